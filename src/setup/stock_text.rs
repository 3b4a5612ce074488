//! This module holds the stock as it is written.

use super::YamlLocation;
use super::setup_reader::{SMALLEST_SIZE_MM, SetupReader};
use super::stock::{BilletAllowances, BilletShape, FileRef, SetupStock, StockBody, StockBodyShape};
use crate::diagnostic::codes;
use crate::parameters::{FilePath, Finite, NonNegative, Positive};
use schemars::JsonSchema;
use serde::Deserialize;

/// The stock before the first cut, in the coordinates of the CL file. Exactly one of `block`, `cylinder`,
/// `stl`, `around`, `file` and `bodies` is given.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(
    rename = "Stock",
    extend("oneOf" = [
        { "required": ["block"] },
        { "required": ["cylinder"] },
        { "required": ["stl"] },
        { "required": ["around"] },
        { "required": ["file"] },
        { "required": ["bodies"] },
    ])
)]
pub(super) struct StockText {
    /// A block along the axes, given by two opposite vertices.
    block: Option<BlockText>,
    /// A cylinder in any direction, given by the centres of its ends.
    cylinder: Option<CylinderText>,
    /// An STL file, relative to this file's folder. Its numbers are in this file's unit.
    stl: Option<FilePath>,
    /// A billet around a model, with allowances.
    around: Option<AroundText>,
    /// A .clstock file that an earlier run has saved, relative to this file's folder.
    file: Option<FilePath>,
    /// Several bodies. The stock is the union of all of them.
    #[schemars(length(min = 1))]
    bodies: Option<Vec<BodyText>>,
    /// How much thicker than described the stock may be: the skin of a casting, which must not be taken for
    /// air.
    allowance: Option<NonNegative>,
}

/// A block along the axes, given by two opposite vertices.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Block")]
struct BlockText {
    /// One vertex: x, y, z.
    from: [Finite; 3],
    /// The opposite vertex: x, y, z.
    to: [Finite; 3],
}

/// A cylinder in any direction, given by the centres of its ends.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Cylinder")]
struct CylinderText {
    /// The diameter.
    diameter: Positive,
    /// The centre of one end: x, y, z.
    from: [Finite; 3],
    /// The centre of the other end: x, y, z.
    to: [Finite; 3],
}

/// A billet around a model.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Around")]
struct AroundText {
    /// The STL file of the model, relative to this file's folder. Its numbers are in this file's unit.
    model: FilePath,
    /// What the billet is larger at every side; 0 when it is left out.
    #[schemars(extend("x-default" = "none"))]
    allowance: Option<NonNegative>,
    /// What it is larger above, instead of `allowance`.
    #[schemars(extend("x-default" = "allowance"))]
    top: Option<NonNegative>,
    /// What it is larger below, instead of `allowance`.
    #[schemars(extend("x-default" = "allowance"))]
    bottom: Option<NonNegative>,
    /// Its shape: a block along the axes, or a cylinder along z.
    #[serde(default)]
    shape: BilletShape,
}

/// One body of the stock.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Body")]
enum BodyText {
    /// A block along the axes, given by two opposite vertices.
    Block(BlockText),
    /// A cylinder in any direction, given by the centres of its ends.
    Cylinder(CylinderText),
    /// An STL file, relative to this file's folder. Its numbers are in this file's unit.
    Stl(FilePath),
    /// A billet around a model, with allowances.
    Around(AroundText),
    /// A .clstock file that an earlier run has saved, relative to this file's folder.
    File(FilePath),
}

impl StockText {
    /// Returns the stock in millimetres. Returns `None` if it has a fault, which the reader then holds.
    pub(super) fn check_stock(self, reader: &mut SetupReader, place: YamlLocation) -> Option<SetupStock> {
        let allowance_mm = reader
            .optional_length_mm(self.allowance.map(NonNegative::get), &place, "allowance")
            .unwrap_or_default();
        let single = [
            self.block.map(|block| (BodyText::Block(block), "block")),
            self.cylinder.map(|cylinder| (BodyText::Cylinder(cylinder), "cylinder")),
            self.stl.map(|file| (BodyText::Stl(file), "stl")),
            self.around.map(|around| (BodyText::Around(around), "around")),
            self.file.map(|file| (BodyText::File(file), "file")),
        ];
        let mut kinds: Vec<&'static str> = single.iter().flatten().map(|(_, key)| *key).collect();
        kinds.extend(self.bodies.is_some().then_some("bodies"));
        match kinds.as_slice() {
            [] => {
                let message = "the stock is not described".to_owned();
                let help = "Add one of `block`, `cylinder`, `stl`, `around`, `file`, or `bodies` for several of them.";
                reader.add_key_fault(
                    codes::MISSING_KEY,
                    message,
                    help,
                    &[(place, "nothing that could be cut")],
                );
                return None;
            }
            [_] => {}
            [first, second, ..] => {
                let message = format!("the stock is described twice, by `{first}` and by `{second}`");
                let help =
                    "Keep one of them; or write `bodies: [ { block: … }, { stl: … } ]` for both together.";
                let keys =
                    [(place.at_key(second), "described again here"), (place.at_key(first), "and here")];
                reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
                return None;
            }
        }
        let mut bodies: Vec<StockBody> = Vec::new();
        for (body, key) in single.into_iter().flatten() {
            bodies.push(body.check_body(reader, place.at_key(key)));
        }
        let list = place.at_key("bodies");
        for (index, body) in self.bodies.into_iter().flatten().enumerate() {
            let key = body.yaml_key();
            bodies.push(body.check_body(reader, list.at_index(index).at_key(key)));
        }
        if bodies.is_empty() {
            let help = "Add a body, `- block: { from: [x, y, z], to: [x, y, z] }`, or remove `stock`.";
            reader.add_fault(|| list, "the list of bodies is empty", "no body", help);
            return None;
        }
        Some(SetupStock { bodies, allowance_mm, place })
    }
}

