//! An entry of `tools:`.

use crate::cutter::Teeth;
use crate::parameters::Glob;
use crate::program::motion::ActiveTool;
use crate::setup::{Setup, YamlLocation};

/// What a setup says about the tools that it fits; what is `None` is left to the CL file. Lengths in mm, angles in
/// radians.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolEntry {
    /// The number that a tool must have to fit.
    pub number: Option<u32>,
    /// What a tool's name must look like to fit.
    pub name: Option<Glob>,
    /// Diameter, where the lines of bottom and flank meet.
    pub diameter_mm: Option<f64>,
    /// Corner radius.
    pub corner_radius_mm: Option<f64>,
    /// Angle of the flank against the axis.
    pub taper_rad: Option<f64>,
    /// Angle of the bottom against the plane across the axis.
    pub tip_rad: Option<f64>,
    /// Length of the flutes from the tip.
    pub flute_length_mm: Option<f64>,
    /// The shank; its length counts from the tip.
    pub shank: Option<ToolCylinder>,
    /// The holder; its length counts from the end of the shank.
    pub holder: Option<ToolCylinder>,
    /// The teeth.
    pub teeth: Option<Teeth>,
    /// Whether the helix of the teeth is said; it is 0 where it is not.
    pub helix_is_told: bool,
    /// The cutting inserts.
    pub insert: Option<CutterInsert>,
    /// Where the setup says it.
    pub place: YamlLocation,
}

/// A cylinder around the tool's axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolCylinder {
    /// Diameter in mm.
    pub diameter_mm: f64,
    /// Length in mm.
    pub length_mm: f64,
}

/// The inserts of an indexable cutter, as its ramping limits need them: the cutter does not cut within `diameter - 2
/// radius`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutterInsert {
    /// Cutting height of an insert in mm.
    pub height_mm: f64,
    /// Radius of the insert's bottom circle in mm.
    pub radius_mm: f64,
}

impl ToolEntry {
    /// Whether a tool fits: what is asked for must all be so. An entry that asks for nothing fits every tool.
    pub fn matches_tool(&self, tool: &ActiveTool) -> bool {
        self.number.is_none_or(|number| tool.number == Some(number))
            && self
                .name
                .as_ref()
                .is_none_or(|glob| tool.name.as_deref().is_some_and(|name| glob.matches_name(name)))
    }
}

impl Setup {
    /// The entry that counts for a tool: the first that fits.
    pub fn find_tool_entry(&self, tool: &ActiveTool) -> Option<&ToolEntry> {
        self.tools.iter().find(|entry| entry.matches_tool(tool))
    }
}
