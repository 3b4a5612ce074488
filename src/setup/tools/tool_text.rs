//! This module holds an entry of `tools:` as it is written.

use super::beam_text::{StiffnessText, ToolMaterialText};
use super::insert_text::InsertText;
use super::shank_text::ShankText;
use super::teeth::{PitchText, RunoutText, TeethText, check_teeth};
use super::tool_entry::{ToolCylinder, ToolEntry};
use crate::diagnostic::codes;
use crate::parameters::{
    Glob, HelixAngle, NonNegative, PointAngle, Positive, PositiveCount, PositiveFraction, Slope,
};
use crate::setup::YamlLocation;
use crate::setup::setup_reader::SetupReader;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;

/// Lengths in mm that differ by less are equal. This is far below any tool's tolerance and far above
/// rounding.
pub(super) const LENGTH_TOLERANCE_MM: f64 = 1e-6;

/// What the CL file does not state, or states wrongly, about the tools that `match` matches.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Tool")]
pub(crate) struct ToolText {
    /// The tools that are meant; `{}` for every tool.
    #[serde(rename = "match")]
    matches: ToolMatchText,
    /// Diameter, where the lines of bottom and flank meet; 0 for a pointed cutter, which has a `taper`.
    diameter: Option<NonNegative>,
    /// Corner radius; half the diameter for a ball-nose cutter.
    corner_radius: Option<NonNegative>,
    /// The angle between flank and axis in degrees. The cutter widens upwards.
    taper: Option<Slope>,
    /// The angle in degrees by which the flank of a dovetail cutter narrows upwards, against the axis. It
    /// excludes `taper`.
    dovetail_angle: Option<Slope>,
    /// The radius of the upper edge of the cutting part: of a T-slot cutter, or half the diameter for a lollipop,
    /// whose neck begins at the end of the flutes.
    upper_corner_radius: Option<Positive>,
    /// The angle between the bottom and the plane across the axis in degrees: 0 for a flat one, 31 for a
    /// drill of 118. It excludes `point`.
    tip: Option<Slope>,
    /// The full point angle of a drill in degrees, for example 118 or 140. It excludes `tip`.
    point: Option<PointAngle>,
    /// The length of the flutes from the tip.
    flute_length: Option<Positive>,
    /// The shank above the flutes, which must not touch material: `{ diameter, length }`, or a list of them from the flutes
    /// upwards where it has steps. Each length is that from the tip of the tool to the end of the part.
    shank: Option<ShankText>,
    /// The holder above the shank, which must not touch material. It begins at `stick_out`, and where that is left out at
    /// the end of the shank.
    holder: Option<HolderText>,
    /// The length from the tip of the tool to where it is clamped. Where it is left out and a holder is given, the tool is
    /// clamped at the end of the shank.
    stick_out: Option<Positive>,
    /// What the tool is made of, which says how far it bends.
    tool_material: Option<ToolMaterialText>,
    /// Young's modulus of the tool in GPa. It excludes `tool_material`.
    #[schemars(extend("x-unit" = "GPa"))]
    youngs_modulus: Option<Positive>,
    /// The diameter of the cylinder that bends like the flutes, as a part of theirs; 0.8 when it is left out.
    #[schemars(extend("x-unit" = "factor"))]
    flute_diameter_factor: Option<PositiveFraction>,
    /// The number of teeth.
    teeth: Option<PositiveCount>,
    /// The number of teeth, as NX and tool catalogues call it. It excludes `teeth`.
    flutes: Option<PositiveCount>,
    /// The angles in degrees from each tooth to the next, and from the last to the first. They add up to 360.
    /// The pitch is even when it is left out.
    pitch: Option<PitchText>,
    /// The helix angle of the teeth in degrees. It is negative for a left-hand helix.
    helix: Option<HelixAngle>,
    /// The eccentricity of the whole cutter towards its first tooth, or a list with the radial offset of each
    /// tooth.
    runout: Option<RunoutText>,
    /// By what the state of the edges multiplies all cutting forces: 1 for edges like those with which the material was
    /// measured, more for blunt ones.
    #[schemars(extend("x-unit" = "factor"))]
    wear: Option<Positive>,
    /// The inserts of an indexable cutter, which limit its ramps.
    insert: Option<InsertText>,
}

/// The tools that are meant. All given keys must match, and `{}` matches every tool.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ToolMatch")]
struct ToolMatchText {
    /// The number of the tool.
    number: Option<u32>,
    /// The name of the tool. `*` and `?` are wildcards.
    name: Option<Glob>,
}

/// The holder above the shank.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Holder")]
struct HolderText {
    /// The diameter.
    diameter: Positive,
    /// The length from where the holder begins to its end.
    length: Positive,
}

