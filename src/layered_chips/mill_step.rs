//! A flat end mill between two places, and its section with a layer.
//!
//! The mill is the cylinder `0 <= (p - tip).a <= flutes`, `|p - tip|^2 - ((p - tip).a)^2 <= R^2`. With a layer z = const it has an ellipse
//! in common, with semi-axes R across the tilt and R / |a_z| along it, cut off by the straight lines in which the planes of the bottom disc
//! and of the upper end of the flutes cross the layer (science.md, section 4).

use crate::sim::{PathPiece, ToolPose};
use nalgebra::Vector3;

/// A flat end mill. Lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatMill {
    /// Radius.
    pub radius: f64,
    /// Length of the flutes above the tip; infinite where it does not matter.
    pub flutes: f64,
}

/// Why a piece of path cannot be modelled.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MillStepError {
    /// No radius or no flutes, or numbers that are not finite.
    #[error("the tool has no diameter or no flutes")]
    NoCutter,
    /// Both places are the same.
    #[error("the piece has no length and the axis does not turn")]
    Still,
    /// The axis is, or becomes on the way, too nearly parallel to the layers.
    #[error(
        "the axis is {tilt_deg:.1} degrees from upright; beyond {most:.0} degrees a layer's section is no ellipse of use",
        most = MOST_TILT_DEG
    )]
    Tilt {
        /// Larger angle between axis and the vertical at the two places, degrees.
        tilt_deg: f64,
    },
    /// One place has the tool upright and the other upside down.
    #[error("the axis turns through the plane of the layers")]
    Overturns,
    /// A place that is no place.
    #[error("a coordinate is not finite, or farther than 100 m away")]
    NotFinite,
}

/// Largest angle between axis and the vertical, degrees: a section is then nearly six times as long as the cutter is wide. Two axes
/// within it have all axes between them within it as well, since a cap smaller than a hemisphere holds its great circles.
pub const MOST_TILT_DEG: f64 = 80.0;

/// Farthest coordinate, mm.
const FARTHEST: f64 = 1e5;

/// Two places closer than this (mm), with axes closer than this (radians), are one.
const STILL: f64 = 1e-12;

/// A mill on its way from one place to another: the tip goes straight, the axis turns evenly in the plane of both axes. A tool that
/// hangs upside down is mirrored at z = 0, together with its layers; sections stay what they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MillStep {
    pub(super) mill: FlatMill,
    /// Tip at the beginning, and its way, mm.
    pub(super) tip: Vector3<f64>,
    pub(super) way: Vector3<f64>,
    /// `axis(t) = from cos(turn t) + across sin(turn t)`.
    pub(super) from: Vector3<f64>,
    pub(super) across: Vector3<f64>,
    /// Radians.
    pub(super) turn: f64,
    /// Tip (mm) and axis at the end as they were given: to the bit what a step that goes on from there begins with.
    pub(super) end: [Vector3<f64>; 2],
    /// -1 for a mirrored step.
    pub(super) up: f64,
}

impl MillStep {
    /// A mill along a piece of path.
    ///
    /// # Errors
    /// See [`MillStepError`].
    pub fn new(mill: FlatMill, piece: &PathPiece) -> Result<Self, MillStepError> {
        if !(mill.radius > 0.0 && mill.radius < FARTHEST && mill.flutes > 0.0) {
            return Err(MillStepError::NoCutter);
        }
        let finite = |place: &ToolPose| {
            place.point.iter().all(|x| x.abs() <= FARTHEST) && (place.axis.norm() - 1.0).abs() < 1e-6
        };
        if !finite(&piece.from) || !finite(&piece.to) {
            return Err(MillStepError::NotFinite);
        }
        let up = if piece.from.axis.z < 0.0 { -1.0 } else { 1.0 };
        let upright = |v: Vector3<f64>| Vector3::new(v.x, v.y, v.z * up);
        let (from, to) = (upright(piece.from.axis.normalize()), upright(piece.to.axis.normalize()));
        let lowest = from.z.min(to.z);
        if lowest < -MOST_TILT_DEG.to_radians().cos() {
            return Err(MillStepError::Overturns);
        }
        if lowest < MOST_TILT_DEG.to_radians().cos() {
            return Err(MillStepError::Tilt { tilt_deg: lowest.clamp(-1.0, 1.0).acos().to_degrees() });
        }
        let way = upright(piece.to.point - piece.from.point);
        let turn = from.cross(&to).norm().atan2(from.dot(&to));
        if way.norm() < STILL && turn < STILL {
            return Err(MillStepError::Still);
        }
        // Within rounding of no turn at all: the same axis, so that a section keeps its shape to the last bit.
        let turn = if turn < 1e-10 { 0.0 } else { turn };
        let across = (to - from * from.dot(&to)).try_normalize(0.0).filter(|_| turn > 0.0);
        let tip = upright(piece.from.point.coords);
        let end = [upright(piece.to.point.coords), to];
        Ok(Self { mill, tip, way, from, across: across.unwrap_or_default(), turn, end, up })
    }

    /// The mill.
    pub fn mill(&self) -> FlatMill {
        self.mill
    }

    /// Length of the tip's way, mm.
    pub fn length_mm(&self) -> f64 {
        self.way.norm()
    }

    /// Least and greatest height that the cutter may reach, mm; no layer outside is touched.
    pub fn height_range_mm(&self) -> [f64; 2] {
        let (a, b) = (self.tip.z, self.tip.z + self.way.z);
        // The bottom disc hangs down by no more than R sin(tilt), the upper end rises likewise.
        let [low, high] = [a.min(b) - self.mill.radius, a.max(b) + self.mill.radius + self.mill.flutes];
        if self.up < 0.0 { [-high, -low] } else { [low, high] }
    }

    /// A bound on how fast any point of the section at height z moves, mm for the whole step.
    pub(super) fn max_displacement_mm(&self, z: f64) -> f64 {
        let lever = (self.up * z - self.tip.z).abs().max((self.up * z - self.tip.z - self.way.z).abs());
        self.way.norm() + self.turn * (self.mill.radius + lever)
    }
}
