//! What is said about broken recipes, and what is underlined.

use super::{bad, describe, fault, step};
use crate::support::snapshots;

/// Every message in one place, for reading: does each say what is wrong, and what to do?
#[track_caller]
fn messages(name: &str, recipes: &[&str]) {
    let mut text = String::new();
    for recipe in recipes {
        for line in recipe.lines() {
            text += &format!("| {line}\n");
        }
        text += &describe(&bad(recipe));
        text += "\n";
    }
    snapshots("recipe").bind(|| insta::assert_snapshot!(name, text));
}

#[test]
fn messages_about_yaml() {
    messages(
        "yaml",
        &[
            "version: 1\nsteps:\n\t- reverse\n",
            "version: 1\nsteps:\n  - shift:\n\tlimit: 1\n",
            "version: 1\n steps: []\n",
            "version: 1\nsteps\n",
            "version: 1\nsteps: [reverse\n",
            "version: 1\nsteps:\n  - scale_feed: { factor: 1, where: { operations: [*ROUGH] } }\n",
            "version: 1\nsteps:\n  - scale_feed: { factor: 1, where: { operations: [**] } }\n",
            "version: 1\nsetup_file: \"shop.yaml\nsteps: []\n",
            "version: 1\nsetup_file: @shop\nsteps: []\n",
            "version: 1\nsetup_file: \"C:\\shop\"\nsteps: []\n",
            "version: 1\nsteps:\n  - reverse\n - shift\n",
            "version: 1\nsetup_file: a: b\nsteps: []\n",
            "",
            "# only a comment\n",
            "version: 1\nsteps: []\n---\nversion: 1\nsteps: []\n",
            "version: 1\nunits: mm\nsteps: []\nunits: inch\n",
            "version: 1\nsteps:\n  - !scale_feed { factor: 1 }\n",
            "version: 1\n[a, b]: 1\nsteps: []\n",
            "version: 1\nsteps: []\u{7}\n",
        ],
    );
}

#[test]
fn messages_about_keys_and_steps() {
    messages(
        "keys",
        &[
            "version: 1\nstep: []\nsteps: []\n",
            "version: 1\nsteps: []\ncolour: red\n",
            "version: 1\n",
            "steps: []\n",
            "version: 2\nsteps:\n  - from_the_future\nnew: thing\n",
            "version: '1'\nsteps: []\n",
            "version: 1\nunits: mn\nsteps: []\n",
            "version: 1\nunits: furlong\nsteps: []\n",
            "version: 1\nsteps:\n  - scale_feeds: { factor: 1 }\n  - polish\n",
            "version: 1\nsteps:\n  - scale_feed: { faktor: 0.5 }\n",
            "version: 1\nsteps:\n  - scale_feed:\n    factor: 0.5\n",
            "version: 1\nsteps:\n  - scale_feed\n",
            "version: 1\nsteps:\n  - {}\n  -\n  - 5\n",
            "version: 1\nsteps:\n  - reverse: { fast: true }\n",
            "version: 1\nsteps:\n  - rewrite:\n      rules:\n        - find: A\n",
            "version: 1\nsteps:\n  scale_feed: { factor: 1 }\n",
            "version: 1\nsteps:\n",
            "- scale_feed\n",
            "version: 1\nsetup: { machine: { max_fed: 1 }, tolls: [] }\nsteps: []\n",
            "version: 1\nsteps:\n  - scale_feed: { <<: { factor: 1 }, factor: 1 }\n",
        ],
    );
}

