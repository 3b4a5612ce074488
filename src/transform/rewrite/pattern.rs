//! This module matches statements with patterns and binds their arguments.
//!
//! The CL grammar reads the pattern as it reads the file, so both may be written equally freely. Only `$NAME`
//! is added.

use super::bindings::{Bindings, BoundName};
use super::charset::Charset;
use super::rule_fault::RuleFault;
use super::rule_subject::{RuleSubject, SubjectClass};
use super::rule_text::{RuleTextPart, parse_rule_text, quote_text};
use super::wildcards::{self, MARK, Wildcard, WildcardPattern};
use crate::number;
use crate::program::{FieldGroup, FieldKind, StatementField};

/// A pattern for statements.
#[derive(Debug, Clone)]
pub(super) struct StatementPattern {
    text: String,
    class: SubjectClass,
    word: WildcardPattern,
    slots: Vec<ArgumentPattern>,
    names: Vec<BoundName>,
}

/// A pattern for one argument.
#[derive(Debug, Clone)]
enum ArgumentPattern {
    Any(Option<String>),
    Rest(Option<String>),
    Empty,
    Number(f64),
    Text(WildcardPattern),
    Quoted(Vec<u8>),
    Group(WildcardPattern, Vec<ArgumentPattern>),
}

impl StatementPattern {
    /// Reads a pattern.
    ///
    /// # Errors
    /// Returns what is wrong with the text.
    pub(super) fn new(text: &str) -> Result<Self, RuleFault> {
        Self::compile(text, Charset::Utf8)
    }

    /// Returns the pattern for a file of this character set. Returns `None` if the character set does not
    /// have all of its characters, because nothing in the file can match then.
    pub(super) fn for_charset(&self, charset: Charset) -> Option<Self> {
        if self.text.is_ascii() { Some(self.clone()) } else { Self::compile(&self.text, charset).ok() }
    }

    /// Returns whether it is the same in every character set.
    pub(super) fn is_ascii(&self) -> bool {
        self.text.is_ascii()
    }

    /// Returns the names that it binds, each of them once.
    pub(super) fn names(&self) -> &[BoundName] {
        &self.names
    }

    fn compile(text: &str, charset: Charset) -> Result<Self, RuleFault> {
        let mut marked = Vec::new();
        let mut holes = Vec::new();
        for piece in parse_rule_text(text)? {
            let hole = match piece {
                RuleTextPart::Plain(plain) => {
                    marked.extend(
                        charset
                            .encode(&plain)
                            .map_err(|letter| RuleFault::without_help(letter.to_string()))?,
                    );
                    continue;
                }
                RuleTextPart::Bound(name) => Wildcard { name: Some(name), rest: false },
                RuleTextPart::Rest(name) => Wildcard { name, rest: true },
                RuleTextPart::Computed(_) => {
                    let help = "Write `$NAME` here, and the condition in `if`.";
                    return Err(RuleFault::new("a pattern binds arguments, it does not compute", help));
                }
            };
            marked.extend_from_slice(format!("\u{7F}{}\u{7F}", holes.len()).as_bytes());
            holes.push(hole);
        }
        let subject = RuleSubject::from_text(&marked);
        let first = subject.bytes_at(&subject.word).split(|&byte| byte == b',').next().unwrap_or_default();
        let is_bare = number::parse_number(first.trim_ascii()).is_some();
        if subject.class == SubjectClass::Other || is_bare || !subject.is_whole(&marked) {
            let help = "A pattern is one statement as it stands in the file, with $NAME for arguments.";
            let message = format!("{} is no CL statement that a rule can match", quote_text(text));
            return Err(RuleFault::new(message, help));
        }
        if subject.remark.is_some() && subject.class != SubjectClass::Comment {
            let help = "Leave the comment out; statements match with and without one.";
            return Err(RuleFault::new("a comment behind a statement is not matched", help));
        }
        let word = WildcardPattern::compile(subject.bytes_at(&subject.word), &holes)?;
        if word.has_rest() {
            return Err(RuleFault::new("`$...` stands for arguments, not for a word", "Write `$WORD/$...`."));
        }
        let slots = compile_arguments(&subject, &subject.fields, &holes)?;
        Ok(Self { text: text.to_owned(), class: subject.class, word, slots, names: collect_names(&holes)? })
    }

    /// Returns whether the first letters allow a match. It is cheap enough for every statement of a large
    /// file.
    pub(super) fn may_match(&self, text: &[u8]) -> bool {
        let text = text.trim_ascii_start();
        let starts_with = |letters: &[u8]| {
            text.get(..letters.len()).is_some_and(|start| start.eq_ignore_ascii_case(letters))
        };
        match self.class {
            SubjectClass::Comment => text.starts_with(b"$$"),
            SubjectClass::Structured => text.starts_with(b"$$->") || starts_with(b"REMARK"),
            _ => starts_with(self.word.first_letters()),
        }
    }

    /// Matches a statement and binds its arguments.
    pub(super) fn matches<'p>(&'p self, subject: &RuleSubject<'p>) -> Option<Bindings<'p>> {
        let mut bindings = Bindings::new(subject.text);
        let fits = self.class == subject.class
            && self.word.matches(subject.text, &subject.word, &mut bindings)
            && match_arguments(&self.slots, subject, &subject.fields, &mut bindings)
            && bindings.is_consistent();
        fits.then_some(bindings)
    }
}

