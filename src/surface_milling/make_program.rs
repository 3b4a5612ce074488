//! This module makes a program from a part.

use super::pass_linking::{PassLinking, link_tracks};
use super::pass_track::{PassTrack, ProgramRounding};
use super::plane_cost::check_plane_cost;
use super::plane_slices::{PassMaker, PlaneSlice};
use super::section_profile::chain_bounds;
use super::surface_program::{SurfaceProgram, draft_program};
use super::surface_proof::{PassProver, ProvedPass, SurfaceProof};
use super::watched_planes::WatchedPlanes;
use super::{PassHeights, PassPattern, PassPlanes, SurfaceMillingOptions, SurfacePart, plane_offsets};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::simulation_run::{RunWatcher, SilentWatcher};
use crate::stock::Mesh;
use crate::surface::drop_cutter::BallClearanceField;
use crate::surface::drop_cutter::{DropCutter, DropCutterShape};
use crate::surface::mesh_section::VerticalMeshSections;
use crate::surface::profile::{Chain, find_unreachable_parts};
use crate::write::new_program;
use nalgebra::Point3;
use rayon::prelude::*;

/// The fractions of the tolerance for the chords of the path, for curves in chords, for the chords of the
/// proof, and for short lines. The rest is for what the proof cannot see.
const PATH_SHARE: f64 = 0.8;
const CURVE_SHARE: f64 = 0.03;
const DENSE_SHARE: f64 = 0.01;
const SHORT_SHARE: f64 = 0.1;

/// The finest tolerance with which curves are divided, mm.
const FINEST: f64 = 1e-6;

/// The ground of the passes, ready to be used.
enum PassGround<'a> {
    Profile { dense: Chain, tips: Vec<Chain> },
    Mesh { mesh: &'a Mesh, sections: VerticalMeshSections, cutter: DropCutter },
}

/// The ground, its lowest and highest z, and its own range across the planes, if it is known.
type PreparedGround<'a> = (PassGround<'a>, f64, f64, Option<(f64, f64)>);

/// Makes the program over a part, proves it and reads it back.
///
/// ```
/// use clsmith::program::Dialect;
/// use clsmith::surface_milling::{Chain, Point};
/// use clsmith::surface_milling::{
///     SectionProfile, SurfaceMillingOptions, SurfacePart, SurfaceProgramWords, make_surface_program,
/// };
///
/// let slope = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(40.0, 10.0)];
/// let slope = SectionProfile::from_chain(&Chain::from_points(&slope)?);
/// let words = SurfaceProgramWords::new(Dialect::Nx, "SLOPE");
/// let mut options = SurfaceMillingOptions::new(0.5, 5.0, 800.0, words);
/// options.range_mm = Some((0.0, 10.0));
/// let made = make_surface_program(&SurfacePart::Profile(slope), &options)?;
/// assert!(made.proof.is_within(options.tolerance_mm));
/// assert!(made.text.starts_with(b"TOOL PATH/SECTION"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns a finding if there is nothing to mill, if the options do not fit together, or if the program that
/// is read back differs from the one that was written. A proof that fails is not an error:
/// [`SurfaceProof::is_within`] tells whether it holds.
pub fn make_surface_program(
    part: &SurfacePart,
    options: &SurfaceMillingOptions,
) -> Result<SurfaceProgram, Failure> {
    make_watched_surface_program(part, options, &SilentWatcher)
}

