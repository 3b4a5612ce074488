//! Values that are known in closed form, and properties that hold for any program.

use super::mills::mill;
use clsmith::certified_engagement::*;
use clsmith::cutter::Meridian;
use nalgebra::Vector3;

fn block(low: [f64; 3], high: [f64; 3]) -> Vec<Box<dyn StockGap>> {
    vec![Box::new(BoxGap::new(Vector3::from(low), Vector3::from(high)))]
}

fn upright(x: f64, y: f64, z: f64) -> CutterPose {
    CutterPose { tip: Vector3::new(x, y, z), axis: Vector3::z() }
}

fn program(stock: Vec<Box<dyn StockGap>>, cutter: CutterContour, poses: &[CutterPose]) -> CertifiedProgram {
    let mut program = CertifiedProgram::new(stock, vec![cutter], StepLimits::default()).unwrap();
    for pair in poses.windows(2) {
        let motion = BlockMotion { from: pair[0], to: pair[1], arc: None, cutter: 0 };
        program.push_block(&motion).unwrap();
    }
    program
}

fn share(program: &CertifiedProgram, block: usize) -> CertifiedEngagement {
    let options = EngagementOptions::default();
    program.certify_block(block, EngagementCriterion::Share, &options, &mut WarmStart::default())
}

fn chip(program: &CertifiedProgram, block: usize, fz: f64) -> CertifiedEngagement {
    let criterion = EngagementCriterion::Chip { feed_per_tooth_mm: fz };
    program.certify_block(block, criterion, &EngagementOptions::default(), &mut WarmStart::default())
}

fn assert_holds(found: &CertifiedEngagement, value: f64) {
    let slack = 1e-6 + value * 1e-6;
    assert!(found.lower <= value + slack && value - slack <= found.upper, "{value} not in {found:?}");
    assert!(found.upper <= found.lower * 1.02 + 1e-9, "too wide: {found:?}");
}

#[test]
fn side_milling_has_the_classic_share() {
    for depth in [0.02, 0.3, 2.0, 4.9] {
        let stock = block([-20.0, -20.0, -8.0], [20.0, depth, 0.0]);
        let cutter = mill(10.0, 0.0, 0.0, 0.0, 30.0);
        let found = share(&program(stock, cutter, &[upright(-40.0, 5.0, -3.0), upright(40.0, 5.0, -3.0)]), 0);
        assert_holds(&found, 2.0 * (depth / 10.0 * (1.0 - depth / 10.0)).sqrt());
    }
}

#[test]
fn a_slot_a_plunge_and_a_ramp_have_their_shares() {
    let cutter = mill(10.0, 0.0, 0.0, 0.0, 30.0);
    let stock = || block([-20.0, -20.0, -8.0], [20.0, 20.0, 0.0]);
    let slot = program(stock(), cutter.clone(), &[upright(-40.0, 0.0, -3.0), upright(0.0, 0.0, -3.0)]);
    assert_holds(&share(&slot, 0), 1.0);
    assert_holds(&chip(&slot, 0, 0.1), 0.1);
    let plunge = program(stock(), cutter.clone(), &[upright(0.0, 0.0, 5.0), upright(0.0, 0.0, -2.0)]);
    assert_holds(&share(&plunge, 0), 1.0);
    let ramp = program(stock(), cutter, &[upright(-10.0, 0.0, 1.0), upright(10.0, 0.0, -2.0)]);
    assert_holds(&share(&ramp, 0), 20.0 / 20.0_f64.hypot(3.0));
}

#[test]
fn a_ball_on_a_floor_has_the_share_of_its_depth() {
    // The highest engaged point has the normal's angle k with R (1 - cos k) = depth.
    let stock = block([-20.0, -20.0, -8.0], [20.0, 20.0, 0.0]);
    let cutter = mill(8.0, 4.0, 0.0, 0.0, 30.0);
    let found = share(&program(stock, cutter, &[upright(-40.0, 0.0, -0.5), upright(0.0, 0.0, -0.5)]), 0);
    assert_holds(&found, (1.0 - (1.0_f64 - 0.5 / 4.0).powi(2)).sqrt());
}

#[test]
fn a_ridge_between_two_passes_has_the_share_of_their_distance() {
    for (a, radius) in [(1.0, 5.0), (0.4, 3.0)] {
        let stock = block([-4.0, -14.0, -6.0], [4.0, 14.0, 2.0]);
        let cutter = mill(2.0 * radius, radius, 0.0, 0.0, 40.0);
        let poses = [
            upright(-20.0, -a, 0.0),
            upright(20.0, -a, 0.0),
            upright(20.0, a, 0.0),
            upright(-20.0, a, 0.0),
            upright(-20.0, 0.0, 0.0),
            upright(20.0, 0.0, 0.0),
        ];
        assert_holds(&share(&program(stock, cutter, &poses), 4), a / radius);
    }
}

