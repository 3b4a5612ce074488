//! The command as people run it.

mod apply;
mod batch;
mod chips;
mod defects;
mod display_units;
mod edges;
mod first_steps;
mod forces;
mod gates;
mod hidden_text;
mod hook;
mod hook_examples;
mod json_outputs;
mod limits;
mod machine;
mod one_hand;
mod one_list;
mod other;
mod papers;
mod plot;
mod reports;
mod section;
mod select;
mod simulate;
mod stopping;
mod undo;
mod watch;

use assert_cmd::Command;
use std::path::{Path, PathBuf};

/// The command, in a folder.
pub fn clsmith(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_clsmith"));
    command.current_dir(folder).env("NO_COLOR", "1").env("COLUMNS", "100").env("LC_ALL", "C.UTF-8");
    command
}

/// The command as somebody who is not root, to whom nothing is forbidden.
#[cfg(unix)]
pub fn as_anybody(folder: &Path) -> std::process::Command {
    use std::os::unix::{fs::MetadataExt, process::CommandExt};
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"));
    command.current_dir(folder);
    if std::fs::metadata("/proc/self").is_ok_and(|own| own.uid() == 0) {
        command.uid(65534).gid(65534);
    }
    command
}

/// A folder with an example's recipe and program.
pub fn example(name: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name);
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        std::fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
    }
    folder
}

/// Names of the files in a folder, sorted.
pub fn names(folder: &Path) -> Vec<PathBuf> {
    let mut names: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().flatten().map(|entry| entry.file_name().into()).collect();
    names.sort();
    names
}
