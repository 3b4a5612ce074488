//! This module holds what a profile file says, as serde reads it, and makes the JSON schema that editors use.

use crate::parameters::{Degrees, Finite, LengthUnit, Positive};
use schemars::JsonSchema;
use serde::Deserialize;

/// A profile in a vertical plane, for `clsmith section --profile`. Points are [u, z], with u along the pass
/// and z up.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith profile file")]
pub(super) struct ProfileFileText {
    /// The unit of every length in this file.
    #[serde(default)]
    pub units: LengthUnit,
    /// The width over which the profile is swept, from 0; `--from` and `--to` override it.
    pub width: Option<Positive>,
    /// The point at which the profile starts.
    pub start: [Finite; 2],
    /// The pieces of the profile; each starts where the one before ends.
    #[schemars(length(min = 1))]
    pub pieces: Vec<PieceText>,
}

/// A piece of a profile.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Piece")]
pub(super) enum PieceText {
    /// A straight line to a point.
    Line([Finite; 2]),
    /// Straight lines from point to point.
    Polyline(Vec<[Finite; 2]>),
    /// An arc of a circle, given by `radius` (the shorter arc unless `long`) or by `centre`.
    Arc(ArcText),
    /// An arc of an ellipse.
    Ellipse(EllipseText),
    /// A rational B-spline that starts where the piece before ends.
    Nurbs(NurbsText),
}

/// The direction in which a curve turns, going along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Turn")]
pub(super) enum CurveTurnText {
    /// From +u towards +z; going to +u, this is a hollow.
    Left,
    /// From +u towards -z; going to +u, this is a hill.
    Right,
}

/// An arc of a circle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Arc")]
pub(super) struct ArcText {
    /// The point at which the arc ends.
    pub to: [Finite; 2],
    /// The radius; give either this or `centre`.
    pub radius: Option<Positive>,
    /// The centre; give either this or `radius`.
    pub centre: Option<[Finite; 2]>,
    /// The direction in which the arc turns.
    pub turn: CurveTurnText,
    /// With `radius`: take the longer arc.
    #[serde(default)]
    pub long: bool,
}

/// An arc of an ellipse.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Ellipse")]
pub(super) struct EllipseText {
    /// The point at which the arc ends.
    pub to: [Finite; 2],
    /// The centre of the ellipse.
    pub centre: [Finite; 2],
    /// Half the axes of the ellipse; the first one is along `tilt`.
    pub semi_axes: [Positive; 2],
    /// The angle of the first axis from +u towards +z, degrees.
    pub tilt: Option<Degrees>,
    /// The direction in which the arc turns.
    pub turn: CurveTurnText,
}

/// A rational B-spline.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Nurbs")]
pub(super) struct NurbsText {
    /// The control points after the first one, which is the start of the piece.
    pub points: Vec<[Finite; 2]>,
    /// The degree; 3 if not given.
    pub degree: Option<u8>,
    /// A weight for each control point, including the first one; all 1 if not given.
    pub weights: Option<Vec<Positive>>,
    /// All knots: as many as control points, degree and 1 together; clamped and even if not given.
    pub knots: Option<Vec<Finite>>,
}

pub(super) fn make_profile_schema() -> serde_json::Value {
    crate::yaml::make_file_schema::<ProfileFileText>("profile")
}

impl PieceText {
    pub(super) fn yaml_key(&self) -> &'static str {
        match self {
            Self::Line(_) => "line",
            Self::Polyline(_) => "polyline",
            Self::Arc(_) => "arc",
            Self::Ellipse(_) => "ellipse",
            Self::Nurbs(_) => "nurbs",
        }
    }
}
