//! What lies around passes: nothing of it may become dangerous.

use super::{compensate, in_plane, operation};
use clsmith::program::motion::Motion;

fn refused(parameters: &str, text: &str) -> String {
    let Err(found) = compensate(parameters, text) else { panic!("not refused") };
    found.last().unwrap().message.clone()
}

/// An unmarked program of ball R5 passes.
fn unmarked(body: &str) -> String {
    format!(
        "TOOL PATH/A,TOOL,B\nTLDATA/MILL,10.0000,5.0000,60.0000,0.0000,0.0000\nRAPID\nGOTO/0.0000,0.0000,50.0000,0.0000000,0.0000000,1.0000000\nFEDRAT/MMPM,300.0000\n{body}RAPID\nGOTO/0.0000,0.0000,50.0000\nEND-OF-PATH\n"
    )
}

#[test]
fn a_slanted_lead_from_a_rapid_is_not_taken_for_the_part() {
    let text = unmarked(
        "RAPID\nGOTO/-3.0000,0.0000,4.0000\nGOTO/0.0000,0.0000,0.0000\nFEDRAT/MMPM,900.0000\nGOTO/60.0000,0.0000,0.0000\n",
    );
    assert!(refused("radius: 5", &text).contains("where this rapid ends"));
    // On level ground nothing has to move, so a rapid may end there.
    let level = unmarked("RAPID\nGOTO/0.0000,0.0000,0.0000\nGOTO/60.0000,0.0000,0.0000\n");
    assert_eq!(compensate("radius: 5", &level).unwrap().text, level);
}

#[test]
fn another_operation_is_not_touched() {
    let first = "TOOL PATH/A,TOOL,B\nTLDATA/MILL,10.0000,5.0000,60.0000,0.0000,0.0000\nRAPID\nGOTO/-1.0000,0.0000,4.0000,0.0000000,0.0000000,1.0000000\nEND-OF-PATH\n";
    let second = "TOOL PATH/B,TOOL,B\nTLDATA/MILL,10.0000,5.0000,60.0000,0.0000,0.0000\nPAINT/COLOR,31\nFEDRAT/MMPM,300.0000\nGOTO/0.0000,0.0000,0.0000\nGOTO/40.0000,0.0000,20.0000\nEND-OF-PATH\n";
    let message = refused("radius: 5, where: { operations: [B] }", &format!("{first}{second}"));
    assert!(message.contains("cannot move"), "{message}");
}

#[test]
fn a_wall_that_leans_by_a_printed_digit_is_a_wall() {
    for lean in [0.0, 0.0001, -0.0001] {
        let text = operation(&[vec![[0.0, 0.0, 20.0], [lean, 0.0, 0.0], [50.0, 0.0, 0.0]]]);
        let start = compensate("radius: 5", &text).unwrap().passes()[0][0];
        assert!((start.x - 5.0).abs() < 2e-3 && start.z > -1e-3, "{lean}: {start}");
    }
}

#[test]
fn a_pass_that_turns_back_is_refused_there() {
    let back = operation(&[vec![[0.0, 0.0, 0.0], [50.0, 0.0, 20.0], [0.0, 0.0, 0.0]]]);
    assert!(refused("radius: 5", &back).contains("turns back"));
    let levels = operation(&[vec![[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [50.0, 0.0, -2.0], [0.0, 0.0, -2.0]]]);
    assert!(refused("radius: 5", &levels).contains("turns back"));
}

#[test]
fn cuts_that_are_left_out_keep_their_place() {
    let text = unmarked(
        "GOTO/0.0000,0.0000,0.0000\nFEDRAT/MMPM,900.0000\nGOTO/50.0000,0.0000,20.0000\nFEDRAT/MMPM,500.0000\nGOTO/50.0000,1.0000,20.0000\nGOTO/0.0000,1.0000,20.0000\n",
    );
    assert!(refused("radius: 5, where: { feed: { min: 800 } }", &text).contains("leaves it out"));
}

#[test]
fn centres_take_everything_around_along() {
    let ridge = [(0.0, 0.0), (40.0, 0.0), (50.0, 20.0), (60.0, 0.0), (100.0, 0.0)];
    let text = operation(&[in_plane(&ridge, [0.0, 0.0], 0.0), in_plane(&ridge, [0.0, 1.0], 0.0)]);
    let done = compensate("radius: 5, output: centre", &text).unwrap();
    let rapids: Vec<f64> =
        done.program.motions().filter(|motion| motion.rapid).map(|motion| motion.to.point.z).collect();
    assert!(rapids.iter().all(|z| (z - 65.0).abs() < 1e-9), "{rapids:?}");
}

#[test]
fn rapids_never_end_lower_and_home_stays() {
    let hills: Vec<(f64, f64)> =
        (0..=80).map(|i| f64::from(i) * 0.5).map(|u| (u, 4.0 * (u / 9.0).cos())).collect();
    let text = operation(&[in_plane(&hills, [0.0, 0.0], 0.0), in_plane(&hills, [0.0, 1.0], 0.0)]);
    let text = text.replace("END-OF-PATH", "GOHOME/40.0000,1.0000,100.0000\nEND-OF-PATH");
    let done = compensate("radius: 5", &text).unwrap();
    assert!(done.text.contains("GOHOME/40.0000,1.0000,100.0000"));
    let heights = |text: &str| -> Vec<f64> {
        let all: Vec<Motion> = crate::support::program(text).motions().collect();
        all.iter().filter(|motion| motion.rapid).map(|motion| motion.to.point.z).collect()
    };
    let (before, after) = (heights(&text), heights(&done.text));
    assert_eq!(before.len(), after.len());
    assert!(before.iter().zip(&after).all(|(before, after)| after >= before), "{before:?} {after:?}");
}

#[test]
fn two_levels_in_one_plane_are_two_passes() {
    let text =
        operation(&[vec![[0.0, 0.0, 0.0], [50.0, 0.0, 0.0]], vec![[0.0, 0.0, -2.0], [50.0, 0.0, -2.0]]]);
    let done = compensate("radius: 5", &text).unwrap();
    assert_eq!((done.report.passes.len(), done.text.as_str()), (2, text.as_str()));
}

#[test]
fn a_remark_outlives_its_point() {
    let text = operation(&[vec![[0.0, 0.0, 0.0], [25.0, 0.0, 0.0], [50.0, 0.0, 0.0]]])
        .replace("GOTO/25.0000,0.0000,0.0000\n", "GOTO/25.0000,0.0000,0.0000 $$ check here\n");
    let done = compensate("radius: 5", &text).unwrap();
    assert!(done.text.contains("$$ check here") && !done.text.contains("GOTO/25.0000"), "{}", done.text);
}
