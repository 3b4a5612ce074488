//! This module splits the texts of a rule at their `$`. It is the only module of `rewrite` that uses pest.

use super::expression::{Expression, ExpressionOperator};
use super::rule_fault::RuleFault;
use pest::Parser;
use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};
use std::sync::LazyLock;

#[derive(pest_derive::Parser)]
#[grammar = "grammar/rewrite.pest"]
struct RewriteGrammar;

/// Longer texts are no statements. The limit also keeps recursion shallow, whatever a recipe contains.
const MOST_BYTES: usize = 2000;
const MOST_NESTED: usize = 30;

/// A part of a text.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum RuleTextPart {
    /// Plain text.
    Plain(String),
    /// `$NAME`.
    Bound(String),
    /// `$...NAME`, `$...`.
    Rest(Option<String>),
    /// `${F * 0.8}`.
    Computed(Expression),
}

/// Splits a pattern or a template into its parts.
///
/// # Errors
/// Returns an error if the text is empty, too long or cannot be read.
pub(super) fn parse_rule_text(text: &str) -> Result<Vec<RuleTextPart>, RuleFault> {
    let text = text.trim_end_matches(['\r', '\n']);
    check_text_size(text)?;
    if text.trim().is_empty() {
        return Err(RuleFault::new(
            "an empty text is no statement",
            "Write a statement as it stands in the file.",
        ));
    }
    if text.chars().any(|c| c.is_control() && !matches!(c, '\t' | '\r' | '\n')) {
        return Err(RuleFault::new(
            "the text holds a control character",
            "CL statements are plain text; remove it.",
        ));
    }
    let mut parsed = RewriteGrammar::parse(Rule::text, text)
        .map_err(|error| explain_syntax_error(text, &error, TEXT_HELP))?;
    let inner = parsed.next().map(Pair::into_inner).into_iter().flatten();
    inner.filter(|pair| pair.as_rule() != Rule::EOI).map(parse_text_part).collect()
}

/// Reads the expression of an `if`.
///
/// # Errors
/// Returns an error if the text is too long or cannot be read.
pub(super) fn parse_condition(text: &str) -> Result<Expression, RuleFault> {
    check_text_size(text)?;
    let parsed = RewriteGrammar::parse(Rule::condition, text)
        .map_err(|error| explain_syntax_error(text, &error, CONDITION_HELP))?;
    let inner = parsed.flat_map(Pair::into_inner).find(|pair| pair.as_rule() == Rule::expression);
    parse_expression(
        inner.map(Pair::into_inner).ok_or_else(|| RuleFault::without_help("there is no expression"))?,
    )
}

fn check_text_size(text: &str) -> Result<(), RuleFault> {
    if text.len() > MOST_BYTES {
        let help = "Statements are a few lines at most; give several as a list.";
        let message = format!("the text has {} bytes, but at most {MOST_BYTES} are allowed", text.len());
        return Err(RuleFault::new(message, help));
    }
    let mut open = 0_usize;
    for c in text.chars() {
        match c {
            '(' => open += 1,
            ')' => open = open.saturating_sub(1),
            _ => {}
        }
        if open > MOST_NESTED {
            let message = format!("more than {MOST_NESTED} parentheses are open at once");
            return Err(RuleFault::new(message, "Close them, or use fewer."));
        }
    }
    Ok(())
}

const TEXT_HELP: &str =
    "`$NAME` is a bound argument, `$...NAME` the remaining ones, `${F * 0.8}` a computed number.";
const CONDITION_HELP: &str =
    "Compare by < <= > >= == !=, join by and, or, not, calculate by + - * /; words stand in 'quotes'.";

/// Returns a text on one line between backticks, shortened if it is long.
pub(super) fn quote_text(text: &str) -> String {
    const MOST: usize = 60;
    let line: String =
        text.trim_end().chars().take(MOST).map(|c| if c.is_control() { ' ' } else { c }).collect();
    let more = if text.trim_end().chars().nth(MOST).is_some() { "…" } else { "" };
    format!("`{line}{more}`")
}

