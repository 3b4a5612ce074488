//! Points with their own normals.

use super::compensate;
use nalgebra::{Point3, Vector3};
use std::fmt::Write;

const AXIS: [f64; 3] = [0.0, 0.0, 1.0];

/// A program of nine-value GOTOs.
fn with_normals(contacts: &[([f64; 3], [f64; 3], [f64; 3])]) -> String {
    let mut text = String::from(
        "PARTNO/1\nUNIT/MM\nCUTTER/10.,5.,0.,0.,0.,0.,50.\nLOAD/TOOL,1\nRAPID/\nGOTO/0,0,80.,0,0,1.\nFEDRAT/500.,MMPM\n",
    );
    for (point, axis, normal) in contacts {
        let numbers: Vec<String> =
            point.iter().chain(axis).chain(normal).map(|n| format!("{n:.6}")).collect();
        let _ = writeln!(text, "GOTO/{}", numbers.join(","));
    }
    text.push_str("RAPID/\nGOTO/0,0,80.,0,0,1.\nFINI\n");
    text
}

fn sphere(radius: f64, hollow: bool, tilt: bool) -> Vec<([f64; 3], [f64; 3], [f64; 3])> {
    (-20..=20)
        .map(|step| {
            let angle = f64::from(step) * 0.03;
            let out = Vector3::new(angle.sin(), 0.0, angle.cos());
            let (point, normal) = if hollow {
                (Vector3::new(out.x, 0.0, -out.z) * radius, Vector3::new(-out.x, 0.0, out.z))
            } else {
                (out * radius, out)
            };
            let axis = if tilt { Vector3::new(0.0, (0.2f64).sin(), (0.2f64).cos()).into() } else { AXIS };
            (point.into(), axis, normal.into())
        })
        .collect()
}

#[test]
fn a_ball_rolls_over_a_sphere() {
    for tilt in [false, true] {
        let contacts = sphere(30.0, false, tilt);
        let done = compensate("radius: 5, against: normals", &with_normals(&contacts)).unwrap();
        assert!(done.findings.iter().all(|found| !found.is_error()), "{:?}", done.findings);
        let tips: Vec<Point3<f64>> = done
            .program
            .motions()
            .filter(|motion| motion.normal.is_some())
            .map(|motion| motion.to.point)
            .collect();
        assert_eq!(tips.len(), contacts.len());
        for (tip, (_, axis, _)) in tips.iter().zip(&contacts) {
            // The centre of the ball is on a sphere of R + r.
            let centre = tip.coords + Vector3::from(*axis) * 5.0;
            assert!((centre.norm() - 35.0).abs() < 2e-4, "{}", centre.norm());
        }
    }
}

#[test]
fn a_hollow_tighter_than_the_ball_is_an_error_with_the_depth() {
    let text = with_normals(&sphere(4.0, true, false));
    let done = compensate("radius: 5, against: normals", &text).unwrap();
    let found: Vec<_> = done.findings.iter().filter(|found| found.code.id() == "CL0331").collect();
    assert!(!found.is_empty() && found[0].is_error());
    assert!(found[0].labels.len() >= 2, "both points are shown");
    let wide = compensate("radius: 5, against: normals", &with_normals(&sphere(9.0, true, false))).unwrap();
    assert!(wide.findings.iter().all(|found| found.code.id() != "CL0331"));
}

#[test]
fn a_point_without_normal_is_asked_for() {
    let text = with_normals(&sphere(30.0, false, false))
        .replace("RAPID/\nGOTO/0,0,80.,0,0,1.\nFINI", "GOTO/1.,0,30.,0,0,1.\nFINI");
    let found = compensate("radius: 5, against: normals", &text).err().unwrap();
    assert_eq!(found.last().unwrap().code.id(), "CL0302");
    assert!(found.last().unwrap().message.contains("no contact normal"));
}

#[test]
fn a_normal_into_the_part_is_refused() {
    let down: Vec<_> = (0..5).map(|step| ([f64::from(step), 0.0, 0.0], AXIS, [0.0, 0.0, -1.0])).collect();
    let found = compensate("radius: 5, against: normals", &with_normals(&down)).err().unwrap();
    assert!(found.last().unwrap().message.contains("into the part"));
}
