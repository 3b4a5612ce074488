//! What the comments say.

use super::comments;

const PART: &str = "\
PARTNO A\n\
UNITS/MM\n\
SPINDL/1000,RPM,CLW\n\
FEDRAT/250.0000,MMPM\n\
GOTO/0.0000,0.0000,0.0000\n\
GOTO/10.0000,0.0000,0.0000\n\
COOLNT/ON\n\
COOLNT/MIST\n\
GOTO/20.0000,0.0000,0.0000\n\
FINI\n";

#[test]
fn every_step_that_changed_a_record_says_so_in_its_own_line() {
    let steps = "  - scale_feed: { factor: 2 }\n  - clamp_feed: { max: 400 }";
    assert_eq!(
        comments(steps, PART),
        ["scale_feed: 250.0000 -> 500.0000", "clamp_feed: 500.0000 -> 400.0000"]
    );
}

#[test]
fn coordinates_have_their_letters_and_only_those_that_changed() {
    let steps = "  - move_origin: { translate: [1.5, 0, -2] }";
    assert_eq!(
        comments(steps, PART),
        [
            "move_origin: X 0.0000 -> 1.5000, Z 0.0000 -> -2.0000",
            "move_origin: X 10.0000 -> 11.5000, Z 0.0000 -> -2.0000",
            "move_origin: X 20.0000 -> 21.5000, Z 0.0000 -> -2.0000"
        ]
    );
    // More than fit are counted.
    let steps = "  - move_origin: { translate: [1000.5, 1000.5, 1000.5] }";
    assert_eq!(
        comments(steps, "UNITS/MM\nGOTO/1000.0000,1000.0000,1000.0000\n"),
        ["move_origin: X 1000.0000 -> 2000.5000, 2 more"]
    );
}

#[test]
fn a_feed_that_is_put_in_says_what_was_programmed() {
    // The last cut alone: slower, and then nothing comes after it.
    let steps = "  - scale_feed: { factor: 0.5, where: { feed: { min: 1 }, motions: [retract] } }";
    let part = "TOOL PATH/A,TOOL,B\nTLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\nFEDRAT/MMPM,250.0000\n\
        PAINT/COLOR,31\nGOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000\nGOTO/9.0000,0.0000,0.0000\n\
        PAINT/COLOR,37\nGOTO/9.0000,0.0000,5.0000\nPAINT/COLOR,31\nGOTO/9.0000,9.0000,5.0000\nEND-OF-PATH\n";
    assert_eq!(
        comments(steps, part),
        ["scale_feed: 250.0000 -> 125.0000, put in", "scale_feed: put in, 250.0000 comes back"]
    );
}

#[test]
fn a_feed_put_in_after_another_step_starts_from_that_steps_feed() {
    let steps =
        "  - scale_feed: { factor: 2 }\n  - scale_feed: { factor: 0.5, where: { motions: [retract] } }";
    let part = "TOOL PATH/A,TOOL,B\nTLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\nFEDRAT/MMPM,250.0000\n\
        PAINT/COLOR,31\nGOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000\nGOTO/9.0000,0.0000,0.0000\n\
        PAINT/COLOR,37\nGOTO/9.0000,0.0000,5.0000\nEND-OF-PATH\n";
    assert_eq!(
        comments(steps, part),
        ["scale_feed: 250.0000 -> 500.0000", "scale_feed: 500.0000 -> 250.0000, put in"]
    );
}

#[test]
fn other_words_are_told_as_they_were() {
    let rules = |rules: &str| format!("  - rewrite: {{ rules: [{rules}] }}");
    let replaced = rules("{ match: COOLNT/MIST, replace: COOLNT/THRU }");
    assert_eq!(comments(&replaced, PART), ["rewrite: was COOLNT/MIST"]);
    let gone = rules("{ match: COOLNT/MIST, delete: true }");
    assert_eq!(comments(&gone, PART), ["rewrite: taken out: COOLNT/MIST"]);
    let both = rules("{ match: COOLNT/MIST, delete: true }, { match: COOLNT/ON, delete: true }");
    assert_eq!(comments(&both, PART), ["rewrite: 2 records taken out"]);
    let put_in = rules("{ match: COOLNT/MIST, insert_before: [STOP, OPSTOP, STOP] }");
    assert_eq!(comments(&put_in, PART), ["rewrite: 3 records put in"]);
}

#[test]
fn what_one_step_put_in_and_another_changed_has_both_lines() {
    let steps = "  - rewrite: { rules: [{ match: COOLNT/MIST, insert_before: 'DELAY/5' }] }\n  \
        - rewrite: { rules: [{ match: 'DELAY/5', replace: 'DELAY/7' }] }";
    assert_eq!(comments(steps, PART), ["rewrite: put in", "rewrite: 5 -> 7"]);
    // What came and went was never in the file.
    let steps = "  - rewrite: { rules: [{ match: COOLNT/MIST, insert_before: 'DELAY/5' }] }\n  \
        - rewrite: { rules: [{ match: 'DELAY/5', delete: true }] }";
    assert!(comments(steps, PART).is_empty());
}

