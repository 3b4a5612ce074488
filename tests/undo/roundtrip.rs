//! undo(apply(x)) is x, byte for byte.

use super::{report, undone};
use crate::provenance::{done, with_comments};
use crate::support;
use clsmith::source::Source;
use clsmith::undo::{BlockChecksums, UndoEdit, UndoPatch};
use proptest::prelude::*;
use std::sync::Arc;

/// Whether the recipe changed the file; the original must come back in any case.
fn comes_back(recipe: &str, source: &Arc<Source>) -> Option<bool> {
    let program = done(recipe, source).ok()?.program;
    let report = report(recipe, &program);
    assert!(undone(&program, &report) == source.bytes(), "{} comes back", source.name());
    Some(program.to_bytes() != source.bytes())
}

#[test]
fn fixtures_come_back_with_and_without_comments() {
    let steps = "  - scale_feed: { factor: 0.8 }\n  - rewrite: { rules: [{ match: 'RAPID', insert_before: OPSTOP }] }";
    let mut changed = 0;
    for (_, path) in support::fixtures() {
        let source = support::source(&path);
        for provenance in ["none", "header", "comments"] {
            let recipe = with_comments(steps).replace("comments", provenance);
            changed += usize::from(comes_back(&recipe, &source) == Some(true));
        }
    }
    assert!(changed > 50, "{changed}");
}

#[test]
fn real_files_come_back() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let source = support::source(&path);
        // Half the feeds, with comments.
        comes_back(&with_comments("  - scale_feed: { factor: 0.5 }"), &source);
    }
}

#[test]
fn two_runs_come_back_one_after_the_other() {
    let recipe = with_comments("  - scale_feed: { factor: 0.5 }");
    let first = support::text("UNITS/MM\nFEDRAT/200,MMPM\nGOTO/1,2,3");
    let once = done(&recipe, &first).unwrap().program;
    let once_report = report(&recipe, &once);
    let second = support::text(once.to_bytes());
    let twice = done(&recipe, &second).unwrap().program;
    let twice_report = report(&recipe, &twice);
    assert_eq!(undone(&twice, &twice_report), second.bytes());
    assert_eq!(undone(&once, &once_report), first.bytes());
}

/// Lines that stay what they are.
const FIXED: &[&str] = &[
    "RAPID",
    "COOLNT/ON",
    "COOLNT/OFF",
    "SPINDL/1000,RPM,CLW",
    "$$ a comment",
    "",
    "  ",
    "PPRINT some text",
    "CIRCLE/0.0000,5.0000,0.0000,0.0000,0.0000,1.0000,5.0000",
    "OPSTOP",
    "GOTO/1.0000, $\n2.0000, 3.0000",
];

/// Lines of a program, each well formed by itself.
fn line() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        4 => (-900.0..900.0f64, -900.0..900.0f64).prop_map(|(x, y)| format!("GOTO/{x:.4},{y:.4},0.0000").into_bytes()),
        2 => (1.0..9000.0f64).prop_map(|feed| format!("FEDRAT/{feed:.3},MMPM").into_bytes()),
        3 => proptest::sample::select(FIXED).prop_map(|text| text.as_bytes().to_vec()),
        1 => proptest::collection::vec(0x80..=0xFFu8, 1..9).prop_map(|bytes| [b"$$ caf".to_vec(), bytes].concat()),
    ]
}

fn program() -> impl Strategy<Value = Vec<u8>> {
    let end = proptest::sample::select(&["\n", "\r\n"][..]);
    let lines = proptest::collection::vec((line(), end), 1..40);
    (lines, any::<bool>(), any::<bool>()).prop_map(|(lines, one_end, last)| {
        let first = lines[0].1;
        let mut bytes = b"UNITS/MM".to_vec();
        bytes.extend_from_slice(first.as_bytes());
        for (line, end) in &lines {
            bytes.extend_from_slice(line);
            bytes.extend_from_slice(if one_end { first } else { end }.as_bytes());
        }
        if !last {
            bytes.truncate(bytes.trim_ascii_end().len());
        }
        bytes
    })
}

fn recipe() -> impl Strategy<Value = String> {
    let step = prop_oneof![
        (0.1..3.0f64).prop_map(|factor| format!("  - scale_feed: {{ factor: {factor:.3} }}\n")),
        (10..5000u32).prop_map(|max| format!("  - clamp_feed: {{ max: {max} }}\n")),
        (-99.0..99.0f64).prop_map(|z| format!("  - move_origin: {{ translate: [0, {z:.2}, 1] }}\n")),
        proptest::sample::select(
            &[
                "{ match: COOLNT/ON, delete: true }",
                "{ match: OPSTOP, insert_before: [STOP, 'DELAY/5'] }",
                "{ match: 'RAPID', insert_after: 'COOLNT/OFF' }",
                "{ match: COOLNT/OFF, replace: 'COOLNT/OFF $$ rinse' }",
            ][..]
        )
        .prop_map(|rule| format!("  - rewrite: {{ rules: [{rule}] }}\n")),
    ];
    let provenance = proptest::sample::select(&["none", "header", "comments"][..]);
    (proptest::collection::vec(step, 1..4), provenance).prop_map(|(steps, provenance)| {
        format!("version: 1\nprovenance: {provenance}\nsteps:\n{}", steps.concat())
    })
}

proptest! {
    #![proptest_config(crate::support::property(192))]

    #[test]
    fn any_program_comes_back_from_any_recipe(bytes in program(), recipe in recipe()) {
        let source = support::text(bytes);
        comes_back(&recipe, &source);
    }

    #[test]
    fn the_first_difference_is_where_it_is(length in 1usize..5000, at in any::<proptest::sample::Index>()) {
        let bytes: Vec<u8> = (0..length).map(|index| (index % 251) as u8).collect();
        let at = at.index(length);
        let mut other = bytes.clone();
        other[at] ^= 1;
        let blocks = BlockChecksums::from_chunks(bytes.chunks(7));
        prop_assert!(blocks.find_first_difference(&other).contains(&at));
        let found = blocks.find_first_difference(&bytes[..at]);
        prop_assert!(found.start <= at && found.end <= at);
    }
}

#[test]
fn bytes_of_any_kind_survive_json() {
    let patch = UndoPatch(vec![
        UndoEdit { at: 0, length: 3, was: b"\"\\\r\n\t\x01\x7f".to_vec(), steps: vec![1, 3] },
        UndoEdit { at: 3, length: 0, was: b"caf\xe9\r\n".to_vec(), steps: vec![] },
        UndoEdit { at: 9, length: 0, was: "Müller".as_bytes().to_vec(), steps: vec![2] },
    ]);
    let text = serde_json::to_string(&patch).unwrap();
    assert!(text.contains("was_base64\":\"Y2Fm6Q0K\""), "{text}");
    assert_eq!(serde_json::from_str::<UndoPatch>(&text).unwrap(), patch);
}
