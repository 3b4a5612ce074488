//! set_spindle: speeds in every dialect, and the feeds that hang on them.

use super::{apply, try_apply};
use crate::support;
use clsmith::parameters::{Factor, Positive};
use clsmith::program::{LengthUnit, Program, Record, StatementId};
use clsmith::recipe::StatementFilter;
use clsmith::setup::Setup;
use clsmith::transform::set_spindle::{
    SetSpindleReport, SpindleFeedHandling, SpindleSpeedChange, SpindleSpeedRange,
};
use clsmith::transform::{SetSpindle, run_steps};
use proptest::prelude::*;

const TWO_TOOLS: &str = "TOOL PATH/A,TOOL,MILL
LOAD/TOOL,1
SPINDL/RPM,1200,CLW
FEDRAT/MMPM,600.0000
GOTO/0.0000,0.0000,5.0000
GOTO/0.0000,0.0000,-1.0000
END-OF-PATH
TOOL PATH/B,TOOL,DRILL
LOAD/TOOL,2
SPINDL/ON
GOTO/9.0000,0.0000,5.0000
GOTO/9.0000,0.0000,-1.0000
END-OF-PATH
";

fn step(parameters: &str) -> String {
    format!("  - set_spindle: {{ {parameters} }}\n")
}

fn clean(parameters: &str, text: &str) -> String {
    let (after, found) = apply(&step(parameters), text);
    assert!(found.is_empty(), "{found:?}");
    after
}

fn run(step: &SetSpindle, program: Program) -> (Program, SetSpindleReport) {
    let mut outcome = run_steps(&[step], LengthUnit::Mm, &Setup::default(), program).unwrap();
    let report = *outcome.reports.pop().unwrap().downcast_ref::<SetSpindleReport>().unwrap();
    (outcome.program, report)
}

#[test]
fn each_dialect_keeps_its_form() {
    let motions = "GOTO/ 0.0, 0.0, 0.0\nGOTO/ 1.0, 0.0, 0.0\n";
    for (before, after) in [
        ("SPINDL/RPM,1200,CLW", "SPINDL/RPM,960,CLW"),
        ("SPINDL/1200,CLW", "SPINDL/960,CLW"),
        ("SPINDL/1200", "SPINDL/960"),
        ("SPINDL/ 1200.0000,RPM,CLW", "SPINDL/ 960.0000,RPM,CLW"),
        ("SPINDL / RPM, 1200.000000,  CLW", "SPINDL / RPM, 960.000000,  CLW"),
        ("SPINDL/   1200,RPM, CCLW", "SPINDL/   960,RPM, CCLW"),
    ] {
        let text = format!("{before}\n{motions}");
        let wanted = format!("{after}\n{motions}");
        assert_eq!(clean("speed: { scale: 0.8 }, feeds: keep", &text), wanted);
        assert_eq!(clean("speed: { set: 960 }, feeds: keep", &text), wanted);
        assert_eq!(clean("speed: { clamp: { max: 960 } }, feeds: keep", &text), wanted);
    }
}

#[test]
fn every_fixture_is_scaled_and_nothing_else_changes() {
    for (dialect, path) in support::fixtures() {
        let program = clsmith::parse::parse(&support::source(&path), Some(dialect)).program;
        let before: Vec<(bool, Vec<u8>)> = lines(&program);
        let change = SpindleSpeedChange::Scale(Factor::new(0.5).unwrap());
        let (after, _) = run(&SetSpindle::new(change, SpindleFeedHandling::Keep), program);
        let after = lines(&after);
        let kept = |lines: &[(bool, Vec<u8>)]| {
            lines.iter().filter(|(spindle, _)| !spindle).map(|(_, text)| text.clone()).collect::<Vec<_>>()
        };
        assert_eq!(kept(&before), kept(&after), "{}", path.display());
    }
}

/// The statements' texts, and whether each sets spindle speed.
fn lines(program: &Program) -> Vec<(bool, Vec<u8>)> {
    let line = |(_, statement): (StatementId, &clsmith::program::Statement)| {
        (matches!(statement.record(), Record::Spindle(_)), program.statement_text(statement).to_vec())
    };
    program.live_statements().map(line).collect()
}

#[test]
fn a_scaled_speed_has_the_decimals_of_the_programmed_one() {
    let at = |speed: &str, factor: &str| {
        let text = format!("SPINDL/RPM,{speed},CLW\nGOTO/0.0,0.0,0.0\n");
        clean(&format!("speed: {{ scale: {factor} }}, feeds: keep"), &text)
    };
    assert!(at("1234", "0.85").starts_with("SPINDL/RPM,1049,CLW\n"));
    assert!(at("12", "0.85").starts_with("SPINDL/RPM,10.2,CLW\n"));
    assert!(at("1000.00", "0.33333").starts_with("SPINDL/RPM,333.33,CLW\n"));
}

