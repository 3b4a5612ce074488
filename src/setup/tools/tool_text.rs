//! An entry of `tools:` as it is written.

use super::teeth::{PitchText, RunoutText, TeethText, check_teeth};
use super::tool_entry::{CutterInsert, ToolCylinder, ToolEntry};
use crate::diagnostic::codes;
use crate::parameters::{Glob, HelixAngle, NonNegative, PointAngle, Positive, PositiveCount, Slope};
use crate::setup::YamlLocation;
use crate::setup::setup_reader::SetupReader;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;

/// Lengths in mm that differ by less are equal: far below any tool's tolerance, far above rounding.
pub(super) const SAME: f64 = 1e-6;

/// What the CL file does not say about the tools that `match` fits, or says wrongly.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Tool")]
pub(crate) struct ToolText {
    /// Which tools are meant; `{}` for every tool.
    #[serde(rename = "match")]
    matches: ToolMatchText,
    /// Diameter, where the lines of bottom and flank meet; 0 for a pointed cutter, which has a `taper`.
    diameter: Option<NonNegative>,
    /// Corner radius; half the diameter for a ball-nose cutter.
    corner_radius: Option<NonNegative>,
    /// Angle of the flank against the axis in degrees; the cutter widens upwards.
    taper: Option<Slope>,
    /// Angle of the bottom against the plane in degrees: 0 is flat, 31 a drill of 118. Not together with `point`.
    tip: Option<Slope>,
    /// A drill's full point angle in degrees, 118 or 140. Not together with `tip`.
    point: Option<PointAngle>,
    /// Length of the flutes from the tip.
    flute_length: Option<Positive>,
    /// The shank above the flutes; it must not touch material.
    shank: Option<ShankText>,
    /// The holder above the shank; it must not touch material.
    holder: Option<HolderText>,
    /// How many teeth.
    teeth: Option<PositiveCount>,
    /// Angles in degrees from each tooth to the next, the last to the first; they make 360. Even if not given.
    pitch: Option<PitchText>,
    /// Helix angle of the teeth in degrees; negative for a left-hand helix.
    helix: Option<HelixAngle>,
    /// How far the whole cutter runs off its axis, towards the first tooth; or a list: how far each tooth stands out.
    runout: Option<RunoutText>,
    /// The inserts of an indexable cutter, for its ramping limits.
    insert: Option<InsertText>,
}

/// Which tools are meant; what is given must all fit, and `{}` fits every tool.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ToolMatch")]
struct ToolMatchText {
    /// The tool's number.
    number: Option<u32>,
    /// The tool's name; `*` and `?` are wildcards.
    name: Option<Glob>,
}

/// The shank above the flutes.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Shank")]
struct ShankText {
    /// Diameter.
    diameter: Positive,
    /// From the tip of the tool to the end of the shank.
    length: Positive,
}

/// The holder above the shank.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Holder")]
struct HolderText {
    /// Diameter.
    diameter: Positive,
    /// From the end of the shank to the end of the holder.
    length: Positive,
}

/// The inserts of an indexable cutter.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Insert")]
struct InsertText {
    /// Cutting height of an insert.
    height: Positive,
    /// Radius of the insert's bottom circle; the cutter does not cut within its diameter less twice this.
    radius: Positive,
}

impl ToolText {
    /// The entry in millimetres and radians.
    pub(crate) fn check_tool(self, reader: &mut SetupReader, place: YamlLocation) -> ToolEntry {
        let teeth = TeethText {
            teeth: self.teeth,
            pitch: self.pitch.as_ref(),
            helix: self.helix,
            runout: self.runout.as_ref(),
        };
        let teeth = check_teeth(&teeth, reader, &place);
        if self.tip.is_some() && self.point.is_some() {
            let message = "the bottom's angle is given twice, by `tip` and by `point`".to_owned();
            let help = "Keep one: a point angle of 118 is a `tip` of 31, half of what is missing to 180.";
            let keys = [(place.at_key("point"), "given again here"), (place.at_key("tip"), "and here")];
            reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
        }
        let point = self.point.map(|point| (FRAC_PI_2 - point.radians() / 2.0).max(0.0));
        let mut bar = |diameter: Positive, length: Positive, key: &'static str| ToolCylinder {
            diameter_mm: reader.size_mm(diameter, || place.at_key(key).at_key("diameter")),
            length_mm: reader.size_mm(length, || place.at_key(key).at_key("length")),
        };
        let shank = self.shank.map(|shank| bar(shank.diameter, shank.length, "shank"));
        let holder = self.holder.map(|holder| bar(holder.diameter, holder.length, "holder"));
        let insert = self.insert.map(|insert| CutterInsert {
            height_mm: reader.size_mm(insert.height, || place.at_key("insert").at_key("height")),
            radius_mm: reader.size_mm(insert.radius, || place.at_key("insert").at_key("radius")),
        });
        let entry = ToolEntry {
            number: self.matches.number,
            name: self.matches.name,
            diameter_mm: self.diameter.map(|diameter| match Positive::new(diameter.get()) {
                Some(diameter) => reader.size_mm(diameter, || place.at_key("diameter")),
                None => 0.0,
            }),
            corner_radius_mm: reader.optional_length_mm(
                self.corner_radius.map(NonNegative::get),
                &place,
                "corner_radius",
            ),
            taper_rad: self.taper.map(Slope::radians),
            tip_rad: self.tip.map(Slope::radians).or(point),
            flute_length_mm: reader.optional_size_mm(self.flute_length, &place, "flute_length"),
            shank,
            holder,
            teeth,
            helix_is_told: self.helix.is_some(),
            insert,
            place,
        };
        entry.check_lengths(reader);
        entry
    }
}

impl ToolEntry {
    /// Reports lengths of one entry that cannot be of one tool. What the CL file adds is looked at when both are known.
    fn check_lengths(&self, reader: &mut SetupReader) {
        let place = &self.place;
        if self.diameter_mm == Some(0.0) && self.taper_rad.is_none_or(|taper| taper <= 0.0) {
            let help = "Say the cone's `taper`, or a diameter above 0.";
            let message = "a diameter of 0 is that of a cone on its tip, which has a taper";
            reader.add_fault(|| place.at_key("diameter"), message, "no taper", help);
        }
        if let (Some(diameter), Some(corner)) = (self.diameter_mm, self.corner_radius_mm)
            && corner > diameter / 2.0 + SAME
        {
            let help = "A ball-nose cutter has a corner radius of half its diameter; none has a larger one.";
            let message = "the corner radius is larger than half the diameter";
            reader.add_fault(|| place.at_key("corner_radius"), message, "too large", help);
        }
        if let (Some(flutes), Some(shank)) = (self.flute_length_mm, self.shank)
            && shank.length_mm < flutes - SAME
        {
            let help = "The shank's length counts from the tip of the tool, flutes included.";
            let message = "the shank ends below the end of the flutes";
            reader.add_fault(
                || place.at_key("shank").at_key("length"),
                message,
                "shorter than `flute_length`",
                help,
            );
        }
        if let (Some(diameter), Some(insert)) = (self.diameter_mm, self.insert)
            && insert.radius_mm > diameter / 2.0 + SAME
        {
            let help = "The inserts go around inside the cutter's diameter.";
            let message = "the insert's radius is larger than half the diameter";
            reader.add_fault(|| place.at_key("insert").at_key("radius"), message, "too large", help);
        }
    }
}
