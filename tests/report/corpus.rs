//! Reports of real files.

use super::unified::apply;
use crate::support;
use clsmith::parse::parse;
use clsmith::program::{StatementId, StepId};
use clsmith::report::diff::ProgramDiff;
use clsmith::report::stats::{ProgramStats, to_json, to_text};
use clsmith::report::unified_diff::{UnifiedDiffOptions, to_bytes};
use clsmith::setup::Setup;
use clsmith::write::ProgramEditor;

#[track_caller]
fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} is not {wanted}");
}

#[test]
fn the_sums_of_real_files_agree() {
    let Some(corpus) = support::require_corpus_with_part_programs() else { return };
    for path in corpus {
        let parsed = parse(&support::source(&path), None);
        let stats = ProgramStats::from_program(&parsed.program, &Setup::default());
        let totals = stats.totals;
        assert!(totals.length().is_finite() && totals.feed_seconds.is_finite(), "{}", path.display());
        let classes = stats.classes.iter().map(|class| class.totals.length()).sum();
        let operations = stats.operations.iter().map(|operation| operation.totals.length()).sum();
        close(classes, totals.length());
        close(operations, totals.length());
        let rows: f64 = stats.feeds.iter().map(|row| row.length).sum();
        assert!(rows <= totals.feed_length * (1.0 + 1e-9));
        assert_eq!(stats.bytes as usize, parsed.program.source().bytes().len());
        assert!(!to_json(&stats, &[]).contains("NaN") && to_text(&stats).lines().count() > 3);
    }
}

#[test]
fn real_files_do_not_differ_from_themselves() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let source = support::source(&path);
        let (a, b) = (parse(&source, None).program, parse(&source, None).program);
        let found = ProgramDiff::from_programs(&a, &b);
        assert!(found.is_empty() && found.same_meaning && found.geometry.same, "{}", path.display());
    }
}

#[test]
fn real_files_with_other_feeds_keep_their_geometry_and_have_a_patch() {
    use clsmith::program::Record;
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let source = support::source(&path);
        let program = parse(&source, None).program;
        let feeds: Vec<(StatementId, f64)> = program
            .live_statements()
            .filter_map(|(id, statement)| match statement.record() {
                Record::Feed(feed) => Some((id, feed.value)),
                _ => None,
            })
            .collect();
        let mut editor = ProgramEditor::new(program, StepId(0));
        for (id, feed) in &feeds {
            let text = editor.program().statement_text(editor.program().statement(*id));
            let number =
                clsmith::parse::statement_numbers(text).iter().position(|(_, value)| value == feed).unwrap();
            editor.set_numbers(*id, &[(number, feed * 0.8)]).unwrap();
        }
        let after = editor.finish().unwrap();
        let found = ProgramDiff::from_programs(&parse(&source, None).program, &after);
        assert!(found.geometry.same, "{}", path.display());
        assert_eq!((found.counts.feeds, found.counts.moved), (feeds.len(), 0), "{}", path.display());
        assert!(found.counts.added.is_empty() && found.counts.removed.is_empty());
        let patch = to_bytes(&after, &UnifiedDiffOptions::default());
        assert_eq!(apply(source.bytes(), &patch), after.to_bytes(), "{}", path.display());
    }
}
