//! Patterns: which statements a rule is about, and what it binds in them.
//!
//! The CL grammar reads the pattern as it reads the file, so both are spelt as freely. Only `$NAME` is new to it.

use super::bindings::{Bindings, Name};
use super::charset::Charset;
use super::subject::{Class, Subject};
use super::text::{Piece, pieces, quoted};
use super::wild::{self, Hole, MARK, Wild};
use crate::number;
use crate::program::{Field, FieldKind, Group};

/// A pattern for statements.
#[derive(Debug, Clone)]
pub(super) struct Pattern {
    text: String,
    class: Class,
    word: Wild,
    slots: Vec<Slot>,
    names: Vec<Name>,
}

/// A pattern for one argument.
#[derive(Debug, Clone)]
enum Slot {
    Any(Option<String>),
    Rest(Option<String>),
    Empty,
    Number(f64),
    Text(Wild),
    Quoted(Vec<u8>),
    Group(Wild, Vec<Slot>),
}

impl Pattern {
    /// Reads a pattern.
    ///
    /// # Errors
    /// A message, with help after a line break.
    pub fn new(text: &str) -> Result<Self, String> {
        Self::compile(text, Charset::Utf8)
    }

    /// The pattern for a file of this character set. One that does not have all of its characters gives `None`: nothing in
    /// the file can fit.
    pub fn in_charset(&self, charset: Charset) -> Option<Self> {
        if self.text.is_ascii() { Some(self.clone()) } else { Self::compile(&self.text, charset).ok() }
    }

    /// Whether it is the same in every character set.
    pub fn is_ascii(&self) -> bool {
        self.text.is_ascii()
    }

    /// The names it binds, each once.
    pub fn names(&self) -> &[Name] {
        &self.names
    }

    fn compile(text: &str, charset: Charset) -> Result<Self, String> {
        let mut marked = Vec::new();
        let mut holes = Vec::new();
        for piece in pieces(text)? {
            let hole = match piece {
                Piece::Plain(plain) => {
                    marked.extend(charset.encode(&plain)?);
                    continue;
                }
                Piece::Bound(name) => Hole { name: Some(name), rest: false },
                Piece::Rest(name) => Hole { name, rest: true },
                Piece::Computed(_) => {
                    let help = "Write `$NAME` here, and the condition in `if`.";
                    return Err(format!("a pattern binds arguments, it does not compute\n{help}"));
                }
            };
            marked.extend_from_slice(format!("\u{7F}{}\u{7F}", holes.len()).as_bytes());
            holes.push(hole);
        }
        let subject = Subject::of(&marked);
        let first = subject.bytes(&subject.word).split(|&byte| byte == b',').next().unwrap_or_default();
        let is_bare = number::parse(first.trim_ascii()).is_some();
        if subject.class == Class::Other || is_bare || !subject.is_whole(&marked) {
            let help = "A pattern is one statement as it stands in the file, with $NAME for arguments.";
            return Err(format!("{} is no CL statement that a rule can match\n{help}", quoted(text)));
        }
        if subject.remark.is_some() && subject.class != Class::Comment {
            let help = "Leave the comment out; statements match with and without one.";
            return Err(format!("a comment behind a statement is not matched\n{help}"));
        }
        let word = Wild::compile(subject.bytes(&subject.word), &holes)?;
        if word.has_rest() {
            return Err("`$...` stands for arguments, not for a word\nWrite `$WORD/$...`.".to_owned());
        }
        let slots = slots(&subject, &subject.fields, &holes)?;
        Ok(Self { text: text.to_owned(), class: subject.class, word, slots, names: names(&holes)? })
    }

    /// Whether the first letters allow a match; cheap, for every statement of a large file.
    pub fn may_match(&self, text: &[u8]) -> bool {
        let text = text.trim_ascii_start();
        let starts_with = |letters: &[u8]| {
            text.get(..letters.len()).is_some_and(|start| start.eq_ignore_ascii_case(letters))
        };
        match self.class {
            Class::Comment => text.starts_with(b"$$"),
            Class::Structured => text.starts_with(b"$$->") || starts_with(b"REMARK"),
            _ => starts_with(self.word.first_letters()),
        }
    }

    /// Matches a statement.
    pub fn matches<'p>(&'p self, subject: &Subject<'p>) -> Option<Bindings<'p>> {
        let mut bindings = Bindings::new(subject.text);
        let fits = self.class == subject.class
            && self.word.matches(subject.text, &subject.word, &mut bindings)
            && all_match(&self.slots, subject, &subject.fields, &mut bindings)
            && bindings.agree();
        fits.then_some(bindings)
    }
}

