//! This module reads the pitch of a thread from the name of a tool: `TAP M10x1.5`, `TAP M6`, `1/4-20 UNC`, `#10-32`.

/// Millimetres in an inch.
const MM_PER_INCH: f64 = 25.4;

/// The coarse pitches of ISO 261, by diameter in mm. A name without a pitch (`TAP M6`) means the coarse one.
const COARSE: &[(f64, f64)] = &[
    (1.6, 0.35),
    (2.0, 0.4),
    (2.5, 0.45),
    (3.0, 0.5),
    (3.5, 0.6),
    (4.0, 0.7),
    (5.0, 0.8),
    (6.0, 1.0),
    (7.0, 1.0),
    (8.0, 1.25),
    (10.0, 1.5),
    (12.0, 1.75),
    (14.0, 2.0),
    (16.0, 2.0),
    (18.0, 2.5),
    (20.0, 2.5),
    (22.0, 2.5),
    (24.0, 3.0),
    (27.0, 3.0),
    (30.0, 3.5),
    (33.0, 3.5),
    (36.0, 4.0),
    (39.0, 4.0),
    (42.0, 4.5),
    (48.0, 5.0),
];

/// Returns the pitch that a tool's name tells, in mm.
pub(super) fn find_pitch_mm(name: &str) -> Option<f64> {
    let text = name.to_ascii_uppercase();
    // A comma between digits is that of a decimal; between fields it is followed by a blank or a word.
    find_metric_pitch(&text.replace(',', "."))
        .or_else(|| find_inch_pitch(&text))
        .or_else(|| find_coarse_pitch(&text))
}

/// Finds a metric thread with its pitch: `M10x1.5`, `M8 X 1,25`, `M 6*1`, `MF10X1`, `M10-1.5`.
fn find_metric_pitch(text: &str) -> Option<f64> {
    list_metric_sizes(text).find_map(|(diameter, rest)| {
        let rest = rest.trim_start();
        let (pitch, behind) = match rest.strip_prefix(['X', '*']) {
            Some(rest) => read_decimal(rest.trim_start())?,
            // `M30-6H` is a tolerance; a pitch behind a dash has its point.
            None => read_decimal(rest.strip_prefix('-')?).filter(|(_, behind)| {
                rest.get(1..rest.len() - behind.len()).is_some_and(|number| number.contains('.'))
            })?,
        };
        let goes_on = behind.starts_with(|next: char| next.is_ascii_digit() || next == '.');
        (!goes_on && is_pitch(pitch, diameter)).then_some(pitch)
    })
}

/// Finds a tap without a pitch: `TAP M6`. A fine thread always has its pitch, or says that it is fine.
fn find_coarse_pitch(text: &str) -> Option<f64> {
    if !text.contains("TAP") || ["FINE", "FEIN", "MF"].iter().any(|word| text.contains(word)) {
        return None;
    }
    list_metric_sizes(text).find_map(|(diameter, rest)| {
        let ends = !rest.starts_with(|next: char| next.is_ascii_alphanumeric() || matches!(next, '.' | '*'));
        let crossed = rest.trim_start().starts_with(['X', '*']);
        let coarse = COARSE.iter().find(|(size, _)| *size == diameter);
        coarse.filter(|_| ends && !crossed).map(|(_, pitch)| *pitch)
    })
}

/// Returns the diameters behind each `M` that begins a word, with what follows them.
fn list_metric_sizes(text: &str) -> impl Iterator<Item = (f64, &str)> {
    let bytes = text.as_bytes();
    let starts = text.match_indices('M').filter(|(at, _)| {
        // `EM10X1` is an end mill.
        !at.checked_sub(1).and_then(|before| bytes.get(before)).is_some_and(u8::is_ascii_alphanumeric)
    });
    starts.filter_map(|(at, _)| {
        let rest = text.get(at + 1..)?;
        read_decimal(rest.strip_prefix('F').unwrap_or(rest).trim_start())
    })
}

