//! Who is closer to the job wins.

use super::{close, good};
use crate::support::named_tool;
use clsmith::program::motion::Tool;
use clsmith::setup::{BodyShape, MaterialChoice};
use clsmith::values::Positive;

#[test]
fn machines_merge_key_by_key() {
    let near = good("machine: { max_acceleration: 5 }");
    let far = good("machine: { max_acceleration: 7, max_feed: 9 }");
    let machine = near.over(far).machine;
    assert_eq!((machine.max_acceleration, machine.max_feed), (Positive::new(5.0), Positive::new(9.0)));
}

#[test]
fn stock_goes_as_a_whole() {
    let near = good("stock: { stl: near.stl }");
    let far = good("stock: { stl: far.stl, allowance: 2 }");
    let stock = near.clone().over(far.clone()).stock.unwrap();
    assert_eq!(stock.allowance_mm, 0.0);
    assert!(matches!(&stock.bodies[0].shape, BodyShape::Stl { file, .. } if file.written == "near.stl"));
    assert_eq!(good("{}").over(far).stock.unwrap().allowance_mm, 2.0);
    assert_eq!(near.clone().over(good("{}")), near);
}

#[test]
fn material_goes_as_a_whole() {
    let near = good("material: { k_tc: 1000 }");
    let far = good("material: { k_tc: 2000, k_te: 30 }");
    let Some(MaterialChoice::Given(material)) = near.over(far).material else { panic!() };
    assert_eq!((material.coefficients.k_tc, material.coefficients.k_te), (1000.0, 0.0));
}

#[test]
fn tools_come_one_list_after_the_other_and_the_first_that_fits_counts() {
    let near = good("tools: [ { match: { number: 1 }, diameter: 10 } ]");
    let far =
        good("tools: [ { match: { number: 1 }, diameter: 20, teeth: 4 }, { match: {}, diameter: 30 } ]");
    let setup = near.over(far);
    let number = |number| named_tool(number, None);
    let first = setup.tool_entry(&number(Some(1))).unwrap();
    close(first.diameter.unwrap(), 10.0);
    assert!(first.teeth.is_none(), "entries are not mixed");
    close(setup.tool_entry(&number(Some(2))).unwrap().diameter.unwrap(), 30.0);
    close(setup.tool_entry(&number(None)).unwrap().diameter.unwrap(), 30.0);
}

#[test]
fn number_and_name_must_both_fit() {
    let setup = good("tools: [ { match: { number: 1, name: \"BALL*\" } }, { match: { name: \"BALL_6\" } } ]");
    let tool = |number, name| named_tool(number, Some(name));
    let entry = |tool: &Tool| setup.tools.iter().position(|entry| entry.fits(tool));
    assert_eq!(entry(&tool(Some(1), "BALL_6")), Some(0));
    assert_eq!(entry(&tool(Some(2), "BALL_6")), Some(1));
    assert_eq!(entry(&tool(Some(1), "MILL_6")), None);
    assert_eq!(entry(&named_tool(Some(1), None)), None);
}
