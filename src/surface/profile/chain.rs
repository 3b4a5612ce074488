//! This module holds chains: connected lines and arcs.

use super::chain_piece::{ChainPiece, Point};
use std::f64::consts::TAU;

/// The end of a piece and the start of the next one are the same point if they are at most this far apart,
/// mm.
pub const CONNECTED: f64 = 1e-6;

/// The largest coordinate and radius, mm. At ten kilometres a number still resolves 2e-9 mm.
pub const LARGEST: f64 = 1e7;

/// Connected pieces from a start to an end. A chain may go towards +u or -u, be vertical in parts, and
/// overhang.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    pieces: Vec<ChainPiece>,
}

/// The reason why pieces do not make a chain.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChainError {
    /// There is no piece, or a polyline has fewer than two points.
    #[error("the chain has no piece")]
    Empty,
    /// A number is not finite or too large.
    #[error("piece {piece}: a number is not finite, or larger than {LARGEST:e} mm")]
    Number {
        /// The index of the piece, from 0.
        piece: usize,
    },
    /// A radius is not positive, or an arc is longer than one turn.
    #[error("piece {piece}: an arc needs a positive radius and at most one turn")]
    Arc {
        /// The index of the piece, from 0.
        piece: usize,
    },
    /// A piece does not start at the end of the piece before.
    #[error("piece {piece} starts {gap:.6} mm from the end of the piece before")]
    Gap {
        /// The index of the piece, from 0.
        piece: usize,
        /// The distance between both ends, mm.
        gap: f64,
    },
}

impl Chain {
    /// Makes the chain of `pieces`, mm.
    ///
    /// # Errors
    /// Returns a [`ChainError`] with the index of the piece if there is no piece, a number is not finite or
    /// beyond [`LARGEST`], an arc is not valid, or two pieces are further apart than [`CONNECTED`].
    pub fn new(pieces: Vec<ChainPiece>) -> Result<Self, ChainError> {
        if pieces.is_empty() {
            return Err(ChainError::Empty);
        }
        let mut before: Option<Point> = None;
        for (index, piece) in pieces.iter().enumerate() {
            check_piece(index, piece)?;
            let start = piece.start();
            if let Some(gap) = before.map(|end| end.distance(start)).filter(|gap| *gap > CONNECTED) {
                return Err(ChainError::Gap { piece: index, gap });
            }
            before = Some(piece.end());
        }
        Ok(Self { pieces })
    }

    /// Makes the straight pieces through `points`, mm.
    ///
    /// # Errors
    /// Returns a [`ChainError`] if there are fewer than two points, or a number is not finite or beyond
    /// [`LARGEST`].
    pub fn from_points(points: &[Point]) -> Result<Self, ChainError> {
        let pair = |pair: &[Point]| match pair {
            [from, to] => Some(ChainPiece::line(*from, *to)),
            _ => None,
        };
        Self::new(points.windows(2).filter_map(pair).collect())
    }

    /// Makes a chain of pieces that are known to be connected.
    pub(super) fn from_trusted(pieces: Vec<ChainPiece>) -> Self {
        Self { pieces }
    }

    /// Returns the pieces, at least one.
    pub fn pieces(&self) -> &[ChainPiece] {
        &self.pieces
    }

    /// Returns the start.
    pub fn start(&self) -> Point {
        self.pieces.first().map(ChainPiece::start).unwrap_or_default()
    }

    /// Returns the end.
    pub fn end(&self) -> Point {
        self.pieces.last().map(ChainPiece::end).unwrap_or_default()
    }

    /// Returns the starts and ends of the pieces in order: one more than there are pieces.
    pub fn vertices(&self) -> impl Iterator<Item = Point> + '_ {
        std::iter::once(self.start()).chain(self.pieces.iter().map(ChainPiece::end))
    }

    /// Returns the length, mm.
    pub fn length_mm(&self) -> f64 {
        self.pieces.iter().map(ChainPiece::length_mm).sum()
    }

    /// Returns the same chain from its end to its start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { pieces: self.pieces.iter().rev().map(ChainPiece::reversed).collect() }
    }

    /// Returns the same chain, moved by some mm.
    #[must_use]
    pub fn shifted(&self, du: f64, dz: f64) -> Self {
        Self { pieces: self.pieces.iter().map(|piece| piece.shifted(du, dz)).collect() }
    }

    /// Returns the same chain with z mirrored.
    #[must_use]
    pub fn flipped(&self) -> Self {
        Self { pieces: self.pieces.iter().map(ChainPiece::flipped).collect() }
    }

    /// Returns the path of the ball's centre for this path of its tip (the south pole).
    #[must_use]
    pub fn tip_to_centre(&self, radius_mm: f64) -> Self {
        self.shifted(0.0, radius_mm)
    }

    /// Returns the path of the ball's tip for this path of its centre.
    #[must_use]
    pub fn centre_to_tip(&self, radius_mm: f64) -> Self {
        self.shifted(0.0, -radius_mm)
    }
}

/// Checks the numbers of one piece.
fn check_piece(index: usize, piece: &ChainPiece) -> Result<(), ChainError> {
    let fine = |number: f64| number.abs() <= LARGEST;
    match piece {
        ChainPiece::Line(line) => {
            if ![line.from.u, line.from.z, line.to.u, line.to.z].into_iter().all(fine) {
                return Err(ChainError::Number { piece: index });
            }
        }
        ChainPiece::Arc(arc) => {
            if ![arc.centre.u, arc.centre.z, arc.radius_mm, arc.start_rad, arc.sweep_rad]
                .into_iter()
                .all(fine)
            {
                return Err(ChainError::Number { piece: index });
            }
            // The computed sweep of a full turn may be slightly more than one turn.
            if arc.radius_mm <= 0.0 || arc.sweep_rad.abs() > TAU + 1e-9 {
                return Err(ChainError::Arc { piece: index });
            }
        }
    }
    Ok(())
}
