//! This module holds the vertices of a chain between which chords are fitted.

use super::chain_piece::{ArcPiece, Point};

/// A vertex of the chain at which a chord may end.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChordVertex {
    pub point: Point,
    /// The arc that leads here from the vertex before; `None` for a line.
    pub arc: Option<ArcPiece>,
    /// Whether a chord or an arc must end here.
    pub corner: bool,
}
