//! Cases of points, arcs and axes.

use super::{Case, case, catia, nx};
use clsmith::diagnostic::codes;

pub fn cases() -> Vec<Case> {
    [arcs(), axes(), points()].into_iter().flatten().collect()
}

/// A quarter about 10,0 from 0,0 to 10,10 (left-hand in NX: axis z is clockwise).
fn arc(radius: &str, end: &str) -> String {
    nx(&format!("CIRCLE/10.0,0.0,0.0,0.0,0.0,1.0,{radius},0.0600,0.5000,10.0,1.0\nGOTO/{end}\n"))
}

fn arcs() -> Vec<Case> {
    let quarter = || arc("10.0000", "10.0000,10.0000,0.0000");
    let tlon = |direction: &str| {
        catia(&format!(
            "AUTOPS\nINDIRV/ {direction}\nTLON,GOFWD/ (CIRCLE/ 10.0, 0.0, 0.0,$\n 10.0),ON,(LINE/ 10.0, 0.0, 0.0,$\n 10.0, 10.0, 0.0)\n"
        ))
    };
    // A path along x that turns up with a radius of 8.
    let corner = |k: &str| {
        let circle = format!("CIRCLE/40.0,8.0,0.0,0.0,0.0,{k},8.0");
        nx(&format!("GOTO/40.0,0.0,0.0\n{circle}\nGOTO/48.0,8.0,0.0\nGOTO/48.0,40.0,0.0\n"))
    };
    let controls = "CNTRL/1.0,0.0,0.0\nCNTRL/2.0,0.0,0.0\nCNTRL/3.0,0.0,0.0\n";
    vec![
        case(
            codes::RAPID_WITHOUT_MOTION,
            nx("RAPID\nFEDRAT/MMPM,9.0\n"),
            "RAPID",
            nx("RAPID\nGOTO/1.0,0.0,9.0\n"),
        ),
        case(
            codes::ARC_WITHOUT_END,
            nx(
                "CIRCLE/1.0,0.0,0.0,0.0,0.0,1.0,1.0\nCIRCLE/10.0,0.0,0.0,0.0,0.0,1.0,10.0\nGOTO/10.0,10.0,0.0\n",
            ),
            "CIRCLE",
            quarter(),
        ),
        case(
            codes::ARC_END_OFF_CIRCLE,
            arc("10.0000", "10.0000,10.5000,0.0000"),
            "10.0000,10.5000,0.0000",
            arc("10.0000", "10.0000,10.0015,0.0000"),
        ),
        case(
            codes::ARC_END_OFF_CIRCLE,
            catia(
                "INDIRV/ 0.0, -1.0, 0.0\nTLON,GOFWD/ (CIRCLE/ 10.0, 0.0, 0.0, 10.0),ON,2,INTOF,(LINE/ 10.0, 0.0, 0.0, 10.0, 10.5, 0.0)\n",
            ),
            "10.0, 10.5, 0.0",
            catia(
                "INDIRV/ 0.0, -1.0, 0.0\nTLON,GOFWD/ (CIRCLE/ 10.0, 0.0, 0.0, 10.0),ON,2,INTOF,(LINE/ 10.0, 0.0, 0.0, 10.0, 10.0, 0.0)\n",
            ),
        ),
        case(codes::ARC_RADIUS_DIFFERS, arc("10.5000", "10.0000,10.0000,0.0000"), "10.5000", quarter()),
        case(codes::ARC_ROUGH, arc("10.0050", "10.0000,10.0000,0.0000"), "10.0050", quarter()),
        case(
            codes::UNKNOWN_START,
            nx("GOHOME\nCIRCLE/10.0,0.0,0.0,0.0,0.0,1.0,10.0\nGOTO/10.0,10.0,0.0\n"),
            "CIRCLE",
            nx("GOHOME\nGOTO/0.0,0.0,0.0\nCIRCLE/10.0,0.0,0.0,0.0,0.0,1.0,10.0\nGOTO/10.0,10.0,0.0\n"),
        ),
        case(codes::TANGENT_MISMATCH, tlon("1.0, 0.0, 0.0"), "TLON,GOFWD", tlon("0.0, 1.0, 0.0")),
        case(
            codes::BROKEN_SPLINE,
            nx(&format!("NURBS/\nKNOT/0.5,1.0\n{controls}")),
            "NURBS",
            nx(&format!("NURBS/\nKNOT/1.0\n{controls}")),
        ),
        case(
            codes::ASSUMED_SENSE,
            "GOTO/0,0,0\nCIRCLE/10.,0,0,0,0,1.,10.\nGOTO/10.,10.,0\n",
            "0,0,1.",
            "GOTO/0,-9.,0\nGOTO/0,0,0\nCIRCLE/10.,0,0,0,0,1.,10.\nGOTO/10.,10.,0\n",
        ),
        case(
            codes::SENSE_FROM_ANGLE,
            "GOTO/10.,0,0\nMOVARC/0,0,0,0,0,1.,10.,ANGLE,90.\nGOTO/0,-10.,0\n",
            "0,0,1.",
            "GOTO/10.,0,0\nMOVARC/0,0,0,0,0,1.,10.,ANGLE,90.\nGOTO/0,10.,0\n",
        ),
        case(codes::OTHER_SENSE_FITS, corner("1.0"), "CIRCLE/40.0,8.0,0.0,0.0,0.0,1.0,8.0", corner("-1.0")),
        case(
            codes::RAPID_ARC,
            nx("RAPID\nCIRCLE/10.0,0.0,0.0,0.0,0.0,1.0,10.0\nGOTO/10.0,10.0,0.0\n"),
            "GOTO/10.0,10.0,0.0",
            quarter(),
        ),
        case(
            codes::BROKEN_FRAME,
            catia("$$*CATIA0\n$$ NAME\n$$ 1.0 0.0 0.0 0.0\nPARTNO X\n"),
            "$$*CATIA0",
            catia(
                "$$*CATIA0\n$$ NAME\n$$ 1.0 0.0 0.0 0.0\n$$ 0.0 1.0 0.0 0.0\n$$ 0.0 0.0 1.0 0.0\nPARTNO X\n",
            ),
        ),
    ]
}

