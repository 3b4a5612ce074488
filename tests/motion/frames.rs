//! Frames: MSYS, CSYS, CAMERA, CATIA0, and the shifts of a post.

use crate::support::{clean_motions, motions, program, program_of};
use clsmith::program::Dialect;
use clsmith::program::motion::{CoordinateFrame, MotionProblemKind};
use nalgebra::{Matrix3, Point3, Vector3};

fn frame_of(text: &str) -> CoordinateFrame {
    let found = clean_motions(&program(text));
    found.last().unwrap().frame.as_deref().unwrap().clone()
}

#[test]
fn msys_is_origin_x_axis_and_y_axis() {
    // This one turns z over: (0,1,0) x (1,0,0) = (0,0,-1).
    let frame = frame_of("MSYS/393.0000,-297.5000,3.0000,0,1,0,1,0,0\nGOTO/0,0,0\n");
    assert_eq!(frame.origin, Vector3::new(393.0, -297.5, 3.0));
    assert_eq!(frame.axes, Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0));
    assert_eq!(frame.statement.index(), 0);
}

#[test]
fn csys_has_the_axes_in_columns_and_the_origin_in_the_fourth() {
    let expected = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    for csys in [
        "CSYS/0,0,1.,5.,1.,0,0,6.,0,1.,0,7.",
        "$$-> CSYS / 0, 0, 1, 5,  $\n 1, 0, 0, 6,  $\n 0, 1, 0, 7",
        "    CAMERA/ 0,0,1,5,$\n  1,0,0,6,$\n 0,1,0,7",
    ] {
        let frame = frame_of(&format!("{csys}\nGOTO/0,0,0\n"));
        assert_eq!((frame.axes, frame.origin), (expected, Vector3::new(5.0, 6.0, 7.0)), "{csys}");
    }
}

#[test]
fn catia_keeps_the_matrix_in_three_rows_of_comment() {
    let text = "$$*CATIA0\n$$ Program.1\n$$     1.00000     0.00000     0.00000  -220.00000\n$$     0.00000    -1.00000     0.00000  -170.00000\n$$     0.00000     0.00000    -1.00000    20.00000\nGOTO/0,0,0\n";
    let frame = frame_of(text);
    assert_eq!(frame.origin, Vector3::new(-220.0, -170.0, 20.0));
    assert_eq!(frame.axes, Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)));
}

#[test]
fn a_second_matrix_replaces_the_first() {
    let matrix = |x: f64| format!("$$*CATIA0\n$$ MSYS/\n$$ 1 0 0 {x}\n$$ 0 1 0 0\n$$ 0 0 1 0\n");
    let found = clean_motions(&program(format!("{}GOTO/0,0,0\n{}GOTO/1,0,0\n", matrix(1.0), matrix(2.0))));
    let origins: Vec<_> = found.iter().map(|motion| motion.frame.as_ref().unwrap().origin.x).collect();
    assert_eq!(origins, [1.0, 2.0]);
}

#[test]
fn a_matrix_without_its_rows_is_told_and_sets_nothing() {
    for text in [
        "$$*CATIA0\n$$ Program.1\n$$ 1 0 0 0\nGOTO/0,0,0\n",
        "$$*CATIA0\n",
        "GOTO/0,0,0\n$$*CATIA0\n$$ 1 0 0 0\n$$ 0 1 0 0\n",
    ] {
        let (found, problems) = motions(&program(text));
        assert_eq!(problems, [MotionProblemKind::BrokenFrame], "{text}");
        assert!(found.iter().all(|motion| motion.frame.is_none()));
    }
}

#[test]
fn four_numbers_in_another_comment_are_no_frame() {
    assert!(clean_motions(&program("$$ 1 2 3 4\n$$ 1 0 0 0\n$$ 1 0 0 0\nGOTO/0,0,0\n"))[0].frame.is_none());
}

#[test]
fn trans_and_origin_are_shifts_of_the_post_and_move_no_point() {
    let shift = |text: &str| {
        let program = program(format!("{text}\nGOTO/1,2,3\n"));
        let mut motions = program.motions();
        let point = motions.next().unwrap().to.point;
        assert_eq!(point, Point3::new(1.0, 2.0, 3.0));
        motions.state().shift
    };
    assert_eq!(shift("TRANS/10,0,-5"), Vector3::new(10.0, 0.0, -5.0));
    assert_eq!(shift("ORIGIN/10,0,-5"), Vector3::new(-10.0, 0.0, 5.0));
    assert_eq!(shift("TRANS/10,0,-5\nTRANS/1,1,1"), Vector3::new(1.0, 1.0, 1.0));
}

#[test]
fn a_tool_in_a_new_nx_frame_is_where_it_was_in_the_part() {
    // NX prints points in MSYS. The second path looks from below: what was z = 30 is z = -70 there, and far away in x.
    let first = "TOOL PATH/A,TOOL,T\nMSYS/0,0,0,1,0,0,0,1,0\nGOTO/10,20,30,0,0,1\nEND-OF-PATH\n";
    let second = "TOOL PATH/B,TOOL,T\nMSYS/60,0,-40,-1,0,0,0,1,0\nRAPID\nGOTO/10,20,50\nEND-OF-PATH\n";
    let found = clean_motions(&program(format!("{first}{second}")));
    assert_eq!(found[1].from.point, Point3::new(50.0, 20.0, -70.0));
    assert_eq!((found[1].from.axis, found[1].to.axis), (-Vector3::z(), Vector3::z()));
    // The same frame again changes nothing, not a bit.
    let found = clean_motions(&program(format!("{first}{first}")));
    assert_eq!(found[1].from, found[0].to);
}

#[test]
fn solidworks_and_creo_print_points_in_one_frame_whatever_csys_says() {
    for dialect in [Dialect::SolidWorks, Dialect::Creo] {
        let text = "CSYS/1,0,0,0,0,1,0,0,0,0,1,0\nGOTO/1,2,3\nCSYS/0,0,1,5,1,0,0,6,0,1,0,7\nGOTO/4,5,6\n";
        let found = clean_motions(&program_of(dialect, text));
        assert_eq!(found[1].from.point, Point3::new(1.0, 2.0, 3.0));
    }
}
