//! Records that do not matter for the path never refuse a file.

use super::{alarms, assert_near, read, totals};
use clsmith::program::{NumberRole, Record};

/// A program around some lines.
fn around(lines: &str) -> String {
    format!(
        "UNITS/MM\nCUTTER/10\nLOADTL/1\nSPINDL/RPM,1000,CLW\nFEDRAT/MMPM,600\nGOTO/0,0,0\n{lines}GOTO/30,0,0\nFINI\n"
    )
}

#[test]
fn texts_and_places_in_records_that_take_none_are_passed_on() {
    for line in [
        "STOP/(TURN PART OVER, SEE SHEET 4)",
        "STOP/(TURN (180), SHEET 4/5)",
        "OPSTOP/'MEASURE'",
        "STOP/'A, B'",
        "ORIGIN/0,0,0,1,0,0,0,1,0",
        "ORIGIN/0,0,0",
        "TRANS/",
        "UNITS/MILLIM",
        "CYCLE/RESET",
        "CYCLE/CLEAR,OFF",
    ] {
        let text = around(&format!("{line}\n"));
        assert_eq!(alarms(&text), [], "{line}");
        assert_eq!(totals(&read(&text)), (30.0, 0.0, 3.0), "{line}");
    }
}

#[test]
fn nobody_knows_where_home_is() {
    for line in ["GOHOME", "GOHOME/", "GOHOME/'TOOL CHANGE'", "GOHOME/PARK", "GOHOME/2"] {
        let text = around(&format!("{line}\n"));
        assert_eq!(alarms(&text), [], "{line}");
        assert_eq!(totals(&read(&text)), (0.0, 0.0, 0.0), "{line}");
    }
}

#[test]
fn a_step_may_have_an_axis() {
    let program = read(around("GODLTA/0,0,5,0,0,1\n"));
    assert_near("step and way", totals(&program).0, 5.0 + 30.0_f64.hypot(5.0));
}

#[test]
fn words_in_a_movarc_say_what_their_numbers_are() {
    let arc = |words: &str| around(&format!("GOTO/8,0,0\nMOVARC/{words}\nGOTO/0,8,0\n"));
    for words in [
        "0,0,0,0,0,1,8",
        "CENTER,0,0,0,AXIS,0,0,1,RADIUS,8",
        "RADIUS,8,AXIS,0,0,1,CENTER,0,0,0",
        "CENTER,0,0,0,AXIS,0,0,1,RADIUS,8,TOLER,0.01",
        "CENTER,0,0,0,AXIS,0,0,1,RADIUS,8,TIMES,1",
        "0,0,0,0,0,1,8,ANGLE,90",
        "CENTER,0,0,0,NORMAL,0,0,1,RADIUS,8,ANGLE,90",
        "CENTER,0,0,0,AXIS,0,0,1,RADIUS,8,SPEED,5",
    ] {
        let text = arc(words);
        assert_eq!(alarms(&text), [], "{words}");
        assert_near(words, totals(&read(&text)).0, 8.0 + 12.566 + 31.048);
    }
    let (record, syntax) =
        clsmith::parse::read_record(b"MOVARC/RADIUS,8,TOLER,.1,AXIS,0,0,1,CENTER,0,0,0\n").unwrap();
    assert!(matches!(record, Record::MoveArc(_)));
    let roles = record.number_roles(&syntax);
    assert_eq!(roles[..3], [NumberRole::Length, NumberRole::Length, NumberRole::ArcAxis(0)]);
    assert_eq!(roles[7], NumberRole::Point(2));
}

#[test]
fn odd_texts_behind_words_that_move_nothing_are_passed_on() {
    for line in [
        "STOP (TURN)",
        "STOP/'IT''S DONE'",
        "OPSTOP/(TURN",
        "OPSTOP (CHECK BORE 12H7, LOG)",
        "STOP/)",
        "MACHIN/'SHOP' 'A",
        "STOP/'TURN",
    ] {
        let text = around(&format!("{line}\n"));
        assert_eq!(alarms(&text), [], "{line}");
        assert_eq!(totals(&read(&text)), (30.0, 0.0, 3.0), "{line}");
    }
    // Words that do matter are still refused, and so are definitions.
    for line in ["FEDRAT/(600", "STOP = 3", "GOTO/(1,2,3"] {
        assert_ne!(alarms(around(&format!("{line}\n"))), [], "{line}");
    }
    // The end is the end, whatever stands behind it.
    let ends = around("").replace("FINI\n", "END/'IT''S DONE\nGOTO/1,2,3\n");
    assert_eq!(alarms(&ends), [("CL0154".to_owned(), 9)]);
}

#[test]
fn zeros_that_fill_the_last_block_of_a_file_are_blank() {
    for zeros in [1, 4000] {
        for text in [around(""), around("").trim_end().to_owned()] {
            let text = format!("{text}{}", "\0".repeat(zeros));
            assert_eq!(alarms(&text), [], "{zeros}");
            assert_eq!(totals(&read(&text)), (30.0, 0.0, 3.0), "{zeros}");
        }
    }
}
