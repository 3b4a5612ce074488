//! A profile as it is written: what serde reads, and what the JSON schema tells editors.

use super::curves::{self, PieceFault};
use crate::diagnostic::{Diagnostic, codes};
use crate::parameters::{Degrees, Finite, LengthUnit, Positive};
use crate::source::Source;
use crate::surface::profile::Point;
use crate::surface_milling::SectionProfile;
use crate::yaml::{YamlDocument, YamlPathSegment};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// Whoever made more mistakes than this fixes the first ones first.
const MOST: usize = 20;

/// A profile in a vertical plane, for `clsmith section --profile`: places are [u, z], u along the pass and z up.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith profile file")]
struct ProfileFileText {
    /// The unit of every length in this file.
    #[serde(default)]
    units: LengthUnit,
    /// Over which width it is swept, from 0; `--from` and `--to` override it.
    width: Option<Positive>,
    /// Where it starts.
    start: [Finite; 2],
    /// Its pieces; each starts where the one before ends.
    #[schemars(length(min = 1))]
    pieces: Vec<PieceText>,
}

/// A piece of a profile.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Piece")]
pub(super) enum PieceText {
    /// A straight line to a place.
    Line([Finite; 2]),
    /// Straight lines from place to place.
    Polyline(Vec<[Finite; 2]>),
    /// An arc of a circle: by `radius` (the shorter way round unless `long`), or by `centre`.
    Arc(ArcText),
    /// An arc of an ellipse.
    Ellipse(EllipseText),
    /// A rational B-spline, from where the piece before ends.
    Nurbs(NurbsText),
}

/// Which way a curve turns, going along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Turn")]
pub(super) enum CurveTurnText {
    /// From +u towards +z: a hollow, going to +u.
    Left,
    /// From +u towards -z: a hill, going to +u.
    Right,
}

/// An arc of a circle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Arc")]
pub(super) struct ArcText {
    /// Where it ends.
    pub to: [Finite; 2],
    /// Its radius; or give `centre`.
    pub radius: Option<Positive>,
    /// Its centre; or give `radius`.
    pub centre: Option<[Finite; 2]>,
    /// Which way it turns.
    pub turn: CurveTurnText,
    /// With `radius`: the longer way round.
    #[serde(default)]
    pub long: bool,
}

/// An arc of an ellipse.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Ellipse")]
pub(super) struct EllipseText {
    /// Where it ends.
    pub to: [Finite; 2],
    /// Its centre.
    pub centre: [Finite; 2],
    /// Half its axes; the first along `tilt`.
    pub semi_axes: [Positive; 2],
    /// Angle of the first axis from +u towards +z, degrees.
    pub tilt: Option<Degrees>,
    /// Which way it turns.
    pub turn: CurveTurnText,
}

/// A rational B-spline.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Nurbs")]
pub(super) struct NurbsText {
    /// Control points after the first one, which is where the piece starts.
    pub points: Vec<[Finite; 2]>,
    /// Its degree; 3 if not given.
    pub degree: Option<u8>,
    /// A weight for each control point, the first one included; all 1 if not given.
    pub weights: Option<Vec<Positive>>,
    /// All knots: as many as control points, degree and 1 together; clamped and even if not given.
    pub knots: Option<Vec<Finite>>,
}

pub(super) fn make_profile_schema() -> serde_json::Value {
    schemars::schema_for!(ProfileFileText).to_value()
}

pub(super) fn read_profile(source: &Arc<Source>) -> Result<SectionProfile, Vec<Diagnostic>> {
    let document = YamlDocument::parse(source).map_err(|diagnostic| vec![*diagnostic])?;
    let file: ProfileFileText = document.deserialize_checked(|_| None)?;
    let scale = file.units.mm_per_unit();
    let [u, z] = file.start.map(|value| value.get() * scale);
    let mut at = Point::new(u, z);
    let mut found = Vec::new();
    let mut profile =
        SectionProfile { curves: Vec::new(), width: file.width.map(|width| width.get() * scale) };
    if file.pieces.is_empty() {
        found.push(locate_fault(
            &document,
            &[YamlPathSegment::Key("pieces")],
            &PieceFault::new("the profile has no piece", "empty"),
        ));
    }
    for (index, piece) in file.pieces.iter().enumerate() {
        match curves::build_curves(piece, at, scale) {
            Ok(curves) => {
                if let Some(end) = curves.last().map(curves::curve_end) {
                    at = end;
                }
                profile.curves.extend(curves);
            }
            Err(wrong) => {
                let kind = piece.yaml_key();
                let mut path = vec![
                    YamlPathSegment::Key("pieces"),
                    YamlPathSegment::Index(index),
                    YamlPathSegment::Key(kind),
                ];
                path.extend(wrong.key.map(YamlPathSegment::Key));
                path.extend(wrong.index.map(YamlPathSegment::Index));
                found.push(locate_fault(&document, &path, &wrong));
                // What comes after starts where this piece was to end.
                at = curves::meant_end(piece, scale).unwrap_or(at);
            }
        }
        if found.len() >= MOST {
            break;
        }
    }
    if found.is_empty() { Ok(profile) } else { Err(found) }
}

fn locate_fault(document: &YamlDocument, path: &[YamlPathSegment<'_>], wrong: &PieceFault) -> Diagnostic {
    let paths = (0..=path.len()).rev().filter_map(|count| path.get(..count));
    let span = paths.filter_map(|path| document.value_span(path)).next().unwrap_or_default();
    let found = Diagnostic::new(codes::BAD_VALUE, wrong.message.clone()).with_label(
        document.source(),
        span,
        wrong.label,
    );
    match &wrong.help {
        Some(help) => found.with_help(help.clone()),
        None => found,
    }
}

impl PieceText {
    fn yaml_key(&self) -> &'static str {
        match self {
            Self::Line(_) => "line",
            Self::Polyline(_) => "polyline",
            Self::Arc(_) => "arc",
            Self::Ellipse(_) => "ellipse",
            Self::Nurbs(_) => "nurbs",
        }
    }
}
