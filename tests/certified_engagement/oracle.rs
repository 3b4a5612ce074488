//! Membership by other means than the library's: a cutter is a polygon of half-planes around its axis, a
//! sweep is searched by halving.

use clsmith::certified_engagement::*;
use nalgebra::{Rotation3, Unit, Vector3};

/// A cutter as half-planes n r + u z <= c, made from APT's numbers.
#[derive(Clone)]
pub struct Polygon {
    pub planes: Vec<[f64; 3]>,
    pub numbers: [f64; 5],
}

impl Polygon {
    pub fn new(diameter: f64, rc: f64, taper: f64, tip: f64, height: f64) -> Self {
        Self::with_tangents(diameter, rc, taper, tip, height, 96)
    }

    /// A polygon with so many tangents around its corner.
    pub fn with_tangents(diameter: f64, rc: f64, taper: f64, tip: f64, height: f64, count: u32) -> Self {
        let (radius, mut planes) = (diameter / 2.0, vec![[0.0, 1.0, height]]);
        // The flank goes through (radius, radius tan tip), the bottom through the tip.
        let corner = [radius, radius * tip.tan()];
        let flank = [taper.cos(), -taper.sin()];
        let bottom = [tip.sin(), -tip.cos()];
        let flank_at = flank[0] * corner[0] + flank[1] * corner[1];
        let ball = (radius - rc).abs() < 1e-9;
        // Both lines moved in by rc meet in the centre.
        let (a, b) = (flank_at - rc, -rc);
        let det = flank[0] * bottom[1] - flank[1] * bottom[0];
        let mut center = [(a * bottom[1] - flank[1] * b) / det, (flank[0] * b - a * bottom[0]) / det];
        if ball {
            center = [0.0, rc];
        }
        let mut push = |n: [f64; 2]| planes.push([n[0], n[1], n[0] * center[0] + n[1] * center[1] + rc]);
        push(flank);
        push(bottom);
        if rc > 0.0 {
            let (from, to) = (tip, std::f64::consts::FRAC_PI_2 - taper);
            for step in 0..=count {
                let k = from + (to - from) * f64::from(step) / f64::from(count);
                push([k.sin(), -k.cos()]);
            }
        }
        Self { planes, numbers: [diameter, rc, taper, tip, height] }
    }

    pub fn gap(&self, point: &Vector3<f64>, pose: &CutterPose) -> f64 {
        let offset = point - pose.tip;
        let z = offset.dot(&pose.axis);
        let r = (offset - pose.axis * z).norm();
        self.planes.iter().map(|[n, u, c]| n * r + u * z - c).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The numbers from which [`Polygon::surface`] makes about this point.
    pub fn locate(&self, point: &Vector3<f64>, pose: &CutterPose) -> (f64, f64) {
        let side = pose.axis.cross(&Vector3::new(0.3, 0.5, 0.81)).normalize();
        let offset = point - pose.tip;
        let phi = offset.dot(&pose.axis.cross(&side)).atan2(offset.dot(&side));
        let apart = |u: f64| (self.surface(u, phi, pose).0 - point).norm();
        let best =
            (0..2000).map(|step| f64::from(step) / 2000.0).min_by(|a, b| apart(*a).total_cmp(&apart(*b)));
        (best.unwrap(), phi)
    }

    /// A point of the surface and its normal in the pose, from a random number along the contour and an
    /// angle.
    pub fn surface(&self, u: f64, phi: f64, pose: &CutterPose) -> (Vector3<f64>, Vector3<f64>) {
        let [diameter, rc, taper, tip, height] = self.numbers;
        let radius = diameter / 2.0;
        let [mut e, mut f] = [0.0, rc];
        if (radius - rc).abs() > 1e-9 {
            let flank_at = taper.cos() * radius - taper.sin() * radius * tip.tan();
            let (a, b) = (flank_at - rc, -rc);
            let det = -taper.cos() * tip.cos() + taper.sin() * tip.sin();
            e = (-a * tip.cos() + taper.sin() * b) / det;
            f = (taper.cos() * b - a * tip.sin()) / det;
        }
        let top_k = std::f64::consts::FRAC_PI_2 - taper;
        let (r, z, k);
        if u < 0.25 {
            let along = (u * 4.0).sqrt() * (e + rc * tip.sin());
            (r, z, k) = (along, along * tip.tan(), tip);
        } else if u < 0.65 && rc > 0.0 {
            k = tip + (top_k - tip) * (u - 0.25) / 0.4;
            (r, z) = (e + rc * k.sin(), f - rc * k.cos());
        } else {
            let start = [e + rc * top_k.sin(), f - rc * top_k.cos()];
            let share = if rc > 0.0 { (u - 0.65) / 0.35 } else { (u - 0.25) / 0.75 };
            z = start[1] + (height - start[1]) * share * share;
            r = start[0] + (z - start[1]) * taper.tan();
            k = top_k;
        }
        let side = pose.axis.cross(&Vector3::new(0.3, 0.5, 0.81)).normalize();
        let other = pose.axis.cross(&side);
        let out = side * phi.cos() + other * phi.sin();
        (pose.tip + out * r + pose.axis * z, out * k.sin() - pose.axis * k.cos())
    }
}

/// The pose of a block at a share of its time.
pub fn pose_at(block: &BlockMotion, share: f64) -> CutterPose {
    let tip = match &block.arc {
        None => block.from.tip.lerp(&block.to.tip, share),
        Some(arc) => {
            let rise = (block.to.tip - block.from.tip).dot(&arc.normal) * share;
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(arc.normal), arc.angle * share);
            arc.center + turn * (block.from.tip - arc.center) + arc.normal * rise
        }
    };
    let (a, b) = (block.from.axis, block.to.axis);
    let angle = a.dot(&b).clamp(-1.0, 1.0).acos();
    let axis = if angle < 1e-7 {
        a
    } else {
        (a * ((1.0 - share) * angle).sin() + b * (share * angle).sin()) / angle.sin()
    };
    CutterPose { tip, axis: axis.normalize() }
}

