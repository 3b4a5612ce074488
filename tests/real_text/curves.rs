//! Arcs and helices in the forms that files really have.

use super::{MOVE, TO_INCH, alarms, apply, assert_near, findings, read, totals};
use clsmith::program::geometry::MotionPath;
use clsmith::program::motion::Motion;
use std::f64::consts::PI;

/// A CATIA program that stands at a point and goes on with some lines.
fn catia(start: &str, lines: &str) -> String {
    format!(
        "$$     CATIA APT VERSION 1.0\nTOOLNO/1,   12.000000\nCUTTER/   12.000000\nLOADTL/1\n\
         SPINDL/ 3000.0000,RPM,CLW\nFEDRAT/  600.0000,MMPM\nGOTO  /{start}\n{lines}FINI\n"
    )
}

fn motions(text: &str) -> Vec<Motion> {
    read(text).motions().collect()
}

/// A helix of 2.5 turns about z that rises by 6.
const HELIX: &str = "HELICAL/CENTER,   25.00000,   10.00000,  -12.00000,$\nINDIRV,    0.00000,    1.00000,    0.00000,$\n\
    AXIS,    0.00000,    0.00000,    1.00000,$\nPITCH,    2.40000,RADIUS,    8.00000,ANGLE,  900.00000,$\n\
    HEIGHT,    6.00000,ROUND,    2.50000,$\nEND,   17.00000,   10.00000,   -6.00000\n";

#[test]
fn a_helical_is_a_motion_with_all_its_turns() {
    let text = catia("33,10,-12", &format!("{HELIX}GOTO/25,10,-6\n"));
    assert_eq!(alarms(&text), []);
    assert_near("helix and way", totals(&read(&text)).0, (5.0 * PI * 8.0).hypot(6.0) + 8.0);
    let MotionPath::Arc(arc) = &motions(&text)[1].path else { panic!("no arc") };
    assert_near("turns", arc.sweep, 5.0 * PI);
    // It starts in the direction that it says, so the other one turns it over.
    let other = text.replace("INDIRV,    0.00000,    1.00000", "INDIRV,    0.00000,   -1.00000");
    let MotionPath::Arc(other) = &motions(&other)[1].path else { panic!("no arc") };
    assert_near("the other sense", other.axis.z, -1.0);
}

#[test]
fn a_helical_moves_turns_and_converts_with_the_path() {
    let text = catia("33,10,-12", HELIX);
    let moved = apply(MOVE, &text);
    assert!(moved.contains("CENTER,   30.00000,    7.00000,  -10.00000"), "{moved}");
    assert!(moved.contains("END,   22.00000,    7.00000,   -4.00000"), "{moved}");
    assert!(moved.contains("PITCH,    2.40000,RADIUS,    8.00000,ANGLE,  900.00000"), "{moved}");
    let inch = apply(TO_INCH, &text);
    for number in ["PITCH,  0.0944882", "RADIUS,  0.3149606", "ANGLE,  900.00000", "ROUND,    2.50000"] {
        assert!(inch.contains(number), "{number}: {inch}");
    }
    for steps in [
        "  - move_origin: { mirror: x }\n",
        "  - move_origin: { mirror: z, rotate: { axis: x, degrees: 180 } }\n",
        "  - move_origin: { rotate: { axis: z, degrees: 90 } }\n",
    ] {
        let changed = apply(steps, &text);
        assert_eq!(alarms(&changed), [], "{changed}");
        assert_near(steps, totals(&read(&changed)).0, totals(&read(&text)).0);
    }
}

/// A third of a circle about x on a cylinder, with its end in a check plane.
fn cylinder(axis: &str, on: &str) -> String {
    format!(
        "PSIS/(PLANE/(POINT/   50.00000,   12.00000,    0.00000),PERPTO,$\n(VECTOR/ 1.000000, 0.000000, 0.000000))\n\
         INDIRV/  0.00000,   0.00000,  -1.00000\nTLON,GOFWD/  (CYLNDR/   50.00000,    0.00000,    0.00000,$\n\
         {axis},   12.00000),{on},$\n(PLANE/PERPTO,$\n(PLANE/(POINT/   50.00000,    0.00000,    0.00000),PERPTO,$\n\
         (VECTOR/ 1.000000, 0.000000, 0.000000)),$\n(POINT/   50.00000,    0.00000,    0.00000),$\n\
         (POINT/   50.00000,   -6.00000,  -10.39230))\n"
    )
}

