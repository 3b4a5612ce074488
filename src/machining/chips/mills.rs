//! Which tools of a program are flat end mills, and why the others are not.

use crate::chips::FlatMill;
use crate::sim::Cutter;

/// Lengths in mm and angles in radians below which a corner, a taper or a point is none: no grinder could make it.
const NONE: f64 = 1e-6;

/// A cutter as a flat end mill.
///
/// # Errors
/// What it has that a flat end mill has not, to be read after "tool 3 has".
pub fn flat(cutter: &Cutter) -> Result<FlatMill, String> {
    let profile = &cutter.profile;
    if profile.bottom_angle() > NONE {
        return Err(format!("a bottom that is {:.1} degrees from flat", profile.bottom_angle().to_degrees()));
    }
    if profile.corner_radius() > NONE {
        let ball = profile.bottom_radius() <= NONE;
        let what = if ball { "a ball of radius" } else { "a corner radius of" };
        return Err(format!("{what} {} mm", short(profile.corner_radius())));
    }
    if profile.taper() > NONE {
        return Err(format!("a taper of {:.2} degrees", profile.taper().to_degrees()));
    }
    Ok(FlatMill { radius: profile.radius(), flutes: profile.height() })
}

fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
