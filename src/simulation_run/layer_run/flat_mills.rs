//! This module finds which tools of a program are flat end mills, and why the others are not.

use crate::cutter::CutterModel;
use crate::layered_chips::FlatMill;
use crate::number::format_short_decimal;

/// The length in mm and the angle in radians below which a corner radius, a taper or a tip angle counts as
/// none. No grinder could make it.
const NONE: f64 = 1e-6;

/// Converts a cutter to a flat end mill.
///
/// # Errors
/// Returns the property that makes it no flat end mill, to be read after "tool 3 has".
pub fn to_flat_mill(cutter: &CutterModel) -> Result<FlatMill, String> {
    let profile = &cutter.profile;
    if profile.bottom_angle_rad() > NONE {
        return Err(format!(
            "a bottom that is {:.1} degrees from flat",
            profile.bottom_angle_rad().to_degrees()
        ));
    }
    if profile.corner_radius_mm() > NONE {
        let ball = profile.bottom_radius_mm() <= NONE;
        let what = if ball { "a ball of radius" } else { "a corner radius of" };
        return Err(format!("{what} {} mm", format_short_decimal(profile.corner_radius_mm(), 4)));
    }
    if profile.taper_rad() > NONE {
        return Err(format!("a taper of {:.2} degrees", profile.taper_rad().to_degrees()));
    }
    Ok(FlatMill { radius: profile.radius_mm(), flutes: profile.height_mm() })
}
