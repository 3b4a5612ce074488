//! What is said about broken rules, and what is underlined.

use super::{rules, shown};
use crate::support::{self, snapshots};
use clsmith::source::Source;
use clsmith::transform::Recipe;

/// All that is wrong with a step.
fn faults(step: &str) -> String {
    let recipe = format!("version: 1\nsteps:\n{step}");
    let found = Recipe::load(&Source::new("recipe.yaml", recipe.into_bytes()).unwrap()).unwrap_err();
    found.findings().iter().map(shown).collect()
}

#[track_caller]
fn messages(name: &str, rule_texts: &[&str]) {
    let mut text = String::new();
    for rule in rule_texts {
        text += &format!("| {rule}\n{}\n", faults(&rules(&[rule])));
    }
    snapshots("rewrite").bind(|| insta::assert_snapshot!(name, text));
}

#[test]
fn patterns() {
    messages(
        "patterns",
        &[
            "match: '', delete: true",
            "match: 5, delete: true",
            "match: '1,2,$X', delete: true",
            "match: 'L1 = LINE/$X', delete: true",
            "match: 'FEDRAT/MMPM,(', delete: true",
            "match: 'FEDRAT/MMPM,$', delete: true",
            "match: \"A\\nB\", delete: true",
            "match: 'LOAD/$...REST,TOOL', delete: true",
            "match: 'PPRINT $...A $B', delete: true",
            "match: '$...A/ON', delete: true",
            "match: 'PPRINT $A$B', delete: true",
            "match: \"SYN/'$A'\", delete: true",
            "match: 'A/${X}', delete: true",
            "match: 'A/$X,$...X', delete: true",
            "match: 'A $$ comment', delete: true",
            "match: \"A\\x7F\", delete: true",
        ],
    );
}

#[test]
fn templates() {
    messages(
        "templates",
        &[
            "match: 'A/$X', replace: 'B/$Y'",
            "match: A, replace: 'B/$Y'",
            "match: 'LOAD/TOOL,$N', insert_after: [STOP, 'PPRINT $Nmm']",
            "insert_before: 'PPRINT $N', match: 'LOAD/TOOL,$M'",
            "match: 'A/$X', replace: 'B/${X *}'",
            "match: 'A/$X', replace: 'B/${X > 1}'",
            "match: 'A/$X', replace: 'B/${'",
            "match: 'A/$X', replace: 'B/$...'",
            "match: 'A/$...X', replace: 'B/${X + 1}'",
            "match: A, replace: 'GOTO/1,2'",
            "match: A, insert_after: [\"B\\nC\"]",
            "match: A, replace: '1,2,3'",
            "match: A, insert_before: []",
            "match: A, insert_before: { B: C }",
            "match: A, replace: ''",
        ],
    );
}

#[test]
fn conditions_at_load() {
    messages(
        "conditions_at_load",
        &[
            "match: 'A/$X', if: '$X = 1', delete: true",
            "match: 'A/$X', if: '$X > ', delete: true",
            "match: 'A/$X', if: '$X', delete: true",
            "match: 'A/$X', if: '$X + 1', delete: true",
            "match: 'A/$X', if: \"$X < 'B'\", delete: true",
            "match: 'A/$X', if: \"1 == 'B'\", delete: true",
            "match: 'A/$X', if: '1 < $X < 3', delete: true",
            "match: 'A/$X', if: '$X and $X > 1', delete: true",
            "match: 'A/$X', if: 'not $X', delete: true",
            "match: 'A/$X', if: '$Y > 1', delete: true",
            "match: 'A/$X', if: '$X == MMPM', delete: true",
            "match: 'A/$X', if: '$X == \"MMPM\"', delete: true",
            "match: 'A/$...X', if: '$X > 1', delete: true",
            "match: 'A/$X', if: true, delete: true",
            "match: 'A/$X', if: '$X > 5mm', delete: true",
        ],
    );
}

#[test]
fn rules_as_a_whole() {
    messages(
        "rules",
        &[
            "match: A",
            "delete: true",
            "match: A, delete: false",
            "match: A, replace: B, delete: true",
            "match: A, delete: true, replace: B",
            "match: A, remove: true",
            "match: A, delete: 'yes'",
            "match: 'A/${', replace: 'B/$X', if: '$X >'",
        ],
    );
    let mut text = String::new();
    for step in [
        "  - rewrite: { rules: [] }\n",
        "  - rewrite:\n",
        "  - rewrite: { rules: [{ match: A, delete: true }], where: { motions: [cut] } }\n",
        "  - rewrite: { rules: [{ match: A, delete: true }], where: { operations: [] } }\n",
        "  - rewrite: { rules: [A] }\n",
    ] {
        text += &format!("|{step}{}\n", faults(step));
    }
    snapshots("rewrite").bind(|| insta::assert_snapshot!("step", text));
}

#[test]
fn hostile_texts_are_refused_not_crashed_on() {
    for text in ["(".repeat(900_000), "-".repeat(900_000), "1+".repeat(400_000), "not ".repeat(200_000)] {
        let rule = format!("match: 'A/$X', if: '{text}1', delete: true");
        assert!(faults(&rules(&[&rule])).contains("if"));
    }
    for text in ["(A/".repeat(650), "1 ".repeat(990), "- ".repeat(900), "(".repeat(30), "${".repeat(900)] {
        for rule in [format!("match: 'A/{text}', delete: true"), format!("match: A, replace: 'B/{text}'")] {
            let recipe = format!("version: 1\nsteps:\n{}", rules(&[&rule]));
            let _ = Recipe::load(&support::text(recipe));
        }
    }
    for condition in ["-".repeat(1900), "not ".repeat(450), "1+".repeat(900), "(".repeat(29)] {
        let rule = format!("match: 'A/$X', if: '{condition}1', delete: true");
        let recipe = format!("version: 1\nsteps:\n{}", rules(&[&rule]));
        let _ = Recipe::load(&support::text(recipe));
    }
}