#[test]
fn an_arc_on_a_cylinder_about_any_axis_is_an_arc() {
    for (axis, on, degrees) in
        [(" 1.000000, 0.000000, 0.000000", "ON", 120.0), ("-1.000000, 0.000000, 0.000000", "ON", 120.0)]
    {
        let text = catia("50,12,0", &cylinder(axis, on));
        assert_eq!(alarms(&text), [], "{text}");
        assert_near(axis, totals(&read(&text)).0, 12.0 * f64::to_radians(degrees));
    }
    // The start direction tells the sense; `2,INTOF` only confirms that it is the long way round.
    let long = cylinder(" 1.000000, 0.000000, 0.000000", "ON,2,INTOF")
        .replace("0.00000,  -1.00000", "0.00000,   1.00000");
    let text = catia("50,12,0", &long);
    assert_eq!(alarms(&text), []);
    assert_near("long way", totals(&read(&text)).0, 12.0 * 240.0_f64.to_radians());
}

#[test]
fn an_arc_on_a_cylinder_moves_with_its_surfaces() {
    let text = catia("50,12,0", &cylinder(" 1.000000, 0.000000, 0.000000", "ON"));
    let moved = apply(MOVE, &text);
    for part in [
        "PSIS/(PLANE/(POINT/   55.00000,    9.00000,    2.00000)",
        "(CYLNDR/   55.00000,   -3.00000,    2.00000",
        "(POINT/   55.00000,   -9.00000,   -8.39230)",
        "(VECTOR/ 1.000000, 0.000000, 0.000000)",
        "   12.00000),ON",
    ] {
        assert!(moved.contains(part), "{part}: {moved}");
    }
    let inch = apply(TO_INCH, &text);
    assert!(inch.contains("0.4724409),ON"), "{inch}");
    for steps in
        ["  - move_origin: { mirror: y }\n", "  - move_origin: { rotate: { axis: z, degrees: 37 } }\n"]
    {
        let changed = apply(steps, &text);
        assert_eq!(alarms(&changed), [], "{changed}");
        assert_near(steps, totals(&read(&changed)).0, totals(&read(&text)).0);
    }
}

#[test]
fn a_drive_circle_may_state_its_axis() {
    let text = catia(
        "0,0,0",
        "INDIRV/1.,0.,0.\nTLON,GOFWD/(CIRCLE/0.,10.,0.,0.,0.,1.,10.),ON,$\n(LINE/0.,10.,0.,10.,10.,0.)\n",
    );
    assert_eq!(alarms(&text), []);
    assert_near("quarter", totals(&read(&text)).0, 5.0 * PI);
    for (steps, scale) in [(MOVE, 1.0), (TO_INCH, 25.4), ("  - move_origin: { mirror: x }\n", 1.0)] {
        let changed = apply(steps, &text);
        assert_eq!(alarms(&changed), [], "{changed}");
        assert!((totals(&read(&changed)).0 * scale - 5.0 * PI).abs() < 1e-3, "{changed}");
        assert_near("radius", motions(&changed)[1].length() * scale, 5.0 * PI);
    }
}

#[test]
fn an_arc_of_a_micron_stays_one_in_inches() {
    let text = |scale: f64, unit: &str| {
        let print = |point: [f64; 2]| format!("{:.6},{:.6},0", point[0] / scale, point[1] / scale);
        let [start, end] = [[10.0, 0.0], [10.0, 0.0012]].map(print);
        format!("UNITS/{unit}\nGOTO/{start}\nCIRCLE/0,0,0,0,0,1,{:.6}\nGOTO/{end}\n", 10.0 / scale)
    };
    for (scale, unit) in [(1.0, "MM"), (25.4, "INCHES")] {
        let arc = motions(&text(scale, unit)).pop().unwrap();
        assert!((arc.length() * scale - 0.0012).abs() < 1e-4, "{unit}: {}", arc.length());
    }
}

#[test]
fn a_drive_motion_of_another_form_is_not_passed_over() {
    let text = catia("0,0,0", "TLON,GOFWD/(CONE/CANON,0,0,0,0,0,1,.5),PAST,(PLANE/0,1,0,5)\nGOTO/9,0,0\n");
    assert_eq!(alarms(&text), [("CL0159".to_owned(), 8)]);
}

/// A Creo program that stands at a point and goes on with some lines.
fn creo(start: &str, lines: &str) -> String {
    format!(
        "$$*          Pro/CLfile  Version 11.0 - 11.0.0.0\nUNITS / MM\nLOADTL / 1\n$$-> CUTTER / 8.000000\n\
         SPINDL / RPM, 1800.000000,  CLW\nFEDRAT / 240.000000,  MMPM\nGOTO / {start}\n{lines}FINI\n"
    )
}

fn on_circle(degrees: f64) -> String {
    let angle = degrees.to_radians();
    format!("{:.10}, {:.10}, -3.0000000000", 40.0 + 15.0 * angle.cos(), 20.0 + 15.0 * angle.sin())
}

