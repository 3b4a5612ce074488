//! A chain: pieces that hang together.

use super::chain_piece::{ChainPiece, Point};
use std::f64::consts::TAU;

/// The end of a piece and the start of the next are one point when no farther apart than this, mm.
pub const CONNECTED: f64 = 1e-6;

/// The largest coordinate and radius that is taken, mm: at ten kilometres a number still tells 2e-9 mm apart.
pub const LARGEST: f64 = 1e7;

/// Connected pieces from a start to an end. It may run towards +u or -u, stand upright in part, and overhang.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    pieces: Vec<ChainPiece>,
}

/// Why pieces make no chain.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ChainError {
    /// No piece, or of a polyline fewer than two points.
    #[error("the chain has no piece")]
    Empty,
    /// A number that is not finite or too large.
    #[error("piece {piece}: a number is not finite, or larger than {LARGEST:e} mm")]
    Number {
        /// Which piece, from 0.
        piece: usize,
    },
    /// A radius that is not positive, or more than one turn.
    #[error("piece {piece}: an arc needs a positive radius and at most one turn")]
    Arc {
        /// Which piece, from 0.
        piece: usize,
    },
    /// A piece does not start where the one before ends.
    #[error("piece {piece} starts {gap:.6} mm from the end of the piece before")]
    Gap {
        /// Which piece, from 0.
        piece: usize,
        /// How far apart, mm.
        gap: f64,
    },
}

impl Chain {
    /// The chain of `pieces`, mm.
    ///
    /// # Errors
    /// [`ChainError`] when there is no piece, a number is not finite or beyond [`LARGEST`], an arc is none, or two pieces lie
    /// farther apart than [`CONNECTED`]; it says which piece.
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

    /// The straight pieces through `points`, mm.
    ///
    /// # Errors
    /// [`ChainError`] when there are fewer than two points or a number is not finite or beyond [`LARGEST`].
    pub fn from_points(points: &[Point]) -> Result<Self, ChainError> {
        let pair = |pair: &[Point]| match pair {
            [from, to] => Some(ChainPiece::line(*from, *to)),
            _ => None,
        };
        Self::new(points.windows(2).filter_map(pair).collect())
    }

    /// A chain of pieces that are known to fit.
    pub(super) fn from_trusted(pieces: Vec<ChainPiece>) -> Self {
        Self { pieces }
    }

    /// Its pieces, at least one.
    pub fn pieces(&self) -> &[ChainPiece] {
        &self.pieces
    }

    /// Where it starts.
    pub fn start(&self) -> Point {
        self.pieces.first().map(ChainPiece::start).unwrap_or_default()
    }

    /// Where it ends.
    pub fn end(&self) -> Point {
        self.pieces.last().map(ChainPiece::end).unwrap_or_default()
    }

    /// Starts and ends of its pieces, in order: one more than there are pieces.
    pub fn vertices(&self) -> impl Iterator<Item = Point> + '_ {
        std::iter::once(self.start()).chain(self.pieces.iter().map(ChainPiece::end))
    }

    /// Its length, mm.
    pub fn length_mm(&self) -> f64 {
        self.pieces.iter().map(ChainPiece::length_mm).sum()
    }

    /// The same chain from its end to its start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { pieces: self.pieces.iter().rev().map(ChainPiece::reversed).collect() }
    }

    /// The same chain, moved, mm.
    #[must_use]
    pub fn shifted(&self, du: f64, dz: f64) -> Self {
        Self { pieces: self.pieces.iter().map(|piece| piece.shifted(du, dz)).collect() }
    }

    /// The same chain, z turned over.
    #[must_use]
    pub fn flipped(&self) -> Self {
        Self { pieces: self.pieces.iter().map(ChainPiece::flipped).collect() }
    }

    /// The path of the ball's centre, from that of its tip (its south pole).
    #[must_use]
    pub fn tip_to_centre(&self, radius: f64) -> Self {
        self.shifted(0.0, radius)
    }

    /// The path of the ball's tip, from that of its centre.
    #[must_use]
    pub fn centre_to_tip(&self, radius: f64) -> Self {
        self.shifted(0.0, -radius)
    }
}

fn check_piece(index: usize, piece: &ChainPiece) -> Result<(), ChainError> {
    let fine = |number: f64| number.abs() <= LARGEST;
    match piece {
        ChainPiece::Line(line) => {
            if ![line.from.u, line.from.z, line.to.u, line.to.z].into_iter().all(fine) {
                return Err(ChainError::Number { piece: index });
            }
        }
        ChainPiece::Arc(arc) => {
            if ![arc.centre.u, arc.centre.z, arc.radius, arc.start, arc.sweep].into_iter().all(fine) {
                return Err(ChainError::Number { piece: index });
            }
            // A full turn that was computed may be a rounding longer than one.
            if arc.radius <= 0.0 || arc.sweep.abs() > TAU + 1e-9 {
                return Err(ChainError::Arc { piece: index });
            }
        }
    }
    Ok(())
}
