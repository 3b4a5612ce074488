//! Rules as they are written: what serde reads, and what the JSON schema tells editors.

use super::{Otherwise, RecipeAndSetup, Rule, Rules, When};
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::source::Source;
use crate::values::{FilePath, Glob, ToolPattern};
use crate::yaml::{Document, Finding, Kind, Segment};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;
use std::sync::Arc;

/// Which recipe a program gets, for `clsmith hook --select` and `clsmith watch --select`: the first rule that fits wins.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith recipe selection", rename = "Selection")]
struct RulesText {
    /// The rules, looked at from the first to the last.
    #[serde(deserialize_with = "some_rules")]
    #[schemars(length(min = 1))]
    rules: Vec<RuleText>,
    /// What becomes of a program that no rule fits: `stop` (also when left out), `pass` (it goes on as it is), or a recipe.
    #[serde(default)]
    otherwise: OtherwiseText,
}

/// A rule.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Rule")]
struct RuleText {
    /// What the program must be like. All that is given must fit; of a list, one has to.
    #[serde(deserialize_with = "something")]
    when: WhenText,
    /// The recipe, relative to this file's folder.
    recipe: FilePath,
    /// A setup file that overrides the recipe's, relative to this file's folder.
    setup: Option<FilePath>,
}

/// What a program must be like.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "When", extend("minProperties" = 1))]
struct WhenText {
    /// The program's `MACHIN/` record: its first field, or all of them without blanks (`UNCX01`, `UNCX01,1`).
    machine: Option<OneOrMore<Glob>>,
    /// Number or name of any tool that moves in the program.
    tool: Option<OneOrMore<ToolPattern>>,
    /// Name of any operation of the program.
    operation: Option<OneOrMore<Glob>>,
    /// Name of the file, without its folder.
    file: Option<OneOrMore<Glob>>,
}

/// What becomes of a program that no rule fits.
#[derive(Debug, Default, JsonSchema)]
#[schemars(untagged, rename = "Otherwise")]
enum OtherwiseText {
    /// It stops the run, or goes on as it is.
    Word(Word),
    /// It is corrected by this recipe.
    Recipe(RecipeText),
    #[default]
    #[schemars(skip)]
    Unsaid,
}

/// `stop` or `pass`.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
enum Word {
    /// It stops the run.
    Stop,
    /// It goes on as it is.
    Pass,
}

/// A recipe for all other programs.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OtherRecipe")]
struct RecipeText {
    /// The recipe, relative to this file's folder.
    recipe: FilePath,
    /// A setup file that overrides the recipe's, relative to this file's folder.
    setup: Option<FilePath>,
}

/// One pattern, or a list of them.
#[derive(Debug, JsonSchema)]
#[schemars(untagged, inline)]
enum OneOrMore<T> {
    One(T),
    More(#[schemars(length(min = 1))] Vec<T>),
}

impl<T> OneOrMore<T> {
    fn list(self) -> Vec<T> {
        match self {
            Self::One(one) => vec![one],
            Self::More(more) => more,
        }
    }
}

/// JSON schema of a file of rules.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(RulesText).to_value()
}

pub(super) fn load(source: &Arc<Source>) -> Result<Rules, Vec<Diagnostic>> {
    let document = Document::read(source).map_err(|diagnostic| vec![*diagnostic])?;
    let text: RulesText = document.check(special)?;
    let rules = text.rules.into_iter().map(|rule| Rule {
        when: When {
            machine: rule.when.machine.map(OneOrMore::list),
            tool: rule.when.tool.map(OneOrMore::list),
            operation: rule.when.operation.map(OneOrMore::list),
            file: rule.when.file.map(OneOrMore::list),
        },
        job: RecipeAndSetup { recipe: rule.recipe, setup: rule.setup },
    });
    let otherwise = match text.otherwise {
        OtherwiseText::Recipe(RecipeText { recipe, setup }) => {
            Otherwise::Recipe(RecipeAndSetup { recipe, setup })
        }
        OtherwiseText::Word(Word::Pass) => Otherwise::Pass,
        OtherwiseText::Word(Word::Stop) | OtherwiseText::Unsaid => Otherwise::Stop,
    };
    Ok(Rules { source: Arc::clone(source), rules: rules.collect(), otherwise, document })
}

