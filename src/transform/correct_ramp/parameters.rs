//! The parameters of `correct_ramp`.

use super::tool_region;
use crate::parameters::{Finite, NonNegative, Positive};
use crate::recipe::MotionFilter;
use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// Corrects ramp approaches whose legs are too short or too steep for an indexable cutter, which does not cut around its axis.
///
/// With D the cutter's diameter, r the radius of its inserts' bottom circle and h their cutting height, a leg has to be at least D - 2r
/// long across the tool axis (a helix that wide), and no steeper than atan(h / (D - 2r)). A ramp that is not gets longer legs (on
/// the circle through its ends; where that leaves the region on the mirror side, along its chord, or along the first cutting pass; a
/// helix is widened), begins lower where `depth_of_cut` says that there is only air, and descends in more passes. It is then
/// measured again, as written.
///
/// A ramp is a descent at feed that ends where cutting at that level begins: by the file's own marks (PAINT/COLOR engage, leads)
/// where it has them, else by geometry in operations that mostly cut level. Drilling cycles, turning and surfaces have none. Start (across the
/// axis) and end of a ramp stay, so does every statement outside. A second run changes nothing.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CorrectRamp {
    /// The cutter; what is left out comes from `setup.tools` (`insert:`) and from the CL file.
    pub tool: Option<RampToolSpec>,
    /// Largest depth of cut A_p, in the recipe's unit. A steep ramp then begins at `depth_of_cut` + `clearance` above its end; without it, it
    /// begins where it did.
    pub depth_of_cut: Option<Positive>,
    /// How far above the depth of cut a ramp may begin, in the recipe's unit; 2.5 mm when left out.
    pub clearance: Option<NonNegative>,
    /// Where the tool's centre may go: where its disc covers only what the operation itself cuts at the ramp's level; the hull of that
    /// cutting, which also spans islands and, around an outside contour, the part; anywhere; or a polygon.
    #[serde(default)]
    pub region: RampRegionSpec,
    /// What becomes of a ramp that cannot be corrected: an error, so that nothing is written, or it is kept with a warning.
    #[serde(default)]
    pub if_impossible: ImpossibleRampHandling,
    /// Straight descents: corrected into ramps, or kept with a warning, where they go down beside the stock.
    #[serde(default)]
    pub plunges: PlungeHandling,
    /// Which motions; all when it is left out. A ramp is meant when its first descending motion is.
    #[serde(default)]
    pub r#where: MotionFilter,
}

/// The cutter of a `correct_ramp` step; what is left out comes from the setup and from the CL file.
#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RampToolSpec {
    /// Diameter D.
    pub diameter: Option<Positive>,
    /// Radius r of the insert's bottom circle.
    pub insert_radius: Option<Positive>,
    /// Cutting height h of the insert.
    pub insert_height: Option<Positive>,
}

/// Where the tool's centre may go.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RampRegionSpec {
    /// Where the tool covers only what the operation cuts at the ramp's level, or what the ramp itself covers.
    #[default]
    Milled,
    /// The convex hull of what the operation cuts at the ramp's level and of the ramp itself. For pockets without islands: around an
    /// outside contour the part lies inside.
    Hull,
    /// Anywhere.
    None,
    /// Within a polygon of `[x, y]` corners, in the recipe's unit and the coordinates of the CL file (with a tilted tool, across its axis).
    Polygon(#[serde(deserialize_with = "read_corners")] Vec<[Finite; 2]>),
}

/// What becomes of a ramp that cannot be corrected.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ImpossibleRampHandling {
    /// Nothing is written.
    #[default]
    Error,
    /// It stays as it is, with a warning.
    Keep,
}

/// What becomes of straight descents.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlungeHandling {
    /// They become ramps.
    #[default]
    Correct,
    /// They stay as they are, with a warning.
    Keep,
}

fn read_corners<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<[Finite; 2]>, D::Error> {
    let corners = Vec::<[Finite; 2]>::deserialize(deserializer)?;
    let places: Vec<[f64; 2]> = corners.iter().map(|corner| corner.map(Finite::get)).collect();
    tool_region::ToolRegion::from_polygon(&places).map_err(|error| {
        D::Error::custom(format!(
            "{error}\nGive its corners in order, once around: [[x, y], [x, y], [x, y]]."
        ))
    })?;
    Ok(corners)
}
