//! This module reads one rule from the recipe and reports every fault at its own text.

use super::bindings::BoundName;
use super::expression::{Expression, ExpressionKind};
use super::pattern::StatementPattern;
use super::rule_fault::RuleFault;
use super::rule_text::parse_condition;
use super::template::StatementTemplate;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A rule: the statements that it matches, and what happens to them.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct RewriteRule {
    /// The statement as it stands in the file, with `$NAME` for an argument and `$...NAME` for all remaining
    /// ones.
    #[schemars(with = "StatementSchema")]
    pub(super) r#match: StatementPattern,
    /// The condition: the rule only applies to statements for which this is true, for example `$F > 1000 and
    /// $U == 'MMPM'`.
    #[schemars(with = "Option<String>")]
    #[schemars(extend("x-default" = "every statement that matches"))]
    pub(super) r#if: Option<RuleCondition>,
    /// The statement that is written in its place.
    #[schemars(with = "Option<StatementSchema>")]
    #[schemars(extend("x-default" = "the statement stays"))]
    pub(super) replace: Option<StatementTemplate>,
    /// Whether the statement is deleted.
    #[schemars(default)]
    pub(super) delete: bool,
    /// A statement, or a list of them, that is inserted before it.
    #[schemars(with = "Option<StatementListSchema>")]
    #[schemars(extend("x-default" = "nothing"))]
    pub(super) insert_before: Vec<StatementTemplate>,
    /// A statement, or a list of them, that is inserted after it.
    #[schemars(with = "Option<StatementListSchema>")]
    #[schemars(extend("x-default" = "nothing"))]
    pub(super) insert_after: Vec<StatementTemplate>,
}

impl RewriteRule {
    /// Makes a rule that replaces each statement that matches by another one.
    ///
    /// # Errors
    /// Returns the fault of one of the texts, as for a recipe.
    pub fn replacing(matched: &str, with: &str) -> Result<Self, RuleFault> {
        let replace = Some(StatementTemplate::new(with)?);
        Self { replace, ..Self::matching(matched)? }.check_names()
    }

    /// Makes a rule that deletes each statement that matches.
    ///
    /// # Errors
    /// Returns the errors of [`RewriteRule::replacing`].
    pub fn deleting(matched: &str) -> Result<Self, RuleFault> {
        Ok(Self { delete: true, ..Self::matching(matched)? })
    }

    /// Makes a rule that inserts a statement before each one that matches.
    ///
    /// # Errors
    /// Returns the errors of [`RewriteRule::replacing`].
    pub fn inserting_before(matched: &str, statement: &str) -> Result<Self, RuleFault> {
        let insert_before = vec![StatementTemplate::new(statement)?];
        Self { insert_before, ..Self::matching(matched)? }.check_names()
    }

    /// Makes a rule that inserts a statement after each one that matches.
    ///
    /// # Errors
    /// Returns the errors of [`RewriteRule::replacing`].
    pub fn inserting_after(matched: &str, statement: &str) -> Result<Self, RuleFault> {
        let insert_after = vec![StatementTemplate::new(statement)?];
        Self { insert_after, ..Self::matching(matched)? }.check_names()
    }

