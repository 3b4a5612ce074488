//! Words of a shop's own, words without a slash, channels, and points behind a tool change.

use super::{MOVE, alarms, findings, read, totals};
use crate::support;
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
    assert_eq!((syntax.major_word().as_ref(), syntax.numbers().len()), ("LOCAL_ORIGIN", 3));
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

/// A program in a shop's own words, and what its setup says of them.
const SHOP: &str = "$$     CATIA APT VERSION 1.0\nWCS_DEF/ 12.0, -4.0, 0.0, 0.0, 1.0,$\n 0.0, -1.0, 0.0, 0.0\n\
    OP_NAME/ROUGH, BASE\nPPRINT TOOL NO 7\nCUTTER/ 16.0, 2.0\nPP_SPEED/ 1500.0,RPM,CLW\nPP_FEED/ 640.0,MMPM\n\
    GOTO/0,0,0\nGOTO/60,0,0\nOP_END\n\
    op_name / 'FINISH WALL'  $$ second\nPP_FEED/ 480.0,MMPM\nGOTO/60,12,0\nGOTO/0,12,0\nOP_END\nTDATA/1,2,3\nFINI\n";

const SHOP_WORDS: &str = "words:\n  OP_NAME: operation\n  OP_END: operation_end\n  WCS_DEF: frame\n  TDATA: text\n  \
    PPRINT TOOL NO: tool_change\n  PP_SPEED: spindle\n  PP_FEED: feed\n";

fn read_in_shop_words(text: &str) -> clsmith::program::Program {
    let setup = clsmith::setup::Setup::load(&support::text(SHOP_WORDS)).unwrap();
    let parsed = clsmith::parse::parse_with_vocabulary(&support::text(text), None, &setup.vocabulary);
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    assert_eq!(parsed.program.to_bytes(), text.as_bytes());
    parsed.program
}

#[test]
fn a_setup_teaches_the_words_of_a_shop() {
    let program = read_in_shop_words(SHOP);
    let operations = clsmith::program::operation::find_operations(&program);
    let names: Vec<&str> = operations.iter().map(|operation| operation.name.as_str()).collect();
    assert_eq!(names, ["ROUGH, BASE", "FINISH WALL"]);
    let motions: Vec<_> = program.motions().collect();
    assert_eq!(motions.iter().map(|motion| motion.operation).collect::<Vec<_>>(), [0, 0, 1, 1]);
    assert_eq!(motions[1].feed.map(|feed| feed.value), Some(640.0));
    assert_eq!(motions[3].feed.map(|feed| feed.value), Some(480.0));
    assert_eq!(motions[1].spindle_rpm(), Some(1500.0));
    assert_eq!(motions[1].tool.as_ref().and_then(|tool| tool.number), Some(7));
    let frame = motions[1].frame.as_ref().unwrap();
    assert_eq!(frame.origin.as_slice(), [12.0, -4.0, 0.0]);
    // Without the words nothing of this is known.
    assert!(read(SHOP).motions().all(|motion| motion.feed.is_none() && motion.frame.is_none()));
}

#[test]
fn steps_work_in_the_words_of_a_shop_and_read_them_back() {
    let recipe = format!(
        "version: 1\nsetup:\n  {}\nsteps:\n  - scale_feed: {{ factor: 0.5, where: {{ operations: ['FINISH*'] }} }}\n",
        SHOP_WORDS.trim_end().replace('\n', "\n  ")
    );
    let recipe = clsmith::transform::Recipe::load(&support::text(recipe)).unwrap();
    let policy = clsmith::report::finding_policy::FindingPolicy::default();
    let job = clsmith::job::CorrectionJob::new(&recipe, &recipe.setup, &policy);
    let outcome = job.correct_source(&support::text(SHOP)).unwrap();
    let text = String::from_utf8(outcome.program.to_bytes()).unwrap();
    assert_eq!(text, SHOP.replace("480.0", "240.0"));
}

#[test]
fn a_word_of_the_language_cannot_be_given_another_meaning() {
    for (words, code) in [("GOTO: text", "CL0215"), ("' ': text", "CL0215"), ("OP: nothing", "CL0212")] {
        let setup = clsmith::setup::Setup::load(&support::text(format!("words: {{ {words} }}\n")));
        let found = setup.expect_err(words).into_findings();
        assert_eq!(found[0].code.to_string(), code, "{words}: {found:?}");
    }
}

