//! Profiles in a vertical plane, and the path of a ball over them.
//!
//! A profile lies in a plane with coordinates (u, z), mm: u horizontal along the pass, z up along the tool axis. Its points are
//! places where the cutter shall touch the part. What is programmed is the ball's tip, its south pole:
//! `tip = contact + R (n - z)` with n the upward normal (Dragoi 2009, eq. (1) and (2)). Point by point that gouges in concave
//! corners and leaves gaps at convex ones; [`compensate`] therefore follows the exact envelope of the ball over the whole
//! profile, and [`recover`] undoes it.
//!
//! From input to output: curves ([`Ellipse`], [`Nurbs`]) become a [`Chain`] of lines and arcs, a chain is compensated, its tip
//! path becomes as few [`chords`] as the tolerance allows, and [`check`] looks at the result with other means.

mod chain;
mod check;
mod chords;
mod compensate;
mod curve;
mod ellipse;
mod fit;
mod nurbs;
mod piece;
mod plane;
mod reach;
mod roll;
mod skyline;
mod stretch;
mod wedge;

pub use chain::{CONNECTED, Chain, ChainError, LARGEST};
pub use check::{Verdict, check};
pub use chords::{ChordError, Side, chords};
pub use compensate::{CompensateError, SMALLEST_BALL, compensate, recover};
pub use curve::{Curve, to_arcs, to_chords};
pub use ellipse::Ellipse;
pub use nurbs::{Nurbs, NurbsError};
pub use piece::{Arc, Line, Piece, Point};
pub use plane::Plane;
pub use reach::{Unreachable, unreachable};
