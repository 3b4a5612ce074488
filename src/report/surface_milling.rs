//! This module reports a program that was made to mill a surface: findings, a summary, and the drawing of one
//! plane.

use super::path_drawing::{PanelPath, PanelPathStyle, PathPanel, draw_path_panels};
use crate::diagnostic::{Diagnostic, codes};
use crate::number::{format_point, format_trimmed_number};
use crate::program::LengthUnit;
use crate::surface::profile::{Chain, ChainPiece, Point, check_tip_path};
use crate::surface_milling::{SurfaceMillingOptions, SurfaceProgram};
use crate::write::new_program::can_write_arcs;
use std::fmt::Write;
use std::io;

/// The number of chords per radian with which arcs are drawn.
const CHORDS: f64 = 24.0;

/// Returns the findings about a program over a surface: those that prevent writing it, and those that its
/// user should know.
pub fn collect_findings(surfaced: &SurfaceProgram, options: &SurfaceMillingOptions) -> Vec<Diagnostic> {
    let units = options.words.units;
    let proof = &surfaced.proof;
    let mut found = Vec::new();
    if !proof.is_within(options.tolerance_mm) {
        let worse = if proof.gouge_mm >= proof.gap_mm {
            format!(
                "the deepest gouge is {} {units} at {}",
                format_fine_length(proof.gouge_mm, units),
                format_point_in_units(proof.gouge_at_mm, units)
            )
        } else {
            format!(
                "the largest gap is {} {units} at {}",
                format_fine_length(proof.gap_mm, units),
                format_point_in_units(proof.gap_at_mm, units)
            )
        };
        let tolerance = format_fine_length(options.tolerance_mm, units);
        let message = format!("{worse}, more than the tolerance of {tolerance} {units}");
        found.push(Diagnostic::new(codes::NOT_WITHIN_TOLERANCE, message));
    }
    if options.words.spindle_rpm.is_none() {
        let message = "no `--spindle` is given, so the program has no spindle speed";
        found.push(Diagnostic::new(codes::SECTION_WITHOUT_SPINDLE, message));
    }
    let left = surfaced.unreached.iter().max_by(|a, b| a.left_mm.total_cmp(&b.left_mm));
    if let Some(most) = left {
        let count = surfaced.unreached.len();
        let places = if count == 1 { "one place".to_owned() } else { format!("{count} places") };
        let [u, z, left] =
            [most.from.u, most.from.z, most.left_mm].map(|length_mm| length_mm / units.mm_per_unit());
        let message = format!(
            "the ball does not touch {places} of the profile; most, {left:.4} {units}, is left at {}",
            format_point([u, z], 4)
        );
        found.push(Diagnostic::new(codes::NOT_REACHED, message));
    }
    found
}

/// Returns a summary of a few lines. `name` is the name of the program.
pub fn to_text(surfaced: &SurfaceProgram, options: &SurfaceMillingOptions, name: &str) -> String {
    let units = options.words.units;
    let mm_per_unit = units.mm_per_unit();
    let mut text = String::new();
    let (planes, passes) = (surfaced.planes, surfaced.passes);
    let planes = if planes == 1 {
        "1 plane".to_owned()
    } else {
        format!("{planes} planes {:.4} {units} apart", surfaced.spacing_mm / mm_per_unit)
    };
    let passes = if passes == 1 { "1 pass".to_owned() } else { format!("{passes} passes") };
    let cutting = surfaced.cutting_length_mm() / mm_per_unit;
    let _ = writeln!(
        text,
        "{name}: {planes}, {passes}, {cutting:.0} {units} of cutting in {} motions",
        surfaced.cutting_motion_count()
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
        format_fine_length(proof.gouge_mm, units),
        format_point_in_units(proof.gouge_at_mm, units),
        format_fine_length(proof.gap_mm, units),
        format_point_in_units(proof.gap_at_mm, units),
        format_fine_length(options.tolerance_mm, units),
        format_fine_length(proof.bound_mm, units),
    );
    let _ = writeln!(
        text,
        "left between passes on level ground: {} {units}",
        format_fine_length(surfaced.scallop_height_mm(options.radius_mm), units)
    );
    if options.arcs && !can_write_arcs(options.words.dialect) {
        let _ = writeln!(text, "arcs are chords: how {} turns them is not known", options.words.dialect);
    }
    text
}

