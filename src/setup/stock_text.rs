//! The stock as it is written.

use super::Place;
use super::reader::{Reader, SMALLEST};
use super::stock::{Body, BodyShape, FileRef, Stock};
use crate::diagnostic::codes;
use crate::values::{FilePath, Finite, NonNegative, Positive};
use schemars::JsonSchema;
use serde::Deserialize;

/// What there is before the first cut, in the coordinates of the CL file: exactly one of `block`, `cylinder`, `stl`,
/// `file`, or `bodies`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(
    rename = "Stock",
    extend("oneOf" = [
        { "required": ["block"] },
        { "required": ["cylinder"] },
        { "required": ["stl"] },
        { "required": ["file"] },
        { "required": ["bodies"] },
    ])
)]
pub(super) struct StockText {
    /// A block along the axes, by two opposite corners.
    block: Option<BlockText>,
    /// A cylinder in any direction, by the centres of its ends.
    cylinder: Option<CylinderText>,
    /// An STL file, relative to this file's folder; its numbers are in this file's unit.
    stl: Option<FilePath>,
    /// A .clstock file that an earlier run has saved, relative to this file's folder.
    file: Option<FilePath>,
    /// Several of them; the stock is all of them together.
    #[schemars(length(min = 1))]
    bodies: Option<Vec<BodyText>>,
    /// How much thicker than described the stock may be: the skin of a casting, which must not be taken for air.
    allowance: Option<NonNegative>,
}

/// A block along the axes, by two opposite corners.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Block")]
struct BlockText {
    /// One corner: x, y, z.
    from: [Finite; 3],
    /// The opposite corner: x, y, z.
    to: [Finite; 3],
}

/// A cylinder in any direction, by the centres of its ends.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Cylinder")]
struct CylinderText {
    /// Diameter.
    diameter: Positive,
    /// Centre of one end: x, y, z.
    from: [Finite; 3],
    /// Centre of the other end: x, y, z.
    to: [Finite; 3],
}

/// One body of the stock.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Body")]
enum BodyText {
    /// A block along the axes, by two opposite corners.
    Block(BlockText),
    /// A cylinder in any direction, by the centres of its ends.
    Cylinder(CylinderText),
    /// An STL file, relative to this file's folder; its numbers are in this file's unit.
    Stl(FilePath),
    /// A .clstock file that an earlier run has saved, relative to this file's folder.
    File(FilePath),
}

impl StockText {
    /// The stock in millimetres; `None` when something is wrong, which the reader then knows.
    pub(super) fn checked(self, reader: &mut Reader, place: Place) -> Option<Stock> {
        let allowance_mm =
            reader.mm_at(self.allowance.map(NonNegative::get), &place, "allowance").unwrap_or_default();
        let single = [
            self.block.map(|block| (BodyText::Block(block), "block")),
            self.cylinder.map(|cylinder| (BodyText::Cylinder(cylinder), "cylinder")),
            self.stl.map(|file| (BodyText::Stl(file), "stl")),
            self.file.map(|file| (BodyText::File(file), "file")),
        ];
        let mut kinds: Vec<&'static str> = single.iter().flatten().map(|(_, key)| *key).collect();
        kinds.extend(self.bodies.is_some().then_some("bodies"));
        match kinds.as_slice() {
            [] => {
                let message = "the stock is not described".to_owned();
                let help = "Add one of `block`, `cylinder`, `stl`, `file`, or `bodies` for several of them.";
                reader.key_fault(codes::MISSING_KEY, message, help, &[(place, "nothing that could be cut")]);
                return None;
            }
            [_] => {}
            [first, second, ..] => {
                let message = format!("the stock is described twice, by `{first}` and by `{second}`");
                let help =
                    "Keep one of them; or write `bodies: [ { block: … }, { stl: … } ]` for both together.";
                let keys = [(place.key(second), "described again here"), (place.key(first), "and here")];
                reader.key_fault(codes::BAD_VALUE, message, help, &keys);
                return None;
            }
        }
        let mut bodies: Vec<Body> = Vec::new();
        for (body, key) in single.into_iter().flatten() {
            bodies.push(body.checked(reader, place.key(key)));
        }
        let list = place.key("bodies");
        for (index, body) in self.bodies.into_iter().flatten().enumerate() {
            let key = body.key();
            bodies.push(body.checked(reader, list.index(index).key(key)));
        }
        if bodies.is_empty() {
            let help = "Add a body, `- block: { from: [x, y, z], to: [x, y, z] }`, or remove `stock`.";
            reader.fault(|| list, "the list of bodies is empty", "no body", help);
            return None;
        }
        Some(Stock { bodies, allowance_mm, place })
    }
}

impl BodyText {
    fn key(&self) -> &'static str {
        match self {
            Self::Block(_) => "block",
            Self::Cylinder(_) => "cylinder",
            Self::Stl(_) => "stl",
            Self::File(_) => "file",
        }
    }

    fn checked(self, reader: &mut Reader, place: Place) -> Body {
        let shape = match self {
            Self::Block(block) => block.checked(reader, &place),
            Self::Cylinder(cylinder) => cylinder.checked(reader, &place),
            Self::Stl(file) => {
                BodyShape::Stl { file: FileRef::new(&file, place.clone()), units: reader.units }
            }
            Self::File(file) => BodyShape::Saved(FileRef::new(&file, place.clone())),
        };
        Body { shape, place }
    }
}

impl BlockText {
    fn checked(self, reader: &mut Reader, place: &Place) -> BodyShape {
        let (from, to) = (point(self.from, reader, place, "from"), point(self.to, reader, place, "to"));
        let (mut low, mut high) = (from, to);
        for (index, name) in ["x", "y", "z"].into_iter().enumerate() {
            let (Some(low), Some(high)) = (low.get_mut(index), high.get_mut(index)) else { continue };
            if *low > *high {
                std::mem::swap(low, high);
            }
            if *high - *low < SMALLEST {
                let message =
                    format!("the block has no size in {name}: `from` and `to` have the same {name}");
                let help = "`from` and `to` are opposite corners; they differ in x, y and z.";
                reader.fault(|| place.key("to").index(index), message, "as in `from`", help);
            }
        }
        BodyShape::Block { low, high }
    }
}

impl CylinderText {
    fn checked(self, reader: &mut Reader, place: &Place) -> BodyShape {
        let diameter = reader.size(self.diameter, || place.key("diameter"));
        let (from, to) = (point(self.from, reader, place, "from"), point(self.to, reader, place, "to"));
        let length = from.iter().zip(&to).map(|(from, to)| (to - from).powi(2)).sum::<f64>().sqrt();
        if length < SMALLEST {
            let message = "the cylinder has no length: `from` and `to` are the same point";
            let help = "`from` and `to` are the centres of its two ends.";
            reader.fault(|| place.key("to"), message, "as `from`", help);
        }
        BodyShape::Cylinder { diameter, from, to }
    }
}

fn point(values: [Finite; 3], reader: &mut Reader, place: &Place, key: &'static str) -> [f64; 3] {
    let mut index = 0;
    values.map(|value| {
        let at = index;
        index += 1;
        reader.mm(value.get(), || place.key(key).index(at))
    })
}