#[test]
fn a_limit_holds_as_it_is_printed() {
    let text = "SPINDL/RPM,9000,CLW\nGOTO/0.0,0.0,0.0\n";
    for (limit, printed) in
        [("7643.3", "7643.3"), ("7643.30006", "7643.3"), ("7643.30004", "7643.3"), ("8000", "8000")]
    {
        let parameters = format!("speed: {{ clamp: {{ max: {limit} }} }}, feeds: keep");
        let once = clean(&parameters, text);
        assert_eq!(once, text.replace("9000", printed));
        assert_eq!(clean(&parameters, &once), once);
    }
    let parameters = "speed: { clamp: { min: 9500.00006, max: 12000 } }, feeds: keep";
    assert_eq!(clean(parameters, text), text.replace("9000", "9500.0001"));
    assert_eq!(clean("speed: { clamp: { min: 500, max: 12000 } }, feeds: follow", text), text);
}

#[test]
fn a_range_without_an_end_or_upside_down_is_refused_where_it_stands() {
    for range in ["{}", "{ min: 900, max: 800 }"] {
        let recipe =
            format!("version: 1\nsteps:\n  - set_spindle: {{ speed: {{ clamp: {range} }}, feeds: keep }}\n");
        assert!(try_apply(&recipe, TWO_TOOLS).is_err(), "{range}");
    }
}

#[test]
fn a_selected_operation_without_a_speed_of_its_own_starts_with_the_new_one() {
    let added = "SPINDL/RPM,800,CLW\nSPINDL/ON";
    for filter in ["operations: [B]", "tools: [2]"] {
        let parameters = format!("speed: {{ set: 800 }}, feeds: keep, where: {{ {filter} }}");
        let once = clean(&parameters, TWO_TOOLS);
        assert_eq!(once, TWO_TOOLS.replace("SPINDL/ON", added));
        assert_eq!(clean(&parameters, &once), once);
    }
}

#[test]
fn the_programmed_speed_and_feed_come_back_behind_the_selected_part() {
    for filter in ["operations: [A]", "tools: [1]", "tools: [MILL]"] {
        let parameters = format!("speed: {{ set: 800 }}, feeds: follow, where: {{ {filter} }}");
        let once = clean(&parameters, TWO_TOOLS);
        let wanted = TWO_TOOLS
            .replace("RPM,1200", "RPM,800")
            .replace("MMPM,600.0000", "MMPM,400.0000")
            .replace("SPINDL/ON\nGOTO", "SPINDL/RPM,1200,CLW\nSPINDL/ON\nFEDRAT/MMPM,600.0000\nGOTO");
        assert_eq!(once, wanted);
        assert_eq!(clean(&parameters, &once), once);
    }
    // Without SPINDL/ON the speed goes in front of the first motion.
    let text = TWO_TOOLS.replace("SPINDL/ON\n", "");
    let after = clean("speed: { scale: 0.5 }, feeds: keep, where: { operations: [A] }", &text);
    let wanted = text
        .replace("RPM,1200", "RPM,600")
        .replace("GOTO/9.0000,0.0000,5", "SPINDL/RPM,1200,CLW\nGOTO/9.0000,0.0000,5");
    assert_eq!(after, wanted);
}

#[test]
fn a_speed_put_in_keeps_the_sense_in_force() {
    let text = TWO_TOOLS.replace("SPINDL/ON", "SPINDL/CCLW");
    let after = clean("speed: { set: 800 }, feeds: keep, where: { operations: [B] }", &text);
    assert_eq!(after, text.replace("SPINDL/CCLW", "SPINDL/RPM,800,CCLW\nSPINDL/CCLW"));
}

#[test]
fn a_speed_that_stands_before_its_tool_is_asked_for_by_its_motions() {
    let text = "LOADTL/1\nSPINDL/1200,CLW\nGOTO/0.0,0.0,0.0\nSPINDL/3000,CLW\nLOADTL/2\nGOTO/1.0,0.0,0.0\n";
    let after = clean("speed: { clamp: { max: 1000 } }, feeds: keep, where: { tools: [2] }", text);
    assert_eq!(after, text.replace("3000", "1000"));
}

#[test]
fn a_spindle_that_stands_still_is_left_alone() {
    let text = "SPINDL/RPM,1200,CLW\nGOTO/0.0,0.0,0.0\nSPINDL/OFF\nGOTO/1.0,0.0,0.0\n";
    assert_eq!(clean("speed: { set: 800 }, feeds: follow", text), text.replace("1200", "800"));
}

