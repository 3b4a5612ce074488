//! The project's own programs are right: what a transform does to them can be judged by their geometry.

use crate::support::{fixture, fixtures, motions, program};
use clsmith::program::geometry::{CircularArc, MotionPath};
use clsmith::program::motion::Motion;

#[test]
fn no_fixture_has_a_problem_and_every_axis_is_a_unit_vector() {
    for (_, path) in fixtures() {
        let (found, problems) = motions(&program(std::fs::read(&path).unwrap()));
        assert!(problems.is_empty(), "{}: {problems:?}", path.display());
        assert!(found.len() > 5, "{}", path.display());
        assert!(found.iter().all(|motion| (motion.to.axis.norm() - 1.0).abs() < 1e-6), "{}", path.display());
    }
}

#[test]
fn motions_follow_one_another() {
    for (_, path) in fixtures() {
        let (found, _) = motions(&program(std::fs::read(&path).unwrap()));
        for pair in found.windows(2) {
            let same_frame = pair[0].frame == pair[1].frame;
            let starts = matches!(pair[1].path, MotionPath::Start);
            assert!(starts || !same_frame || pair[1].from == pair[0].to, "{}", path.display());
        }
    }
}

#[test]
fn motions_that_are_given_back_leave_nothing_behind() {
    for (_, path) in fixtures() {
        let program = program(std::fs::read(&path).unwrap());
        let (found, _) = motions(&program);
        let mut seen = Vec::new();
        program.motions().for_each_motion(|motion| seen.push(format!("{motion:?}")));
        let found: Vec<String> = found.iter().map(|motion| format!("{motion:?}")).collect();
        assert_eq!(seen, found, "{}", path.display());
    }
}

/// The arcs with the motions before them, where those are feed motions.
fn arcs(found: &[Motion]) -> Vec<(&Motion, &CircularArc)> {
    let pairs = found.windows(2).filter(|pair| !pair[0].rapid);
    pairs
        .filter_map(|pair| {
            if let MotionPath::Arc(arc) = &pair[1].path { Some((&pair[0], arc.as_ref())) } else { None }
        })
        .collect()
}

#[test]
fn every_arc_of_the_fixtures_continues_the_motion_before_it() {
    let mut count = 0;
    for (_, path) in fixtures() {
        let (found, _) = motions(&program(std::fs::read(&path).unwrap()));
        for (before, arc) in arcs(&found) {
            let Some(tangent) = before.path.end_tangent(before.from.point, before.to.point) else { continue };
            // Helices go down while the motion before was level, and full circles may follow an arc.
            let level = arc.rise.abs() < 1e-9;
            assert!(!level || tangent.dot(&arc.tangent_at(0.0)) > 0.999, "{}: {arc:?}", path.display());
            count += 1;
        }
    }
    assert!(count > 25, "{count}");
}

#[test]
fn the_nx_pocket_has_a_helix_and_compensated_corners() {
    let (found, _) = motions(&fixture("nx/pocket-3axis.cls"));
    let arcs: Vec<_> = found
        .iter()
        .filter_map(|motion| if let MotionPath::Arc(arc) = &motion.path { Some(arc) } else { None })
        .collect();
    assert_eq!(arcs.len(), 6);
    let degrees: Vec<_> = arcs.iter().map(|arc| arc.sweep.to_degrees().round()).collect();
    assert_eq!(degrees, [630.0, 90.0, 90.0, 90.0, 90.0, 90.0]);
    assert_eq!(arcs[0].rise, -5.0 * arcs[0].axis.z);
}

#[test]
fn the_catia_profile_has_a_full_circle_and_one_beyond_half() {
    let (found, _) = motions(&fixture("catia/profile-3axis.aptsource"));
    let degrees: Vec<_> = found
        .iter()
        .filter_map(|motion| {
            if let MotionPath::Arc(arc) = &motion.path { Some(arc.sweep.to_degrees().round()) } else { None }
        })
        .collect();
    assert_eq!(degrees, [360.0, 270.0, 90.0, 90.0]);
}

#[test]
fn nothing_moves_after_the_end_of_a_program() {
    let (found, _) = motions(&fixture("catia/turning-junk-after-end.aptsource"));
    assert_eq!(found.last().unwrap().to.point, nalgebra::Point3::new(16.5, 0.0, 3.0));
}