#[test]
fn messages_about_values() {
    let steps = [
        "scale_feed: { factor: 0 }",
        "scale_feed: { factor: -1.5 }",
        "scale_feed: { factor: .nan }",
        "scale_feed: { factor: .inf }",
        "scale_feed: { factor: 1e999 }",
        "scale_feed: { factor: 5 mm }",
        "scale_feed: { factor: '5' }",
        "scale_feed: { factor: \"0,8\" }",
        "scale_feed: { factor: 80 % }",
        "scale_feed: { factor: fast }",
        "scale_feed: { factor: true }",
        "scale_feed: { factor: [1] }",
        "scale_feed: { factor: }",
        "scale_feed: { factor: 1, share: 1.5 }",
        "shift: { by: [1, 2] }",
        "shift: { by: [1, 2, 3, 4] }",
        "shift: { by: [1, x, 3] }",
        "rewrite: { rules: [{ find: 'A[', replace: B }] }",
        "rewrite: { rules: [{ find: A, replace: 5 }] }",
        "rewrite: { rules: [{ find: A, replace: B, once: 1 }] }",
        "scale_feed: { factor: 1, where: { operations: [] } }",
        "scale_feed: { factor: 1, where: { operations: [100] } }",
        "scale_feed: { factor: 1, where: { operations: POCKET } }",
        "scale_feed: { factor: 1, where: { tools: [-1] } }",
        "scale_feed: { factor: 1, where: { tools: [1.5] } }",
        "scale_feed: { factor: 1, where: { motions: [cutt] } }",
        "scale_feed: { factor: 1, where: { feed: { min: 3, max: 1 } } }",
        "scale_feed: { factor: 1, where: { feed: {} } }",
    ];
    let recipes: Vec<String> = steps.iter().map(|text| step(text)).collect();
    messages("values", &recipes.iter().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn exactly_the_value_is_underlined() {
    fault(&step("scale_feed: { factor: -0.5, share: 1 }"), "CL0215", "-0.5");
    fault(&step("scale_feed: {factor: -0.5}"), "CL0215", "-0.5");
    fault(&step("scale_feed:\n      factor:   -0.5   # no"), "CL0215", "-0.5");
    fault(&step("scale_feed:\n      factor:\n        -0.5"), "CL0215", "-0.5");
    fault(&step("scale_feed: { factor: \"fa\\\"st, #2\" }"), "CL0214", "\"fa\\\"st, #2\"");
    fault(&step("scale_feed: { factor: 'it''s' }"), "CL0214", "'it''s'");
    fault(&step("scale_feed: { factor: 5 mm }"), "CL0215", "5 mm");
    fault(&step("scale_feed:\n      factor: 5 mm # long"), "CL0215", "5 mm");
    fault(&step("scale_feed: { factor: &f -1 }"), "CL0215", "-1");
    fault(&step("scale_feed: { factor: [1, '}]', # ]\n 2] }"), "CL0214", "[1, '}]', # ]\n 2]");
    fault(&step("scale_feed: { factor: { a: 1 } }"), "CL0214", "{ a: 1 }");
    fault(&step("scale_feed:\n      factor:\n        a: 1\n        b: 2"), "CL0214", "a: 1");
    fault(&step("scale_feed:\n      factor:\n        - 1\n        - 2"), "CL0214", "- 1");
    fault(&step("scale_feed:\n      factor: |\n        text"), "CL0214", "|");
    fault(&step("scale_feed:\n      factor: two\n        lines"), "CL0214", "two");
    fault(&step("scale_feed:\n      factor: # none\n      share: 1"), "CL0214", "factor");
    fault("version: 1\nsteps:\n  -\n  - reverse\n", "CL0214", "-");
    fault(&step("shift: { by: [1, 2, x] }"), "CL0214", "x");
}

#[test]
fn exactly_the_key_is_underlined() {
    fault(&step("scale_feed: { factor: 1, shaer: 1 }"), "CL0210", "shaer");
    fault(&step("scale_feed: { factor: 1, \"sha er\": 1 }"), "CL0210", "\"sha er\"");
    fault(&step("scale_feed: { factor: 1, 'it''s': 1 }"), "CL0210", "'it''s'");
    fault(&step("scale_feed: { factor: 1, 5: 1 }"), "CL0210", "5");
    fault(&step("scale_feed: { factor: 1, ~: 1 }"), "CL0210", "~");
    fault(&step("scale_feed:\n      factor: 1\n      &k two words: 1"), "CL0210", "two words");
    fault(&step("scale_fed: { factor: 1 }"), "CL0211", "scale_fed");
    fault(&step("\"scale_fed\": { factor: 1 }"), "CL0211", "\"scale_fed\"");
    fault(&step("scale_fed"), "CL0211", "scale_fed");
    fault(&step("? scale_fed\n    : { factor: 1 }"), "CL0211", "scale_fed");
    fault(&step("scale_feed: {}"), "CL0213", "scale_feed");
    fault(&step("scale_feed:\n    factor: 1"), "CL0217", "factor");
}

#[test]
fn places_count_bytes_past_umlauts_marks_and_line_ends() {
    fault("\u{feff}version: 1\r\n# Schräge µ → 🛠\r\nsteps:\r\n  - \"scäle\": 1\r\n", "CL0211", "\"scäle\"");
    fault("# 🛠🛠🛠 \u{2028} \u{85}\nversion: 1\nsteps: [{shift: {by: [ä]}}]\n", "CL0214", "ä");
    fault("version: 1\nsteps: [{shift: {by: [ä, 1, 2]}}]\n", "CL0214", "ä");
    fault("\u{feff}version: 1\nsteps: [}\n", "CL0201", "}");
}

#[test]
fn a_fault_behind_an_alias_is_where_the_value_is_written() {
    let text = "version: 1\nsteps:\n  - scale_feed: { factor: 1, where: &w { motion: [cut] } }\n  - scale_feed: { factor: 2, where: *w }\n";
    fault(text, "CL0210", "motion");
}

#[test]
fn all_faults_are_reported_at_once_in_the_order_of_the_text() {
    let found = bad(
        "version: 1\nunits: mil\nsteps:\n  - scale_feed: { factor: 0, share: 2, colour: 1 }\n  - polish\n  - shift: { by: [a, b, 3] }\n  - rewrite: { rules: [{ find: A }, { replace: B, find: C, x: 1 }] }\nextra: 1\nextra: 2\n",
    );
    let codes: Vec<String> =
        found.iter().map(|d| format!("{} {}", d.code, super::underlined_by(d))).collect();
    assert_eq!(
        codes,
        [
            "CL0212 mil",
            "CL0215 0",
            "CL0215 2",
            "CL0210 colour",
            "CL0211 polish",
            "CL0214 a",
            "CL0214 b",
            "CL0213 { find: A }",
            "CL0210 x",
            "CL0210 extra",
            "CL0206 extra",
        ]
    );
}

#[test]
fn nobody_is_shown_more_than_twenty_faults() {
    let text = format!("version: 1\nsteps:\n{}", "  - polish\n".repeat(200));
    assert_eq!(bad(text).len(), 20);
}

#[test]
fn text_in_another_encoding_is_named_at_its_first_byte() {
    let found = bad(b"version: 1\n# Fr\xE4sen\nsteps: []\n");
    assert_eq!(found[0].code.id(), "CL0202");
    assert_eq!(found[0].labels[0].span.to_range(), 15..16);
    assert_eq!(bad(b"\xFF\xFEv\0e\0")[0].code.id(), "CL0202");
    assert_eq!(bad(b"version: 1\n\xC3")[0].labels[0].span.to_range(), 11..12);
}