/// Makes a program as [`make_surface_program`] does. `watch` gets the planes that are made and proved, and can stop
/// the work between two planes.
///
/// # Errors
/// Returns the errors of [`make_surface_program`], [`codes::TOO_MUCH`] if the passes take more memory than they
/// may, and what `watch` stops the work with.
pub fn make_watched_surface_program(
    part: &SurfacePart,
    options: &SurfaceMillingOptions,
    watch: &dyn RunWatcher,
) -> Result<SurfaceProgram, Failure> {
    let words = &options.words;
    let print = ProgramRounding { dialect: words.dialect, units: words.units };
    let ball = DropCutterShape::new(2.0 * options.radius_mm, options.radius_mm)
        .map_err(|error| invalid_option(format!("a ball of radius {} mm: {error}", options.radius_mm)))?;
    // Rounding to the program's decimals moves a point by up to one unit of the last decimal.
    let tolerance = PATH_SHARE * options.tolerance_mm - print.last_decimal_mm();
    // The tolerance must not be below FINEST, nor so small that rounding to decimals uses most of it.
    if !(tolerance >= options.tolerance_mm / 4.0 && tolerance >= 10.0 * FINEST) {
        let message = format!(
            "{} writes {} decimals, too few for a tolerance of {} mm",
            words.dialect,
            new_program::coordinate_decimals(words.dialect),
            options.tolerance_mm
        );
        return Err(Diagnostic::new(codes::TOLERANCE_TOO_FINE, message).into());
    }
    let arcs = options.arcs && new_program::can_write_arcs(words.dialect);
    let mut making = PassMaker {
        planes: options.planes,
        radius_mm: options.radius_mm,
        tolerance_mm: tolerance,
        arcs,
        floor_mm: f64::NEG_INFINITY,
    };
    let (ground, low, high, own) = prepare_ground(part, options, &mut making, ball)?;
    let range = options.range_mm.or(own).ok_or_else(|| {
        let message = "nothing says over which width the profile is swept".to_owned();
        Diagnostic::new(codes::SURFACE_OPTION, message)
            .with_help("Give --from and --to, or `width:` in the profile file.")
    })?;
    let places = plane_offsets(range.0, range.1, options.step_mm).ok_or_else(|| {
        invalid_option(format!(
            "from {} to {} mm in steps of {} mm are too many planes",
            range.0, range.1, options.step_mm
        ))
    })?;
    check_plane_cost(&places, watch, &|offset| slice_plane(&making, &ground, options, offset))?;
    // Planes do not depend on each other; only the order of cutting does.
    let work = WatchedPlanes::new(watch, places.len());
    let slices: Vec<PlaneSlice> = places
        .par_iter()
        .map(|offset| work.do_next(|| slice_plane(&making, &ground, options, *offset)))
        .collect::<Result<_, Failure>>()?;
    let tracks = make_tracks(&slices, options, print);
    let passes: usize = tracks.iter().map(Vec::len).sum();
    if passes == 0 {
        let message = format!("no plane from {} to {} mm has anything to go over", range.0, range.1);
        return Err(Diagnostic::new(codes::NOTHING_TO_SURFACE, message)
            .with_help(format!(
                "The part lies from z = {low} to {high} mm{}; the tip stays above z = {} mm.",
                own.map_or(String::new(), |(from, to)| format!(
                    " and from {from} to {to} mm across the planes"
                )),
                making.floor_mm
            ))
            .into());
    }
    let proof = prove_passes(&slices, &tracks, &ground, options, print, &work)?;
    watch.check_stop()?;
    // The clearance height is rounded up to a round number, as people write heights.
    let clear = (high.max(making.floor_mm) + options.clearance_mm) / words.units.mm_per_unit();
    let clear = new_program::round_coordinate((clear * 1e3 - 1e-6).ceil() / 1e3, words.dialect);
    let between = PassLinking {
        pattern: options.pattern,
        clear,
        approach: options.approach_mm / words.units.mm_per_unit(),
        feed: print.round_feed(options.feed_mm_min),
        plunge: print.round_feed(options.plunge_feed_mm_min),
        air: options.air_feed_mm_min.map(|feed| print.round_feed(feed)),
    };
    let spacing = match places.as_slice() {
        [first, second, ..] => (second - first).abs(),
        _ => 0.0,
    };
    // A link over the surface is only worth it between neighbouring planes.
    let near = (3.0 * spacing).max(2.0 * options.radius_mm);
    let beside = make_height_probe(part, options);
    // The highest point beside a position, above which a rapid must end. A profile is known by its own
    // highest point.
    let top = |at: Point3<f64>| {
        let mm_per_unit = words.units.mm_per_unit();
        let height = match &beside {
            Some(wide) => wide.drop_at(at.x * mm_per_unit, at.y * mm_per_unit).map(|drop| drop.tip_z_mm),
            None => Some(high),
        };
        height.map_or(at.z, |height| height / mm_per_unit)
    };
    let moves = link_tracks(
        &tracks,
        &between,
        print,
        |from, to| link_over_surface(&ground, &making, print, near, from, to),
        top,
    );
    watch.check_stop()?;
    let draft = draft_program(options, print, moves);
    let text = new_program::write_program(&draft, words.dialect).map_err(|error| {
        let message = format!("the written program does not read back as it was meant: {error}");
        Diagnostic::new(codes::NOT_READ_BACK, message)
    })?;
    let unreached = match &ground {
        PassGround::Profile { dense, .. } => {
            let found = find_unreachable_parts(dense, options.radius_mm, options.tolerance_mm);
            debug_assert!(found.is_ok(), "this profile was compensated before: {found:?}");
            found.unwrap_or_default()
        }
        PassGround::Mesh { .. } => Vec::new(),
    };
    Ok(SurfaceProgram {
        draft,
        text,
        proof,
        planes: tracks.iter().filter(|tracks| !tracks.is_empty()).count(),
        empty: tracks.iter().filter(|tracks| tracks.is_empty()).count(),
        passes,
        spacing_mm: spacing,
        unreached,
        figure: figure_of_middle_plane(&slices, &tracks, &ground, &making, print),
    })
}

