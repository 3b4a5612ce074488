//! Words of a shop's own, words without a slash, channels, and points behind a tool change.

use super::{MOVE, alarms, findings, read, totals};
use crate::transform::apply as apply_with_findings;

#[test]
fn an_unknown_word_is_one_note_and_no_slip_of_another_system() {
    let text =
        "$$     CATIA APT VERSION 1.0\nOP_NAME/A\nTDATA/ENDMILL,16.,2.,100.\nOP_NAME/B\nOP_NAME/C\nFINI\n";
    let found = findings(text, true);
    let words: Vec<_> = found.iter().filter(|(code, _)| code.starts_with("CL015")).collect();
    assert_eq!(words, [&("CL0150".to_owned(), 2), &("CL0150".to_owned(), 3)], "{found:?}");
}

#[test]
fn numbers_behind_a_comma_are_no_part_of_the_word() {
    let text = "UNITS/MM\nLOCAL_ORIGIN,   40.00000,    85.50000,   0.000000\nGOTO/0,0,0\n";
    let syntax = clsmith::parse::syntax(b"LOCAL_ORIGIN,   40.00000,    85.50000,   0.000000\n");
    assert_eq!((syntax.major_word().as_str(), syntax.numbers().len()), ("LOCAL_ORIGIN", 3));
    let (_, found) = apply_with_findings(MOVE, text);
    assert!(found.iter().any(|found| found.message.contains("`LOCAL_ORIGIN`")), "{found:?}");
}

#[test]
fn channels_are_paths_of_their_own() {
    let text = "CHANNEL,1\nUNITS/MM\nFEDRAT/MMPM,600.\nGOTO/0,0,0\nGOTO/10,0,0\nCHANNEL,2\nFEDRAT/MMPM,60.\nGOTO/100,0,0\n\
                GOTO/101,0,0\nCHANNEL,1\nGOTO/10,5,0\nCHANNEL,2\nGOTO/101,2,0\n";
    assert_eq!(totals(&read(text)), (10.0 + 1.0 + 5.0 + 2.0, 0.0, 1.5 + 3.0));
}

#[test]
fn a_tool_change_goes_elsewhere_between_two_equal_points() {
    let text = "UNITS/MM\nCUTTER/8\nLOADTL/1\nSPINDL/RPM,500,CLW\nFEDRAT/MMPM,600.\nRAPID\nGOTO/0,0,60\nLOADTL/2\nSPINDL/RPM,900,CLW\n\
                RAPID\nGOTO/0,0,60\n";
    let repeated = |text: &str| findings(text, true).iter().filter(|(code, _)| code == "CL0114").count();
    assert_eq!(repeated(text), 0);
    assert_eq!(repeated(&text.replace("LOADTL/2\n", "")), 1);
    assert_eq!(alarms(text), []);
}