/// A recipe given in place of the rules is told by name.
fn special(finding: &Finding<'_>) -> Option<(Code, String, String)> {
    match (finding.kind, finding.path) {
        (Kind::Missing { name: "rules" }, []) | (Kind::Type { .. }, []) => {
            let message = "the selection has no `rules`".to_owned();
            let help = "A selection is a list `rules:` of `- when: { file: \"*.cls\" }` with `recipe: name.yaml` below. For one \
                        recipe for all programs give `--recipe` instead.";
            Some((codes::MISSING_KEY, message, help.to_owned()))
        }
        (Kind::UnknownKey { name, .. }, [Segment::Key(_)]) if name == "steps" => {
            let message = "this is a recipe, not a selection of recipes".to_owned();
            Some((codes::UNKNOWN_KEY, message, "Give it by `--recipe`.".to_owned()))
        }
        _ => None,
    }
}

fn some_rules<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<RuleText>, D::Error> {
    let rules = Vec::deserialize(deserializer)?;
    if rules.is_empty() {
        return Err(de::Error::custom(
            "there is no rule\nFor one recipe for all programs give `--recipe` instead.",
        ));
    }
    Ok(rules)
}

fn something<'de, D: Deserializer<'de>>(deserializer: D) -> Result<WhenText, D::Error> {
    let when = WhenText::deserialize(deserializer)?;
    let is_empty = matches!(when, WhenText { machine: None, tool: None, operation: None, file: None });
    if is_empty {
        return Err(de::Error::custom(
            "`when` asks for nothing, so every program fits\nSay machine, tool, operation or file; a recipe for all others \
             stands under `otherwise`.",
        ));
    }
    Ok(when)
}

impl<'de> Deserialize<'de> for OtherwiseText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OtherwiseVisitor)
    }
}

struct OtherwiseVisitor;

impl<'de> Visitor<'de> for OtherwiseVisitor {
    type Value = OtherwiseText;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("`stop`, `pass` or `{ recipe: name.yaml }`")
    }
    fn visit_str<E: de::Error>(self, word: &str) -> Result<OtherwiseText, E> {
        Word::deserialize(word.into_deserializer()).map(OtherwiseText::Word)
    }
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<OtherwiseText, A::Error> {
        RecipeText::deserialize(MapAccessDeserializer::new(map)).map(OtherwiseText::Recipe)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMore<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrMoreVisitor(PhantomData))
    }
}

struct OneOrMoreVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for OneOrMoreVisitor<T> {
    type Value = OneOrMore<T>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name or pattern, or a list of them")
    }
    fn visit_str<E: de::Error>(self, text: &str) -> Result<OneOrMore<T>, E> {
        T::deserialize(text.into_deserializer()).map(OneOrMore::One)
    }
    fn visit_u64<E: de::Error>(self, number: u64) -> Result<OneOrMore<T>, E> {
        T::deserialize(number.into_deserializer()).map(OneOrMore::One)
    }
    fn visit_i64<E: de::Error>(self, number: i64) -> Result<OneOrMore<T>, E> {
        T::deserialize(number.into_deserializer()).map(OneOrMore::One)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<OneOrMore<T>, A::Error> {
        let mut more = Vec::new();
        while let Some(one) = list.next_element()? {
            more.push(one);
        }
        if more.is_empty() {
            return Err(de::Error::custom(
                "an empty list fits nothing\nRemove the key to ask nothing of it.",
            ));
        }
        Ok(OneOrMore::More(more))
    }
}
