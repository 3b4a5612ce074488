//! Back from a corrected file to the original, by the report of the run (`apply --json`).
//!
//! [`RunReport`] is what is written: what the run did, for other programs, and for undo the old bytes of every place that differs
//! ([`Patch`]), the digests of both files, and checksums along the corrected one. [`Undo`] is what is read of it: it gives the
//! original back, byte for byte, from exactly the file that the run wrote, or says why not and from where on it is another.

mod back;
mod blocks;
mod patch;
mod report;

pub use back::{Undo, Undone};
pub use blocks::Blocks;
pub use patch::{Patch, Place};
pub use report::{FORMAT, FORMAT_VERSION, Output, RunReport, Sized};
