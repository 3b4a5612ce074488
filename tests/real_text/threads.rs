//! Taps and threads, whose feed is their pitch times the spindle speed.

use super::{HALF, alarms, apply, assert_near, findings, read, totals};
use crate::transform::apply as apply_with_findings;

const NX: &str = "TOOL PATH/A,TOOL,EM\nTLDATA/MILL,10.,0.,75.,0.,0.\nLOAD/TOOL,1\nSPINDL/RPM,1000,CLW\nFEDRAT/MMPM,900.0000\n\
    GOTO/0,0,0\nGOTO/9,0,0\nEND-OF-PATH\n\
    TOOL PATH/B,TOOL,TAP\nTLDATA/DRILL,MILL,8.,0.,75.,118.,40.\nLOAD/TOOL,2\nSPINDL/RPM,320,CLW\n\
    CYCLE/TAP,RAPTO,5.,FEDTO,-17.,MMPM,560.0000\nGOTO/0,0,0\nGOTO/9,0,0\nCYCLE/OFF\nEND-OF-PATH\n";

const THREAD: &str = "TOOL PATH/C,TOOL,TH\nLOAD/TOOL,3\nSPINDL/RPM,500,CLW\nFEDRAT/MMPR,0.2000\nRAPID\nGOTO/4.,29.,0.\n\
    PITCH/2.0000\nTHREAD/TURN\nGOTO/-25.,29.,0.\nTHREAD/OFF\nGOTO/-25.,34.,0.\nEND-OF-PATH\n";

#[test]
fn steps_that_change_feeds_leave_threads_alone_and_say_so() {
    for steps in [HALF, "  - clamp_feed: { max: 450 }\n"] {
        let (text, found) = apply_with_findings(steps, NX);
        assert_eq!(text, NX.replace("900.0000", "450.0000"));
        let kept: Vec<_> = found.iter().filter(|found| found.code.to_string() == "CL0309").collect();
        assert_eq!(kept.len(), 1, "{found:?}");
        assert!(kept[0].message.starts_with("2 tapped holes were left alone"), "{}", kept[0].message);
    }
    let (text, found) = apply_with_findings(HALF, THREAD);
    assert_eq!(text, THREAD.replace("0.2000", ".1"));
    assert!(found.iter().any(|found| found.message.starts_with("1 thread pass was left alone")), "{found:?}");
}

#[test]
fn a_feed_before_a_tap_comes_back_for_the_tap() {
    let text = "UNITS/MM\nCUTTER/8\nLOADTL/1\nSPINDL/RPM,500,CLW\nFEDRAT/MMPM,500.0\nGOTO/0,0,5\nGOTO/9,0,5\nCYCLE/TAP,10.,2.\n\
                GOTO/9,0,0\nCYCLE/OFF\n";
    let halved = apply(HALF, text);
    assert!(halved.contains("FEDRAT/MMPM,250.0\nGOTO/0,0,5"), "{halved}");
    assert!(halved.contains("FEDRAT/MMPM,500.0\nGOTO/9,0,0"), "{halved}");
}

#[test]
fn a_step_that_parts_feed_and_speed_of_a_tap_is_told() {
    let slower =
        "  - rewrite: { rules: [ { match: 'SPINDL/RPM,320,CLW', replace: 'SPINDL/RPM,160,CLW' } ] }\n";
    let (_, found) = apply_with_findings(slower, NX);
    let parted: Vec<_> = found.iter().filter(|found| found.code.to_string() == "CL0315").collect();
    assert_eq!(parted.len(), 1, "{found:?}");
    assert!(parted[0].message.contains("1.75 mm per revolution become 3.5"), "{}", parted[0].message);
    let other =
        "  - rewrite: { rules: [ { match: 'SPINDL/RPM,1000,CLW', replace: 'SPINDL/RPM,160,CLW' } ] }\n";
    let (_, found) = apply_with_findings(other, NX);
    assert!(found.iter().all(|found| found.code.to_string() != "CL0315"), "{found:?}");
}

#[test]
fn a_thread_runs_at_its_pitch_times_the_speed() {
    assert_eq!(findings(THREAD, true).iter().filter(|(code, _)| code == "CL0150").count(), 0);
    let (feed, rapid, seconds) = totals(&read(THREAD));
    assert_eq!((feed, rapid), (34.0, 0.0));
    assert_near("thread and retract", seconds, 29.0 / 1000.0 * 60.0 + 5.0 / 100.0 * 60.0);
}

