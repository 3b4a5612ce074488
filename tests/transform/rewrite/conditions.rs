//! `if`.

use super::{rules, shown, stopped};
use crate::transform::apply;

/// Whether a condition on `A/$X,$Y` holds for arguments.
#[track_caller]
fn holds(condition: &str, arguments: &str) -> bool {
    let rule = format!("match: 'A/$X,$Y', if: {}, delete: true", serde_json::to_string(condition).unwrap());
    let (text, findings) = apply(&rules(&[&rule]), format!("A/{arguments}\n"));
    assert!(findings.is_empty(), "{findings:?}");
    text.is_empty()
}

#[test]
fn numbers_are_compared_by_value() {
    for (condition, expected) in [
        ("$X < $Y", true),
        ("$X <= 1.000", true),
        ("$X >= 1.0001", false),
        ("$X > .5", true),
        ("$X == 1", true),
        ("$X != 1.0", false),
        ("X < Y", true),
        ("$X<$Y", true),
    ] {
        assert_eq!(holds(condition, "1.00,2"), expected, "{condition}");
    }
}

#[test]
fn words_are_compared_without_case() {
    assert!(holds("$X == 'mmpm'", "MMPM,1"));
    assert!(holds("$X != 'IPM' and $Y == 1", "MMPM,1"));
    assert!(holds("$X == 'it  is'", "'It is',1"));
    assert!(!holds("$X == 1", "MMPM,1"));
    assert!(holds("$X != 1", "MMPM,1"));
    assert!(holds("$X == $Y", "ON,on"));
}

#[test]
fn arithmetic_and_logic_bind_as_everywhere() {
    for (condition, expected) in [
        ("1 + 2 * 3 == 7", true),
        ("(1 + 2) * 3 == 9", true),
        ("2 - 1 - 1 == 0", true),
        ("8 / 2 / 2 == 2", true),
        ("-$X + 2 == 1", true),
        ("- -1 == 1", true),
        ("-2 * -2 == 4", true),
        ("$X == 2 or $X == 1 and $Y == 5", false),
        ("$X == 1 or $X == 2 and $Y == 5", true),
        ("not $X == 2 and not ($Y == 3)", true),
        ("not not $X == 1", true),
        ("NOT $X == 2 AND $Y == 2", true),
        ("$X + $Y * 2 > 4.999 and $X / $Y == 0.5", true),
    ] {
        assert_eq!(holds(condition, "1,2"), expected, "{condition}");
    }
}

#[test]
fn what_cannot_be_calculated_stops_the_step_at_both_places() {
    let mut text = String::new();
    for (condition, arguments) in [("$X > 1", "MMPM,1"), ("1 / ($Y - 1) > 1", "1,1"), ("-$X < 2", "(B/1),2")]
    {
        let rule = format!("match: 'A/$X,$Y', if: \"{condition}\", delete: true");
        text += &shown(&stopped(&rules(&[&rule]), &format!("B\nA/{arguments}\n")));
    }
    let rule = "match: 'A/$X,$Y', replace: 'A/${X * 2},$Y'";
    text += &shown(&stopped(&rules(&[rule]), "A/B,1\n"));
    crate::support::snapshots("rewrite").bind(|| insta::assert_snapshot!("conditions", text));
    // `and` and `or` look no further than they have to.
    assert!(!holds("$X != 'MMPM' and $X > 1", "MMPM,1"));
    assert!(holds("$X == 'MMPM' or $X > 1", "MMPM,1"));
}