const PER_MINUTE_AND_PER_REVOLUTION: &str = "SPINDL/RPM,1000,CLW
FEDRAT/MMPM,500.0000
GOTO/0.0000,0.0000,0.0000
GOTO/1.0000,0.0000,0.0000
FEDRAT/MMPR,0.2500
GOTO/2.0000,0.0000,0.0000
";

#[test]
fn feeds_per_minute_are_kept_or_follow_and_feeds_per_revolution_stay() {
    let text = PER_MINUTE_AND_PER_REVOLUTION;
    let faster = text.replace("RPM,1000", "RPM,1500");
    assert_eq!(clean("speed: { scale: 1.5 }, feeds: keep", text), faster);
    assert_eq!(
        clean("speed: { scale: 1.5 }, feeds: follow", text),
        faster.replace("MMPM,500.0000", "MMPM,750.0000")
    );
    for unit in ["IPM", "PERMIN", "INVERS"] {
        let text = text.replace("MMPM", unit);
        assert!(clean("speed: { scale: 1.5 }, feeds: follow", &text).contains(&format!("{unit},750.0000")));
    }
}

#[test]
fn a_tap_keeps_its_pitch_whatever_is_chosen() {
    let text = "SPINDL/RPM,800,CLW
FEDRAT/MMPM,500.0000
GOTO/0.0000,0.0000,9.0000
CYCLE/TAP,RAPTO,3.0000,FEDTO,-10.0000,MMPM,1000.0000
GOTO/0.0000,0.0000,0.0000
CYCLE/ON,FEDTO,-12.0000
GOTO/5.0000,0.0000,0.0000
CYCLE/OFF
CYCLE/TAP,RAPTO,3.0000,FEDTO,-10.0000,MMPR,1.2500
GOTO/9.0000,0.0000,0.0000
CYCLE/OFF
CYCLE/DRILL,RAPTO,3.0000,FEDTO,-10.0000,MMPM,160.0000
GOTO/9.0000,0.0000,0.0000
CYCLE/OFF
";
    let set = SpindleSpeedChange::Set(Positive::new(600.0).unwrap());
    let kept = text.replace("RPM,800", "RPM,600").replace("MMPM,1000.0000", "MMPM,750.0000");
    let (program, report) = run(&SetSpindle::new(set, SpindleFeedHandling::Keep), support::program(text));
    assert_eq!(String::from_utf8(program.to_bytes()).unwrap(), kept);
    assert_eq!(
        report,
        SetSpindleReport { speeds_changed: 1, speeds_added: 0, feeds_followed: 1, tap_feeds: 1 }
    );
    let (program, report) = run(&SetSpindle::new(set, SpindleFeedHandling::Follow), support::program(text));
    let followed = kept.replace("MMPM,500.0000", "MMPM,375.0000").replace("MMPM,160.0000", "MMPM,120.0000");
    assert_eq!(String::from_utf8(program.to_bytes()).unwrap(), followed);
    assert_eq!((report.feeds_followed, report.tap_feeds), (3, 1));
    let told = clsmith::transform::TransformReport::to_text(&report, Default::default());
    assert_eq!(
        told,
        "\nset_spindle: 1 speed changed, 0 put in; 3 feeds per minute follow, 1 of taps (pitch times speed)\n"
    );
    // A tap that goes at the FEDRAT in force.
    let text = "SPINDL/RPM,800,CLW\nFEDRAT/MMPM,1000.0000\nCYCLE/TAP,RAPTO,3.0000,FEDTO,-10.0000\nGOTO/0.0000,0.0000,0.0000\nCYCLE/OFF\n";
    let after = clean("speed: { set: 600 }, feeds: keep", text);
    assert!(after.contains("MMPM,750.0000"), "{after}");
}

#[test]
fn a_surface_speed_is_scaled_and_else_reported() {
    for unit in ["SFM", "SMM"] {
        let text = format!("SPINDL/  200,{unit},CLW\nGOTO/0.0,0.0,0.0\n");
        assert_eq!(clean("speed: { scale: 0.5 }, feeds: keep", &text), text.replace("200", "100"));
        for change in ["set: 900", "clamp: { max: 100 }"] {
            let (after, found) = apply(&step(&format!("speed: {{ {change} }}, feeds: follow")), &text);
            assert_eq!(after, text);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!(found[0].code.id(), "CL0305");
        }
    }
}

