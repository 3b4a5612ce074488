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
    assert_eq!(tap("TAP M12", "56.0000"), 0);
}
