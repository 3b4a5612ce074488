//! This module holds profiles in a vertical plane and computes the path of a ball over them.
//!
//! A profile is in a plane with the coordinates (u, z) in mm: u is horizontal along the pass, z goes up along
//! the tool axis. Its points are the points at which the cutter must touch the part. The program moves the
//! ball's tip, its south pole: `tip = contact + R (n - z)` with n the upward normal (Dragoi 2009, eq. (1) and
//! (2)). Applied point by point, this gouges in concave corners and leaves gaps at convex ones. So
//! [`compensate_profile`] follows the exact envelope of the ball over the whole profile, and
//! [`recover_profile`] is its inverse.
//!
//! The path of a ball over a profile is an upper envelope and not an offset whose loops are cut out: it
//! consists of segments that are functions of u, of which the highest one counts everywhere. So loops, jumps
//! beside walls and overhangs need no special rules. The contact of an old ball is recovered by the same
//! computation with z mirrored.
//!
//! Curves ([`EllipseArc`], [`NurbsCurve`]) become a [`Chain`] of lines and arcs. The chain is compensated,
//! its tip path becomes as few [`fit_chords`] as the tolerance allows, and [`check_tip_path`] checks the
//! result by an independent method.

mod arc_fit;
mod ball_compensation;
mod chain;
mod chain_piece;
mod chord_vertex;
mod chords;
mod direction_wedge;
mod ellipse_arc;
mod graph_segment;
mod nurbs;
mod parametric_curve;
mod profile_plane;
mod rolling_ball;
mod tip_path_check;
mod unreachable_parts;
mod upper_envelope;

pub use ball_compensation::{BallCompensationError, SMALLEST_BALL, compensate_profile, recover_profile};
pub use chain::{CONNECTED, Chain, ChainError, LARGEST};
pub use chain_piece::{ArcPiece, ChainPiece, LinePiece, Point};
pub use chords::{ChordError, ChordSide, fit_chords};
pub use ellipse_arc::EllipseArc;
pub use nurbs::{NurbsCurve, NurbsError};
pub use parametric_curve::{ParametricCurve, to_arcs, to_chords};
pub use profile_plane::ProfilePlane;
pub use tip_path_check::{ProfileDeviation, check_tip_path};
pub use unreachable_parts::{UnreachablePart, find_unreachable_parts};
