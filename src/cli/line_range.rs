//! This module reads `--lines`.

use crate::cli::bad_argument::BadArgument;
use std::ops::RangeInclusive;

/// Reads `A..B`, `A..`, `..B`, `A` or `..`. Both ends are included.
pub(in crate::cli) fn parse_line_range(text: &str) -> Result<RangeInclusive<usize>, BadArgument> {
    let number = |text: &str, none: usize| match text.trim() {
        "" => Some(none),
        text => text.parse::<usize>().ok().filter(|line| *line > 0),
    };
    let range = match text.split_once("..") {
        Some((from, to)) => number(from, 1).zip(number(to, usize::MAX)),
        None => number(text, 0).filter(|line| *line > 0).map(|line| (line, line)),
    };
    let (from, to) =
        range.ok_or(BadArgument::new("this must be lines of the file: 40..48, 40.., ..48 or 44"))?;
    if from > to {
        return Err(BadArgument::new(format!("line {from} is after line {to}")));
    }
    Ok(from..=to)
}

#[cfg(test)]
mod tests {
    use super::parse_line_range;

    #[test]
    fn lines_of_the_command_line() {
        assert_eq!(parse_line_range("40..48"), Ok(40..=48));
        assert_eq!(parse_line_range("40.."), Ok(40..=usize::MAX));
        assert_eq!(parse_line_range("..48"), Ok(1..=48));
        assert_eq!(parse_line_range("44"), Ok(44..=44));
        assert_eq!(parse_line_range(".."), Ok(1..=usize::MAX));
        for wrong in ["", "0", "0..3", "a", "1...2", "-1", "1..b", "5..4"] {
            assert!(parse_line_range(wrong).is_err(), "{wrong}");
        }
    }
}