#[test]
fn all_points_under_a_creo_circle_lie_on_its_arc() {
    let circle = "CIRCLE / 40.0000000000, 20.0000000000, -3.0000000000,  $\n0.0, 0.0, 1.0, 15.0000000000\n";
    for (angles, sweep) in
        [(vec![60.0, 130.0, 200.0], 200.0), (vec![90.0], 90.0), (vec![150.0, 300.0, 430.0], 430.0)]
    {
        let points: Vec<String> = angles.iter().map(|angle| on_circle(*angle)).collect();
        let text = creo("55.0, 20.0, -3.0", &format!("{circle}GOTO / {}\n", points.join("\n")));
        assert_eq!(findings(&text, true), [], "{text}");
        let found = motions(&text);
        assert_eq!(found.len(), 2, "one arc");
        assert_near("sweep", found[1].length(), 15.0 * f64::to_radians(sweep));
    }
    // The axis turns the arc by the right hand, also where it starts with a cusp.
    let clockwise = circle.replace("0.0, 0.0, 1.0, 15", "0.0, 0.0, -1.0, 15");
    let text = creo("55.0, 20.0, -3.0", &format!("{clockwise}GOTO / {}\n", on_circle(-90.0)));
    assert_eq!(findings(&text, true), []);
    assert_near("clockwise", motions(&text)[1].length(), 15.0 * PI / 2.0);
}

#[test]
fn points_that_are_not_on_the_arc_come_after_it() {
    let text = "FEDRAT/100,MMPM\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n-20,10,0\n";
    let found = motions(text);
    assert_eq!(found.len(), 3);
    assert_near("arc and line", totals(&read(text)).0, 5.0 * PI + 20.0);
}

#[test]
fn the_angle_of_a_movarc_tells_its_sense_where_the_normal_is_always_the_same() {
    let arc = |degrees: f64, end: &str| {
        format!(
            "UNITS/MM\nCUTTER/10\nLOADTL/1\nSPINDL/1000,CLW\nFEDRAT/600,MMPM\nGOTO/10,0,0\nMOVARC/0,0,0,0,0,1,10,ANGLE,{degrees}\nGOTO/{end}\n"
        )
    };
    for (degrees, end, notes) in
        [(90.0, "0,10,0", 0), (270.0, "0,-10,0", 0), (90.0, "0,-10,0", 1), (450.0, "0,10,0", 0)]
    {
        let text = arc(degrees, end);
        assert_eq!(alarms(&text), [], "{text}");
        assert_near(end, totals(&read(&text)).0, 10.0 * f64::to_radians(degrees));
        assert_eq!(findings(&text, true).iter().filter(|(code, _)| code == "CL0118").count(), notes);
    }
    // An angle below 0 turns against the axis.
    for (degrees, end) in [(-90.0, "0,-10,0"), (-270.0, "0,10,0"), (-360.0, "10,0,0")] {
        let text = arc(degrees, end);
        assert_eq!(alarms(&text), [], "{text}");
        assert_near(end, totals(&read(&text)).0, 10.0 * f64::to_radians(-degrees));
        let MotionPath::Arc(found) = &motions(&text)[1].path else { panic!("no arc") };
        assert_near("clockwise", found.axis.z, -1.0);
    }
    let turned = arc(-90.0, "0,-10,0").replace("0,0,0,0,0,1,10", "0,0,0,0,0,-1,10");
    assert_near("both say it", totals(&read(&turned)).0, 5.0 * PI);
    assert_eq!(alarms(arc(120.0, "0,10,0")), [("CL0102".to_owned(), 8)], "it fits neither sense");
}

#[test]
fn an_arc_that_turns_back_at_both_ends_is_suspicious() {
    let corner = |k: i32| {
        format!(
            "TOOL PATH/A,TOOL,B\nTLDATA/MILL,6.,0.,60.,0.,0.\nLOAD/TOOL,1\nSPINDL/RPM,1000,CLW\nFEDRAT/MMPM,600.\nGOTO/0,0,0\n\
             GOTO/40,0,0\nCIRCLE/40,8,0,0,0,{k},8.\nGOTO/48,8,0\nGOTO/48,40,0\nEND-OF-PATH\n"
        )
    };
    assert_eq!(alarms(corner(-1)), []);
    assert_eq!(alarms(corner(1)), [("CL0119".to_owned(), 8)]);
    // A cusp that goes back the short way is a corner.
    let cusp = corner(1).replace("GOTO/0,0,0", "GOTO/48,0,0");
    assert_eq!(alarms(cusp.replace("CIRCLE/40,8,0,0,0,1,8.", "CIRCLE/40,8,0,0,0,-1,8.")), []);
}

