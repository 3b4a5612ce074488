//! What cannot be made, each with its code.

use super::options;
use crate::surface::solids::{cube, mesh};
use clsmith::diagnostic::codes;
use clsmith::internals::surface::profile::{Chain, Point};
use clsmith::program::{Dialect, LengthUnit};
use clsmith::report::surface_milling::{collect_findings, draw_middle_plane, to_text};
use clsmith::surface_milling::{SectionProfile, SurfaceMillingOptions, SurfacePart, make_surface_program};

fn block() -> SurfacePart {
    SurfacePart::Mesh(mesh(&cube([0.0, 0.0, 0.0], [60.0, 20.0, 10.0])))
}

fn corner() -> SurfacePart {
    let points = [[0.0, 20.0], [20.0, 0.0], [40.0, 20.0]].map(|[u, z]| Point::new(u, z));
    SurfacePart::Profile(SectionProfile::from_chain(&Chain::from_points(&points).unwrap()))
}

#[test]
fn what_cannot_be_made_says_why() {
    let mut fine_inch = SurfaceMillingOptions { tolerance_mm: 2e-3, ..options() };
    fine_inch.words.units = LengthUnit::Inch;
    let cases = [
        (
            block(),
            SurfaceMillingOptions { range_mm: Some((30.0, 40.0)), ..options() },
            codes::NOTHING_TO_SURFACE,
        ),
        (block(), SurfaceMillingOptions { floor_mm: Some(10.5), ..options() }, codes::NOTHING_TO_SURFACE),
        (block(), SurfaceMillingOptions { step_mm: 1e-5, ..options() }, codes::SURFACE_OPTION),
        (block(), SurfaceMillingOptions { radius_mm: 0.0, ..options() }, codes::SURFACE_OPTION),
        (corner(), options(), codes::SURFACE_OPTION),
        (block(), SurfaceMillingOptions { tolerance_mm: 1e-4, ..options() }, codes::TOLERANCE_TOO_FINE),
        (block(), fine_inch, codes::TOLERANCE_TOO_FINE),
    ];
    for (part, options, code) in cases {
        let failure = make_surface_program(&part, &options).unwrap_err();
        assert_eq!(failure.findings()[0].code, code, "{options:?}");
    }
    let mut creo = SurfaceMillingOptions { tolerance_mm: 1e-4, ..options() };
    creo.words.dialect = Dialect::Creo;
    assert!(make_surface_program(&block(), &creo).is_ok(), "ten decimals are enough");
}

#[test]
fn a_corner_tighter_than_the_ball_is_told() {
    let options = SurfaceMillingOptions { range_mm: Some((0.0, 4.0)), ..options() };
    let surfaced = make_surface_program(&corner(), &options).unwrap();
    let found = collect_findings(&surfaced, &options);
    assert_eq!(found.iter().map(|found| found.code).collect::<Vec<_>>(), [codes::NOT_REACHED]);
    // The corner is R sqrt 2 from the centre of a ball that touches both sides.
    let left = 5.0 * (2f64.sqrt() - 1.0);
    assert!(found[0].message.contains(&format!("{left:.3}")), "{}", found[0].message);
    let text = to_text(&surfaced, &options, "corner.yaml");
    assert!(text.starts_with("corner.yaml: 3 planes 2.0000 mm apart, 3 passes, "), "{text}");
    // Points shifted one by one cross over in the corner.
    let drawn = draw_middle_plane(&surfaced, &options).unwrap();
    assert!(drawn.contains("points shifted one by one") && drawn.contains("gouge deepest: 4.99"), "{drawn}");
}
