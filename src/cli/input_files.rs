//! This module reads inputs: CL files, recipes and setups, from files and from standard input.

use crate::cli::bad_argument::BadArgument;
use crate::cli::choice_parser::ChoiceParser;
use clap::builder::TypedValueParser;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::program::{Dialect, LengthUnit};
use clsmith::recipe::Provenance;
use clsmith::setup::Setup;
use clsmith::source::{
    LARGEST_STREAM_BYTES, Source, SourceReadError, SourceTooLarge, read_file_or_pipe, read_stream_bytes,
};
use clsmith::transform::Recipe;
use std::cell::RefCell;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The path that stands for standard input or output.
pub(super) const STANDARD: &str = "-";

/// Reads a file; `-` is standard input.
pub(super) fn read_source(path: &Path) -> Result<Arc<Source>, Failure> {
    read_source_within(path, LARGEST_STREAM_BYTES)
}

/// Reads a file; `-` is standard input. No more than `most` bytes are read from a pipe.
pub(super) fn read_source_within(path: &Path, most: u64) -> Result<Arc<Source>, Failure> {
    Ok(read_bytes_within(path, most).map_err(|error| {
        let (code, help) = match error {
            SourceReadError::Unreadable { .. } => (codes::UNREADABLE, None),
            SourceReadError::TooLarge(SourceTooLarge::Stream { .. }) => (
                codes::TOO_LARGE,
                Some(
                    "Look at what writes into the pipe; a program that is really so long is given as a file.",
                ),
            ),
            SourceReadError::TooLarge(_) => (codes::TOO_LARGE, None),
        };
        let found = Diagnostic::new(code, error.to_string());
        match help {
            Some(help) => found.with_help(help),
            None => found,
        }
    })?)
}

/// Reads a file; `-` is standard input.
///
/// # Errors
/// Returns the reason why it cannot be read, and no finding: if another file names it, the caller reports the
/// place of the name.
pub(super) fn read_bytes(path: &Path) -> Result<Arc<Source>, SourceReadError> {
    read_bytes_within(path, LARGEST_STREAM_BYTES)
}

fn read_bytes_within(path: &Path, most: u64) -> Result<Arc<Source>, SourceReadError> {
    let standard = path == Path::new(STANDARD);
    let name = if standard { "standard input".to_owned() } else { path.to_string_lossy().into_owned() };
    let bytes = if standard { read_standard_input(most) } else { read_file_or_pipe(path, most) };
    let bytes = bytes.map_err(|error| match error.get_ref().and_then(|inner| inner.downcast_ref()) {
        Some(too_large) => SourceReadError::TooLarge(*too_large),
        None => SourceReadError::Unreadable { name: name.clone(), error },
    })?;
    Ok(Source::new(name, bytes)?)
}

/// Reads at most so many bytes of standard input, unless that is a device without an end.
fn read_standard_input(most: u64) -> io::Result<Vec<u8>> {
    let input = io::stdin().lock();
    // A terminal ends when its user says so, and `/dev/null` is empty.
    #[cfg(unix)]
    if !io::IsTerminal::is_terminal(&input) {
        use std::os::fd::AsFd;
        use std::os::unix::fs::MetadataExt;
        let there = std::fs::File::from(input.as_fd().try_clone_to_owned()?).metadata()?;
        if !std::fs::metadata("/dev/null").is_ok_and(|null| null.rdev() == there.rdev()) {
            clsmith::source::refuse_device(&there)?;
        }
    }
    read_stream_bytes(input, most)
}

/// Reads a setup file, and the file of its machine.
pub(super) fn read_setup(path: &Path) -> Result<Setup, Failure> {
    Setup::load(&read_source(path)?)?.read_machine_file(read_bytes)
}

/// A recipe and the setup in force.
pub(super) struct LoadedRecipe {
    pub recipe: Recipe,
    pub setup: Setup,
    /// The texts that were read for them. The first one is the recipe.
    pub texts: Vec<Arc<Source>>,
}

/// Reads a recipe, the setup file that it names (relative to its folder), and the setup file of the command
/// line, which overrides that.
pub(super) fn read_recipe(path: &Path, setup: Option<&Path>) -> Result<LoadedRecipe, Failure> {
    let texts = RefCell::new(Vec::new());
    let keep = |source: &Arc<Source>| texts.borrow_mut().push(Arc::clone(source));
    let read = |path: &Path| read_bytes(path).inspect(keep);
    let source = read_source(path).inspect(keep)?;
    let recipe = Recipe::load(&source)?;
    let named = recipe.load_setup_file(|name| read(&path_beside_recipe(path, name)))?;
    let given = match setup {
        Some(path) => Setup::load(&read_source(path).inspect(keep)?)?,
        None => Setup::default(),
    };
    let setup = recipe.merge_setups(named, given).read_machine_file(read)?.read_material_file(read)?;
    Ok(LoadedRecipe { recipe, setup, texts: texts.into_inner() })
}

/// Returns the path of a file that a recipe names, relative to the recipe's folder.
pub(super) fn path_beside_recipe(recipe: &Path, name: &str) -> PathBuf {
    recipe.parent().unwrap_or(Path::new("")).join(name)
}

/// Returns the reader of `--dialect`, which knows all values.
pub(super) fn dialect_parser() -> impl TypedValueParser<Value = Dialect> {
    ChoiceParser::new(parse_dialect, || Dialect::ALL.iter().map(|dialect| dialect.name()).collect())
}

/// Returns the reader of `--units` and `--display-units`, which knows all values.
pub(super) fn length_unit_parser() -> impl TypedValueParser<Value = LengthUnit> {
    ChoiceParser::new(parse_length_unit, || vec!["mm", "inch"])
}

/// Returns the reader of `--provenance`, which knows all values.
pub(super) fn provenance_parser() -> impl TypedValueParser<Value = Provenance> {
    ChoiceParser::new(parse_provenance, || Provenance::ALL.iter().map(|one| one.name()).collect())
}

fn parse_dialect(name: &str) -> Result<Dialect, BadArgument> {
    Dialect::from_name(name).ok_or_else(|| {
        let names: Vec<&str> = Dialect::ALL.iter().map(|dialect| dialect.name()).collect();
        BadArgument::new(format!("the dialects are {}", names.join(", ")))
    })
}

fn parse_provenance(name: &str) -> Result<Provenance, BadArgument> {
    let found = Provenance::ALL.into_iter().find(|provenance| provenance.name() == name);
    found.ok_or(BadArgument::new("this is none, header or comments"))
}

fn parse_length_unit(text: &str) -> Result<LengthUnit, BadArgument> {
    match text {
        "mm" => Ok(LengthUnit::Mm),
        "inch" => Ok(LengthUnit::Inch),
        _ => Err(BadArgument::new("the units are mm and inch")),
    }
}

/// Reads a time in seconds, which must be above 0.
pub(super) fn parse_seconds(text: &str) -> Result<Duration, BadArgument> {
    let seconds = text.parse().ok().filter(|&seconds: &f64| seconds > 0.0);
    seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or(BadArgument::new("a time is a number of seconds above 0"))
}
