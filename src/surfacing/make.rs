//! From a part to a program.

use super::join::{Between, join};
use super::profile::bounds;
use super::proof::{Look, Pass, Proof};
use super::slices::{Making, Slice};
use super::surfaced::{Surfaced, draft};
use super::track::{Print, Track};
use super::{Against, Options, Part, Pattern, Planes, offsets};
use crate::diagnostic::{Diagnostic, codes};
use crate::sim::Mesh;
use crate::surface::drop::Space;
use crate::surface::drop::{Cutter, DropCutter};
use crate::surface::profile::{Chain, unreachable};
use crate::surface::section::Sections;
use crate::write::program;
use nalgebra::Point3;
use rayon::prelude::*;

/// Of the tolerance, this share is for the path's chords; the rest for curves in chords, and for what the proof cannot see.
const PATH_SHARE: f64 = 0.8;
const CURVE_SHARE: f64 = 0.03;
const DENSE_SHARE: f64 = 0.01;
const SHORT_SHARE: f64 = 0.1;

/// The finest that curves are divided, mm.
const FINEST: f64 = 1e-6;

/// What passes are made over, ready to be used.
enum Ground<'a> {
    Profile { dense: Chain, tips: Vec<Chain> },
    Mesh { mesh: &'a Mesh, sections: Sections, cutter: DropCutter },
}

/// What to go over, its lowest and highest z, and from where to where it goes across the planes, where that is known.
type Place<'a> = (Ground<'a>, f64, f64, Option<(f64, f64)>);

/// Makes the program over a part, proves it and reads it back.
///
/// # Errors
/// A finding when there is nothing to go over, when numbers do not go together, or when the program is not what was meant.
/// That the proof fails is none: [`Proof::holds`] tells.
pub fn surface(part: &Part, options: &Options) -> Result<Surfaced, Box<Diagnostic>> {
    let words = &options.words;
    let print = Print { dialect: words.dialect, units: words.units };
    let ball = Cutter::new(2.0 * options.radius, options.radius)
        .map_err(|error| fault(format!("a ball of radius {} mm: {error}", options.radius)))?;
    let tolerance = PATH_SHARE * options.tolerance - print.last_decimal();
    // Not below FINEST, nor so little that rounding is the larger part.
    if !(tolerance >= options.tolerance / 4.0 && tolerance >= 10.0 * FINEST) {
        let message = format!(
            "{} writes {} decimals, too few for a tolerance of {} mm",
            words.dialect,
            program::decimals(words.dialect),
            options.tolerance
        );
        return Err(Box::new(Diagnostic::new(codes::TOLERANCE_TOO_FINE, message)));
    }
    let arcs = options.arcs && program::holds_arcs(words.dialect);
    let mut making =
        Making { planes: options.planes, radius: options.radius, tolerance, arcs, floor: f64::NEG_INFINITY };
    let (ground, low, high, own) = ground(part, options, &mut making, ball)?;
    let range = options.range.or(own).ok_or_else(|| {
        let message = "nothing says over which width the profile is swept".to_owned();
        Diagnostic::new(codes::SURFACE_OPTION, message)
            .help("Give --from and --to, or `width:` in the profile file.")
    })?;
    let places = offsets(range.0, range.1, options.step).ok_or_else(|| {
        fault(format!(
            "from {} to {} mm in steps of {} mm are too many planes",
            range.0, range.1, options.step
        ))
    })?;
    let slices: Vec<Slice> =
        places.par_iter().map(|offset| slice(&making, &ground, options, *offset)).collect();
    let tracks = tracks(&slices, options, print);
    let passes: usize = tracks.iter().map(Vec::len).sum();
    if passes == 0 {
        let message = format!("no plane from {} to {} mm has anything to go over", range.0, range.1);
        return Err(Box::new(Diagnostic::new(codes::NOTHING_TO_SURFACE, message).help(format!(
            "The part lies from z = {low} to {high} mm{}; the tip stays above z = {} mm.",
            own.map_or(String::new(), |(from, to)| format!(" and from {from} to {to} mm across the planes")),
            making.floor
        ))));
    }
    let proof = prove(&slices, &tracks, &ground, options, print);
    // Up to a round number, as people write heights.
    let clear = (high.max(making.floor) + options.clearance) / words.units.in_mm();
    let clear = program::rounded((clear * 1e3 - 1e-6).ceil() / 1e3, words.dialect);
    let between = Between {
        pattern: options.pattern,
        clear,
        approach: options.approach / words.units.in_mm(),
        feed: print.feed(options.feed),
        plunge: print.feed(options.plunge),
        air: options.air.map(|feed| print.feed(feed)),
    };
    let spacing = match places.as_slice() {
        [first, second, ..] => (second - first).abs(),
        _ => 0.0,
    };
    let near = (3.0 * spacing).max(2.0 * options.radius);
    let beside = beside(part, options);
    let top = |at: Point3<f64>| {
        let mm = words.units.in_mm();
        let height = match &beside {
            Some(wide) => wide.height(at.x * mm, at.y * mm).map(|drop| drop.tip_z),
            None => Some(high),
        };
        height.map_or(at.z, |height| height / mm)
    };
    let moves = join(&tracks, &between, print, |from, to| link(&ground, &making, print, near, from, to), top);
    let draft = draft(options, print, moves);
    let text = program::write(&draft, words.dialect).map_err(|error| {
        let message = format!("the written program does not read back as it was meant: {error}");
        Diagnostic::new(codes::NOT_READ_BACK, message)
    })?;
    let unreached = match &ground {
        Ground::Profile { dense, .. } => {
            unreachable(dense, options.radius, options.tolerance).unwrap_or_default()
        }
        Ground::Mesh { .. } => Vec::new(),
    };
    Ok(Surfaced {
        draft,
        text,
        proof,
        planes: tracks.iter().filter(|tracks| !tracks.is_empty()).count(),
        empty: tracks.iter().filter(|tracks| tracks.is_empty()).count(),
        passes,
        spacing,
        unreached,
        figure: figure(&slices, &tracks, &ground, &making, print),
    })
}

