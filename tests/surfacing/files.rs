//! Profile files: every kind of curve, and everything that can be wrong with one.

use super::options;
use crate::support;
use clsmith::diagnostic::codes;
use clsmith::internals::surface::profile::{Chain, ChainPiece, Point};
use clsmith::program::LengthUnit;
use clsmith::surface_milling::{
    SectionProfile, SurfaceMillingOptions, SurfacePart, load_profile, make_surface_program,
};

fn load(text: &str) -> SectionProfile {
    load_profile(&support::text(text)).unwrap_or_else(|found| panic!("{found:?}"))
}

fn chain(pieces: &str) -> Chain {
    load(&format!("start: [0, 0]\npieces:\n{pieces}")).to_chain(1e-4).unwrap()
}

/// Enough places of a chain.
fn places(chain: &Chain) -> Vec<Point> {
    chain.pieces().iter().flat_map(|piece| (0..=8).map(|i| piece.point_at(f64::from(i) / 8.0))).collect()
}

#[test]
fn lines_and_polylines_go_where_they_say() {
    let lines = chain("  - line: [10, 5]\n  - polyline: [[20, 5], [20, 0], [30, 0]]\n");
    let ends: Vec<(f64, f64)> = lines.vertices().map(|at| (at.u, at.z)).collect();
    assert_eq!(ends, [(0.0, 0.0), (10.0, 5.0), (20.0, 5.0), (20.0, 0.0), (30.0, 0.0)]);
}

#[test]
fn arcs_turn_as_they_say() {
    let cases = [
        ("{ to: [20, 0], radius: 10, turn: right }", (10.0, 10.0), 10.0),
        ("{ to: [20, 0], radius: 10, turn: left }", (10.0, -10.0), 10.0),
        ("{ to: [20, 0], radius: 12.5, turn: right }", (10.0, 5.0), 12.5),
        ("{ to: [20, 0], radius: 12.5, turn: right, long: true }", (10.0, 20.0), 12.5),
        ("{ to: [20, 0], radius: 12.5, turn: left }", (10.0, -5.0), 12.5),
        ("{ to: [20, 0], radius: 12.5, turn: left, long: true }", (10.0, -20.0), 12.5),
        ("{ to: [20, 0], centre: [10, -7.5], turn: right }", (10.0, 5.0), 12.5),
        ("{ to: [20, 0], centre: [10, -7.5], turn: left }", (10.0, -20.0), 12.5),
        // Written by hand, with three decimals.
        ("{ to: [20, 0], centre: [10.0007, -7.5], turn: right }", (10.0, 5.0), 12.5),
    ];
    for (text, (u, z), radius) in cases {
        let chain = chain(&format!("  - arc: {text}\n"));
        let [ChainPiece::Arc(arc)] = chain.pieces() else { panic!("{chain:?}") };
        let middle = chain.pieces()[0].point_at(0.5);
        assert!((middle.u - u).hypot(middle.z - z) < 1e-9, "{text}: {middle:?}");
        assert!((arc.radius_mm - radius).abs() < 1e-9, "{text}");
        assert!(chain.start().distance(Point::default()) < 1e-9, "{text}");
    }
}