fn axes() -> Vec<Case> {
    let axis = |axis: &str| nx(&format!("GOTO/1.0,1.0,1.0,{axis}\n"));
    let multax = |before: &str| {
        catia(&format!(
            "{before}GOTO/1.0,1.0,1.0, 0.0, 0.0, 1.0\nGOTO/1.0,1.0,2.0, 0.0, 0.6, 0.8\nMULTAX/OFF\nTLAXIS/0.0,0.0,1.0\n"
        ))
    };
    vec![
        case(
            codes::AXIS_NOT_UNIT,
            axis("0.0000,0.0000,1.0100"),
            "0.0000,0.0000,1.0100",
            axis("0.577,0.577,0.577"),
        ),
        case(
            codes::AXIS_NOT_UNIT,
            catia("TLAXIS/ 0.0, 0.0, 1.05\n"),
            "0.0, 0.0, 1.05",
            catia("TLAXIS/ 0.0, 0.6, 0.8\n"),
        ),
        case(
            codes::AXIS_NOT_UNIT,
            nx("CIRCLE/10.0,0.0,0.0,0.0,0.0,0.99,10.0\nGOTO/10.0,10.0,0.0\n"),
            "0.0,0.0,0.99",
            nx("FROM/1.0,1.0,1.0,0.0,0.0,1.0\n"),
        ),
        case(
            codes::NO_AXIS,
            axis("10.0000,20.0000,1.0000"),
            "10.0000,20.0000,1.0000",
            axis("0.00,0.71,0.71"),
        ),
        case(codes::AXIS_WITHOUT_MULTAX, multax(""), "0.0, 0.6, 0.8", multax("MULTAX\n")),
        case(codes::AXIS_JUMP, axis("1.0,0.0,0.0"), "1.0,0.0,0.0", axis("0.0,0.6,0.8")),
    ]
}

/// A zigzag of 40 mm with a point in its middle.
fn zigzag(middle: &str) -> String {
    let line =
        |index: i32| format!("GOTO/{}.0000,{index}.0000,-1.0000\n", if index % 4 < 2 { 0 } else { 40 });
    let lines: Vec<String> = (0..24).map(line).collect();
    let (before, behind) = lines.split_at(12);
    format!("{}GOTO/{middle}\n{}", before.concat(), behind.concat())
}

fn points() -> Vec<Case> {
    vec![
        case(codes::REPEATED_POINT, nx("GOTO/0.0,0.0,0.0\n"), "0.0,0.0,0.0", nx("GOTO/0.0,0.0,0.1\n")),
        case(codes::FAR_AWAY, nx("GOTO/1.0,250000.0,0.0\n"), "250000.0", nx("GOTO/1.0,25000.0,0.0\n")),
        case(codes::FAR_AWAY, "UNITS/INCHES\nGOTO/9000.,0,0\n", "9000.", "UNITS/MM\nGOTO/9000.,0,0\n"),
        case(
            codes::POINT_APART,
            nx(&zigzag("1000.0000,12.5000,-1.0000")),
            "1000.0000",
            nx(&zigzag("400.0000,12.5000,-1.0000")),
        ),
        case(
            codes::POINT_APART,
            nx(&zigzag("30.0000,12.5000,-900.0000")),
            "-900.0000",
            nx(&zigzag("30.0000,12.5000,-90.0000")),
        ),
        case(codes::NO_MOTION, "PARTNO X\n", "", "PARTNO X\nGOTO/0,0,0\n"),
        case(
            codes::LEFT_IN_CUT,
            "TLDATA/MILL,9.0,0.0,9.0\nPAINT/COLOR,31\nGOTO/0.0,0.0,0.0\nGOTO/1.0,0.0,0.0\n",
            "GOTO/1.0,0.0,0.0",
            nx("PAINT/COLOR,31\nGOTO/1.0,0.0,0.0\n"),
        ),
    ]
}

#[test]
fn ways_to_a_place_far_away_are_no_slips() {
    let apart =
        |text: &str| super::findings(text).iter().filter(|found| found.code == codes::POINT_APART).count();
    let slip = "GOTO/1000.0000,12.5000,-1.0000\n";
    assert_eq!(apart(&nx(&zigzag(slip.trim_start_matches("GOTO/").trim_end()))), 1);
    // Home at both ends, by rapid and by feed.
    let home = "GOTO/0.0000,0.0000,900.0000\n";
    let middle = zigzag("20.0000,12.5000,-1.0000");
    assert_eq!(apart(&nx(&format!("RAPID\n{home}FEDRAT/MMPM,500.0000\n{middle}RAPID\n{home}"))), 0);
    assert_eq!(apart(&nx(&format!("{middle}RAPID\n{home}"))), 0);
    // A way out and back.
    assert_eq!(apart(&nx(&format!("{middle}{slip}{slip}{middle}"))), 0);
    // Few points, and a large part.
    assert_eq!(apart(&nx(slip)), 0);
    let large: String = (0..40).map(|index| format!("GOTO/{}.0000,0.0000,0.0000\n", index * 100)).collect();
    assert_eq!(apart(&nx(&large)), 0);
}
