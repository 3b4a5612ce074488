//! This module reads recipes, which state in YAML which transforms are applied with which parameters.
//!
//! A [`Recipe`] is generic over its steps, which are the business of the transforms. This module knows the
//! keys around them, and the place of each of them in the file.

mod motion_filter;
mod provenance;
mod recipe_fault_wording;
mod recipe_text;
mod statement_filter;

pub use crate::parameters;
pub use crate::yaml::YamlPathSegment;
pub(crate) use motion_filter::deserialize_not_empty;
pub use motion_filter::{FeedRange, MotionFacts, MotionFilter};
pub use provenance::Provenance;
pub use recipe_text::recipe_schema;
pub use statement_filter::{OperationFilter, StatementFilter};

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::setup::{Setup, YamlLocation};
use crate::source::{Source, SourceReadError, Span};
use crate::yaml::YamlDocument;
use parameters::LengthUnit;
use recipe_text::RecipeText;
use serde::de::DeserializeOwned;
use std::sync::{Arc, OnceLock};

/// A recipe that was read and checked.
///
/// `S` is a serde enum with one variant per transform, tagged externally: `- scale_feed: { factor: 0.8 }`.
///
/// ```
/// use clsmith::source::Source;
/// use clsmith::transform::Recipe;
///
/// let text = b"version: 1\nsteps:\n  - scale_feed: { factor: 0.8 }\n";
/// let recipe = Recipe::load(&Source::new("recipe.yaml", text.to_vec())?)?;
/// assert_eq!(recipe.step_names(), ["scale_feed"]);
///
/// // A fault stands at its place, with what to do about it.
/// let text = b"version: 1\nsteps:\n  - scale_fed: { factor: 0.8 }\n";
/// let wrong = Source::new("recipe.yaml", text.to_vec())?;
/// let findings = Recipe::load(&wrong).expect_err("there is no such step").into_findings();
/// assert_eq!(wrong.slice(findings[0].labels[0].span), b"scale_fed");
/// assert!(findings[0].help.as_ref().is_some_and(|help| help.contains("scale_feed")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Recipe<S> {
    /// The file from which it was read. Diagnostics point into it.
    pub source: Arc<Source>,
    /// The version of the rules by which it was written.
    pub version: u32,
    /// The unit of every length in it. Feeds are in this unit per minute.
    pub units: LengthUnit,
    /// The path of a setup file, relative to the recipe's folder; see [`Recipe::load_setup_file`].
    pub setup_file: Option<String>,
    /// The recipe's own `setup:`, in millimetres; see [`Recipe::merge_setups`].
    pub setup: Setup,
    /// What the corrected file states about its run.
    pub provenance: Provenance,
    /// Whether the corrected program is simulated before it is written, where the setup has a stock.
    pub simulate: bool,
    /// The steps in the order in which they are applied.
    pub steps: Vec<S>,
    document: Arc<YamlDocument>,
    step_places: Vec<OnceLock<Span>>,
}

impl<S: DeserializeOwned> Recipe<S> {
    /// Reads a recipe.
    ///
    /// # Errors
    /// Returns all faults in the order of the text, each at its exact key or value. At most 20 findings are
    /// returned.
    pub fn load(source: &Arc<Source>) -> Result<Self, Failure> {
        let document = YamlDocument::parse(source)?;
        let text: RecipeText<S> = document
            .deserialize_checked(recipe_fault_wording::word_recipe_fault)
            .map_err(|failure| keep_version_finding(&document, failure))?;
        let document = Arc::new(document);
        let setup = text
            .setup
            .check_setup(text.units, YamlLocation::new(&document, &[YamlPathSegment::Key("setup")]))?;
        Ok(Self {
            source: Arc::clone(source),
            version: text.version.get(),
            units: text.units,
            setup_file: text.setup_file,
            setup,
            provenance: text.provenance,
            simulate: text.simulate,
            step_places: text.steps.iter().map(|_| OnceLock::new()).collect(),
            steps: text.steps,
            document,
        })
    }
}