/// Makes a flat cutter that finds the highest point of a mesh within the ball's radius and the approach;
/// `None` for a profile.
fn make_height_probe(part: &SurfacePart, options: &SurfaceMillingOptions) -> Option<DropCutter> {
    let wide = DropCutterShape::flat(2.0 * (options.radius_mm + options.approach_mm)).ok()?;
    match part {
        SurfacePart::Mesh(mesh) => Some(DropCutter::new(mesh, wide)),
        SurfacePart::Profile(_) => None,
    }
}

/// Makes a finding about an option.
fn invalid_option(message: String) -> Failure {
    Diagnostic::new(codes::SURFACE_OPTION, message).into()
}

/// Prepares the ground and returns it with its lowest and highest z and its own range across the planes. Sets
/// the floor of `making`.
fn prepare_ground<'a>(
    part: &'a SurfacePart,
    options: &SurfaceMillingOptions,
    making: &mut PassMaker,
    ball: DropCutterShape,
) -> Result<PreparedGround<'a>, Failure> {
    match part {
        SurfacePart::Profile(profile) => {
            let share = |share: f64| (share * options.tolerance_mm).max(FINEST);
            let chain =
                profile.to_chain(share(CURVE_SHARE)).map_err(|error| invalid_option(error.to_string()))?;
            let dense = profile
                .to_dense_chain(share(DENSE_SHARE))
                .map_err(|error| invalid_option(error.to_string()))?;
            let (low, high) = chain_bounds(&dense);
            making.floor_mm = options.floor_mm.unwrap_or(low.z);
            let tips = making.tips_over_profile(&chain);
            let own = profile.width_mm.map(|width| (0.0, width));
            Ok((PassGround::Profile { dense, tips }, low.z, high.z, own))
        }
        SurfacePart::Mesh(mesh) => {
            let sections = VerticalMeshSections::new(mesh, options.planes.angle_rad());
            let (low, high) = sections.offset_range();
            let (one, other) = (options.planes.offset_to_left(low), options.planes.offset_to_left(high));
            let ([.., bottom], [.., top]) = mesh.bounds();
            making.floor_mm = options.floor_mm.unwrap_or(bottom);
            let cutter = DropCutter::new(mesh, ball);
            Ok((
                PassGround::Mesh { mesh, sections, cutter },
                bottom,
                top,
                Some((one.min(other), one.max(other))),
            ))
        }
    }
}

/// Makes the passes in one plane.
fn slice_plane(
    making: &PassMaker,
    ground: &PassGround<'_>,
    options: &SurfaceMillingOptions,
    offset: f64,
) -> PlaneSlice {
    match (ground, options.against) {
        (PassGround::Profile { dense, tips }, _) => {
            PlaneSlice { offset_mm: offset, ground: Some(dense.clone()), tips: tips.clone() }
        }
        (PassGround::Mesh { sections, .. }, PassHeights::Profile) => making.slice_in_plane(sections, offset),
        (PassGround::Mesh { sections, cutter, .. }, PassHeights::Mesh) => {
            making.slice_over_mesh(sections, cutter, offset)
        }
    }
}

/// Converts the passes to tracks plane by plane, in the order and direction in which they are cut.
fn make_tracks(
    slices: &[PlaneSlice],
    options: &SurfaceMillingOptions,
    print: ProgramRounding,
) -> Vec<Vec<PassTrack>> {
    let mut back = false;
    let mut all = Vec::with_capacity(slices.len());
    for slice in slices {
        let least = options.tolerance_mm * SHORT_SHARE;
        let track = |tip: &Chain| PassTrack::new(tip, &options.planes, slice.offset_mm, least, print);
        let mut tracks: Vec<PassTrack> = if back {
            slice.tips.iter().rev().filter_map(|tip| track(&tip.reversed())).collect()
        } else {
            slice.tips.iter().filter_map(track).collect()
        };
        tracks.shrink_to_fit();
        // In a zigzag, only a plane that has a pass reverses the direction.
        back = options.pattern == PassPattern::ZigZag && (back == tracks.is_empty());
        all.push(tracks);
    }
    all
}

