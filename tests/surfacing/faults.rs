//! What cannot be made, each with its code.

use super::options;
use crate::surface::solids::{cube, mesh};
use clsmith::diagnostic::codes;
use clsmith::program::{Dialect, LengthUnit};
use clsmith::report::surfacing::{findings, plot, to_text};
use clsmith::surface::profile::{Chain, Point};
use clsmith::surfacing::{Options, Part, Profile, surface};

fn block() -> Part {
    Part::Mesh(mesh(&cube([0.0, 0.0, 0.0], [60.0, 20.0, 10.0])))
}

fn corner() -> Part {
    let points = [[0.0, 20.0], [20.0, 0.0], [40.0, 20.0]].map(|[u, z]| Point::new(u, z));
    Part::Profile(Profile::of_chain(&Chain::polyline(&points).unwrap()))
}

#[test]
fn what_cannot_be_made_says_why() {
    let mut fine_inch = Options { tolerance: 2e-3, ..options() };
    fine_inch.words.units = LengthUnit::Inch;
    let cases = [
        (block(), Options { range: Some((30.0, 40.0)), ..options() }, codes::NOTHING_TO_SURFACE),
        (block(), Options { floor: Some(10.5), ..options() }, codes::NOTHING_TO_SURFACE),
        (block(), Options { step: 1e-5, ..options() }, codes::SURFACE_OPTION),
        (block(), Options { radius: 0.0, ..options() }, codes::SURFACE_OPTION),
        (corner(), options(), codes::SURFACE_OPTION),
        (block(), Options { tolerance: 1e-4, ..options() }, codes::TOLERANCE_TOO_FINE),
        (block(), fine_inch, codes::TOLERANCE_TOO_FINE),
    ];
    for (part, options, code) in cases {
        assert_eq!(surface(&part, &options).unwrap_err().code, code, "{options:?}");
    }
    let mut creo = Options { tolerance: 1e-4, ..options() };
    creo.words.dialect = Dialect::Creo;
    assert!(surface(&block(), &creo).is_ok(), "ten decimals are enough");
}

#[test]
fn a_corner_tighter_than_the_ball_is_told() {
    let options = Options { range: Some((0.0, 4.0)), ..options() };
    let surfaced = surface(&corner(), &options).unwrap();
    let found = findings(&surfaced, &options);
    assert_eq!(found.iter().map(|found| found.code).collect::<Vec<_>>(), [codes::NOT_REACHED]);
    // The corner is R sqrt 2 from the centre of a ball that touches both sides.
    let left = 5.0 * (2f64.sqrt() - 1.0);
    assert!(found[0].message.contains(&format!("{left:.3}")), "{}", found[0].message);
    let text = to_text(&surfaced, &options, "corner.yaml");
    assert!(text.starts_with("corner.yaml: 3 planes 2.0000 mm apart, 3 passes, "), "{text}");
    // Points shifted one by one cross over in the corner.
    let drawn = plot(&surfaced, &options).unwrap();
    assert!(drawn.contains("points shifted one by one") && drawn.contains("gouge deepest: 4.99"), "{drawn}");
}
