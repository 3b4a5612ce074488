//! What was made over a surface: findings, a summary, and the drawing of one plane.

use super::picture::{Look, Panel, Path, draw};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::LengthUnit;
use crate::surface::profile::{Chain, Piece, Point, check};
use crate::surfacing::{Options, Surfaced};
use crate::write::program::holds_arcs;
use std::fmt::Write;
use std::io;

/// Arcs are drawn in so many chords a radian.
const CHORDS: f64 = 24.0;

/// What stands in the way of writing it, and what its user should know.
pub fn findings(surfaced: &Surfaced, options: &Options) -> Vec<Diagnostic> {
    let units = options.words.units;
    let proof = &surfaced.proof;
    let mut found = Vec::new();
    if !proof.holds(options.tolerance) {
        let worse = if proof.gouge >= proof.gap {
            format!(
                "the deepest gouge is {} {units} at {}",
                fine(proof.gouge, units),
                place(proof.gouge_at, units)
            )
        } else {
            format!("the largest gap is {} {units} at {}", fine(proof.gap, units), place(proof.gap_at, units))
        };
        let tolerance = fine(options.tolerance, units);
        let message = format!("{worse}, more than the tolerance of {tolerance} {units}");
        found.push(Diagnostic::new(codes::NOT_WITHIN_TOLERANCE, message));
    }
    if options.words.spindle.is_none() {
        let message = "no `--spindle` is given, so the program says no spindle speed";
        found.push(Diagnostic::new(codes::SECTION_WITHOUT_SPINDLE, message));
    }
    let left = surfaced.unreached.iter().max_by(|a, b| a.left.total_cmp(&b.left));
    if let Some(most) = left {
        let count = surfaced.unreached.len();
        let places = if count == 1 { "one place".to_owned() } else { format!("{count} places") };
        let [u, z, left] = [most.from.u, most.from.z, most.left].map(|mm| mm / units.in_mm());
        let message = format!(
            "the ball does not touch {places} of the profile; most, {left:.4} {units}, is left at ({u:.4}, {z:.4})"
        );
        found.push(Diagnostic::new(codes::NOT_REACHED, message));
    }
    found
}

/// The summary, a few lines.
pub fn to_text(surfaced: &Surfaced, options: &Options, name: &str) -> String {
    let units = options.words.units;
    let mm = units.in_mm();
    let mut text = String::new();
    let (planes, passes) = (surfaced.planes, surfaced.passes);
    let planes = if planes == 1 {
        "1 plane".to_owned()
    } else {
        format!("{planes} planes {:.4} {units} apart", surfaced.spacing / mm)
    };
    let passes = if passes == 1 { "1 pass".to_owned() } else { format!("{passes} passes") };
    let cutting = surfaced.cutting_mm() / mm;
    let _ = writeln!(
        text,
        "{name}: {planes}, {passes}, {cutting:.0} {units} of cutting in {} motions",
        surfaced.cuts()
    );
    if surfaced.empty > 0 {
        let _ = writeln!(
            text,
            "{} planes beside these meet nothing of the part: a flank that faces across the planes is not cut",
            surfaced.empty
        );
    }
    let proof = &surfaced.proof;
    let _ = writeln!(
        text,
        "deepest gouge {} {units} at {}, largest gap {} {units} at {}; tolerance {}, the check may miss {}",
        fine(proof.gouge, units),
        place(proof.gouge_at, units),
        fine(proof.gap, units),
        place(proof.gap_at, units),
        fine(options.tolerance, units),
        fine(proof.bound, units),
    );
    let _ = writeln!(
        text,
        "left between passes on level ground: {} {units}",
        fine(surfaced.scallop(options.radius), units)
    );
    if options.arcs && !holds_arcs(options.words.dialect) {
        let _ = writeln!(text, "arcs are chords: how {} turns them is not known", options.words.dialect);
    }
    text
}