#[test]
fn arguments_that_do_not_fit_the_meaning_are_told_at_their_place() {
    let setup = clsmith::setup::Setup::load(&support::text(SHOP_WORDS)).unwrap();
    let text = "GOTO/0,0,0\nWCS_DEF/1,2\nPPRINT TOOL NO X\nGOTO/1,0,0\n";
    let parsed = clsmith::parse::parse_with_vocabulary(&support::text(text), None, &setup.vocabulary);
    let lines: Vec<_> =
        parsed.diagnostics.iter().map(|found| (found.code.to_string(), found.labels[0].span.start)).collect();
    assert_eq!(lines, [("CL0002".to_owned(), 11), ("CL0002".to_owned(), 23)], "{:?}", parsed.diagnostics);
    assert_eq!(parsed.program.to_bytes(), text.as_bytes());
}

#[test]
fn turrets_and_heads_are_paths_of_their_own() {
    let forms = [
        ("HEAD/1", "HEAD/2"),
        ("TURRET/FRONT", "TURRET/REAR"),
        ("TURRET/3,FRONT", "TURRET/4,REAR"),
        ("TURRET/FRONT,3", "TURRET/REAR,4"),
    ];
    for (one, other) in forms {
        let text = format!(
            "UNITS/MM\n{one}\nFEDRAT/MMPM,600.\nGOTO/0,0,0\nGOTO/10,0,0\n{other}\nFEDRAT/MMPM,60.\nGOTO/100,0,0\n\
             GOTO/101,0,0\n{one}\nGOTO/10,5,0\n{other}\nGOTO/101,2,0\n"
        );
        let program = read(&text);
        assert_eq!(totals(&program), (10.0 + 1.0 + 5.0 + 2.0, 0.0, 1.5 + 3.0), "{one}");
        if one.contains('3') {
            let tools: Vec<_> =
                program.motions().map(|motion| motion.tool.unwrap().number.unwrap()).collect();
            assert_eq!(tools, [3, 3, 4, 4, 3, 4]);
        }
    }
    // CATIA's turret of a tool change stays one.
    let catia = read("TURRET/5,OSETNO,1,SETOOL,10,20,0\nGOTO/0,0,0\n");
    assert_eq!(catia.motions().last().unwrap().tool.unwrap().number, Some(5));
}

#[test]
fn a_shops_feed_may_stand_behind_a_letter_and_its_frame_behind_a_name() {
    let text = "UNITS/MM\nWCS_DEF/G54, 12.0, -4.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0\nF_CUT/F300\nGOTO/0,0,0\nGOTO/30,0,0\nF_CUT/F150.5\n\
                GOTO/60,0,0\nFINI\n";
    let words = "words: { F_CUT: feed, WCS_DEF: frame }\n";
    let setup = clsmith::setup::Setup::load(&support::text(words)).unwrap();
    let parsed = clsmith::parse::parse_with_vocabulary(&support::text(text), None, &setup.vocabulary);
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    let motions: Vec<_> = parsed.program.motions().collect();
    assert_eq!(motions[1].feed.map(|feed| feed.value), Some(300.0));
    assert_eq!(motions[1].frame.as_ref().unwrap().origin.as_slice(), [12.0, -4.0, 0.0]);
    let run = |steps: &str| super::apply_in_words("{ F_CUT: feed, WCS_DEF: frame }", steps, text);
    let (half, _) = run("  - scale_feed: { factor: 0.5 }\n");
    assert!(half.contains("F_CUT/F150\nGOTO/0,0,0") && half.contains("F_CUT/F75.25\n"), "{half}");
    // What cannot be converted is named.
    let (_, found) = run("  - convert_units: { to: inch }\n");
    assert!(found.iter().any(|found| found.message.contains("behind a letter")), "{found:?}");
}

#[test]
fn a_feed_behind_a_letter_is_put_in_again_where_another_one_is_needed() {
    let text = "UNITS/MM\nOP/A\nF_CUT/F300\nGOTO/0,0,0\nGOTO/30,0,0\nOP/B\nGOTO/60,0,0\nFINI\n";
    let steps = "  - scale_feed: { factor: 0.5, where: { operations: [B] } }\n";
    let (after, _) = super::apply_in_words("{ F_CUT: feed, OP: operation }", steps, text);
    assert_eq!(after, text.replace("GOTO/60", "F_CUT/F150\nGOTO/60"));
}
