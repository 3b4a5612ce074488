//! This module makes a cutter for the simulation from the data of the CL file, completed and overridden by
//! the setup.

use super::file_tool_data::FileToolData;
use super::tool_data_fault::{ToolDataFault, ToolDataFaultKind, format_length_in};
use super::tool_entry::ToolEntry;
use super::tool_profile::{ProfileNumbers, make_profile};
use super::tool_text::LENGTH_TOLERANCE_MM;
use crate::cutter::{CutterModel, ToolBeam};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::LengthUnit;
use crate::program::motion::ActiveTool;
use crate::setup::Setup;
use crate::source::{Source, Span};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Flutes of unknown length are assumed to be so many diameters long. That is more than the flutes of any
/// cutter for which they would matter to the path.
const FLUTE_DIAMETERS: f64 = 4.0;

/// A cutter, and the assumptions about it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ResolvedCutter {
    /// The cutter.
    pub cutter: CutterModel,
    /// The tool as a beam, if the setup says what that needs ([`Setup::report_missing_stiffness`]).
    pub beam: Option<ToolBeam>,
    /// What neither the CL file nor the setup states, each in words such as `corner radius 0: neither the CL
    /// file nor setup.tools gives one`.
    pub assumptions: Vec<String>,
}

impl ResolvedCutter {
    /// Makes a note ([`codes::ASSUMPTION`]) about all assumptions for a tool, at a place of the CL file that
    /// uses it. Returns `None` if nothing was assumed.
    pub fn note_assumptions(
        &self,
        tool: &ActiveTool,
        source: &Arc<Source>,
        span: Span,
    ) -> Option<Diagnostic> {
        if self.assumptions.is_empty() {
            return None;
        }
        let message = format!("{} is taken with {}", tool.display_name(), self.assumptions.join("; "));
        Some(Diagnostic::new(codes::ASSUMPTION, message).with_label(source, span, "used here"))
    }
}

impl Setup {
    /// Makes the cutter for a tool of the CL file, in millimetres. `units` is the unit of the CL file. Teeth
    /// are `None` if the setup does not state their number ([`Setup::report_missing_teeth`]).
    ///
    /// The call is expensive, so it should be made once for each distinct tool, not for each motion.
    ///
    /// ```
    /// use clsmith::parse::parse;
    /// use clsmith::program::LengthUnit;
    /// use clsmith::setup::Setup;
    /// use clsmith::source::Source;
    ///
    /// let shop = b"tools: [ { match: { number: 3 }, flute_length: 25, teeth: 2, helix: 30 } ]\n";
    /// let setup = Setup::load(&Source::new("shop.yaml", shop.to_vec())?)?;
    /// let part = b"TLDATA/MILL,8.0000,4.0000,75.0000,0.0000,0.0000\nLOAD/TOOL,3\nGOTO/0,0,0\n";
    /// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
    /// let motion = program.motions().next().expect("there is a GOTO");
    /// let tool = motion.tool.expect("a tool is loaded");
    /// // The program says the diameter and the ball, the setup file flutes and teeth.
    /// let resolved = setup.resolve_cutter(&tool, LengthUnit::Mm).expect("nothing is missing");
    /// assert_eq!(resolved.cutter.profile.corner_radius_mm(), 4.0);
    /// assert_eq!(resolved.cutter.teeth.map(|teeth| teeth.count()), Some(2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns [`ToolDataFault`] if the diameter is unknown, if the numbers make no cutter, or if it is no
    /// milling cutter.
    pub fn resolve_cutter(
        &self,
        tool: &ActiveTool,
        units: LengthUnit,
    ) -> Result<ResolvedCutter, ToolDataFault> {
        let entry = self.find_tool_entry(tool);
        let told = FileToolData::from_tool_data(tool.data.as_ref(), units);
        CutterResolver { tool, entry, told, units, assumptions: Vec::new() }.resolve_cutter()
    }
}

pub(super) struct CutterResolver<'a> {
    tool: &'a ActiveTool,
    pub(super) entry: Option<&'a ToolEntry>,
    pub(super) told: FileToolData,
    /// The unit of the CL file.
    pub(super) units: LengthUnit,
    pub(super) assumptions: Vec<String>,
}

/// Makes a cone that stands on its tip (diameter 0) a cutter whose bottom is all of it. Returns diameter, taper and angle
/// of the bottom; `None` for every other cutter.
fn point_cutter(diameter_mm: f64, corner_mm: f64, taper_rad: f64, flutes_mm: f64) -> Option<(f64, f64, f64)> {
    let pointed = diameter_mm <= LENGTH_TOLERANCE_MM
        && corner_mm <= LENGTH_TOLERANCE_MM
        && taper_rad > 0.0
        && flutes_mm > 0.0;
    pointed.then(|| (2.0 * flutes_mm * taper_rad.tan(), 0.0, FRAC_PI_2 - taper_rad))
}

