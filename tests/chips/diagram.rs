//! The boundary construction diagram.

use super::sections::{axis, piece, place};
use clsmith::engagement::PathPiece;
use clsmith::internals::layered_chips::boundary_diagram::{BranchEnd, EdgeState};
use clsmith::internals::layered_chips::section_family::DiagramCurve;
use clsmith::layered_chips::{BoundaryDiagram, FlatMill, MillStep, MillStepError, SectionFamily};
use clsmith::program::geometry::Pose;
use nalgebra::Vector3;
use proptest::prelude::*;

fn family(radius: f64, from: Pose, to: Pose, z: f64) -> SectionFamily {
    let step =
        MillStep::new(FlatMill { radius_mm: radius, flute_length_mm: f64::INFINITY }, &piece(from, to))
            .unwrap();
    SectionFamily::new(&step, z)
}

/// The determinant by differences of points.
fn by_differences(family: &SectionFamily, theta: f64, t: f64) -> f64 {
    let h = 1e-5;
    let point = |theta: f64, t: f64| family.ellipse_at(t).point_towards([theta.cos(), theta.sin()]);
    let slope = |a: [f64; 2], b: [f64; 2]| [(b[0] - a[0]) / (2.0 * h), (b[1] - a[1]) / (2.0 * h)];
    let across = slope(point(theta - h, t), point(theta + h, t));
    let up = slope(point(theta, t - h), point(theta, t + h));
    across[0] * up[1] - across[1] * up[0]
}

fn edge(family: &SectionFamily, theta: f64, t: f64) -> f64 {
    let [k0, k1, k2, k3, k4] = family.curve_coefficients(DiagramCurve::Edge, t);
    k0 + k1 * theta.cos() + k2 * theta.sin() + k3 * (2.0 * theta).cos() + k4 * (2.0 * theta).sin()
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn f_is_the_determinant_and_its_zeros_are_the_branches(
        tilts in prop::array::uniform2(0.0..70.0f64),
        towards in prop::array::uniform2(0.0..90.0f64),
        way in prop::array::uniform3(-5.0..5.0f64),
        z in -3.0..10.0f64,
        theta in 0.0..std::f64::consts::TAU,
        t in 0.01..0.99f64,
    ) {
        let f = family(4.0, place([0.0; 3], axis(tilts[0], towards[0])), place(way, axis(tilts[1], towards[1])), z);
        let scale = 1.0 + edge(&f, theta, t).abs();
        prop_assert!((edge(&f, theta, t) - by_differences(&f, theta, t)).abs() < 1e-5 * scale.max(100.0));
        let diagram = BoundaryDiagram::new(&f);
        prop_assert!(diagram.is_resolved());
        let branches = diagram.trace_branches(8);
        for branch in &branches {
            for [theta, t] in branch.points.iter().filter(|[_, t]| *t > 0.001 && *t < 0.999) {
                prop_assert!(by_differences(&f, *theta, *t).abs() < 2e-2, "{} at {theta} {t}", by_differences(&f, *theta, *t));
            }
        }
        // As many branches at a time as a fine walk around the circle finds changes of sign, unless an event is at that very time.
        let walk = |index: usize| edge(&f, std::f64::consts::TAU * index as f64 / 4000.0, t) > 0.0;
        let changes = (0..4000).filter(|index| walk(*index) != walk(index + 1)).count();
        let there = branches.iter().filter(|branch| {
            branch.points.first().unwrap()[1] <= t && t <= branch.points.last().unwrap()[1]
        });
        let near = diagram.events().iter().any(|event| (event.t - t).abs() < 1e-3);
        prop_assert!(near || there.count() == changes, "{changes} changes");
    }
}

#[test]
fn a_straight_step_has_two_branches_from_edge_to_edge() {
    let f = family(5.0, place([0.0; 3], [0.0, 0.0, 1.0]), place([2.0, 0.0, 0.0], [0.0, 0.0, 1.0]), 3.0);
    let diagram = BoundaryDiagram::new(&f);
    let branches = diagram.trace_branches(4);
    assert_eq!(branches.len(), 2);
    for branch in &branches {
        assert_eq!((branch.begins, branch.ends), (BranchEnd::Edge, BranchEnd::Edge));
        assert!(branch.points.iter().all(|[theta, _]| theta.cos().abs() < 1e-12));
    }
    assert_eq!(diagram.edge_state_at(0.0, 0.5), EdgeState::Advancing);
    assert_eq!(diagram.edge_state_at(3.0, 0.5), EdgeState::Retreating);
}

#[test]
fn a_cutter_that_turns_back_in_the_layer_folds_its_envelope() {
    // The axis pivots about a point in the layer that the way passes: the section grows, stops and shrinks.
    let f = family(5.0, place([0.0; 3], axis(30.0, 20.0)), place([3.0, 1.0, 1.0], axis(45.0, 100.0)), 3.0);
    let diagram = BoundaryDiagram::new(&f);
    // Two begin together, and one of them ends together with one that was there.
    let ends: Vec<(BranchEnd, BranchEnd)> =
        diagram.trace_branches(16).iter().map(|b| (b.begins, b.ends)).collect();
    assert_eq!(ends.len(), 4, "{ends:?} {:?}", diagram.events());
    assert_eq!(ends.iter().filter(|(begins, _)| *begins == BranchEnd::Fold).count(), 2, "{ends:?}");
    assert_eq!(ends.iter().filter(|(_, ends)| *ends == BranchEnd::Fold).count(), 2, "{ends:?}");
    assert!(diagram.is_resolved());
}

#[test]
fn turning_about_the_tip_from_upright_is_told_apart() {
    for z in [0.1, 4.0] {
        let f = family(5.0, place([0.0; 3], axis(0.0, 0.0)), place([0.0; 3], axis(25.0, 0.0)), z);
        assert!(BoundaryDiagram::new(&f).is_resolved(), "z {z}");
    }
    // In the tip's own layer f is zero twice over along the chord's ends, which no proof of signs can tell.
    let f = family(5.0, place([0.0; 3], axis(0.0, 0.0)), place([0.0; 3], axis(25.0, 0.0)), 0.0);
    assert!(!BoundaryDiagram::new(&f).is_resolved());
}

#[test]
fn what_cannot_be_modelled_is_refused() {
    let up = place([0.0; 3], [0.0, 0.0, 1.0]);
    let mill = FlatMill { radius_mm: 5.0, flute_length_mm: 10.0 };
    let refuse = |mill: FlatMill, from: Pose, to: Pose| {
        MillStep::new(mill, &PathPiece { from, to, cutter: 0 }).unwrap_err()
    };
    assert_eq!(refuse(mill, up, up), MillStepError::Still);
    assert_eq!(
        refuse(
            FlatMill { radius_mm: 0.0, flute_length_mm: 1.0 },
            up,
            place([1.0, 0.0, 0.0], [0.0, 0.0, 1.0])
        ),
        MillStepError::NoCutter
    );
    assert!(matches!(refuse(mill, up, place([1.0, 0.0, 0.0], axis(85.0, 0.0))), MillStepError::Tilt { .. }));
    assert_eq!(refuse(mill, up, place([1.0, 0.0, 0.0], [0.0, 0.0, -1.0])), MillStepError::Overturns);
    let nowhere = Pose { point: nalgebra::Point3::new(f64::NAN, 0.0, 0.0), axis: Vector3::z() };
    assert_eq!(refuse(mill, up, nowhere), MillStepError::NotFinite);
}