#[test]
fn ellipses_and_nurbs_are_met_within_the_tolerance() {
    let half = chain("  - ellipse: { to: [40, 0], centre: [20, 0], semi_axes: [20, 8], turn: right }\n");
    for at in places(&half) {
        let off = (((at.u - 20.0) / 20.0).powi(2) + (at.z / 8.0).powi(2)).sqrt() - 1.0;
        assert!(off.abs() * 8.0 < 1e-3 && at.z > -1e-3, "{at:?}: {off}");
    }
    // The same ellipse, its first axis upright.
    let tilted =
        chain("  - ellipse: { to: [40, 0], centre: [20, 0], semi_axes: [8, 20], tilt: 90, turn: right }\n");
    let (one, other) = (half.length_mm(), tilted.length_mm());
    assert!((one - other).abs() < 1e-2, "{one} {other}");
    // A quarter of a circle of radius 10 as a rational curve of degree 2.
    let weight = 0.5f64.sqrt();
    let quarter = chain(&format!(
        "  - nurbs: {{ degree: 2, points: [[0, 10], [10, 10]], weights: [1, {weight}, 1], knots: [0, 0, 0, 1, 1, 1] }}\n"
    ));
    for at in places(&quarter) {
        let off = (at.u - 10.0).hypot(at.z) - 10.0;
        assert!(off.abs() < 2e-4, "{at:?}: {off}");
    }
    // Without knots and weights: a Bezier curve of degree 3, half of which is where the mean of its polygon says.
    let bezier = chain("  - nurbs: { points: [[10, 20], [30, 20], [40, 0]] }\n");
    let highest = places(&bezier).into_iter().map(|at| at.z).fold(0.0, f64::max);
    assert!((highest - 15.0).abs() < 5e-3, "{highest}");
}

#[test]
fn a_piece_starts_where_the_one_before_ends() {
    let profile = load(
        "units: inch\nwidth: 2\nstart: [0, 0]\npieces:\n  - line: [1, 0]\n  - arc: { to: [2, 1], radius: 1, turn: left }\n  \
         - ellipse: { to: [4, 1], centre: [3, 1.00002], semi_axes: [1, 0.5], turn: right }\n  \
         - nurbs: { points: [[4.5, 0], [5, 2], [6, 1]] }\n  - polyline: [[7, 1], [8, 0.5]]\n",
    );
    assert_eq!(profile.width_mm, Some(50.8));
    let chain = profile.to_chain(1e-3).unwrap();
    assert!((chain.end().u - 8.0 * 25.4).abs() < 1e-9);
    let mut options = SurfaceMillingOptions { step_mm: 10.0, ..options() };
    options.words.units = LengthUnit::Inch;
    let surfaced = make_surface_program(&SurfacePart::Profile(profile), &options).unwrap();
    assert!(surfaced.proof.is_within(options.tolerance_mm), "{:?}", surfaced.proof);
    assert_eq!(surfaced.planes, 7, "50.8 mm in steps of 10 mm and less");
    assert!(surfaced.draft.moves.iter().all(|step| step.to.x < 9.0), "in inches");
}

#[test]
fn few_chords_where_curvature_is_small() {
    // The tip's path over an ellipse of half axes 40 and 10, and a ball of 5: about the offset's length over 2 sqrt(2 rho tolerance).
    let text = "width: 1\nstart: [0, 0]\npieces: [ { ellipse: { to: [80, 0], centre: [40, 0], semi_axes: [40, 10], turn: right } } ]\n";
    let count = |tolerance: f64| {
        let options = SurfaceMillingOptions {
            tolerance_mm: tolerance,
            floor_mm: Some(-5.0),
            step_mm: 1.0,
            ..options()
        };
        make_surface_program(&SurfacePart::Profile(load(text)), &options).unwrap().cutting_motion_count() / 2
    };
    let ideal = |tolerance: f64| {
        let steps = 20_000;
        let place = |i: i32| std::f64::consts::PI * f64::from(i) / f64::from(steps);
        (0..steps)
            .map(|i| {
                let t = f64::midpoint(place(i), place(i + 1));
                let speed = (40.0 * t.sin()).hypot(10.0 * t.cos());
                let rho = speed.powi(3) / 400.0;
                // The centre's path is 5 farther out.
                let length = speed * (rho + 5.0) / rho * (place(i + 1) - place(i));
                length / (2.0 * (2.0 * (rho + 5.0) * tolerance).sqrt())
            })
            .sum::<f64>()
    };
    for tolerance in [0.1, 0.01, 0.005] {
        let (count, ideal) = (count(tolerance) as f64, ideal(tolerance));
        assert!((1.0..1.3).contains(&(count / ideal)), "{tolerance}: {count} chords, {ideal} at least");
    }
    let (coarse, fine) = (count(0.1) as f64, count(0.001) as f64);
    assert!((8.0..12.0).contains(&(fine / coarse)), "ten times as many for a hundredth: {coarse} {fine}");
}

