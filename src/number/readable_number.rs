//! Numbers for people: in findings, reports and tables. None of these ever writes `-0`.

use super::{strip_negative_zero, trim_trailing_zeros};

/// Numbers from here on are printed with an exponent.
const LARGEST_PLAIN: f64 = 1e15;

/// Prints a number with a fixed number of decimals: `2.500`.
pub(crate) fn format_fixed_number(value: f64, decimals: usize) -> String {
    strip_negative_zero(format!("{value:.decimals$}"))
}

/// Prints a number with at most so many decimals and without trailing zeros: `2.5`, `120`.
pub(crate) fn format_trimmed_number(value: f64, most_decimals: usize) -> String {
    // So many digits tell people nothing: 9e290 has 291.
    if value.abs() >= LARGEST_PLAIN {
        return format!("{value:e}");
    }
    // What is "-0.0" before the zeros go must be "0" after it.
    let text = format_fixed_number(value, most_decimals);
    trim_trailing_zeros(&text).to_owned()
}

/// Prints a number with so many significant digits, at most so many of them decimals, and without trailing
/// zeros. Digits before the point are all printed: 12,345 with three significant digits is `12345`.
pub(crate) fn format_significant_number(value: f64, digits: u8, most_decimals: u8) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let before_point = value.abs().log10().floor() + 1.0;
    let decimals = (f64::from(digits) - before_point).clamp(0.0, f64::from(most_decimals));
    format_trimmed_number(value, decimals as usize)
}

/// Prints a point in a plane or in space with a fixed number of decimals: `(1.000, -2.500, 0.000)`.
pub(crate) fn format_point<const N: usize>(coordinates: [f64; N], decimals: usize) -> String {
    format!("({})", coordinates.map(|value| format_fixed_number(value, decimals)).join(", "))
}

/// Prints a point in space with the names of its coordinates: `x 1.000, y -2.500, z 0.000`.
pub(crate) fn format_named_point(coordinates: [f64; 3], decimals: usize) -> String {
    let [x, y, z] = coordinates.map(|value| format_fixed_number(value, decimals));
    format!("x {x}, y {y}, z {z}")
}

/// Sets the thousands of a printed number apart: `1234567.8901` becomes `1,234,567.8901`.
pub(crate) fn group_thousands(number: &str) -> String {
    let digits = number.find('.').unwrap_or(number.len());
    let mut out = String::with_capacity(number.len() + digits / 3);
    for (index, c) in number.chars().enumerate() {
        let after_digit = out.ends_with(|last: char| last.is_ascii_digit());
        if c.is_ascii_digit() && after_digit && index < digits && (digits - index).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_decimals() {
        let print = |value| format_fixed_number(value, 2);
        assert_eq!([0.0, 2.5, -2.499, 120.0].map(print), ["0.00", "2.50", "-2.50", "120.00"]);
        assert_eq!([-0.0, -0.004].map(print), ["0.00", "0.00"], "never -0");
        assert_eq!([f64::INFINITY, f64::NAN].map(print), ["inf", "NaN"]);
        assert_eq!(format_fixed_number(119.6, 0), "120");
    }

    #[test]
    fn trailing_zeros_go_and_zeros_of_whole_numbers_stay() {
        let print = |value| format_trimmed_number(value, 4);
        assert_eq!([0.0, 0.5, 120.0, -1.25, 0.00004].map(print), ["0", "0.5", "120", "-1.25", "0"]);
        assert_eq!([-0.0, -0.00004].map(print), ["0", "0"], "never -0");
        assert_eq!([100.0, 119.6].map(|value| format_trimmed_number(value, 0)), ["100", "120"]);
        assert_eq!([f64::INFINITY, f64::NAN].map(print), ["inf", "NaN"]);
    }

    #[test]
    fn significant_digits() {
        let print = |value| format_significant_number(value, 4, 9);
        assert_eq!([0.0, 1.0, 12.3456, -0.00123456].map(print), ["0", "1", "12.35", "-0.001235"]);
        assert_eq!([9.99996, 123_456.7, 1000.0].map(print), ["10", "123457", "1000"]);
        assert_eq!([1e-12, -1e-12].map(print), ["0", "0"], "beyond the decimals there is nothing");
        assert_eq!([f64::INFINITY, f64::NAN].map(print), ["inf", "NaN"]);
        assert_eq!(format_significant_number(0.012_345_678, 3, 3), "0.012");
    }

    #[test]
    fn points() {
        assert_eq!(format_point([1.0, -2.5, -0.0001], 3), "(1.000, -2.500, 0.000)");
        assert_eq!(format_point([10.0, 0.25], 1), "(10.0, 0.2)");
        assert_eq!(format_named_point([1.0, -2.5, -0.0001], 3), "x 1.000, y -2.500, z 0.000");
    }

    #[test]
    fn thousands() {
        let cases = [
            ("0", "0"),
            ("999", "999"),
            ("1000", "1,000"),
            ("-1234567.8901", "-1,234,567.8901"),
            ("-100", "-100"),
            ("inf", "inf"),
        ];
        for (plain, grouped) in cases {
            assert_eq!(group_thousands(plain), grouped);
        }
    }
}
