//! This module holds the data around the program: machine, stock, tools and material.
//!
//! The same keys come from the recipe's `setup:`, from a setup file, or from both. The one that is closer to
//! the job has priority, field by field ([`Setup::override_base`]). A setup is a description: lengths are in
//! millimetres, files are given by their paths, and everything has its [`YamlLocation`].
//! [`Setup::resolve_cutter`] makes a tool that can be simulated from the CL file and the setup.

mod machine_axes_text;
mod machine_limits;
mod material;
mod material_origin_text;
mod material_text;
mod setup_reader;
mod setup_text;
mod shipped_materials;
mod shop_words;
mod stock;
mod stock_text;
mod tools;
mod yaml_location;

pub use machine_limits::MachineLimits;
pub use material::{MaterialChoice, MaterialOrigin, WorkMaterial};
pub(crate) use setup_text::SetupText;
pub use stock::{BilletAllowances, BilletShape, FileRef, SetupStock, StockBody, StockBodyShape};
pub use tools::{
    CutterInsert, InsertClearance, InsertData, InsertWidth, ResolvedCutter, ToolCylinder, ToolDataFault,
    ToolDataFaultKind, ToolEntry, ToolStiffness,
};
pub use yaml_location::YamlLocation;

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::ShopVocabulary;
use crate::source::Source;
use std::path::Path;
use std::sync::Arc;

/// The setup of a job. Lengths are in millimetres, whatever the unit of the file.
///
/// ```
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
///
/// let text = b"machine: { max_feed: 8000 }\ntools: [ { match: { number: 3 }, diameter: 10, teeth: 4 } ]\n";
/// let setup = Setup::load(&Source::new("shop.yaml", text.to_vec())?)?;
/// assert_eq!(setup.machine.max_feed.map(|feed| feed.get()), Some(8000.0));
/// assert_eq!(setup.tools[0].diameter_mm, Some(10.0));
///
/// // A fault is told where it stands.
/// let typo = Source::new("shop.yaml", b"machine: { max_fed: 8000 }\n".to_vec())?;
/// let findings = Setup::load(&typo).expect_err("there is no such key").into_findings();
/// assert_eq!(typo.slice(findings[0].labels[0].span), b"max_fed");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setup {
    /// The machine.
    pub machine: MachineLimits,
    /// The stock before the first cut.
    pub stock: Option<SetupStock>,
    /// The tool entries. The first entry that matches a tool counts.
    pub tools: Vec<ToolEntry>,
    /// The work material.
    pub material: Option<MaterialChoice>,
    /// The words that the shop's post knows and no dialect.
    pub vocabulary: Arc<ShopVocabulary>,
}

impl Setup {
    /// Reads a setup file, which has `units:` and the keys of a recipe's `setup:`. Files that it names are
    /// not opened.
    ///
    /// # Errors
    /// Returns all faults of the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Failure> {
        setup_text::load_setup(source)
    }

    /// Returns this setup, with `base` where this one has no value. Stock and material are taken as a whole.
    /// The tool entries of this setup come first.
    #[must_use]
    pub fn override_base(self, base: Self) -> Self {
        let mut tools = self.tools;
        tools.extend(base.tools);
        Self {
            machine: self.machine.override_base(base.machine),
            stock: self.stock.or(base.stock),
            tools,
            material: self.material.or(base.material),
            vocabulary: match base.vocabulary.is_empty() {
                true => self.vocabulary,
                false => Arc::new((*self.vocabulary).clone().override_base((*base.vocabulary).clone())),
            },
        }
    }

    /// Returns the stock.
    ///
    /// # Errors
    /// Returns [`codes::STOCK_MISSING`] if the setup has none.
    pub fn require_stock(&self) -> Result<&SetupStock, Failure> {
        let missing = || {
            let message = "a simulation needs the stock, and the setup has none";
            let help = "Add it under `setup:`, in the coordinates of the CL file: \
                        `stock: { block: { from: [x, y, z], to: [x, y, z] } }`, or `cylinder`, `stl`, `around`, `file`.";
            Diagnostic::new(codes::STOCK_MISSING, message).with_help(help)
        };
        Ok(self.stock.as_ref().ok_or_else(missing)?)
    }

    /// Returns the files from which the stock is read.
    pub fn stock_files(&self) -> impl Iterator<Item = &Path> {
        let bodies = self.stock.iter().flat_map(|stock| &stock.bodies);
        bodies.filter_map(|body| match &body.shape {
            StockBodyShape::Stl { file, .. }
            | StockBodyShape::Around { file, .. }
            | StockBodyShape::Saved(file) => Some(file.path.as_path()),
            StockBodyShape::Block { .. } | StockBodyShape::Cylinder { .. } => None,
        })
    }

    /// Returns the files that the setup names: stock, material and machine.
    pub fn referenced_files(&self) -> impl Iterator<Item = &Path> {
        let material = self.material.iter().filter_map(|material| match material {
            MaterialChoice::File(file) => Some(file.path.as_path()),
            _ => None,
        });
        let machine = self.machine.file.iter().map(|file| file.path.as_path());
        self.stock_files().chain(material).chain(machine)
    }

    /// Returns the JSON schema of a setup file, for editors.
    pub fn schema() -> serde_json::Value {
        setup_text::setup_file_schema()
    }
}
