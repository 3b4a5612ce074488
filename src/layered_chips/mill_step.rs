//! This module describes a flat end mill that moves between two poses, and its section with a layer.
//!
//! The mill is the cylinder `0 <= (p - tip).a <= flutes`, `|p - tip|^2 - ((p - tip).a)^2 <= R^2`. It meets a
//! layer z = const in an ellipse with the semi-axes R across the tilt and R / |a_z| along it. The ellipse is
//! cut off by the straight lines in which the planes of the bottom disc and of the upper end of the flutes
//! cross the layer (science.md, section 4).
//!
//! The layered model covers flat end mills whose axis is not nearly parallel to the layers. A piece of path
//! with any other mill or axis is left out and not approximated: its material stays, and a finding says so.

use crate::engagement::PathPiece;
use crate::program::geometry::Pose;
use nalgebra::Vector3;

/// A flat end mill; lengths are in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatMill {
    /// The radius.
    pub radius_mm: f64,
    /// The length of the flutes above the tip. It is infinite if it does not matter.
    pub flute_length_mm: f64,
}

/// The reason why a piece of path cannot be modelled.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MillStepError {
    /// The mill has no radius or no flutes, or its numbers are not finite.
    #[error("the tool has no diameter or no flutes")]
    NoCutter,
    /// Both poses are the same.
    #[error("the piece has no length and the axis does not turn")]
    Still,
    /// The axis is nearly parallel to the layers somewhere on the piece.
    #[error(
        "the axis is {tilt_deg:.1} degrees from upright; beyond {most:.0} degrees a layer's section is no ellipse of use",
        most = MOST_TILT_DEG
    )]
    Tilt {
        /// The larger of the angles between axis and vertical at the two poses, degrees.
        tilt_deg: f64,
    },
    /// The tool points upwards at one pose and downwards at the other.
    #[error("the axis turns through the plane of the layers")]
    Overturns,
    /// A coordinate is not finite or too large.
    #[error("a coordinate is not finite, or farther than 100 m away")]
    NotFinite,
}

/// The largest angle between axis and vertical, degrees. A section is then nearly six times as long as the
/// cutter is wide. If two axes are within this angle, all axes between them are too, since a cap smaller than
/// a hemisphere contains the great circles between its points.
pub(crate) const MOST_TILT_DEG: f64 = 80.0;

/// The largest coordinate, mm.
const FARTHEST: f64 = 1e5;

/// Two poses whose tips are closer than this (mm) and whose axes are closer than this (radians) are the same.
const STILL: f64 = 1e-12;

/// A mill that moves from one pose to another: the tip moves straight, and the axis turns evenly in the plane
/// of both axes. A tool that hangs upside down is mirrored at z = 0 together with its layers, which does not
/// change the sections.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MillStep {
    pub(super) mill: FlatMill,
    /// The tip at the start and its displacement, mm.
    pub(super) tip: Vector3<f64>,
    pub(super) way: Vector3<f64>,
    /// The vectors of the turning axis: `axis(t) = from cos(turn t) + across sin(turn t)`.
    pub(super) from: Vector3<f64>,
    pub(super) across: Vector3<f64>,
    /// The angle of the turn, radians.
    pub(super) turn: f64,
    /// The tip (mm) and axis at the end as they were given. They are equal to the bit to those with which a
    /// following step begins.
    pub(super) end: [Vector3<f64>; 2],
    /// The factor of z: -1 for a mirrored step, else 1.
    pub(super) up: f64,
}

impl MillStep {
    /// Makes the step of a mill along a piece of path.
    ///
    /// # Errors
    /// Returns a [`MillStepError`] if the mill or the poses cannot be modelled.
    pub fn new(mill: FlatMill, piece: &PathPiece) -> Result<Self, MillStepError> {
        if !(mill.radius_mm > 0.0 && mill.radius_mm < FARTHEST && mill.flute_length_mm > 0.0) {
            return Err(MillStepError::NoCutter);
        }
        let finite = |place: &Pose| {
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
        // A turn that is only rounding becomes zero, so that a section keeps its shape to the last bit.
        let turn = if turn < 1e-10 { 0.0 } else { turn };
        // Gram-Schmidt: the part of the last axis across the first one gives the direction of the turn.
        // It is only used by steps that turn, so a step without a turn may leave it zero.
        let across = (to - from * from.dot(&to)).try_normalize(0.0).filter(|_| turn > 0.0);
        let tip = upright(piece.from.point.coords);
        let end = [upright(piece.to.point.coords), to];
        Ok(Self { mill, tip, way, from, across: across.unwrap_or_default(), turn, end, up })
    }

    /// Returns the mill.
    pub fn mill(&self) -> FlatMill {
        self.mill
    }

    /// Returns the length of the tip's path, mm.
    pub fn length_mm(&self) -> f64 {
        self.way.norm()
    }

    /// Returns the least and the greatest height that the cutter may reach, mm. Layers outside are not
    /// touched.
    pub fn height_range_mm(&self) -> [f64; 2] {
        let (a, b) = (self.tip.z, self.tip.z + self.way.z);
        // The bottom disc hangs below the tip by at most R sin(tilt), and the upper end rises likewise.
        let [low, high] =
            [a.min(b) - self.mill.radius_mm, a.max(b) + self.mill.radius_mm + self.mill.flute_length_mm];
        if self.up < 0.0 { [-high, -low] } else { [low, high] }
    }

    /// Returns an upper bound of the displacement of any point of the section at height z, mm for the whole
    /// step.
    pub(super) fn max_displacement_mm(&self, z: f64) -> f64 {
        let lever = (self.up * z - self.tip.z).abs().max((self.up * z - self.tip.z - self.way.z).abs());
        self.way.norm() + self.turn * (self.mill.radius_mm + lever)
    }
}
