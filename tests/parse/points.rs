//! GOTO in all its shapes.

use crate::support::{program, text};
use clsmith::parse::parse;
use clsmith::program::Record;
use clsmith::program::record::Goto;
use nalgebra::{Point3, Vector3};

fn records(text: &str) -> Vec<Record> {
    program(text).statements().iter().map(|statement| statement.record().clone()).collect()
}

fn plain(x: f64, y: f64, z: f64) -> Record {
    Record::Goto(Goto { point: Point3::new(x, y, z), axis: None })
}

#[test]
fn the_same_point_in_the_style_of_each_dialect() {
    for goto in [
        "GOTO/12.5000,-3.0000,0.5000",
        "GOTO  /   12.50000,   -3.00000,    0.50000",
        "GOTO / 12.5000000000, -3.0000000000, 0.5000000000",
        "GOTO/12.5,-3.,.5",
        "GOTO/ 12.500000,-3.000000,0.500000 ",
        "goto/12.5,-3,5.0E-1",
        "GOTO/+12.5,-0.3D1,50e-2",
    ] {
        assert_eq!(records(goto), [plain(12.5, -3.0, 0.5)], "{goto}");
    }
}

#[test]
fn six_values_are_a_point_and_the_tool_axis() {
    let axis = Some(Vector3::new(0.0, -0.6, 0.8));
    assert_eq!(
        records("GOTO/1,2,3,0,-.6,.8"),
        [Record::Goto(Goto { point: Point3::new(1.0, 2.0, 3.0), axis })]
    );
}

#[test]
fn the_sign_of_a_zero_is_kept() {
    let found = records("GOTO/-0.000000,0.000000,-0.0\n");
    let Record::Goto(goto) = &found[0] else { panic!() };
    assert!(goto.point.x.is_sign_negative() && !goto.point.y.is_sign_negative());
}

#[test]
fn a_goto_may_hold_several_points() {
    let numbers = [0.0, 0.0, 1.0, 5.0, 5.0, 5.0, 6.0, 6.0, 6.0];
    assert_eq!(records("GOTO/0,0,1,$\n5,5,5,$\n6,6,6\n"), [Record::Points(numbers.into())]);
}

#[test]
fn lines_of_bare_numbers_after_a_goto_are_further_points() {
    let found = records("GOTO/1,2,3\n   4.0  5.0  6.0\n7,8,9, 10,11,12,\nRAPID\n");
    assert_eq!(
        found,
        [
            plain(1.0, 2.0, 3.0),
            Record::Points([4.0, 5.0, 6.0].into()),
            Record::Points([7.0, 8.0, 9.0, 10.0, 11.0, 12.0].into()),
            Record::Rapid,
        ]
    );
}

#[test]
fn a_line_of_bare_numbers_elsewhere_is_an_error() {
    // Most likely the head of a statement was lost; taken for points it would move the tool.
    for before in ["", "RAPID\n", "FEDRAT/100\n", "CIRCLE/0,0,0,0,0,1,5\n"] {
        let source = text(format!("{before}1.0,2.0,3.0\nGOTO/4,5,6\n"));
        let parsed = parse(&source, None);
        assert_eq!(parsed.diagnostics.len(), 1, "{before:?}");
        assert_eq!(source.slice(parsed.diagnostics[0].labels[0].span), b"1.0,2.0,3.0");
        assert_eq!(parsed.program.statements().last().unwrap().record(), &plain(4.0, 5.0, 6.0));
    }
}

#[test]
fn from_and_gohome_are_points_too() {
    let found = records("FROM/0,0,50,0,0,1\nGOHOME/0,0,100\nGOHOME\nGODLTA/0,0,5\nGODLTA/5\n");
    assert!(matches!(&found[0], Record::From(goto) if goto.axis == Some(Vector3::z())));
    assert!(matches!(&found[1], Record::GoHome(Some(goto)) if goto.point.z == 100.0));
    assert_eq!(found[2], Record::GoHome(None));
    assert_eq!(found[3..], [Record::GoDelta([0.0, 0.0, 5.0].into()), Record::GoDelta([5.0].into())]);
}
