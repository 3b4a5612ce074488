//! Stock from meshes, columns and functions bounds the same engagement as stock in closed form.

use super::mills::mill;
use clsmith::certified_engagement::*;
use nalgebra::Vector3;

type Triangle = [Vector3<f64>; 3];

/// The twelve triangles of a box.
fn box_triangles(low: [f64; 3], high: [f64; 3]) -> Vec<Triangle> {
    let at = |number: usize| {
        let pick = |axis: usize| if number >> axis & 1 == 1 { high[axis] } else { low[axis] };
        Vector3::new(pick(0), pick(1), pick(2))
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().flat_map(|[a, b, c, d]| [[at(*a), at(*b), at(*c)], [at(*a), at(*c), at(*d)]]).collect()
}

/// A bar around x with so many sides, whose corners are on the radius.
fn bar_triangles(radius: f64, from: f64, to: f64, sides: u32) -> Vec<Triangle> {
    let at = |x: f64, side: u32| {
        let angle = f64::from(side % sides) / f64::from(sides) * std::f64::consts::TAU;
        Vector3::new(x, radius * angle.cos(), radius * angle.sin())
    };
    let middle = |x: f64| Vector3::new(x, 0.0, 0.0);
    let one = |side: u32| {
        [
            [at(from, side), at(to, side + 1), at(to, side)],
            [at(from, side), at(from, side + 1), at(to, side + 1)],
            [middle(to), at(to, side), at(to, side + 1)],
            [middle(from), at(from, side + 1), at(from, side)],
        ]
    };
    (0..sides).flat_map(one).collect()
}

fn random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

fn poses() -> Vec<CutterPose> {
    let tilt = Vector3::new(0.2, 0.1, 1.0).normalize();
    let upright = [
        [-30.0, 9.0, -2.0],
        [25.0, 9.0, -2.0],
        [25.0, -8.0, -3.0],
        [-20.0, -9.5, -1.0],
        [0.0, 0.0, 2.0],
        [0.0, 0.0, -1.0],
    ];
    let tilted = [[0.0, 30.0, 10.0], [0.0, 0.0, 10.0], [3.0, 4.0, -1.5]];
    let pose = |tip: [f64; 3], axis| CutterPose { tip: Vector3::from(tip), axis };
    let upright = upright.iter().map(|tip| pose(*tip, Vector3::z()));
    upright.chain(tilted.iter().map(|tip| pose(*tip, tilt))).collect()
}

/// All intervals of a small program: lines and arcs, shares and chips.
fn intervals(stock: Vec<Box<dyn StockGap>>) -> Vec<CertifiedEngagement> {
    let cutter = mill(10.0, 2.0, 0.0, 0.0, 40.0);
    let mut program = CertifiedProgram::new(stock, vec![cutter], StepLimits::default()).unwrap();
    let start = CutterPose { tip: Vector3::new(16.0, 0.0, -2.0), axis: Vector3::z() };
    for pair in poses().windows(2) {
        let (from, to) = (pair[0], pair[1]);
        if from.axis == to.axis {
            program.push_block(&BlockMotion { from, to, arc: None, cutter: 0 }).unwrap();
        }
    }
    let arc = TipArc { center: Vector3::zeros(), normal: Vector3::z(), angle: 4.0 };
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), 4.0);
    let to = CutterPose { tip: turn * start.tip, axis: Vector3::z() };
    program.push_block(&BlockMotion { from: start, to, arc: Some(arc), cutter: 0 }).unwrap();
    let chip = EngagementCriterion::Chip { feed_per_tooth_mm: 0.1 };
    let options = EngagementOptions::default();
    (0..program.block_count())
        .flat_map(|block| {
            [EngagementCriterion::Share, chip]
                .map(|criterion| program.certify_block(block, criterion, &options, &mut WarmStart::default()))
        })
        .collect()
}

/// Both programs are the same, so their intervals meet, and only some may be wide.
fn assert_alike(name: &str, exact: &[CertifiedEngagement], found: &[CertifiedEngagement], most_open: usize) {
    let mut open = 0;
    for (number, (a, b)) in exact.iter().zip(found).enumerate() {
        assert!(
            a.lower <= b.upper * 1.000_001 + 2e-6 && b.lower <= a.upper * 1.000_001 + 2e-6,
            "{name} {number}: {a:?} {b:?}"
        );
        open += usize::from(!b.is_within_tolerance);
    }
    assert!(open <= most_open, "{name}: {open} open");
}

