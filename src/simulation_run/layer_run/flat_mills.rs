//! This module finds which tools of a program are flat end mills, and why the others are not.

use crate::cutter::CutterModel;
use crate::layered_chips::FlatMill;
use crate::number::format_trimmed_number;

/// The length in mm and the angle in radians below which a corner radius, a taper or a tip angle counts as
/// none. No grinder could make it.
const NONE: f64 = 1e-6;

/// The property that makes a cutter no flat end mill, to be read after "tool 3 has".
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub(crate) enum NotFlat {
    /// The bottom is a cone.
    #[error("a bottom that is {degrees:.1} degrees from flat")]
    Bottom {
        /// The angle between the bottom and a flat one.
        degrees: f64,
    },
    /// The bottom is a ball.
    #[error("a ball of radius {} mm", format_trimmed_number(*radius_mm, 4))]
    Ball {
        /// The radius of the ball, mm.
        radius_mm: f64,
    },
    /// The corner is round.
    #[error("a corner radius of {} mm", format_trimmed_number(*radius_mm, 4))]
    Corner {
        /// The radius of the corner, mm.
        radius_mm: f64,
    },
    /// The cutter is narrower above its widest place.
    #[error("a neck or a flank that narrows upwards")]
    Undercut,
    /// The middle does not cut.
    #[error("inserts that leave a middle of {} mm uncut", format_trimmed_number(*diameter_mm, 4))]
    DeadMiddle {
        /// The diameter of the middle, mm.
        diameter_mm: f64,
    },
    /// The flank is a cone.
    #[error("a taper of {degrees:.2} degrees")]
    Taper {
        /// The angle between the flank and the axis.
        degrees: f64,
    },
}

/// Converts a cutter to a flat end mill.
///
/// # Errors
/// Returns the property that makes it no flat end mill.
pub(crate) fn to_flat_mill(cutter: &CutterModel) -> Result<FlatMill, NotFlat> {
    let profile = &cutter.profile;
    if profile.top().is_some() {
        return Err(NotFlat::Undercut);
    }
    if let Some(middle) = profile.dead_middle() {
        return Err(NotFlat::DeadMiddle { diameter_mm: 2.0 * middle.radius_mm });
    }
    if profile.bottom_angle_rad() > NONE {
        return Err(NotFlat::Bottom { degrees: profile.bottom_angle_rad().to_degrees() });
    }
    if profile.corner_radius_mm() > NONE {
        let ball = profile.bottom_radius_mm() <= NONE;
        let radius_mm = profile.corner_radius_mm();
        return Err(if ball { NotFlat::Ball { radius_mm } } else { NotFlat::Corner { radius_mm } });
    }
    if profile.taper_rad() > NONE {
        return Err(NotFlat::Taper { degrees: profile.taper_rad().to_degrees() });
    }
    Ok(FlatMill { radius_mm: profile.radius_mm(), flute_length_mm: profile.height_mm() })
}
