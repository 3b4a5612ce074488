//! Pillars under the middle of a cutter: a thousand bad ramps before and after, on the stock.

use super::ramp;
use clsmith::cutter::{CutterModel, DeadMiddle, Meridian};
use clsmith::engagement::{PathPiece, Simulation};
use clsmith::internals::transform::correct_ramp::ramp::Ramp;
use clsmith::internals::transform::correct_ramp::ramp_limits::{IndexableCutter, is_within_limits};
use clsmith::internals::transform::correct_ramp::ramp_pillar::{PillarSearch, find_pillar};
use clsmith::internals::transform::correct_ramp::tool_region::ToolRegion;
use clsmith::internals::transform::correct_ramp::{RampTask, correct_ramp};
use clsmith::program::geometry::Pose;
use clsmith::stock::{SolidBody, Stock};
use nalgebra::{Point2, Point3, Rotation2, Vector2, Vector3};

const CUTTER: IndexableCutter = IndexableCutter { diameter: 50.0, insert_radius: 6.0, insert_height: 5.0 };

/// Numbers that are the same in every run: Knuth's MMIX generator.
struct Numbers(u64);

impl Numbers {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The volumes that the body of the cutter is pushed into on the steps of its way down a ramp through a block, with columns of its own.
fn pillar_mm3(ramp: &Ramp) -> f64 {
    let points: Vec<Point3<f64>> = ramp
        .steps_with_starts()
        .flat_map(|(from, step)| {
            let places = step.sample_points_across(from);
            let count = places.len() as f64;
            let z = move |index: usize| from.z + (step.to.z - from.z) * (index + 1) as f64 / count;
            places.into_iter().enumerate().map(move |(index, at)| Point3::new(at.x, at.y, z(index)))
        })
        .collect();
    let points: Vec<Point3<f64>> = std::iter::once(ramp.start).chain(points).collect();
    let far =
        |axis: usize, of: fn(f64, f64) -> f64| points.iter().map(|point| point[axis]).reduce(of).unwrap();
    let (low, high) = ([0, 1, 2].map(|axis| far(axis, f64::min)), [0, 1, 2].map(|axis| far(axis, f64::max)));
    let from = [low[0] - 26.0, low[1] - 26.0, low[2] - 2.0];
    let block = SolidBody::Block { from, to: [high[0] + 26.0, high[1] + 26.0, high[2]] };
    let stock = Stock::new(vec![block], 0.0).unwrap().to_dexels(1.3, 100_000_000).unwrap();
    let middle = DeadMiddle { radius_mm: 19.0, clearance_mm: 5.0 };
    let profile = Meridian::new(50.0, 6.0, 0.0, 0.0, 200.0).unwrap().with_dead_middle(middle);
    let cutter = CutterModel { profile, collars: Vec::new(), teeth: None };
    let pose = |point: Point3<f64>| Pose { point, axis: Vector3::z() };
    let pieces: Vec<PathPiece> = points
        .windows(2)
        .map(|pair| PathPiece { from: pose(pair[0]), to: pose(pair[1]), cutter: 0 })
        .collect();
    let engaged = Simulation::new(stock, false).sweep_pieces(&pieces, &[cutter]);
    engaged.iter().filter_map(|found| found.pillar).map(|pillar| pillar.volume_mm3).sum()
}

/// A ramp to and fro, around, or of few legs in any direction.
fn any_ramp(numbers: &mut Numbers) -> Ramp {
    let height = numbers.between(6.0, 25.0);
    let count = 2 + numbers.between(0.0, 4.0) as usize;
    let mut at = Point2::new(0.0, 0.0);
    let mut heading = Vector2::new(numbers.between(10.0, 70.0), 0.0);
    let mut points = vec![[0.0, 0.0, height]];
    for leg in 1..=count {
        at += heading;
        points.push([at.x, at.y, height * (1.0 - leg as f64 / count as f64)]);
        let turn = if numbers.between(0.0, 1.0) < 0.5 { 180.0 } else { numbers.between(60.0, 300.0) };
        heading = Rotation2::new(f64::to_radians(turn)) * heading * numbers.between(0.6, 1.4);
    }
    ramp(&points)
}

#[test]
fn a_thousand_bad_ramps_have_pillars_before_and_none_after() {
    let mut numbers = Numbers(19);
    let limits = CUTTER.ramp_limits().unwrap().halved_for_turns();
    let (mut bad, mut of_paper) = (0, 0);
    while bad < 1000 {
        let before = any_ramp(&mut numbers);
        if pillar_mm3(&before) <= 0.0 {
            continue;
        }
        bad += 1;
        of_paper += usize::from(is_within_limits(&before, &CUTTER.ramp_limits().unwrap(), 0.0));
        let task = RampTask {
            limits,
            begin: None,
            region: &ToolRegion::Everywhere,
            passes: &[Vector2::x()],
            rounding: 0.0,
        };
        let after =
            correct_ramp(&before, &task).unwrap().expect("a ramp with a pillar is beyond these limits").ramp;
        assert_eq!(pillar_mm3(&after), 0.0, "{before:?}\nbecame {after:?}");
        assert!(find_pillar(&after, &CUTTER, PillarSearch::AtColumns).is_none());
    }
    assert!(of_paper > 10, "some of them keep the limit of the paper: {of_paper}");
}

#[test]
fn what_is_found_between_columns_is_never_less() {
    let mut numbers = Numbers(5);
    for _ in 0..100 {
        let ramp = any_ramp(&mut numbers);
        let [at, between] = [PillarSearch::AtColumns, PillarSearch::BetweenColumns]
            .map(|search| find_pillar(&ramp, &CUTTER, search).is_some());
        assert!(between || !at);
        assert!(
            between || pillar_mm3(&ramp) <= 0.0,
            "what is cleared is cleared on other columns, too: {ramp:?}"
        );
    }
}
