//! Every motion of every file split in three, and read back.

use crate::support;
use clsmith::internals::transform::optimize_feed::{SplitProgram, UnsplitReason, split_motions};
use clsmith::program::geometry::MotionPath as ClPath;
use clsmith::program::motion::Motion;
use clsmith::program::{Dialect, Program, Record, StatementChange, StepId};
use nalgebra::Point3;
use std::collections::BTreeMap;

const SHARES: [f64; 2] = [1.0 / 3.0, 2.0 / 3.0];

/// Parts shorter than this show no more in the decimals.
const SHORT: f64 = 0.01;

/// Splits whatever is long enough; everything that must hold then is checked. Gives how many motions were split, and why others not.
fn split_all(name: &str, before: &Program) -> (usize, BTreeMap<UnsplitReason, usize>) {
    let old: Vec<Motion> = before.motions().collect();
    let wanted: Vec<_> = (0..old.len())
        .filter(|index| old[*index].length() > SHORT)
        .map(|index| (index, SHARES.to_vec()))
        .collect();
    let mut findings = Vec::new();
    let result = split_motions(before.clone(), StepId(0), &wanted, &mut findings).unwrap();
    let again =
        clsmith::parse::parse(&support::text(result.program.to_bytes()), Some(before.dialect())).program;
    let new: Vec<Motion> = again.motions().collect();
    assert_eq!(result.parts.len(), old.len());
    let mut splits = 0;
    for ((index, old), range) in old.iter().enumerate().zip(&result.parts) {
        let place = || {
            let (line, _) =
                before.source().line_column(before.statement(old.last_statement()).origin().start);
            format!("{name}:{line}")
        };
        let parts = &new[range.clone()];
        assert_eq!((parts[0].from, parts[parts.len() - 1].to), (old.from, old.to), "{}", place());
        if let [whole] = parts {
            assert_eq!(whole.path, old.path, "{}", place());
            let asked = wanted.iter().any(|(motion, _)| *motion == index);
            assert_eq!(asked, result.kept.iter().any(|(motion, _)| *motion == index), "{}", place());
            continue;
        }
        splits += 1;
        assert_eq!(parts.len(), 3, "{}", place());
        parts_lie_on(old, parts, &place);
    }
    assert_eq!(range_end(&result), new.len(), "{name}");
    assert_statements(name, before, &result.program);
    let mut why = BTreeMap::new();
    result.kept.iter().for_each(|(_, reason)| *why.entry(*reason).or_default() += 1);
    (splits, why)
}

fn range_end(result: &SplitProgram) -> usize {
    result.parts.last().map_or(0, |range| range.end)
}

fn point(motion: &Motion, share: f64) -> Point3<f64> {
    match &motion.path {
        ClPath::Arc(arc) => arc.point_at(share),
        _ => motion.from.point + (motion.to.point - motion.from.point) * share,
    }
}

fn parts_lie_on(old: &Motion, parts: &[Motion], place: &impl Fn() -> String) {
    let starts = [0.0, SHARES[0], SHARES[1], 1.0];
    for (part, pair) in parts.iter().zip(starts.windows(2)) {
        assert!((part.to.axis.norm() - 1.0).abs() < 1e-4, "{}", place());
        assert_eq!(
            (part.feed, part.class, part.operation),
            (old.feed, old.class, old.operation),
            "{}",
            place()
        );
        // Half of the fourth decimal in each coordinate at the ends; inside an arc both ends and the printed radius count.
        let ends = 5e-5 * 3f64.sqrt() * 1.001;
        for step in 0..=8 {
            let share = f64::from(step) / 8.0;
            let slack = if matches!(old.path, ClPath::Arc(_)) { 4.0 * ends + 2e-3 * share } else { ends };
            let off = point(part, share) - point(old, pair[0] + (pair[1] - pair[0]) * share);
            assert!(off.norm() <= slack, "{}: {} off at {share}", place(), off.norm());
        }
    }
    // Each new end: within half of the last decimal of the exact point.
    for (part, share) in parts.iter().zip(SHARES) {
        assert!((part.to.point - point(old, share)).amax() <= 5.001e-5, "{}", place());
    }
    if let ClPath::Arc(whole) = &old.path {
        let arcs = parts.iter().map(|part| match &part.path {
            ClPath::Arc(arc) => arc.as_ref(),
            other => panic!("{}: {other:?}", place()),
        });
        let arcs = arcs.collect::<Vec<_>>();
        let sweep: f64 = arcs.iter().map(|arc| arc.sweep).sum();
        assert!((sweep - whole.sweep).abs() < 1e-6 + 4e-4 / whole.radius, "{}", place());
        assert!(arcs.iter().all(|arc| arc.center == whole.center), "{}", place());
    }
}

/// What was in the file stays byte for byte, except what has to change in an arc that was split; what is new is of a kind that parts need.
fn assert_statements(name: &str, before: &Program, after: &Program) {
    let mut old = before.statements().iter();
    for statement in after.statements() {
        let new = matches!(
            statement.record(),
            Record::Goto(_)
                | Record::Circle(_)
                | Record::MoveArc(_)
                | Record::DriveArc(_)
                | Record::StartDirection(_)
        );
        match statement.change() {
            StatementChange::Inserted(_) => {
                assert!(new, "{name}");
                continue;
            }
            StatementChange::Untouched => {
                assert_eq!(after.statement_text(statement), before.statement_text(old.next().unwrap()))
            }
            StatementChange::Edited(_) => {
                assert!(matches!(statement.record(), Record::MoveArc(_) | Record::DriveArc(_)), "{name}");
                old.next().unwrap();
            }
            StatementChange::Deleted(_) => panic!("{name}: deleted"),
        }
    }
    assert!(old.next().is_none());
}

#[test]
fn fixtures_split_in_three_read_back_as_they_were() {
    let mut of_dialect: BTreeMap<&str, usize> = BTreeMap::new();
    for (dialect, path) in support::fixtures() {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let before = clsmith::parse::parse(&support::source(&path), Some(dialect)).program;
        let (splits, why) = split_all(&name, &before);
        *of_dialect.entry(dialect.name()).or_default() += splits;
        for reason in why.keys() {
            let expected = match reason {
                UnsplitReason::Helix => name == "pocket-3axis.cls",
                UnsplitReason::NotReadBack
                | UnsplitReason::UnsaidAxis
                | UnsplitReason::OppositeAxis
                | UnsplitReason::GoBack => false,
                _ => true,
            };
            assert!(expected, "{name}: {reason:?}");
        }
    }
    for dialect in Dialect::ALL.into_iter().filter(|dialect| *dialect != Dialect::CatiaIcam) {
        assert!(of_dialect[dialect.name()] > 0, "{dialect}");
    }
}

#[test]
fn real_files_split_in_three_read_back_as_they_were() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let before = clsmith::parse::parse(&support::source(&path), None).program;
        let (splits, why) = split_all(&name, &before);
        let lost = why.get(&UnsplitReason::NotReadBack).copied().unwrap_or_default();
        assert!(lost * 20 <= splits.max(20), "{name}: {lost} of {splits} do not read back");
    }
}
