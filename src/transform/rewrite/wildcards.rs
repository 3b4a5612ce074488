//! This module matches text with wildcards: `TOOL $N`, `T$NAME`, `Start of $...REST`.
//!
//! Upper and lower case, repeated blanks and blanks around commas do not matter. Each wildcard takes the
//! shortest text that lets the next words match, and the last one takes everything that remains. So matching
//! never goes back, and it takes linear time.

use super::bindings::Bindings;
use super::rule_fault::RuleFault;
use std::ops::Range;

/// In texts for the CL grammar, a `$NAME` is replaced by the index of its wildcard between two of these
/// marks. The grammar takes this byte for a letter, and neither words nor names contain it.
pub(super) const MARK: u8 = 0x7F;

/// A wildcard, which stands for an argument in a pattern.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wildcard {
    /// The name that it binds. It is `None` if it binds nothing.
    pub name: Option<String>,
    /// Whether it takes everything that remains.
    pub rest: bool,
}

/// A text pattern.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WildcardPattern(Vec<WildcardPart>);

#[derive(Debug, Clone, PartialEq)]
enum WildcardPart {
    /// Bytes in upper case with single blanks.
    Literal(Vec<u8>),
    /// At least one character.
    Some(Option<String>),
    /// Everything that remains, which may be nothing. If there is something, a blank must come before it.
    Rest(Option<String>, bool),
}

impl WildcardPattern {
    /// Reads a text in which wildcards are marked.
    ///
    /// # Errors
    /// Returns an error if the text cannot be matched unambiguously.
    pub(super) fn compile(marked: &[u8], wildcards: &[Wildcard]) -> Result<Self, RuleFault> {
        let folded: Vec<u8> =
            fold_bytes(marked, &(0..marked.len())).into_iter().map(|(byte, _)| byte).collect();
        let mut parts: Vec<WildcardPart> = Vec::new();
        for (index, bytes) in folded.split(|&byte| byte == MARK).enumerate() {
            if index % 2 == 0 {
                if !bytes.is_empty() {
                    parts.push(WildcardPart::Literal(bytes.to_vec()));
                }
                continue;
            }
            let Some(hole) = find_wildcard(bytes, wildcards) else {
                return Err(RuleFault::without_help("a wildcard of the text is missing"));
            };
            let mut after_blank = false;
            if hole.rest
                && let Some(WildcardPart::Literal(literal)) = parts.last_mut()
                && literal.last() == Some(&b' ')
            {
                after_blank = true;
                literal.pop();
                if literal.is_empty() {
                    parts.pop();
                }
            }
            match parts.last() {
                Some(WildcardPart::Rest(..)) => return Err(rest_not_last()),
                Some(WildcardPart::Some(_)) if !after_blank => {
                    let help = "Put a blank or a comma between them; two arguments are two names.";
                    let message = "nothing separates two wildcards, so it is unclear where one ends and the next begins";
                    return Err(RuleFault::new(message, help));
                }
                _ => {}
            }
            parts.push(match hole.rest {
                true => WildcardPart::Rest(hole.name.clone(), after_blank),
                false => WildcardPart::Some(hole.name.clone()),
            });
        }
        match parts.iter().rev().skip(1).any(|part| matches!(part, WildcardPart::Rest(..))) {
            true => Err(rest_not_last()),
            false => Ok(Self(parts)),
        }
    }

    /// Returns whether it has a `$...`.
    pub(super) fn has_rest(&self) -> bool {
        matches!(self.0.last(), Some(WildcardPart::Rest(..)))
    }

    /// Returns the letters with which every match begins, up to the first blank, comma or wildcard.
    pub(super) fn first_letters(&self) -> &[u8] {
        match self.0.first() {
            Some(WildcardPart::Literal(literal)) => {
                literal.split(|byte| matches!(byte, b' ' | b',')).next().unwrap_or_default()
            }
            _ => &[],
        }
    }

