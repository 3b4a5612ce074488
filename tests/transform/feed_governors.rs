//! Which record a feed is changed in, and where a new FEDRAT stands.

use super::apply;

#[test]
fn a_cycle_that_only_changes_the_depth_leaves_its_feed_where_it_stands() {
    let text = "TOOL PATH/A,TOOL,T\nCYCLE/DRILL,RAPTO,3.0000,FEDTO,-10.0000,MMPM,9000.0000\nCYCLE/ON,FEDTO,-20.0000\n\
                GOTO/0.0000,0.0000,0.0000\nCYCLE/OFF\n";
    let (after, found) = apply("  - clamp_feed: { max: 1000 }\n", text);
    assert!(found.is_empty(), "{found:?}");
    assert_eq!(after, text.replace("MMPM,9000.0000", "MMPM,1000.0000"));
}