/// What is found in a file, and the bytes under it.
fn found(text: &str) -> Vec<(String, String)> {
    let source = support::text(text);
    let found = load_profile(&source).unwrap_err();
    let shown = |span: clsmith::source::Span| text[span.to_range()].to_owned();
    found.findings().iter().map(|found| (found.code.to_string(), shown(found.labels[0].span))).collect()
}

#[test]
fn every_fault_stands_at_its_place() {
    let cases = [
        ("line: [0, 0]", "[0, 0]"),
        ("polyline: []", "[]"),
        ("polyline: [[5, 0], [5, 0]]", "[5, 0]"),
        ("polyline: [[5, 0], [1e9, 0]]", "[1e9, 0]"),
        ("arc: { to: [0, 0], radius: 5, turn: left }", "[0, 0]"),
        ("arc: { to: [20, 0], radius: 5, turn: left }", "5"),
        ("arc: { to: [20, 0], centre: [11, 0], turn: left }", "[11, 0]"),
        ("arc: { to: [20, 0], turn: left }", "{ to: [20, 0], turn: left }"),
        (
            "arc: { to: [20, 0], radius: 15, centre: [10, 5], turn: left }",
            "{ to: [20, 0], radius: 15, centre: [10, 5], turn: left }",
        ),
        ("ellipse: { to: [40, 0], centre: [21, 0], semi_axes: [20, 8], turn: left }", "[21, 0]"),
        ("ellipse: { to: [40, 1], centre: [20, 0], semi_axes: [20, 8], turn: left }", "[40, 1]"),
        ("nurbs: { points: [[1, 1]] }", "[[1, 1]]"),
        ("nurbs: { points: [[1, 1], [2, 1], [3, 0]], weights: [1, 2] }", "[1, 2]"),
        ("nurbs: { points: [[1, 1], [2, 1], [3, 0]], knots: [0, 1] }", "[0, 1]"),
        (
            "nurbs: { points: [[1, 1], [2, 1], [3, 0]], knots: [0, 1, 2, 3, 4, 5, 6, 7] }",
            "[0, 1, 2, 3, 4, 5, 6, 7]",
        ),
    ];
    for (piece, shown) in cases {
        let text = format!("start: [0, 0]\npieces:\n  - {piece}\n  - line: [99, 9]\n");
        assert_eq!(found(&text), [(codes::BAD_VALUE.to_string(), shown.to_owned())], "{piece}");
    }
    assert_eq!(found("start: [0, 0]\npieces: []\n")[0].1, "[]");
    // Several at once, and what YAML itself finds.
    let text = "start: [0, 0]\npieces:\n  - line: [0, 0]\n  - arc: { to: [20, 0], radius: 5, turn: left }\n";
    assert_eq!(found(text).len(), 2);
    let text = "start: [0, 0]\npieces:\n  - arc: { to: [20, 0], radius: -5, turn: up }\n";
    assert_eq!(
        found(text),
        [("CL0215", "-5"), ("CL0212", "up")].map(|(code, at)| (code.to_owned(), at.to_owned()))
    );
    assert_eq!(found("pieces: [ { line: [1, 2] } ]\n").len(), 1, "no start");
    assert_eq!(found("start: [0, 0]\npieces: [ { curve: [1, 2] } ]\n")[0].1, "curve");
    assert_eq!(found("start: [0, 0\n").len(), 1, "no YAML");
}

#[test]
fn the_schema_knows_every_kind() {
    let schema = clsmith::surface_milling::profile_schema().to_string();
    for kind in ["line", "polyline", "arc", "ellipse", "nurbs", "semi_axes", "width"] {
        assert!(schema.contains(&format!("\"{kind}\"")), "{kind}");
    }
}