    /// Matches a part of a text and binds the wildcards.
    pub(super) fn matches<'p>(
        &'p self,
        text: &'p [u8],
        at: &Range<usize>,
        bindings: &mut Bindings<'p>,
    ) -> bool {
        let folded = fold_bytes(text, at);
        let bytes: Vec<u8> = folded.iter().map(|(byte, _)| *byte).collect();
        let mut next = 0;
        let mut open: Option<&Option<String>> = None;
        let mut bind = |name: &'p Option<String>, from: usize, to: usize| {
            bindings.bind(name.as_deref(), unfolded_range(&folded, from, to, at.end));
        };
        for (index, part) in self.0.iter().enumerate() {
            let is_last = index + 1 == self.0.len();
            match part {
                WildcardPart::Literal(literal) => {
                    // A wildcard takes at least one character, so what follows it begins one later.
                    let earliest = next + usize::from(open.is_some());
                    let Some(found) = find_literal(&bytes, literal, earliest, open.is_some(), is_last) else {
                        return false;
                    };
                    if let Some(name) = open.take() {
                        bind(name, next, found);
                    }
                    next = found + literal.len();
                }
                WildcardPart::Some(name) => open = Some(name),
                WildcardPart::Rest(name, after_blank) => {
                    if let Some(before) = open.take() {
                        let rest = bytes.get(next + 1..).unwrap_or_default();
                        let end = rest.iter().position(|&byte| byte == b' ');
                        let end = end.map_or(bytes.len(), |blank| next + 1 + blank);
                        if end == next {
                            return false;
                        }
                        bind(before, next, end);
                        next = end;
                    } else if *after_blank && next > 0 && next < bytes.len() && bytes.get(next) != Some(&b' ')
                    {
                        return false;
                    }
                    bind(name, next, bytes.len());
                    next = bytes.len();
                }
            }
        }
        if let Some(name) = open {
            if next >= bytes.len() {
                return false;
            }
            bind(name, next, bytes.len());
            next = bytes.len();
        }
        next == bytes.len()
    }
}

pub(super) fn rest_not_last() -> RuleFault {
    RuleFault::new("`$...` takes all that is left, so it comes last", "`$NAME` stands for one argument.")
}

/// Returns the wildcard with a marked index.
pub(super) fn find_wildcard<'h>(digits: &[u8], wildcards: &'h [Wildcard]) -> Option<&'h Wildcard> {
    wildcards.get(std::str::from_utf8(digits).ok()?.parse::<usize>().ok()?)
}

/// Finds a literal. It stands at `earliest`, or anywhere behind it if text may come before it, or at the end
/// if it is the last one.
fn find_literal(bytes: &[u8], literal: &[u8], earliest: usize, floats: bool, is_last: bool) -> Option<usize> {
    let rest = bytes.get(earliest..)?;
    let found = match (floats, is_last) {
        (false, _) => rest.starts_with(literal).then_some(0),
        (true, true) => rest.ends_with(literal).then(|| rest.len() - literal.len()),
        // The first place is as good as any later one, because it leaves the most text for the parts that
        // follow. So no search back is needed.
        (true, false) => memchr::memmem::find(rest, literal),
    };
    found.map(|at| earliest + at)
}

/// Returns the place in the original text of a range of folded bytes, without blanks at both ends.
fn unfolded_range(folded: &[(u8, usize)], from: usize, to: usize, end: usize) -> Range<usize> {
    let part = folded.get(from..to).unwrap_or_default();
    let ink = |(byte, _): &(u8, usize)| *byte != b' ';
    match (part.iter().position(ink), part.iter().rposition(ink)) {
        (Some(first), Some(last)) => {
            let at = |index: usize| part.get(index).map_or(end, |(_, at)| *at);
            at(first)..at(last) + 1
        }
        _ => end..end,
    }
}

/// Converts a text to upper case with single blanks and no blanks around commas and at the ends. Each byte
/// keeps its original place.
fn fold_bytes(text: &[u8], at: &Range<usize>) -> Vec<(u8, usize)> {
    let mut folded: Vec<(u8, usize)> = Vec::with_capacity(at.len());
    let mut blank = None;
    for (index, &byte) in text.iter().enumerate().take(at.end).skip(at.start) {
        if byte.is_ascii_whitespace() {
            blank = Some(index);
            continue;
        }
        if let Some(index) = blank.take()
            && byte != b','
            && folded.last().is_some_and(|(last, _)| *last != b',')
        {
            folded.push((b' ', index));
        }
        folded.push((byte.to_ascii_uppercase(), index));
    }
    folded
}

/// Returns whether two texts are equal except for upper and lower case and blanks.
pub(super) fn is_same_folded(a: &[u8], b: &[u8]) -> bool {
    let (a, b) = (fold_bytes(a, &(0..a.len())), fold_bytes(b, &(0..b.len())));
    a.len() == b.len() && a.iter().zip(&b).all(|((a, _), (b, _))| a == b)
}