#[test]
fn a_tap_needs_no_feed() {
    let text = "UNITS/MM\nCUTTER/8\nLOADTL/1\nSPINDL/RPM,500,CLW\nRAPID\nGOTO/0,0,5\nCYCLE/TAP,10.,2.\nGOTO/9,0,0\nCYCLE/OFF\n";
    assert_eq!(alarms(text), []);
    assert_eq!(alarms(text.replace("TAP", "DRILL")), [("CL0120".to_owned(), 8)]);
}

#[test]
fn g99_comes_back_to_the_clearance() {
    let text = |plane: &str| {
        format!(
            "UNITS/ MM \nBOX/ 0.,80.,0.,50.,-15.,0. \nCUTTER/ 5.000000,\nRAPID/ \nGOTO/ 0.,0.,40. \nCYCLE/ ON \n\
             CYCLE/ DRILL,{plane},12.000000,MMPM,150.000000,2.000000,40.000000 40.000000 DWELL,0.000000 \n\
             GOTO/ 0.,0.,0. \nGOTO/ 25.,0.,0. \nCYCLE/ OFF \nRAPID/ \nGOTO/ 25.,0.,40. \nFINI \n"
        )
    };
    assert_eq!(totals(&read(text("G99"))).1, 38.0 + 14.0 + 25.0 + 14.0 + 38.0);
    assert_eq!(totals(&read(text("G98"))).1, 38.0 + 52.0 + 25.0 + 38.0 + 52.0);
    assert_eq!(findings(text("G99"), true).iter().filter(|(code, _)| code == "CL0170").count(), 1);
}

#[test]
fn a_cycle_that_clears_is_no_cycle() {
    let text = "UNITS/MM\nCUTTER/8\nLOADTL/1\nSPINDL/RPM,500,CLW\nGOTO/0,0,5\nCYCLE/CLEAR\nCYCLE/DRILL,FEDTO,9.,MMPM,240.,RAPTO,2.\n\
                GOTO/9,0,0\nCYCLE/OFF\n";
    assert_eq!(findings(text, true), []);
}

#[test]
fn a_step_changes_threads_where_it_asks_for_them_by_name() {
    let asked = "  - scale_feed: { factor: 0.5, where: { threads: true } }\n";
    let (text, found) = apply_with_findings(asked, NX);
    assert_eq!(text, NX.replace("560.0000", "280.0000"));
    assert!(found.iter().all(|found| found.code.to_string() != "CL0309"), "{found:?}");
    // The pitch is another one now, and that is told.
    assert!(found.iter().any(|found| found.code.to_string() == "CL0315"), "{found:?}");

    let left_out = "  - scale_feed: { factor: 0.5, where: { threads: false } }\n";
    let (text, found) = apply_with_findings(left_out, NX);
    assert_eq!(text, NX.replace("900.0000", "450.0000"));
    assert!(found.iter().all(|found| found.code.to_string() != "CL0309"), "nothing was to be left alone");
}

#[test]
fn a_tap_whose_feed_does_not_fit_its_name_is_told_once() {
    let tap = |name: &str, feed: &str| {
        let text = NX.replace("TOOL PATH/B,TOOL,TAP", &format!("TOOL PATH/B,TOOL,{name}"));
        alarms(text.replace("560.0000", feed)).into_iter().filter(|(code, _)| code == "CL0137").count()
    };
    assert_eq!(tap("TAP M12x1.75", "560.0000"), 0);
    assert_eq!(tap("TAP M12x1.5", "560.0000"), 1);
    assert_eq!(tap("TAP M12x1.75", "56.0000"), 1);
    // A name without a pitch means the coarse one.
    assert_eq!(tap("TAP M12", "560.0000"), 0);
    assert_eq!(tap("TAP M12", "56.0000"), 1);
    assert_eq!(tap("1/2-13 UNC", "560.0000"), 1);
    assert_eq!(tap("1/2-13 UNC", "625.2300"), 0);
}

/// The messages of CL0137 with their lines.
fn parted(text: &str) -> Vec<(String, usize)> {
    let source = crate::support::text(text);
    let (_, found) = clsmith::check::read_and_check(&source, None);
    let found = found.iter().filter(|found| found.code.to_string() == "CL0137");
    let line = |at: u32| source.bytes()[..at as usize].iter().filter(|byte| **byte == b'\n').count() + 1;
    found.map(|found| (found.message.clone(), line(found.labels[0].span.start))).collect()
}