/// Finds an inch thread, a size with its threads in an inch: `1/4-20`, `#10-32`, `1-8 UNC`, `0.25-28UNF`.
fn find_inch_pitch(text: &str) -> Option<f64> {
    text.match_indices('-').find_map(|(dash, _)| {
        let before = text.get(..dash)?.trim_end();
        let after = text.get(dash + 1..)?.trim_start();
        let (threads, rest) = read_decimal(after)?;
        let named = rest.trim_start_matches([' ', '-', '_']).starts_with("UN");
        let start = before
            .rfind(|c: char| !c.is_ascii_digit() && !matches!(c, '/' | '.' | '#'))
            .map_or(0, |at| at + 1);
        let size = before.get(start..)?;
        let diameter_mm = read_inch_size(size, named)? * MM_PER_INCH;
        let goes_on =
            rest.starts_with(|next: char| next.is_ascii_digit() || matches!(next, '.' | '/' | '-') && !named);
        let pitch = MM_PER_INCH / threads;
        ((4.0..=80.0).contains(&threads) && !goes_on && is_pitch(pitch, diameter_mm)).then_some(pitch)
    })
}

/// Reads the size of an inch thread in inches. A plain number is one only where UNC, UNF or the like follows, and then a
/// whole one of more than 1 is a screw's number.
fn read_inch_size(size: &str, named: bool) -> Option<f64> {
    let of_number = |number: f64| 0.06 + 0.013 * number;
    if let Some(number) = size.strip_prefix('#') {
        return number.parse().ok().filter(|number| *number <= 12.0).map(of_number);
    }
    if let Some((over, under)) = size.split_once('/') {
        let [over, under]: [f64; 2] = [over.parse().ok()?, under.parse().ok()?];
        return (under > 0.0).then_some(over / under);
    }
    let plain: f64 = size.parse().ok().filter(|_| named)?;
    let numbered = !size.contains('.') && (plain == 0.0 || plain > 1.0) && plain <= 12.0;
    Some(if numbered { of_number(plain) } else { plain })
}

/// Returns whether a pitch is one of a thread of a diameter. The finest thread of ISO 261 has a pitch of 0.2 mm, the
/// coarsest of 8; none is a third of its diameter.
fn is_pitch(pitch: f64, diameter: f64) -> bool {
    (0.2..=8.0).contains(&pitch) && pitch * 3.0 < diameter
}

/// Reads a plain decimal number, and returns what follows it.
fn read_decimal(text: &str) -> Option<(f64, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, rest) = text.split_at_checked(end)?;
    Some((number.parse().ok()?, rest))
}

#[cfg(test)]
mod tests {
    use super::find_pitch_mm;

    #[test]
    fn pitches_are_read_from_names_of_threads_only() {
        let cases = [
            ("TAP M10x1.5", Some(1.5)),
            ("M8 X 1,25 HSS", Some(1.25)),
            ("TAP_M10X1.5", Some(1.5)),
            ("T1 Tap M 6*1", Some(1.0)),
            ("M6*1", Some(1.0)),
            ("TAP MF10X1", Some(1.0)),
            ("M10-1.5", Some(1.5)),
            ("TAP M6", Some(1.0)),
            ("TAP_M12-6H", Some(1.75)),
            ("TAP M1.6", Some(0.35)),
            ("TAP M8 FINE", None),
            ("M8", None),
            ("M30-6H", None),
            ("EM10X1", None),
            ("M10X75", None),
            ("MILL 10 X 1", None),
            ("M1.2.3X1", None),
            ("1/4-20 UNC", Some(1.27)),
            ("TAP 1/4-20", Some(1.27)),
            ("3/8-16UNC-2B", Some(25.4 / 16.0)),
            ("#10-32 TAP", Some(25.4 / 32.0)),
            ("10-24 UNC", Some(25.4 / 24.0)),
            ("1-8 UNC", Some(25.4 / 8.0)),
            ("0.25-28 UNF", Some(25.4 / 28.0)),
            ("TOOL 10-32", None),
            ("1/2-2024 JOB", None),
            ("DRILL 10-20", None),
        ];
        for (name, pitch) in cases {
            assert_eq!(find_pitch_mm(name), pitch, "{name}");
        }
    }
}
