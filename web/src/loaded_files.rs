//! This module reads recipes and setups with all files that they name, as the command does.

use clsmith::diagnostic::codes;
use clsmith::source::{SourceReadError, read_file_bytes};
use clsmith::{Diagnostic, Failure, Recipe, Setup, Source};
use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

/// Takes the bytes of a program.
pub(crate) fn read_program(name: &str, bytes: Vec<u8>) -> Result<Arc<Source>, Failure> {
    Source::new(name, bytes)
        .map_err(|too_large| Diagnostic::new(codes::TOO_LARGE, too_large.to_string()).into())
}

/// Reads a given file that another file names.
fn read_named(path: &Path) -> Result<Arc<Source>, SourceReadError> {
    let name = path.to_string_lossy().into_owned();
    let bytes =
        read_file_bytes(path).map_err(|error| SourceReadError::Unreadable { name: name.clone(), error })?;
    Ok(Source::new(name, bytes)?)
}

/// Reads a given file that the page names.
fn read_chosen(name: &str) -> Result<Arc<Source>, Failure> {
    read_named(Path::new(name)).map_err(|error| Diagnostic::new(codes::UNREADABLE, error.to_string()).into())
}

/// A setup with the files that were read for it.
#[derive(Default)]
pub(crate) struct LoadedSetup {
    pub(crate) setup: Setup,
    pub(crate) texts: Vec<Arc<Source>>,
}

impl LoadedSetup {
    /// Reads a setup file, its machine and its material. Without a name, the setup is empty.
    pub(crate) fn read_given(name: Option<&str>) -> Result<Self, Failure> {
        let Some(name) = name else { return Ok(Self::default()) };
        let texts = RefCell::new(Vec::new());
        let keep = |source: &Arc<Source>| texts.borrow_mut().push(Arc::clone(source));
        let read = |path: &Path| read_named(path).inspect(keep);
        let setup = Setup::load(&read_chosen(name).inspect(keep)?)?;
        let setup = setup.read_machine_file(read)?.read_material_file(read)?;
        Ok(Self { setup, texts: texts.into_inner() })
    }
}

/// A recipe and the setup in force.
pub(crate) struct LoadedRecipe {
    pub(crate) recipe: Recipe,
    pub(crate) setup: Setup,
    /// The texts that were read for them. The first one is the recipe.
    pub(crate) texts: Vec<Arc<Source>>,
}

impl LoadedRecipe {
    /// Reads a recipe, the setup file that it names, and a setup file that overrides that.
    pub(crate) fn read_given(name: &str, setup: Option<&str>) -> Result<Self, Failure> {
        let texts = RefCell::new(Vec::new());
        let keep = |source: &Arc<Source>| texts.borrow_mut().push(Arc::clone(source));
        let read = |path: &Path| read_named(path).inspect(keep);
        let recipe = Recipe::load(&read_chosen(name).inspect(keep)?)?;
        let named = recipe.load_setup_file(|named| read(&Path::new(name).with_file_name(named)))?;
        let given = match setup {
            Some(name) => Setup::load(&read_chosen(name).inspect(keep)?)?,
            None => Setup::default(),
        };
        let setup = recipe.merge_setups(named, given).read_machine_file(read)?.read_material_file(read)?;
        Ok(Self { recipe, setup, texts: texts.into_inner() })
    }
}