    /// Restricts the rule to statements for which a condition is true.
    ///
    /// # Errors
    /// Returns the errors of [`RewriteRule::replacing`].
    pub fn only_if(self, condition: &str) -> Result<Self, RuleFault> {
        let condition = read_condition(condition)?;
        condition.0.check_names(self.r#match.names())?;
        Ok(Self { r#if: Some(condition), ..self })
    }

    fn matching(matched: &str) -> Result<Self, RuleFault> {
        let r#match = StatementPattern::new(matched)?;
        let (insert_before, insert_after) = (Vec::new(), Vec::new());
        Ok(Self { r#match, r#if: None, replace: None, delete: false, insert_before, insert_after })
    }

    fn check_names(self) -> Result<Self, RuleFault> {
        let mut templates = self.replace.iter().chain(&self.insert_before).chain(&self.insert_after);
        templates.try_for_each(|template| template.check_names(self.r#match.names()))?;
        Ok(self)
    }

    /// Returns whether its texts are the same in every character set.
    pub(super) fn is_ascii(&self) -> bool {
        let mut templates = self.replace.iter().chain(&self.insert_before).chain(&self.insert_after);
        self.r#match.is_ascii() && templates.all(StatementTemplate::is_ascii)
    }
}

/// The expression of an `if`.
#[derive(Debug, Clone)]
pub(super) struct RuleCondition(pub Expression);

impl<'de> Deserialize<'de> for RewriteRule {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        const KEYS: &[&str] = &["match", "if", "replace", "delete", "insert_before", "insert_after"];
        deserializer.deserialize_struct("RewriteRule", KEYS, RuleVisitor)
    }
}

#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "snake_case")]
enum RuleKey {
    Match,
    If,
    Replace,
    Delete,
    InsertBefore,
    InsertAfter,
}

/// The part of a rule that has been read so far. Names are checked as soon as both sides are known, in
/// whichever order they come.
#[derive(Default)]
struct RuleDraft {
    pattern: Option<StatementPattern>,
    condition: Option<RuleCondition>,
    replace: Option<StatementTemplate>,
    delete: bool,
    before: Vec<StatementTemplate>,
    after: Vec<StatementTemplate>,
}

impl RuleDraft {
    fn check_condition(&self, condition: &RuleCondition) -> Result<(), RuleFault> {
        self.pattern_names().map_or(Ok(()), |names| condition.0.check_names(names))
    }

    fn check_template(&self, template: &StatementTemplate) -> Result<(), RuleFault> {
        self.pattern_names().map_or(Ok(()), |names| template.check_names(names))
    }

    fn check_replace(&self, template: &StatementTemplate) -> Result<(), RuleFault> {
        match self.delete {
            true => Err(replaced_and_deleted()),
            false => self.check_template(template),
        }
    }

    fn check_pattern(&self, pattern: &StatementPattern) -> Result<(), RuleFault> {
        let mut templates = self.replace.iter().chain(&self.before).chain(&self.after);
        templates.try_for_each(|template| template.check_names(pattern.names()))?;
        self.condition.iter().try_for_each(|condition| condition.0.check_names(pattern.names()))
    }

    fn pattern_names(&self) -> Option<&[BoundName]> {
        self.pattern.as_ref().map(StatementPattern::names)
    }
}

fn replaced_and_deleted() -> RuleFault {
    RuleFault::new("a statement cannot be replaced and deleted", "Keep one of the two.")
}

struct RuleVisitor;

impl<'de> Visitor<'de> for RuleVisitor {
    type Value = RewriteRule;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a rule (`match:` and an action)")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RewriteRule, A::Error> {
        let mut draft = RuleDraft::default();
        let mut acts = false;
        while let Some(key) = map.next_key()? {
            match key {
                RuleKey::Match => {
                    let seed = CheckedTextSeed {
                        read: StatementPattern::new,
                        check: |found: &StatementPattern| draft.check_pattern(found),
                    };
                    draft.pattern = Some(map.next_value_seed(seed)?);
                }
                RuleKey::If => {
                    let seed = CheckedTextSeed {
                        read: read_condition,
                        check: |found: &_| draft.check_condition(found),
                    };
                    draft.condition = Some(map.next_value_seed(seed)?);
                }
                RuleKey::Replace => {
                    let seed = CheckedTextSeed {
                        read: StatementTemplate::new,
                        check: |found: &_| draft.check_replace(found),
                    };
                    draft.replace = Some(map.next_value_seed(seed)?);
                    acts = true;
                }
                RuleKey::Delete => {
                    draft.delete = map.next_value_seed(DeleteSeed { replaces: draft.replace.is_some() })?;
                    acts |= draft.delete;
                }
                RuleKey::InsertBefore => {
                    draft.before = map.next_value_seed(TemplateListSeed(&draft))?;
                    acts = true;
                }
                RuleKey::InsertAfter => {
                    draft.after = map.next_value_seed(TemplateListSeed(&draft))?;
                    acts = true;
                }
            }
        }
        let pattern = draft.pattern.ok_or_else(|| A::Error::missing_field("match"))?;
        if !acts {
            let help = "Add `replace: …`, `delete: true`, `insert_before: …` or `insert_after: …`.";
            return Err(A::Error::custom(RuleFault::new("the rule does nothing", help)));
        }
        Ok(RewriteRule {
            r#match: pattern,
            r#if: draft.condition,
            replace: draft.replace,
            delete: draft.delete,
            insert_before: draft.before,
            insert_after: draft.after,
        })
    }
}

fn read_condition(text: &str) -> Result<RuleCondition, RuleFault> {
    let expression = parse_condition(text)?;
    match expression.kind()? {
        ExpressionKind::Truth => Ok(RuleCondition(expression)),
        _ => Err(RuleFault::new(
            format!("`{text}` is neither true nor false"),
            format!("Compare it: {text} > 0."),
        )),
    }
}

/// Reads a text as a `T` and checks it against the rest of its rule.
struct CheckedTextSeed<R, C> {
    read: R,
    check: C,
}

impl<'de, T, R, C> DeserializeSeed<'de> for CheckedTextSeed<R, C>
where
    R: Fn(&str) -> Result<T, RuleFault>,
    C: Fn(&T) -> Result<(), RuleFault>,
{
    type Value = T;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<T, D::Error> {
        let text = String::deserialize(deserializer)?;
        let value = (self.read)(&text).map_err(D::Error::custom)?;
        (self.check)(&value).map_err(D::Error::custom)?;
        Ok(value)
    }
}

struct DeleteSeed {
    replaces: bool,
}

impl<'de> DeserializeSeed<'de> for DeleteSeed {
    type Value = bool;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<bool, D::Error> {
        match bool::deserialize(deserializer)? {
            true if self.replaces => Err(D::Error::custom(replaced_and_deleted())),
            delete => Ok(delete),
        }
    }
}

/// One statement, or a list of them.
struct TemplateListSeed<'d>(&'d RuleDraft);

impl<'de> DeserializeSeed<'de> for TemplateListSeed<'_> {
    type Value = Vec<StatementTemplate>;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<StatementTemplate>, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for TemplateListSeed<'_> {
    type Value = Vec<StatementTemplate>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a statement or a list of statements")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Vec<StatementTemplate>, E> {
        let template = StatementTemplate::new(text).map_err(E::custom)?;
        self.0.check_template(&template).map_err(E::custom)?;
        Ok(vec![template])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<StatementTemplate>, A::Error> {
        let mut templates = Vec::new();
        let seed = || CheckedTextSeed {
            read: StatementTemplate::new,
            check: |found: &_| self.0.check_template(found),
        };
        while let Some(template) = list.next_element_seed(seed())? {
            templates.push(template);
        }
        if templates.is_empty() {
            return Err(A::Error::custom(RuleFault::new("an empty list inserts nothing", "Remove the key.")));
        }
        Ok(templates)
    }
}

/// The schema of one statement.
struct StatementSchema;

impl JsonSchema for StatementSchema {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Statement".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "minLength": 1, "examples": ["FEDRAT/MMPM,$F"] })
    }
}

/// The schema of one or several statements.
struct StatementListSchema;

impl JsonSchema for StatementListSchema {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Statements".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "type": "string", "minLength": 1 },
                { "type": "array", "items": { "type": "string", "minLength": 1 }, "minItems": 1 },
            ],
        })
    }
}