#[test]
fn gaps_agree_with_a_box() {
    let (low, high) = ([-12.0, -10.0, -8.0], [12.0, 10.0, 0.5]);
    let mesh = MeshGap::new(&box_triangles(low, high)).unwrap();
    let columns =
        ColumnGap::new([-12.0, -10.0], 0.5, 48, vec![vec![[-8.0, -3.0], [-3.0, 0.5]]; 48 * 40]).unwrap();
    let mut state = 5;
    for _ in 0..3000 {
        let point = Vector3::from_fn(|_, _| random(&mut state) * 40.0 - 20.0);
        let (a, b) = (Vector3::from(low) - point, point - Vector3::from(high));
        let beyond = a.sup(&b);
        let truth = if beyond.max() > 0.0 { beyond.sup(&Vector3::zeros()).norm() } else { beyond.max() };
        assert!((mesh.gap(&point) - truth).abs() < 1e-9, "{point:?} {} {truth}", mesh.gap(&point));
        let found = columns.gap(&point);
        assert!(found <= truth + 1e-9 && (found - truth).abs() < 12.0, "{point:?} {found} {truth}");
        if truth < 2.0 {
            assert!((found - truth).abs() < 1e-9, "{point:?} {found} {truth}");
        }
    }
}

#[test]
fn a_mesh_of_a_box_bounds_what_the_box_does() {
    let (low, high) = ([-12.0, -10.0, -8.0], [12.0, 10.0, 0.5]);
    let exact = intervals(vec![Box::new(BoxGap::new(Vector3::from(low), Vector3::from(high)))]);
    let mesh = intervals(vec![Box::new(MeshGap::new(&box_triangles(low, high)).unwrap())]);
    assert_alike("mesh", &exact, &mesh, 0);
}

#[test]
fn columns_of_a_box_bound_what_the_box_does() {
    let (low, high) = ([-12.0, -10.0, -8.0], [12.0, 10.0, 0.5]);
    let exact = intervals(vec![Box::new(BoxGap::new(Vector3::from(low), Vector3::from(high)))]);
    let columns = ColumnGap::new([-12.0, -10.0], 0.5, 48, vec![vec![[-8.0, 0.5]]; 48 * 40]).unwrap();
    assert_alike("columns", &exact, &intervals(vec![Box::new(columns)]), 6);
}

#[test]
fn a_function_bounds_what_its_body_does() {
    let (from, to) = (Vector3::new(-15.0, 0.0, -6.0), Vector3::new(15.0, 0.0, -6.0));
    let bar = CylinderGap::new(8.0, from, to).unwrap();
    let (own, bounds) = (bar.clone(), bar.bounds());
    let exact = intervals(vec![Box::new(bar)]);
    let function = FunctionGap::new(move |point: &Vector3<f64>| own.gap(point), bounds);
    assert_alike("function", &exact, &intervals(vec![Box::new(function)]), 6);
}

#[test]
fn a_mesh_of_many_faces_bounds_what_the_bar_does() {
    let (from, to) = (Vector3::new(-15.0, 0.0, 0.0), Vector3::new(15.0, 0.0, 0.0));
    let exact = intervals(vec![Box::new(CylinderGap::new(8.0, from, to).unwrap())]);
    // The corners are on the bar, so the faces are 8 (1 - cos(pi / 1500)) = 2e-5 mm inside.
    let mesh = MeshGap::new(&bar_triangles(8.0, -15.0, 15.0, 1500)).unwrap();
    let found = intervals(vec![Box::new(mesh)]);
    for (a, b) in exact.iter().zip(&found) {
        assert!(b.lower <= a.upper * 1.001 + 1e-5 && a.lower <= b.upper * 1.02 + 1e-3, "{a:?} {b:?}");
    }
    let open = found.iter().filter(|found| !found.is_within_tolerance).count();
    assert!(open <= 4, "{open} open");
}

#[test]
fn triangles_that_bound_nothing_are_refused() {
    let mut triangles = box_triangles([0.0; 3], [1.0; 3]);
    assert_eq!(MeshGap::new(&[]).err(), Some(MeshGapError::Empty));
    let turned: Vec<Triangle> = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    assert_eq!(MeshGap::new(&turned).err(), Some(MeshGapError::TurnedInwards));
    assert_eq!(MeshGap::new(&triangles[1..]).err(), Some(MeshGapError::NotClosed));
    triangles[0][0].x = f64::NAN;
    assert_eq!(MeshGap::new(&triangles).err(), Some(MeshGapError::NotFinite));
    assert!(ColumnGap::new([0.0; 2], 1.0, 0, Vec::new()).is_none());
    assert!(ColumnGap::new([0.0; 2], 1.0, 2, vec![Vec::new(); 2]).is_none());
}
