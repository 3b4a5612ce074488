//! Closed forms in every dialect, and what the changes look like.

use super::*;
use crate::support::snapshots;
use proptest::prelude::*;

#[test]
fn translation_moves_every_motion_and_nothing_else() {
    for (name, text) in ALL {
        let settings =
            if name == "creo" { "{ translate: [25.4, -50.8, 76.2] }" } else { "{ translate: [1, -2, 3] }" };
        moved(settings, text, &Place::identity().translated([1.0, -2.0, 3.0]));
    }
}

#[test]
fn quarter_turns_keep_the_decimals_and_map_zeros_to_zeros() {
    let place = Place::identity().rotated([0.0, 0.0, 1.0], 90.0, [0.0; 3]);
    for (name, text) in ALL {
        let (after, _) = moved("{ rotate: { axis: z, degrees: 90 } }", text, &place);
        snapshots("move_origin").bind(|| {
            insta::assert_snapshot!(format!("quarter_turn_{name}"), diff(text, &after));
        });
    }
}

#[test]
fn a_mirror_swaps_arcs_and_sides() {
    let place = Place::identity().mirrored([1.0, 0.0, 0.0], [0.0; 3]);
    for (name, text) in ALL {
        let (after, findings) = moved("{ mirror: x }", text, &place);
        assert!(findings[0].message.starts_with("the spindle keeps its sense"), "{:?}", shown(&findings));
        snapshots("move_origin").bind(|| {
            insta::assert_snapshot!(format!("mirror_{name}"), diff(text, &after));
        });
    }
}

#[test]
fn a_tilt_writes_out_the_axes_that_the_file_leaves_unsaid() {
    let place = Place::identity().rotated([1.0, 0.0, 0.0], 90.0, [0.0; 3]);
    for (name, text) in ALL.iter().filter(|(name, _)| !matches!(*name, "solidworks" | "camworks")) {
        let text = text.replace("CUTCOM/LEFT\n", "");
        let (after, _) = moved("{ rotate: { axis: x, degrees: 90 } }", &text, &place);
        snapshots("move_origin").bind(|| {
            insta::assert_snapshot!(format!("tilt_{name}"), diff(&text, &after));
        });
    }
}

#[test]
fn solidworks_without_a_setup_states_a_tilted_axis_in_every_line() {
    let text = SOLIDWORKS.replace("CSYS/1.,0,0,0,0,1.,0,0,0,0,1.,0\n", "");
    let place = Place::identity().rotated([1.0, 0.0, 0.0], 90.0, [0.0; 3]);
    let (after, _) = moved("{ rotate: { axis: x, degrees: 90 } }", &text, &place);
    for line in after.lines().filter(|line| line.starts_with("GOTO")) {
        assert!(line.ends_with(",0,-1.,0"), "{after}");
    }
}

#[test]
fn the_order_is_mirror_then_rotate_then_translate() {
    let place = Place::identity()
        .mirrored([1.0, 1.0, 0.0], [3.0, 0.0, 0.0])
        .rotated([0.0, 0.0, 1.0], 30.0, [5.0, 5.0, 0.0])
        .translated([100.0, 0.0, -7.5]);
    let settings = "{ mirror: { normal: [2, 2, 0], through: [3, 0, 0] }, \
                    rotate: { axis: [0, 0, 2], degrees: 30, about: [5, 5, 0] }, translate: [100, 0, -7.5] }";
    for (_, text) in ALL.iter().filter(|(name, _)| *name != "creo") {
        moved(settings, text, &place);
    }
}

#[test]
fn moving_by_nothing_changes_no_byte() {
    for settings in ["{ translate: [0, 0, 0] }", "{ rotate: { axis: z, degrees: 360 } }"] {
        for (_, text) in ALL {
            let (after, findings) = apply(&format!("  - move_origin: {settings}"), text);
            assert_eq!(after, text);
            assert!(findings.is_empty());
        }
    }
}

#[test]
fn a_turn_and_its_reverse_give_the_file_back() {
    let there_and_back = "  - move_origin: { rotate: { axis: z, degrees: 90, about: [1, 2, 3] } }
  - move_origin: { rotate: { axis: z, degrees: -90, about: [1, 2, 3] } }";
    for (name, text) in ALL.iter().filter(|(name, _)| !matches!(*name, "creo" | "makino")) {
        assert_eq!(apply(there_and_back, text).0, *text, "{name}");
    }
    let mirrors = "  - move_origin: { mirror: y }\n  - move_origin: { mirror: y }";
    for (name, text) in ALL.iter().filter(|(name, _)| *name != "makino") {
        assert_eq!(apply(mirrors, text).0, *text, "{name}");
    }
}

#[test]
fn inches_of_the_recipe_become_millimetres_of_the_file() {
    let recipe = "version: 1\nunits: inch\nsteps:\n  - move_origin: { translate: [1, 0, 0] }";
    let (after, _) = try_apply(recipe, SOLIDWORKS).unwrap();
    assert!(after.contains("GOTO/25.4,0,25."), "{after}");
}

#[test]
fn crlf_and_trailing_blanks_survive() {
    let text = NX.replace('\n', " \r\n");
    let (after, _) =
        apply("  - move_origin: { rotate: { axis: x, degrees: 90 } }", text.replace("CUTCOM/LEFT \r\n", ""));
    assert_eq!(after.matches('\n').count(), after.matches(" \r\n").count());
}

#[test]
fn a_second_step_still_knows_the_style_of_the_file() {
    let text = CATIA.replace('\n', "\r\n");
    let steps = "  - move_origin: { translate: [1, 1, 1] }
  - move_origin: { rotate: { axis: x, degrees: 90 } }";
    let (after, _) = apply(steps, text.replace("FEDRAT/  300.0000,MMPM\r\n", ""));
    assert_eq!(after.matches('\n').count(), after.matches("\r\n").count());
    let steps = "  - move_origin: { translate: [1, 1, 1] }
  - move_origin: { rotate: { axis: z, degrees: 30 } }";
    let text = SOLIDWORKS.replace("GOTO/10.,0,0", "GOTO/10.123456,0,0").replace("CIRCLE/0,0,0,0,0,1.\n", "");
    let (after, _) = apply(steps, text);
    assert!(after.contains("GOTO/9.133195,6.427753,1."), "{after}");
}

proptest! {
    #![proptest_config(crate::support::property(40))]

    #[test]
    fn any_rigid_transform_moves_nx_catia_and_iso(
        axis in prop::array::uniform3(-1.0..1.0f64),
        degrees in -360.0..360.0f64,
        about in prop::array::uniform3(-100.0..100.0f64),
        by in prop::array::uniform3(-500.0..500.0f64),
        normal in prop::array::uniform3(-1.0..1.0f64),
        mirror: bool,
    ) {
        prop_assume!(axis.iter().map(|part| part * part).sum::<f64>() > 0.01);
        prop_assume!(normal.iter().map(|part| part * part).sum::<f64>() > 0.01);
        let mut place = Place::identity();
        let mut settings = format!("rotate: {{ axis: {axis:?}, degrees: {degrees:?}, about: {about:?} }}, translate: {by:?}");
        if mirror {
            place = place.mirrored(normal, about);
            settings += &format!(", mirror: {{ normal: {normal:?}, through: {about:?} }}");
        }
        place = place.rotated(axis, degrees, about).translated(by);
        for text in [NX, CATIA, ISO] {
            moved(&format!("{{ {settings} }}"), text, &place);
        }
    }
}
