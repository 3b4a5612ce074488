//! This module holds rules as they are written: what serde reads, and what the JSON schema gives editors.

use super::{RecipeAndSetup, RecipeFallback, RecipeRule, RecipeRuleCondition, RecipeRules};
use crate::diagnostic::{DiagnosticCode, Failure, codes};
use crate::parameters::{FilePath, Glob, ToolPattern};
use crate::source::Source;
use crate::yaml::{LocatedYamlFault, YamlDocument, YamlFaultKind, YamlPathSegment};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;
use std::sync::Arc;

/// Which recipe a program gets, for `clsmith hook --select` and `clsmith watch --select`. The first rule that
/// matches counts.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith recipe selection", rename = "Selection")]
struct RecipeRulesText {
    /// The rules, which are tried from the first to the last.
    #[serde(deserialize_with = "deserialize_rules")]
    #[schemars(length(min = 1))]
    rules: Vec<RecipeRuleText>,
    /// What happens to a program that no rule matches: `stop` (also when it is left out), `pass` (it passes
    /// unchanged), or a recipe.
    #[serde(default)]
    otherwise: RecipeFallbackText,
}

/// A rule.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Rule")]
struct RecipeRuleText {
    /// The conditions on the program. All given keys must match, and at least one element of each list.
    #[serde(deserialize_with = "deserialize_condition")]
    when: RecipeRuleConditionText,
    /// The recipe, relative to this file's folder.
    recipe: FilePath,
    /// A setup file that overrides the recipe's, relative to this file's folder.
    setup: Option<FilePath>,
}

/// The conditions on a program.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "When", extend("minProperties" = 1))]
struct RecipeRuleConditionText {
    /// The program's `MACHIN/` record: its first field, or all of them without blanks (`UNCX01`, `UNCX01,1`).
    machine: Option<OneOrMorePatterns<Glob>>,
    /// Number or name of any tool that moves in the program.
    tool: Option<OneOrMorePatterns<ToolPattern>>,
    /// Name of any operation of the program.
    operation: Option<OneOrMorePatterns<Glob>>,
    /// Name of the file, without its folder.
    file: Option<OneOrMorePatterns<Glob>>,
}

/// What happens to a program that no rule matches.
#[derive(Debug, Default, JsonSchema)]
#[schemars(untagged, rename = "Otherwise")]
enum RecipeFallbackText {
    /// It stops the run, or passes unchanged.
    Word(FallbackWordText),
    /// It is corrected by this recipe.
    Recipe(FallbackRecipeText),
    #[default]
    #[schemars(skip)]
    Unsaid,
}

/// `stop` or `pass`.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
enum FallbackWordText {
    /// It stops the run.
    Stop,
    /// It passes unchanged.
    Pass,
}

/// A recipe for all other programs.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OtherRecipe")]
struct FallbackRecipeText {
    /// The recipe, relative to this file's folder.
    recipe: FilePath,
    /// A setup file that overrides the recipe's, relative to this file's folder.
    setup: Option<FilePath>,
}

