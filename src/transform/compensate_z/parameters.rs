//! The parameters of `compensate_z`.

use crate::parameters::{FilePath, Positive};
use crate::recipe::MotionFilter;
use schemars::JsonSchema;
use serde::Deserialize;

/// Puts the tip of a ball-nose cutter where the ball touches the part, for a path that was programmed on the part itself.
///
/// The points of such a path are contact points; driven as they are, the ball cuts too deep on every slope. `against: profile` takes each
/// pass in a vertical plane (between its leads, links and rapids) as the part's profile and writes the envelope of the ball over
/// it: no gouge in hollow corners, arcs about sharp ones, as few chords as the tolerance allows, arcs where the file has one to
/// write them like. `against: normals` moves each point by its own contact normal (nine-value GOTO), in three to five axes.
/// `against: { mesh: part.stl }` lowers the cutter onto a model along the pass seen from above, so that heights are right in
/// space; there it may be a bull-nose or flat cutter, too.
///
/// With `input: tip` (or `centre`) the path was made for a ball of `was_radius`: its contact is recovered and compensated anew, for a
/// reground cutter. Leads, links and rapids move with the ends of their passes. The result is measured by other means than it
/// was made, and the step fails when gouge or gap pass the tolerance.
///
/// Not idempotent with `input: contact`: a second run would take tips for contacts.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompensateZ {
    /// Radius of the ball, in the recipe's unit; else that of the tool in the setup or in the CL file.
    pub radius: Option<Positive>,
    /// What the points of the path are.
    #[serde(default)]
    pub input: InputPointKind,
    /// What they shall be.
    #[serde(default)]
    pub output: OutputPointKind,
    /// Radius of the ball that the path was made for, where `input` is `tip` or `centre`; in the recipe's unit.
    pub was_radius: Option<Positive>,
    /// Allowed gouge and gap, in the recipe's unit; 0.005 mm when left out.
    pub tolerance: Option<Positive>,
    /// What the cutter is compensated against.
    #[serde(default)]
    pub against: CompensationReference,
    /// Whether arcs are written as arcs where the file has a record for them.
    #[serde(default)]
    pub arcs: ArcOutput,
    /// Which motions; all cuts when it is left out.
    #[serde(default)]
    pub r#where: MotionFilter,
}

/// What the points of a path are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InputPointKind {
    /// Points of the part, where the cutter shall touch it.
    #[default]
    Contact,
    /// The tip (south pole) of the ball `was_radius`.
    Tip,
    /// The centre of the ball `was_radius`.
    Centre,
}

/// What points become.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OutputPointKind {
    /// The tip (south pole) of the cutter.
    #[default]
    Tip,
    /// The centre of the ball.
    Centre,
}

/// What the cutter is compensated against.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CompensationReference {
    /// The pass itself, as the part's profile in its vertical plane.
    #[default]
    Profile,
    /// The contact normals of the points.
    Normals,
    /// An STL file, relative to the recipe, in the coordinates and unit of the CL file.
    Mesh(FilePath),
}

/// Whether arcs are written as arcs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ArcOutput {
    /// Where the file has an arc that tells its sense to write them like: a CIRCLE (NX, SolidWorks, Makino), or INDIRV and TLON (CATIA).
    #[default]
    Keep,
    /// As chords.
    Chords,
}
