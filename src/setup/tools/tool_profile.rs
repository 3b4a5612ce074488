//! This module makes the meridian of a tool from numbers of the CL file and of the setup, and finds setup entries that
//! no cutter can have.

use super::tool_entry::ToolEntry;
use crate::cutter::{Meridian, MeridianError};
use crate::setup::setup_reader::SetupReader;

/// The numbers of a meridian that the CL file or the setup says. Lengths are in mm, angles in radians.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProfileNumbers {
    pub diameter_mm: f64,
    pub corner_mm: f64,
    pub taper_rad: f64,
    pub tip_rad: f64,
    pub flute_length_mm: f64,
    pub upper_corner_mm: Option<f64>,
}

/// Makes the meridian, with its upper side if the cutter is narrower there. The CL file writes a flank that narrows
/// upwards as a taper below 0; `entry` may say a dovetail's angle and an upper corner.
///
/// # Errors
/// Returns the reason why no cutter has these numbers.
pub(super) fn make_profile(
    numbers: ProfileNumbers,
    entry: Option<&ToolEntry>,
) -> Result<Meridian, MeridianError> {
    let ProfileNumbers { diameter_mm, corner_mm, taper_rad, tip_rad, flute_length_mm, upper_corner_mm } =
        numbers;
    let own = entry.and_then(|entry| entry.dovetail_rad);
    let narrowing = own.or((taper_rad < 0.0).then_some(-taper_rad));
    let profile = match narrowing {
        Some(angle) => Meridian::dovetail(diameter_mm, corner_mm, angle, tip_rad, flute_length_mm)?,
        None => Meridian::new(diameter_mm, corner_mm, taper_rad, tip_rad, flute_length_mm)?,
    };
    match entry.and_then(|entry| entry.upper_corner_radius_mm).or(upper_corner_mm) {
        Some(radius_mm) => profile.with_upper_corner(radius_mm),
        None => Ok(profile),
    }
}

impl ToolEntry {
    /// Reports the upper side of a cutter that cannot be, if the entry itself says everything that this depends on.
    pub(super) fn check_upper_side(&self, reader: &mut SetupReader) {
        let key = match (self.upper_corner_radius_mm, self.dovetail_rad) {
            (Some(_), _) => "upper_corner_radius",
            (None, Some(_)) => "dovetail_angle",
            (None, None) => return,
        };
        let (Some(diameter_mm), Some(flute_length_mm)) =
            (self.diameter_mm.filter(|diameter| *diameter > 0.0), self.flute_length_mm)
        else {
            return;
        };
        let numbers = ProfileNumbers {
            diameter_mm,
            corner_mm: self.corner_radius_mm.unwrap_or(0.0),
            taper_rad: self.taper_rad.unwrap_or(0.0),
            tip_rad: self.tip_rad.unwrap_or(0.0),
            flute_length_mm,
            upper_corner_mm: None,
        };
        // A lower corner that is too large is reported at its own key.
        let is_corner = numbers.corner_mm > diameter_mm / 2.0;
        if let Err(error) = make_profile(numbers, Some(self))
            && !is_corner
        {
            let help = "`flute_length` is the height of the cutting part, with both corners; the diameter is that of \
                        the widest place.";
            let message = format!("no cutter has this upper side: {error}");
            reader.add_fault(|| self.place.at_key(key), &message, "does not fit", help);
        }
    }
}
