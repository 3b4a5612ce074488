//! Identifications in columns 73 to 80: kept, never read, never moved.

use super::{HALF, MOVE, TO_INCH, alarms, apply, read, totals};

/// Lines with an identification in columns 73 to 80.
fn cards(lines: &[&str]) -> String {
    let card = |(index, line): (usize, &&str)| format!("{line:<72}PKT{:05}\n", (index + 1) * 10);
    lines.iter().enumerate().map(card).collect()
}

const LINES: &[&str] = &[
    "PARTNO POCKET",
    "UNITS/MM",
    "CUTTER/12.",
    "LOADTL/3",
    "SPINDL/RPM,1600,CLW",
    "FEDRAT/MMPM,420.",
    "RAPID",
    "GOTO/4.,-7.,25.",
    "GOTO/4.,-7.,-5.",
    "GOTO/4.,$",
    "     33.,-5.",
    "COOLNT/OFF",
    "FINI",
];

/// Checks that every line of a text has its identification in column 73.
fn assert_identified(text: &str) {
    for (index, line) in text.lines().enumerate() {
        assert_eq!(line.get(72..), Some(format!("PKT{:05}", (index + 1) * 10).as_str()), "{text}");
    }
}

#[test]
fn a_program_on_cards_reads_as_without_them() {
    let plain = LINES.join("\n");
    let text = cards(LINES);
    assert_eq!(alarms(&text), []);
    assert_eq!(totals(&read(&text)), totals(&read(&plain)));
    assert_eq!(totals(&read(&text)), (70.0, 0.0, 10.0));
}

#[test]
fn identifications_stay_in_their_columns_whatever_is_changed() {
    let text = cards(LINES);
    for steps in
        [HALF, MOVE, TO_INCH, "  - rewrite: { rules: [ { match: 'SPINDL/$...S', replace: 'SPINDL/ON' } ] }\n"]
    {
        let changed = apply(steps, &text);
        assert_ne!(changed, text);
        assert_identified(&changed);
        assert_eq!(alarms(&changed), []);
    }
}

#[test]
fn identifications_of_other_forms_stay_as_they_are() {
    let forms: [fn(usize) -> String; 6] = [
        |line| format!("{line:>8}"),
        |line| format!("{line:<8}"),
        |line| format!("  {line:>4}"),
        |line| format!("JOB-{line:03}."),
        |line| format!("A1B{line:05}"),
        |_| "POCKET".to_owned(),
    ];
    for behind in forms {
        let card = |(index, line): (usize, &&str)| format!("{line:<72}{}\r\n", behind(index + 1));
        let text: String = LINES.iter().enumerate().map(card).collect();
        assert_eq!(alarms(&text), [], "{text}");
        assert_eq!(totals(&read(&text)), (70.0, 0.0, 10.0));
        assert_eq!(apply(HALF, &text), text.replace("420.", "210."));
        for steps in [MOVE, TO_INCH] {
            let changed = apply(steps, &text);
            let columns = |text: &str| text.lines().map(|line| line[72..].to_owned()).collect::<Vec<_>>();
            assert_eq!(columns(&changed), columns(&text), "{changed}");
        }
    }
}

#[test]
fn catia_numbers_its_points_behind_a_break_too() {
    let line = |data: &str, behind: &str| format!("{data:<72}{behind}\r\n");
    let text = [
        line("$$     CATIA APT VERSION 1.0", ""),
        line("FEDRAT/  560.0000,MMPM", ""),
        line("GOTO  /   18.00000,   12.50000,   -6.00000", "PT     4"),
        line("INDIRV/    1.00000,    0.00000,    0.00000", ""),
        line("TLON,GOFWD/      (CIRCLE/     18.00000,     22.50000,     -6.00000,$", "CIR    1"),
        line("      10.00000),ON,(LINE/     18.00000,     22.50000,     -6.00000,$", "CIR    2"),
        line("                              28.00000,     22.50000,     -6.00000)", ""),
        line("FINI", ""),
    ]
    .concat();
    let (feed, _, _) = totals(&read(&text));
    super::assert_near("a quarter of a circle", feed, 15.708);
    let moved = apply(MOVE, &text);
    for (before, after) in text.lines().zip(moved.lines()) {
        assert_eq!(before.get(72..), after.get(72..), "{moved}");
    }
}
