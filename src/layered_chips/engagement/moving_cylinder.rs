//! This module moves a cylinder along a piece of path and finds the time at which it reaches a point.

use super::layer_slab::LayerSlab;
use crate::engagement::PathPiece;
use crate::layered_chips::mill_step::FlatMill;
use nalgebra::Vector3;

/// Tips that are closer together than this (mm) count as standing still, as in the simulation.
const STILL: f64 = 1e-7;

/// The least and the most times at which a point is tested, and the distance that the surface may move
/// between two of them, as a fraction of the radius.
const LOOKS: [f64; 2] = [6.0, 256.0];
const BETWEEN: f64 = 0.1;

/// The most steps of the search between two tested times. False position needs about 5.
const STEPS: usize = 30;

/// A mill along a piece of path, in the workpiece frame.
#[derive(Debug, Clone)]
pub(super) struct MovingCylinder {
    radius: f64,
    flutes: f64,
    tip: Vector3<f64>,
    way: Vector3<f64>,
    from: Vector3<f64>,
    across: Vector3<f64>,
    turn: f64,
    /// The turn of the axis as a rotation vector, radians.
    spin: Vector3<f64>,
    /// The length of path that advance ratios refer to, mm.
    pace: f64,
    /// A point counts as reached if the surface is this close, mm.
    near: f64,
    /// The poses in which every point is tested, from the first to the last.
    looks: Vec<CylinderPose>,
}

/// The cylinder at a time of the piece, from 0 to 1.
#[derive(Debug, Clone, Copy)]
struct CylinderPose {
    time: f64,
    axis: Vector3<f64>,
    /// How far the tip has moved.
    moved: Vector3<f64>,
}

/// The surface of the cylinder that reaches a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CylinderFace {
    Flank,
    Bottom,
    Top,
}

/// How a point of the surface moves.
#[derive(Debug, Clone, Copy)]
struct SurfaceAdvance {
    /// The advance ratio along the outward unit normal, and in the direction in which the point moves.
    ratio: f64,
    speed: f64,
    normal: Vector3<f64>,
}

/// The contact at the time when a point is reached.
#[derive(Debug, Clone, Copy)]
pub(super) struct CylinderContact {
    pub face: CylinderFace,
    /// The angle around the axis from the feed's direction, radians, positive to the left.
    pub angle: f64,
    /// The distance from the axis, and the height above the tip along it, mm.
    pub rho: f64,
    pub height: f64,
    /// The outward unit normal of the surface.
    pub normal: Vector3<f64>,
    /// The advance ratio of the surface, and the largest one in any direction at this height.
    pub advance_ratio: f64,
    pub most: f64,
    /// The cosine of the angle between the axis and z, not negative.
    pub upright: f64,
}

impl MovingCylinder {
    pub(super) fn new(mill: &FlatMill, piece: &PathPiece, length: f64, near: f64) -> Self {
        let (from, to) = (piece.from.axis.normalize(), piece.to.axis.normalize());
        let cross = from.cross(&to);
        let turn = cross.norm().atan2(from.dot(&to));
        let axis = cross.try_normalize(1e-12).unwrap_or_default();
        let turn = if axis == Vector3::zeros() { 0.0 } else { turn };
        let way = piece.to.point - piece.from.point;
        let lever = mill.radius_mm.hypot(mill.flute_length_mm.min(1e3));
        let looks = ((way.norm() + turn * lever) / (BETWEEN * mill.radius_mm)).ceil();
        let looks = looks.clamp(LOOKS[0], LOOKS[1]) as usize;
        let mut motion = Self {
            radius: mill.radius_mm,
            flutes: mill.flute_length_mm,
            tip: piece.from.point.coords,
            way,
            from,
            across: axis.cross(&from),
            turn,
            spin: axis * turn,
            pace: length.max(1e-12),
            near,
            looks: Vec::new(),
        };
        // Hundreds of points are tested at the same times.
        motion.looks = (0..=looks).map(|look| motion.pose_at(look as f64 / looks as f64)).collect();
        motion
    }

    pub(super) fn radius_mm(&self) -> f64 {
        self.radius
    }

    /// Returns the distance that chords may hide, mm.
    pub(super) fn chord_error_mm(&self) -> f64 {
        self.near
    }