/// Keeps only the finding about the version if that is unknown, because the rest was written by unknown
/// rules.
fn keep_version_finding(document: &YamlDocument, failure: Failure) -> Failure {
    let Failure::Found(mut found) = failure else { return failure };
    if document.value_span(&[YamlPathSegment::Key("version")]).is_some()
        && found.iter().any(|diagnostic| diagnostic.code == codes::RECIPE_VERSION)
    {
        found.retain(|diagnostic| diagnostic.code == codes::RECIPE_VERSION);
    }
    found.into()
}

impl<S> Recipe<S> {
    /// Returns the place of a value. For a key without a value, it is the place of the key. Returns `None` if
    /// the recipe does not contain it.
    pub fn value_span(&self, path: &[YamlPathSegment<'_>]) -> Option<Span> {
        self.document.value_span(path)
    }

    /// Returns the place of a value's key. Returns `None` if the recipe does not contain it.
    pub fn key_span(&self, path: &[YamlPathSegment<'_>]) -> Option<Span> {
        self.document.key_span(path)
    }

    /// Returns the place of a step's name as it was written: `scale_feed`. It is searched once and then
    /// remembered.
    ///
    /// A step that does not exist is placed at the start of the file, so that a diagnostic is never lost for
    /// want of a place.
    pub fn step_span(&self, index: usize) -> Span {
        let find = || self.find_step_span(index).unwrap_or_default();
        self.step_places.get(index).map_or_else(find, |place| *place.get_or_init(find))
    }

    /// Returns the place of a parameter of a step. It is given by the keys below the step's name, and
    /// elements of lists by their index (`"0"`). If the recipe does not contain it, the place of the nearest
    /// key above it is returned, in the end that of the step's name.
    ///
    /// Each call reads the text of the recipe again, so it should be called once per step, not once per
    /// finding.
    pub fn step_value_span(&self, index: usize, keys: &[&str]) -> Span {
        let step = [YamlPathSegment::Key("steps"), YamlPathSegment::Index(index)];
        let Some(name) = self.document.list_keys(&step).first().copied() else {
            return self.step_span(index);
        };
        let below: Vec<YamlPathSegment<'_>> = keys
            .iter()
            .map(|key| key.parse().map_or(YamlPathSegment::Key(key), YamlPathSegment::Index))
            .collect();
        (1..=below.len())
            .rev()
            .filter_map(|count| {
                let mut path = vec![step[0], step[1], YamlPathSegment::Key(name)];
                path.extend_from_slice(below.get(..count)?);
                self.document.value_span(&path)
            })
            .next()
            .unwrap_or_else(|| self.step_span(index))
    }

    fn find_step_span(&self, index: usize) -> Option<Span> {
        let step = [YamlPathSegment::Key("steps"), YamlPathSegment::Index(index)];
        match self.document.list_keys(&step).first() {
            Some(name) => self.document.key_span(&[step[0], step[1], YamlPathSegment::Key(name)]),
            None => self.document.value_span(&step),
        }
    }

    /// Reads the setup file that the recipe names. Returns an empty setup if it names none.
    ///
    /// `read` gets the path as written. It returns the file, or the reason why it cannot be read.
    ///
    /// # Errors
    /// Returns [`codes::SETUP_FILE`] at the path in the recipe, or the faults of the setup file.
    pub fn load_setup_file(
        &self,
        read: impl FnOnce(&str) -> Result<Arc<Source>, SourceReadError>,
    ) -> Result<Setup, Failure> {
        let Some(path) = &self.setup_file else { return Ok(Setup::default()) };
        let source = read(path).map_err(|reason| {
            let span = self.value_span(&[YamlPathSegment::Key("setup_file")]);
            debug_assert!(span.is_some(), "the path was read from this key");
            let span = span.unwrap_or_default();
            let message = format!("the setup file `{path}` cannot be read: {reason}");
            Diagnostic::new(codes::SETUP_FILE, message).with_label(&self.source, span, "named here")
        })?;
        Setup::load(&source)
    }

    /// Merges setups field by field. The command line has priority over the recipe, and the recipe over the
    /// setup file.
    pub fn merge_setups(&self, setup_file: Setup, command_line: Setup) -> Setup {
        command_line.override_base(self.setup.clone()).override_base(setup_file)
    }
}
