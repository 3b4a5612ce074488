//! Edits by statement ids: what is not there cannot be edited, and ids hold until the editor finishes.

use crate::support;
use clsmith::diagnostic::Failure;
use clsmith::program::{Program, StatementId, StepId};
use clsmith::write::ProgramEditor;
use proptest::prelude::*;

const THREE: &str = "GOTO/1,0,0\nGOTO/2,0,0\nGOTO/3,0,0\n";

fn ids_of(program: &Program) -> Vec<StatementId> {
    program.statement_ids().collect()
}

/// An editor of three GOTOs, with their ids.
fn edit_three() -> (ProgramEditor, Vec<StatementId>) {
    let program = support::program(THREE);
    let ids = ids_of(&program);
    (ProgramEditor::new(program, StepId(0)), ids)
}

fn error_of<T: std::fmt::Debug>(result: Result<T, Failure>) -> (&'static str, String) {
    let found = result.unwrap_err().into_findings().remove(0);
    (found.code.id(), found.message)
}

#[test]
fn an_edit_of_a_deleted_statement_is_an_error() {
    let (mut editor, ids) = edit_three();
    editor.delete_statement(ids[1]).unwrap();
    let said = ("CL0308", "the step edits a statement that it has taken out".to_owned());
    assert_eq!(error_of(editor.set_text(ids[1], b"GOTO/9,0,0\n")), said);
    assert_eq!(error_of(editor.set_numbers(ids[1], &[(0, 9.0)])), said);
    assert_eq!(error_of(editor.replace_parts(ids[1], &[(5..6, b"9")])), said);
    // The error points at the statement in the source.
    let failure = editor.set_numbers(ids[1], &[(0, 9.0)]).unwrap_err();
    let found = &failure.findings()[0];
    assert_eq!((found.labels[0].span.start, found.labels[0].span.end), (11, 22));
    assert_eq!(editor.finish().unwrap().to_bytes(), b"GOTO/1,0,0\nGOTO/3,0,0\n");
}

#[test]
fn a_double_delete_is_an_error() {
    let (mut editor, ids) = edit_three();
    editor.delete_statement(ids[0]).unwrap();
    assert_eq!(error_of(editor.delete_statement(ids[0])).0, "CL0308");
    // So is one of a statement that an earlier step has deleted.
    let mut editor = ProgramEditor::new(editor.finish().unwrap(), StepId(1));
    let (code, message) = error_of(editor.delete_statement(ids[0]));
    assert_eq!(
        (code, message.as_str()),
        ("CL0308", "the step edits a statement that an earlier step has taken out")
    );
}

#[test]
fn a_statement_that_the_program_never_had_cannot_be_edited() {
    let (_, ids) = edit_three();
    let mut short = ProgramEditor::new(support::program("GOTO/1,0,0\n"), StepId(0));
    for result in [
        short.set_text(ids[2], b"GOTO/9,0,0\n"),
        short.set_numbers(ids[2], &[(0, 9.0)]),
        short.replace_parts(ids[2], &[(5..6, b"9")]),
        short.delete_statement(ids[2]),
        short.insert_before(ids[2], b"RAPID"),
        short.insert_after(ids[2], b"RAPID"),
    ] {
        assert_eq!(error_of(result).0, "CL0308");
    }
    assert_eq!(short.finish().unwrap().to_bytes(), b"GOTO/1,0,0\n");
}

#[test]
fn a_number_or_a_part_that_the_statement_never_had_cannot_be_edited() {
    let (mut editor, ids) = edit_three();
    assert_eq!(error_of(editor.set_numbers(ids[0], &[(0, 9.0), (3, 1.0)])).0, "CL0301");
    assert_eq!(error_of(editor.replace_parts(ids[0], &[(5..99, b"9")])).0, "CL0301");
    assert_eq!(error_of(editor.replace_parts(ids[0], &[(7..8, b"9"), (5..6, b"9")])).0, "CL0301");
    assert_eq!(editor.finish().unwrap().to_bytes(), THREE.as_bytes());
}

#[test]
fn statements_are_inserted_at_both_ends_and_keep_their_order() {
    let (mut editor, ids) = edit_three();
    let (start, end) = (editor.program().start(), editor.program().end());
    editor.insert(end, b"GOTO/4,0,0").unwrap();
    editor.insert_after(ids[2], b"GOTO/5,0,0").unwrap();
    editor.insert(start, b"GOTO/-1,0,0").unwrap();
    editor.insert_before(ids[0], b"GOTO/0,0,0").unwrap();
    let expected = format!("GOTO/-1,0,0\nGOTO/0,0,0\n{THREE}GOTO/4,0,0\nGOTO/5,0,0\n");
    assert_eq!(editor.finish().unwrap().to_bytes(), expected.as_bytes());
}

#[test]
fn an_empty_program_has_one_place_that_is_both_ends() {
    let program = support::program("");
    assert_eq!((program.start(), ids_of(&program).len()), (program.end(), 0));
    let at = program.start();
    let mut editor = ProgramEditor::new(program, StepId(0));
    editor.insert(at, b"FINI").unwrap();
    assert_eq!(editor.finish().unwrap().to_bytes().trim_ascii(), b"FINI");
}

