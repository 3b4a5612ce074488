//! This module holds the parameters of `correct_ramp`.

use super::step::CLEARANCE_MM;
use super::tool_region;
use crate::parameters::{Finite, NonNegative, Positive, describe_length_mm};
use crate::recipe::MotionFilter;
use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// Corrects ramp approaches whose legs are too short or too steep for an indexable cutter, which does not cut
/// around its axis.
///
/// With D as the cutter's diameter, r as the radius of its inserts' bottom circle and h as their cutting
/// height, a leg must be at least D - 2r long across the tool axis (a helix must be that wide), and no
/// steeper than atan(h / (D - 2r)). Chords that turn by less than 20 degrees are one curved leg, which is as long as its
/// two points that are farthest apart: so a polyline of short chords is no leg of a chord's length. A ramp that violates this gets longer legs: on the circle through its
/// ends, or where that leaves the region on the mirrored side, along its chord, or along the first cutting
/// pass. A helix is widened. The ramp begins lower where `depth_of_cut` shows that there is only air, and it
/// descends in more passes. Then it is measured again as it was written. Where none of this helps, it becomes an entry
/// straight down over a hole that the program has drilled before and that is at least D - 2r wide.
///
/// A ramp is a descent at feed that ends where cutting at that level begins. The file's own marks
/// (PAINT/COLOR engage, leads) tell where it has them. Otherwise, geometry tells in operations that mostly
/// cut level. Drilling cycles, turning and surfaces have no ramps. The start (across the axis) and the end of
/// a ramp stay, and so does every statement outside of it. A second run changes nothing.
///
/// ```yaml
/// version: 1
/// units: mm
/// setup:
///   tools:
///     - { match: {}, insert: { height: 4, radius: 6 } }
/// steps:
///   - correct_ramp: { depth_of_cut: 3, clearance: 2.5 }
/// ```
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CorrectRamp {
    /// The cutter. What is left out comes from `setup.tools` (`insert:`) and from the CL file.
    #[schemars(extend("x-default" = "the tool of the setup and the program"))]
    pub tool: Option<RampToolSpec>,
    /// How steep a ramp may be. `paper`: atan(h / (D - 2r)), as Zhou (2020) says. `survivable`: half of that tangent, so that
    /// the pillar that stays where a ramp turns back fits under the cutter, too; proved on a block of stock.
    #[serde(default)]
    pub limit: RampLimitRule,
    /// The largest depth of cut A_p, in the recipe's unit. A ramp that is too steep then begins at
    /// `depth_of_cut` + `clearance` above its end. Without it, the ramp begins where it did before.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "the height at which the ramp began"))]
    pub depth_of_cut: Option<Positive>,
    /// How far above the depth of cut a ramp may begin, in the recipe's unit; 2.5 mm when it is left out.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = describe_length_mm(CLEARANCE_MM)))]
    pub clearance: Option<NonNegative>,
    /// Where the tool's centre may go. `milled`: where its disc covers only what the operation itself cuts at
    /// the ramp's level. `hull`: within the convex hull of that, which also covers islands and, around an
    /// outside contour, the part. `none`: anywhere. Or a polygon.
    #[serde(default)]
    pub region: RampRegionSpec,
    /// What happens if a ramp cannot be corrected. `error` stops the step, so that nothing is written; `keep`
    /// leaves the ramp unchanged, with a warning.
    #[serde(default)]
    pub if_impossible: ImpossibleRampHandling,
    /// What happens to straight descents. `correct` makes ramps of them; `keep` leaves them unchanged, with a
    /// warning, for example where they go down beside the stock.
    #[serde(default)]
    pub plunges: PlungeHandling,
    /// Which motions are meant; all of them when it is left out. A ramp is meant if its first descending
    /// motion is.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: MotionFilter,
}

/// The cutter of a `correct_ramp` step. What is left out comes from the setup and from the CL file.
#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RampToolSpec {
    /// The diameter D.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "that of the setup or the program"))]
    pub diameter: Option<Positive>,
    /// The radius r of the insert's bottom circle.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "that of the setup"))]
    pub insert_radius: Option<Positive>,
    /// The cutting height h of the insert.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "that of the setup"))]
    pub insert_height: Option<Positive>,
}

/// Where the tool's centre may go.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RampRegionSpec {
    /// Where the tool covers only what the operation cuts at the ramp's level, or what the ramp itself
    /// covers.
    #[default]
    Milled,
    /// Within the convex hull of the ramp and of what the operation cuts at its level. This is for pockets
    /// without islands: around an outside contour, the hull holds the part.
    Hull,
    /// Anywhere.
    None,
    /// Within a polygon of `[x, y]` vertices, in the recipe's unit and the coordinates of the CL file (for a
    /// tilted tool, across its axis).
    #[schemars(extend("x-unit" = "the recipe's unit"))]
    Polygon(#[serde(deserialize_with = "read_vertices")] Vec<[Finite; 2]>),
}

/// How steep a ramp may be.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RampLimitRule {
    /// No steeper than atan(h / (D - 2r)), with legs of at least D - 2r. Where a ramp turns back by 180 degrees, the
    /// pillar under the middle is then up to twice as high as the inserts clear.
    #[default]
    Paper,
    /// A ramp stays as it is if no pillar under the middle is higher than the inserts clear. Else it gets legs of at
    /// least D - 2r and a tangent of at most h / (2 (D - 2r)), and is cut out of a block to prove it.
    Survivable,
}

/// What happens if a ramp cannot be corrected.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ImpossibleRampHandling {
    /// The step fails, and nothing is written.
    #[default]
    Error,
    /// The ramp stays unchanged, with a warning.
    Keep,
}

/// What happens to straight descents.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlungeHandling {
    /// They become ramps.
    #[default]
    Correct,
    /// They stay as they are, with a warning.
    Keep,
}

fn read_vertices<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<[Finite; 2]>, D::Error> {
    let vertices = Vec::<[Finite; 2]>::deserialize(deserializer)?;
    let places: Vec<[f64; 2]> = vertices.iter().map(|vertex| vertex.map(Finite::get)).collect();
    tool_region::ToolRegion::from_polygon(&places).map_err(|error| {
        D::Error::custom(format!(
            "{error}\nGive its vertices in order, once around the region: [[x, y], [x, y], [x, y]]."
        ))
    })?;
    Ok(vertices)
}