/// Draws the middle plane as SVG: the line of the part, the path of the tip, and for comparison the points of
/// the part shifted one by one, which gouges. A second panel shows the place where the shifted points gouge
/// deepest.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_middle_plane(surfaced: &SurfaceProgram, options: &SurfaceMillingOptions) -> io::Result<String> {
    let Some((offset, line, tips)) = &surfaced.figure else { return Ok(String::new()) };
    let units = options.words.units;
    let mm_per_unit = units.mm_per_unit();
    let radius = options.radius_mm;
    let shifted = shift_contact_points(line, radius);
    let wrong =
        Chain::from_points(&shifted).ok().map(|naive| check_tip_path(line, &naive, radius, radius / 200.0));
    let scaled = |points: &[Point]| -> Vec<(f64, f64)> {
        points.iter().map(|point| (point.u / mm_per_unit, point.z / mm_per_unit)).collect()
    };
    let path = |name: &str, look, points: &[Point]| PanelPath {
        name: name.to_owned(),
        look,
        points: scaled(points),
    };
    let paths = |named: bool| {
        let name = |name: &'static str| if named { name } else { "" };
        let mut paths = vec![
            path(name("part"), PanelPathStyle::Reference, &sample_chain(line)),
            path(name("points shifted one by one"), PanelPathStyle::Wrong, &shifted),
        ];
        for (index, tip) in tips.iter().enumerate() {
            paths.push(path(
                if index == 0 { name("tip") } else { "" },
                PanelPathStyle::After,
                &sample_chain(tip),
            ));
        }
        paths
    };
    let panel = |title: String, paths| PathPanel {
        title,
        right: abscissa_title(units).to_owned(),
        up: ordinate_title(units).to_owned(),
        one_scale: true,
        paths,
    };
    let title = format!(
        "plane at {:.3}, ball of radius {} {units}",
        offset / mm_per_unit,
        format_fine_length(radius, units)
    );
    let mut panels = vec![panel(title, paths(true))];
    if let Some(wrong) = wrong.filter(|wrong| wrong.gouge_mm > options.tolerance_mm) {
        let (at, half) = (wrong.gouge_at, 1.2 * radius);
        let window = [at.u - half, at.u + half, at.z - half, at.z + half].map(|value| value / mm_per_unit);
        let close = paths(true).into_iter().flat_map(|path| clip_path(path, window));
        let title = format!(
            "where shifted points gouge deepest: {} {units}",
            format_fine_length(wrong.gouge_mm, units)
        );
        panels.push(panel(title, close.collect()));
    }
    // There is always the panel of the middle plane, so the drawing is never empty.
    Ok(draw_path_panels(&panels)?.unwrap_or_default())
}

/// Returns the parts of a path that are in a window, which is given by its least and largest abscissa and its
/// least and largest ordinate.
fn clip_path(path: PanelPath, [left, right, low, high]: [f64; 4]) -> Vec<PanelPath> {
    let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
    for pair in path.points.windows(2) {
        let [(u0, z0), (u1, z1)] = *pair else { continue };
        let (du, dz) = (u1 - u0, z1 - z0);
        // Liang and Barsky 1984: the line is inside between the last entry and the first exit across the four
        // sides, as fractions of its length.
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
    // All parts have a single entry in the legend.
    let name = |index: usize| if index == 0 { path.name.clone() } else { String::new() };
    let part = |(index, points)| PanelPath { name: name(index), look: path.look, points };
    parts.into_iter().enumerate().map(part).collect()
}

/// Shifts every contact point on its own to the tip of a ball of radius R: contact + R (n - z), with the
/// upward normal n and the unit vector z (Dragoi 2009, eq. (1) and (2)).
fn shift_contact_points(line: &Chain, radius: f64) -> Vec<Point> {
    let mut points = Vec::new();
    for piece in line.pieces() {
        let count = match piece {
            // The points are dense, so that a window shows all of the line.
            ChainPiece::Line(line) => {
                (line.from.distance(line.to) / radius * CHORDS).ceil().clamp(1.0, 2000.0)
            }
            ChainPiece::Arc(arc) => (arc.sweep_rad.abs() * CHORDS).ceil().max(1.0),
        };
        let mut part = 0.0;
        while part <= count {
            let (at, along) = (piece.point_at(part / count), piece.direction_at(part / count));
            // The normal is the tangent rotated to the left, or its opposite if that points down.
            let up = if along.u < 0.0 { -1.0 } else { 1.0 };
            points.push(Point::new(at.u - up * radius * along.z, at.z + up * radius * along.u - radius));
            part += 1.0;
        }
    }
    points
}

/// Returns a chain as points for a drawing.
fn sample_chain(chain: &Chain) -> Vec<Point> {
    let mut points = vec![chain.start()];
    for piece in chain.pieces() {
        let count = match piece {
            ChainPiece::Line(_) => 1.0,
            ChainPiece::Arc(arc) => (arc.sweep_rad.abs() * CHORDS).ceil().max(1.0),
        };
        let mut part = 1.0;
        while part <= count {
            points.push(piece.point_at(part / count));
            part += 1.0;
        }
    }
    points
}

fn abscissa_title(units: LengthUnit) -> &'static str {
    if units == LengthUnit::Inch { "u, inch" } else { "u, mm" }
}

fn ordinate_title(units: LengthUnit) -> &'static str {
    if units == LengthUnit::Inch { "z, inch" } else { "z, mm" }
}

/// Formats a small length in the program's unit, without trailing zeros.
fn format_fine_length(length_mm: f64, units: LengthUnit) -> String {
    format_trimmed_number(length_mm / units.mm_per_unit(), 6)
}

fn format_point_in_units(point_mm: [f64; 3], units: LengthUnit) -> String {
    format_point(point_mm.map(|length_mm| length_mm / units.mm_per_unit()), 3)
}