impl BodyText {
    fn yaml_key(&self) -> &'static str {
        match self {
            Self::Block(_) => "block",
            Self::Cylinder(_) => "cylinder",
            Self::Stl(_) => "stl",
            Self::Around(_) => "around",
            Self::File(_) => "file",
        }
    }

    fn check_body(self, reader: &mut SetupReader, place: YamlLocation) -> StockBody {
        let shape = match self {
            Self::Block(block) => block.check_block(reader, &place),
            Self::Cylinder(cylinder) => cylinder.check_cylinder(reader, &place),
            Self::Stl(file) => {
                StockBodyShape::Stl { file: FileRef::new(&file, place.clone()), units: reader.units }
            }
            Self::Around(around) => around.check_billet(reader, &place),
            Self::File(file) => StockBodyShape::Saved(FileRef::new(&file, place.clone())),
        };
        StockBody { shape, place }
    }
}

impl AroundText {
    fn check_billet(self, reader: &mut SetupReader, place: &YamlLocation) -> StockBodyShape {
        let mut length = |value: Option<NonNegative>, key: &'static str| {
            reader.optional_length_mm(value.map(NonNegative::get), place, key)
        };
        let all = length(self.allowance, "allowance").unwrap_or_default();
        let top_mm = length(self.top, "top").unwrap_or(all);
        let bottom_mm = length(self.bottom, "bottom").unwrap_or(all);
        StockBodyShape::Around {
            file: FileRef::new(&self.model, place.at_key("model")),
            units: reader.units,
            allowances: BilletAllowances { sides_mm: all, top_mm, bottom_mm },
            shape: self.shape,
        }
    }
}

impl BlockText {
    fn check_block(self, reader: &mut SetupReader, place: &YamlLocation) -> StockBodyShape {
        let (from, to) =
            (check_point_mm(self.from, reader, place, "from"), check_point_mm(self.to, reader, place, "to"));
        let (mut low, mut high) = (from, to);
        for (index, name) in ["x", "y", "z"].into_iter().enumerate() {
            let (Some(low), Some(high)) = (low.get_mut(index), high.get_mut(index)) else { continue };
            if *low > *high {
                std::mem::swap(low, high);
            }
            if *high - *low < SMALLEST_SIZE_MM {
                let message =
                    format!("the block has no size in {name}: `from` and `to` have the same {name}");
                let help = "`from` and `to` are opposite vertices, so they differ in x, y and z.";
                reader.add_fault(|| place.at_key("to").at_index(index), message, "as in `from`", help);
            }
        }
        StockBodyShape::Block { low, high }
    }
}

impl CylinderText {
    fn check_cylinder(self, reader: &mut SetupReader, place: &YamlLocation) -> StockBodyShape {
        let diameter = reader.size_mm(self.diameter, || place.at_key("diameter"));
        let (from, to) =
            (check_point_mm(self.from, reader, place, "from"), check_point_mm(self.to, reader, place, "to"));
        let length = from.iter().zip(&to).map(|(from, to)| (to - from).powi(2)).sum::<f64>().sqrt();
        if length < SMALLEST_SIZE_MM {
            let message = "the cylinder has no length: `from` and `to` are the same point";
            let help = "`from` and `to` are the centres of its two ends.";
            reader.add_fault(|| place.at_key("to"), message, "as `from`", help);
        }
        StockBodyShape::Cylinder { diameter, from, to }
    }
}

fn check_point_mm(
    values: [Finite; 3],
    reader: &mut SetupReader,
    place: &YamlLocation,
    key: &'static str,
) -> [f64; 3] {
    let mut index = 0;
    values.map(|value| {
        let at = index;
        index += 1;
        reader.length_mm(value.get(), || place.at_key(key).at_index(at))
    })
}
