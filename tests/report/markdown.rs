//! The summary for merge requests.

use super::html::told;
use super::simulation::{SHOP, SLOT};
use crate::support::snapshots;
use clsmith::report::comparison::to_markdown;

#[test]
fn before_and_after_with_chips() {
    let steps = "  - scale_feed: { factor: 0.5 }\n  - rewrite: { rules: [ { match: \"SPINDL/RPM,4000.0000,CLW\", replace: \"SPINDL/RPM,3000.0000,CLW\" } ] }\n";
    let text = told("part.cls", SLOT.as_bytes(), steps, SHOP, to_markdown);
    snapshots("report").bind(|| insta::assert_snapshot!("markdown", text));
}

#[test]
fn without_a_setup() {
    let text = told("part.cls", SLOT.as_bytes(), "  - clamp_feed: { max: 5000 }\n", "", to_markdown);
    snapshots("report").bind(|| insta::assert_snapshot!("markdown_unchanged", text));
}

#[test]
fn times_say_what_they_leave_out() {
    let part = SLOT.replace("FEDRAT/MMPM,800.0000\n", "");
    assert!(part.len() < SLOT.len());
    let text = told("some/part.cls", part.as_bytes(), "  - clamp_feed: { max: 5000 }\n", "", to_markdown);
    assert!(text.contains("| time at feed, without acceleration | \\> 0.0 s | \\> 0.0 s |  |"), "{text}");
    assert!(text.contains("- the time at feed leaves out 5 motions whose feed is not known"), "{text}");
    assert!(text.contains("corrected program (of part.cls) sha256"), "{text}");
}

#[test]
fn names_of_files_are_no_markup() {
    let part = SLOT.replace("TOOL PATH/SLOT", "TOOL PATH/A|B*c*<img src=x>`[x](y)");
    let text =
        told("a|b\n# [x](y).cls", part.as_bytes(), "  - scale_feed: { factor: 0.5 }\n", "", to_markdown);
    assert!(text.starts_with("## a\\|b \\# \\[x\\](y).cls\n"), "{text}");
    assert!(text.contains("| A\\|B\\*c\\*\\<img src=x\\>\\`\\[x\\](y) |"), "{text}");
    // Every row of a table has as many cells as its head.
    for table in text.split("\n\n").filter(|block| block.starts_with('|')) {
        let cells = |line: &str| line.replace("\\|", "").matches('|').count();
        assert!(table.lines().all(|line| cells(line) == cells(table.lines().next().unwrap())), "{table}");
    }
}