/// A flat cutter that tells the highest place of a mesh within the ball's radius and the approach.
fn beside(part: &Part, options: &Options) -> Option<DropCutter> {
    let wide = Cutter::flat(2.0 * (options.radius + options.approach)).ok()?;
    match part {
        Part::Mesh(mesh) => Some(DropCutter::new(mesh, wide)),
        Part::Profile(_) => None,
    }
}

fn fault(message: String) -> Box<Diagnostic> {
    Box::new(Diagnostic::new(codes::SURFACE_OPTION, message))
}

/// What to go over, its lowest and highest z, and from where to where it goes across the planes. Sets the floor.
fn ground<'a>(
    part: &'a Part,
    options: &Options,
    making: &mut Making,
    ball: Cutter,
) -> Result<Place<'a>, Box<Diagnostic>> {
    match part {
        Part::Profile(profile) => {
            let share = |share: f64| (share * options.tolerance).max(FINEST);
            let chain = profile.chain(share(CURVE_SHARE)).map_err(|error| fault(error.to_string()))?;
            let dense = profile.dense(share(DENSE_SHARE)).map_err(|error| fault(error.to_string()))?;
            let (low, high) = bounds(&dense);
            making.floor = options.floor.unwrap_or(low.z);
            let tips = making.over_profile(&chain);
            let own = profile.width.map(|width| (0.0, width));
            Ok((Ground::Profile { dense, tips }, low.z, high.z, own))
        }
        Part::Mesh(mesh) => {
            let sections = Sections::new(mesh, options.planes.angle());
            let (low, high) = sections.offsets();
            let (one, other) = (options.planes.to_the_left(low), options.planes.to_the_left(high));
            let ([.., bottom], [.., top]) = mesh.bounds();
            making.floor = options.floor.unwrap_or(bottom);
            let cutter = DropCutter::new(mesh, ball);
            Ok((Ground::Mesh { mesh, sections, cutter }, bottom, top, Some((one.min(other), one.max(other)))))
        }
    }
}

fn slice(making: &Making, ground: &Ground<'_>, options: &Options, offset: f64) -> Slice {
    match (ground, options.against) {
        (Ground::Profile { dense, tips }, _) => {
            Slice { offset, ground: Some(dense.clone()), tips: tips.clone() }
        }
        (Ground::Mesh { sections, .. }, Against::Profile) => making.in_plane(sections, offset),
        (Ground::Mesh { sections, cutter, .. }, Against::Mesh) => making.over_mesh(sections, cutter, offset),
    }
}

