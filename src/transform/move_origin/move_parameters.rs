//! This module holds the parameters of `move_origin`: axes, planes and rotations. They are valid once they
//! are read.

use crate::parameters::{Degrees, Finite};
use crate::program::LengthUnit;
use crate::transform::Affine;
use nalgebra::{Unit, Vector3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Unexpected, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A point or a displacement in the recipe's unit.
pub type VectorSpec = [Finite; 3];

/// A direction: `x`, `y`, `z`, or any vector `[i, j, k]`, whose length does not matter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionSpec(pub Unit<Vector3<f64>>);

/// A plane of a mirror: its normal alone (the plane goes through the origin), or `{ normal: x, through: [0,
/// 0, 0] }`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MirrorSpec {
    /// The plane's normal.
    pub normal: DirectionSpec,
    /// A point of the plane, in the recipe's unit.
    pub through: Vector3<f64>,
}

/// A rotation about an axis.
#[derive(Debug, Clone, Copy, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotationSpec {
    /// The direction of the axis: `x`, `y`, `z` or `[i, j, k]`.
    #[schemars(extend("x-unit" = "none (a direction of any length)"))]
    pub axis: DirectionSpec,
    /// The angle in degrees, counter-clockwise when the axis points at you. Quarter turns are exact.
    pub degrees: Degrees,
    /// A point of the axis, in the recipe's unit; the origin when it is left out.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "the origin"))]
    pub about: Option<VectorSpec>,
}

/// Returns three numbers as a vector.
pub(super) fn vector_from_spec(triple: &VectorSpec) -> Vector3<f64> {
    Vector3::from(triple.map(Finite::get))
}

/// Combines mirror, then rotation, then translation into a single transform, in the file's unit.
pub(super) fn compose_affine(
    mirror: Option<&MirrorSpec>,
    rotate: Option<&RotationSpec>,
    translate: Option<&VectorSpec>,
    recipe: LengthUnit,
    file: LengthUnit,
) -> Affine {
    let scale = recipe.mm_per_unit() / file.mm_per_unit();
    let mut place = Affine::identity();
    if let Some(mirror) = mirror {
        place = place.then(Affine::mirror(mirror.normal.0, mirror.through * scale));
    }
    if let Some(rotate) = rotate {
        let about = rotate.about.as_ref().map(vector_from_spec).unwrap_or_default() * scale;
        place = place.then(Affine::rotation(rotate.axis.0, rotate.degrees.get(), about));
    }
    if let Some(translate) = translate {
        place = place.then(Affine::translation(vector_from_spec(translate) * scale));
    }
    place
}

const AXIS: &str = "`x`, `y`, `z` or a vector [i, j, k]";
const MIRROR: &str = "`x`, `y`, `z`, a vector [i, j, k], or `normal` and `through`";

fn direction_from_name<E: Error>(name: &str, expected: &'static str) -> Result<DirectionSpec, E> {
    match name {
        "x" => Ok(DirectionSpec(Vector3::x_axis())),
        "y" => Ok(DirectionSpec(Vector3::y_axis())),
        "z" => Ok(DirectionSpec(Vector3::z_axis())),
        _ => Err(E::invalid_value(Unexpected::Str(name), &expected)),
    }
}

fn direction_from_list<'de, A: SeqAccess<'de>>(list: A) -> Result<DirectionSpec, A::Error> {
    let vector = vector_from_spec(&VectorSpec::deserialize(SeqAccessDeserializer::new(list))?);
    let unit = Unit::try_new(vector, 1e-9).filter(|unit| unit.iter().all(|part| part.is_finite()));
    unit.map(DirectionSpec).ok_or_else(|| {
        A::Error::custom("the vector has no direction\nAt least one of its three numbers must differ from 0.")
    })
}

impl<'de> Deserialize<'de> for DirectionSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AxisVisitor;
        impl<'de> Visitor<'de> for AxisVisitor {
            type Value = DirectionSpec;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(AXIS)
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<DirectionSpec, E> {
                direction_from_name(name, AXIS)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<DirectionSpec, A::Error> {
                direction_from_list(list)
            }
        }
        deserializer.deserialize_any(AxisVisitor)
    }
}

impl<'de> Deserialize<'de> for MirrorSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MirrorVisitor;
        impl<'de> Visitor<'de> for MirrorVisitor {
            type Value = MirrorSpec;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(MIRROR)
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<MirrorSpec, E> {
                direction_from_name(name, MIRROR)
                    .map(|normal| MirrorSpec { normal, through: Vector3::zeros() })
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<MirrorSpec, A::Error> {
                direction_from_list(list).map(|normal| MirrorSpec { normal, through: Vector3::zeros() })
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MirrorSpec, A::Error> {
                let MirrorPlaneSpec { normal, through } =
                    MirrorPlaneSpec::deserialize(MapAccessDeserializer::new(map))?;
                let through = through.as_ref().map(vector_from_spec).unwrap_or_default();
                Ok(MirrorSpec { normal, through })
            }
        }
        deserializer.deserialize_any(MirrorVisitor)
    }
}

/// A plane of a mirror.
#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MirrorPlaneSpec {
    /// The plane's normal.
    #[schemars(extend("x-unit" = "none (a direction of any length)"))]
    normal: DirectionSpec,
    /// A point of the plane, in the recipe's unit; the origin when it is left out.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "the origin"))]
    through: Option<VectorSpec>,
}

impl JsonSchema for DirectionSpec {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Axis".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "`x`, `y`, `z`, or a vector of any length.",
            "anyOf": [
                { "enum": ["x", "y", "z"] },
                { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
            ],
        })
    }
}

impl JsonSchema for MirrorSpec {
    fn schema_name() -> Cow<'static, str> {
        "Mirror".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (axis, plane) = (DirectionSpec::json_schema(generator), MirrorPlaneSpec::json_schema(generator));
        json_schema!({
            "description": "The plane of the mirror: its normal (the plane goes through the origin), or its normal and a point of it.",
            "anyOf": [axis, plane],
        })
    }
}
