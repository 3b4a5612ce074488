//! What holds for every ramp.

use super::Turns;
use clsmith::internals::transform::correct_ramp::ramp::{Ramp, RampArc, RampStep};
use clsmith::internals::transform::correct_ramp::ramp_kind::RampKind;
use clsmith::internals::transform::correct_ramp::ramp_limits::{RampLimits, is_within_limits};
use clsmith::internals::transform::correct_ramp::tool_region::ToolRegion;
use clsmith::internals::transform::correct_ramp::{
    ImpossibleCorrection, LengtheningMethod, RampTask, correct_ramp,
};
use nalgebra::{Point2, Point3, Rotation2, Vector2};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn place(reach: f64) -> impl Strategy<Value = Point2<f64>> {
    (-reach..reach, -reach..reach).prop_map(|(x, y)| Point2::new(x, y))
}

/// Legs in every direction, some level, some straight down.
fn zigzag() -> impl Strategy<Value = Ramp> {
    let fall = prop_oneof![1 => Just(0.0), 4 => 0.01..2.0f64, 1 => 2.0..9.0f64];
    let leg = (prop_oneof![9 => place(20.0), 1 => Just(Point2::origin())], fall);
    (prop::collection::vec(leg, 2..9), any::<bool>(), prop_oneof![Just(1.0), 0.01..3.0f64]).prop_map(
        |(legs, closed, scale)| {
            let mut z = 0.0;
            let mut points: Vec<Point3<f64>> = Vec::new();
            for (at, fall) in &legs {
                points.push(Point3::new(at.x * scale, at.y * scale, z));
                z -= fall;
            }
            let last =
                if closed { points[0].xy() } else { (legs[0].0 + (legs[1].0 - legs[0].0) * 0.3) * scale };
            points.push(Point3::new(last.x, last.y, z));
            Ramp::from_points(&points).unwrap()
        },
    )
}

fn helix() -> impl Strategy<Value = Ramp> {
    let shape = (0.3..15.0f64, 0.76..4.0f64, 0.2..20.0f64, 8..40usize);
    (place(20.0), shape, any::<bool>(), any::<bool>(), any::<bool>()).prop_map(
        |(centre, (radius, turns, height, per_turn), whole, clockwise, arcs)| {
            let turns = if whole { turns.ceil() } else { turns };
            let steps = (turns * per_turn as f64).ceil() as usize;
            let turns = if clockwise { -turns } else { turns };
            Turns { centre: centre.into(), radius, turns, height, steps, arcs }.ramp()
        },
    )
}

/// Lines and arcs.
fn along_shape() -> impl Strategy<Value = Ramp> {
    let step = (place(15.0), prop::option::of(-3.0..3.0f64), 0.01..3.0f64);
    (place(20.0), prop::collection::vec(step, 1..7)).prop_map(|(start, shape)| {
        let mut at = Point3::new(start.x, start.y, 0.0);
        let start = at;
        let steps = shape.into_iter().map(|(place, sweep, fall)| {
            let (across, bend) = match sweep {
                None => (place, None),
                Some(sweep) => (
                    place + Rotation2::new(sweep) * (at.xy() - place),
                    Some(RampArc { centre: place, sweep }),
                ),
            };
            at = Point3::new(across.x, across.y, at.z - fall);
            RampStep { to: at, bend }
        });
        Ramp { steps: steps.collect(), start }
    })
}

fn any_ramp() -> impl Strategy<Value = Ramp> {
    prop_oneof![4 => zigzag(), 3 => helix(), 1 => along_shape()]
}

/// A region as its corners; none for everywhere.
fn any_region(ramp: &Ramp, extra: &[Point2<f64>], kind: u8) -> Option<Vec<Point2<f64>>> {
    let own = way(ramp);
    match kind {
        0 => None,
        1 => Some(hull(own)),
        2 => Some(hull(own.into_iter().chain(extra.iter().copied()).collect())),
        _ => {
            // A star around the ramp's start: seldom convex, never crossing itself.
            let count = extra.len();
            let spoke = |(index, point): (usize, &Point2<f64>)| {
                let angle = TAU * index as f64 / count as f64;
                ramp.start.xy() + Rotation2::new(angle) * Vector2::new(2.0 + point.x.abs() * 2.0, 0.0)
            };
            Some(extra.iter().enumerate().map(spoke).collect())
        }
    }
}