impl ToolText {
    /// Returns the entry in millimetres and radians.
    pub(crate) fn check_tool(self, reader: &mut SetupReader, place: YamlLocation) -> ToolEntry {
        if self.teeth.is_some() && self.flutes.is_some() {
            let message = "the number of teeth is given twice, by `teeth` and by `flutes`".to_owned();
            let help = "Keep one of them; the length of the flutes is `flute_length`.";
            let keys = [(place.at_key("flutes"), "given again here"), (place.at_key("teeth"), "and here")];
            reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
        }
        let teeth = TeethText {
            teeth: self.teeth.or(self.flutes),
            teeth_key: if self.teeth.is_some() { "teeth" } else { "flutes" },
            pitch: self.pitch.as_ref(),
            helix: self.helix,
            runout: self.runout.as_ref(),
        };
        let teeth = check_teeth(&teeth, reader, &place);
        let wear = self.wear.map_or(1.0, Positive::get);
        let teeth = teeth.map(|teeth| teeth.with_wear_factor(wear));
        if self.tip.is_some() && self.point.is_some() {
            let message = "the bottom's angle is given twice, by `tip` and by `point`".to_owned();
            let help = "Keep one of them. A point angle of 118 is a `tip` of (180 - 118) / 2 = 31.";
            let keys = [(place.at_key("point"), "given again here"), (place.at_key("tip"), "and here")];
            reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
        }
        let point = self.point.map(|point| (FRAC_PI_2 - point.radians() / 2.0).max(0.0));
        let shank_is_list = self.shank.as_ref().is_some_and(ShankText::is_list);
        let shank = self.shank.as_ref().map(|shank| shank.check_parts(reader, &place.at_key("shank")));
        let holder = self.holder.map(|holder| ToolCylinder {
            diameter_mm: reader.size_mm(holder.diameter, || place.at_key("holder").at_key("diameter")),
            length_mm: reader.size_mm(holder.length, || place.at_key("holder").at_key("length")),
        });
        let stiffness = StiffnessText {
            stick_out: self.stick_out,
            tool_material: self.tool_material,
            youngs_modulus: self.youngs_modulus,
            flute_diameter_factor: self.flute_diameter_factor,
        };
        let stiffness = stiffness.check_stiffness(reader, &place);
        let diameter_mm = self.diameter.map(|diameter| match Positive::new(diameter.get()) {
            Some(diameter) => reader.size_mm(diameter, || place.at_key("diameter")),
            None => 0.0,
        });
        let insert = self
            .insert
            .as_ref()
            .and_then(|insert| insert.check_insert(diameter_mm, reader, &place.at_key("insert")));
        let entry = ToolEntry {
            number: self.matches.number,
            name: self.matches.name,
            diameter_mm,
            corner_radius_mm: reader.optional_length_mm(
                self.corner_radius.map(NonNegative::get),
                &place,
                "corner_radius",
            ),
            taper_rad: self.taper.map(Slope::radians),
            dovetail_rad: self.dovetail_angle.map(Slope::radians).filter(|angle| *angle > 0.0),
            upper_corner_radius_mm: reader.optional_size_mm(
                self.upper_corner_radius,
                &place,
                "upper_corner_radius",
            ),
            tip_rad: self.tip.map(Slope::radians).or(point),
            flute_length_mm: reader.optional_size_mm(self.flute_length, &place, "flute_length"),
            shank: shank.unwrap_or_default(),
            holder,
            stiffness,
            teeth,
            helix_is_given: self.helix.is_some(),
            insert,
            place,
        };
        entry.check_lengths(shank_is_list, reader);
        entry
    }
}

impl ToolEntry {
    /// Reports lengths of an entry that cannot belong to the same tool. What the CL file adds is checked when
    /// both are known.
    fn check_lengths(&self, shank_is_list: bool, reader: &mut SetupReader) {
        let place = &self.place;
        if self.diameter_mm == Some(0.0) && self.taper_rad.is_none_or(|taper| taper <= 0.0) {
            let help = "Say the cone's `taper`, or a diameter above 0.";
            let message = "a diameter of 0 is that of a cone on its tip, which has a taper";
            reader.add_fault(|| place.at_key("diameter"), message, "no taper", help);
        }
        if self.dovetail_rad.is_some() && self.taper_rad.is_some_and(|taper| taper > 0.0) {
            let message = "the flank widens by `taper` and narrows by `dovetail_angle`".to_owned();
            let keys = [(place.at_key("dovetail_angle"), "narrows"), (place.at_key("taper"), "widens")];
            reader.add_key_fault(codes::BAD_VALUE, message, "Keep one of them.", &keys);
        }
        if let (Some(diameter), Some(corner)) = (self.diameter_mm, self.corner_radius_mm)
            && corner > diameter / 2.0 + LENGTH_TOLERANCE_MM
        {
            let help = "A ball-nose cutter has a corner radius of half its diameter, and no cutter has a larger one.";
            let message = "the corner radius is larger than half the diameter";
            reader.add_fault(|| place.at_key("corner_radius"), message, "too large", help);
        }
        if let (Some(flutes), Some(shank)) = (self.flute_length_mm, self.shank.last())
            && shank.length_mm < flutes - LENGTH_TOLERANCE_MM
        {
            let help = "The shank's length counts from the tip of the tool, flutes included.";
            let message = "the shank ends below the end of the flutes";
            let at = || ShankText::length_place(&place.at_key("shank"), self.shank.len(), shank_is_list);
            reader.add_fault(at, message, "shorter than `flute_length`", help);
        }
        self.check_stick_out(reader);
        self.check_upper_side(reader);
    }

    /// Reports a clamp that is not on the shank.
    fn check_stick_out(&self, reader: &mut SetupReader) {
        let Some(stick_out) = self.stiffness.stick_out_mm else { return };
        let at = || self.place.at_key("stick_out");
        let help = "`stick_out` is the length from the tip of the tool to the holder that clamps its shank.";
        if self.flute_length_mm.is_some_and(|flutes| stick_out < flutes - LENGTH_TOLERANCE_MM) {
            let message = "the tool is clamped below the end of its flutes";
            reader.add_fault(at, message, "shorter than `flute_length`", help);
        }
        if self.shank.last().is_some_and(|shank| stick_out > shank.length_mm + LENGTH_TOLERANCE_MM) {
            let message = "the tool is clamped beyond the end of its shank";
            reader.add_fault(at, message, "longer than the shank", help);
        }
    }
}
