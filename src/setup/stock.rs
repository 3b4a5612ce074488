//! The stock: a description of it, which the simulation builds solids from.

use super::YamlLocation;
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::parameters::{FilePath, LengthUnit};
use std::path::{Path, PathBuf};

/// What there is before the first cut, in the coordinates that the CL file prints (those of its frame).
#[derive(Debug, Clone, PartialEq)]
pub struct SetupStock {
    /// Its bodies; the stock is all of them together. Never empty.
    pub bodies: Vec<StockBody>,
    /// How much thicker than described it may be, in mm, 0 or more: the skin of a casting. The simulation grows the
    /// stock by it, so that skin is not taken for air.
    pub allowance_mm: f64,
    /// Where the setup says it.
    pub place: YamlLocation,
}

/// One body of the stock.
#[derive(Debug, Clone, PartialEq)]
pub struct StockBody {
    /// What it is.
    pub shape: StockBodyShape,
    /// Where the setup says it.
    pub place: YamlLocation,
}

/// What a body is.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum StockBodyShape {
    /// A block along the axes.
    Block {
        /// Its lowest corner, mm.
        low: [f64; 3],
        /// Its highest corner, mm; above `low` in every axis.
        high: [f64; 3],
    },
    /// A cylinder in any direction.
    Cylinder {
        /// Diameter, mm.
        diameter: f64,
        /// Centre of one end, mm.
        from: [f64; 3],
        /// Centre of the other end, mm.
        to: [f64; 3],
    },
    /// A closed surface.
    Stl {
        /// The STL file.
        file: FileRef,
        /// The unit of its numbers, for STL says none: that of the file that names it.
        units: LengthUnit,
    },
    /// What an earlier run has left.
    Saved(FileRef),
}

/// A file that a setup names.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRef {
    /// The path seen from where clsmith runs: relative paths begin at the folder of the file that names it.
    pub path: PathBuf,
    /// The path as it is written.
    pub written: String,
    /// Where it is written.
    pub place: YamlLocation,
}

impl FileRef {
    /// A file named at a place.
    pub(super) fn new(path: &FilePath, place: YamlLocation) -> Self {
        let full = path.resolve_beside(Path::new(place.source().name()));
        Self { path: full, written: path.as_str().to_owned(), place }
    }

    /// A finding about the file, at the place that names it.
    pub(crate) fn make_finding(&self, code: DiagnosticCode, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(code, message).with_label(self.place.source(), self.place.value_span(), "named here")
    }

    /// [`codes::STOCK_FILE`]: a file of the stock that cannot be used, and why.
    pub fn make_stock_finding(&self, reason: &str) -> Diagnostic {
        self.make_finding(
            codes::STOCK_FILE,
            format!("the stock file `{}` cannot be used: {reason}", self.written),
        )
    }
}