/// Tracks plane by plane, in the order and direction in which they are cut.
fn tracks(slices: &[Slice], options: &Options, print: Print) -> Vec<Vec<Track>> {
    let mut back = false;
    let mut all = Vec::with_capacity(slices.len());
    for slice in slices {
        let least = options.tolerance * SHORT_SHARE;
        let track = |tip: &Chain| Track::new(tip, &options.planes, slice.offset, least, print);
        let mut tracks: Vec<Track> = if back {
            slice.tips.iter().rev().filter_map(|tip| track(&tip.reversed())).collect()
        } else {
            slice.tips.iter().filter_map(track).collect()
        };
        tracks.shrink_to_fit();
        back = options.pattern == Pattern::ZigZag && (back == tracks.is_empty());
        all.push(tracks);
    }
    all
}

fn prove(
    slices: &[Slice],
    tracks: &[Vec<Track>],
    ground: &Ground<'_>,
    options: &Options,
    print: Print,
) -> Proof {
    let space = match ground {
        Ground::Mesh { mesh, .. } => Some(Space::new(mesh, options.radius)),
        Ground::Profile { .. } => None,
    };
    let passes: Vec<Pass<'_>> = slices
        .iter()
        .zip(tracks)
        .flat_map(|(slice, tracks)| {
            tracks.iter().map(|track| Pass { offset: slice.offset, track, ground: slice.ground.as_ref() })
        })
        .collect();
    let look = Look {
        planes: &options.planes,
        radius: options.radius,
        tolerance: options.tolerance,
        print,
        space: space.as_ref(),
    };
    look.over(&passes)
}

/// From the end of a pass to the start of one in the next plane, over the surface; none where that is far or not known to be safe.
fn link(
    ground: &Ground<'_>,
    making: &Making,
    print: Print,
    near: f64,
    from: Point3<f64>,
    to: Point3<f64>,
) -> Option<Vec<Point3<f64>>> {
    let (start, end) = (print.in_mm(from), print.in_mm(to));
    let ends = [start, end].map(|[x, y, _]| [x, y]);
    let [[x0, y0], [x1, y1]] = ends;
    if (x1 - x0).hypot(y1 - y0) > near {
        return None;
    }
    match ground {
        Ground::Profile { .. } => {
            // The same place of a profile that is the same between the planes.
            let [a, b] = ends.map(|end| making.planes.along(end));
            let same = (a - b).abs() + (start[2] - end[2]).abs() <= 4.0 * print.last_decimal();
            same.then(|| vec![to])
        }
        Ground::Mesh { cutter, .. } => {
            let runs = cutter.follow(&ends, making.tolerance);
            let [run] = runs.as_slice() else { return None };
            // From end to end, or there is a hole in between.
            let whole = run
                .first()
                .zip(run.last())
                .is_some_and(|([a, b, _], [c, d, _])| ends == [[*a, *b], [*c, *d]]);
            let between = run.get(1..run.len().saturating_sub(1))?;
            let lifted = |[x, y, z]: &[f64; 3]| print.point([*x, *y, z.max(making.floor)]);
            whole.then(|| between.iter().map(lifted).chain([to]).collect())
        }
    }
}

/// The middle plane that has a pass.
fn figure(
    slices: &[Slice],
    tracks: &[Vec<Track>],
    ground: &Ground<'_>,
    making: &Making,
    print: Print,
) -> Option<(f64, Chain, Vec<Chain>)> {
    let with: Vec<(&Slice, &Vec<Track>)> =
        slices.iter().zip(tracks).filter(|(_, tracks)| !tracks.is_empty()).collect();
    let (slice, tracks) = with.get(with.len() / 2)?;
    let planes: &Planes = &making.planes;
    let line = match ground {
        Ground::Profile { dense, .. } => dense.clone(),
        Ground::Mesh { sections, .. } => making.in_plane(sections, slice.offset).ground?,
    };
    let tips = tracks.iter().filter_map(|track| track.flat(planes, print)).collect();
    Some((slice.offset, line, tips))
}
