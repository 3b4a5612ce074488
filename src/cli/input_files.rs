//! Reading inputs: CL files, recipes and setups, from files and from standard input.

use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::program::{Dialect, LengthUnit};
use clsmith::recipe::Provenance;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::Recipe;
use std::cell::RefCell;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The path that stands for standard input or output.
pub const STANDARD: &str = "-";

/// Reads a file; `-` is standard input.
pub fn read_source(path: &Path) -> Result<Arc<Source>, Box<Diagnostic>> {
    let standard = path == Path::new(STANDARD);
    let name = if standard { "standard input".to_owned() } else { path.to_string_lossy().into_owned() };
    let bytes = if standard {
        let mut bytes = Vec::new();
        std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(path)
    };
    let bytes = bytes.map_err(|error| {
        Box::new(Diagnostic::new(codes::UNREADABLE, format!("{name} cannot be read: {error}")))
    })?;
    Source::new(name, bytes).map_err(|error| Box::new(Diagnostic::new(codes::TOO_LARGE, error.to_string())))
}

/// Reads a setup file.
pub fn read_setup(path: &Path) -> Result<Setup, Vec<Diagnostic>> {
    Setup::load(&read_source(path).map_err(|found| vec![*found])?).map_err(Failure::into_findings)
}

/// A recipe and the setup that counts for it.
pub struct LoadedRecipe {
    pub recipe: Recipe,
    pub setup: Setup,
    /// The texts that were read for them, the recipe first.
    pub texts: Vec<Arc<Source>>,
}

/// Reads a recipe, the setup file it names (beside it), and the one of the command line.
pub fn read_recipe(path: &Path, setup: Option<&Path>) -> Result<LoadedRecipe, Vec<Diagnostic>> {
    let texts = RefCell::new(Vec::new());
    let read = |path: &Path| {
        let source = read_source(path)?;
        texts.borrow_mut().push(Arc::clone(&source));
        Ok(source)
    };
    let message = |found: Box<Diagnostic>| found.message;
    let source = read(path).map_err(|found: Box<Diagnostic>| vec![*found])?;
    let recipe = Recipe::load(&source).map_err(Failure::into_findings)?;
    let named = recipe
        .load_setup_file(|name| read(&path_beside_recipe(path, name)).map_err(message))
        .map_err(Failure::into_findings)?;
    let given = match setup {
        Some(path) => {
            Setup::load(&read(path).map_err(|found| vec![*found])?).map_err(Failure::into_findings)?
        }
        None => Setup::default(),
    };
    let setup = recipe.merge_setups(named, given);
    let setup =
        setup.read_material_file(|path| read(path).map_err(message)).map_err(Failure::into_findings)?;
    Ok(LoadedRecipe { recipe, setup, texts: texts.into_inner() })
}

/// The path of a file that a recipe names: relative to the recipe's folder.
pub fn path_beside_recipe(recipe: &Path, name: &str) -> PathBuf {
    recipe.parent().unwrap_or(Path::new("")).join(name)
}

/// Reads `--dialect`.
pub fn parse_dialect(name: &str) -> Result<Dialect, String> {
    Dialect::from_name(name).ok_or_else(|| {
        let names: Vec<&str> = Dialect::ALL.iter().map(|dialect| dialect.name()).collect();
        format!("the dialects are {}", names.join(", "))
    })
}

/// Reads `--provenance`.
pub fn parse_provenance(name: &str) -> Result<Provenance, String> {
    let found = Provenance::ALL.into_iter().find(|provenance| provenance.name() == name);
    found.ok_or_else(|| "this is none, header or comments".into())
}

/// Reads `--units`.
pub fn parse_length_unit(text: &str) -> Result<LengthUnit, String> {
    match text {
        "mm" => Ok(LengthUnit::Mm),
        "inch" => Ok(LengthUnit::Inch),
        _ => Err("the units are mm and inch".into()),
    }
}

/// Reads a time in seconds, more than none.
pub fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|&seconds: &f64| seconds > 0.0);
    seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| "a time is a number of seconds above 0".into())
}
