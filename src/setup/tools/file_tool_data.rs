//! This module converts the data of a tool in the CL file into a single form, whatever its word.

use crate::program::LengthUnit;
use crate::program::record::{ToolData, ToolWord};
use crate::setup::setup_reader::SMALLEST_SIZE_MM;
use std::f64::consts::FRAC_PI_2;

/// CL files print at least four decimals, so the corner radius of a ball may differ from half its diameter by
/// this, in the file's unit.
const ROUNDING: f64 = 1e-4;

/// The data of the CL file, in mm and radians.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct FileToolData {
    /// Whether the file describes a lathe tool, a wire or the like.
    pub other: bool,
    pub diameter_mm: Option<f64>,
    pub corner_radius_mm: Option<f64>,
    pub taper_rad: Option<f64>,
    /// The angle between the bottom and the plane across the axis.
    pub tip_rad: Option<f64>,
    pub flute_length_mm: Option<f64>,
    /// The upper corner radius, of a cutter that is narrower above.
    pub upper_corner_mm: Option<f64>,
    /// The length of the tool below its holder.
    pub length_mm: Option<f64>,
    /// How far printed numbers may be off, in mm.
    pub rounding_mm: f64,
}

impl FileToolData {
    pub(super) fn from_tool_data(data: Option<&ToolData>, units: LengthUnit) -> Self {
        let rounding = ROUNDING * units.mm_per_unit();
        let Some(data) = data else { return Self { rounding_mm: rounding, ..Self::default() } };
        let to_mm = |value: Option<f64>| value.map(|value| value * units.mm_per_unit());
        // CAM systems write 0 for a length that nobody has entered, and a length that is rounded to nothing
        // is the same.
        let length = |value: Option<f64>| to_mm(value).filter(|value| *value >= SMALLEST_SIZE_MM);
        let drill = data.word == ToolWord::TlDataDrill;
        let tip = match data.tip_degrees {
            // A point angle of 0 is a field that nobody has entered, for example of reamers and taps.
            Some(point) if drill => (point > 0.0).then(|| FRAC_PI_2 - point.to_radians() / 2.0),
            tip => tip.map(f64::to_radians),
        };
        // A diameter of 0 is a field that nobody has filled in, too, but for a cone.
        let cone = data.diameter == Some(0.0) && data.taper_degrees.is_some_and(|taper| taper > 0.0);
        Self {
            other: data.word.is_no_mill(),
            diameter_mm: length(data.diameter).or(cone.then_some(0.0)),
            corner_radius_mm: to_mm(data.corner_radius),
            // The flank of a drill is the wall of its bore, so it has no taper.
            taper_rad: data.taper_degrees.map(f64::to_radians).or(drill.then_some(0.0)),
            tip_rad: tip,
            flute_length_mm: length(data.flute_length),
            upper_corner_mm: to_mm(data.upper_corner_radius),
            length_mm: length(data.length),
            rounding_mm: rounding,
        }
    }
}