#[test]
fn what_cannot_be_changed_is_said() {
    let codes = |text: &str, parameters: &str| {
        let (after, found) = apply(&step(parameters), text);
        assert_eq!(after, text);
        found.iter().map(|found| found.code.id()).collect::<Vec<_>>()
    };
    let parameters = "speed: { set: 900 }, feeds: keep";
    assert_eq!(codes("FEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0\nGOTO/1.0,0.0,0.0\n", parameters), ["CL0305"]);
    let cycle = "SPINDL/900,CLW\nCYCLE/TAP,DEPTH,10.0,RPM,500\nGOTO/0.0,0.0,0.0\n";
    assert_eq!(codes(cycle, parameters), ["CL0305"]);
    let nothing = "speed: { set: 900 }, feeds: keep, where: { operations: [C] }";
    assert_eq!(codes(TWO_TOOLS, nothing).len(), 1);
}

/// A program of operations with speeds, feeds and a tap, in all orders.
fn programs() -> impl Strategy<Value = String> {
    let speed = prop_oneof![
        (1u32..20_000).prop_map(|speed| format!("SPINDL/RPM,{speed},CLW\n")),
        (1u32..20_000).prop_map(|speed| format!("SPINDL/{speed}.0000,RPM,CCLW\n")),
        Just("SPINDL/ON\n".to_owned()),
        Just("SPINDL/OFF\n".to_owned()),
        Just("SPINDL/200,SMM,CLW\n".to_owned()),
    ];
    let feed = prop_oneof![
        (1u32..5000).prop_map(|feed| format!("FEDRAT/MMPM,{feed}.0000\n")),
        (1u32..50).prop_map(|feed| format!("FEDRAT/MMPR,0.{feed:02}00\n")),
    ];
    let line = prop_oneof![
        2 => speed,
        1 => feed,
        4 => (0i32..50).prop_map(|x| format!("GOTO/{x}.0000,0.0000,0.0000\n")),
        1 => (0i32..50).prop_map(|x| format!("RAPID\nGOTO/{x}.0000,0.0000,9.0000\n")),
        1 => (1u32..4).prop_map(|tool| format!("LOAD/TOOL,{tool}\n")),
        1 => Just("END-OF-PATH\nTOOL PATH/A,TOOL,MILL\n".to_owned()),
        1 => Just("END-OF-PATH\nTOOL PATH/B,TOOL,DRILL\n".to_owned()),
        1 => Just("CYCLE/TAP,RAPTO,3.0000,FEDTO,-5.0000,MMPM,200.0000\nGOTO/3.0000,0.0000,0.0000\nCYCLE/OFF\n".to_owned()),
    ];
    prop::collection::vec(line, 1..40).prop_map(|lines| format!("TOOL PATH/A,TOOL,MILL\n{}", lines.concat()))
}

fn filters() -> impl Strategy<Value = StatementFilter> {
    let texts = [
        "{}",
        "{ operations: [A] }",
        "{ operations: [B] }",
        "{ tools: [1] }",
        "{ operations: [A], tools: [2, DRILL] }",
    ];
    prop::sample::select(texts.to_vec()).prop_map(|text| serde_yaml::from_str(text).unwrap())
}

proptest! {
    #![proptest_config(support::property(256))]

    #[test]
    fn only_speeds_and_following_feeds_change_and_a_second_run_nothing(
        text in programs(),
        r#where in filters(),
        follow in any::<bool>(),
        limit in 1u32..15_000,
        set in any::<bool>(),
    ) {
        let limit = Positive::new(f64::from(limit)).unwrap();
        let speed = match set {
            true => SpindleSpeedChange::Set(limit),
            false => SpindleSpeedChange::Clamp(SpindleSpeedRange { min: None, max: Some(limit) }),
        };
        let feeds = if follow { SpindleFeedHandling::Follow } else { SpindleFeedHandling::Keep };
        let mut step = SetSpindle::new(speed, feeds);
        step.r#where = r#where;
        let (once, _) = run(&step, support::program(&text));
        let bytes = once.to_bytes();
        let kept = |program: &Program| {
            let others = program.live_statements().filter(|(_, statement)| match statement.record() {
                Record::Spindle(spindle) => spindle.speed.is_none(),
                Record::Feed(_) | Record::Cycle(_) => false,
                _ => true,
            });
            others.map(|(_, statement)| program.statement_text(statement).to_vec()).collect::<Vec<_>>()
        };
        prop_assert_eq!(kept(&support::program(&text)), kept(&support::program(&bytes)));
        let (twice, _) = run(&step, support::program(&bytes));
        prop_assert_eq!(String::from_utf8(twice.to_bytes()).unwrap(), String::from_utf8(bytes).unwrap());
        // Motions that are not meant have the speed and the feed that they had.
        if !follow {
            let feeds = |program: &Program| {
                let kept = program.motions().filter(|motion| motion.hole.is_none() && !motion.rapid);
                kept.map(|motion| motion.feed.map(|feed| feed.value)).collect::<Vec<_>>()
            };
            prop_assert_eq!(feeds(&support::program(&text)), feeds(&once));
        }
    }
}
