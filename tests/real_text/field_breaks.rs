//! Lines that are broken behind a field, in a column where CATIA breaks full lines anywhere.

use super::{MOVE, TO_INCH, alarms, apply, read};
use clsmith::program::Record;

const NX: &str = "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,0.0000,80.0000,0.0000,0.0000\nLOAD/TOOL,1\n\
    SPINDL/RPM,1000,CLW\nFEDRAT/MMPM,100.0000\nGOTO/910.0000,-1900.0000,-123.4567\n";

/// An NX program with an arc whose first line has so many bytes, with its `$`.
fn nx_arc(bytes: usize) -> String {
    let circle = "CIRCLE/900.0000,-1900.0000,-123.4567,0.000000000,0.000000000,1.0000";
    let padding = "0".repeat(bytes - circle.len() - 2);
    format!(
        "{NX}{circle}{padding},$\n10.0000,0.0000,0.5000,10.0000,0.0000\nGOTO/900.0000,-1890.0000,-123.4567\nEND-OF-PATH\n"
    )
}

/// The moves that make the numbers shorter, as long and longer.
const MOVES: [&str; 4] = [
    "  - move_origin: { translate: [-899, 1899, 122] }\n",
    MOVE,
    "  - move_origin: { translate: [9900, -9900, -9900] }\n",
    TO_INCH,
];

/// Checks that every line that goes on ends behind a comma, as in a file that breaks no number.
#[track_caller]
fn assert_breaks_fields(text: &str, lines: usize) {
    assert_eq!(text.lines().count(), lines, "{text}");
    for line in text.lines().filter(|line| line.contains('$') && !line.starts_with("$$")) {
        let data = line.split('$').next().unwrap().trim_end();
        assert!(data.ends_with(','), "{line}\n{text}");
    }
}

#[test]
fn a_break_behind_a_field_stays_there_in_any_column() {
    for bytes in 69..=82 {
        let text = nx_arc(bytes);
        for (steps, end) in MOVES.into_iter().zip(["\n", "\r\n", "\n", "\n"]) {
            let moved = apply(steps, text.replace('\n', end));
            assert_breaks_fields(&moved, text.lines().count());
            assert_eq!(read(&moved).motions().count(), 2, "{moved}");
        }
    }
}

#[test]
fn creo_breaks_its_points_in_front_of_the_axis_in_any_column() {
    let head = "$$-> MFGNO / A\n$$-> CUTTER / 10.000000\nLOADTL / 1\nSPINDL / RPM, 900.000000, CLW\n\
                FEDRAT / 100.000000, MMPM\nGOTO / 0.0000000000, 0.0000000000, 50.0000000000\n";
    for blanks in 1..20 {
        let goto = format!(
            "GOTO / 912.1640937215, -871.2503418896, -933.5817460029,{}$\n0.9992386202, -0.0000004711, 0.0390151234\n",
            " ".repeat(blanks)
        );
        let text = format!("{head}{goto}FINI\n");
        for steps in MOVES {
            let moved = apply(steps, &text);
            assert_breaks_fields(&moved, text.lines().count());
            assert!(moved.contains("\n0.9992386202, -0.0000004711, 0.0390151234\n"), "{moved}");
        }
    }
}

/// A text is broken anywhere by whoever breaks it at all, also where no letter stands at the break.
#[test]
fn a_text_that_is_broken_at_a_blank_is_no_field() {
    let text = format!("{NX}PPRINT {} $\nEND OF IT\nEND-OF-PATH\n", "A".repeat(65));
    let changed =
        apply("  - rewrite: { rules: [ { match: 'PPRINT $...T', replace: 'PPRINT NOTE $...T' } ] }\n", &text);
    assert_eq!(read(&changed).statements().len(), read(&text).statements().len(), "{changed}");
    assert!(
        changed.replace("$\n", "").contains(&format!("NOTE {} END OF IT\n", "A".repeat(65))),
        "{changed}"
    );
}

/// Where lines have identifications, nothing may stand in their columns: the line is broken behind an earlier field.
#[test]
fn a_card_that_grows_is_broken_behind_a_field() {
    let card = |data: &str, behind: &str| format!("{data:<72}{behind}\n");
    let arc = "CIRCLE/900.0000,-900.0000,-123.4567,0.0000000,0.0000000,1.00000000,10.,$";
    assert_eq!(arc.len(), 72);
    let text = [
        card("PARTNO PLATE", "PT     1"),
        card("CUTTER/12.", "PT     2"),
        card("LOADTL/3", "PT     3"),
        card("SPINDL/RPM,1600,CLW", "PT     4"),
        card("FEDRAT/MMPM,420.", "PT     5"),
        card("GOTO/910.0000,-900.0000,-123.4567", "PT     6"),
        card(arc, "PT     7"),
        card("0.,.5,12.,0.", "PT     8"),
        card("GOTO/900.0000,-890.0000,-123.4567", "PT     9"),
        card("FINI", "PT    10"),
    ]
    .concat();
    assert_eq!(alarms(&text), []);
    let moved = apply(MOVES[2], &text);
    assert_breaks_fields(&moved, text.lines().count() + 1);
    assert!(
        moved.lines().all(|line| line.trim_end().len() <= 72 || line[72..].starts_with("PT ")),
        "{moved}"
    );
    assert_eq!(alarms(&moved), []);
    let radius = |text: &str| {
        read(text).statements().iter().find_map(|statement| match statement.record() {
            Record::Circle(arc) => Some(format!("{:?}", arc.radius)),
            _ => None,
        })
    };
    assert_eq!(radius(&moved), radius(&text));
    let shorter = apply(MOVES[0], &text);
    assert_breaks_fields(&shorter, text.lines().count());
    assert!(shorter.lines().all(|line| line[72..].starts_with("PT ")), "{shorter}");
}