/// The points of a way, arcs every degree or so.
fn way(ramp: &Ramp) -> Vec<Point2<f64>> {
    let mut all = vec![ramp.start.xy()];
    for (from, step) in ramp.steps_with_starts() {
        let pieces = step.bend.map_or(1, |bend| (bend.sweep.abs() * 60.0).ceil().max(1.0) as usize);
        all.extend((1..pieces).filter_map(|piece| {
            let bend = step.bend?;
            let turn = Rotation2::new(bend.sweep * piece as f64 / pieces as f64);
            Some(bend.centre + turn * (from.xy() - bend.centre))
        }));
        all.push(step.to.xy());
    }
    all
}

/// Andrew's monotone chain.
fn hull(mut points: Vec<Point2<f64>>) -> Vec<Point2<f64>> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = &Point2<f64>>| {
        let mut chain: Vec<Point2<f64>> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp(&(point - a)) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut points.iter());
    all.extend(half(&mut points.iter().rev()));
    all
}

fn distance(point: Point2<f64>, [a, b]: [Point2<f64>; 2]) -> f64 {
    let way = b - a;
    let share = if way.norm_squared() > 0.0 { (point - a).dot(&way) / way.norm_squared() } else { 0.0 };
    (point - (a + way * share.clamp(0.0, 1.0))).norm()
}

/// Inside by the number of borders to the right, or near the border.
fn inside(corners: &[Point2<f64>], point: Point2<f64>, near: f64) -> bool {
    let edges = || corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]);
    let crossed = edges().filter(|[a, b]| {
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)
    });
    crossed.count() % 2 == 1 || edges().any(|edge| distance(point, edge) <= near)
}

