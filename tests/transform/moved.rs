//! Whether a program is another one moved: the one property that every move must have, whatever the dialect.

use clsmith::program::Program;
use clsmith::program::geometry::MotionPath;
use clsmith::program::motion::Motion;
use nalgebra::{Matrix3, Point3, Unit, Vector3};

/// A transform as the tests compute it, by other formulas than the library.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub linear: Matrix3<f64>,
    pub offset: Vector3<f64>,
}

impl Place {
    pub fn identity() -> Self {
        Self { linear: Matrix3::identity(), offset: Vector3::zeros() }
    }

    pub fn translated(self, by: [f64; 3]) -> Self {
        Self { offset: self.offset + Vector3::from(by), ..self }
    }

    pub fn rotated(self, axis: [f64; 3], degrees: f64, about: [f64; 3]) -> Self {
        let axis = Unit::new_normalize(Vector3::from(axis));
        let turn = nalgebra::UnitQuaternion::from_axis_angle(&axis, degrees.to_radians());
        let turn = turn.to_rotation_matrix().into_inner();
        let about = Vector3::from(about);
        Self { linear: turn * self.linear, offset: turn * (self.offset - about) + about }
    }

    pub fn mirrored(self, normal: [f64; 3], through: [f64; 3]) -> Self {
        let normal = Vector3::from(normal).normalize();
        let through = Vector3::from(through);
        let flip = |v: Vector3<f64>| v - normal * (2.0 * normal.dot(&v));
        let columns: Vec<_> = (0..3).map(|column| flip(self.linear.column(column).into_owned())).collect();
        Self { linear: Matrix3::from_columns(&columns), offset: flip(self.offset - through) + through }
    }

    pub fn point(&self, point: Point3<f64>) -> Point3<f64> {
        Point3::from(self.linear * point.coords + self.offset)
    }
}

/// Every motion of `after` is the motion of `before` moved: poses, and points all along arcs and splines.
pub fn assert_moved(name: &str, before: &Program, after: &Program, place: &Place, tolerance: f64) {
    let (old, new): (Vec<Motion>, Vec<Motion>) = (before.motions().collect(), after.motions().collect());
    assert_eq!(old.len(), new.len(), "{name}: number of motions");
    let mut last: Option<Point3<f64>> = None;
    for (old, new) in old.iter().zip(&new) {
        let statement = before.statement(old.last_statement());
        let place_of = || {
            let (line, _) = before.source().line_column(statement.origin().start);
            format!("{name}:{line} {}", String::from_utf8_lossy(before.statement_text(statement)).trim())
        };
        let near = |a: Point3<f64>, b: Point3<f64>| {
            assert!((a - b).norm() <= tolerance, "{}: {a} is not {b}", place_of());
        };
        near(place.point(old.to.point), new.to.point);
        // Where another frame comes into force the tool stands where it stood, seen from there: no point of the path moved.
        let continues = last.is_none_or(|last| last == old.from.point);
        if continues {
            near(place.point(old.from.point), new.from.point);
            assert_eq!(old.class, new.class, "{}", place_of());
        }
        last = Some(old.to.point);
        let axis = place.linear * old.to.axis - new.to.axis;
        assert!(axis.norm() <= 2e-6, "{}: axis {} from {}", place_of(), new.to.axis, old.to.axis);
        assert_eq!((old.rapid, old.operation), (new.rapid, new.operation));
        assert_eq!(old.feed.map(|feed| feed.value), new.feed.map(|feed| feed.value), "{}", place_of());
        if let (Some(normal), Some(new)) = (old.normal, new.normal) {
            assert!((place.linear * normal - new).norm() <= 2e-6, "{}", place_of());
        }
        for share in 0..=12 {
            let share = f64::from(share) / 12.0;
            match (&old.path, &new.path) {
                (MotionPath::Arc(old), MotionPath::Arc(new)) => {
                    // Where an arc ends depends on its rounded points by its angle: a share of its radius.
                    let slack = tolerance * 3.0;
                    let (a, b) = (place.point(old.point_at(share)), new.point_at(share));
                    assert!((a - b).norm() <= slack, "{}: arc at {share}: {a} is not {b}", place_of());
                }
                (MotionPath::Spline(old), MotionPath::Spline(new)) => {
                    near(place.point(old.point_at(share)), new.point_at(share))
                }
                (MotionPath::Line, MotionPath::Line) | (MotionPath::Start, MotionPath::Start) => {}
                other => panic!("{}: {other:?}", place_of()),
            }
        }
    }
}
