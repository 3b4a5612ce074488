//! This module holds the workpiece: the bodies and meshes that it is made of, and the columns (dexels) that
//! are cut.
//!
//! Lengths are in mm in the workpiece frame, in which dexels stand along z. The stock that is left can be
//! kept in a file ([`stock_file`]), written as a surface ([`stl_export`]) and compared with the target part
//! ([`TargetDeviation`]).

mod air_clip;
mod axis_box;
pub(crate) mod dexel;
mod dexel_spans;
mod dilate;
pub(crate) mod memory;
mod mesh;
mod raw_stock;
mod solid_body;
pub mod stl_export;
mod stock_error;
pub mod stock_file;
mod target_deviation;

pub use air_clip::AirClip;
pub use axis_box::AxisBox;
pub(crate) use dexel::DexelBand;
pub use dexel::{DexelGrid, DexelSpan, Dexels};
pub(crate) use dexel_spans::merge_span;
pub use memory::NoMemory;
#[doc(hidden)]
pub use memory::refuse_memory_for_test;
pub use mesh::{Mesh, MeshError};
pub use raw_stock::Stock;
pub use solid_body::SolidBody;
pub use stock_error::StockError;
pub use stock_file::StockFileError;
pub use target_deviation::{GridMismatch, TargetDeviation};
