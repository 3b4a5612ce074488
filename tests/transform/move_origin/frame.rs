//! `change: frame`: the path lands in the same place outside, whichever of the two changes.

use super::*;
use clsmith::program::Program;
use nalgebra::Point3;

fn outside(program: &Program) -> Vec<(Point3<f64>, nalgebra::Vector3<f64>)> {
    let map = |motion: clsmith::program::motion::Motion| {
        let frame = motion.frame.unwrap();
        let point = frame.origin + frame.axes * motion.to.point.coords;
        (point.into(), frame.axes * motion.to.axis)
    };
    program.motions().map(map).collect()
}

fn same_outside(settings: &str, text: &str) -> String {
    let (points, _) = apply(&format!("  - move_origin: {{ {settings} }}"), text);
    let (frame, _) = apply(&format!("  - move_origin: {{ {settings}, change: frame }}"), text);
    let (by_points, by_frame) = (outside(&support::program(&points)), outside(&support::program(&frame)));
    assert_eq!(by_points.len(), by_frame.len());
    for ((a, a_axis), (b, b_axis)) in by_points.iter().zip(&by_frame) {
        assert!((a - b).norm() < 3e-4, "{settings}: {a} {b}");
        assert!((a_axis - b_axis).norm() < 2e-6, "{settings}: {a_axis} {b_axis}");
    }
    frame
}

#[test]
fn nx_and_catia_land_in_the_same_place_by_points_and_by_frame() {
    let nx = NX.replace("CUTCOM/LEFT\n", "");
    for settings in [
        "translate: [1, -2, 3.25]",
        "rotate: { axis: z, degrees: 90 }",
        "rotate: { axis: y, degrees: -90, about: [1, 2, 3] }, translate: [5, 6, 7]",
        "rotate: { axis: [1, 2, 3], degrees: 47.11, about: [10, 20, 30] }",
    ] {
        same_outside(settings, &nx);
        same_outside(settings, CATIA);
    }
}

#[test]
fn only_the_frame_changes() {
    let frame = same_outside("rotate: { axis: z, degrees: 90 }, translate: [1, 0, 0]", NX);
    let expected = NX
        .replace(
            "MSYS/10.0000,20.0000,30.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000",
            "MSYS/11.0000,20.0000,30.0000,0.0000000,1.0000000,0.0000000,-1.0000000,0.0000000,0.0000000",
        )
        .replace("MSYS/0.0000,0.0000,0.0000,0,1,0,1,0,0", "MSYS/0.0000,1.0000,0.0000,1,0,0,0,-1,0");
    assert_eq!(frame, expected);
    let (catia, findings) = apply("  - move_origin: { translate: [1, 2, 3], change: frame }", CATIA);
    let expected = CATIA
        .replace("-220.00000", "-219.00000")
        .replace("-170.00000", "-168.00000")
        .replace("   20.00000\nPARTNO", "   23.00000\nPARTNO");
    assert_eq!(catia, expected);
    assert_eq!(findings.len(), 1);
}

#[test]
fn a_matrix_row_keeps_its_columns_and_its_blanks() {
    let (catia, _) = apply(
        "  - move_origin: { rotate: { axis: z, degrees: 30 }, translate: [-1234567, 0, 0], change: frame }",
        CATIA,
    );
    assert!(catia.contains("$$   0.8660254    -0.50000     0.00000 -1234787.00000\n"), "{catia}");
    assert_eq!(support::program(&catia).motions().next().unwrap().frame.unwrap().origin.x, -1234787.0);
}

#[test]
fn in_creo_the_matrix_takes_the_translation_back() {
    let text = CREO.replace("UNITS / INCHES\n", "UNITS / MM\n");
    let (after, _) =
        apply("  - move_origin: { translate: [106.609375, 121.28125, 100.59375], change: frame }", &text);
    assert_eq!(after.matches("GOTO / -0.3500000000, 4.2871428571, 1.2250000000").count(), 1);
    for translation in ["-106.6093750000", "-121.2812500000", "-100.5937500000"] {
        assert!(after.contains(translation), "{after}");
    }
}

#[test]
fn what_a_frame_cannot_hold_is_refused() {
    let frame = |settings: &str, text: &str| refused(&format!("{{ {settings}, change: frame }}"), text);
    assert!(frame("mirror: x", NX).contains("right-handed"));
    assert!(frame("translate: [1, 0, 0]", SOLIDWORKS).contains("world coordinates"));
    assert!(frame("rotate: { axis: z, degrees: 90 }", CREO).contains("not known for Creo"));
    let turned = CREO.replacen("1.0000000000, 0.0000000000", "0.0000000000, 1.0000000000", 1);
    assert!(frame("translate: [1, 0, 0]", &turned).contains("in a sense that is not known"));
    for text in [MAKINO, ISO, CAMWORKS] {
        assert!(frame("translate: [1, 0, 0]", text).contains("no frame record"));
    }
    let late = NX.replacen("MSYS/10", "$$ MSYS/10", 1);
    assert!(frame("translate: [1, 0, 0]", &late).contains("no frame record"));
}

#[test]
fn a_frame_that_others_share_is_not_moved_for_some() {
    let one_frame = NX.replace("MSYS/0.0000,0.0000,0.0000,0,1,0,1,0,0\n", "");
    let message =
        refused("{ translate: [1, 0, 0], change: frame, where: { operations: [POCKET] } }", &one_frame);
    assert!(message.contains("the same frame governs"), "{message}");
    let (after, _) =
        apply("  - move_origin: { translate: [1, 0, 0], change: frame, where: { operations: [FACE] } }", NX);
    assert_eq!(after, NX.replace("MSYS/0.0000,0.0000", "MSYS/0.0000,1.0000"));
}
