//! Several runs on one file.

use super::{corrected, text, with_comments};
use clsmith::diagnostic::codes;
use clsmith::parse::parse;

const PART: &str = "\
PARTNO A\n\
UNITS/MM\n\
FEDRAT/250.0000,MMPM\n\
GOTO/0.0000,0.0000,0.0000\n\
GOTO/10.0000,0.0000,0.0000\n\
FINI\n";

const HALF: &str = "  - scale_feed: { factor: 0.5 }";

#[test]
fn a_run_that_changes_nothing_writes_nothing() {
    let clamp = with_comments("  - clamp_feed: { max: 200 }");
    let once = text(&clamp, PART);
    assert!(once.contains("$$ clsmith clamp_feed: 250.0000 -> 200.0000\nFEDRAT/200.0000,MMPM\n"), "{once}");
    assert_eq!(text(&clamp, &once), once);
    // Neither does one on a program that has nothing to correct.
    assert_eq!(text(&with_comments("  - clamp_feed: { max: 300 }"), PART), PART);
}

#[test]
fn what_a_rule_put_beside_a_record_is_found_again_behind_its_comment() {
    let rule = "  - rewrite: { rules: [{ match: 'GOTO/10.0000,$...', insert_before: [STOP, 'DELAY/2'], \
        insert_after: [OPSTOP, 'COOLNT/OFF'] }] }";
    let once = text(&with_comments(rule), PART);
    assert!(once.contains("\n$$ clsmith rewrite: 2 records put in\nOPSTOP\nCOOLNT/OFF\n"), "{once}");
    assert_eq!(text(&with_comments(rule), &once), once);
}

#[test]
fn comments_end_as_the_lines_of_the_file_do() {
    for part in [PART.replace('\n', "\r"), "PARTNO A\rRAPID\rGOTO/0.0,0.0,5.0\rFINI\r".to_owned()] {
        let steps = "  - rewrite: { rules: [{ match: FINI, insert_before: OPSTOP }] }";
        let done = text(&with_comments(steps), &part);
        assert!(done.contains("\r$$ clsmith rewrite: put in\rOPSTOP\rFINI\r"), "{done:?}");
        assert!(!done.contains('\n'), "{done:?}");
    }
}

#[test]
fn the_lines_of_each_run_follow_those_of_the_run_before() {
    let once = text(&with_comments(HALF), PART);
    let twice = text(&with_comments(HALF), &once);
    let (header, rest) = twice.split_once("UNITS/MM\n").unwrap();
    assert_eq!(header.matches("has corrected this file").count(), 2, "{twice}");
    assert!(twice.starts_with(once.split_once("UNITS/MM\n").unwrap().0), "{twice}");
    assert_eq!(
        rest,
        "$$ clsmith scale_feed: 250.0000 -> 125.0000\n\
         $$ clsmith scale_feed: 125.0000 -> 62.5000\n\
         FEDRAT/62.5000,MMPM\n\
         GOTO/0.0000,0.0000,0.0000\n\
         GOTO/10.0000,0.0000,0.0000\n\
         FINI\n"
    );
}

#[test]
fn a_comment_stays_with_its_record_when_something_is_put_in_between() {
    let moved = text(&with_comments("  - move_origin: { translate: [0, 0, 1] }"), PART);
    let put_in = "  - rewrite: { rules: [{ match: 'GOTO/10.0000,$...', insert_before: OPSTOP }] }";
    let twice = text(&with_comments(put_in), &moved);
    let end = "\
        $$ clsmith rewrite: put in\n\
        OPSTOP\n\
        $$ clsmith move_origin: Z 0.0000 -> 1.0000\n\
        GOTO/10.0000,0.0000,1.0000\n\
        FINI\n";
    assert!(twice.ends_with(end), "{twice}");
    // Also where the record itself changes in the same run: the older line first.
    let both = format!("{put_in}\n  - move_origin: {{ translate: [0, 0, 1] }}");
    let twice = text(&with_comments(&both), &moved);
    let end = "\
        OPSTOP\n\
        $$ clsmith move_origin: Z 0.0000 -> 1.0000\n\
        $$ clsmith move_origin: Z 1.0000 -> 2.0000\n\
        GOTO/10.0000,0.0000,2.0000\n\
        FINI\n";
    assert!(twice.ends_with(end), "{twice}");
}

#[test]
fn a_run_without_comments_warns_of_those_that_it_makes_untrue() {
    let once = text(&with_comments(HALF), PART);
    let stale = |recipe: &str, part: &str| {
        let found = corrected(recipe, part).1;
        found.iter().filter(|found| found.code == codes::STALE_COMMENTS).count()
    };
    let plain = format!("version: 1\nsteps:\n{HALF}\n");
    assert_eq!(stale(&plain, &once), 1);
    assert_eq!(stale(&plain.replace("steps", "provenance: header\nsteps"), &once), 1);
    assert_eq!(stale(&with_comments(HALF), &once), 0);
    assert_eq!(stale(&plain, PART), 0);
    // Other records than the commented ones are no matter.
    assert_eq!(stale("version: 1\nsteps: [{ move_origin: { translate: [1, 0, 0] } }]", &once), 0);
}

#[test]
fn names_of_files_do_not_make_another_dialect() {
    for name in ["ICAM - old.apt", "CATIA APT VERSION 1.0.apt", "Pro/CLfile", "a $$-> b\n.apt", "täschle.apt"]
    {
        let source = clsmith::source::Source::new(name, PART.as_bytes().to_vec()).unwrap();
        let program = super::done(&with_comments(HALF), &source).unwrap().program;
        let bytes = program.to_bytes();
        let again = parse(&crate::support::text(&bytes), None).program;
        assert_eq!(again.dialect(), program.dialect(), "{name}");
        assert!(
            bytes.is_ascii() && bytes.split(|byte| *byte == b'\n').all(|line| line.len() <= 72),
            "{name}"
        );
    }
}

#[test]
fn a_header_alone_leaves_the_records_alone() {
    let done = text(&with_comments(HALF).replace("comments", "header"), PART);
    assert_eq!(done.matches("$$ clsmith").count(), 7, "{done}");
    assert!(done.ends_with(
        "UNITS/MM\nFEDRAT/125.0000,MMPM\nGOTO/0.0000,0.0000,0.0000\nGOTO/10.0000,0.0000,0.0000\nFINI\n"
    ));
}
