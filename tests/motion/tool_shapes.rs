//! Which tool cuts.

use crate::support;

fn tools(text: &str) -> Vec<(Option<u32>, Option<f64>)> {
    let program = support::program(text);
    let tool = |motion: clsmith::program::motion::Motion| {
        let tool = motion.tool.unwrap();
        (tool.number, tool.data.as_ref().and_then(|data| data.diameter))
    };
    program.motions().map(tool).collect()
}

#[test]
fn a_tool_that_nothing_describes_does_not_pass_for_the_one_before_it() {
    let text = "CUTTER/10\nLOADTL/1\nGOTO/0,0,0\nLOADTL/2\nGOTO/1,0,0\nCUTTER/6\nLOADTL/3\nGOTO/2,0,0\n";
    assert_eq!(tools(text), [(Some(1), Some(10.0)), (Some(2), None), (Some(3), Some(6.0))]);
}

#[test]
fn the_same_tool_loaded_twice_keeps_its_shape() {
    assert_eq!(tools("CUTTER/10\nLOADTL/2\nLOADTL/2,1\nGOTO/0,0,0\n"), [(Some(2), Some(10.0))]);
}

#[test]
fn a_turret_position_is_a_tool() {
    let text = "CUTTER/10\nLOADTL/6\nGOTO/0,0,0\nCUTTER/0.8\nTURRET/1,OSETNO,1\nGOTO/1,0,0\n";
    assert_eq!(tools(text), [(Some(6), Some(10.0)), (Some(1), Some(0.8))]);
}
