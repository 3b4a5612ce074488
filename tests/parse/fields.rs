//! Words and the fields after them, as each dialect writes them.

use clsmith::parse::syntax;
use clsmith::program::{FieldKind, StatementKind};

/// The fields of a line as text, numbers marked with `#`, groups with their word.
fn shown(line: &str) -> (String, Vec<String>) {
    let line = syntax(line.as_bytes());
    assert_eq!(line.form, StatementKind::Words, "{line:?}");
    let show = |field: &clsmith::program::StatementField| {
        let text = String::from_utf8_lossy(line.bytes_at(&field.at)).into_owned();
        match &field.kind {
            FieldKind::Number(value) => format!("#{value}"),
            FieldKind::Group(group) => format!("({})", String::from_utf8_lossy(line.bytes_at(&group.word))),
            _ => text,
        }
    };
    (line.major_word().into_owned(), line.fields.iter().map(show).collect())
}

#[track_caller]
fn assert_fields(line: &str, major: &str, fields: &[&str]) {
    let (found, found_fields) = shown(line);
    assert_eq!((found.as_str(), found_fields), (major, fields.iter().map(|&f| f.to_owned()).collect()));
}

#[test]
fn empty_arguments_keep_their_place() {
    assert_fields("ROTABL/    0.000000,,TABLE,CLW", "ROTABL", &["#0", "", "TABLE", "CLW"]);
    assert_fields("COOLNT/\n", "COOLNT", &[""]);
    assert_fields("RAPID/ ", "RAPID", &[""]);
    assert_fields("ON/,,NOTE", "ON", &["", "", "NOTE"]);
    assert_fields("CUTTER/ 6.0,0.0,\n", "CUTTER", &["#6", "#0", ""]);
}

#[test]
fn a_bare_word_has_no_field() {
    for word in ["RAPID", "RAPID ", "FINI \r\n", "MULTAX", "NURBS", "AUTOPS\n"] {
        assert_fields(word, word.trim_end(), &[]);
    }
}

#[test]
fn blanks_around_the_slash_and_commas_do_not_matter() {
    assert_fields("GOTO  /   17.00000,    0.00000,    2.00000", "GOTO", &["#17", "#0", "#2"]);
    assert_fields("FEDRAT / 10.000000,  IPM", "FEDRAT", &["#10", "IPM"]);
    assert_fields("SPINDL/  500.0000,RPM, CLW", "SPINDL", &["#500", "RPM", "CLW"]);
    assert_fields("SPINDL/RPM,1000,CLW \n", "SPINDL", &["RPM", "#1000", "CLW"]);
    assert_fields("\tGOTO\t/\t1 ,\t2\t,3", "GOTO", &["#1", "#2", "#3"]);
}

#[test]
fn a_word_that_starts_with_a_digit_is_no_number() {
    // SolidWorks: a reader that takes the digits makes a peck of 1 mm out of one of 5 mm.
    assert_fields(
        "CYCLE/DEEP2,FEDTO,28.6019,1STPECK,5.,SUBPECK,2.",
        "CYCLE",
        &["DEEP2", "FEDTO", "#28.6019", "1STPECK", "#5", "SUBPECK", "#2"],
    );
    assert_fields("PPWORD/3DCOMP,1101", "PPWORD", &["3DCOMP", "#1101"]);
    assert_fields("INSERT2/16MM X 90DEG", "INSERT2", &["16MM X 90DEG"]);
    assert_fields("MACHIN/1.5.2,12-3,1E,0X1", "MACHIN", &["1.5.2", "12-3", "1E", "0X1"]);
}

#[test]
fn words_may_hold_blanks_dashes_and_underscores() {
    assert_fields("END-OF-PATH\n", "END-OF-PATH", &[]);
    assert_fields("CSI_SET_FLUTE_LENGTH/4.", "CSI_SET_FLUTE_LENGTH", &["#4"]);
    assert_fields("MOVE_ATTRIB/ LEADIN,END_ATTRIB ", "MOVE_ATTRIB", &["LEADIN", "END_ATTRIB"]);
    assert_fields("  csys / 1,2", "CSYS", &["#1", "#2"]);
}

#[test]
fn a_missing_comma_leaves_the_fields_apart() {
    // CAMWorks: one field `43.518204 43.518204 DWELL` would lose two lengths.
    assert_fields(
        "CYCLE/ DRILL,G98,11.846500,MMPM,203.471650,3.000000,43.518204 43.518204 DWELL,0.000000 ",
        "CYCLE",
        &["DRILL", "G98", "#11.8465", "MMPM", "#203.47165", "#3", "#43.518204", "#43.518204", "DWELL", "#0"],
    );
    assert_fields("CYCLE/ CDRILL G98,2.0", "CYCLE", &["CDRILL G98", "#2"]);
}

#[test]
fn catia_nests_records_in_a_drive_record() {
    let tlon = "TLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,     -0.20000,$\n      43.20718),ON,2,INTOF,$\n                   (LINE/      0.00000,      0.00000,     -0.20000,$\n                             -41.91057,    -10.50548,     -0.20000)\n";
    assert_fields(tlon, "TLON,GOFWD", &["(CIRCLE)", "ON", "#2", "INTOF", "(LINE)"]);
    let numbers: Vec<f64> = syntax(tlon.as_bytes()).numbers().into_iter().map(|(_, value)| value).collect();
    assert_eq!(numbers, [0.0, 0.0, -0.2, 43.20718, 2.0, 0.0, 0.0, -0.2, -41.91057, -10.50548, -0.2]);
}

#[test]
fn number_places_are_exact_so_that_a_patch_changes_the_number_and_nothing_else() {
    let line = syntax(b"  GOTO  /  -0.0000 ,+1.5,.25$ c\n, 1E3 $$ 7\n");
    let found: Vec<_> = line.numbers().into_iter().map(|(at, _)| line.bytes_at(&at)).collect();
    assert_eq!(found, [&b"-0.0000"[..], b"+1.5", b".25", b"1E3"]);
}
