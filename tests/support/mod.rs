//! What the areas share: what tests need beside the project, properties, programs from text, snapshots.

mod property;
mod requirement;
mod timing;

pub use property::property;
#[cfg(unix)]
pub use requirement::require_path;
pub use requirement::{
    require_corpus, require_corpus_file, require_corpus_with_part_programs, require_program,
    require_shared_folder, require_viewer,
};
pub use timing::{try_until_met, wait_for, within_seconds};

use clsmith::program::geometry::{CircularArc, MotionPath as ClPath};
use clsmith::program::motion::{ActiveTool, Motion, MotionProblemKind};
use clsmith::program::{Dialect, Program, StatementId};
use clsmith::source::Source;
use std::path::{Path, PathBuf};

/// A source read from a file.
pub fn source(path: &Path) -> std::sync::Arc<Source> {
    Source::new(path.file_name().unwrap().to_string_lossy(), std::fs::read(path).unwrap()).unwrap()
}

/// A source from text.
pub fn text(text: impl AsRef<[u8]>) -> std::sync::Arc<Source> {
    Source::new("part.cls", text.as_ref().to_vec()).unwrap()
}

/// A program parsed from text, which must be free of errors.
pub fn program(source: impl AsRef<[u8]>) -> Program {
    let parsed = clsmith::parse::parse(&text(source), None);
    assert!(parsed.diagnostics.iter().all(|found| !found.is_error()), "{:?}", parsed.diagnostics);
    parsed.program
}

/// How many statements stand before each statement of a motion.
pub fn statement_indices(motion: &Motion) -> Vec<usize> {
    motion.statements.ids().map(StatementId::index).collect()
}

/// Snapshots of an area, all kept in the top-level `snapshots/`.
pub fn snapshots(area: &str) -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(format!("{}/snapshots/{area}", env!("CARGO_MANIFEST_DIR")));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

/// As [`snapshots`], with numbers cut to six decimals: the last digits of sines differ between platforms.
pub fn rounded_snapshots(area: &str) -> insta::Settings {
    let mut settings = snapshots(area);
    settings.add_filter(r"(\d\.\d{6})\d+", "$1");
    settings
}

/// All fixtures of the project with the dialect that their folder names.
pub fn fixtures() -> Vec<(Dialect, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let mut files = Vec::new();
    for dialect in Dialect::ALL {
        let folder = std::fs::read_dir(root.join(dialect.name())).unwrap();
        files.extend(folder.flatten().map(|entry| (dialect, entry.path())));
    }
    files.sort_by(|(_, a), (_, b)| a.cmp(b));
    files
}

/// A fixture by its path below `tests/fixtures`, parsed; it must be free of errors.
pub fn fixture(path: &str) -> Program {
    program(std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(path)).unwrap())
}

/// A program parsed from text of a given dialect, which must be free of errors.
pub fn program_of(dialect: Dialect, source: impl AsRef<[u8]>) -> Program {
    let parsed = clsmith::parse::parse(&text(source), Some(dialect));
    assert!(parsed.diagnostics.iter().all(|found| !found.is_error()), "{:?}", parsed.diagnostics);
    parsed.program
}

/// All motions of a program, and the problems met on the way.
pub fn motions(program: &Program) -> (Vec<Motion>, Vec<MotionProblemKind>) {
    let mut motions = program.motions();
    let found = motions.by_ref().collect();
    (found, motions.take_problems().into_iter().map(|problem| problem.kind).collect())
}

/// The motions of a program that has no problem.
pub fn clean_motions(program: &Program) -> Vec<Motion> {
    let (found, problems) = motions(program);
    assert!(problems.is_empty(), "{problems:?}");
    found
}

/// The only arc among motions that hold just one.
pub fn only_arc(motions: &[Motion]) -> &CircularArc {
    let mut arcs = motions.iter().filter_map(|motion| match &motion.path {
        ClPath::Arc(arc) => Some(arc.as_ref()),
        _ => None,
    });
    let arc = arcs.next().unwrap();
    assert!(arcs.next().is_none());
    arc
}

/// A tool of which only number and name are known.
pub fn named_tool(number: Option<u32>, name: Option<&str>) -> ActiveTool {
    let mut tool = ActiveTool::default();
    tool.number = number;
    tool.name = name.map(str::to_owned);
    tool
}