/// Proves all passes against the part: in their planes, and in space if the part is a mesh.
fn prove_passes(
    slices: &[PlaneSlice],
    tracks: &[Vec<PassTrack>],
    ground: &PassGround<'_>,
    options: &SurfaceMillingOptions,
    print: ProgramRounding,
    work: &WatchedPlanes<'_>,
) -> Result<SurfaceProof, Failure> {
    let space = match ground {
        PassGround::Mesh { mesh, .. } => Some(BallClearanceField::new(mesh, options.radius_mm)),
        PassGround::Profile { .. } => None,
    };
    let passes: Vec<ProvedPass<'_>> = slices
        .iter()
        .zip(tracks)
        .flat_map(|(slice, tracks)| {
            tracks.iter().map(|track| ProvedPass {
                offset_mm: slice.offset_mm,
                track,
                ground: slice.ground.as_ref(),
            })
        })
        .collect();
    let look = PassProver {
        planes: &options.planes,
        radius_mm: options.radius_mm,
        tolerance_mm: options.tolerance_mm,
        print,
        space: space.as_ref(),
    };
    look.prove_all(&passes, work)
}

/// Returns the points over the surface from the end of a pass to the start of one in the next plane, or
/// `None` if that is far or not known to be safe.
fn link_over_surface(
    ground: &PassGround<'_>,
    making: &PassMaker,
    print: ProgramRounding,
    near: f64,
    from: Point3<f64>,
    to: Point3<f64>,
) -> Option<Vec<Point3<f64>>> {
    let (start, end) = (print.point_in_mm(from), print.point_in_mm(to));
    let ends = [start, end].map(|[x, y, _]| [x, y]);
    let [[x0, y0], [x1, y1]] = ends;
    if (x1 - x0).hypot(y1 - y0) > near {
        return None;
    }
    match ground {
        PassGround::Profile { .. } => {
            // A profile is the same in all planes, so a straight line between equal points of it is safe.
            let [a, b] = ends.map(|end| making.planes.distance_along(end));
            let same = (a - b).abs() + (start[2] - end[2]).abs() <= 4.0 * print.last_decimal_mm();
            same.then(|| vec![to])
        }
        PassGround::Mesh { cutter, .. } => {
            let runs = cutter.follow_line(&ends, making.tolerance_mm);
            let [run] = runs.as_slice() else { return None };
            // The path must go from end to end, otherwise there is a hole between them.
            let whole = run
                .first()
                .zip(run.last())
                .is_some_and(|([a, b, _], [c, d, _])| ends == [[*a, *b], [*c, *d]]);
            let between = run.get(1..run.len().saturating_sub(1))?;
            let lifted = |[x, y, z]: &[f64; 3]| print.round_point([*x, *y, z.max(making.floor_mm)]);
            whole.then(|| between.iter().map(lifted).chain([to]).collect())
        }
    }
}

/// Returns the figure of the middle plane that has a pass: its offset, the part's line and the tip's.
fn figure_of_middle_plane(
    slices: &[PlaneSlice],
    tracks: &[Vec<PassTrack>],
    ground: &PassGround<'_>,
    making: &PassMaker,
    print: ProgramRounding,
) -> Option<(f64, Chain, Vec<Chain>)> {
    let with: Vec<(&PlaneSlice, &Vec<PassTrack>)> =
        slices.iter().zip(tracks).filter(|(_, tracks)| !tracks.is_empty()).collect();
    let (slice, tracks) = with.get(with.len() / 2)?;
    let planes: &PassPlanes = &making.planes;
    let line = match ground {
        PassGround::Profile { dense, .. } => dense.clone(),
        PassGround::Mesh { sections, .. } => making.slice_in_plane(sections, slice.offset_mm).ground?,
    };
    let tips = tracks.iter().filter_map(|track| track.to_plane_chain(planes, print)).collect();
    Some((slice.offset_mm, line, tips))
}
