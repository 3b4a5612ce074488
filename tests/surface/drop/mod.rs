//! Cutters lowered onto meshes.

mod check;
mod contacts;
mod edges;
mod follow;
mod soups;

use super::solids::{Triangles, mesh};
use clsmith::internals::surface::drop_cutter::{DropCutter, DropCutterShape};

/// Ball, bull-nose and flat end of 10 mm.
fn cutters() -> [DropCutterShape; 3] {
    [5.0, 1.5, 0.0].map(|corner| DropCutterShape::new(10.0, corner).unwrap())
}

fn over(solid: &Triangles, cutter: DropCutterShape) -> DropCutter {
    DropCutter::new(&mesh(solid), cutter)
}

fn tip(drop: &DropCutter, x: f64, y: f64) -> f64 {
    drop.drop_at(x, y).unwrap().tip_z_mm
}

/// The largest value of a function that rises and then falls, between two places.
fn largest(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if value(a) < value(b) {
            low = a;
        } else {
            high = b;
        }
    }
    value(f64::midpoint(low, high)).max(value(low)).max(value(high))
}

/// The tip's height over one triangle by searching all of it: the height is concave, outside the cutter worse the farther.
fn searched(cutter: &DropCutterShape, [x, y]: [f64; 2], triangle: [[f64; 3]; 3]) -> f64 {
    let [a, b, c] = triangle;
    let mix = |p: [f64; 3], q: [f64; 3], t: f64| [0, 1, 2].map(|axis| p[axis] + (q[axis] - p[axis]) * t);
    largest(0.0, 1.0, |s| {
        let (from, to) = (mix(a, b, s), mix(a, c, s));
        largest(0.0, 1.0, |t| {
            let point = mix(from, to, t);
            let r = f64::hypot(point[0] - x, point[1] - y);
            if r > cutter.radius_mm() - 1e-6 {
                return -1e6 - r;
            }
            let across = (r - cutter.flat_radius_mm()).max(0.0);
            let corner = cutter.corner_radius_mm();
            point[2] - (corner - (corner * corner - across * across).max(0.0).sqrt())
        })
    })
}

/// The tip's height over a solid, by search.
fn searched_all(cutter: &DropCutterShape, place: [f64; 2], solid: &Triangles) -> Option<f64> {
    let best = solid.iter().map(|triangle| searched(cutter, place, *triangle)).fold(f64::MIN, f64::max);
    (best > -1e5).then_some(best)
}

#[test]
fn cutters_that_cannot_be_are_refused() {
    for (diameter, corner) in [
        (0.0, 0.0),
        (-1.0, 0.0),
        (f64::NAN, 0.0),
        (f64::INFINITY, 1.0),
        (10.0, 5.1),
        (10.0, -0.1),
        (10.0, f64::NAN),
    ] {
        assert!(DropCutterShape::new(diameter, corner).is_err(), "{diameter} {corner}");
    }
    let ball = DropCutterShape::ball(10.0).unwrap();
    assert_eq!([ball.radius_mm(), ball.corner_radius_mm(), ball.flat_radius_mm()], [5.0, 5.0, 0.0]);
    assert_eq!(DropCutterShape::flat(10.0).unwrap(), DropCutterShape::new(10.0, 0.0).unwrap());
}