/// The farthest that an arc of a ramp leaves the chords of 5 degrees that stand for it.
fn bulge(ramp: &Ramp) -> f64 {
    let radii =
        ramp.steps_with_starts().filter_map(|(from, step)| Some((from.xy() - step.bend?.centre).norm()));
    radii.fold(0.0, f64::max) * (1.0 - 2.5f64.to_radians().cos())
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn corrected_ramps_keep_the_limits_in_their_place(
        ramp in any_ramp(),
        (shortest_leg, steepest) in (0.3..25.0f64, 0.02..1.5f64),
        extra in prop::collection::vec(place(25.0), 3..12),
        region_kind in 0..4u8,
        begin in prop::option::of(0.1..10.0f64),
        first_pass in prop::option::of(place(1.0)),
        rounding in prop_oneof![3 => Just(0.0), 1 => Just(2e-4)],
    ) {
        let limits = RampLimits { shortest_leg, steepest };
        let corners = any_region(&ramp, &extra, region_kind);
        let region = match &corners {
            None => ToolRegion::Everywhere,
            Some(corners) if region_kind < 3 => ToolRegion::from_hull(corners.iter().copied()),
            Some(corners) => {
                ToolRegion::from_polygon(&corners.iter().map(|at| [at.x, at.y]).collect::<Vec<_>>()).unwrap()
            }
        };
        let passes: Vec<_> = first_pass.map(|at| at.coords).into_iter().collect();
        let task = RampTask { limits, begin, region: &region, passes: &passes, rounding };
        let found = match correct_ramp(&ramp, &task) {
            Ok(None) => {
                prop_assert!(is_within_limits(&ramp, &limits, rounding));
                return Ok(());
            }
            Ok(Some(found)) => found,
            Err(why) => {
                prop_assert!(region_kind > 0 || !matches!(why, ImpossibleCorrection::Region(_)), "{why}");
                return Ok(());
            }
        };
        prop_assert!(!is_within_limits(&ramp, &limits, rounding));
        prop_assert!(is_within_limits(&found.ramp, &limits, rounding));
        prop_assert_eq!(correct_ramp(&found.ramp, &task), Ok(None), "a second time changes nothing");
        // P1 stays across the axis, Pn altogether; nothing rises.
        prop_assert_eq!(found.ramp.start.xy(), ramp.start.xy());
        prop_assert_eq!(found.ramp.end_point(), ramp.end_point());
        prop_assert!(found.ramp.steps_with_starts().all(|(from, step)| step.to.z <= from.z + 1e-12));
        prop_assert!(found.ramp.start.z <= ramp.start.z);
        // Counted anew: no step is steeper, and what moved has no leg that is shorter.
        let least = match found.lengthened {
            LengtheningMethod::No | LengtheningMethod::WidenedHelix => 0.0,
            _ if matches!(RampKind::classify_ramp(&found.ramp), RampKind::Helix(_)) => 0.0,
            _ => shortest_leg - 1e-6,
        };
        for (from, step) in found.ramp.steps_with_starts() {
            let across = match step.bend {
                None => (step.to.xy() - from.xy()).norm(),
                Some(bend) => (from.xy() - bend.centre).norm() * bend.sweep.abs(),
            };
            prop_assert!(from.z - step.to.z <= steepest * across + 2.0 * rounding + 1e-6);
            prop_assert!(across >= least, "{across} mm of {:?}", found.lengthened);
        }
        let after = way(&found.ramp);
        let before = way(&ramp);
        let same_way = |point: &Point2<f64>| {
            before.windows(2).any(|pair| distance(*point, [pair[0], pair[1]]) <= 1e-9 + bulge(&ramp))
        };
        if found.lengthened == LengtheningMethod::No && found.passes == 1 {
            // A step that goes nowhere may be left out.
            let distinct = |mut way: Vec<Point2<f64>>| {
                way.dedup();
                way.len()
            };
            prop_assert_eq!(distinct(before.clone()), distinct(after.clone()));
        }
        if let Some(corners) = &corners {
            let near = 2e-5 + bulge(&found.ramp);
            for pair in after.windows(2) {
                for share in [0.0, 0.2, 0.4, 0.5, 0.6, 0.8, 1.0] {
                    let point = pair[0] + (pair[1] - pair[0]) * share;
                    let stays = found.lengthened == LengtheningMethod::No && same_way(&point);
                    prop_assert!(stays || inside(corners, point, near), "{point} of {:?}", found.lengthened);
                }
            }
        }
    }

    #[test]
    fn no_numbers_stop_it(
        values in prop::collection::vec([wild(), wild(), wild()], 2..7),
        arcs in prop::collection::vec(prop::option::weighted(0.3, [wild(), wild(), wild()]), 6),
        limits in [wild(), wild(), wild()],
    ) {
        let mut all = values.iter().map(|[x, y, z]| Point3::new(*x, *y, *z));
        let start = all.next().unwrap();
        let steps = all.zip(&arcs).map(|(to, arc)| {
            RampStep { to, bend: arc.map(|[x, y, sweep]| RampArc { centre: Point2::new(x, y), sweep }) }
        });
        let ramp = Ramp { start, steps: steps.collect() };
        let region = ToolRegion::from_hull(ramp.points().map(|point| point.xy()));
        let [shortest_leg, steepest, begin] = limits;
        let limits = RampLimits { shortest_leg, steepest };
        for region in [&region, &ToolRegion::Everywhere] {
            let passes = &[Vector2::new(begin, steepest)];
            let task = RampTask { limits, begin: Some(begin), region, passes, rounding: 0.0 };
            if let Ok(Some(found)) = correct_ramp(&ramp, &task) {
                prop_assert!(is_within_limits(&found.ramp, &limits, 0.0));
            }
        }
    }
}

/// Numbers of every size, and none.
fn wild() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -20.0..20.0f64,
        1 => -1e-3..1e-3f64,
        1 => prop::sample::select(vec![0.0, 1.0, 10.0]),
        1 => -1e9..1e9f64,
        1 => prop::num::f64::ANY,
    ]
}