fn compile_arguments(
    subject: &RuleSubject<'_>,
    fields: &[StatementField],
    holes: &[Wildcard],
) -> Result<Vec<ArgumentPattern>, RuleFault> {
    let slots: Vec<ArgumentPattern> =
        fields.iter().map(|field| compile_argument(subject, field, holes)).collect::<Result<_, _>>()?;
    let takes_all = |slot: &ArgumentPattern| match slot {
        ArgumentPattern::Rest(_) => true,
        ArgumentPattern::Text(wild) => wild.has_rest(),
        _ => false,
    };
    match slots.iter().rev().skip(1).any(takes_all) {
        true => Err(wildcards::rest_not_last()),
        false => Ok(slots),
    }
}

fn compile_argument(
    subject: &RuleSubject<'_>,
    field: &StatementField,
    holes: &[Wildcard],
) -> Result<ArgumentPattern, RuleFault> {
    let bytes = subject.bytes_at(&field.at);
    Ok(match &field.kind {
        FieldKind::Empty => ArgumentPattern::Empty,
        FieldKind::Number(value) => ArgumentPattern::Number(*value),
        FieldKind::Quoted if bytes.contains(&MARK) => {
            let help = "Write `$NAME` without quotes for the whole argument; it is bound with its quotes.";
            return Err(RuleFault::new("`$` between quotes is plain text, so it binds nothing", help));
        }
        FieldKind::Quoted => ArgumentPattern::Quoted(bytes.to_vec()),
        FieldKind::Text => {
            let digits = bytes.strip_prefix(&[MARK]).and_then(|bytes| bytes.strip_suffix(&[MARK]));
            match digits.and_then(|digits| wildcards::find_wildcard(digits, holes)) {
                Some(Wildcard { name, rest: true }) => ArgumentPattern::Rest(name.clone()),
                Some(Wildcard { name, rest: false }) => ArgumentPattern::Any(name.clone()),
                None => ArgumentPattern::Text(WildcardPattern::compile(bytes, holes)?),
            }
        }
        FieldKind::Group(group) => {
            let word = WildcardPattern::compile(subject.bytes_at(&group.word), holes)?;
            if word.has_rest() {
                return Err(wildcards::rest_not_last());
            }
            ArgumentPattern::Group(word, compile_arguments(subject, &group.fields, holes)?)
        }
    })
}

fn collect_names(holes: &[Wildcard]) -> Result<Vec<BoundName>, RuleFault> {
    let mut names: Vec<BoundName> = Vec::new();
    for hole in holes {
        let Some(text) = hole.name.as_deref().filter(|name| *name != "_") else { continue };
        match names.iter().find(|name| name.text == text) {
            Some(known) if known.rest != hole.rest => {
                let message = format!("`${text}` and `$...{text}` cannot both be bound");
                return Err(RuleFault::new(message, "Give one of them another name."));
            }
            Some(_) => {}
            None => names.push(BoundName { text: text.to_owned(), rest: hole.rest }),
        }
    }
    Ok(names)
}

fn match_arguments<'p>(
    slots: &'p [ArgumentPattern],
    subject: &RuleSubject<'p>,
    fields: &[StatementField],
    bindings: &mut Bindings<'p>,
) -> bool {
    let (slots, rest) = match slots.split_last() {
        Some((ArgumentPattern::Rest(name), slots)) => (slots, Some(name)),
        _ => (slots, None),
    };
    let Some((fields, left)) = fields.split_at_checked(slots.len()) else { return false };
    if !slots.iter().zip(fields).all(|(slot, field)| match_argument(slot, subject, field, bindings)) {
        return false;
    }
    match (rest, left) {
        (None, []) => true,
        (None, _) => false,
        (Some(name), left) => {
            let end = fields.last().map_or(subject.word.end, |field| field.at.end);
            let start = left.first().map_or(end, |field| field.at.start);
            bindings.bind(name.as_deref(), start..left.last().map_or(end, |field| field.at.end));
            true
        }
    }
}

fn match_argument<'p>(
    slot: &'p ArgumentPattern,
    subject: &RuleSubject<'p>,
    field: &StatementField,
    bindings: &mut Bindings<'p>,
) -> bool {
    match (slot, &field.kind) {
        (ArgumentPattern::Empty, FieldKind::Empty) => true,
        (ArgumentPattern::Any(name), kind) if *kind != FieldKind::Empty => {
            bindings.bind(name.as_deref(), field.at.clone());
            true
        }
        (ArgumentPattern::Number(wanted), FieldKind::Number(value)) => wanted == value,
        // A name may consist of digits: `TOOL PATH/100`.
        (ArgumentPattern::Number(wanted), FieldKind::Text) => {
            number::parse_number(subject.bytes_at(&field.at)) == Some(*wanted)
        }
        (ArgumentPattern::Text(wild), FieldKind::Text) => wild.matches(subject.text, &field.at, bindings),
        (ArgumentPattern::Quoted(wanted), FieldKind::Quoted) => wanted == subject.bytes_at(&field.at),
        (ArgumentPattern::Group(word, slots), FieldKind::Group(group)) => {
            let FieldGroup { word: at, fields } = group.as_ref();
            word.matches(subject.text, at, bindings) && match_arguments(slots, subject, fields, bindings)
        }
        _ => false,
    }
}