    /// Returns by how much an advance ratio changes per mm of distance from the tip, because the axis turns.
    pub(super) fn turn_per_mm(&self) -> f64 {
        self.turn / self.pace
    }

    /// Returns the cylinder at a time of the piece, from 0 to 1.
    fn pose_at(&self, time: f64) -> CylinderPose {
        let axis = match self.turn * time {
            0.0 => self.from,
            turned => self.from * turned.cos() + self.across * turned.sin(),
        };
        CylinderPose { time, axis, moved: self.way * time }
    }

    /// Returns the vector from the axis to a point, its length, and the height of the point above the tip.
    fn cylinder_coordinates(&self, place: &Vector3<f64>, pose: &CylinderPose) -> (Vector3<f64>, f64, f64) {
        let here = place - self.tip - pose.moved;
        let height = here.dot(&pose.axis);
        let aside = here - pose.axis * height;
        (aside, aside.norm(), height)
    }

    /// Returns the distance of a point outside the cylinder, and the surface from which it counts.
    fn gap_at(&self, place: &Vector3<f64>, pose: &CylinderPose) -> (f64, CylinderFace) {
        let (_, rho, height) = self.cylinder_coordinates(place, pose);
        let gaps = [
            (rho - self.radius, CylinderFace::Flank),
            (-height, CylinderFace::Bottom),
            (height - self.flutes, CylinderFace::Top),
        ];
        gaps.into_iter().fold((f64::NEG_INFINITY, CylinderFace::Flank), |most, gap| {
            if gap.0 > most.0 { gap } else { most }
        })
    }

    /// Returns the first contact with a point, or `None` if no advancing surface reaches it.
    pub(super) fn find_first_contact(&self, place: &Vector3<f64>) -> Option<CylinderContact> {
        let out = |pose: &CylinderPose| {
            let (gap, face) = self.gap_at(place, pose);
            (gap - self.near, face)
        };
        let advances = |at: &CylinderPose, face: CylinderFace| {
            Some(self.contact_at(place, at, face)).filter(|contact| contact.advance_ratio > 0.0)
        };
        let [first, later @ ..] = self.looks.as_slice() else { return None };
        let (mut at, (mut before, mut face)) = (first.time, out(first));
        if before <= 0.0
            && let Some(contact) = advances(first, face)
        {
            return Some(contact);
        }
        for next in later {
            let (gap, near) = out(next);
            if before > 0.0 && gap <= 0.0 {
                let moving = |time: f64| out(&self.pose_at(time));
                let (at, face) = find_zero_crossing(moving, (at, before, face), (next.time, gap));
                if let Some(contact) = advances(&self.pose_at(at), face) {
                    return Some(contact);
                }
            }
            (at, before, face) = (next.time, gap, near);
        }
        None
    }

    /// Returns a number that the advance ratio of the first contact with a point does not exceed, without the search for
    /// its time: `None` where no advancing surface reaches the point, infinite where only the search can tell.
    ///
    /// Between the two tested poses around the contact the surface moves by a tenth of the radius at most. The ratio is that
    /// of one of both poses, but for the square of the angle by which the normal turns between them.
    pub(super) fn bound_first_advance(&self, place: &Vector3<f64>) -> Option<f64> {
        let [first, later @ ..] = self.looks.as_slice() else { return None };
        let (mut at, (mut before, mut face)) = (first, self.gap_at(place, first));
        if before <= self.near {
            let ratio = self.advance_at(place, first, face).ratio;
            if ratio > 0.0 {
                return Some(ratio);
            }
        }
        for next in later {
            let (gap, near) = self.gap_at(place, next);
            if before > self.near && gap <= self.near {
                if face != near {
                    return Some(f64::INFINITY);
                }
                let [one, other] = [at, next].map(|pose| self.advance_at(place, pose, face));
                let turned = one.normal.cross(&other.normal).norm() + self.turn;
                let margin = 2.0 * turned * turned * one.speed.max(other.speed);
                let certain = one.ratio.min(other.ratio) > margin && one.normal.dot(&other.normal) > 0.5;
                return Some(if certain { one.ratio.max(other.ratio) + margin } else { f64::INFINITY });
            }
            (at, before, face) = (next, gap, near);
        }
        None
    }

