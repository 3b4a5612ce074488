//! This module reads CL numbers as `f64` and prints them in the style of their text.
//!
//! CAM systems write plain decimals without exponent and `+` (measured over 127 files). Files written by hand
//! may have both, and the `D` exponent of FORTRAN; all of them are read.

mod readable_number;

pub(crate) use readable_number::{
    format_fixed_number, format_named_point, format_point, format_significant_number, format_trimmed_number,
    group_thousands,
};

/// The powers of ten that `f64` holds exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// The largest integer up to which all integers are exact in `f64`.
const EXACT_INTEGER: u64 = 1 << 53;

/// Reads a plain decimal (`-12.50`, `.5`, `120.`) from the start of `text`; returns the value and its length
/// in bytes.
///
/// The result is correctly rounded: if the mantissa is below 2^53 and there are at most 22 decimals, it is
/// one division of two exact numbers (Clinger 1990). Returns `None` for anything else: exponents, more
/// digits, or no digit.
#[inline]
pub fn parse_plain_decimal(text: &[u8]) -> Option<(f64, usize)> {
    let (negative, mut at) = match text.first()? {
        b'-' => (true, 1),
        _ => (false, 0),
    };
    let mut mantissa: u64 = 0;
    let mut digits = 0;
    let mut point = None;
    while let Some(&byte) = text.get(at) {
        // One test finds digits: other bytes wrap around to 10 or more.
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            digits += 1;
        } else if byte == b'.' && point.is_none() {
            point = Some(at);
        } else {
            break;
        }
        at += 1;
    }
    let decimals = point.map_or(0, |point| at - point - 1);
    if digits == 0 || digits > 19 || mantissa > EXACT_INTEGER {
        return None;
    }
    let value = mantissa as f64 / EXACT_POWERS.get(decimals)?;
    Some((if negative { -value } else { value }, at))
}

/// Reads the whole of `text` as a CL number.
///
/// Returns `None` if it is not a number or is too large for `f64`.
///
/// ```
/// use clsmith::number::parse_number;
///
/// assert_eq!(parse_number(b"-.5"), Some(-0.5));
/// assert_eq!(parse_number(b"1.25D+1"), Some(12.5));
/// assert_eq!(parse_number(b"12.5O00"), None);
/// ```
pub fn parse_number(text: &[u8]) -> Option<f64> {
    if let Some((value, length)) = parse_plain_decimal(text)
        && length == text.len()
    {
        return Some(value);
    }
    let mut plain = String::with_capacity(text.len());
    for &byte in text {
        match byte {
            b'd' | b'D' => plain.push('e'),
            b'0'..=b'9' | b'.' | b'-' | b'+' | b'e' | b'E' => plain.push(char::from(byte)),
            _ => return None,
        }
    }
    plain.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Returns the number of digits after the decimal point of a number's text.
///
/// ```
/// use clsmith::number::count_decimals;
///
/// assert_eq!(count_decimals(b"12.5000"), 4);
/// assert_eq!(count_decimals(b"120."), 0);
/// ```
pub fn count_decimals(text: &[u8]) -> usize {
    match text.iter().position(|&byte| byte == b'.') {
        Some(point) => text.iter().skip(point + 1).take_while(|byte| byte.is_ascii_digit()).count(),
        None => 0,
    }
}

/// The way in which a file writes the zeros of its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ZeroStyle {
    /// Numbers have a fixed number of decimals: `12.5000` (NX, CATIA, Creo, CLT, FF).
    #[default]
    Kept,
    /// Trailing zeros are cut, and positive numbers have no leading zero: `12.5`, `120.`, `.5`, `-0.5`, `0`
    /// (SolidWorks CAM).
    Cut,
}

/// The requirements for a printed number.
///
/// ```
/// use clsmith::number::{NumberFormat, ZeroStyle};
///
/// let nx = NumberFormat { decimals: 4, tolerance: 5e-5, zeros: ZeroStyle::Kept, point: true };
/// assert_eq!(nx.format_number(600.0, -600.0), "600.0000");
/// // An edit that four decimals would round away gets as many as it needs.
/// assert_eq!(nx.format_number(10.00002, 0.00002), "10.00002");
/// let solid_works = NumberFormat { zeros: ZeroStyle::Cut, ..nx };
/// assert_eq!(solid_works.format_number(0.5, 0.0), ".5");
/// ```
#[derive(Debug, Clone, Copy)]
pub struct NumberFormat {
    /// The least number of decimals; with [`ZeroStyle::Cut`], before zeros are cut.
    pub decimals: usize,
    /// The largest allowed difference between the wanted and the printed value.
    pub tolerance: f64,
    /// The zero style.
    pub zeros: ZeroStyle,
    /// Whether a whole number keeps its point (`120.`) with [`ZeroStyle::Cut`].
    pub point: bool,
}

/// The most decimals that are tried. At the size of machines, a value never needs more to differ from its
/// neighbours.
const MOST_DECIMALS: usize = 15;

/// The most decimals that a changed number keeps of its old text. Digits behind them are far below the
/// precision of a number, and Rust's formatter panics if more than 65,535 are asked for.
const MOST_KEPT_DECIMALS: usize = 40;

impl NumberFormat {
    /// Prints `wanted` and reads back what it printed. Decimals are added until the value is within the
    /// tolerance and within a tenth of `edit`, so that no edit is rounded away. `edit` is the change of the
    /// number, or 0 for a new number. A number whose old text had more than 40 decimals gets 40.
    pub fn format_number(&self, wanted: f64, edit: f64) -> String {
        let mut printed = Vec::new();
        self.write_number(wanted, edit, &mut printed);
        String::from_utf8_lossy(&printed).into_owned()
    }