fn explain_syntax_error(text: &str, error: &pest::error::Error<Rule>, usual: &str) -> RuleFault {
    let at = match error.location {
        pest::error::InputLocation::Pos(at) | pest::error::InputLocation::Span((at, _)) => at,
    };
    let rest = text.get(at..).unwrap_or_default().trim();
    let help = if rest.starts_with('=') && !rest.starts_with("==") {
        "Two values are compared by `==`."
    } else if rest.starts_with('"') {
        "A word stands between single quotes: 'MMPM'."
    } else {
        usual
    };
    let message = match rest {
        "" => format!("{} ends too early", quote_text(text)),
        rest => format!("{} cannot be read from {} on", quote_text(text), quote_text(rest)),
    };
    RuleFault::new(message, help)
}

fn parse_text_part(pair: Pair<'_, Rule>) -> Result<RuleTextPart, RuleFault> {
    let plain = pair.as_str().to_owned();
    let rule = pair.as_rule();
    let mut inner = pair.into_inner();
    let name = |inner: Option<Pair<'_, Rule>>| inner.map(|name| name.as_str().to_owned());
    Ok(match rule {
        Rule::bound => RuleTextPart::Bound(name(inner.next()).unwrap_or_default()),
        Rule::rest => RuleTextPart::Rest(name(inner.next())),
        Rule::computed => {
            let inner = inner.find(|pair| pair.as_rule() == Rule::expression);
            RuleTextPart::Computed(parse_expression(
                inner.map(Pair::into_inner).ok_or_else(|| RuleFault::without_help("`${}` is empty"))?,
            )?)
        }
        _ => RuleTextPart::Plain(plain),
    })
}

static PRECEDENCE: LazyLock<PrattParser<Rule>> = LazyLock::new(|| {
    let left = |rule| Op::infix(rule, Assoc::Left);
    PrattParser::new()
        .op(left(Rule::or))
        .op(left(Rule::and))
        .op(Op::prefix(Rule::not))
        .op(left(Rule::equal)
            | left(Rule::unequal)
            | left(Rule::at_most)
            | left(Rule::at_least)
            | left(Rule::less)
            | left(Rule::greater))
        .op(left(Rule::add) | left(Rule::subtract))
        .op(left(Rule::multiply) | left(Rule::divide))
        .op(Op::prefix(Rule::minus))
});

fn parse_expression(pairs: Pairs<'_, Rule>) -> Result<Expression, RuleFault> {
    PRECEDENCE
        .map_primary(parse_operand)
        .map_prefix(|operator, value| {
            let value = Box::new(value?);
            Ok(match operator.as_rule() {
                Rule::not => Expression::Not(value),
                _ => Expression::Minus(value),
            })
        })
        .map_infix(|left, operator, right| {
            Ok(Expression::Binary(Box::new(left?), parse_operator(operator.as_rule())?, Box::new(right?)))
        })
        .parse(pairs)
}

fn parse_operand(pair: Pair<'_, Rule>) -> Result<Expression, RuleFault> {
    let text = pair.as_str();
    match pair.as_rule() {
        Rule::number => match text.parse::<f64>().ok().filter(|value| value.is_finite()) {
            Some(value) => Ok(Expression::Number(value)),
            None => Err(RuleFault::without_help(format!("`{text}` is not a number"))),
        },
        Rule::word => Ok(Expression::Word(text.trim_matches('\'').to_owned())),
        Rule::variable => Ok(Expression::Name(text.trim_start_matches('$').to_owned())),
        _ => parse_expression(pair.into_inner()),
    }
}

fn parse_operator(rule: Rule) -> Result<ExpressionOperator, RuleFault> {
    Ok(match rule {
        Rule::or => ExpressionOperator::Or,
        Rule::and => ExpressionOperator::And,
        Rule::equal => ExpressionOperator::Equal,
        Rule::unequal => ExpressionOperator::Unequal,
        Rule::at_most => ExpressionOperator::AtMost,
        Rule::at_least => ExpressionOperator::AtLeast,
        Rule::less => ExpressionOperator::Less,
        Rule::greater => ExpressionOperator::Greater,
        Rule::add => ExpressionOperator::Add,
        Rule::subtract => ExpressionOperator::Subtract,
        Rule::multiply => ExpressionOperator::Multiply,
        Rule::divide => ExpressionOperator::Divide,
        other => return Err(RuleFault::without_help(format!("{other:?} is no operator"))),
    })
}
