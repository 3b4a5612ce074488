//! What the CL file tells about a tool's shape, brought to one form whatever its word.

use crate::program::LengthUnit;
use crate::program::record::{ToolData, ToolWord};
use crate::setup::setup_reader::SMALLEST;
use std::f64::consts::FRAC_PI_2;

/// Numbers of CL files have four decimals or more, so a ball's corner radius may miss half its diameter by this, in the
/// file's unit.
const ROUNDING: f64 = 1e-4;

/// What the CL file tells, in mm and radians.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct FileToolData {
    /// Whether the file tells of a lathe tool, a wire or the like.
    pub other: bool,
    pub diameter_mm: Option<f64>,
    pub corner_radius_mm: Option<f64>,
    pub taper_rad: Option<f64>,
    /// Angle of the bottom against the plane.
    pub tip_rad: Option<f64>,
    pub flute_length_mm: Option<f64>,
    /// Length of the tool below its holder.
    pub length_mm: Option<f64>,
    /// By how much numbers may be off for having been printed, in mm.
    pub rounding_mm: f64,
}

impl FileToolData {
    pub fn from_tool_data(data: Option<&ToolData>, units: LengthUnit) -> Self {
        let rounding = ROUNDING * units.mm_per_unit();
        let Some(data) = data else { return Self { rounding_mm: rounding, ..Self::default() } };
        let to_mm = |value: Option<f64>| value.map(|value| value * units.mm_per_unit());
        // CAM systems write 0 for a length that nobody has filled in; what is rounded away is as good as 0.
        let length = |value: Option<f64>| to_mm(value).filter(|value| *value >= SMALLEST);
        let drill = data.word == ToolWord::TlDataDrill;
        let tip = match data.tip_degrees {
            // A point angle of 0 is a field that nobody has filled in: reamers, taps.
            Some(point) if drill => (point > 0.0).then(|| FRAC_PI_2 - point.to_radians() / 2.0),
            tip => tip.map(f64::to_radians),
        };
        // A diameter of 0 is a field that nobody has filled in, too, but for a cone.
        let cone = data.diameter == Some(0.0) && data.taper_degrees.is_some_and(|taper| taper > 0.0);
        Self {
            other: data.word == ToolWord::TlDataOther,
            diameter_mm: length(data.diameter).or(cone.then_some(0.0)),
            corner_radius_mm: to_mm(data.corner_radius),
            // A drill's flank is its bore's: it has no taper to tell.
            taper_rad: data.taper_degrees.map(f64::to_radians).or(drill.then_some(0.0)),
            tip_rad: tip,
            flute_length_mm: length(data.flute_length),
            length_mm: length(data.length),
            rounding_mm: rounding,
        }
    }
}