    /// Does the same in the memory of `printed`, which loses what it held.
    pub(crate) fn write_number(&self, wanted: f64, edit: f64, printed: &mut Vec<u8>) {
        let allowed = if edit == 0.0 { self.tolerance } else { self.tolerance.min(edit.abs() * 0.1) };
        let least = self.decimals.min(MOST_KEPT_DECIMALS);
        for decimals in least..=MOST_DECIMALS.max(least) {
            let error = write_decimals(wanted, decimals, printed)
                .map_or(f64::INFINITY, |value| (value - wanted).abs());
            // The slack allows for rounding: 0.00005 is not exactly half of 0.0001.
            if error <= allowed * (1.0 + 1e-9) {
                break;
            }
        }
        if is_negative_zero(printed) {
            printed.remove(0);
        }
        if self.zeros == ZeroStyle::Cut {
            let cut = cut_zeros(&String::from_utf8_lossy(printed), self.point);
            printed.clear();
            printed.extend_from_slice(cut.as_bytes());
        }
    }
}

/// Prints a value with so many decimals, correctly rounded as `format!` does it, in the memory of `printed`. Returns
/// the value that the text reads as.
fn write_decimals(value: f64, decimals: usize, printed: &mut Vec<u8>) -> Option<f64> {
    if let Some(read) = write_near_integer(value, decimals, printed) {
        return Some(read);
    }
    printed.clear();
    printed.extend_from_slice(format!("{value:.decimals$}").as_bytes());
    parse_number(printed)
}

/// Does the same for values of machines by one multiplication, about ten times faster. Returns `None` for large
/// values, and where the error of the product might decide how it is rounded.
fn write_near_integer(value: f64, decimals: usize, printed: &mut Vec<u8>) -> Option<f64> {
    let power = EXACT_POWERS.get(decimals)?;
    let scaled = value.abs() * power;
    // What is large or not finite is left to `format!`.
    if scaled.is_nan() || scaled >= 1e15 {
        return None;
    }
    let floor = scaled.floor();
    let rest = scaled - floor;
    // The product is off by at most 2^-53 of itself; twice that is kept away from the tie.
    if (rest - 0.5).abs() <= scaled * f64::EPSILON {
        return None;
    }
    let mantissa = floor as u64 + u64::from(rest > 0.5);
    let mut digits = mantissa;
    let mut bytes = [b'0'; 48];
    let mut start = bytes.len();
    let mut count = 0;
    while digits > 0 || count <= decimals {
        if count == decimals && decimals > 0 {
            start -= 1;
            *bytes.get_mut(start)? = b'.';
        }
        start -= 1;
        *bytes.get_mut(start)? = b'0' + (digits % 10) as u8;
        digits /= 10;
        count += 1;
    }
    if value.is_sign_negative() {
        start -= 1;
        *bytes.get_mut(start)? = b'-';
    }
    printed.clear();
    printed.extend_from_slice(bytes.get(start..)?);
    // Both are exact, so the quotient is what `parse_number` reads (Clinger 1990).
    let read = mantissa as f64 / power;
    Some(if value.is_sign_negative() { -read } else { read })
}

/// Returns whether a number that is printed as zero has a sign.
fn is_negative_zero(printed: &[u8]) -> bool {
    let unsigned = printed.strip_prefix(b"-");
    unsigned.is_some_and(|rest| rest.iter().all(|byte| matches!(byte, b'0' | b'.')))
}

/// Removes the sign of a number that is printed as zero.
fn strip_negative_zero(text: String) -> String {
    if is_negative_zero(text.as_bytes()) { text.chars().skip(1).collect() } else { text }
}

/// Cuts the zeros after the last decimal that counts, and a point that nothing follows. Zeros of whole numbers
/// stay.
fn trim_trailing_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// Cuts the zeros of a printed number; `point` keeps the point of a whole number.
fn cut_zeros(text: &str, point: bool) -> String {
    let cut = trim_trailing_zeros(text);
    if cut.is_empty() || cut == "0" {
        return "0".to_owned();
    }
    if let Some(decimals) = cut.strip_prefix("0.") {
        return format!(".{decimals}");
    }
    if point && !cut.contains('.') { format!("{cut}.") } else { cut.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the text, and the value that it is said to read as.
    fn assert_printed(value: f64, decimals: usize) {
        let mut printed = b"before".to_vec();
        let read = write_decimals(value, decimals, &mut printed);
        let text = format!("{value:.decimals$}");
        assert_eq!(String::from_utf8(printed).unwrap(), text, "{value:e} {decimals}");
        assert_eq!(read.map(f64::to_bits), parse_number(text.as_bytes()).map(f64::to_bits), "{text}");
    }

    /// Sizes and decimals of machines, ties, and values beside them.
    #[test]
    fn numbers_are_printed_as_the_standard_library_prints_them() {
        let mut state = 1_u64;
        for round in 0..200_000_u32 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let decimals = (state >> 60) as usize;
            let whole = (state >> 20) as i32 as f64;
            let value = match round % 5 {
                0 => whole / 1e4,
                1 => whole / 131_072.0,
                2 => (whole + 0.5) / 10f64.powi(decimals as i32),
                3 => ((whole + 0.5) / 10f64.powi(decimals as i32)).next_up(),
                _ => whole * 1e-9,
            };
            assert_printed(value, decimals);
        }
        for value in [0.0, -0.0, 0.5, 1.5, 2.5, -0.00004, 1e14, 1e15, 1e300, f64::MIN_POSITIVE, f64::INFINITY]
        {
            for decimals in [0, 1, 4, 7, 22, 40] {
                assert_printed(value, decimals);
            }
        }
    }
}
