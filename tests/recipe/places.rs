//! Places of values after loading.

use super::{Step, good};
use clsmith::recipe::Recipe;
use clsmith::recipe::YamlPathSegment::{Index, Key};
use clsmith::source::Span;

const TEXT: &str = "version: 1\nunits: mm\nsetup: { machine: { max_feed: 8000 } }\nsteps:\n  - scale_feed: { factor: 0.50, where: { operations: [\"A, B\", 'C*'] } }\n  - reverse\n  - \"shift\":\n      by: [1, -2.0, 3]\n      limit:\n";

fn text(recipe: &Recipe<Step>, span: Span) -> String {
    String::from_utf8(recipe.source.slice(span).to_vec()).unwrap()
}

#[test]
fn every_value_has_a_place() {
    let recipe = good(TEXT);
    let at = |path: &[_]| recipe.value_span(path).map(|span| text(&recipe, span));
    assert_eq!(at(&[Key("version")]).unwrap(), "1");
    assert_eq!(at(&[Key("setup"), Key("machine"), Key("max_feed")]).unwrap(), "8000");
    let scale = [Key("steps"), Index(0), Key("scale_feed")];
    assert_eq!(at(&[&scale[..], &[Key("factor")]].concat()).unwrap(), "0.50");
    assert_eq!(at(&[&scale[..], &[Key("where"), Key("operations"), Index(0)]].concat()).unwrap(), "\"A, B\"");
    assert_eq!(at(&[&scale[..], &[Key("where"), Key("operations"), Index(1)]].concat()).unwrap(), "'C*'");
    assert_eq!(at(&[Key("steps"), Index(2), Key("shift"), Key("limit")]).unwrap(), "limit");
    assert_eq!(at(&[Key("steps"), Index(2), Key("shift"), Key("by"), Index(1)]).unwrap(), "-2.0");
    assert_eq!(at(&[]).unwrap(), "version: 1");
    assert_eq!(at(&[Key("steps"), Index(3)]), None);
    assert_eq!(at(&[Key("nothing")]), None);
    assert_eq!(at(&[Key("version"), Key("deeper")]), None);
    let key = recipe.key_span(&[Key("steps"), Index(2), Key("shift")]).unwrap();
    assert_eq!(text(&recipe, key), "\"shift\"");
}

#[test]
fn every_step_has_a_place_and_its_parameters_fall_back_to_it() {
    let recipe = good(TEXT);
    let names: Vec<String> = (0..3).map(|index| text(&recipe, recipe.step_span(index))).collect();
    assert_eq!(names, ["scale_feed", "reverse", "\"shift\""]);
    let at = |index, keys: &[&str]| text(&recipe, recipe.step_value_span(index, keys));
    assert_eq!(at(0, &["factor"]), "0.50");
    assert_eq!(at(0, &["where", "operations", "1"]), "'C*'");
    assert_eq!(at(0, &["where", "tools"]), "{ operations: [\"A, B\", 'C*'] }");
    assert_eq!(at(0, &["share"]), "scale_feed");
    assert_eq!(at(0, &[]), "scale_feed");
    assert_eq!(at(1, &["anything"]), "reverse");
    assert_eq!(at(2, &["by", "2"]), "3");
    assert_eq!(recipe.step_span(9), Span::default());
}
