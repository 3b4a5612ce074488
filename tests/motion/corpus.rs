//! What was measured over real files must come out of the motions again.

use crate::support::{motions, require_corpus, require_corpus_file, source};
use clsmith::parse::parse;
use clsmith::program::geometry::MotionPath;
use clsmith::program::motion::Motion;
use clsmith::program::{Dialect, Program, Record};
use std::path::{Path, PathBuf};

fn read(path: &Path) -> Program {
    parse(&source(path), None).program
}

/// Arcs of files of a dialect: (arcs, tangent entries, entries that agree with the resolved sense).
fn arcs_of(
    corpus: &[PathBuf],
    dialect: Dialect,
    check: impl Fn(&Program, &Motion, &clsmith::program::geometry::CircularArc),
) -> (usize, usize, usize) {
    let (mut count, mut tangent, mut agree) = (0, 0, 0);
    for program in corpus.iter().map(|path| read(path)).filter(|program| program.dialect() == dialect) {
        let (found, _) = motions(&program);
        for pair in found.windows(2) {
            let MotionPath::Arc(arc) = &pair[1].path else { continue };
            check(&program, &pair[1], arc);
            count += 1;
            let Some(before) = pair[0].path.end_tangent(pair[0].from.point, pair[0].to.point) else {
                continue;
            };
            let along = before.dot(&arc.tangent_at(0.0));
            if !pair[0].rapid && along.abs() > 0.999 {
                tangent += 1;
                agree += usize::from(along > 0.0);
            }
        }
    }
    (count, tangent, agree)
}

#[test]
fn nx_arcs_lie_on_their_circles_and_continue_the_motion_before() {
    let Some(corpus) = require_corpus() else { return };
    let (count, tangent, agree) = arcs_of(&corpus, Dialect::Nx, |program, motion, arc| {
        let printed = motion.statements.ids().find_map(|id| match program.statement(id).record() {
            Record::Circle(circle) => circle.radius,
            _ => None,
        });
        assert!((arc.radius - printed.unwrap()).abs() <= 2e-4, "{arc:?}");
        assert!(arc.end_deviation(motion.to.point) <= 2e-4, "{arc:?}");
        assert!((arc.point_at(1.0) - motion.to.point).norm() <= 4e-4);
    });
    assert!(count > 300 && tangent > 250, "{count} arcs, {tangent} with a tangent entry");
    assert_eq!(agree, tangent);
}

#[test]
fn makino_arcs_are_left_hand_too() {
    let Some(corpus) = require_corpus() else { return };
    let (_, tangent, agree) = arcs_of(&corpus, Dialect::MakinoFf, |_, motion, arc| {
        assert!(arc.end_deviation(motion.to.point) <= 1e-6, "{arc:?}");
    });
    assert_eq!(agree, tangent);
    assert!(tangent > 2, "{tangent}");
}

#[test]
fn solidworks_arcs_are_right_hand_but_for_the_cusps_of_rest_pockets() {
    let Some(corpus) = require_corpus() else { return };
    let (count, tangent, agree) = arcs_of(&corpus, Dialect::SolidWorks, |_, motion, arc| {
        assert!(arc.end_deviation(motion.to.point) <= 2e-5, "{arc:?}");
    });
    assert!(count > 500 && tangent > 300, "{count} {tangent}");
    assert!(agree * 100 >= tangent * 95, "{agree} of {tangent}");
}

#[test]
fn catia_arcs_end_where_their_line_ends_and_pass_half_if_and_only_if_intof() {
    let Some(path) = require_corpus_file("Hole-Flanging.aptsource") else { return };
    let program = read(&path);
    let (found, problems) = motions(&program);
    assert!(problems.is_empty(), "{:?}", problems.first());
    let mut beyond = 0;
    let mut count = 0;
    for motion in &found {
        let MotionPath::Arc(arc) = &motion.path else { continue };
        let Record::DriveArc(record) = program.statement(motion.last_statement()).record() else { panic!() };
        count += 1;
        assert_eq!(motion.to.point, record.end);
        assert!(arc.end_deviation(record.end) <= 2e-5 && (arc.point_at(1.0) - record.end).norm() <= 1e-4);
        assert_eq!(arc.sweep > std::f64::consts::PI, record.beyond_half, "{arc:?}");
        beyond += usize::from(record.beyond_half);
    }
    assert_eq!(count, 400);
    assert!(beyond > 300, "{beyond}");
}

#[test]
fn creo_five_axis_has_a_unit_axis_on_each_of_its_35418_points() {
    let Some(path) = require_corpus_file("finition2.ncl") else { return };
    let program = read(&path);
    let mut count = 0;
    for motion in program.motions() {
        count += 1;
        assert!((motion.to.axis.norm() - 1.0).abs() < 1e-9);
    }
    assert_eq!(count, 35_418);
    let printed = program
        .statements()
        .iter()
        .filter(|statement| matches!(statement.record(), Record::Goto(goto) if goto.axis.is_some()));
    assert_eq!(printed.count(), 35_418);
}

#[test]
fn coremill_has_356_rapids_and_one_feed() {
    let Some(path) = require_corpus_file("coremill.cls") else { return };
    let program = read(&path);
    let (found, _) = motions(&program);
    assert_eq!(found.iter().filter(|motion| motion.rapid).count(), 356);
    let feeds: std::collections::BTreeSet<_> =
        found.iter().filter(|motion| !motion.rapid).map(|motion| motion.feed_from).collect();
    assert_eq!(feeds.len(), 1);
    assert!(feeds.iter().all(Option::is_some));
}

#[test]
fn all_splines_of_nx_fit_and_lead_to_the_next_motion() {
    let Some(path) = require_corpus_file("nurbs.clsf") else { return };
    let (found, problems) = motions(&read(&path));
    assert!(problems.is_empty());
    let mut count = 0;
    for (index, motion) in found.iter().enumerate() {
        if let MotionPath::Spline(spline) = &motion.path {
            count += 1;
            assert!((spline.point_at(1.0) - motion.to.point).norm() < 1e-9);
            assert!(found.get(index + 1).is_none_or(|next| next.from == motion.to));
            // The curve is no longer than its control polygon and no shorter than its chord.
            let polygon: f64 = spline.controls.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
            let length = motion.length();
            assert!(
                length <= polygon + 1e-9 && length >= (motion.to.point - motion.from.point).norm() - 1e-9
            );
        }
    }
    assert_eq!(count, 70);
}

#[test]
fn helices_of_nx_come_down_by_what_was_measured() {
    for (file, rise) in [("2_KONTUR_VNUT_40_N2.cls", 5.0), ("10_KONTUR_125_N2_162.cls", 3.0)] {
        let Some(path) = require_corpus_file(file) else { return };
        let (found, _) = motions(&read(&path));
        let helices: Vec<_> = found
            .iter()
            .filter_map(|motion| match &motion.path {
                MotionPath::Arc(arc) if arc.sweep > std::f64::consts::TAU => Some(arc.rise.abs()),
                _ => None,
            })
            .collect();
        assert!(
            !helices.is_empty() && helices.iter().all(|found| (found - rise).abs() < 1e-9),
            "{file}: {helices:?}"
        );
    }
}
