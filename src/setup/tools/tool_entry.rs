//! This module holds an entry of `tools:`.

use super::beam_text::ToolStiffness;
use super::insert_data::InsertData;
use crate::cutter::Teeth;
use crate::parameters::Glob;
use crate::program::motion::ActiveTool;
use crate::setup::{Setup, YamlLocation};

/// The data of a setup about the tools that an entry matches. For what is `None`, the CL file counts. Lengths
/// are in mm, angles in radians.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolEntry {
    /// The number that a tool must have.
    pub number: Option<u32>,
    /// The pattern that a tool's name must match.
    pub name: Option<Glob>,
    /// The diameter, where the lines of bottom and flank meet.
    pub diameter_mm: Option<f64>,
    /// The corner radius.
    pub corner_radius_mm: Option<f64>,
    /// The angle between flank and axis.
    pub taper_rad: Option<f64>,
    /// The angle by which the flank narrows upwards.
    pub dovetail_rad: Option<f64>,
    /// The radius of the upper edge of the cutting part.
    pub upper_corner_radius_mm: Option<f64>,
    /// The angle between the bottom and the plane across the axis.
    pub tip_rad: Option<f64>,
    /// The length of the flutes from the tip.
    pub flute_length_mm: Option<f64>,
    /// The parts of the shank, from the flutes upwards; none if it is not given. Their lengths count from the tip.
    pub shank: Vec<ToolCylinder>,
    /// The holder. Its length counts from the clamp, or where that is not given from the end of the shank.
    pub holder: Option<ToolCylinder>,
    /// How stiff it is.
    pub stiffness: ToolStiffness,
    /// The teeth.
    pub teeth: Option<Teeth>,
    /// Whether the helix of the teeth is given. Otherwise it is 0.
    pub helix_is_given: bool,
    /// The cutting inserts.
    pub insert: Option<InsertData>,
    /// The place of the entry in the setup.
    pub place: YamlLocation,
}

/// A cylinder around the tool's axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolCylinder {
    /// The diameter in mm.
    pub diameter_mm: f64,
    /// The length in mm.
    pub length_mm: f64,
}

impl ToolEntry {
    /// Returns the length from the tip to the clamp, mm: where a holder is given, the tool is clamped at the end of its shank
    /// unless the entry says otherwise.
    pub fn clamp_mm(&self) -> Option<f64> {
        let below_holder = || self.shank.last().filter(|_| self.holder.is_some()).map(|part| part.length_mm);
        self.stiffness.stick_out_mm.or_else(below_holder)
    }

    /// Returns whether the entry matches a tool. All its conditions must hold. An entry without conditions
    /// matches every tool.
    pub fn matches_tool(&self, tool: &ActiveTool) -> bool {
        self.number.is_none_or(|number| tool.number == Some(number))
            && self
                .name
                .as_ref()
                .is_none_or(|glob| tool.name.as_deref().is_some_and(|name| glob.matches_name(name)))
    }
}

impl Setup {
    /// Returns the entry for a tool: the first that matches.
    pub fn find_tool_entry(&self, tool: &ActiveTool) -> Option<&ToolEntry> {
        self.tools.iter().find(|entry| entry.matches_tool(tool))
    }
}
