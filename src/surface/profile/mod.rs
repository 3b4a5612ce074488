//! Profiles in a vertical plane, and the path of a ball over them.
//!
//! A profile lies in a plane with coordinates (u, z), mm: u horizontal along the pass, z up along the tool axis. Its points are
//! places where the cutter shall touch the part. What is programmed is the ball's tip, its south pole:
//! `tip = contact + R (n - z)` with n the upward normal (Dragoi 2009, eq. (1) and (2)). Point by point that gouges in concave
//! corners and leaves gaps at convex ones; [`compensate_profile`] therefore follows the exact envelope of the ball over the whole
//! profile, and [`recover_profile`] undoes it.
//!
//! From input to output: curves ([`EllipseArc`], [`NurbsCurve`]) become a [`Chain`] of lines and arcs, a chain is compensated, its tip
//! path becomes as few [`fit_chords`] as the tolerance allows, and [`check_tip_path`] looks at the result with other means.

mod arc_fit;
mod ball_compensation;
mod chain;
mod chain_piece;
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