#[test]
fn optimize_feed_says_what_it_knows_of_the_chip() {
    use super::{done, with_comments};
    use crate::support;
    let part = "TOOL PATH/SLOT,TOOL,EM10\nTLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\n\
        MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n\
        LOAD/TOOL,1,ADJUST,1\nSPINDL/RPM,2000,CLW\nRAPID\n\
        GOTO/-10.0000,10.0000,-2.0000,0.0000000,0.0000000,1.0000000\nFEDRAT/MMPM,320.0000\n\
        GOTO/50.0000,10.0000,-2.0000\nEND-OF-PATH\n";
    let setup = "setup:\n  machine: { max_feed: 5000 }\n  stock: { block: { from: [0, 0, -10], to: [40, 20, 0] } }\n  \
        tools: [{ match: {}, teeth: 4, flute_length: 20 }]\n";
    let steps = "  - optimize_feed: { target: 0.065 }";
    let done = done(&with_comments(steps).replace("steps:", &format!("{setup}steps:")), &support::text(part))
        .unwrap();
    let text = String::from_utf8(done.program.to_bytes()).unwrap();
    let lines: Vec<&str> = text.lines().filter(|line| line.contains("optimize_feed")).collect();
    assert!(lines.iter().any(|line| line.contains(", h 0.040 -> 0.06")), "{text}");
    // What only an earlier step changed has no note of this one.
    let steps =
        "  - scale_feed: { factor: 1.5 }\n  - optimize_feed: { target: 0.06, min_feed: 480, max_feed: 480 }";
    let done =
        super::done(&with_comments(steps).replace("steps:", &format!("{setup}steps:")), &support::text(part))
            .unwrap();
    let text = String::from_utf8(done.program.to_bytes()).unwrap();
    assert!(text.contains("$$ clsmith scale_feed: 320.0000 -> 480.0000\n"), "{text}");
}

/// A light cut, a way through air and a slot, all at one feed.
const TWO_CUTS: &str = "\
TOOL PATH/SLOT,TOOL,EM10\n\
TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\n\
MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n\
LOAD/TOOL,1,ADJUST,1\n\
SPINDL/RPM,8000,CLW\n\
RAPID\n\
GOTO/-10.0000,-3.0000,-2.0000,0.0000000,0.0000000,1.0000000\n\
FEDRAT/MMPM,1920.0000\n\
GOTO/50.0000,-3.0000,-2.0000\n\
GOTO/50.0000,12.0000,-2.0000\n\
GOTO/-10.0000,12.0000,-2.0000\n\
END-OF-PATH\n";

/// What `optimize_feed` says in a file, with the text of the whole file.
fn optimized(part: &str, more: &str) -> (Vec<String>, String) {
    let recipe = format!(
        "version: 1\nprovenance: comments\nsetup:\n  machine: {{ max_feed: 5000 }}\n  \
         stock: {{ block: {{ from: [0, 0, -10], to: [40, 20, 0] }} }}\n  \
         tools: [{{ match: {{}}, teeth: 4, flute_length: 20 }}]\n\
         steps:\n  - optimize_feed: {{ target: 0.065{more} }}\n"
    );
    let text = super::text(&recipe, part);
    let lines = text.lines().filter(|line| line.starts_with("$$ clsmith optimize_feed: "));
    (lines.map(str::to_owned).collect(), text)
}

#[test]
fn no_number_of_a_comment_is_cut() {
    let (lines, text) = optimized(TWO_CUTS, "");
    assert!(lines.iter().all(|line| line.len() <= clsmith::provenance::WIDTH), "{text}");
    // With `, put in` it would have 74 columns.
    let slot = lines.iter().find(|line| line.contains("1920.0000 -> 2080.0000")).unwrap();
    let (_, load) = slot.split_once("1920.0000 -> 2080.0000, h 0.060 -> 0.06").unwrap();
    assert_eq!(load.len(), 1, "{slot}");
    assert!(lines.iter().any(|line| line.ends_with(": put in, 1920.0000 comes back")), "{text}");
}

#[test]
fn parts_of_a_split_motion_have_no_load_of_the_whole() {
    let slot = TWO_CUTS
        .replace("GOTO/-10.0000,-3.0000", "GOTO/60.0000,12.0000")
        .replace("GOTO/50.0000,-3.0000,-2.0000\nGOTO/50.0000,12.0000,-2.0000\n", "");
    let (lines, text) = optimized(&slot, ", air_feed: 4000, split: { above: 10, shortest: 2, at_most: 8 }");
    // The first part is in air and has no load to tell; the others have their own, and none before.
    let feeds = lines.iter().filter(|line| line.contains(" -> ")).collect::<Vec<_>>();
    assert!(feeds[0].ends_with(": 1920.0000 -> 4000.0000"), "{text}");
    assert!(feeds[1].contains(": 1920.0000 -> 2080.0000, put in, h 0.06"), "{text}");
    assert_eq!(feeds.iter().filter(|line| line.contains("-> 2080.0000")).count(), 1, "none repeats: {text}");
    assert!(feeds.iter().all(|line| line.matches(" -> ").count() == 1), "{text}");
}
