//! Two steps in one recipe write the same bytes as two runs with one step each.

use super::try_apply;
use crate::support;

/// Steps that change every kind of number; each stands alone in a recipe.
const STEPS: &[&str] = &[
    "  - scale_feed: { factor: 0.8 }\n",
    "  - clamp_feed: { min: 10, max: 500 }\n",
    "  - move_origin: { translate: [0.1234, -20, 3.5] }\n",
    "  - move_origin: { rotate: { axis: z, degrees: 30 } }\n",
    "  - convert_units: { from: mm, to: inch }\n",
    "  - move_origin: { mirror: { axis: x } }\n",
];

fn assert_composed(name: &str, text: &[u8]) -> usize {
    let mut compared = 0;
    for first in STEPS {
        let Ok((between, _)) = try_apply(&format!("version: 1\nunits: mm\nsteps:\n{first}"), text) else {
            continue;
        };
        for second in STEPS {
            let second_alone = format!("version: 1\nunits: mm\nsteps:\n{second}");
            let both = try_apply(&format!("version: 1\nunits: mm\nsteps:\n{first}{second}"), text);
            match (both, try_apply(&second_alone, &between)) {
                (Ok((together, _)), Ok((apart, _))) => {
                    assert_eq!(together, apart, "{name}: {first}{second}");
                    compared += 1;
                }
                (Err(_), Err(_)) => {}
                (together, apart) => panic!("{name}: {first}{second}{together:?} {apart:?}"),
            }
        }
    }
    compared
}

#[test]
fn two_steps_are_two_runs_in_every_dialect() {
    let mut compared = 0;
    for (_, path) in support::fixtures() {
        let text = std::fs::read(&path).unwrap();
        // What is no text of one byte a character would not come through `String` unchanged.
        if text.is_ascii() {
            compared += assert_composed(&path.to_string_lossy(), &text);
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn a_file_that_cuts_zeros_keeps_its_decimals_where_one_number_stays_untouched() {
    // All points but a short one are changed by the first step; the file's decimals are still four.
    let mut text =
        String::from("$$ SolidWorks\nUNITS/MM\nFEDRAT/100.5,MMPM\nGOTO/0,0,5\nGOTO/1.1234,2.2345,5\n");
    for row in 1..30 {
        text.push_str(&format!("GOTO/{row}.0625,{}.1234,-.5\n", row * 2));
    }
    assert!(assert_composed("solidworks", text.as_bytes()) > 10);
}
