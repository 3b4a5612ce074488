//! The parameters of `move_origin`: axes, planes and turns, right once they are read.

use crate::program::LengthUnit;
use crate::transform::Affine;
use crate::values::{Degrees, Finite};
use nalgebra::{Unit, Vector3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Unexpected, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A place or step in the recipe's unit.
pub type Triple = [Finite; 3];

/// A direction: `x`, `y`, `z`, or any vector `[i, j, k]`, whose length does not matter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis(pub Unit<Vector3<f64>>);

/// A plane to mirror in: its normal alone (the plane holds the origin), or `{ normal: x, through: [0, 0, 0] }`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mirror {
    /// The plane's normal.
    pub normal: Axis,
    /// A point of the plane, in the recipe's unit.
    pub through: Vector3<f64>,
}

/// A turn about an axis.
#[derive(Debug, Clone, Copy, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rotate {
    /// Direction of the axis: `x`, `y`, `z` or `[i, j, k]`.
    pub axis: Axis,
    /// Angle in degrees, counter-clockwise when the axis points at you. Quarter turns are exact.
    pub degrees: Degrees,
    /// A point of the axis, in the recipe's unit; the origin when it is left out.
    pub about: Option<Triple>,
}

/// The numbers of a triple as a vector.
pub fn vector(triple: &Triple) -> Vector3<f64> {
    Vector3::from(triple.map(Finite::get))
}

/// Mirror, then rotation, then translation, in the file's unit.
pub fn affine(
    mirror: Option<&Mirror>,
    rotate: Option<&Rotate>,
    translate: Option<&Triple>,
    recipe: LengthUnit,
    file: LengthUnit,
) -> Affine {
    let scale = recipe.in_mm() / file.in_mm();
    let mut place = Affine::identity();
    if let Some(mirror) = mirror {
        place = place.then(Affine::mirror(mirror.normal.0, mirror.through * scale));
    }
    if let Some(rotate) = rotate {
        let about = rotate.about.as_ref().map(vector).unwrap_or_default() * scale;
        place = place.then(Affine::rotation(rotate.axis.0, rotate.degrees.get(), about));
    }
    if let Some(translate) = translate {
        place = place.then(Affine::translation(vector(translate) * scale));
    }
    place
}

const AXIS: &str = "`x`, `y`, `z` or a vector [i, j, k]";
const MIRROR: &str = "`x`, `y`, `z`, a vector [i, j, k], or `normal` and `through`";

fn of_name<E: Error>(name: &str, expected: &'static str) -> Result<Axis, E> {
    match name {
        "x" => Ok(Axis(Vector3::x_axis())),
        "y" => Ok(Axis(Vector3::y_axis())),
        "z" => Ok(Axis(Vector3::z_axis())),
        _ => Err(E::invalid_value(Unexpected::Str(name), &expected)),
    }
}

fn of_list<'de, A: SeqAccess<'de>>(list: A) -> Result<Axis, A::Error> {
    let vector = vector(&Triple::deserialize(SeqAccessDeserializer::new(list))?);
    let unit = Unit::try_new(vector, 1e-9).filter(|unit| unit.iter().all(|part| part.is_finite()));
    unit.map(Axis).ok_or_else(|| {
        A::Error::custom("the vector has no direction\nOne of its three numbers has to be different from 0.")
    })
}

impl<'de> Deserialize<'de> for Axis {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AxisVisitor;
        impl<'de> Visitor<'de> for AxisVisitor {
            type Value = Axis;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(AXIS)
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<Axis, E> {
                of_name(name, AXIS)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Axis, A::Error> {
                of_list(list)
            }
        }
        deserializer.deserialize_any(AxisVisitor)
    }
}

impl<'de> Deserialize<'de> for Mirror {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MirrorVisitor;
        impl<'de> Visitor<'de> for MirrorVisitor {
            type Value = Mirror;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(MIRROR)
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<Mirror, E> {
                of_name(name, MIRROR).map(|normal| Mirror { normal, through: Vector3::zeros() })
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Mirror, A::Error> {
                of_list(list).map(|normal| Mirror { normal, through: Vector3::zeros() })
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Mirror, A::Error> {
                let Plane { normal, through } = Plane::deserialize(MapAccessDeserializer::new(map))?;
                let through = through.as_ref().map(vector).unwrap_or_default();
                Ok(Mirror { normal, through })
            }
        }
        deserializer.deserialize_any(MirrorVisitor)
    }
}

/// A plane to mirror in.
#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Plane {
    /// The plane's normal.
    normal: Axis,
    /// A point of the plane, in the recipe's unit; the origin when it is left out.
    through: Option<Triple>,
}

impl JsonSchema for Axis {
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

impl JsonSchema for Mirror {
    fn schema_name() -> Cow<'static, str> {
        "Mirror".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (axis, plane) = (Axis::json_schema(generator), Plane::json_schema(generator));
        json_schema!({
            "description": "The plane to mirror in: its normal (the plane holds the origin), or its normal and a point of it.",
            "anyOf": [axis, plane],
        })
    }
}
