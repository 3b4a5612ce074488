//! Curves that become chains.

use clsmith::internals::surface::profile::{
    Chain, EllipseArc, NurbsCurve, NurbsError, ParametricCurve, Point, ProfilePlane, check_tip_path,
    compensate_profile, to_arcs, to_chords,
};
use clsmith::program::geometry::Spline;
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// The largest distance of an ellipse from its chord between two parameters, by samples.
fn bulge(curve: &impl ParametricCurve, from: f64, to: f64) -> f64 {
    let (a, b) = (curve.point_at(from), curve.point_at(to));
    let length = a.distance(b);
    (1..64)
        .map(|index| curve.point_at(from + (to - from) * f64::from(index) / 64.0))
        .map(|point| ((b.u - a.u) * (point.z - a.z) - (b.z - a.z) * (point.u - a.u)).abs() / length)
        .fold(0.0, f64::max)
}

/// Greedy longest chords of a curve by bisection, from scratch.
fn greedy(curve: &impl ParametricCurve, tolerance: f64) -> usize {
    let (mut at, mut count) = (0.0, 0);
    while at < 1.0 {
        let (mut low, mut high) = (at, (at + 0.25_f64).min(1.0));
        if bulge(curve, at, high) > tolerance {
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if bulge(curve, at, middle) > tolerance {
                    high = middle;
                } else {
                    low = middle;
                }
            }
        } else {
            low = high;
        }
        at = low;
        count += 1;
    }
    count
}

/// The largest distance of a curve's samples from a chain that was made of it.
fn off(curve: &impl ParametricCurve, chain: &Chain) -> f64 {
    let parameters = curve.knots();
    let (first, last) = (parameters[0], *parameters.last().unwrap());
    let count = 1000;
    let mut worst = 0.0_f64;
    for index in 0..=count {
        let point = curve.point_at(first + (last - first) * f64::from(index) / f64::from(count));
        let distance = chain
            .pieces()
            .iter()
            .filter(|piece| piece.start().distance(point) <= piece.length_mm() + 0.1)
            .map(|piece| {
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..40 {
                    let (a, b) = (low + (high - low) * 0.382, low + (high - low) * 0.618);
                    if piece.point_at(a).distance(point) < piece.point_at(b).distance(point) {
                        high = b
                    } else {
                        low = a
                    }
                }
                piece.point_at(low).distance(point)
            })
            .fold(f64::INFINITY, f64::min);
        worst = worst.max(distance);
    }
    worst
}

fn dome(a: f64, b: f64, tilt: f64) -> EllipseArc {
    EllipseArc { centre: Point::new(1.0, 2.0), a, b, tilt_rad: tilt, start_rad: PI, sweep_rad: -PI }
}

#[test]
fn an_ellipse_takes_nearly_as_few_chords_as_possible() {
    for (ellipse, tolerance) in
        [(dome(40.0, 20.0, 0.0), 0.01), (dome(40.0, 4.0, 0.3), 0.002), (dome(10.0, 30.0, 0.0), 0.05)]
    {
        let chain = to_chords(&ellipse, tolerance).unwrap();
        let (count, optimum) = (chain.pieces().len(), greedy(&ellipse, tolerance));
        println!("ellipse {}x{} within {tolerance}: {count} chords, optimum {optimum}", ellipse.a, ellipse.b);
        assert!(count as f64 <= (optimum as f64 * 1.15).ceil(), "{count} {optimum}");
        assert!(off(&ellipse, &chain) <= tolerance * (1.0 + 1e-6));
        assert!(
            chain.start().distance(ellipse.point_at(0.0)) < 1e-12
                && chain.end().distance(ellipse.point_at(1.0)) < 1e-12
        );
        let arcs = to_arcs(&ellipse, tolerance).unwrap();
        println!("  {} with arcs", arcs.pieces().len());
        assert!(arcs.pieces().len() * 2 < count);
        assert!(off(&ellipse, &arcs) <= tolerance * (1.0 + 1e-6));
    }
}

