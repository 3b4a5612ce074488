//! This module holds the parameters of `compensate_z`.

use super::compensation_job::TOLERANCE_MM;
use crate::parameters::{FilePath, Positive, describe_length_mm};
use crate::recipe::MotionFilter;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Puts the tip of a ball-nose cutter where the ball touches the part, for a path that was programmed on the
/// part itself.
///
/// The points of such a path are contact points. If the tip is driven to them, the ball cuts too deep on
/// every slope. `against: profile` takes each pass in a vertical plane (between its leads, links and rapids)
/// as the profile of the part and writes the envelope of the ball over it. That gives no gouge in concave
/// corners, arcs around sharp ones, as few chords as the tolerance allows, and arcs where the file has an arc
/// to model them on. `against: normals` moves each point along its own contact normal (GOTO with nine
/// values), in three to five axes. `against: { mesh: part.stl }` lowers the cutter onto a model along the
/// pass as seen from above, so that the heights are right in space. There, the cutter may also be a bull-nose
/// or a flat one.
///
/// With `input: tip` (or `centre`), the path was made for a ball of `was_radius`. Its contact points are
/// recovered and compensated anew, for example for a reground cutter. Leads, links and rapids move with the
/// ends of their passes. The result is measured by another method than the one that made it, and the step
/// fails if gouge or gap exceed the tolerance.
///
/// The step is not idempotent with `input: contact`: a second run would take tips for contact points.
///
/// ```yaml
/// version: 1
/// units: mm
/// steps:
///   # The path has the points of the part; a ball of this radius shall touch them.
///   - compensate_z: { radius: 5 }
/// ```
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompensateZ {
    /// The radius of the ball, in the recipe's unit. Without it, the radius of the tool in the setup or in
    /// the CL file counts.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "that of the tool"))]
    pub radius: Option<Positive>,
    /// What the points of the path are: contact points, tips or centres.
    #[serde(default)]
    pub input: InputPointKind,
    /// What the points of the path become: tips or centres.
    #[serde(default)]
    pub output: OutputPointKind,
    /// The radius of the ball that the path was made for, in the recipe's unit. It is needed with `input:
    /// tip` or `input: centre`.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "none; needed unless `input` is `contact`"))]
    pub was_radius: Option<Positive>,
    /// The allowed gouge and gap, in the recipe's unit; 0.005 mm when it is left out.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = describe_length_mm(TOLERANCE_MM)))]
    pub tolerance: Option<Positive>,
    /// What the cutter is compensated against: the profile of the pass, contact normals or a model.
    #[serde(default)]
    pub against: CompensationReference,
    /// Whether arcs are written as arcs where the file has a record for them, or as chords.
    #[serde(default)]
    pub arcs: ArcOutput,
    /// Which motions are meant; all cuts when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "all cuts"))]
    pub r#where: MotionFilter,
}

/// What the points of a path are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InputPointKind {
    /// The points lie on the part, where the cutter has to touch it.
    #[default]
    Contact,
    /// The points are the tip (south pole) of the ball of `was_radius`.
    Tip,
    /// The points are the centre of the ball of `was_radius`.
    Centre,
}

/// What the points of the path become.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OutputPointKind {
    /// They become the tip (south pole) of the cutter.
    #[default]
    Tip,
    /// They become the centre of the ball.
    Centre,
}

/// What the cutter is compensated against.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CompensationReference {
    /// The pass itself is the profile of the part in its vertical plane.
    #[default]
    Profile,
    /// Each point has its own contact normal.
    Normals,
    /// An STL file is the model, in the coordinates and the unit of the CL file. Its path is relative to the
    /// recipe.
    Mesh(FilePath),
}

/// How arcs are written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ArcOutput {
    /// As arcs, if the file has an arc of known sense on which they can be modelled: a CIRCLE (NX,
    /// SolidWorks, Makino), or INDIRV and TLON (CATIA). Otherwise they become chords.
    #[default]
    Keep,
    /// As chords.
    Chords,
}
