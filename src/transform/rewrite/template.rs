//! This module holds what a rule writes: a statement with `$NAME` and `${...}` in it.

use super::bindings::{Bindings, BoundName, unbound_name};
use super::charset::Charset;
use super::expression::{EvaluationError, Expression, ExpressionKind};
use super::expression_value::ExpressionValue;
use super::rule_fault::RuleFault;
use super::rule_subject::{RuleSubject, SubjectClass};
use super::rule_text::{RuleTextPart, parse_rule_text, quote_text};
use crate::parse;
use crate::program::{NumberRole, Record, ShopVocabulary};
use crate::write::FileStyle;

/// A statement that will be written.
#[derive(Debug, Clone)]
pub(super) struct StatementTemplate {
    pieces: Vec<RuleTextPart>,
    is_ascii: bool,
}

/// The values with which a template is filled.
pub(super) struct TemplateInputs<'f> {
    /// The arguments that the pattern has bound.
    pub bindings: &'f Bindings<'f>,
    /// The matched statement.
    pub text: &'f [u8],
    /// The record of the matched statement.
    pub record: &'f Record,
    /// The style in which the file writes numbers.
    pub style: &'f FileStyle,
    /// The character set of the file.
    pub charset: Charset,
}

impl StatementTemplate {
    /// Reads a template.
    ///
    /// # Errors
    /// Returns what is wrong with the text.
    pub(super) fn new(text: &str) -> Result<Self, RuleFault> {
        let pieces = parse_rule_text(text)?;
        let mut tried = String::new();
        let mut is_plain = true;
        for piece in &pieces {
            is_plain &= matches!(piece, RuleTextPart::Plain(_));
            match piece {
                RuleTextPart::Plain(plain) => tried.push_str(plain),
                RuleTextPart::Bound(_) | RuleTextPart::Rest(Some(_)) => tried.push('\u{7F}'),
                RuleTextPart::Rest(None) => {
                    let message = "`$...` does not say what is to be written";
                    return Err(RuleFault::new(message, "Name it here and in `match`: $...REST."));
                }
                RuleTextPart::Computed(expression) => {
                    if expression.kind()? == ExpressionKind::Truth {
                        let message = "`${...}` writes a number or a word";
                        return Err(RuleFault::new(message, "A condition stands in `if`."));
                    }
                    tried.push('1');
                }
            }
        }
        let subject = RuleSubject::from_text(tried.as_bytes());
        if !subject.is_whole(tried.as_bytes()) {
            let help =
                "Give several statements as a list; a statement goes on in a new line only behind a `$`.";
            return Err(RuleFault::new("this is not one statement", help));
        }
        // Arguments are only known when the rule runs. Then the whole statement is read back again.
        let problem = match parse::read_whole_record(tried.as_bytes(), &ShopVocabulary::default()) {
            Err(problem) if is_plain => Some(problem.problem),
            _ if subject.class == SubjectClass::Other => Some("it starts with no word".to_owned()),
            _ => None,
        };
        match problem {
            Some(problem) => {
                let message = format!("{} is no CL statement: {problem}", quote_text(text));
                Err(RuleFault::new(message, "Write a statement as it stands in the file."))
            }
            None => Ok(Self { pieces, is_ascii: text.is_ascii() }),
        }
    }

    /// Returns whether it is the same in every character set.
    pub(super) fn is_ascii(&self) -> bool {
        self.is_ascii
    }

    /// Checks that every name is bound.
    ///
    /// # Errors
    /// Returns what is wrong with the text.
    pub(super) fn check_names(&self, names: &[BoundName]) -> Result<(), RuleFault> {
        self.pieces.iter().try_for_each(|piece| match piece {
            RuleTextPart::Bound(name) | RuleTextPart::Rest(Some(name))
                if !names.iter().any(|known| known.text == *name) =>
            {
                Err(unbound_name(name, names, ""))
            }
            // `${REST}` only names the arguments. Only calculations need a single argument.
            RuleTextPart::Computed(Expression::Name(name))
                if names.iter().any(|known| known.text == *name) =>
            {
                Ok(())
            }
            RuleTextPart::Computed(expression) => expression.check_names(names),
            _ => Ok(()),
        })
    }

    /// Returns the text of the statement without a line end.
    ///
    /// # Errors
    /// Returns an error if an expression has no value here, or if the file cannot hold a letter of the
    /// template.
    pub(super) fn fill(&self, filling: &TemplateInputs<'_>) -> Result<Vec<u8>, EvaluationError> {
        let mut out = Vec::new();
        let mut comma_goes = false;
        for (index, piece) in self.pieces.iter().enumerate() {
            match piece {
                RuleTextPart::Plain(plain) => {
                    let plain = match std::mem::take(&mut comma_goes) {
                        true => plain.trim_start().trim_start_matches(','),
                        false => plain,
                    };
                    let bytes = filling.charset.encode(plain);
                    out.extend(bytes.map_err(EvaluationError::from)?);
                }
                RuleTextPart::Rest(None) => {}
                RuleTextPart::Bound(name)
                | RuleTextPart::Rest(Some(name))
                | RuleTextPart::Computed(Expression::Name(name)) => {
                    let argument = filling.bindings.argument_text(name);
                    if argument.is_empty() {
                        comma_goes = self.has_comma_after(index);
                        if !comma_goes {
                            drop_separator(&mut out);
                        }
                    }
                    out.extend_from_slice(&argument);
                }
                RuleTextPart::Computed(expression) => out.extend(format_computed(expression, filling)?),
            }
        }
        Ok(out)
    }

    fn has_comma_after(&self, index: usize) -> bool {
        let next = self.pieces.get(index + 1);
        matches!(next, Some(RuleTextPart::Plain(plain)) if plain.trim_start().starts_with(','))
    }
}

/// Removes the comma or slash at the end of the text, because nothing follows it.
fn drop_separator(out: &mut Vec<u8>) {
    out.truncate(out.trim_ascii_end().len());
    if matches!(out.last(), Some(b',' | b'/')) {
        out.pop();
        out.truncate(out.trim_ascii_end().len());
    }
}

fn format_computed(
    expression: &Expression,
    filling: &TemplateInputs<'_>,
) -> Result<Vec<u8>, EvaluationError> {
    let number = match expression.evaluate(filling.bindings)? {
        ExpressionValue::Number(number) => number,
        ExpressionValue::Word(word) => {
            return Ok(filling.charset.encode(&word)?);
        }
        ExpressionValue::Truth(_) => {
            return Err(EvaluationError { message: "this is not a number".to_owned(), at: None });
        }
    };
    // The result is written in the style of the first number from which it is computed.
    let model = expression.names().into_iter().find_map(|name| match filling.bindings.argument_value(name) {
        ExpressionValue::Number(value) => filling.bindings.argument_range(name).map(|at| (at, value)),
        _ => None,
    });
    let Some((at, old)) = model else { return Ok(number.to_string().into_bytes()) };
    let places = parse::statement_numbers(filling.text);
    let roles = parse::number_roles(filling.record, filling.text);
    let role = places
        .iter()
        .zip(roles)
        .find(|((place, _), _)| *place == at)
        .map_or(NumberRole::Plain, |(_, role)| role);
    let original = filling.text.get(at).unwrap_or_default();
    Ok(filling.style.changed_format(role, original).format_number(number, number - old).into_bytes())
}