#[test]
fn the_tip_path_of_a_semi_ellipse_keeps_the_papers_equations() {
    let (a, b, radius, tolerance) = (40.0, 20.0, 5.0, 1e-4);
    let profile = to_chords(&EllipseArc { centre: Point::default(), ..dome(a, b, 0.0) }, tolerance).unwrap();
    let path = compensate_profile(&profile, radius).unwrap();
    for index in 1..200 {
        let (sin, cos) = (PI * f64::from(index) / 200.0).sin_cos();
        let slope = (-b * cos / (a * sin)).atan();
        let contact = Point::new(a * cos, b * sin);
        let expected = Point::new(contact.u - radius * slope.sin(), contact.z - radius * (1.0 - slope.cos()));
        let nearest = path
            .pieces()
            .iter()
            .flat_map(|piece| (0..=10).map(|share| piece.point_at(f64::from(share) / 10.0)))
            .map(|point| {
                (
                    (point.u - expected.u) * -slope.sin() + (point.z - expected.z) * slope.cos(),
                    point.distance(expected),
                )
            })
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        assert!(nearest.0.abs() < 2.0 * tolerance, "{nearest:?} at {expected:?}");
    }
    assert!((path.start().u + a + radius).abs() < 0.05);
    let verdict = check_tip_path(&profile, &path, radius, 0.002);
    assert!(verdict.gouge_mm <= verdict.bound_mm && verdict.gap_mm <= verdict.bound_mm, "{verdict:?}");
}

#[test]
fn a_rational_quadratic_is_a_circle() {
    let half = 0.5_f64.sqrt();
    let controls = [[10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [-10.0, 10.0], [-10.0, 0.0]];
    let controls: Vec<Point> = controls.iter().map(|[u, z]| Point::new(*u, *z)).collect();
    let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0];
    let curve = NurbsCurve::new(2, &controls, &[1.0, half, 1.0, half, 1.0], knots).unwrap();
    for index in 0..=100 {
        let point = curve.point_at(f64::from(index) / 50.0);
        assert!((point.distance(Point::default()) - 10.0).abs() < 1e-12);
    }
    let chain = to_chords(&curve, 0.01).unwrap();
    let optimum = (PI / (2.0 * (1.0 - 0.01_f64 / 10.0).acos())).ceil() as usize;
    assert!(chain.pieces().len() <= optimum + 3, "{} {optimum}", chain.pieces().len());
    assert!(off(&curve, &chain) < 0.01 * (1.0 + 1e-6));
    assert_eq!(to_arcs(&curve, 0.01).unwrap().pieces().len(), 1);
}

#[test]
fn a_programs_spline_is_seen_in_its_plane() {
    let direction = Vector3::new(3.0, 4.0, 0.0);
    let plane = ProfilePlane::new(Point3::new(1.0, 2.0, 3.0), direction, Vector3::z()).unwrap();
    let flats = [[0.0, 0.0], [5.0, 8.0], [12.0, -4.0], [20.0, 6.0], [28.0, 0.0], [35.0, 2.0]];
    let space: Vec<Point3<f64>> = flats.iter().map(|[u, z]| plane.to_space(Point::new(*u, *z))).collect();
    assert!(space.iter().all(|point| plane.signed_distance_mm(*point).abs() < 1e-12));
    assert!((plane.signed_distance_mm(Point3::new(1.0 - 4.0, 2.0 + 3.0, 3.0)) - 5.0).abs() < 1e-12);
    let spline = Spline::from_knots(space[0], &[0.3, 0.6, 1.0], &space[1..]).unwrap();
    let curve = NurbsCurve::from_spline(&spline, &plane).unwrap();
    for index in 0..=50 {
        let share = f64::from(index) / 50.0;
        assert!(curve.point_at(share).distance(plane.to_plane(spline.point_at(share))) < 1e-12);
    }
    let chain = to_chords(&curve, 0.005).unwrap();
    assert!(off(&curve, &chain) < 0.005 * (1.0 + 1e-6));
    assert!(ProfilePlane::new(Point3::origin(), Vector3::z(), Vector3::z()).is_none());
}

#[test]
fn what_is_no_curve_is_refused() {
    let points = [Point::default(); 4];
    let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let new =
        |degree, weights: &[f64], knots: &[f64]| NurbsCurve::new(degree, &points, weights, knots.to_vec());
    assert!(new(3, &[1.0; 4], &knots).is_ok());
    assert_eq!(new(4, &[1.0; 4], &knots), Err(NurbsError::Controls { degree: 4, controls: 4 }));
    assert_eq!(new(3, &[1.0; 3], &knots), Err(NurbsError::Weights { controls: 4, weights: 3 }));
    assert_eq!(new(3, &[1.0, 1.0, 0.0, 1.0], &knots), Err(NurbsError::Weight(2)));
    assert_eq!(new(3, &[1.0; 4], &knots[1..]), Err(NurbsError::Knots(7)));
    assert_eq!(new(3, &[1.0; 4], &[0.0; 8]), Err(NurbsError::Order));
    assert_eq!(new(3, &[f64::NAN; 4], &knots), Err(NurbsError::Number));
}
