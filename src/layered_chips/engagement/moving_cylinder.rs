//! A moving cylinder and the moment at which it reaches a place.

use super::contact_samples::LayerSlab;
use crate::layered_chips::mill_step::FlatMill;
use crate::sim::PathPiece;
use nalgebra::Vector3;

/// Tips closer together than this (mm) stand still, as for the simulation.
const STILL: f64 = 1e-7;

/// Times at which a place is looked for at least and at most, and how far (as a share of the radius) the surface may go between two.
const LOOKS: [f64; 2] = [6.0, 256.0];
const BETWEEN: f64 = 0.1;

/// Steps of the search between two looks: false position needs some 5.
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
    /// The turn as a vector, radians.
    spin: Vector3<f64>,
    /// Way that shares relate to, mm.
    pace: f64,
    /// A place counts as reached when the surface is this close, mm.
    near: f64,
    looks: usize,
}

/// Which surface reaches a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CylinderFace {
    Flank,
    Bottom,
    Top,
}

/// A place when it is reached.
#[derive(Debug, Clone, Copy)]
pub(super) struct CylinderContact {
    pub face: CylinderFace,
    /// About the axis from the feed's direction, radians, left positive.
    pub angle: f64,
    /// From the axis, and up it from the tip, mm.
    pub rho: f64,
    pub height: f64,
    /// The surface's normal, outwards.
    pub normal: Vector3<f64>,
    /// Share of the feed with which the surface advances, and the largest that it has in any direction at this height.
    pub share: f64,
    pub most: f64,
    /// Cosine of the axis' angle to z, not negative.
    pub upright: f64,
}

impl MovingCylinder {
    pub fn new(mill: &FlatMill, piece: &PathPiece, length: f64, near: f64) -> Self {
        let (from, to) = (piece.from.axis.normalize(), piece.to.axis.normalize());
        let cross = from.cross(&to);
        let turn = cross.norm().atan2(from.dot(&to));
        let axis = cross.try_normalize(1e-12).unwrap_or_default();
        let turn = if axis == Vector3::zeros() { 0.0 } else { turn };
        let way = piece.to.point - piece.from.point;
        let lever = mill.radius.hypot(mill.flutes.min(1e3));
        let looks = ((way.norm() + turn * lever) / (BETWEEN * mill.radius)).ceil();
        Self {
            radius: mill.radius,
            flutes: mill.flutes,
            tip: piece.from.point.coords,
            way,
            from,
            across: axis.cross(&from),
            turn,
            spin: axis * turn,
            pace: length.max(1e-12),
            near,
            looks: looks.clamp(LOOKS[0], LOOKS[1]) as usize,
        }
    }

    pub fn radius_mm(&self) -> f64 {
        self.radius
    }

    /// What chords may hide, mm.
    pub fn chord_error_mm(&self) -> f64 {
        self.near
    }

    /// The turn as a share of the pace: by how much a share changes over a millimetre of lever.
    pub fn turn_per_mm(&self) -> f64 {
        self.turn / self.pace
    }

    fn tool_axis_at(&self, t: f64) -> Vector3<f64> {
        let (sin, cos) = (self.turn * t).sin_cos();
        self.from * cos + self.across * sin
    }

    /// Distance of a place from the axis, and its height above the tip, at a time.
    fn cylinder_coordinates(&self, place: &Vector3<f64>, t: f64) -> (Vector3<f64>, f64, f64) {
        let axis = self.tool_axis_at(t);
        let here = place - self.tip - self.way * t;
        let height = here.dot(&axis);
        let aside = here - axis * height;
        (aside, aside.norm(), height)
    }

    /// How far a place is outside at a time, and of which surface.
    fn gap_at(&self, place: &Vector3<f64>, t: f64) -> (f64, CylinderFace) {
        let (_, rho, height) = self.cylinder_coordinates(place, t);
        let gaps = [
            (rho - self.radius, CylinderFace::Flank),
            (-height, CylinderFace::Bottom),
            (height - self.flutes, CylinderFace::Top),
        ];
        gaps.into_iter().fold((f64::NEG_INFINITY, CylinderFace::Flank), |most, gap| {
            if gap.0 > most.0 { gap } else { most }
        })
    }

    /// How a place is reached first; `None` where nothing that advances reaches it.
    pub fn find_first_contact(&self, place: &Vector3<f64>) -> Option<CylinderContact> {
        let out = |t: f64| {
            let (gap, face) = self.gap_at(place, t);
            (gap - self.near, face)
        };
        let advances = |at: f64, face: CylinderFace| {
            Some(self.contact_at(place, at, face)).filter(|contact| contact.share > 0.0)
        };
        let (mut at, (mut before, mut face)) = (0.0, out(0.0));
        if before <= 0.0
            && let Some(contact) = advances(0.0, face)
        {
            return Some(contact);
        }
        for look in 1..=self.looks {
            let next = look as f64 / self.looks as f64;
            let (gap, near) = out(next);
            if before > 0.0 && gap <= 0.0 {
                let (at, face) = find_zero_crossing(out, (at, before, face), (next, gap));
                if let Some(contact) = advances(at, face) {
                    return Some(contact);
                }
            }
            (at, before, face) = (next, gap, near);
        }
        None
    }

    fn contact_at(&self, place: &Vector3<f64>, t: f64, face: CylinderFace) -> CylinderContact {
        let axis = self.tool_axis_at(t);
        let (aside, rho, height) = self.cylinder_coordinates(place, t);
        let outward = aside.try_normalize(1e-9).unwrap_or_else(|| any_perpendicular(&axis));
        let normal = match face {
            CylinderFace::Flank => outward,
            CylinderFace::Bottom => -axis,
            CylinderFace::Top => axis,
        };
        let velocity = self.way + self.spin.cross(&(aside + axis * height));
        let level = velocity - axis * velocity.dot(&axis);
        let ahead = self.feed_direction_at(&axis);
        let share = velocity.dot(&normal) / self.pace;
        CylinderContact {
            face,
            angle: axis.cross(&ahead).dot(&outward).atan2(ahead.dot(&outward)),
            rho: rho.min(self.radius),
            height: height.clamp(0.0, self.flutes),
            normal,
            share,
            most: if face == CylinderFace::Flank { level.norm() / self.pace } else { share },
            upright: axis.z.abs(),
        }
    }

    /// The direction from which angles count, as the simulation has it.
    fn feed_direction_at(&self, axis: &Vector3<f64>) -> Vector3<f64> {
        let direction = if self.way.norm() > STILL { self.way.normalize() } else { self.spin.cross(axis) };
        let aside = direction - axis * direction.dot(axis);
        if aside.norm() > 1e-6 * direction.norm() { aside.normalize() } else { any_perpendicular(axis) }
    }

    /// Lengths along the meridian between which a slab meets the cutter's axis at the start.
    pub fn meridian_range_at_start(&self, slab: &LayerSlab) -> [f64; 2] {
        let upright = self.from.z.abs().max(1e-3);
        let height = (slab.z - self.tip.z).abs() / upright;
        let half = slab.thickness / 2.0 / upright;
        [height - half, height + half].map(|height| self.radius + height.clamp(0.0, self.flutes))
    }
}

/// Where a function falls through zero between two times, by false position (Illinois); with the face outside of it.
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

fn any_perpendicular(axis: &Vector3<f64>) -> Vector3<f64> {
    let along = if axis.x.abs() < 1.0 - 1e-6 { Vector3::x() } else { Vector3::y() };
    (along - axis * along.dot(axis)).normalize()
}