/// The length that feeds refer to.
pub fn reference(block: &BlockMotion, polygon: &Polygon, radius: f64) -> f64 {
    let chord = block.to.tip - block.from.tip;
    let length = block.arc.as_ref().map_or(chord.norm(), |arc| {
        let offset = block.from.tip - arc.center;
        let radius = (offset - arc.normal * offset.dot(&arc.normal)).norm();
        (radius * arc.angle).hypot(chord.dot(&arc.normal))
    });
    if length > 1e-7 {
        return length;
    }
    block.from.axis.dot(&block.to.axis).clamp(-1.0, 1.0).acos() * radius.hypot(polygon.numbers[4])
}

/// Whether a point may have been removed by a part of a block. What is not decided counts as removed.
pub fn may_be_removed(point: &Vector3<f64>, block: &BlockMotion, polygon: &Polygon, to: f64) -> bool {
    is_removed(point, block, polygon, to, 2e-6, true)
}

/// Whether a point is more than a micrometre's thousandth inside a sweep.
pub fn is_surely_removed(point: &Vector3<f64>, block: &BlockMotion, polygon: &Polygon) -> bool {
    is_removed(point, block, polygon, 1.0, -1e-6, false)
}

fn is_removed(
    point: &Vector3<f64>,
    block: &BlockMotion,
    polygon: &Polygon,
    to: f64,
    enough: f64,
    undecided: bool,
) -> bool {
    let speed = {
        let turn = block.from.axis.dot(&block.to.axis).clamp(-1.0, 1.0).acos();
        let way = match &block.arc {
            None => (block.to.tip - block.from.tip).norm(),
            Some(arc) => {
                let way = (block.from.tip - arc.center).norm() * arc.angle.abs();
                way + (block.to.tip - block.from.tip).norm()
            }
        };
        way + turn * ((point - block.from.tip).norm() + way)
    };
    let mut stack = vec![(0.0, to)];
    while let Some((from, to)) = stack.pop() {
        let middle = (from + to) / 2.0;
        let gap = polygon.gap(point, &pose_at(block, middle));
        let reach = speed * (to - from) / 2.0;
        if gap > reach + enough {
            continue;
        }
        if gap <= enough {
            return true;
        }
        if reach < 1e-7 {
            if undecided {
                return true;
            }
            continue;
        }
        stack.push((from, middle));
        stack.push((middle, to));
    }
    false
}
