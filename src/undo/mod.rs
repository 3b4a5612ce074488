//! This module restores the original from a corrected file, by the report of the run (`apply --json`).
//!
//! [`RunReport`] is what is written: what the run did, for other programs, and for undo the old bytes of
//! every place that differs ([`UndoPatch`]), the digests of both files, and checksums of the corrected one.
//! [`UndoData`] is what is read from it. It restores the original byte for byte from exactly the file that
//! the run wrote. For any other file, it reports where the two begin to differ.
//!
//! The report only contains old bytes. The digests make sure that the file is the one that was written and
//! that the result is the one that was read, so nothing between them can be wrong. The checksums, one for
//! each KiB, only show where another file differs.

mod block_checksums;
mod run_report;
mod undo_data;
mod undo_patch;

pub use block_checksums::BlockChecksums;
pub use run_report::{CorrectedFile, FileIdentity, RunReport};
pub use undo_data::{RestoredOriginal, UndoData};
pub use undo_patch::{UndoEdit, UndoPatch};
