//! This module holds the expressions of `if` and `${...}`: their types, which are checked when the recipe is
//! read, and their values.

use super::bindings::{self, Bindings, BoundName};
use super::charset::MissingLetter;
use super::expression_value::{ExpressionValue, fold_word};
use super::rule_fault::RuleFault;
use std::ops::Range;

/// An expression of bound numbers and words.
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
    Binary(Box<Self>, ExpressionOperator, Box<Self>),
}

/// An operator between two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ExpressionOperator {
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

/// The kind of value that an expression has, as far as the recipe alone determines it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ExpressionKind {
    Number,
    Word,
    Truth,
    /// A bound argument, which is a number or a word.
    Argument,
}

/// The reason why an expression has no value for a statement.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EvaluationError {
    /// The fault, worded for people.
    pub message: String,
    /// The argument that causes it, as a place in the statement's text.
    pub at: Option<Range<usize>>,
}

impl From<MissingLetter> for EvaluationError {
    fn from(letter: MissingLetter) -> Self {
        Self { message: letter.to_string(), at: None }
    }
}

impl Expression {
    /// Returns the kind of its value. Names are checked separately.
    ///
    /// # Errors
    /// Returns an error if the expression cannot have a value.
    pub(super) fn kind(&self) -> Result<ExpressionKind, RuleFault> {
        Ok(match self {
            Self::Number(_) => ExpressionKind::Number,
            Self::Word(_) => ExpressionKind::Word,
            Self::Name(_) => ExpressionKind::Argument,
            Self::Not(value) => {
                require_truth(value, "not")?;
                ExpressionKind::Truth
            }
            Self::Minus(value) => {
                require_number(value, "-")?;
                ExpressionKind::Number
            }
            Self::Binary(left, operator, right) => match operator {
                ExpressionOperator::Or | ExpressionOperator::And => {
                    require_truth(left, operator.sign())?;
                    require_truth(right, operator.sign())?;
                    ExpressionKind::Truth
                }
                ExpressionOperator::Equal | ExpressionOperator::Unequal => {
                    require_comparable(left.kind()?, right.kind()?)?;
                    ExpressionKind::Truth
                }
                ExpressionOperator::AtMost
                | ExpressionOperator::AtLeast
                | ExpressionOperator::Less
                | ExpressionOperator::Greater => {
                    require_number(left, operator.sign())?;
                    require_number(right, operator.sign())?;
                    ExpressionKind::Truth
                }
                _ => {
                    require_number(left, operator.sign())?;
                    require_number(right, operator.sign())?;
                    ExpressionKind::Number
                }
            },
        })
    }

    /// Checks that every name is bound to a single argument.
    ///
    /// # Errors
    /// Returns an error if a name is not bound, or if it is bound to several arguments.
    pub(super) fn check_names(&self, names: &[BoundName]) -> Result<(), RuleFault> {
        self.names().into_iter().try_for_each(|name| match names.iter().find(|known| known.text == *name) {
            None => {
                Err(bindings::unbound_name(name, names, "A word to compare with stands in quotes: 'MMPM'."))
            }
            Some(known) if known.rest => Err(RuleFault::new(
                format!("`$...{name}` is not one value but several arguments"),
                "Bind the one that is meant: $NAME.",
            )),
            Some(_) => Ok(()),
        })
    }

    /// Returns the names in the expression, in order.
    pub(super) fn names(&self) -> Vec<&str> {
        match self {
            Self::Number(_) | Self::Word(_) => Vec::new(),
            Self::Name(name) => vec![name],
            Self::Not(value) | Self::Minus(value) => value.names(),
            Self::Binary(left, _, right) => [left.names(), right.names()].concat(),
        }
    }

    /// Returns its value for a statement.
    ///
    /// # Errors
    /// Returns an error if an argument has the wrong kind, or if a number is divided by zero.
    pub(super) fn evaluate(&self, bindings: &Bindings<'_>) -> Result<ExpressionValue, EvaluationError> {
        match self {
            Self::Number(value) => Ok(ExpressionValue::Number(*value)),
            Self::Word(word) => Ok(ExpressionValue::Word(fold_word(word))),
            Self::Name(name) => Ok(bindings.argument_value(name)),
            Self::Not(value) => Ok(ExpressionValue::Truth(!value.evaluate_truth(bindings)?)),
            Self::Minus(value) => Ok(ExpressionValue::Number(-value.evaluate_number(bindings)?)),
            Self::Binary(left, operator, right) => evaluate_binary(left, *operator, right, bindings),
        }
    }

