//! Expressions of `if` and `${...}`: their types, checked when the recipe is read, and their values.

use super::bindings::{self, Bindings, Name};
use std::ops::Range;

/// An expression on bound numbers and words.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Expression {
    /// `0.8`
    Number(f64),
    /// `'MMPM'`
    Word(String),
    /// `$F`
    Name(String),
    /// `not ...`
    Not(Box<Self>),
    /// `-...`
    Minus(Box<Self>),
    /// `... < ...`
    Binary(Box<Self>, Operator, Box<Self>),
}

/// What stands between two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operator {
    Or,
    And,
    Equal,
    Unequal,
    AtMost,
    AtLeast,
    Less,
    Greater,
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// What an expression gives, as far as the recipe alone tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Number,
    Word,
    Truth,
    /// A bound argument: a number or a word.
    Argument,
}

/// What an expression gave.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    /// In upper case.
    Word(String),
    Truth(bool),
}

/// Why an expression has no value for a statement.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Trouble {
    /// What is wrong, for a person.
    pub message: String,
    /// The argument it is about, in the statement's text.
    pub at: Option<Range<usize>>,
}

impl Expression {
    /// Its kind, if it can have a value at all. Names are checked apart.
    ///
    /// # Errors
    /// A message, with help after a line break.
    pub fn kind(&self) -> Result<Kind, String> {
        Ok(match self {
            Self::Number(_) => Kind::Number,
            Self::Word(_) => Kind::Word,
            Self::Name(_) => Kind::Argument,
            Self::Not(value) => {
                truth(value, "not")?;
                Kind::Truth
            }
            Self::Minus(value) => {
                number(value, "-")?;
                Kind::Number
            }
            Self::Binary(left, operator, right) => match operator {
                Operator::Or | Operator::And => {
                    truth(left, operator.sign())?;
                    truth(right, operator.sign())?;
                    Kind::Truth
                }
                Operator::Equal | Operator::Unequal => {
                    comparable(left.kind()?, right.kind()?)?;
                    Kind::Truth
                }
                Operator::AtMost | Operator::AtLeast | Operator::Less | Operator::Greater => {
                    number(left, operator.sign())?;
                    number(right, operator.sign())?;
                    Kind::Truth
                }
                _ => {
                    number(left, operator.sign())?;
                    number(right, operator.sign())?;
                    Kind::Number
                }
            },
        })
    }

    /// Checks that every name is bound to one argument.
    ///
    /// # Errors
    /// A message, with help after a line break.
    pub fn check_names(&self, names: &[Name]) -> Result<(), String> {
        self.names().into_iter().try_for_each(|name| match names.iter().find(|known| known.text == *name) {
            None => Err(bindings::unbound(name, names, "A word to compare with stands in quotes: 'MMPM'.")),
            Some(known) if known.rest => Err(format!(
                "`$...{name}` is not one value but several arguments\nBind the one that is meant: $NAME."
            )),
            Some(_) => Ok(()),
        })
    }

    /// The names in it, in order.
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::Number(_) | Self::Word(_) => Vec::new(),
            Self::Name(name) => vec![name],
            Self::Not(value) | Self::Minus(value) => value.names(),
            Self::Binary(left, _, right) => [left.names(), right.names()].concat(),
        }
    }

    /// Its value for a statement.
    ///
    /// # Errors
    /// When an argument is of the wrong kind, or a number is divided by zero.
    pub fn value(&self, bindings: &Bindings<'_>) -> Result<Value, Trouble> {
        match self {
            Self::Number(value) => Ok(Value::Number(*value)),
            Self::Word(word) => Ok(Value::Word(bindings::folded(word))),
            Self::Name(name) => Ok(bindings.value(name)),
            Self::Not(value) => Ok(Value::Truth(!value.truth(bindings)?)),
            Self::Minus(value) => Ok(Value::Number(-value.number(bindings)?)),
            Self::Binary(left, operator, right) => binary(left, *operator, right, bindings),
        }
    }

    /// Its truth for a statement.
    ///
    /// # Errors
    /// As [`Expression::value`].
    pub fn truth(&self, bindings: &Bindings<'_>) -> Result<bool, Trouble> {
        match self.value(bindings)? {
            Value::Truth(value) => Ok(value),
            _ => Err(Trouble { message: "this is neither true nor false".to_owned(), at: None }),
        }
    }

    fn number(&self, bindings: &Bindings<'_>) -> Result<f64, Trouble> {
        match self.value(bindings)? {
            Value::Number(value) => Ok(value),
            Value::Word(word) => {
                let (name, at) = match self {
                    Self::Name(name) => (format!("`${name}` is"), bindings.place(name)),
                    _ => ("this is".to_owned(), None),
                };
                Err(Trouble { message: format!("{name} `{word}` here, which is not a number"), at })
            }
            Value::Truth(_) => Err(Trouble { message: "a number is wanted here".to_owned(), at: None }),
        }
    }
}

