//! `where:`.

use clsmith::program::MotionClass;
use clsmith::recipe::parameters::Glob;
use clsmith::recipe::{MotionFacts, MotionFilter};

fn matches(text: &str, facts: MotionFacts<'_>) -> bool {
    serde_yaml::from_str::<MotionFilter>(text).unwrap().matches_motion(&facts)
}

#[test]
fn everything_is_meant_unless_something_is_said() {
    assert!(matches("{}", MotionFacts::default()));
    assert!(MotionFilter::default().matches_motion(&MotionFacts::default()));
}

#[test]
fn what_is_given_must_all_fit_and_of_a_list_one_has_to() {
    let facts = MotionFacts {
        operation: Some("POCKET_2 rough"),
        tool_number: Some(3),
        tool_name: Some("BALL_6"),
        motion: Some(MotionClass::StepOver),
        feed: Some(500.0),
        cuts_thread: false,
    };
    assert!(matches("{ operations: [X, POCKET*] }", facts));
    assert!(!matches("{ operations: [pocket*] }", facts), "names differ by case");
    assert!(!matches("{ operations: [POCKET] }", facts), "the whole name has to fit");
    assert!(matches("{ tools: [9, 3] }", facts));
    assert!(matches("{ tools: ['BALL_?'] }", facts));
    assert!(!matches("{ tools: ['3'] }", facts), "in quotes it is a name");
    assert!(matches("{ motions: [cut, step_over] }", facts));
    assert!(matches("{ feed: { min: 500, max: 500 } }", facts));
    assert!(!matches("{ feed: { max: 499.9 } }", facts));
    assert!(!matches("{ feed: { min: 500.1 } }", facts));
    assert!(!matches("{ operations: [POCKET*], tools: [4] }", facts));
    assert!(!matches("{ threads: true }", facts));
    assert!(matches("{ threads: false }", facts));
    assert!(matches("{ threads: true }", MotionFacts { cuts_thread: true, ..facts }));
}

#[test]
fn what_is_not_known_does_not_fit() {
    for text in [
        "{ operations: ['*'] }",
        "{ tools: [1] }",
        "{ tools: ['*'] }",
        "{ motions: [rapid] }",
        "{ feed: { min: 0 } }",
    ] {
        assert!(!matches(text, MotionFacts::default()), "{text}");
    }
}

#[test]
fn a_star_matches_anything_and_special_characters_can_be_escaped() {
    let fits = |glob: &str, name: &str| Glob::new(glob).unwrap().matches_name(name);
    assert!(fits("*", ""));
    assert!(fits("*", "a/b c\\d.e"));
    assert!(fits("A*C", "A/B/C"));
    assert!(fits("{ROUGH,FINISH}_*", "FINISH_2"));
    assert!(fits("DRILL\\[1\\]", "DRILL[1]"));
    assert!(fits("DRILL[12]", "DRILL2"));
    assert!(fits("FRÄSEN_?", "FRÄSEN_2"));
    assert!(fits("FR*SEN", "FRÄSEN"));
    assert!(Glob::new("A[").is_err());
    assert!(Glob::new("").is_err());
}