#[test]
fn unknown_words_with_points_between_motions_are_seen() {
    let text = "UNITS/MM\nCUTTER/10\nLOADTL/1\nSPINDL/1000,CLW\nFEDRAT/600,MMPM\nORIGN_X/1,2,3\nGOTO/0,0,0\nSPLPNT/1,2,3\n\
                SPLPNT/2,3,4\nGOTO/9,0,0\nPARK/1,2,3\n";
    assert_eq!(alarms(text), [("CL0159".to_owned(), 8)]);
    // Words that name curves need not hold one point alone.
    for word in ["HELIX/CENTER,0,10,0,RADIUS,10", "SPIRAL/0,10,0,0,0,1,10,90", "ARCDAT/0,10,0,0,0,1,10"] {
        let text = text.replace("SPLPNT/1,2,3", word).replace("SPLPNT/2,3,4", "COOLNT/ON");
        assert_eq!(alarms(&text), [("CL0159".to_owned(), 8)], "{word}");
    }
}

#[test]
fn a_text_that_takes_a_line_of_the_path_is_seen() {
    // Only a full line of text goes on.
    let text = "TOOL PATH/A,TOOL,B\nTLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\nLOAD/TOOL,1,ADJUST,1\nSPINDL/RPM,900,CLW\n\
                COOLNT/ON\nFEDRAT/MMPM,100.0000\nGOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000\nPPRINT A TEXT THAT GOES ON UP TO THE COLUMN SEVENTY-TWO AND ENDS THERE $\n\
                GOTO/1.0000,2.0000,3.0000\nGOTO/9.0000,2.0000,3.0000\nEND-OF-PATH\n";
    assert_eq!(alarms(text), [("CL0159".to_owned(), 9)]);
    // A text that goes on in words says nothing of the path.
    assert_eq!(alarms(text.replace("GOTO/1.0000,2.0000,3.0000", "THAT NAMES GOTO/ IN ITS MIDDLE")), []);
}

/// The findings of a check about a helix whose turns and angle are given.
fn helix_findings(angle: &str, round: &str) -> Vec<(String, usize)> {
    let helix = HELIX.replace("ANGLE,  900.00000", angle).replace("ROUND,    2.50000", round);
    alarms(catia("33,10,-12", &helix))
}

#[test]
fn turns_that_are_not_the_angle_are_told() {
    assert_eq!(helix_findings("ANGLE,  900.00000", "ROUND,    2.50000"), []);
    assert_eq!(helix_findings("ANGLE,  900.00000", "ROUND,    3.50000").len(), 1);
    // Without an angle, the turns tell how far it goes, and without these the rise and the pitch.
    for left_out in ["", ",ROUND,    2.50000"] {
        let text = HELIX.replace("ANGLE,  900.00000,", "").replace(left_out, "");
        let text = catia("33,10,-12", &text);
        let MotionPath::Arc(arc) = &motions(&text)[1].path else { panic!("no arc") };
        assert_near("turns", arc.sweep, 5.0 * PI);
    }
}

/// A Creo program with an arc of radius 15 about (20, 20) and points on it, by their angles in degrees and distances
/// from the circle.
fn creo_arc(points: &[(f64, f64)]) -> String {
    let point = |(degrees, off): &(f64, f64)| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        format!("{:.6}, {:.6}, 0.0", 20.0 + (15.0 + off) * cosine, 20.0 + (15.0 + off) * sine)
    };
    let lines: Vec<String> = points.iter().map(point).collect();
    format!(
        "$$*          Pro/CLfile  Version 9.0 - 9.0.3.0\n$$-> MFGNO / A\nPARTNO / A\nUNITS / MM\nLOADTL / 1\n$$-> CUTTER / 8.000000\n\
         SPINDL / RPM, 1400.000000,  CLW\nFEDRAT / 240.000000,  MMPM\nGOTO / 35.0, 20.0, 0.0\n\
         CIRCLE / 20.0, 20.0, 0.0, $\n0.0, 0.0, 1.0, 15.0\nGOTO / {}\n$$-> END / \nFINI\n",
        lines.join("\n")
    )
}

#[test]
fn bad_points_of_creos_arcs_are_told() {
    let arc = |points: &[(f64, f64)]| {
        let text = creo_arc(points);
        (alarms(&text), totals(&read(&text)).0)
    };
    let whole = 200_f64.to_radians() * 15.0;
    let (found, length) = arc(&[(60.0, 0.0), (130.0, 0.0), (200.0, 0.0)]);
    assert_eq!(found, []);
    assert_near("in order", length, whole);
    // Half a millimetre beside the circle: still a point of the arc, and told.
    let (found, length) = arc(&[(60.0, 0.5), (130.0, 0.0), (200.0, 0.0)]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_near("beside it", length, whole);
    let (found, length) = arc(&[(130.0, 0.0), (60.0, 0.0), (200.0, 0.0)]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_near("out of order", length, whole);
    // Far away is no point of the arc, and told, too.
    assert!(!arc(&[(60.0, 0.0), (130.0, 9.0), (200.0, 0.0)]).0.is_empty());
}
