//! What a motion is for: marked in the file, else told by rapid, axis and direction.

use crate::support::{clean_motions, program, program_of};
use clsmith::program::MotionClass::{self, Approach, Cut, Engage, Rapid, Retract, StepOver};
use clsmith::program::{Dialect, Program};

fn classes(program: &Program) -> Vec<MotionClass> {
    clean_motions(program).into_iter().map(|motion| motion.class).collect()
}

#[test]
fn nx_colours_are_classes() {
    let line = |color: u32, rapid: bool, x: u32| {
        format!("PAINT/COLOR,{color}\n{}GOTO/{x},0,0\n", if rapid { "RAPID\n" } else { "" })
    };
    let text = [
        line(186, true, 0),
        line(211, true, 1),
        line(42, false, 2),
        line(31, false, 3),
        line(36, false, 4),
        line(37, false, 5),
        line(37, true, 6),
    ]
    .concat();
    let found = clean_motions(&program(&text));
    assert_eq!(classes(&program(&text)), [Approach, Rapid, Engage, Cut, StepOver, Retract, Retract]);
    assert!(found.iter().all(|motion| motion.class_is_stated));
}

#[test]
fn a_colour_stays_until_the_next_or_the_end_of_the_path() {
    let text = "TOOL PATH/A,TOOL,T\nPAINT/COLOR,36\nGOTO/0,0,0\nGOTO/1,0,0\nPAINT/COLOR,99\nGOTO/2,0,0\nPAINT/COLOR,36\nEND-OF-PATH\nTOOL PATH/B,TOOL,T\nGOTO/3,0,0\n";
    assert_eq!(classes(&program(text)), [StepOver, StepOver, Cut, Cut]);
}

#[test]
fn a_rapid_never_cuts_and_a_feed_move_is_never_rapid_whatever_the_colour() {
    let text = "GOTO/0,0,0\nPAINT/COLOR,31\nRAPID\nGOTO/1,0,0\nPAINT/COLOR,42\nRAPID\nGOTO/2,0,0\nPAINT/COLOR,211\nGOTO/3,0,0\n";
    let found = clean_motions(&program(text));
    assert_eq!(found.iter().map(|motion| motion.class).collect::<Vec<_>>()[1..], [Rapid, Rapid, Cut]);
    assert!(found[1..].iter().all(|motion| !motion.class_is_stated));
}

#[test]
fn without_marks_the_direction_along_the_axis_tells() {
    let text = "GOTO/0,0,10\nGOTO/0,0,0\nGOTO/5,0,0\nGOTO/5,0,10\nRAPID\nGOTO/5,0,50\nGOTO/8,0,10\n";
    assert_eq!(classes(&program(text))[1..], [Engage, Cut, Retract, Rapid, Cut]);
    // Along a tilted axis as well; a ramp is a cut.
    let tilted = "GOTO/0,0,0,0,0.6,0.8\nGOTO/0,-6,-8\nGOTO/0,0,0\nGOTO/0,0,-8\n";
    assert_eq!(classes(&program(tilted))[1..], [Engage, Retract, Cut]);
}

#[test]
fn makino_labels_its_motions_in_pprint() {
    let fixture = crate::support::fixture("makino-ff/scan-cut.cldata");
    let found = classes(&fixture);
    assert_eq!(found[1..], [Rapid, Rapid, Engage, Cut, Cut, Cut, Cut, StepOver, Cut, Retract, Rapid]);
    // FEDRAT and SPINDL labels are about other things.
    let text = "PPRINT/MOTION,CUT,TYPE,SCAN-CUT\nPPRINT/MOTION,CUTIN,FEDRAT,DEFAULT\nPPRINT/MOTION,RAPID,SPINDL,DEFAULT\nGOTO/0,0,0\n";
    assert_eq!(classes(&program_of(Dialect::MakinoFf, text)), [Cut]);
}

#[test]
fn clt_marks_its_leads_and_a_link_starts_the_next_pass() {
    let text = "GOTO/ 0,0,0 \nMOVE_ATTRIB/ LEADIN,END_ATTRIB \nGOTO/ 1,0,0 \nMOVE_ATTRIB/ LEADOUT,END_ATTRIB \nGOTO/ 2,0,0 \nMOVE_ATTRIB/ LINK,END_ATTRIB \nGOTO/ 3,0,0 \n";
    assert_eq!(classes(&program_of(Dialect::CamWorks, text))[1..], [Engage, Retract, Cut]);
}