#[test]
fn a_repeated_program_cuts_nothing() {
    for (corner, taper, tip) in
        [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (4.0, 0.0, 0.0), (1.0, 0.2, 0.0), (0.5, 0.0, 0.4)]
    {
        let stock = block([-20.0, -20.0, -8.0], [20.0, 20.0, 0.0]);
        let cutter = mill(8.0, corner, taper, tip, 30.0);
        let path = [
            upright(-30.0, 0.0, -2.0),
            upright(0.0, 0.0, -2.0),
            upright(5.0, 3.0, -2.0),
            upright(8.0, -7.0, -3.0),
            upright(-30.0, 0.0, 20.0),
        ];
        let twice: Vec<CutterPose> = path.iter().chain(&path).copied().collect();
        let program = program(stock, cutter, &twice);
        for block in 5..9 {
            let (share, chip) = (share(&program, block), chip(&program, block, 0.1));
            assert_eq!((share.upper, chip.upper), (0.0, 0.0), "{corner} {taper} {tip} block {block}");
        }
    }
}

#[test]
fn a_disc_that_tips_has_the_share_of_its_heel() {
    let (angle, way) = (2.0_f64.to_radians(), 0.8);
    let stock = block([-9.0, -9.0, -3.0], [9.0, 9.0, -0.1]);
    let cutter = mill(12.0, 0.0, 0.0, 0.0, 60.0);
    let to =
        CutterPose { tip: Vector3::new(way, 0.0, 0.0), axis: Vector3::new(-angle.sin(), 0.0, angle.cos()) };
    let program = program(stock, cutter, &[upright(0.0, 0.0, 25.0), upright(0.0, 0.0, 0.0), to]);
    assert_holds(&share(&program, 1), 6.0 * angle / way + angle.sin());
}

#[test]
fn a_thin_sheet_limits_the_chip_of_a_tilted_rim() {
    let tilt = 25.0_f64.to_radians();
    let axis = Vector3::new(tilt.sin(), 0.0, tilt.cos());
    let pose = |x, z| CutterPose { tip: Vector3::new(x, 0.0, z), axis };
    let top = -5.0 * tilt.sin() + 0.08;
    let stock = block([-10.0, -10.0, -5.0], [10.0, 10.0, top]);
    let cutter = mill(10.0, 0.0, 0.0, 0.0, 60.0);
    let program = program(stock, cutter, &[pose(-0.5, 0.25), pose(0.0, 0.0)]);
    assert_holds(&chip(&program, 0, 0.4), 0.08 / tilt.sin());
}

#[test]
fn an_arc_and_its_chords_agree() {
    let stock = || block([-20.0, -20.0, -8.0], [20.0, 20.0, 0.0]);
    let cutter = || mill(8.0, 1.0, 0.0, 0.0, 30.0);
    let at = |angle: f64, radius: f64| upright(radius * angle.cos(), radius * angle.sin(), -2.0);
    let mut whole = CertifiedProgram::new(stock(), vec![cutter()], StepLimits::default()).unwrap();
    for radius in [10.0, 8.5] {
        let arc = Some(TipArc { center: Vector3::new(0.0, 0.0, -2.0), normal: Vector3::z(), angle: 2.0 });
        let motion = BlockMotion { from: at(0.0, radius), to: at(2.0, radius), arc, cutter: 0 };
        whole.push_block(&motion).unwrap();
    }
    let poses: Vec<CutterPose> = [10.0, 8.5]
        .into_iter()
        .flat_map(|radius| (0..=200).map(move |step| at(f64::from(step) / 100.0, radius)))
        .collect();
    let chords = program(stock(), cutter(), &poses);
    let arc = share(&whole, 1);
    let largest = (210..400).map(|block| share(&chords, block).upper).fold(0.0, f64::max);
    assert!(arc.is_within_tolerance, "{arc:?}");
    assert!(arc.lower <= largest * 1.01, "{arc:?} {largest}");
}

