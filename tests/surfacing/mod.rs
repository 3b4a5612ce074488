//! Programs over surfaces.

mod closed_forms;
mod dialects;
mod faults;
mod files;
mod paths;

use clsmith::internals::surface::profile::{Chain, Point};
use clsmith::program::{Dialect, LengthUnit, MotionClass};
use clsmith::stock::Mesh;
use clsmith::surface_milling::{
    PassHeights, PassPattern, PassPlanes, SectionProfile, SurfaceMillingOptions, SurfacePart, SurfaceProgram,
    SurfaceProgramWords, make_surface_program,
};
use clsmith::write::new_program::DraftMove;

/// A ball of radius 5 over planes along zx, 2 mm apart, within 0.01 mm, in NX.
fn options() -> SurfaceMillingOptions {
    SurfaceMillingOptions {
        planes: PassPlanes::ZX,
        range_mm: None,
        step_mm: 2.0,
        radius_mm: 5.0,
        tolerance_mm: 0.01,
        against: PassHeights::Mesh,
        pattern: PassPattern::ZigZag,
        arcs: false,
        floor_mm: None,
        clearance_mm: 10.0,
        approach_mm: 2.0,
        feed_mm_min: 800.0,
        plunge_feed_mm_min: 300.0,
        air_feed_mm_min: None,
        words: SurfaceProgramWords {
            dialect: Dialect::Nx,
            units: LengthUnit::Mm,
            name: "PART".to_owned(),
            operation: "SECTION".to_owned(),
            tool: 3,
            tool_name: None,
            spindle_rpm: Some(6000.0),
            coolant: false,
        },
    }
}

/// The program over a mesh; its proof must hold.
fn over(mesh: &Mesh, options: &SurfaceMillingOptions) -> SurfaceProgram {
    let surfaced = make_surface_program(&SurfacePart::Mesh(mesh.clone()), options).unwrap();
    assert!(surfaced.proof.is_within(options.tolerance_mm), "{:?}", surfaced.proof);
    surfaced
}

/// The program over a profile of straight pieces, swept from 0 to 10.
fn along(points: &[[f64; 2]], options: &SurfaceMillingOptions) -> SurfaceProgram {
    let points: Vec<Point> = points.iter().map(|[u, z]| Point::new(*u, *z)).collect();
    let profile = SectionProfile::from_chain(&Chain::from_points(&points).unwrap());
    let options = SurfaceMillingOptions { range_mm: Some((0.0, 10.0)), ..options.clone() };
    let surfaced = make_surface_program(&SurfacePart::Profile(profile), &options).unwrap();
    assert!(surfaced.proof.is_within(options.tolerance_mm), "{:?}", surfaced.proof);
    surfaced
}

/// Starts and ends of the motions of a class.
fn of_class(surfaced: &SurfaceProgram, class: MotionClass) -> Vec<(DraftMove, DraftMove)> {
    let moves = &surfaced.draft.moves;
    moves.iter().copied().zip(moves.iter().copied().skip(1)).filter(|(_, to)| to.class == class).collect()
}