    /// Returns how a surface of the cylinder advances at the height of a point.
    fn advance_at(&self, place: &Vector3<f64>, pose: &CylinderPose, face: CylinderFace) -> SurfaceAdvance {
        let (aside, _, height) = self.cylinder_coordinates(place, pose);
        let normal = match face {
            CylinderFace::Flank => aside.try_normalize(1e-9).unwrap_or_else(|| any_perpendicular(&pose.axis)),
            CylinderFace::Bottom => -pose.axis,
            CylinderFace::Top => pose.axis,
        };
        // The surface point moves with the tip and turns about it.
        let velocity = self.way + self.spin.cross(&(aside + pose.axis * height));
        SurfaceAdvance {
            ratio: velocity.dot(&normal) / self.pace,
            speed: velocity.norm() / self.pace,
            normal,
        }
    }

    /// Returns the contact of a point with a surface of the cylinder.
    fn contact_at(&self, place: &Vector3<f64>, pose: &CylinderPose, face: CylinderFace) -> CylinderContact {
        let axis = pose.axis;
        let (aside, rho, height) = self.cylinder_coordinates(place, pose);
        let outward = aside.try_normalize(1e-9).unwrap_or_else(|| any_perpendicular(&axis));
        let normal = match face {
            CylinderFace::Flank => outward,
            CylinderFace::Bottom => -axis,
            CylinderFace::Top => axis,
        };
        // The surface point moves with the tip and turns about it.
        let velocity = self.way + self.spin.cross(&(aside + axis * height));
        let level = velocity - axis * velocity.dot(&axis);
        let ahead = self.feed_direction_at(&axis);
        let advance_ratio = velocity.dot(&normal) / self.pace;
        CylinderContact {
            face,
            angle: axis.cross(&ahead).dot(&outward).atan2(ahead.dot(&outward)),
            rho: rho.min(self.radius),
            height: height.clamp(0.0, self.flutes),
            normal,
            advance_ratio,
            most: if face == CylinderFace::Flank { level.norm() / self.pace } else { advance_ratio },
            upright: axis.z.abs(),
        }
    }

    /// Returns the direction from which angles count, as in the simulation.
    fn feed_direction_at(&self, axis: &Vector3<f64>) -> Vector3<f64> {
        let direction = if self.way.norm() > STILL { self.way.normalize() } else { self.spin.cross(axis) };
        let aside = direction - axis * direction.dot(axis);
        if aside.norm() > 1e-6 * direction.norm() { aside.normalize() } else { any_perpendicular(axis) }
    }

    /// Returns the lengths along the meridian between which a layer meets the cutter's axis at the start.
    pub(super) fn meridian_range_at_start(&self, slab: &LayerSlab) -> [f64; 2] {
        let upright = self.from.z.abs().max(1e-3);
        let height = (slab.z - self.tip.z).abs() / upright;
        let half = slab.thickness / 2.0 / upright;
        [height - half, height + half].map(|height| self.radius + height.clamp(0.0, self.flutes))
    }
}

/// Finds by false position (Illinois variant) where a function falls through zero between two times. Also
/// returns the surface just before that time.
fn find_zero_crossing(
    out: impl Fn(f64) -> (f64, CylinderFace),
    (mut low, mut above, mut face): (f64, f64, CylinderFace),
    (mut high, mut below): (f64, f64),
) -> (f64, CylinderFace) {
    for _ in 0..STEPS {
        let at = low + (high - low) * above / (above - below);
        let (gap, near) = out(at);
        if gap > 0.0 {
            (low, above, face) = (at, gap, near);
            below *= 0.5;
        } else {
            (high, below) = (at, gap);
            above *= 0.5;
        }
        if gap.abs() < 1e-7 || high - low < 1e-9 {
            break;
        }
    }
    (high, face)
}

/// Returns a unit vector across an axis, as near to x as possible, or near to y for an axis along x.
fn any_perpendicular(axis: &Vector3<f64>) -> Vector3<f64> {
    let along = if axis.x.abs() < 1.0 - 1e-6 { Vector3::x() } else { Vector3::y() };
    (along - axis * along.dot(axis)).normalize()
}