#[test]
fn a_speed_that_changes_inside_a_taps_cycle_is_told() {
    let text = NX.replace(
        "GOTO/0,0,0\nGOTO/9,0,0\nCYCLE/OFF",
        "GOTO/0,0,0\nSPINDL/RPM,160,CLW\nGOTO/9,0,0\nCYCLE/OFF",
    );
    let found = parted(&text);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].0.contains("1.75 mm per revolution become 3.5") && found[0].1 == 15, "{found:?}");
    // A feed per revolution follows by itself.
    assert_eq!(parted(&text.replace("MMPM,560.0000", "MMPR,1.7500")), []);
}

#[test]
fn one_tap_cuts_one_pitch() {
    let tap = |feed: &str| {
        format!("CYCLE/TAP,RAPTO,5.,FEDTO,-17.,MMPM,{feed}\nGOTO/20,0,0\nCYCLE/OFF\nEND-OF-PATH\n")
    };
    let twice = |feed: &str| NX.replace("CYCLE/OFF\nEND-OF-PATH\n", &format!("CYCLE/OFF\n{}", tap(feed)));
    assert_eq!(parted(&twice("560.0000")), []);
    let found = parted(&twice("400.0000"));
    assert!(found.len() == 1 && found[0].0.contains("has cut a pitch of 1.75 mm before"), "{found:?}");
    // The cycle's own pitch, and a FEDRAT inside it.
    let stated = NX.replace("CYCLE/TAP,", "CYCLE/TAP,PITCH,1.5,");
    assert!(parted(&stated)[0].0.contains("the cycle states a pitch of 1.5 mm"), "{:?}", parted(&stated));
    let inner = |feed: &str| NX.replace("MMPM,560.0000\n", &format!("MMPM,560.0000\nFEDRAT/MMPM,{feed}\n"));
    assert_eq!(parted(&inner("560.0")), []);
    assert!(
        parted(&inner("400.0"))[0].0.contains("this FEDRAT makes 1.25 mm"),
        "{:?}",
        parted(&inner("400.0"))
    );
}

#[test]
fn names_in_other_records_tell_the_pitch() {
    let text = |name: &str, load: &str| {
        format!(
            "UNITS/MM\n{name}CUTTER/8.,0,4.,0,0,0,60.\n{load}\nSPINDL/400,RPM,CLW\nGOTO/0,0,5\n\
             CYCLE/TAP,FEDTO,9.,MMPM,400.,RAPTO,2.\nGOTO/9,0,0\nCYCLE/OFF\nFINI\n"
        )
    };
    for (name, load) in [
        ("INSERT/M10x1.5 TAP HSS\n", "LOAD/TOOL,3"),
        ("INSERT/TAP M10\n", "LOAD/TOOL,3"),
        ("TPRINT/T3 Tap M 10 x 1.5\n", "LOADTL/3"),
        ("", "LOAD/TOOL,3,'TAP 1/4-20'"),
        ("", "LOADTL/'TAP M8'"),
    ] {
        assert_eq!(parted(&text(name, load)).len(), 1, "{name}{load}");
    }
    for (name, load) in
        [("INSERT/M6x1 TAP\n", "LOAD/TOOL,3"), ("INSERT/Stock Size X440. Y170. Z30.\n", "LOAD/TOOL,3")]
    {
        assert_eq!(parted(&text(name, load)), [], "{name}{load}");
    }
    // The name belongs to the tool that is loaded behind it, and not to the next one.
    let next = text("INSERT/M10x1.5 TAP\n", "LOAD/TOOL,3").replace("SPINDL", "LOAD/TOOL,4\nSPINDL");
    assert_eq!(parted(&next), []);
}

#[test]
fn a_feed_that_repeats_that_of_a_taps_cycle_follows_the_speed() {
    let text = NX.replace("MMPM,560.0000\n", "MMPM,560.0000\nFEDRAT/MMPM,560.0000\n");
    let slower = "  - set_spindle: { speed: { scale: 0.5 }, feeds: keep }\n";
    let after = apply(slower, &text);
    assert!(after.contains("MMPM,280.0000\nFEDRAT/MMPM,280.0000\n"), "{after}");
    assert!(after.contains("FEDRAT/MMPM,900.0000"), "other feeds keep their numbers: {after}");
    assert_eq!(parted(&after), []);
    let per_turn = NX.replace("MMPM,560.0000\n", "MMPM,560.0000\nFEDRAT/MMPR,1.7500\n");
    assert!(apply(slower, &per_turn).contains("MMPM,280.0000\nFEDRAT/MMPR,1.7500\n"));
}