fn binary(
    left: &Expression,
    operator: Operator,
    right: &Expression,
    bindings: &Bindings<'_>,
) -> Result<Value, Trouble> {
    let numbers = || Ok((left.number(bindings)?, right.number(bindings)?));
    Ok(match operator {
        Operator::Or => Value::Truth(left.truth(bindings)? || right.truth(bindings)?),
        Operator::And => Value::Truth(left.truth(bindings)? && right.truth(bindings)?),
        Operator::Equal => Value::Truth(left.value(bindings)? == right.value(bindings)?),
        Operator::Unequal => Value::Truth(left.value(bindings)? != right.value(bindings)?),
        Operator::AtMost => numbers().map(|(a, b)| Value::Truth(a <= b))?,
        Operator::AtLeast => numbers().map(|(a, b)| Value::Truth(a >= b))?,
        Operator::Less => numbers().map(|(a, b)| Value::Truth(a < b))?,
        Operator::Greater => numbers().map(|(a, b)| Value::Truth(a > b))?,
        Operator::Add => numbers().and_then(|(a, b)| finite(a + b))?,
        Operator::Subtract => numbers().and_then(|(a, b)| finite(a - b))?,
        Operator::Multiply => numbers().and_then(|(a, b)| finite(a * b))?,
        Operator::Divide => numbers().and_then(|(a, b)| finite(a / b))?,
    })
}

fn finite(value: f64) -> Result<Value, Trouble> {
    if value.is_finite() {
        return Ok(Value::Number(value));
    }
    Err(Trouble { message: "the result is no number: a division by zero, or too large".to_owned(), at: None })
}

impl Operator {
    fn sign(self) -> &'static str {
        match self {
            Self::Or => "or",
            Self::And => "and",
            Self::Equal => "==",
            Self::Unequal => "!=",
            Self::AtMost => "<=",
            Self::AtLeast => ">=",
            Self::Less => "<",
            Self::Greater => ">",
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
        }
    }
}

fn truth(value: &Expression, sign: &str) -> Result<(), String> {
    match value.kind()? {
        Kind::Truth => Ok(()),
        _ => {
            let left = if sign == "not" { "" } else { "$F > 1000 " };
            Err(format!("`{sign}` stands with comparisons only\nFor example: {left}{sign} $U == 'MMPM'."))
        }
    }
}

fn number(value: &Expression, sign: &str) -> Result<(), String> {
    match value.kind()? {
        Kind::Number | Kind::Argument => Ok(()),
        Kind::Word => Err(format!("`{sign}` stands with numbers only\nWords are compared by == and !=.")),
        Kind::Truth => {
            Err(format!("`{sign}` stands with numbers, not with a comparison\nJoin comparisons by `and`."))
        }
    }
}

fn comparable(left: Kind, right: Kind) -> Result<(), String> {
    match (left, right) {
        (Kind::Truth, _) | (_, Kind::Truth) => {
            Err("`==` and `!=` compare numbers or words\nJoin comparisons by `and` or `or`.".to_owned())
        }
        (Kind::Number, Kind::Word) | (Kind::Word, Kind::Number) => {
            Err("a number never equals a word\nA number stands without quotes.".to_owned())
        }
        _ => Ok(()),
    }
}
