//! What good recipes mean.

use super::{Step, good, load, source, step};
use clsmith::recipe::parameters::{LengthUnit, Positive, PositiveCount};
use clsmith::recipe::{Recipe, YamlPathSegment};
use clsmith::setup::Setup;
use clsmith::source::SourceReadError;

#[test]
fn a_whole_recipe() {
    let recipe = good(
        "version: 1\nunits: inch\nsetup_file: shop.yaml\nsetup:\n  machine: { max_feed: 100, rapid_feed: 400.5 }\n\
         steps:\n  - scale_feed: { factor: 0.5, share: 1, where: { operations: [\"POCKET*\"], tools: [3, T*] } }\n\
         \x20 - rewrite:\n      rules:\n        - find: \"A*\"\n          replace: B\n          once: true\n  - reverse\n",
    );
    assert_eq!(recipe.version, 1);
    assert_eq!(recipe.units, LengthUnit::Inch);
    assert_eq!(recipe.setup_file.as_deref(), Some("shop.yaml"));
    assert_eq!(recipe.setup.machine.max_feed, Positive::new(2540.0));
    assert_eq!(recipe.steps.len(), 3);
    let Step::ScaleFeed(scale) = &recipe.steps[0] else { panic!() };
    assert_eq!((scale.factor.get(), scale.share.unwrap().get()), (0.5, 1.0));
    assert_eq!(recipe.steps[2], Step::Reverse);
}

#[test]
fn units_are_millimetres_and_the_setup_is_unknown_unless_said() {
    let recipe = good("version: 1\nsteps: []\n");
    assert_eq!(recipe.units, LengthUnit::Mm);
    assert_eq!(recipe.setup, Setup::default());
    assert!(recipe.steps.is_empty());
}

#[test]
fn a_step_without_settings_is_a_bare_word_or_an_empty_key_or_an_empty_map() {
    for text in ["shift", "shift:", "shift: {}", "'shift'"] {
        assert_eq!(good(&step(text)).steps, [Step::Shift(super::Shift::default())], "{text}");
    }
    for text in ["reverse", "reverse:", "reverse: {}"] {
        assert_eq!(good(&step(text)).steps, [Step::Reverse], "{text}");
    }
}

#[test]
fn a_key_with_nothing_below_it_says_nothing() {
    assert_eq!(good("version: 1\nsetup:\n  machine:\n  # max_feed: 3\nsteps: []").setup, Setup::default());
    good(&step("scale_feed: { factor: 1, where: }"));
}

#[test]
fn whole_numbers_and_exponents_are_numbers() {
    for (text, value) in [("2", 2.0), ("2.5", 2.5), ("1e-1", 0.1), ("+3", 3.0), ("0x10", 16.0)] {
        let recipe = good(&step(&format!("scale_feed: {{ factor: {text} }}")));
        let Step::ScaleFeed(scale) = &recipe.steps[0] else { panic!() };
        assert_eq!(scale.factor.get(), value, "{text}");
    }
    good(&step("shift: { by: [-1, 2.5, 0] }"));
    let count: PositiveCount = serde_json::from_str("4").unwrap();
    assert_eq!(count.get(), 4);
    assert!(serde_json::from_str::<PositiveCount>("4.5").is_err());
    assert!(serde_json::from_str::<PositiveCount>("0").is_err());
}

#[test]
fn steps_may_share_a_value_by_an_alias() {
    let recipe = good(
        "version: 1\nsteps:\n  - scale_feed: { factor: 1, where: &w { motions: [cut] } }\n  - scale_feed: { factor: 2, where: *w }\n",
    );
    let [Step::ScaleFeed(one), Step::ScaleFeed(two)] = recipe.steps.as_slice() else { panic!() };
    assert_eq!(one.part, two.part);
}

#[test]
fn json_line_ends_and_byte_order_marks_do_not_matter() {
    good(r#"{"version": 1, "steps": [{"scale_feed": {"factor": 0.5}}]}"#);
    good("version: 1\r\nsteps:\r\n  - shift: { limit: 1 }\r\n");
    good("\u{feff}version: 1\nsteps: []\n");
    good("%YAML 1.2\n---\nversion: 1\nsteps: []\n...\n");
}

#[test]
fn the_command_line_overrides_the_recipe_and_the_recipe_its_setup_file() {
    let recipe = good("version: 1\nsetup_file: shop.yaml\nsetup: { machine: { max_feed: 200 } }\nsteps: []");
    let file = recipe
        .load_setup_file(|path| {
            assert_eq!(path, "shop.yaml");
            Ok(source("units: inch\nmachine: { max_feed: 1, rapid_feed: 10 }"))
        })
        .unwrap();
    assert_eq!(file.machine.rapid_feed, Positive::new(254.0));
    let merged = recipe.merge_setups(file.clone(), Setup::default());
    assert_eq!(merged.machine.max_feed, Positive::new(200.0));
    assert_eq!(merged.machine.rapid_feed, Positive::new(254.0));
    let typed = Setup::load(&source("machine: { max_feed: 7 }")).unwrap();
    assert_eq!(recipe.merge_setups(file, typed).machine.max_feed, Positive::new(7.0));
}

fn unreadable(name: &str) -> SourceReadError {
    SourceReadError::Unreadable { name: name.to_owned(), error: std::io::Error::other("no such file") }
}

#[test]
fn a_setup_file_that_cannot_be_read_is_reported_where_it_is_named() {
    let recipe = good("version: 1\nsetup_file: 'my shop.yaml'\nsteps: []");
    let found = recipe.load_setup_file(|name| Err(unreadable(name))).unwrap_err();
    assert_eq!(found.findings()[0].code.id(), "CL0220");
    assert_eq!(super::underlined_by(&found.findings()[0]), "'my shop.yaml'");
    let found = recipe.load_setup_file(|_| Ok(source("machine: { max_fed: 1 }"))).unwrap_err();
    assert_eq!(super::underlined_by(&found.findings()[0]), "max_fed");
    assert_eq!(good("version: 1\nsteps: []").load_setup_file(|_| panic!()).unwrap(), Setup::default());
}

#[test]
fn a_recipe_can_be_moved_between_threads() {
    fn check<T: Send + Sync>() {}
    check::<Recipe<Step>>();
    assert!(load("version: 1\nsteps: []").unwrap().value_span(&[YamlPathSegment::Key("version")]).is_some());
}
