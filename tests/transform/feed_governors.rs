//! Which record a feed is changed in, and where a new FEDRAT stands.

use super::apply;

const SCALE_FIRST: &str = "  - scale_feed: { factor: 0.5, where: { operations: [A] } }\n";

#[test]
fn a_cycle_that_only_changes_the_depth_leaves_its_feed_where_it_stands() {
    let text = "TOOL PATH/A,TOOL,T\nCYCLE/DRILL,RAPTO,3.0000,FEDTO,-10.0000,MMPM,9000.0000\nCYCLE/ON,FEDTO,-20.0000\n\
                GOTO/0.0000,0.0000,0.0000\nCYCLE/OFF\n";
    let (after, found) = apply("  - clamp_feed: { max: 1000 }\n", text);
    assert!(found.is_empty(), "{found:?}");
    assert_eq!(after, text.replace("MMPM,9000.0000", "MMPM,1000.0000"));
}

#[test]
fn a_feed_that_comes_back_after_many_cycles_is_not_set_anew() {
    let mut text = "TOOL PATH/A,TOOL,T\nFEDRAT/MMPM,1000.0000\nGOTO/0.0000,0.0000,0.0000\n".to_owned();
    for hole in 0..12 {
        text += &format!(
            "CYCLE/DRILL,RAPTO,3.0000,FEDTO,-5.0000,MMPM,200.0000\nGOTO/{hole}.0000,0.0000,0.0000\nCYCLE/OFF\n"
        );
    }
    text += "END-OF-PATH\nTOOL PATH/B,TOOL,T\nGOTO/0.0000,9.0000,0.0000\nEND-OF-PATH\n";
    let (after, _) = apply(SCALE_FIRST, &text);
    let wanted = text
        .replace("MMPM,1000.0000", "MMPM,500.0000")
        .replace("MMPM,200.0000", "MMPM,100.0000")
        .replace("GOTO/0.0000,9.0000,0.0000", "FEDRAT/MMPM,1000.0000\nGOTO/0.0000,9.0000,0.0000");
    assert_eq!(after, wanted);
}

#[test]
fn a_rapid_of_several_points_wants_no_feed() {
    let text = "TOOL PATH/A,TOOL,T\nFEDRAT/MMPM,1000.0000\nGOTO/0.0000,0.0000,0.0000\nEND-OF-PATH\nTOOL PATH/B,TOOL,T\n\
                RAPID\nGOTO/1.0000,0.0000,0.0000,2.0000,0.0000,0.0000,3.0000,0.0000,0.0000\nEND-OF-PATH\n";
    let (after, _) = apply(SCALE_FIRST, text);
    assert_eq!(after, text.replace("MMPM,1000.0000", "MMPM,500.0000"));
}

#[test]
fn a_second_feed_of_a_cycle_is_not_passed_over() {
    let text = "CYCLE/BORE,FEDTO,-10.0000,MMPM,100.0000,RTRCTO,5.0000,MMPM,9000.0000\nGOTO/0.0000,0.0000,0.0000\nCYCLE/OFF\n";
    let (_, found) = apply("  - clamp_feed: { max: 1000 }\n", text);
    assert!(!found.is_empty());
}

#[test]
fn a_feed_with_a_word_of_the_post_is_changed_or_reported() {
    let text = "FEDRAT/MMPM,9000.0000,LOCK\nGOTO/0.0000,0.0000,0.0000\nGOTO/1.0000,0.0000,0.0000\n";
    for step in ["clamp_feed: { max: 1000 }", "scale_feed: { factor: 0.5 }"] {
        let (after, _) = apply(&format!("  - {step}\n"), text);
        assert!(
            after.starts_with("FEDRAT/MMPM,1000.0000,LOCK")
                || after.starts_with("FEDRAT/MMPM,4500.0000,LOCK")
        );
        for unknown in ["FEDRAT/9000.0000,FPM", "FEDRAT/RAPID"] {
            let text = text.replace("FEDRAT/MMPM,9000.0000,LOCK", unknown);
            let (after, found) = apply(&format!("  - {step}\n"), &text);
            assert_eq!(after, text);
            assert_eq!(found.len(), 1, "{step} {unknown} {found:?}");
        }
    }
}

#[test]
fn a_small_feed_keeps_its_proportion() {
    let text =
        "SPINDL/RPM,9000,CLW\nFEDRAT/IPR,0.0020\nGOTO/0.0000,0.0000,0.0000\nGOTO/1.0000,0.0000,0.0000\n";
    let (after, _) = apply("  - scale_feed: { factor: 0.01 }\n", text);
    assert!(after.contains("FEDRAT/IPR,0.00002\n"), "{after}");
}

#[test]
fn a_clamped_feed_is_never_above_the_limit_and_stays() {
    for (text, max) in [
        (
            "SPINDL/RPM,3000,CLW\nFEDRAT/MMPR,0.2500\nGOTO/0.0000,0.0000,0.0000\nGOTO/1.0000,0.0000,0.0000\n",
            500.0,
        ),
        (
            "SPINDL/RPM,9000,CLW\nFEDRAT/MMPR,0.0020\nGOTO/0.0000,0.0000,0.0000\nGOTO/1.0000,0.0000,0.0000\n",
            10.0,
        ),
        ("FEDRAT/IPM,100.0\nGOTO/0.0000,0.0000,0.0000\nGOTO/1.0000,0.0000,0.0000\n", 1001.0),
        ("FEDRAT/IPM,100.0\nGOTO/0.0000,0.0000,0.0000\nGOTO/1.0000,0.0000,0.0000\n", 999.9999),
    ] {
        let step = format!("  - clamp_feed: {{ max: {max} }}\n");
        let (once, _) = apply(&step, text);
        let program = crate::support::program(&once);
        for motion in program.motions() {
            let feed = motion.feed.unwrap().mm_per_minute(
                clsmith::program::LengthUnit::Mm,
                motion.spindle_rpm(),
                None,
            );
            let feed = feed.unwrap();
            assert!(feed <= max * (1.0 + 1e-9) && feed > max * 0.99, "{once}: {feed}");
        }
        assert_eq!(apply(&step, &once).0, once);
    }
}

#[test]
fn a_new_feed_does_not_part_a_goto_from_its_lines_of_numbers() {
    let text = "TOOL PATH/A,TOOL,T\nFEDRAT/MMPM,100.0\nGOTO/0.0,0.0,10.0\nGOTO/0.0,0.0,0.0\n2.0,0.0,0.0\nEND-OF-PATH\n";
    let (after, found) = apply("  - scale_feed: { factor: 0.5, where: { motions: [engage] } }\n", text);
    assert!(after.contains("FEDRAT/MMPM,50.0\nGOTO/0.0,0.0,0.0\n2.0,0.0,0.0\n"), "{after}");
    assert_eq!(found.len(), 1, "the points want different feeds: {found:?}");
}