#[test]
fn pitches_in_all_their_forms_make_the_feed() {
    let seconds = |pitch_mm: f64| 29.0 / (pitch_mm * 500.0) * 60.0 + 5.0 / 100.0 * 60.0;
    for (records, pitch_mm) in [
        ("PITCH/LEAD,1.5\nTHREAD/TURN", 1.5),
        ("PITCH/1.5,LEAD\nTHREAD/TURN", 1.5),
        ("PITCH/TPI,16\nTHREAD/TURN", 25.4 / 16.0),
        ("PITCH/16,TPI\nTHREAD/TURN", 25.4 / 16.0),
        ("THREAD/TURN,LEAD,1.5", 1.5),
        ("THREAD/TURN,TPI,20", 1.27),
    ] {
        let text = THREAD.replace("PITCH/2.0000\nTHREAD/TURN", records);
        assert_near(records, totals(&read(&text)).2, seconds(pitch_mm));
    }
    // A pitch that only the post understands leaves the time open, whatever pitch and feed came before.
    let grows = THREAD.replace("PITCH/2.0000\n", "PITCH/2.0000\nPITCH/0.5,INCR,0.1\n");
    assert_eq!(read(&grows).motions().find(|motion| motion.cuts_thread).unwrap().feed, None);
    let inch =
        apply("  - convert_units: { from: mm, to: inch }\n", THREAD.replace("PITCH/2.0000", "PITCH/TPI,16"));
    assert!(inch.contains("PITCH/TPI,16\n"), "{inch}");
}

#[test]
fn the_pitch_of_a_cycle_is_no_depth() {
    for (pitch, pitch_mm) in [("PITCH,1.5", 1.5), ("LEAD,1.5", 1.5), ("TPI,20", 1.27)] {
        let text = format!(
            "UNITS/MM\nCUTTER/8\nLOADTL/1\nSPINDL/RPM,500,CLW\nRAPID\nGOTO/0,0,5\nCYCLE/TAP,{pitch},DEPTH,10.,CLEAR,2.\n\
             GOTO/9,0,0\nCYCLE/OFF\n"
        );
        let (feed, _, seconds) = totals(&read(&text));
        assert_near(pitch, feed, 24.0);
        assert_near(pitch, seconds, 24.0 / (pitch_mm * 500.0) * 60.0);
        assert_eq!(alarms(&text), [], "{pitch}");
    }
    // Also where depth and clearance have no words, and a speed stands among them.
    let bare = "UNITS/MM\nCUTTER/8\nLOADTL/1\nSPINDL/RPM,500,CLW\nRAPID\nGOTO/0,0,5\nCYCLE/TAP,TPI,20,RPM,500,10.,2.\nGOTO/9,0,0\n";
    assert_near("bare", totals(&read(bare)).0, 24.0);
}

#[test]
fn taps_without_a_feed_are_counted_among_those_left_alone() {
    let text = NX.replace(",MMPM,560.0000", "").replace("FEDRAT/MMPM,900.0000\n", "");
    let text = format!("{text}FEDRAT/MMPM,300.0000\nGOTO/50,0,0\n");
    let (after, found) = apply_with_findings(HALF, &text);
    assert!(after.contains("FEDRAT/MMPM,150.0000"), "{after}");
    assert!(
        found.iter().any(|found| found.message.starts_with("2 tapped holes were left alone")),
        "{found:?}"
    );
}

#[test]
fn a_tap_may_be_an_option_of_its_cycle() {
    for cycle in ["RIGID,TAP", "DEEP,TAP", "DRILL,TAP", "TAP,RIGID"] {
        let text = NX.replace("CYCLE/TAP", &format!("CYCLE/{cycle}"));
        assert!(!text.contains("CYCLE/TAP,RAPTO"), "{cycle}");
        let changed = apply(HALF, &text);
        assert!(changed.contains("FEDTO,-17.,MMPM,560.0000"), "{cycle}: {changed}");
        assert_near(cycle, totals(&read(&text)).0, totals(&read(NX)).0);
        assert_eq!(alarms(&text), alarms(NX), "{cycle}");
    }
    // A thread that is milled runs at the feed of the mill.
    let milled = NX.replace("CYCLE/TAP", "CYCLE/MILL,THREAD");
    assert!(apply(HALF, &milled).contains("MMPM,280.0000"), "{}", apply(HALF, &milled));
}

#[test]
fn a_number_of_a_thread_without_a_word_leaves_its_time_open() {
    let bare = THREAD.replace("PITCH/2.0000\nTHREAD/TURN", "THREAD/TURN,1.5");
    assert_eq!(read(&bare).motions().find(|motion| motion.cuts_thread).unwrap().feed, None);
    // It takes nothing from a pitch that the file states.
    let stated = THREAD.replace("THREAD/TURN", "THREAD/TURN,1");
    assert_eq!(totals(&read(&stated)), totals(&read(THREAD)));
}