    /// Returns whether it is true for a statement.
    ///
    /// # Errors
    /// Returns the errors of [`Expression::evaluate`].
    pub(super) fn evaluate_truth(&self, bindings: &Bindings<'_>) -> Result<bool, EvaluationError> {
        match self.evaluate(bindings)? {
            ExpressionValue::Truth(value) => Ok(value),
            _ => Err(EvaluationError { message: "this is neither true nor false".to_owned(), at: None }),
        }
    }

    fn evaluate_number(&self, bindings: &Bindings<'_>) -> Result<f64, EvaluationError> {
        match self.evaluate(bindings)? {
            ExpressionValue::Number(value) => Ok(value),
            ExpressionValue::Word(word) => {
                let (name, at) = match self {
                    Self::Name(name) => (format!("`${name}` is"), bindings.argument_range(name)),
                    _ => ("this is".to_owned(), None),
                };
                Err(EvaluationError { message: format!("{name} `{word}` here, which is not a number"), at })
            }
            ExpressionValue::Truth(_) => {
                Err(EvaluationError { message: "a number is wanted here".to_owned(), at: None })
            }
        }
    }
}

fn evaluate_binary(
    left: &Expression,
    operator: ExpressionOperator,
    right: &Expression,
    bindings: &Bindings<'_>,
) -> Result<ExpressionValue, EvaluationError> {
    let numbers = || Ok((left.evaluate_number(bindings)?, right.evaluate_number(bindings)?));
    Ok(match operator {
        ExpressionOperator::Or => {
            ExpressionValue::Truth(left.evaluate_truth(bindings)? || right.evaluate_truth(bindings)?)
        }
        ExpressionOperator::And => {
            ExpressionValue::Truth(left.evaluate_truth(bindings)? && right.evaluate_truth(bindings)?)
        }
        ExpressionOperator::Equal => {
            ExpressionValue::Truth(left.evaluate(bindings)? == right.evaluate(bindings)?)
        }
        ExpressionOperator::Unequal => {
            ExpressionValue::Truth(left.evaluate(bindings)? != right.evaluate(bindings)?)
        }
        ExpressionOperator::AtMost => numbers().map(|(a, b)| ExpressionValue::Truth(a <= b))?,
        ExpressionOperator::AtLeast => numbers().map(|(a, b)| ExpressionValue::Truth(a >= b))?,
        ExpressionOperator::Less => numbers().map(|(a, b)| ExpressionValue::Truth(a < b))?,
        ExpressionOperator::Greater => numbers().map(|(a, b)| ExpressionValue::Truth(a > b))?,
        ExpressionOperator::Add => numbers().and_then(|(a, b)| require_finite(a + b))?,
        ExpressionOperator::Subtract => numbers().and_then(|(a, b)| require_finite(a - b))?,
        ExpressionOperator::Multiply => numbers().and_then(|(a, b)| require_finite(a * b))?,
        ExpressionOperator::Divide => numbers().and_then(|(a, b)| require_finite(a / b))?,
    })
}

fn require_finite(value: f64) -> Result<ExpressionValue, EvaluationError> {
    if value.is_finite() {
        return Ok(ExpressionValue::Number(value));
    }
    Err(EvaluationError {
        message: "the result is no number: a division by zero, or too large".to_owned(),
        at: None,
    })
}

impl ExpressionOperator {
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

fn require_truth(value: &Expression, sign: &str) -> Result<(), RuleFault> {
    match value.kind()? {
        ExpressionKind::Truth => Ok(()),
        _ => {
            let left = if sign == "not" { "" } else { "$F > 1000 " };
            let message = format!("`{sign}` stands with comparisons only");
            Err(RuleFault::new(message, format!("For example: {left}{sign} $U == 'MMPM'.")))
        }
    }
}

fn require_number(value: &Expression, sign: &str) -> Result<(), RuleFault> {
    match value.kind()? {
        ExpressionKind::Number | ExpressionKind::Argument => Ok(()),
        ExpressionKind::Word => {
            let message = format!("`{sign}` stands with numbers only");
            Err(RuleFault::new(message, "Words are compared by == and !=."))
        }
        ExpressionKind::Truth => {
            let message = format!("`{sign}` stands with numbers, not with a comparison");
            Err(RuleFault::new(message, "Join comparisons by `and`."))
        }
    }
}

fn require_comparable(left: ExpressionKind, right: ExpressionKind) -> Result<(), RuleFault> {
    match (left, right) {
        (ExpressionKind::Truth, _) | (_, ExpressionKind::Truth) => {
            let message = "`==` and `!=` compare numbers or words";
            Err(RuleFault::new(message, "Join comparisons by `and` or `or`."))
        }
        (ExpressionKind::Number, ExpressionKind::Word) | (ExpressionKind::Word, ExpressionKind::Number) => {
            Err(RuleFault::new("a number never equals a word", "A number stands without quotes."))
        }
        _ => Ok(()),
    }
}