#[test]
fn a_repeated_arc_cuts_nothing_in_either_sense() {
    for sense in [1.0, -1.0] {
        let stock = block([-20.0, -20.0, -8.0], [20.0, 20.0, 0.0]);
        let cutter = mill(8.0, 2.0, 0.0, 0.0, 30.0);
        let mut program = CertifiedProgram::new(stock, vec![cutter], StepLimits::default()).unwrap();
        let at = |angle: f64| upright(9.0 * angle.cos(), 9.0 * angle.sin(), -2.0);
        for (from, to) in [(0.0, 2.5), if sense > 0.0 { (0.0, 2.5) } else { (2.5, 0.0) }] {
            let arc =
                Some(TipArc { center: Vector3::new(0.0, 0.0, -2.0), normal: Vector3::z(), angle: to - from });
            program.push_block(&BlockMotion { from: at(from), to: at(to), arc, cutter: 0 }).unwrap();
        }
        let (cut, again) = (share(&program, 0), share(&program, 1));
        assert!(cut.lower > 0.99 && again.upper == 0.0, "{sense}: {cut:?} {again:?}");
    }
}

#[test]
fn another_tool_leaves_its_own_shape() {
    let stock = block([-20.0, -20.0, -8.0], [20.0, 20.0, 0.0]);
    let small = mill(6.0, 0.0, 0.0, 0.0, 30.0);
    let large = mill(6.4, 0.0, 0.0, 0.0, 30.0);
    let mut program = CertifiedProgram::new(stock, vec![small, large], StepLimits::default()).unwrap();
    for cutter in [0, 1] {
        let (from, to) = (upright(-40.0, 0.0, -2.0), upright(40.0, 0.0, -2.0));
        program.push_block(&BlockMotion { from, to, arc: None, cutter }).unwrap();
    }
    // 0.2 mm are left on both walls: the point where they begin has the direction acos(3 / 3.2) from the
    // side.
    assert_holds(&share(&program, 1), (1.0 - (3.0_f64 / 3.2).powi(2)).sqrt());
}

#[test]
fn a_small_budget_gives_a_wider_interval_that_holds() {
    let stock = block([-20.0, -20.0, -8.0], [20.0, 0.3, 0.0]);
    let cutter = mill(10.0, 0.0, 0.0, 0.0, 30.0);
    let program = program(stock, cutter, &[upright(-40.0, 5.0, -3.0), upright(40.0, 5.0, -3.0)]);
    let options = EngagementOptions { most_patches: 6, ..EngagementOptions::default() };
    let found = program.certify_block(0, EngagementCriterion::Share, &options, &mut WarmStart::default());
    let truth = 2.0 * (0.03_f64 * 0.97).sqrt();
    assert!(!found.is_within_tolerance && found.lower <= truth && truth <= found.upper, "{found:?}");
    assert!(found.upper.is_finite());
    for feed_per_tooth_mm in [f64::NAN, f64::INFINITY, -1.0] {
        let criterion = EngagementCriterion::Chip { feed_per_tooth_mm };
        let found = program.certify_block(0, criterion, &options, &mut WarmStart::default());
        assert!(!found.is_within_tolerance && found.upper == f64::INFINITY, "{found:?}");
    }
    assert_eq!(share(&program, 7).upper, f64::INFINITY);
}

#[test]
fn bad_input_is_refused() {
    let cutter = mill(10.0, 0.0, 0.0, 0.0, 30.0);
    let none = CertifiedProgram::new(Vec::new(), vec![cutter.clone()], StepLimits::default());
    assert_eq!(none.err(), Some(CertifiedProgramError::NoStock));
    let mut program =
        CertifiedProgram::new(block([0.0; 3], [1.0; 3]), vec![cutter], StepLimits::default()).unwrap();
    let mut motion =
        BlockMotion { from: upright(0.0, 0.0, 0.0), to: upright(1.0, 0.0, 0.0), arc: None, cutter: 0 };
    assert!(program.push_block(&motion).is_ok());
    motion.cutter = 3;
    assert_eq!(program.push_block(&motion), Err(CertifiedProgramError::Cutter));
    motion.cutter = 0;
    motion.to.tip.y = f64::NAN;
    assert_eq!(program.push_block(&motion), Err(CertifiedProgramError::NotFinite));
    motion.to = upright(1.0, 0.0, 0.0);
    motion.to.axis = Vector3::zeros();
    assert_eq!(program.push_block(&motion), Err(CertifiedProgramError::Axis));
    let dovetail = Meridian::dovetail(10.0, 0.0, 0.2, 0.0, 8.0).unwrap();
    assert_eq!(CutterContour::from_meridian(&dovetail), Err(CutterContourError::Undercut));
    assert_eq!(CutterContour::from_elements(Vec::new(), 8.0), Err(CutterContourError::Length));
}
