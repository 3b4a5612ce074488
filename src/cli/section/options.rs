//! This module reads the options of `clsmith section` and reports all faults at once.

use super::SectionArgs;
use super::command_line::CommandLine;
use clsmith::diagnostic::Failure;
use clsmith::program::Dialect;
use clsmith::surface_milling::{PassPlanes, SurfaceMillingOptions, SurfaceProgramWords};
use std::path::Path;

/// The smallest radius of the ball, and the smallest step and tolerance, in mm. Below them, the results would
/// be dominated by rounding.
const SMALLEST: f64 = 1e-2;
const FINEST: f64 = 1e-4;

/// The least distance between the end of a rapid and the part, in mm, and the lowest feed (mm/min) and
/// spindle speed (rev/min).
const NEAREST: f64 = 0.1;
const SLOWEST: f64 = 0.01;

impl SectionArgs {
    /// Returns the options, and how much larger than the model the billet is, mm.
    pub(super) fn check_options(&self) -> Result<(SurfaceMillingOptions, f64), Failure> {
        let mut line = CommandLine::from_process(self.units);
        let unit = self.units.mm_per_unit();
        let planes = self.parse_planes(&mut line);
        let step =
            parse_required_size_mm(&mut line, "--step", self.step.as_deref(), "how far planes are apart");
        let radius =
            parse_required_size_mm(&mut line, "--radius", self.radius.as_deref(), "the ball's radius");
        let feed =
            parse_required_size_mm(&mut line, "--feed", self.feed.as_deref(), "how fast passes are cut");
        let tolerance = line.parse_size_mm("--tolerance", self.tolerance.as_deref());
        for (option, value, least) in
            [("--radius", radius, SMALLEST), ("--step", step, FINEST), ("--tolerance", tolerance, FINEST)]
        {
            if value.is_some_and(|value| value < least) {
                line.add_fault(
                    option,
                    format!("{option} is less than {} {}", least / unit, self.units),
                    "too small",
                );
            }
        }
        let range = self.parse_plane_range_mm(&mut line);
        let clearance = line.parse_size_mm("--clearance", self.clearance.as_deref());
        let approach = line.parse_distance_mm("--approach", self.approach.as_deref());
        let plunge = line.parse_size_mm("--plunge", self.plunge.as_deref());
        let floor = line.parse_coordinate_mm("--floor", self.floor.as_deref());
        let air = match self.between.as_str() {
            "rapid" => None,
            feed => line.parse_size_mm("--between", Some(feed)),
        };
        let spindle = line.parse_positive("--spindle", self.spindle.as_deref());
        for (option, value, least) in [("--clearance", clearance, NEAREST), ("--approach", approach, NEAREST)]
        {
            if value.is_some_and(|value| value < least) {
                let message = format!(
                    "{option} is less than {} {}: a rapid would end on the part",
                    least / unit,
                    self.units
                );
                line.add_fault(option, message, "too small");
            }
        }
        let rates = [("--feed", feed), ("--plunge", plunge), ("--between", air), ("--spindle", spindle)];
        for (option, value) in rates {
            if value.is_some_and(|value| value < SLOWEST) {
                line.add_fault(
                    option,
                    format!("{option} is less than {SLOWEST}: it would be printed as zero"),
                    "too slow",
                );
            }
        }
        let allowance = line.parse_distance_mm("--allowance", self.allowance.as_deref());
        let operation = line.parse_name("--operation", self.operation.as_deref());
        let tool_name = line.parse_name("--tool-name", self.tool_name.as_deref());
        let found = line.into_findings();
        let (Some(planes), Some(step), Some(radius), Some(feed), []) =
            (planes, step, radius, feed, found.as_slice())
        else {
            return Err(found.into());
        };
        let words = SurfaceProgramWords::new(self.choose_dialect(), program_name(self.input_path()));
        let left_out = SurfaceMillingOptions::new(step, radius, feed, words);
        let options = SurfaceMillingOptions {
            planes,
            range_mm: range,
            tolerance_mm: tolerance.unwrap_or(left_out.tolerance_mm),
            against: self.against.into(),
            pattern: self.pattern.into(),
            arcs: self.arcs,
            floor_mm: floor,
            clearance_mm: clearance.unwrap_or(left_out.clearance_mm),
            approach_mm: approach.unwrap_or(left_out.approach_mm),
            plunge_feed_mm_min: plunge.unwrap_or(left_out.plunge_feed_mm_min),
            air_feed_mm_min: air,
            words: SurfaceProgramWords {
                units: self.units,
                operation: operation.unwrap_or(left_out.words.operation),
                tool: self.tool,
                tool_name,
                spindle_rpm: spindle,
                coolant: self.coolant,
                ..left_out.words
            },
            ..left_out
        };
        Ok((options, allowance.unwrap_or_default()))
    }

    fn parse_planes(&self, line: &mut CommandLine) -> Option<PassPlanes> {
        match self.plane.to_ascii_lowercase().as_str() {
            "zx" | "xz" => Some(PassPlanes::ZX),
            "yz" | "zy" => Some(PassPlanes::YZ),
            angle => {
                let fits = angle.parse::<f64>().ok().filter(|angle| angle.abs() <= 360.0);
                if fits.is_none() {
                    let message = format!(
                        "--plane is zx, yz or an angle from -360 to 360 degrees, not `{}`",
                        self.plane
                    );
                    line.add_fault("--plane", message, "no plane");
                }
                fits.map(PassPlanes::from_degrees)
            }
        }
    }

    /// Reads the first and the last plane. Returns `None` if they are not given, and adds a fault if only one
    /// is.
    fn parse_plane_range_mm(&self, line: &mut CommandLine) -> Option<(f64, f64)> {
        let (from, to) = (
            line.parse_coordinate_mm("--from", self.from.as_deref()),
            line.parse_coordinate_mm("--to", self.to.as_deref()),
        );
        match (&self.from, &self.to) {
            (Some(_), None) => line.add_missing("--to", "--from only gives the first plane"),
            (None, Some(_)) => line.add_missing("--from", "--to only gives the last plane"),
            _ => {}
        }
        from.zip(to)
    }

    /// Returns the requested dialect, else that of the output's extension, else NX.
    fn choose_dialect(&self) -> Dialect {
        // Creo adds a version to its names: `op010.ncl.1`.
        let version =
            |path: &&Path| path.extension().is_some_and(|end| end.to_string_lossy().parse::<u32>().is_ok());
        let output = self.output.as_deref();
        let unversioned = output.filter(version).map(|path| path.with_extension(""));
        let extension = unversioned.as_deref().or(output).and_then(Path::extension);
        let extension = extension.map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        self.dialect.unwrap_or(match extension.as_deref() {
            Some("aptsource" | "apt") => Dialect::Catia,
            Some("ncl") => Dialect::Creo,
            _ => Dialect::Nx,
        })
    }
}

fn parse_required_size_mm(
    line: &mut CommandLine,
    option: &'static str,
    text: Option<&str>,
    what: &str,
) -> Option<f64> {
    if text.is_none() {
        line.add_missing(option, what);
    }
    line.parse_size_mm(option, text)
}

/// Makes a name for the program that every dialect can contain, from the name of its input.
fn program_name(input: &Path) -> String {
    let stem = input.file_stem().unwrap_or_default().to_string_lossy().to_ascii_uppercase();
    let plain: String =
        stem.chars().take(40).map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.is_empty() { "PART".to_owned() } else { plain }
}
