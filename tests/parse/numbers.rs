//! CL numbers: read correctly rounded, printed so that no edit is lost.

use clsmith::number::{self, NumberFormat, ZeroStyle, parse_number, parse_plain_decimal};
use proptest::prelude::*;

#[test]
fn the_styles_of_all_dialects_are_read() {
    for (text, value) in [
        ("12.5000", 12.5),
        ("-0.1", -0.1),
        (".5", 0.5),
        ("120.", 120.0),
        ("0", 0.0),
        ("-.984808", -0.984808),
        ("+1.5", 1.5),
        ("1E3", 1000.0),
        ("1.5e-2", 0.015),
        ("1.2D+1", 12.0),
        ("0.1d0", 0.1),
        ("007", 7.0),
    ] {
        assert_eq!(parse_number(text.as_bytes()), Some(value), "{text}");
    }
}

#[test]
fn what_is_no_number_is_none() {
    for text in [
        "", ".", "-", "+", "1.2.3", "--1", "1-", "1E", "E5", "1E5E5", "nan", "inf", "1e400", "0x1", "1,5",
        " 1", "1 ",
    ] {
        assert_eq!(parse_number(text.as_bytes()), None, "{text:?}");
    }
}

#[test]
fn decimals_are_those_after_the_point() {
    let found = ["12.5000", "120.", "7", ".5", "-0.25E3"].map(|text| number::count_decimals(text.as_bytes()));
    assert_eq!(found, [4, 0, 0, 1, 2]);
}

#[test]
fn style_of_solidworks_has_no_needless_zero() {
    let form = NumberFormat { decimals: 6, tolerance: 5e-7, zeros: ZeroStyle::Cut, point: true };
    let printed = [0.0, -0.0, 0.5, -0.5, 120.0, -120.0, 0.984808, 12.25, 1e-9, -1e-9, 100.0, 1000.5];
    let printed = printed.map(|value| form.format_number(value, 0.0));
    assert_eq!(
        printed,
        ["0", "0", ".5", "-0.5", "120.", "-120.", ".984808", "12.25", "0", "0", "100.", "1000.5"]
    );
    assert_eq!(NumberFormat { point: false, ..form }.format_number(120.0, 0.0), "120");
}

#[test]
fn an_edit_smaller_than_the_decimals_gets_more_of_them() {
    // 0.1 moved by 0.04 printed with one decimal is 0.1 again: the edit would be lost.
    let form = NumberFormat { decimals: 1, tolerance: 0.05, zeros: ZeroStyle::Kept, point: false };
    assert_eq!(form.format_number(0.14, 0.04), "0.14");
    assert_eq!(form.format_number(0.2, 0.1), "0.2");
    assert_eq!(NumberFormat { decimals: 4, ..form }.format_number(12.00003, 0.00003), "12.00003");
}

/// Decimal texts as CAM systems and people write them.
fn decimal_text() -> impl Strategy<Value = String> {
    let styles =
        ["-?[0-9]{1,7}\\.[0-9]{0,10}", "-?\\.[0-9]{1,12}", "-?[0-9]{1,17}", "-?[0-9]{1,4}\\.[0-9]{12,20}"];
    prop::sample::select(styles.to_vec()).prop_flat_map(|style| prop::string::string_regex(style).unwrap())
}

proptest! {
    #![proptest_config(crate::support::property(2000))]

    #[test]
    fn a_plain_decimal_is_what_the_standard_library_reads(text in decimal_text(), tail in "[ ,$eE\r\n.+-]?") {
        let expected: f64 = text.parse().unwrap();
        prop_assert_eq!(parse_number(text.as_bytes()).map(f64::to_bits), Some(expected.to_bits()));
        if let Some((value, length)) = parse_plain_decimal(format!("{text}{tail}").as_bytes()) {
            let read = &format!("{text}{tail}")[..length];
            prop_assert_eq!(value.to_bits(), read.parse::<f64>().unwrap().to_bits());
            prop_assert!(length >= text.len());
        } else {
            // Only long ones are declined.
            prop_assert!(text.bytes().filter(u8::is_ascii_digit).count() > 15);
        }
    }

    #[test]
    fn any_bytes_are_a_number_or_none(bytes in prop::collection::vec(any::<u8>(), 0..12)) {
        if let Some(value) = parse_number(&bytes) {
            prop_assert!(value.is_finite());
        }
        if let Some((_, length)) = parse_plain_decimal(&bytes) {
            prop_assert!(length <= bytes.len());
        }
    }

    #[test]
    fn what_is_printed_reads_back_close_to_what_was_wanted(
        wanted in -1e5f64..1e5,
        edit in prop_oneof![Just(0.0), -10.0f64..10.0, -1e-6f64..1e-6],
        decimals in 0usize..11,
        cut in any::<bool>(),
    ) {
        let tolerance = 0.5 * 10f64.powi(-(decimals as i32));
        let zeros = if cut { ZeroStyle::Cut } else { ZeroStyle::Kept };
        let text = NumberFormat { decimals, tolerance, zeros, point: true }.format_number(wanted, edit);
        let off = (parse_number(text.as_bytes()).unwrap() - wanted).abs();
        let slack = wanted.abs() * 2.0 * f64::EPSILON;
        prop_assert!(off <= tolerance * (1.0 + 1e-6) + slack, "{text} for {wanted}");
        if edit != 0.0 {
            prop_assert!(off <= edit.abs() * 0.1 * (1.0 + 1e-6) + slack.max(5e-16), "{text} for {wanted}, edit {edit}");
        }
        if cut {
            let number = text.trim_start_matches('-');
            prop_assert!(!(number.contains('.') && number.ends_with('0')), "{text}");
            prop_assert!(text == "0" || !text.starts_with("0."), "{text}");
            prop_assert!(!text.starts_with("-."), "{text}");
        } else {
            prop_assert!(number::count_decimals(text.as_bytes()) >= decimals, "{text}");
        }
    }

    #[test]
    fn minus_zero_is_never_printed(wanted in prop_oneof![-1e-3f64..1e-3, Just(-0.0)], decimals in 0usize..8, cut in any::<bool>()) {
        let zeros = if cut { ZeroStyle::Cut } else { ZeroStyle::Kept };
        let text = NumberFormat { decimals, tolerance: 1.0, zeros, point: false }.format_number(wanted, 0.0);
        prop_assert!(!text.starts_with('-') || text.bytes().any(|b| (b'1'..=b'9').contains(&b)), "{text}");
        let any = NumberFormat { decimals, tolerance: 1.0, zeros: ZeroStyle::Kept, point: false }.format_number(wanted, 0.0);
        prop_assert_eq!(number::count_decimals(any.as_bytes()), decimals);
    }
}

#[test]
fn a_number_with_very_many_decimals_is_printed_with_forty() {
    let form = NumberFormat { decimals: 70_000, tolerance: 5e-5, zeros: ZeroStyle::Kept, point: true };
    let text = form.format_number(12.5, 0.25);
    assert_eq!(text, format!("12.5{}", "0".repeat(39)));
}
