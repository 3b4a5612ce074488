//! Who is closer to the job wins.

use super::{close, good};
use crate::support::named_tool;
use clsmith::parameters::Positive;
use clsmith::program::motion::ActiveTool;
use clsmith::setup::{MaterialChoice, StockBodyShape};

#[test]
fn machines_merge_key_by_key() {
    let near = good("machine: { max_acceleration: 5 }");
    let far = good("machine: { max_acceleration: 7, max_feed: 9 }");
    let machine = near.override_base(far).machine;
    assert_eq!((machine.max_acceleration, machine.max_feed), (Positive::new(5.0), Positive::new(9.0)));
}

#[test]
fn stock_goes_as_a_whole() {
    let near = good("stock: { stl: near.stl }");
    let far = good("stock: { stl: far.stl, allowance: 2 }");
    let stock = near.clone().override_base(far.clone()).stock.unwrap();
    assert_eq!(stock.allowance_mm, 0.0);
    assert!(matches!(&stock.bodies[0].shape, StockBodyShape::Stl { file, .. } if file.written == "near.stl"));
    assert_eq!(good("{}").override_base(far).stock.unwrap().allowance_mm, 2.0);
    assert_eq!(near.clone().override_base(good("{}")), near);
}

#[test]
fn material_goes_as_a_whole() {
    let near = good("material: { k_tc: 1000 }");
    let far = good("material: { k_tc: 2000, k_te: 30 }");
    let Some(MaterialChoice::Given(material)) = near.override_base(far).material else { panic!() };
    let found = super::materials::linear(&material);
    assert_eq!((found.k_tc, found.k_te), (1000.0, 0.0));
}

#[test]
fn tools_come_one_list_after_the_other_and_the_first_that_fits_counts() {
    let near = good("tools: [ { match: { number: 1 }, diameter: 10 } ]");
    let far =
        good("tools: [ { match: { number: 1 }, diameter: 20, teeth: 4 }, { match: {}, diameter: 30 } ]");
    let setup = near.override_base(far);
    let number = |number| named_tool(number, None);
    let first = setup.find_tool_entry(&number(Some(1))).unwrap();
    close(first.diameter_mm.unwrap(), 10.0);
    assert!(first.teeth.is_none(), "entries are not mixed");
    close(setup.find_tool_entry(&number(Some(2))).unwrap().diameter_mm.unwrap(), 30.0);
    close(setup.find_tool_entry(&number(None)).unwrap().diameter_mm.unwrap(), 30.0);
}

#[test]
fn number_and_name_must_both_fit() {
    let setup = good("tools: [ { match: { number: 1, name: \"BALL*\" } }, { match: { name: \"BALL_6\" } } ]");
    let tool = |number, name| named_tool(number, Some(name));
    let entry = |tool: &ActiveTool| setup.tools.iter().position(|entry| entry.matches_tool(tool));
    assert_eq!(entry(&tool(Some(1), "BALL_6")), Some(0));
    assert_eq!(entry(&tool(Some(2), "BALL_6")), Some(1));
    assert_eq!(entry(&tool(Some(1), "MILL_6")), None);
    assert_eq!(entry(&named_tool(Some(1), None)), None);
}
