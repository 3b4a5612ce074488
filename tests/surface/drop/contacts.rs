//! Planes, balls, saddles, walls and slivers, in closed form.

use super::super::solids::{cube, mesh, sphere, terrain};
use super::{cutters, over, tip};
use clsmith::internals::surface::drop_cutter::{DropCutter, DropCutterShape};
use clsmith::stock::Mesh;

fn near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected}");
}

#[test]
fn planes_level_and_tilted() {
    for cutter in cutters() {
        for [a, b] in [[0.0, 0.0], [0.3, -0.2], [-1.4, 0.9], [0.0, 3.0]] {
            let drop = over(&terrain(40.0, 7, |x, y| 2.0 + a * x + b * y), cutter);
            let steep = f64::hypot(a, b);
            let above =
                steep * cutter.flat_radius_mm() + cutter.corner_radius_mm() * (steep.hypot(1.0) - 1.0);
            for (x, y) in [(0.0, 0.0), (1.3, -4.1), (-10.0, 9.0), (17.123, 3.3)] {
                let found = drop.drop_at(x, y).unwrap();
                near(found.tip_z_mm, 2.0 + a * x + b * y + above, 1e-5);
                // A flat end's touch is 1e-6 inside its radius, which a slope makes as much higher.
                if cutter.corner_radius_mm() > 0.0 {
                    near(found.tip_z_mm, 2.0 + a * x + b * y + above, 1e-9);
                }
                let length = steep.hypot(1.0);
                for (n, expected) in found.normal.into_iter().zip([-a / length, -b / length, 1.0 / length]) {
                    near(n, expected, 1e-9);
                }
                let [cx, cy, cz] = found.contact_mm;
                near(cz, 2.0 + a * cx + b * cy, 1e-9);
            }
        }
    }
}

#[test]
fn a_ball_on_a_ball_is_as_near_as_facets_are() {
    let (fineness, large) = (60_u32, 20.0);
    let ball = DropCutterShape::ball(10.0).unwrap();
    let drop = over(&sphere(large, fineness as usize), ball);
    // Facets are nowhere farther inside than the sagitta of their diagonals.
    let sagitta = large * (1.0 - (std::f64::consts::PI / f64::from(fineness) / f64::sqrt(2.0)).cos());
    for i in 0..200 {
        let (angle, r) = (f64::from(i), f64::from(i) * 0.09);
        let found = drop.drop_at(r * angle.cos(), r * angle.sin()).unwrap();
        let exact = ((large + 5.0_f64).powi(2) - r * r).sqrt() - 5.0;
        let upright = (exact + 5.0) / (large + 5.0);
        assert!(found.tip_z_mm <= exact + 1e-9, "{} > {exact}", found.tip_z_mm);
        assert!(found.tip_z_mm >= exact - 1.05 * sagitta / upright, "{} < {exact}", found.tip_z_mm);
        // The contact is a radius away from the ball's centre along the normal.
        let [x, y, z] = [0, 1, 2].map(|axis| found.contact_mm[axis] + 5.0 * found.normal[axis]);
        near(x, r * angle.cos(), 1e-9);
        near(y, r * angle.sin(), 1e-9);
        near(z, found.tip_z_mm + 5.0, 1e-9);
    }
    assert_eq!(drop.drop_at(25.0, 0.0), None);
    assert_eq!(drop.drop_at(0.0, f64::NAN), None);
    assert_eq!(drop.drop_at(f64::INFINITY, 0.0), None);
}

#[test]
fn a_saddle_moves_the_tip_no_more_than_its_facets_are_off() {
    // Less curved than any of the cutters, so each touches in one place: take the place, and find where the cutter stands.
    let bend = 0.02;
    let solid = terrain(30.0, 120, |x, y| bend * x * y);
    let off = bend * 0.5 * 0.5 / 4.0;
    for cutter in [DropCutterShape::ball(10.0).unwrap(), DropCutterShape::new(10.0, 2.0).unwrap()] {
        let drop = over(&solid, cutter);
        for (x, y) in [(3.0, 4.0), (-10.2, 7.7), (0.1, -12.0), (14.0, 14.0)] {
            let (a, b) = (bend * y, bend * x);
            let (steep, length) = (f64::hypot(a, b), f64::hypot(1.0, f64::hypot(a, b)));
            // A flat bottom hangs over the saddle when it is level: only where it is steep enough is the touch at the corner's circle.
            let far = cutter.flat_radius_mm() + cutter.corner_radius_mm() * steep / length;
            let place = [x - far * a / steep, y - far * b / steep];
            let tip_z = bend * x * y - cutter.corner_radius_mm() * (1.0 - 1.0 / length);
            let found = tip(&drop, place[0], place[1]);
            assert!(found >= tip_z - off - 1e-9, "{found} {tip_z}");
            if cutter.flat_radius_mm() == 0.0 {
                near(found, tip_z, off);
            }
        }
    }
}