/// One pattern, or a list of them.
#[derive(Debug, JsonSchema)]
#[schemars(untagged, inline)]
enum OneOrMorePatterns<T> {
    One(T),
    More(#[schemars(length(min = 1))] Vec<T>),
}

impl<T> OneOrMorePatterns<T> {
    fn into_list(self) -> Vec<T> {
        match self {
            Self::One(one) => vec![one],
            Self::More(more) => more,
        }
    }
}

/// Returns the JSON schema of a file of rules.
pub fn rules_schema() -> serde_json::Value {
    crate::yaml::make_file_schema::<RecipeRulesText>("select")
}

pub(super) fn load_rules(source: &Arc<Source>) -> Result<RecipeRules, Failure> {
    let document = YamlDocument::parse(source)?;
    let text: RecipeRulesText = document.deserialize_checked(word_rules_fault)?;
    let rules = text.rules.into_iter().map(|rule| RecipeRule {
        when: RecipeRuleCondition {
            machine: rule.when.machine.map(OneOrMorePatterns::into_list),
            tool: rule.when.tool.map(OneOrMorePatterns::into_list),
            operation: rule.when.operation.map(OneOrMorePatterns::into_list),
            file: rule.when.file.map(OneOrMorePatterns::into_list),
        },
        job: RecipeAndSetup { recipe: rule.recipe, setup: rule.setup },
    });
    let otherwise = match text.otherwise {
        RecipeFallbackText::Recipe(FallbackRecipeText { recipe, setup }) => {
            RecipeFallback::Recipe(RecipeAndSetup { recipe, setup })
        }
        RecipeFallbackText::Word(FallbackWordText::Pass) => RecipeFallback::Pass,
        RecipeFallbackText::Word(FallbackWordText::Stop) | RecipeFallbackText::Unsaid => RecipeFallback::Stop,
    };
    Ok(RecipeRules { source: Arc::clone(source), rules: rules.collect(), otherwise, document })
}

/// Words the fault when a recipe was given in place of the rules.
fn word_rules_fault(finding: &LocatedYamlFault<'_>) -> Option<(DiagnosticCode, String, String)> {
    match (finding.kind, finding.path) {
        (YamlFaultKind::Missing { name: "rules" }, []) | (YamlFaultKind::Type { .. }, []) => {
            let message = "the selection has no `rules`".to_owned();
            let help = "A selection is a list `rules:` of `- when: { file: \"*.cls\" }` with `recipe: name.yaml` below. For one \
                        recipe for all programs, give `--recipe` instead.";
            Some((codes::MISSING_KEY, message, help.to_owned()))
        }
        (YamlFaultKind::UnknownKey { name, .. }, [YamlPathSegment::Key(_)]) if name == "steps" => {
            let message = "this is a recipe, not a selection of recipes".to_owned();
            Some((codes::UNKNOWN_KEY, message, "Give it by `--recipe`.".to_owned()))
        }
        _ => None,
    }
}

fn deserialize_rules<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<RecipeRuleText>, D::Error> {
    let rules = Vec::deserialize(deserializer)?;
    if rules.is_empty() {
        return Err(de::Error::custom(
            "there is no rule\nFor one recipe for all programs, give `--recipe` instead.",
        ));
    }
    Ok(rules)
}

fn deserialize_condition<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<RecipeRuleConditionText, D::Error> {
    let when = RecipeRuleConditionText::deserialize(deserializer)?;
    let is_empty =
        matches!(when, RecipeRuleConditionText { machine: None, tool: None, operation: None, file: None });
    if is_empty {
        return Err(de::Error::custom(
            "`when` has no condition, so every program matches\nAdd machine, tool, operation or file; a recipe for all others \
             belongs under `otherwise`.",
        ));
    }
    Ok(when)
}

impl<'de> Deserialize<'de> for RecipeFallbackText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RecipeFallbackVisitor)
    }
}

struct RecipeFallbackVisitor;

impl<'de> Visitor<'de> for RecipeFallbackVisitor {
    type Value = RecipeFallbackText;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("`stop`, `pass` or `{ recipe: name.yaml }`")
    }
    fn visit_str<E: de::Error>(self, word: &str) -> Result<RecipeFallbackText, E> {
        FallbackWordText::deserialize(word.into_deserializer()).map(RecipeFallbackText::Word)
    }
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RecipeFallbackText, A::Error> {
        FallbackRecipeText::deserialize(MapAccessDeserializer::new(map)).map(RecipeFallbackText::Recipe)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMorePatterns<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrMorePatternsVisitor(PhantomData))
    }
}

struct OneOrMorePatternsVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for OneOrMorePatternsVisitor<T> {
    type Value = OneOrMorePatterns<T>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name or pattern, or a list of them")
    }
    fn visit_str<E: de::Error>(self, text: &str) -> Result<OneOrMorePatterns<T>, E> {
        T::deserialize(text.into_deserializer()).map(OneOrMorePatterns::One)
    }
    fn visit_u64<E: de::Error>(self, number: u64) -> Result<OneOrMorePatterns<T>, E> {
        T::deserialize(number.into_deserializer()).map(OneOrMorePatterns::One)
    }
    fn visit_i64<E: de::Error>(self, number: i64) -> Result<OneOrMorePatterns<T>, E> {
        T::deserialize(number.into_deserializer()).map(OneOrMorePatterns::One)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<OneOrMorePatterns<T>, A::Error> {
        let mut more = Vec::new();
        while let Some(one) = list.next_element()? {
            more.push(one);
        }
        if more.is_empty() {
            return Err(de::Error::custom(
                "an empty list fits nothing\nRemove the key to ask nothing of it.",
            ));
        }
        Ok(OneOrMorePatterns::More(more))
    }
}
