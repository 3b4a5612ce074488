//! CL number text to `f64` and back, keeping the style of the text.
//!
//! CAM systems write plain decimals: no exponent, no `+` (measured over 127 files). Hand-written files may have both, and
//! FORTRAN's `D` exponent; all are read.

/// Powers of ten that `f64` holds exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// Integers up to here are exact in `f64`.
const EXACT_INTEGER: u64 = 1 << 53;

/// Reads a plain decimal (`-12.50`, `.5`, `120.`) from the start of `text`; gives the value and its length in bytes.
///
/// The result is correctly rounded: with a mantissa below 2^53 and at most 22 decimals one division of two exact numbers
/// is (Clinger 1990). Anything else (exponents, more digits, no digit at all) is declined with `None`.
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
/// `None` when it is none, or too large for `f64`.
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

/// Number of digits after the decimal point of a number text.
pub fn count_decimals(text: &[u8]) -> usize {
    match text.iter().position(|&byte| byte == b'.') {
        Some(point) => text.iter().skip(point + 1).take_while(|byte| byte.is_ascii_digit()).count(),
        None => 0,
    }
}

/// How a file writes its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ZeroStyle {
    /// A fixed number of decimals, zeros kept: `12.5000` (NX, CATIA, Creo, CLT, FF).
    #[default]
    Kept,
    /// Trailing zeros cut and no leading zero when positive: `12.5`, `120.`, `.5`, `-0.5`, `0` (SolidWorks CAM).
    Cut,
}

/// What a printed number has to satisfy.
#[derive(Debug, Clone, Copy)]
pub struct NumberFormat {
    /// Decimals to print at least (with [`ZeroStyle::Cut`]: before zeros are cut).
    pub decimals: usize,
    /// Largest allowed difference between the wanted and the printed value.
    pub tolerance: f64,
    /// Zero style.
    pub zeros: ZeroStyle,
    /// Whether a whole number carries its point (`120.`) with [`ZeroStyle::Cut`].
    pub point: bool,
}

/// `f64` text never needs more decimals than this to differ from its neighbours at machine sizes.
const MOST_DECIMALS: usize = 15;

/// A changed number keeps at most this many decimals of its old text: what stands behind them is far below a number's own
/// precision, and Rust's formatter panics where more than 65,535 are asked for.
const MOST_KEPT_DECIMALS: usize = 40;

impl NumberFormat {
    /// Prints `wanted` and reads back what it printed: decimals are added until the value is within the tolerance and within
    /// a tenth of `edit` (how far the number moved; 0 for a new number), so that no edit is rounded away. A number whose old
    /// text had more than 40 decimals gets 40.
    pub fn format_number(&self, wanted: f64, edit: f64) -> String {
        let allowed = if edit == 0.0 { self.tolerance } else { self.tolerance.min(edit.abs() * 0.1) };
        let mut text = String::new();
        let least = self.decimals.min(MOST_KEPT_DECIMALS);
        for decimals in least..=MOST_DECIMALS.max(least) {
            text = format!("{wanted:.decimals$}");
            let error =
                parse_number(text.as_bytes()).map_or(f64::INFINITY, |printed| (printed - wanted).abs());
            // Half an ulp of slack: 0.00005 is not exactly half of 0.0001.
            if error <= allowed * (1.0 + 1e-9) {
                break;
            }
        }
        let text = strip_negative_zero(text);
        match self.zeros {
            ZeroStyle::Kept => text,
            ZeroStyle::Cut => cut_zeros(&text, self.point),
        }
    }
}

fn strip_negative_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|byte| matches!(byte, b'0' | b'.')) => rest.to_owned(),
        _ => text,
    }
}

fn cut_zeros(text: &str, point: bool) -> String {
    let cut = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text };
    if cut.is_empty() || cut == "0" {
        return "0".to_owned();
    }
    if let Some(decimals) = cut.strip_prefix("0.") {
        return format!(".{decimals}");
    }
    if point && !cut.contains('.') { format!("{cut}.") } else { cut.to_owned() }
}