impl CutterResolver<'_> {
    fn resolve_cutter(mut self) -> Result<ResolvedCutter, ToolDataFault> {
        let own = |field: fn(&ToolEntry) -> Option<f64>| self.entry.and_then(field);
        let diameter = match (own(|entry| entry.diameter_mm), self.told) {
            (Some(diameter), _) => diameter,
            (None, FileToolData { other: true, .. }) => {
                return Err(self.make_gap(ToolDataFaultKind::NoMillingCutter));
            }
            (None, FileToolData { diameter_mm: Some(diameter), .. }) => diameter,
            (None, _) => return Err(self.make_gap(ToolDataFaultKind::Diameter)),
        };
        let (corner, taper, tip) =
            (own(|entry| entry.corner_radius_mm), own(|entry| entry.taper_rad), own(|entry| entry.tip_rad));
        let tip = tip
            .or(self.told.tip_rad)
            .unwrap_or_else(|| self.assume_zero("a flat bottom (tip 0)", "its angle"));
        let corner = corner
            .or(self.told.corner_radius_mm)
            .unwrap_or_else(|| self.assume_zero("corner radius 0", "one"));
        let corner = self.snap_to_ball_mm(diameter, corner);
        let taper = taper.or(self.told.taper_rad).unwrap_or_else(|| self.assume_zero("taper 0", "one"));
        let diameter = self.snap_to_cone_ball_mm(diameter, corner, taper, tip);
        let flute_length = self.resolve_flute_length_mm(diameter, tip);
        let (diameter, taper, tip) =
            point_cutter(diameter, corner, taper, flute_length).unwrap_or((diameter, taper, tip));
        let numbers = ProfileNumbers {
            diameter_mm: diameter,
            corner_mm: corner,
            taper_rad: taper,
            tip_rad: tip,
            flute_length_mm: flute_length,
            upper_corner_mm: self.resolve_upper_corner_mm(taper),
        };
        let profile = make_profile(numbers, self.entry).map_err(|error| {
            let (taper, tip) = (taper.to_degrees(), tip.to_degrees());
            self.make_gap(ToolDataFaultKind::Shape {
                error,
                diameter,
                corner_radius: corner,
                flute_length,
                taper,
                tip,
            })
        })?;
        let profile = match self.entry.and_then(|entry| entry.insert) {
            Some(insert) => profile.with_dead_middle(insert.dead_middle_of(diameter)),
            None => profile,
        };
        let collars = self.resolve_shank_and_holder(&profile)?;
        let teeth = self.entry.and_then(|entry| entry.teeth.clone());
        if teeth.is_some() && self.entry.is_some_and(|entry| !entry.helix_is_given) {
            self.assumptions.push("helix 0: setup.tools gives none".to_owned());
        }
        let beam = self.resolve_beam(&profile);
        let cutter = CutterModel { profile, collars, teeth };
        Ok(ResolvedCutter { cutter, beam, assumptions: self.assumptions })
    }

    pub(super) fn make_gap(&self, kind: ToolDataFaultKind) -> ToolDataFault {
        ToolDataFault::new(self.tool, self.entry, kind, self.units)
    }

    /// Assumes 0 for a value that neither file states.
    fn assume_zero(&mut self, what: &str, none: &str) -> f64 {
        self.assumptions.push(format!("{what}: neither the CL file nor setup.tools gives {none}"));
        0.0
    }

    /// Returns the corner radius. If it differs from a ball's only by the rounding of printed numbers, it is
    /// the radius of the ball.
    fn snap_to_ball_mm(&self, diameter: f64, corner: f64) -> f64 {
        let half = diameter / 2.0;
        if corner > 0.0 && (corner - half).abs() <= self.told.rounding_mm { half } else { corner }
    }

    /// Returns the upper corner radius that the file gives. That of a tapered flank is left out, and the flank goes on.
    fn resolve_upper_corner_mm(&mut self, taper: f64) -> Option<f64> {
        let upper = self.told.upper_corner_mm?;
        if taper == 0.0 {
            return Some(upper);
        }
        self.assumptions.push("no upper corner radius: a flank with a taper cannot have one here".to_owned());
        None
    }

    /// Returns the diameter of a cone with a ball at its tip. If it differs from that of a ball that touches the flank
    /// only by the rounding of printed numbers, it is that.
    fn snap_to_cone_ball_mm(&self, diameter: f64, corner: f64, taper: f64, tip: f64) -> f64 {
        let (sin, cos) = taper.sin_cos();
        let ball = 2.0 * corner * (1.0 - sin) / cos;
        let is_cone = taper > 0.0 && tip == 0.0 && corner > 0.0;
        if is_cone && (ball - diameter).abs() <= 2.0 * self.told.rounding_mm { ball } else { diameter }
    }

    fn resolve_flute_length_mm(&mut self, diameter: f64, tip: f64) -> f64 {
        if let Some(flutes) = self.entry.and_then(|entry| entry.flute_length_mm).or(self.told.flute_length_mm)
        {
            return flutes;
        }
        let shank_end = self.entry.and_then(|entry| entry.shank.last()).map(|shank| shank.length_mm);
        let clamp = self.entry.and_then(|entry| entry.stiffness.stick_out_mm);
        // Flutes end below the clamp.
        let end = match (shank_end, clamp) {
            (Some(shank), Some(clamp)) if clamp < shank => Some((clamp, "setup.tools only says the clamp")),
            (None, Some(clamp)) => Some((clamp, "setup.tools only says the clamp")),
            (Some(shank), _) => Some((shank, "setup.tools only gives the end of the shank")),
            (None, None) => None,
        };
        let (length, why) = match (self.told.length_mm, end) {
            (Some(length), Some((end, why))) if length > end => (end, why),
            (Some(length), _) => (length, "the CL file only gives the length of the tool"),
            (None, Some((end, why))) => (end, why),
            (None, None) => {
                let bottom = diameter / 2.0 * tip.tan();
                (FLUTE_DIAMETERS * diameter + bottom, "neither the CL file nor setup.tools gives one")
            }
        };
        self.assumptions.push(format!("flute length {}: {why}", format_length_in(length, self.units)));
        length
    }
}