/// The middle plane: the part's line, its points shifted one by one (which gouges), and the tip's path; and the same where shifting gouges
/// deepest.
///
/// # Errors
/// What the drawing library returns, which for a drawing in memory is nothing.
pub fn plot(surfaced: &Surfaced, options: &Options) -> io::Result<String> {
    let Some((offset, line, tips)) = &surfaced.figure else { return Ok(String::new()) };
    let units = options.words.units;
    let mm = units.in_mm();
    let radius = options.radius;
    let shifted = shifted(line, radius);
    let wrong = Chain::polyline(&shifted).ok().map(|naive| check(line, &naive, radius, radius / 200.0));
    let scaled = |points: &[Point]| -> Vec<(f64, f64)> {
        points.iter().map(|point| (point.u / mm, point.z / mm)).collect()
    };
    let path =
        |name: &str, look, points: &[Point]| Path { name: name.to_owned(), look, points: scaled(points) };
    let paths = |named: bool| {
        let name = |name: &'static str| if named { name } else { "" };
        let mut paths = vec![
            path(name("part"), Look::Reference, &drawn(line)),
            path(name("points shifted one by one"), Look::Wrong, &shifted),
        ];
        for (index, tip) in tips.iter().enumerate() {
            paths.push(path(if index == 0 { name("tip") } else { "" }, Look::After, &drawn(tip)));
        }
        paths
    };
    let panel =
        |title: String, paths| Panel { title, right: right(units), up: up(units), one_scale: true, paths };
    let title = format!("plane at {:.3}, ball of radius {} {units}", offset / mm, fine(radius, units));
    let mut panels = vec![panel(title, paths(true))];
    if let Some(wrong) = wrong.filter(|wrong| wrong.gouge > options.tolerance) {
        let (at, half) = (wrong.gouge_at, 1.2 * radius);
        let window = [at.u - half, at.u + half, at.z - half, at.z + half].map(|value| value / mm);
        let close = paths(true).into_iter().flat_map(|path| clipped(path, window));
        let title = format!("where shifted points gouge deepest: {} {units}", fine(wrong.gouge, units));
        panels.push(panel(title, close.collect()));
    }
    Ok(draw(&panels)?.unwrap_or_default())
}

/// The parts of a path in a window (least and most to the right, least and most up).
fn clipped(path: Path, [left, right, low, high]: [f64; 4]) -> Vec<Path> {
    let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
    for pair in path.points.windows(2) {
        let [(u0, z0), (u1, z1)] = *pair else { continue };
        let (du, dz) = (u1 - u0, z1 - z0);
        // From which share of the line to which it is inside all four sides (Liang and Barsky 1984).
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for (across, inside) in [(-du, u0 - left), (du, right - u0), (-dz, z0 - low), (dz, high - z0)] {
            let share = inside / across;
            if across < 0.0 {
                from = from.max(share);
            } else if across > 0.0 {
                to = to.min(share);
            } else if inside < 0.0 {
                to = -1.0;
            }
        }
        if from > to {
            continue;
        }
        let [start, end] = [from, to].map(|share| (u0 + du * share, z0 + dz * share));
        match parts.last_mut().filter(|part| part.last() == Some(&start)) {
            Some(part) => part.push(end),
            None => parts.push(vec![start, end]),
        }
    }
    // One entry in the legend for all parts.
    let name = |index: usize| if index == 0 { path.name.clone() } else { String::new() };
    let part = |(index, points)| Path { name: name(index), look: path.look, points };
    parts.into_iter().enumerate().map(part).collect()
}

/// Every contact point by itself: contact + R (n - z), n the upward normal (Dragoi 2009, eq. (1) and (2)).
fn shifted(line: &Chain, radius: f64) -> Vec<Point> {
    let mut points = Vec::new();
    for piece in line.pieces() {
        let count = match piece {
            // Dense, so that a window shows all of it.
            Piece::Line(line) => (line.from.distance(line.to) / radius * CHORDS).ceil().clamp(1.0, 2000.0),
            Piece::Arc(arc) => (arc.sweep.abs() * CHORDS).ceil().max(1.0),
        };
        let mut part = 0.0;
        while part <= count {
            let (at, along) = (piece.point(part / count), piece.direction(part / count));
            // Turned to the left, and up.
            let up = if along.u < 0.0 { -1.0 } else { 1.0 };
            points.push(Point::new(at.u - up * radius * along.z, at.z + up * radius * along.u - radius));
            part += 1.0;
        }
    }
    points
}

/// A chain as points to draw.
fn drawn(chain: &Chain) -> Vec<Point> {
    let mut points = vec![chain.start()];
    for piece in chain.pieces() {
        let count = match piece {
            Piece::Line(_) => 1.0,
            Piece::Arc(arc) => (arc.sweep.abs() * CHORDS).ceil().max(1.0),
        };
        let mut part = 1.0;
        while part <= count {
            points.push(piece.point(part / count));
            part += 1.0;
        }
    }
    points
}

fn right(units: LengthUnit) -> &'static str {
    if units == LengthUnit::Inch { "u, inch" } else { "u, mm" }
}

fn up(units: LengthUnit) -> &'static str {
    if units == LengthUnit::Inch { "z, inch" } else { "z, mm" }
}

/// A small length, to four digits that count, without zeros behind.
fn fine(mm: f64, units: LengthUnit) -> String {
    let value = mm / units.in_mm();
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() { "0".to_owned() } else { text.to_owned() }
}

fn place([x, y, z]: [f64; 3], units: LengthUnit) -> String {
    let [x, y, z] = [x, y, z].map(|mm| mm / units.in_mm());
    format!("({x:.3}, {y:.3}, {z:.3})")
}