#[test]
fn statements_are_inserted_beside_a_deleted_one() {
    let (mut editor, ids) = edit_three();
    editor.delete_statement(ids[1]).unwrap();
    editor.insert_before(ids[1], b"GOTO/7,0,0").unwrap();
    editor.insert_after(ids[1], b"GOTO/8,0,0").unwrap();
    let after = editor.finish().unwrap();
    assert_eq!(after.to_bytes(), b"GOTO/1,0,0\nGOTO/7,0,0\nGOTO/8,0,0\nGOTO/3,0,0\n");
}

#[test]
fn ids_hold_until_the_editor_finishes_and_are_asked_for_anew_after_insertions() {
    let (mut editor, ids) = edit_three();
    editor.insert_before(ids[0], b"RAPID").unwrap();
    // The insertion waits, so the ids still mean what they meant.
    editor.set_numbers(ids[2], &[(0, 30.0)]).unwrap();
    assert_eq!(ids_of(editor.program()), ids);
    let after = editor.finish().unwrap();
    assert_eq!(after.to_bytes(), b"RAPID\nGOTO/1,0,0\nGOTO/2,0,0\nGOTO/30,0,0\n");
    let text = |id: StatementId| after.statement_text(after.statement(id)).to_vec();
    assert_eq!(text(ids_of(&after)[3]), b"GOTO/30,0,0\n");
}

#[test]
#[cfg(debug_assertions)]
#[should_panic(expected = "an id is used with a program that did not make it")]
fn an_id_from_before_an_insertion_is_found_in_builds_with_assertions() {
    let (mut editor, ids) = edit_three();
    editor.insert_before(ids[0], b"RAPID").unwrap();
    let after = editor.finish().unwrap();
    let _ = after.statement(ids[0]);
}

#[test]
fn ids_stay_valid_over_edits_without_insertions_and_in_clones() {
    let (mut editor, ids) = edit_three();
    editor.set_numbers(ids[0], &[(0, 10.0)]).unwrap();
    editor.delete_statement(ids[1]).unwrap();
    let after = editor.finish().unwrap();
    let copy = after.clone();
    assert_eq!(copy.statement_text(copy.statement(ids[0])), b"GOTO/10,0,0\n");
    assert!(!after.statement(ids[1]).is_live() && after.statement(ids[2]).is_live());
    assert_eq!(after.next_live_statement(ids[0]), Some(ids[2]));
    assert_eq!(after.next_live_statement(ids[2]), None);
}

/// Statements of every kind that motions take notice of.
const LINES: [&str; 14] = [
    "GOTO/1,2,3",
    "GOTO/4,5,6,0,0,1",
    "GOTO/1,2,3,4,5,6,7,8,9,1,2,3",
    "RAPID",
    "FROM/0,0,0",
    "GODLTA/1,0,0",
    "FEDRAT/100,MMPM",
    "CIRCLE/0,0,0,0,0,1,5",
    "CYCLE/DRILL,5,MMPM,100",
    "CYCLE/OFF",
    "GOHOME",
    "NURBS",
    "CNTRL/1,2,3",
    "TOOL PATH/A,TOOL,T",
];

/// What is done to a statement, by its number.
#[derive(Debug, Clone)]
enum Change {
    Delete(usize),
    Insert(usize, usize),
}

proptest! {
    #![proptest_config(support::property(256))]

    #[test]
    fn ids_of_motions_always_lead_to_live_statements(
        lines in prop::collection::vec(0..LINES.len(), 1..40),
        changes in prop::collection::vec(
            prop_oneof![
                any::<usize>().prop_map(Change::Delete),
                (any::<usize>(), 0..LINES.len()).prop_map(|(at, line)| Change::Insert(at, line)),
            ],
            0..10,
        ),
    ) {
        let text: String = lines.iter().map(|line| format!("{}\n", LINES[*line])).collect();
        let program = clsmith::parse::parse(&support::text(text), None).program;
        let ids = ids_of(&program);
        let mut editor = ProgramEditor::new(program, StepId(0));
        for change in changes {
            match change {
                Change::Delete(at) => {
                    let id = ids[at % ids.len()];
                    let was_live = editor.program().statement(id).is_live();
                    prop_assert_eq!(editor.delete_statement(id).is_ok(), was_live);
                }
                Change::Insert(at, line) => {
                    editor.insert_before(ids[at % ids.len()], LINES[line].as_bytes()).unwrap();
                }
            }
        }
        let program = editor.finish().unwrap();
        let mut last = None;
        for motion in program.motions() {
            let live = |id: StatementId| program.contains(id) && program.statement(id).is_live();
            prop_assert!(live(motion.last_statement()), "{:?}", motion);
            prop_assert!(live(motion.statements.first()), "{:?}", motion);
            prop_assert!(motion.feed_from.is_none_or(live), "{:?}", motion);
            prop_assert!(motion.statements.contains(motion.last_statement()));
            prop_assert!(last <= Some(motion.last_statement()), "motions go on through the file");
            last = Some(motion.last_statement());
        }
    }
}
