//! This module describes the stock, from which the simulation builds solids.

use super::YamlLocation;
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::parameters::{FilePath, LengthUnit};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// The stock before the first cut, in the coordinates that the CL file prints (those of its frame).
#[derive(Debug, Clone, PartialEq)]
pub struct SetupStock {
    /// Its bodies, at least one. The stock is the union of all of them.
    pub bodies: Vec<StockBody>,
    /// How much thicker than described it may be in mm, 0 or more: the skin of a casting. The simulation adds
    /// it to the stock, so that skin is not taken for air.
    pub allowance_mm: f64,
    /// The place of the stock in the setup.
    pub place: YamlLocation,
}

/// One body of the stock.
#[derive(Debug, Clone, PartialEq)]
pub struct StockBody {
    /// The shape of the body.
    pub shape: StockBodyShape,
    /// The place of the body in the setup.
    pub place: YamlLocation,
}

/// The shape of a body.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum StockBodyShape {
    /// A block along the axes.
    Block {
        /// Its lowest vertex, in mm.
        low: [f64; 3],
        /// Its highest vertex, in mm. It is above `low` in every axis.
        high: [f64; 3],
    },
    /// A cylinder in any direction.
    Cylinder {
        /// The diameter, in mm.
        diameter: f64,
        /// The centre of one end, in mm.
        from: [f64; 3],
        /// The centre of the other end, in mm.
        to: [f64; 3],
    },
    /// A closed surface.
    Stl {
        /// The STL file.
        file: FileRef,
        /// The unit of its numbers, which STL does not state. It is the unit of the file that names it.
        units: LengthUnit,
    },
    /// A block or an upright cylinder around a model, with allowances: a billet that the model fits into.
    Around {
        /// The STL file of the model.
        file: FileRef,
        /// The unit of its numbers.
        units: LengthUnit,
        /// What the billet is larger at each side.
        allowances: BilletAllowances,
        /// Its shape.
        shape: BilletShape,
    },
    /// The stock that an earlier run has left.
    Saved(FileRef),
}

/// What a billet is larger than its model, mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BilletAllowances {
    /// At each side across z; of a cylinder at its radius.
    pub sides_mm: f64,
    /// Above.
    pub top_mm: f64,
    /// Below.
    pub bottom_mm: f64,
}

/// The shape of a billet around a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum BilletShape {
    /// A block along the axes.
    #[default]
    Block,
    /// A cylinder along z around the middle of the model's box.
    Cylinder,
}

/// A file that a setup names.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRef {
    /// The path as seen from where clsmith runs. Relative paths start at the folder of the file that names
    /// it.
    pub path: PathBuf,
    /// The path as it is written.
    pub written: String,
    /// The place where it is written.
    pub place: YamlLocation,
}

impl FileRef {
    /// Makes a reference to a file that is named at a place.
    pub(super) fn new(path: &FilePath, place: YamlLocation) -> Self {
        let full = path.resolve_beside(Path::new(place.source().name()));
        Self { path: full, written: path.as_str().to_owned(), place }
    }

    /// Makes a finding about the file, at the place that names it.
    pub(crate) fn make_finding(&self, code: DiagnosticCode, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(code, message).with_label(self.place.source(), self.place.value_span(), "named here")
    }

    /// Makes the finding [`codes::STOCK_FILE`] about a file of the stock that cannot be used, with the
    /// reason.
    pub fn make_stock_finding(&self, reason: &str) -> Diagnostic {
        self.make_finding(
            codes::STOCK_FILE,
            format!("the stock file `{}` cannot be used: {reason}", self.written),
        )
    }
}
