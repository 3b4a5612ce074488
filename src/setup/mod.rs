//! What stands around the program: machine, stock, tools, material.
//!
//! The same keys come from the recipe's `setup:`, from a setup file, or both; whoever is closer to the job wins, field
//! by field ([`Setup::over`]). A setup is a description: lengths in millimetres, files by their paths, everything with
//! its [`Place`]. [`Setup::cutter`] makes a tool that can be simulated of what the CL file and the setup say together.

mod machine;
mod material;
mod place;
mod reader;
mod stock;
mod stock_text;
mod text;
mod tools;

pub use machine::Machine;
pub use material::{Material, MaterialChoice};
pub use place::Place;
pub use stock::{Body, BodyShape, FileRef, Stock};
pub(crate) use text::SetupText;
pub use tools::{Bar, Insert, Resolved, ToolEntry, ToolGap, ToolGapKind};

use crate::diagnostic::{Diagnostic, codes};
use crate::source::Source;
use std::path::Path;
use std::sync::Arc;

/// The setup of a job. Lengths in millimetres, whatever the unit of the file it came from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setup {
    /// The machine.
    pub machine: Machine,
    /// What there is before the first cut.
    pub stock: Option<Stock>,
    /// What is said about tools; the first entry that fits a tool counts.
    pub tools: Vec<ToolEntry>,
    /// The material that is cut.
    pub material: Option<MaterialChoice>,
}

impl Setup {
    /// Reads a setup file: `units:` and the keys of a recipe's `setup:` beside it. Files that it names are not opened.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Vec<Diagnostic>> {
        text::load(source)
    }

    /// This setup where it says something, `base` where it does not. Stock and material go as a whole; of tools, the
    /// entries of this setup come first.
    #[must_use]
    pub fn over(self, base: Self) -> Self {
        let mut tools = self.tools;
        tools.extend(base.tools);
        Self {
            machine: self.machine.over(base.machine),
            stock: self.stock.or(base.stock),
            tools,
            material: self.material.or(base.material),
        }
    }

    /// The stock.
    ///
    /// # Errors
    /// [`codes::STOCK_MISSING`] when the setup says none.
    pub fn stock(&self) -> Result<&Stock, Box<Diagnostic>> {
        self.stock.as_ref().ok_or_else(|| {
            let message = "a simulation needs the stock, and the setup says none";
            let help = "Add it under `setup:`, in the coordinates of the CL file: \
                        `stock: { block: { from: [x, y, z], to: [x, y, z] } }`, or `cylinder`, `stl`, `file`.";
            Box::new(Diagnostic::new(codes::STOCK_MISSING, message).help(help))
        })
    }

    /// The files that its stock is read from.
    pub fn stock_files(&self) -> impl Iterator<Item = &Path> {
        let bodies = self.stock.iter().flat_map(|stock| &stock.bodies);
        bodies.filter_map(|body| match &body.shape {
            BodyShape::Stl { file, .. } | BodyShape::Saved(file) => Some(file.path.as_path()),
            BodyShape::Block { .. } | BodyShape::Cylinder { .. } => None,
        })
    }

    /// The files that it names: stock and material.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let material = self.material.iter().filter_map(|material| match material {
            MaterialChoice::File(file) => Some(file.path.as_path()),
            _ => None,
        });
        self.stock_files().chain(material)
    }

    /// JSON schema of a setup file, for editors.
    pub fn schema() -> serde_json::Value {
        text::schema()
    }
}
