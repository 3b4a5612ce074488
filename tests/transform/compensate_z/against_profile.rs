//! Passes as profiles, in planes of any direction.

use super::{compensate, envelope, in_plane, operation};
use crate::support;
use clsmith::program::geometry::MotionPath;
use nalgebra::Vector2;

const R: f64 = 5.0;

/// The path's points back in the plane of their pass.
fn flat(points: &[nalgebra::Point3<f64>], origin: [f64; 2], degrees: f64) -> Vec<(f64, f64)> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let along = Vector2::new(cos, sin);
    points.iter().map(|at| ((at.xy().coords - Vector2::from(origin)).dot(&along), at.z)).collect()
}

#[test]
fn profiles_come_out_right_in_every_plane() {
    let slope = 30f64.to_radians();
    let profiles: [(&str, Vec<(f64, f64)>); 6] = [
        ("flat", vec![(0.0, 2.0), (40.0, 2.0)]),
        ("slope", vec![(0.0, 0.0), (40.0, 40.0 * slope.tan())]),
        ("ridge", vec![(0.0, 0.0), (20.0, 15.0), (40.0, 0.0)]),
        ("valley", vec![(0.0, 15.0), (20.0, 0.0), (40.0, 15.0)]),
        ("steps", vec![(0.0, 0.0), (15.0, 0.0), (15.0, 8.0), (25.0, 8.0), (25.0, 0.0), (40.0, 0.0)]),
        ("waves", (0..=160).map(|i| f64::from(i) * 0.25).map(|u| (u, 3.0 * (u / 4.0).sin())).collect()),
    ];
    for degrees in [0.0, 90.0, 37.0, 180.0] {
        for (name, profile) in &profiles {
            let origin = [10.0, -5.0];
            let text = operation(&[in_plane(profile, origin, degrees)]);
            let done = compensate("tolerance: 0.005", &text).unwrap();
            assert!(
                done.gouge() <= 0.0052 && done.gap() <= 0.0052,
                "{name} at {degrees}: {} {}",
                done.gouge(),
                done.gap()
            );
            let pass = flat(&done.passes()[0], origin, degrees);
            // Between the ends of chords, too, the tip is at the height that brute force finds; steep chords are compared across.
            for pair in pass.windows(2) {
                for share in [0.1, 0.5, 0.9] {
                    let u = pair[0].0 + (pair[1].0 - pair[0].0) * share;
                    let z = pair[0].1 + (pair[1].1 - pair[0].1) * share;
                    if (pair[1].0 - pair[0].0).abs() < 1e-3 {
                        continue;
                    }
                    let steep = ((pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).abs();
                    let off = (z - envelope(profile, R, u)).abs() / (1.0 + steep * steep).sqrt();
                    assert!(off < 0.0065, "{name} at {degrees}: {off} at u {u}");
                }
            }
        }
    }
}

#[test]
fn a_slope_moves_as_the_paper_says() {
    let slope = 30f64.to_radians();
    let text = operation(&[in_plane(&[(0.0, 0.0), (40.0, 40.0 * slope.tan())], [0.0, 0.0], 0.0)]);
    let done = compensate("radius: 5", &text).unwrap();
    let pass = &done.passes()[0];
    assert_eq!(pass.len(), 2);
    // Ps = Pc - R (sin U, 1 - cos U).
    let moved = (-R * slope.sin(), -R * (1.0 - slope.cos()));
    assert!((pass[0].x - moved.0).abs() < 1e-4 && (pass[0].z - moved.1).abs() < 1e-4, "{}", pass[0]);
    assert!((pass[1].x - 40.0 - moved.0).abs() < 1e-4);
}

#[test]
fn leads_and_rapids_go_with_their_ends() {
    let text = operation(&[in_plane(&[(0.0, 0.0), (20.0, 15.0), (40.0, 0.0)], [0.0, 0.0], 0.0)]);
    let done = compensate("tolerance: 0.01", &text).unwrap();
    let pass = done.passes()[0].clone();
    let (first, last) = (pass[0], pass[pass.len() - 1]);
    let motions: Vec<_> = done.program.motions().collect();
    let start = motions.iter().position(|motion| (motion.to.point - first).norm() < 1e-9).unwrap();
    assert!(
        (motions[start].from.point.xy() - first.xy()).norm() < 1e-9 && motions[start].from.point.z == 60.0
    );
    let end = motions.iter().rposition(|motion| (motion.from.point - last).norm() < 1e-9).unwrap();
    assert!((motions[end].to.point.xy() - last.xy()).norm() < 1e-9 && motions[end].to.point.z == 3.0);
    assert_eq!(motions[end + 1].to.point.z, 60.0);
    // What is no motion stays.
    let others = |text: &str| {
        text.lines().filter(|line| !line.starts_with("GOTO")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(others(&text), others(&done.text));
}

#[test]
fn a_zigzag_with_links_at_feed_is_taken_apart() {
    let ridge = [(0.0, 0.0), (20.0, 15.0), (40.0, 0.0)];
    let mut path: Vec<[f64; 3]> = Vec::new();
    for row in 0..5 {
        let mut pass = in_plane(&ridge, [0.0, f64::from(row) * 0.5], 0.0);
        if row % 2 == 1 {
            pass.reverse();
        }
        path.extend(pass);
    }
    let text = operation(&[path]);
    let done = compensate("tolerance: 0.005", &text).unwrap();
    assert_eq!(done.report.passes.len(), 5);
    assert!(done.gouge() <= 0.0052 && done.gap() <= 0.0052);
    // The links are still across: one end is the end of a pass, the other the start of the next.
    let ys: Vec<f64> = done.passes()[0].iter().map(|at| at.y).collect();
    assert!(ys.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > 0.4).count() == 4, "{ys:?}");
}

#[test]
fn arcs_stay_arcs_where_the_file_has_one_to_write_them_by() {
    // A hollow of radius 12 between two flats, as an arc: the axis of a left-hand CIRCLE in the zx plane.
    let head = "TOOL PATH/FINISH,TOOL,BALL_R5\nTLDATA/MILL,10.0000,5.0000,60.0000,0.0000,0.0000\nPAINT/COLOR,211\nRAPID\nGOTO/-30.0000,0.0000,40.0000,0.0000000,0.0000000,1.0000000\n";
    let body = "PAINT/COLOR,42\nFEDRAT/MMPM,300.0000\nGOTO/-30.0000,0.0000,0.0000\nPAINT/COLOR,31\nGOTO/-12.0000,0.0000,0.0000\nCIRCLE/0.0000,0.0000,0.0000,0.0000000,1.0000000,0.0000000,12.0000,0.0600,0.5000,10.0000,5.0000\nGOTO/12.0000,0.0000,0.0000\nGOTO/30.0000,0.0000,0.0000\nEND-OF-PATH\n";
    let text = format!("{head}{body}");
    let before: Vec<_> = support::program(&text).motions().collect();
    let low = before.iter().find_map(|motion| match &motion.path {
        MotionPath::Arc(arc) => Some(arc.point_at(0.5).z),
        _ => None,
    });
    assert!((low.unwrap() + 12.0).abs() < 1e-9, "the arc is a hollow");
    let done = compensate("tolerance: 0.005", &text).unwrap();
    let arcs: Vec<_> = done
        .program
        .motions()
        .filter_map(|motion| match motion.path {
            MotionPath::Arc(arc) => Some(arc),
            _ => None,
        })
        .collect();
    // The hollow's own offset, and the balls about its sharp edges.
    assert!(arcs.iter().any(|arc| (arc.radius - 7.0).abs() < 1e-3), "{arcs:?}");
    assert!(arcs.iter().any(|arc| (arc.radius - 5.0).abs() < 1e-3), "{arcs:?}");
    assert!(done.gouge() <= 0.0052 && done.gap() <= 0.0052, "{} {}", done.gouge(), done.gap());
    let chords = compensate("tolerance: 0.005, arcs: chords", &text).unwrap();
    assert!(!chords.text.contains("CIRCLE/") && chords.report.passes[0].motions_after > 20);
}

#[test]
fn a_feed_in_the_middle_stays_with_its_contact() {
    let waves: Vec<(f64, f64)> =
        (0..=80).map(|i| f64::from(i) * 0.5).map(|u| (u, 3.0 * (u / 4.0).sin())).collect();
    let text = operation(&[in_plane(&waves, [0.0, 0.0], 0.0)]);
    let (before, after) = text.split_at(text.find("GOTO/20.5000").unwrap());
    let text = format!("{before}FEDRAT/MMPM,450.0000\n{after}");
    let done = compensate("tolerance: 0.005", &text).unwrap();
    let slow: Vec<_> =
        done.program.motions().filter(|motion| motion.feed.is_some_and(|feed| feed.value == 450.0)).collect();
    let start = slow.first().unwrap().from.point.x;
    let sine = (0.75 * (20.0f64 / 4.0).cos()).atan().sin();
    assert!((start - (20.0 - R * sine)).abs() < 1.0, "{start}");
}

#[test]
fn what_the_ball_does_not_reach_is_told_at_its_place() {
    let valley = [(0.0, 15.0), (20.0, 0.0), (40.0, 15.0)];
    let done = compensate("tolerance: 0.005", &operation(&[in_plane(&valley, [0.0, 0.0], 0.0)])).unwrap();
    let found: Vec<_> = done.findings.iter().filter(|found| found.code.id() == "CL0330").collect();
    assert_eq!(found.len(), 1);
    assert!(found[0].message.contains("are left"), "{}", found[0].message);
    let label = &found[0].labels[0];
    assert!(String::from_utf8_lossy(label.source.slice(label.span)).contains("20.0000,0.0000,0.0000"));
    // In a corner of 2 x 36.87 degrees below the level, the ball stands R (1 / cos - 1) above it.
    let left = R * ((15.0f64 / 20.0).atan().cos().recip() - 1.0);
    assert!((done.report.passes[0].left_mm - left).abs() < 0.02, "{} {left}", done.report.passes[0].left_mm);
}

#[test]
fn centres_are_a_radius_above_tips() {
    let text = operation(&[in_plane(&[(0.0, 0.0), (20.0, 15.0), (40.0, 0.0)], [0.0, 0.0], 0.0)]);
    let tips = compensate("tolerance: 0.005", &text).unwrap().passes()[0].clone();
    let centres = compensate("tolerance: 0.005, output: centre", &text).unwrap().passes()[0].clone();
    assert_eq!(tips.len(), centres.len());
    assert!(
        tips.iter()
            .zip(&centres)
            .all(|(tip, centre)| (centre - tip - nalgebra::Vector3::new(0.0, 0.0, R)).norm() < 3e-4)
    );
}

#[test]
fn catia_arcs_are_written_as_catia_does() {
    let head = "$$     CATIA APT VERSION 1.0\nPARTNO P\n$$ OPERATION NAME : Sweep.1\nCUTTER/   10.000000,    5.000000,    0.000000,    5.000000,    0.000000,    0.000000,   50.000000\nLOADTL/1\nRAPID\nGOTO  /  -30.00000,    0.00000,   40.00000\nFEDRAT/  300.0000,MMPM\n";
    let body = "GOTO  /  -30.00000,    0.00000,    0.00000\nGOTO  /  -12.00000,    0.00000,    0.00000\nAUTOPS\nINDIRV/    0.00000,    0.00000,   -1.00000\nTLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,      0.00000,$\n      12.00000),ON,(LINE/      0.00000,      0.00000,      0.00000,$\n                              12.00000,      0.00000,      0.00000)\nGOTO  /   30.00000,    0.00000,    0.00000\nRAPID\nGOTO  /   30.00000,    0.00000,   40.00000\n$$ end of pass\nSPINDL/OFF\nREWIND/0\nEND\n\n";
    let text = format!("{head}{body}");
    let done = compensate("radius: 5, tolerance: 0.005", &text).unwrap();
    assert!(done.gouge() <= 0.0052 && done.gap() <= 0.0052, "{} {}", done.gouge(), done.gap());
    let arcs: Vec<f64> = done
        .program
        .motions()
        .filter_map(|motion| match motion.path {
            MotionPath::Arc(arc) => Some(arc.radius),
            _ => None,
        })
        .collect();
    assert!(arcs.iter().any(|radius| (radius - 7.0).abs() < 1e-3), "{}", done.text);
    assert_eq!(done.text.matches("INDIRV").count(), arcs.len());
    assert_eq!(done.text.matches("AUTOPS").count(), arcs.len() + 1, "the old one stays");
}

#[test]
fn what_a_person_reads() {
    let text = operation(&[
        in_plane(&[(0.0, 0.0), (20.0, 15.0), (40.0, 0.0)], [0.0, 0.0], 0.0),
        in_plane(&[(40.0, 15.0), (20.0, 0.0), (0.0, 15.0)], [0.0, 0.5], 0.0),
    ]);
    let done = compensate("radius: 5, tolerance: 0.05", &text).unwrap();
    let mut shown = Vec::new();
    clsmith::report::unified_diff::write_unified_diff(&mut shown, &done.program, &Default::default())
        .unwrap();
    let mut shown = String::from_utf8(shown).unwrap();
    shown.push_str(&clsmith::transform::TransformReport::to_text(&done.report, Default::default()));
    for found in &done.findings {
        shown.push_str(&format!("\n{}: {}\n", found.code, found.message));
    }
    support::rounded_snapshots("compensate_z").bind(|| insta::assert_snapshot!("two-passes", shown));
}
