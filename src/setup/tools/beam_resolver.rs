//! This module makes of an entry what is above the flutes of a cutter: shank and holder, and the beam that bends.

use super::cutter_resolver::CutterResolver;
use super::tool_data_fault::{ToolDataFault, ToolDataFaultKind, format_length_in};
use super::tool_text::LENGTH_TOLERANCE_MM;
use crate::cutter::{
    BeamStep, FLUTE_DIAMETER_FACTOR, Meridian, NonCuttingCylinder, NonCuttingKind, ToolBeam,
};

impl CutterResolver<'_> {
    /// Adds shank and holder.
    pub(super) fn resolve_shank_and_holder(
        &mut self,
        profile: &Meridian,
    ) -> Result<Vec<NonCuttingCylinder>, ToolDataFault> {
        let flutes = profile.height_mm();
        let stick_out = self.entry.and_then(|entry| entry.stiffness.stick_out_mm);
        if let Some(length) = stick_out.filter(|length| *length < flutes - LENGTH_TOLERANCE_MM) {
            return Err(self.make_gap(ToolDataFaultKind::StickOut { flute_length: flutes, length }));
        }
        let parts = self.list_shank_parts(profile, stick_out)?;
        let end = parts.last().map_or(flutes, |part| part[1]);
        let mut collars = Vec::new();
        let mut from = flutes;
        for [radius_mm, to] in parts {
            // What is in the holder touches nothing.
            let to = stick_out.map_or(to, |stick_out| to.min(stick_out));
            if to > from + LENGTH_TOLERANCE_MM {
                let kind = NonCuttingKind::Shank;
                collars.push(NonCuttingCylinder { kind, radius_mm, from_mm: from, to_mm: to });
                from = to;
            }
        }
        let clamp = stick_out.unwrap_or(end);
        match self.entry.and_then(|entry| entry.holder) {
            Some(holder) => collars.push(NonCuttingCylinder {
                kind: NonCuttingKind::Holder,
                radius_mm: holder.diameter_mm / 2.0,
                from_mm: clamp,
                to_mm: clamp + holder.length_mm,
            }),
            None => self.assumptions.push("no holder: setup.tools gives none".to_owned()),
        }
        Ok(collars)
    }

    /// Lists the radii of the parts above the flutes and where they end, mm.
    fn list_shank_parts(
        &mut self,
        profile: &Meridian,
        stick_out: Option<f64>,
    ) -> Result<Vec<[f64; 2]>, ToolDataFault> {
        let flutes = profile.height_mm();
        let given = self.entry.map_or(&[][..], |entry| &entry.shank);
        if let Some(last) = given.last() {
            if last.length_mm < flutes - LENGTH_TOLERANCE_MM {
                let (flute_length, length) = (flutes, last.length_mm);
                return Err(self.make_gap(ToolDataFaultKind::Shank { flute_length, length }));
            }
            return Ok(given.iter().map(|part| [part.diameter_mm / 2.0, part.length_mm]).collect());
        }
        let radius = profile.upper_radius_mm();
        // The neck of a T-slot cutter or lollipop is thinner than its head, and the CL file does not say how thin.
        if self.told.upper_corner_mm.is_some() {
            self.assumptions.push("no neck and shank: setup.tools gives none".to_owned());
            return Ok(vec![[radius, flutes]]);
        }
        let end = self.told.length_mm.into_iter().chain(stick_out).fold(flutes, f64::max);
        if end > flutes + LENGTH_TOLERANCE_MM {
            let [diameter, length] = [2.0 * radius, end].map(|mm| format_length_in(mm, self.units));
            self.assumptions.push(format!(
                "a shank of {diameter} up to {length}, as thick as the cutter: setup.tools gives none"
            ));
        }
        Ok(vec![[radius, end]])
    }

    /// Returns the tool as a beam from its tip to its clamp. Returns `None` where the setup does not say the clamp, Young's
    /// modulus, or how thick the tool is up to the clamp.
    pub(super) fn resolve_beam(&self, profile: &Meridian) -> Option<ToolBeam> {
        let entry = self.entry?;
        let modulus_gpa = entry.stiffness.youngs_modulus_gpa?;
        let clamp = entry.clamp_mm()?;
        let factor = entry.stiffness.flute_diameter_factor.unwrap_or(FLUTE_DIAMETER_FACTOR);
        let mut steps = ToolBeam::flute_steps(profile, factor, clamp);
        let mut from = steps.last()?.to_mm;
        for part in &entry.shank {
            let to = part.length_mm.min(clamp);
            if to > from + LENGTH_TOLERANCE_MM {
                steps.push(BeamStep { from_mm: from, to_mm: to, diameter_mm: part.diameter_mm });
                from = to;
            }
        }
        if from < clamp - LENGTH_TOLERANCE_MM { None } else { ToolBeam::new(steps, modulus_gpa) }
    }
}
