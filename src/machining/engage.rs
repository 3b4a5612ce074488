//! What every motion engages, by columns or by the exact chips of layers.

use super::chips::{ChipCut, ChipOptions, ChipsRan, flat};
use super::tooling::place;
use super::{Cut, Machining, Options, Watch};
use crate::chips::{FlatMill, engagement};
use crate::diagnostic::{Diagnostic, codes};
use crate::sim::{Engagement, Step};

/// What engagement is found with.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Source {
    /// Columns: any cutter.
    #[default]
    Dexels,
    /// Layers: flat end mills, exactly within each layer. Shanks and holders are not looked at.
    Layers {
        /// Their thickness, mm; else a fortieth of the smallest cutter's diameter.
        thickness: Option<f64>,
    },
}

/// How finely the stock is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Grain {
    /// Distance of columns, mm.
    Cell(f64),
    /// Thickness of layers, mm.
    Layer(f64),
}

/// What a run found.
#[derive(Debug)]
pub struct Engaged {
    /// How fine it was.
    pub grain: Grain,
    /// Lower corner of the box around the stock, mm.
    pub lowest: [f64; 3],
    /// Collisions, cuts at rapid or without spindle.
    pub findings: Vec<Diagnostic>,
}

/// Layers in the smallest cutter's diameter when nobody says their thickness.
const LAYERS_ACROSS: f64 = 40.0;

/// Largest distance of a border's chords from the curve, mm. Finer than `clsmith chips` draws, for the film that chords leave
/// is where directions are lost.
const TOLERANCE: f64 = 0.001;

impl Machining<'_> {
    /// How finely a run with these options divides the stock.
    ///
    /// # Errors
    /// Of columns as [`Machining::plan`].
    pub fn grain(&self, options: &Options, source: Source) -> Result<Grain, Box<Diagnostic>> {
        match source {
            Source::Dexels => Ok(Grain::Cell(self.plan(options)?.cell)),
            Source::Layers { thickness: Some(thickness) } => Ok(Grain::Layer(thickness)),
            Source::Layers { thickness: None } => {
                let diameters = self.tooling.cutters().iter().map(|cutter| 2.0 * cutter.radius());
                let smallest = diameters.fold(f64::INFINITY, f64::min);
                let ([.., low], [.., high]) = self.stock.bounds();
                let usual = if smallest.is_finite() { smallest / LAYERS_ACROSS } else { 0.1 };
                Ok(Grain::Layer(usual.min(high - low)))
            }
        }
    }

    /// Runs the whole program, as [`Machining::run`] does. `None` when `watch` stopped it.
    ///
    /// # Errors
    /// Of columns as [`Machining::plan`]. Of layers [`codes::LAYERS`] for stock that has none, and [`codes::NOT_IN_LAYERS`] for a
    /// motion that they cannot model: there is no engagement to go by then, and the material that it leaves would make later ones wrong.
    pub fn engage(
        &self,
        options: &Options,
        source: Source,
        watch: &dyn Watch,
        sink: &mut dyn FnMut(&Cut<'_>),
    ) -> Result<Option<Engaged>, Box<Diagnostic>> {
        let grain = self.grain(options, source)?;
        let findings = match grain {
            Grain::Cell(_) => self.run(options, watch, sink)?.map(|ran| ran.findings),
            Grain::Layer(layer) => self.engage_layers(options, layer, watch, sink)?.map(|ran| ran.findings),
        };
        let (lowest, _) = self.stock.bounds();
        Ok(findings.map(|findings| Engaged { grain, lowest, findings }))
    }

    fn engage_layers(
        &self,
        options: &Options,
        layer: f64,
        watch: &dyn Watch,
        sink: &mut dyn FnMut(&Cut<'_>),
    ) -> Result<Option<ChipsRan>, Box<Diagnostic>> {
        let mills = self.flat_mills()?;
        let options =
            ChipOptions { tolerance: TOLERANCE, longest: options.longest, ..ChipOptions::new(layer) };
        let mut refused = None;
        let mut number = 0;
        let ran = self.chips(&options, watch, &mut |cut| {
            if refused.is_none() {
                refused = self.refused(cut);
            }
            let mill = cut.cutter.and_then(|index| mills.get(index));
            let pieces: Vec<(Step, Engagement)> = cut
                .pieces
                .iter()
                .filter_map(|(step, chip)| {
                    let chip = chip.as_ref().ok()?;
                    Some((*step, engagement(chip, mill?, &step.piece, options.tolerance)))
                })
                .collect();
            sink(&Cut { motion: cut.motion, number, cutter: cut.cutter, pieces: &pieces });
            number += 1;
        })?;
        match refused {
            Some(refused) => Err(refused),
            None => Ok(ran.map(|mut ran| {
                // A repeated point is no matter for feeds.
                ran.findings.retain(|found| found.code != codes::STILL_MOTION);
                ran
            })),
        }
    }

    /// The cutters as flat end mills.
    fn flat_mills(&self) -> Result<Vec<FlatMill>, Box<Diagnostic>> {
        let mill = |(index, cutter)| {
            flat(cutter).map_err(|has| {
                let called = self.tooling.tool(index).map(|tool| tool.called()).unwrap_or_default();
                let message = format!("{called} has {has}; layers are for flat end mills");
                let first =
                    self.program.motions().find(|motion| self.tooling.cutter_of(motion) == Some(index));
                let span = first.map(|motion| place(self.program, motion.last_statement()));
                let found = Diagnostic::new(codes::NOT_IN_LAYERS, message);
                Box::new(found.label(self.program.source(), span.unwrap_or_default(), "its first motion"))
            })
        };
        self.tooling.cutters().iter().enumerate().map(mill).collect()
    }

    /// Why a motion cannot be modelled, with its place.
    fn refused(&self, cut: &ChipCut<'_>) -> Option<Box<Diagnostic>> {
        let (refusal, _) = cut.refused()?;
        let message = format!("this motion cannot be modelled in layers: {refusal}");
        let span = place(self.program, cut.motion.last_statement());
        let found = Diagnostic::new(codes::NOT_IN_LAYERS, message);
        Some(Box::new(found.label(self.program.source(), span, "not modelled")))
    }
}