fn slots(subject: &Subject<'_>, fields: &[Field], holes: &[Hole]) -> Result<Vec<Slot>, String> {
    let slots: Vec<Slot> =
        fields.iter().map(|field| slot(subject, field, holes)).collect::<Result<_, _>>()?;
    let takes_all = |slot: &Slot| match slot {
        Slot::Rest(_) => true,
        Slot::Text(wild) => wild.has_rest(),
        _ => false,
    };
    match slots.iter().rev().skip(1).any(takes_all) {
        true => Err(wild::not_last()),
        false => Ok(slots),
    }
}

fn slot(subject: &Subject<'_>, field: &Field, holes: &[Hole]) -> Result<Slot, String> {
    let bytes = subject.bytes(&field.at);
    Ok(match &field.kind {
        FieldKind::Empty => Slot::Empty,
        FieldKind::Number(value) => Slot::Number(*value),
        FieldKind::Quoted if bytes.contains(&MARK) => {
            let help = "Write `$NAME` without quotes for the whole argument; it is bound with its quotes.";
            return Err(format!("`$` between quotes is text, so it binds nothing\n{help}"));
        }
        FieldKind::Quoted => Slot::Quoted(bytes.to_vec()),
        FieldKind::Text => {
            let digits = bytes.strip_prefix(&[MARK]).and_then(|bytes| bytes.strip_suffix(&[MARK]));
            match digits.and_then(|digits| wild::hole(digits, holes)) {
                Some(Hole { name, rest: true }) => Slot::Rest(name.clone()),
                Some(Hole { name, rest: false }) => Slot::Any(name.clone()),
                None => Slot::Text(Wild::compile(bytes, holes)?),
            }
        }
        FieldKind::Group(group) => {
            let word = Wild::compile(subject.bytes(&group.word), holes)?;
            if word.has_rest() {
                return Err(wild::not_last());
            }
            Slot::Group(word, slots(subject, &group.fields, holes)?)
        }
    })
}

fn names(holes: &[Hole]) -> Result<Vec<Name>, String> {
    let mut names: Vec<Name> = Vec::new();
    for hole in holes {
        let Some(text) = hole.name.as_deref().filter(|name| *name != "_") else { continue };
        match names.iter().find(|name| name.text == text) {
            Some(known) if known.rest != hole.rest => {
                return Err(format!(
                    "`${text}` and `$...{text}` cannot both be bound\nGive one of them another name."
                ));
            }
            Some(_) => {}
            None => names.push(Name { text: text.to_owned(), rest: hole.rest }),
        }
    }
    Ok(names)
}

fn all_match<'p>(
    slots: &'p [Slot],
    subject: &Subject<'p>,
    fields: &[Field],
    bindings: &mut Bindings<'p>,
) -> bool {
    let (slots, rest) = match slots.split_last() {
        Some((Slot::Rest(name), slots)) => (slots, Some(name)),
        _ => (slots, None),
    };
    let Some((fields, left)) = fields.split_at_checked(slots.len()) else { return false };
    if !slots.iter().zip(fields).all(|(slot, field)| matches(slot, subject, field, bindings)) {
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

fn matches<'p>(slot: &'p Slot, subject: &Subject<'p>, field: &Field, bindings: &mut Bindings<'p>) -> bool {
    match (slot, &field.kind) {
        (Slot::Empty, FieldKind::Empty) => true,
        (Slot::Any(name), kind) if *kind != FieldKind::Empty => {
            bindings.bind(name.as_deref(), field.at.clone());
            true
        }
        (Slot::Number(wanted), FieldKind::Number(value)) => wanted == value,
        // A name of digits: `TOOL PATH/100`.
        (Slot::Number(wanted), FieldKind::Text) => number::parse(subject.bytes(&field.at)) == Some(*wanted),
        (Slot::Text(wild), FieldKind::Text) => wild.matches(subject.text, &field.at, bindings),
        (Slot::Quoted(wanted), FieldKind::Quoted) => wanted == subject.bytes(&field.at),
        (Slot::Group(word, slots), FieldKind::Group(group)) => {
            let Group { word: at, fields } = group.as_ref();
            word.matches(subject.text, at, bindings) && all_match(slots, subject, fields, bindings)
        }
        _ => false,
    }
}