#[test]
fn walls_touched_from_the_side_are_not_under_the_cutter() {
    let solid = cube([-10.0, -10.0, -5.0], [10.0, 10.0, 2.0]);
    for cutter in cutters() {
        let drop = over(&solid, cutter);
        for (x, y) in [(0.0, 0.0), (10.0, 0.0), (-10.0, 10.0), (9.9, -9.9)] {
            near(tip(&drop, x, y), 2.0, 1e-12);
        }
        for beside in [0.5, 2.0, 4.9, 4.99999] {
            near(tip(&drop, 10.0 + beside, 3.0), 2.0 - cutter.height_at(beside), 1e-9);
            let corner = beside / f64::sqrt(2.0);
            near(tip(&drop, 10.0 + corner, 10.0 + corner), 2.0 - cutter.height_at(beside), 1e-9);
        }
        assert_eq!(drop.drop_at(15.0, 3.0), None);
        assert_eq!(drop.drop_at(0.0, -15.0), None);
    }
}

#[test]
fn slivers_do_no_harm() {
    // A top with a corner in the middle of a side, off by a rounding, and one a hair beside a diagonal.
    for hair in [0.0, 1e-15, 1e-12, 1e-9, 1e-6] {
        let [a, b, c, d] = [[-9.0, -9.0, 1.0], [9.0, -9.0, 1.0], [9.0, 9.0, 1.0], [-9.0, 9.0, 1.0]];
        let [m, n] = [[0.7, -9.0 + hair, 1.0], [0.3, 0.3 + hair, 1.0]];
        let low = [0.0, 0.0, -9.0];
        let top = [[a, b, m], [a, m, n], [a, n, d], [n, c, d], [n, m, c], [m, b, c]];
        let mut solid = Vec::from(top);
        solid.extend([[b, a, low], [c, b, low], [d, c, low], [a, d, low]]);
        for cutter in cutters() {
            let drop = over(&solid, cutter);
            for (x, y) in [(0.0, 0.0), (0.7, -9.0), (0.3, 0.3), (-4.0, -4.0), (5.0, 5.0)] {
                near(tip(&drop, x, y), 1.0, 1e-9);
            }
        }
    }
}

#[test]
fn nearly_upright_walls_hold_the_cutter() {
    for lean in [1e-3, 1e-6, 1e-8] {
        let corners = cube([-10.0, -10.0, -5.0], [10.0, 10.0, 2.0]);
        // The wall at +x leans outwards at the bottom.
        let leaning = |[x, y, z]: [f64; 3]| [if x > 0.0 && z < 0.0 { x + lean } else { x }, y, z];
        let solid = corners.into_iter().map(|triangle| triangle.map(leaning)).collect();
        let ball = DropCutterShape::ball(2.0).unwrap();
        let drop = over(&solid, ball);
        // Between the wall's upper and lower end: at a height where the wall is a radius away.
        let found = tip(&drop, 11.0 - 2e-6 + lean / 2.0, 0.0);
        assert!((-6.0..=2.0).contains(&found), "{found}");
        if lean > 1e-5 {
            // The wall's normal leans as well, by far less than this.
            let z = 2.0 - 7.0 * (lean / 2.0 - 2e-6) / lean - 1.0;
            near(found, z, 0.02);
        }
    }
}

#[test]
fn more_material_never_lowers_and_sides_do_not_matter() {
    let hill = terrain(20.0, 12, |x, y| (x / 5.0).sin() + (y / 4.0).cos());
    let post = cube([2.0, 3.0, -3.0], [4.0, 5.0, 2.5]);
    let mut both = hill.clone();
    both.extend(post);
    for cutter in cutters() {
        let [alone, joined] = [&hill, &both].map(|solid| DropCutter::new(&mesh(solid), cutter));
        let inside_out: Mesh = mesh(&hill.iter().map(|[a, b, c]| [*a, *c, *b]).collect());
        let inside_out = DropCutter::new(&inside_out, cutter);
        for i in 0..400 {
            let [x, y] = [0.61803, 0.41421].map(|step| 50.0 * (f64::from(i) * step).fract() - 25.0);
            let [a, b] = [&alone, &joined].map(|drop| drop.drop_at(x, y).map(|drop| drop.tip_z_mm));
            assert!(b.is_some() >= a.is_some() && b.unwrap_or(0.0) >= a.unwrap_or(-99.0) - 1e-12, "{x} {y}");
            let turned = inside_out.drop_at(x, y).map(|drop| drop.tip_z_mm);
            assert_eq!(a.is_some(), turned.is_some());
            near(a.unwrap_or(0.0), turned.unwrap_or(0.0), 1e-12);
        }
    }
}
