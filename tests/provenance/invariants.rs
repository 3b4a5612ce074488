//! What comments must never do, over all fixtures and the corpus.

use super::done;
use crate::support::{self, fixtures};
use clsmith::job::JobOutcome;
use clsmith::parse::parse;
use clsmith::program::{Program, ProvenanceComment};
use clsmith::report::diff::ProgramDiff;
use clsmith::source::Source;
use std::sync::Arc;

const RECIPES: &[&str] = &[
    "  - scale_feed: { factor: 0.8 }",
    "  - clamp_feed: { max: 100 }",
    "  - move_origin: { translate: [1, -2, 3.5] }\n  - scale_feed: { factor: 0.7, where: { motions: [engage, cut] } }",
    "  - convert_units: { from: mm, to: inch }",
    "  - convert_units: { from: inch, to: mm }\n  - scale_feed: { factor: 1.1 }",
    "  - rewrite: { rules: [{ match: 'RAPID', insert_before: OPSTOP }, { match: 'COOLNT/ON', delete: true }] }",
];

/// Where clsmith's own comments stand in a program: before which statement, counted without them.
fn without_comments(program: &Program) -> Vec<u8> {
    let live = program.live_statements().map(|(_, statement)| program.statement_text(statement));
    live.filter(|text| ProvenanceComment::from_text(text).is_none()).flatten().copied().collect()
}

/// Corrects with and without comments: the same but for the comments, the same findings, and each comment fits.
fn compare(steps: &str, source: &Arc<Source>) -> bool {
    let name = source.name();
    let plain = done(&format!("version: 1\nsteps:\n{steps}\n"), source);
    let commented = done(&super::with_comments(steps), source);
    assert_eq!(commented.is_ok(), plain.is_ok(), "{name}: {commented:?}");
    let (Ok(commented), Ok(plain)) = (commented, plain) else { return false };
    let JobOutcome { program: plain, findings: before, .. } = plain;
    let JobOutcome { program, findings, .. } = commented;
    let codes = |found: &[clsmith::diagnostic::Diagnostic]| {
        found.iter().map(|found| (found.code.id(), found.message.clone())).collect::<Vec<_>>()
    };
    assert_eq!(codes(&findings), codes(&before), "{name}");
    let bytes = program.to_bytes();
    let again = parse(&support::text(&bytes), None);
    assert_eq!(again.program.dialect(), parse(source, None).program.dialect(), "{name}");
    assert!(without_comments(&again.program) == plain.to_bytes(), "{name}: only comments differ");
    let motions =
        |program: &Program| program.motions().map(|motion| (motion.to, motion.rapid)).collect::<Vec<_>>();
    assert!(motions(&again.program) == motions(&plain), "{name}: the path is the same");
    let plain_again = parse(&support::text(plain.to_bytes()), None).program;
    assert!(
        ProgramDiff::from_programs(&plain_again, &again.program).same_meaning,
        "{name}: `diff` finds the same meaning"
    );
    for (_, statement) in again.program.live_statements() {
        let text = again.program.statement_text(statement);
        if ProvenanceComment::from_text(text).is_some() {
            assert!(text.is_ascii() && text.trim_ascii_end().len() <= clsmith::provenance::WIDTH, "{name}");
        }
    }
    bytes != plain.to_bytes()
}

#[test]
fn comments_change_nothing_but_the_comments() {
    let mut commented = 0;
    for (_, path) in fixtures() {
        let source = support::source(&path);
        for steps in RECIPES {
            commented += usize::from(compare(steps, &source));
        }
    }
    assert!(commented > 80, "{commented}");
}

#[test]
fn comments_change_nothing_but_the_comments_in_real_files() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let source = support::source(&path);
        compare(RECIPES[0], &source);
    }
}

#[test]
fn a_second_run_adds_nothing_where_nothing_is_left_to_do() {
    for (_, path) in fixtures() {
        let source = support::source(&path);
        let clamp = super::with_comments(RECIPES[1]);
        let Ok(JobOutcome { program: once, .. }) = done(&clamp, &source) else { continue };
        let once = support::text(once.to_bytes());
        let twice = done(&clamp, &once).unwrap().program;
        assert!(twice.to_bytes() == once.bytes(), "{}", source.name());
    }
}
