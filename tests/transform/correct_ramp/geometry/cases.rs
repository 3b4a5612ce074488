//! Worked cases: what goes in, what comes out, each number from a closed form.

use super::{LIMITS, all_near, near, points, ramp};
use clsmith::internals::transform::correct_ramp::tool_region::ToolRegion;
use clsmith::internals::transform::correct_ramp::{
    ImpossibleCorrection, LengtheningMethod, RampTask, correct_ramp,
};
use nalgebra::Vector2;

/// How it becomes longer, nu, passes and P1..Pn.
type Expected = (LengtheningMethod, f64, usize, Vec<[f64; 3]>);

/// What a ramp is corrected to; legs of 10 mm, 1 in 10.
struct Case {
    name: &'static str,
    ramp: &'static [[f64; 3]],
    /// Limits of x and of y; none for anywhere.
    region: Option<[[f64; 2]; 2]>,
    begin: Option<f64>,
    first_pass: Option<[f64; 2]>,
    expected: Result<Expected, ImpossibleCorrection>,
}

const PLAIN: Case = Case {
    name: "",
    ramp: &[],
    region: None,
    begin: None,
    first_pass: None,
    expected: Err(ImpossibleCorrection::NoDirection),
};

fn box_(x: [f64; 2], y: [f64; 2]) -> ToolRegion {
    ToolRegion::from_polygon(&[[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]).unwrap()
}

fn lengthened() -> Vec<Case> {
    let apex = |height: f64| vec![[0.0, 0.0, 1.0], [6.0, height, 0.5], [12.0, 0.0, 0.0]];
    let side = 75f64.sqrt();
    let reach = 136f64.sqrt();
    // |(6, 0) + t (-3, 4) / 5| = 10.
    let back = 3.6 + 76.96f64.sqrt();
    vec![
        Case {
            name: "two legs of 10 over a chord of 12: their apex is 8 off",
            ramp: &[[0.0, 0.0, 1.0], [6.0, 2.0, 0.5], [12.0, 0.0, 0.0]],
            expected: Ok((LengtheningMethod::Circle, 1.0, 1, apex(8.0))),
            ..PLAIN
        },
        Case {
            name: "on the other side of the chord",
            ramp: &[[0.0, 0.0, 1.0], [5.0, -2.0, 0.5], [12.0, 0.0, 0.0]],
            expected: Ok((LengtheningMethod::Circle, 1.0, 1, apex(-8.0))),
            ..PLAIN
        },
        Case {
            name: "no room on the left",
            ramp: &[[0.0, 0.0, 1.0], [6.0, 2.0, 0.5], [12.0, 0.0, 0.0]],
            region: Some([[0.0, 12.0], [-9.0, 7.0]]),
            expected: Ok((LengtheningMethod::MirroredCircle, 1.0, 1, apex(-8.0))),
            ..PLAIN
        },
        Case {
            name: "no room on the right",
            ramp: &[[0.0, 0.0, 1.0], [6.0, -2.0, 0.5], [12.0, 0.0, 0.0]],
            region: Some([[0.0, 12.0], [-7.0, 9.0]]),
            expected: Ok((LengtheningMethod::MirroredCircle, 1.0, 1, apex(8.0))),
            ..PLAIN
        },
        Case {
            name: "three legs, centre beyond the chord: a trapezoid",
            ramp: &[[0.0, 0.0, 1.5], [8.0, 4.0, 1.0], [14.0, 4.0, 0.5], [22.0, 0.0, 0.0]],
            expected: Ok((
                LengtheningMethod::Circle,
                1.0,
                1,
                vec![[0.0, 0.0, 1.5], [6.0, 8.0, 1.0], [16.0, 8.0, 0.5], [22.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "three legs, centre before the chord: a square",
            ramp: &[[0.0, 0.0, 1.5], [2.0, 3.0, 1.0], [8.0, 3.0, 0.5], [10.0, 0.0, 0.0]],
            expected: Ok((
                LengtheningMethod::Circle,
                1.0,
                1,
                vec![[0.0, 0.0, 1.5], [0.0, 10.0, 1.0], [10.0, 10.0, 0.5], [10.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "closed, counter-clockwise: an equilateral triangle",
            ramp: &[[0.0, 0.0, 0.9], [2.0, -1.0, 0.6], [2.0, 1.0, 0.3], [0.0, 0.0, 0.0]],
            expected: Ok((
                LengtheningMethod::Circle,
                1.0,
                1,
                vec![[0.0, 0.0, 0.9], [side, -5.0, 0.6], [side, 5.0, 0.3], [0.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "closed, clockwise, and no room there",
            ramp: &[[0.0, 0.0, 0.9], [2.0, 1.0, 0.6], [2.0, -1.0, 0.3], [0.0, 0.0, 0.0]],
            region: Some([[-9.0, 3.0], [-5.0, 5.0]]),
            expected: Ok((
                LengtheningMethod::MirroredCircle,
                1.0,
                1,
                vec![[0.0, 0.0, 0.9], [-side, 5.0, 0.6], [-side, -5.0, 0.3], [0.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "to and fro: two legs around are the diameter there and back",
            ramp: &[[1.0, 0.0, 1.0], [4.0, 0.0, 0.5], [1.0, 0.0, 0.0]],
            expected: Ok((
                LengtheningMethod::Circle,
                1.0,
                1,
                vec![[1.0, 0.0, 1.0], [11.0, 0.0, 0.5], [1.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "the mean leg is longer than the least one: no leg gets shorter on the whole",
            ramp: &[[0.0, 0.0, 1.0], [9.0, 0.0, 0.5], [9.0, 21.0, 0.0]],
            expected: Ok((
                LengtheningMethod::Circle,
                1.0,
                1,
                // Two legs of 15 over sqrt(522): sqrt(225 - 522 / 4) to the right of the middle.
                {
                    let share = (225.0 - 522.0 / 4.0f64).sqrt() / 522f64.sqrt();
                    vec![[0.0, 0.0, 1.0], [4.5 + 21.0 * share, 10.5 - 9.0 * share, 0.5], [9.0, 21.0, 0.0]]
                },
            )),
            ..PLAIN
        },
        Case {
            name: "a chord that is long enough, where there is room for nothing else",
            ramp: &[[0.0, 0.0, 1.0], [3.0, 4.0, 0.5], [30.0, 0.0, 0.0]],
            region: Some([[0.0, 30.0], [-4.5, 4.5]]),
            expected: Ok((LengtheningMethod::AlongChord, 1.0, 1, vec![[0.0, 0.0, 1.0], [30.0, 0.0, 0.0]])),
            ..PLAIN
        },
        Case {
            name: "one leg: beyond its end and back",
            ramp: &[[0.0, 0.0, 1.3], [6.0, 0.0, 0.0]],
            expected: Ok((
                LengtheningMethod::AlongChord,
                1.0,
                1,
                vec![[0.0, 0.0, 1.3], [16.0, 0.0, 0.5], [6.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "one leg: from behind its start",
            ramp: &[[0.0, 0.0, 1.3], [6.0, 0.0, 0.0]],
            region: Some([[-10.0, 12.0], [-1.0, 1.0]]),
            expected: Ok((
                LengtheningMethod::AlongChord,
                1.0,
                1,
                vec![[0.0, 0.0, 1.3], [-10.0, 0.0, 0.8], [6.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "one leg: over both ends",
            ramp: &[[0.0, 0.0, 1.7], [6.0, 0.0, 0.0]],
            region: Some([[-4.0, 10.0], [-1.0, 1.0]]),
            expected: Ok((
                LengtheningMethod::AlongChord,
                1.0,
                1,
                vec![[0.0, 0.0, 1.7], [10.0, 0.0, 1.2], [-4.0, 0.0, 0.5], [6.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "one leg: along the first pass",
            ramp: &[[0.0, 0.0, 1.0], [6.0, 0.0, 0.0]],
            region: Some([[-1.0, 7.0], [-1.0, 11.0]]),
            first_pass: Some([0.0, 2.0]),
            expected: Ok((
                LengtheningMethod::AlongPass,
                1.0,
                1,
                vec![[0.0, 0.0, 1.0], [6.0, 10.0, 10.0 / (10.0 + reach)], [6.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "along a first pass that comes back past the start: as far as the first leg needs",
            ramp: &[[0.0, 0.0, 1.0], [6.0, 0.0, 0.0]],
            region: Some([[-2.0, 8.0], [-1.0, 11.0]]),
            first_pass: Some([-3.0, 4.0]),
            expected: Ok((
                LengtheningMethod::AlongPass,
                1.0,
                1,
                vec![[0.0, 0.0, 1.0], [6.0 - 0.6 * back, 0.8 * back, back / (10.0 + back)], [6.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "straight down: along the first pass",
            ramp: &[[0.0, 0.0, 2.0], [0.0, 0.0, 0.0]],
            first_pass: Some([3.0, 0.0]),
            expected: Ok((
                LengtheningMethod::AlongPass,
                1.0,
                1,
                vec![[0.0, 0.0, 2.0], [10.0, 0.0, 1.0], [0.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "straight down, twice too deep",
            ramp: &[[0.0, 0.0, 4.0], [0.0, 0.0, 0.0]],
            first_pass: Some([1.0, 0.0]),
            expected: Ok((
                LengtheningMethod::AlongPass,
                1.0,
                2,
                vec![[0.0, 0.0, 4.0], [10.0, 0.0, 3.0], [0.0, 0.0, 2.0], [10.0, 0.0, 1.0], [0.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
    ]
}

fn flattened() -> Vec<Case> {
    const DEEP: &[[f64; 3]] = &[[0.0, 0.0, 5.0], [20.0, 0.0, 0.0]];
    vec![
        Case {
            name: "compression alone: 0.25 times 2/5 is 0.1",
            ramp: DEEP,
            begin: Some(2.0),
            expected: Ok((LengtheningMethod::No, 0.4, 1, vec![[0.0, 0.0, 2.0], [20.0, 0.0, 0.0]])),
            ..PLAIN
        },
        Case {
            name: "open: forward, back, forward",
            ramp: DEEP,
            expected: Ok((
                LengtheningMethod::No,
                1.0,
                3,
                vec![[0.0, 0.0, 5.0], [20.0, 0.0, 10.0 / 3.0], [0.0, 0.0, 5.0 / 3.0], [20.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "compression, then layers on what is left",
            ramp: DEEP,
            begin: Some(4.5),
            expected: Ok((
                LengtheningMethod::No,
                0.9,
                3,
                vec![[0.0, 0.0, 4.5], [20.0, 0.0, 3.0], [0.0, 0.0, 1.5], [20.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "a start below the height where it may begin is not raised",
            ramp: &[[0.0, 0.0, 4.0], [20.0, 0.0, 0.0]],
            begin: Some(4.5),
            expected: Ok((
                LengtheningMethod::No,
                1.0,
                3,
                vec![[0.0, 0.0, 4.0], [20.0, 0.0, 8.0 / 3.0], [0.0, 0.0, 4.0 / 3.0], [20.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "closed: the same way around again",
            ramp: &[[0.0, 0.0, 4.0], [10.0, 0.0, 2.0], [0.0, 0.0, 0.0]],
            expected: Ok((
                LengtheningMethod::No,
                1.0,
                2,
                vec![[0.0, 0.0, 4.0], [10.0, 0.0, 3.0], [0.0, 0.0, 2.0], [10.0, 0.0, 1.0], [0.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "longer first, and then no layers are needed: 2 over 20 instead of over 12",
            ramp: &[[0.0, 0.0, 2.0], [6.0, 2.0, 1.0], [12.0, 0.0, 0.0]],
            expected: Ok((
                LengtheningMethod::Circle,
                1.0,
                1,
                vec![[0.0, 0.0, 2.0], [6.0, 8.0, 1.0], [12.0, 0.0, 0.0]],
            )),
            ..PLAIN
        },
        Case {
            name: "no room at all",
            ramp: &[[0.0, 0.0, 1.0], [6.0, 1.0, 0.5], [8.0, 0.0, 0.0]],
            region: Some([[-1.0, 9.0], [-2.0, 2.0]]),
            first_pass: Some([1.0, 0.0]),
            expected: Err(ImpossibleCorrection::Region(10.0)),
            ..PLAIN
        },
        Case {
            name: "one leg straight down and no pass to follow",
            ramp: &[[0.0, 0.0, 2.0], [0.0, 0.0, 0.0]],
            expected: Err(ImpossibleCorrection::NoDirection),
            ..PLAIN
        },
        Case {
            name: "as deep as no one ramps: 1000 over 10, there and back 500 times",
            ramp: &[[0.0, 0.0, 1000.0], [10.0, 0.0, 0.0]],
            expected: Err(ImpossibleCorrection::TooMany(1001.0)),
            ..PLAIN
        },
    ]
}

#[test]
fn worked_cases() {
    for case in lengthened().into_iter().chain(flattened()) {
        println!("{}", case.name);
        let region = case.region.map_or(ToolRegion::Everywhere, |[x, y]| box_(x, y));
        let task = RampTask {
            limits: LIMITS,
            begin: case.begin,
            region: &region,
            passes: &case.first_pass.map(Vector2::from).into_iter().collect::<Vec<_>>(),
            rounding: 0.0,
        };
        match (correct_ramp(&ramp(case.ramp), &task), case.expected) {
            (Ok(Some(found)), Ok((lengthened, compression, passes, expected))) => {
                assert_eq!((found.lengthened, found.passes), (lengthened, passes));
                near(found.compression, compression);
                all_near(&points(&found.ramp), &expected);
            }
            (found, Err(expected)) => assert_eq!(found, Err(expected)),
            (found, Ok(_)) => panic!("{found:?}"),
        }
    }
}
