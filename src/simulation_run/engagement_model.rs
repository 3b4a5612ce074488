//! What every motion engages, by columns or by the exact chips of layers.

use super::layer_run::{LayerRunOptions, LayerRunResult, MotionChips, to_flat_mill};
use super::tooling::statement_span;
use super::{EngagedMotion, Machining, RunWatcher, SimulationRunOptions};
use crate::diagnostic::{Diagnostic, codes};
use crate::layered_chips::{FlatMill, measure_engagement};
use crate::sim::{Engagement, MotionPiece};

/// What engagement is found with.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum EngagementModel {
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
pub enum StockResolution {
    /// Distance of columns, mm.
    Cell(f64),
    /// Thickness of layers, mm.
    Layer(f64),
}

/// What a run found.
#[derive(Debug)]
pub struct EngagementRunResult {
    /// How fine it was.
    pub grain: StockResolution,
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
    /// Of columns as [`Machining::estimate_cost`].
    pub fn choose_resolution(
        &self,
        options: &SimulationRunOptions,
        source: EngagementModel,
    ) -> Result<StockResolution, Box<Diagnostic>> {
        match source {
            EngagementModel::Dexels => Ok(StockResolution::Cell(self.estimate_cost(options)?.cell)),
            EngagementModel::Layers { thickness: Some(thickness) } => Ok(StockResolution::Layer(thickness)),
            EngagementModel::Layers { thickness: None } => {
                let diameters = self.tooling.cutters().iter().map(|cutter| 2.0 * cutter.radius_mm());
                let smallest = diameters.fold(f64::INFINITY, f64::min);
                let ([.., low], [.., high]) = self.stock.bounds();
                let usual = if smallest.is_finite() { smallest / LAYERS_ACROSS } else { 0.1 };
                Ok(StockResolution::Layer(usual.min(high - low)))
            }
        }
    }

    /// Runs the whole program, as [`Machining::simulate_program`] does. `None` when `watch` stopped it.
    ///
    /// # Errors
    /// Of columns as [`Machining::estimate_cost`]. Of layers [`codes::LAYERS`] for stock that has none, and [`codes::NOT_IN_LAYERS`] for a
    /// motion that they cannot model: there is no engagement to go by then, and the material that it leaves would make later ones wrong.
    pub fn find_engagements(
        &self,
        options: &SimulationRunOptions,
        source: EngagementModel,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&EngagedMotion<'_>),
    ) -> Result<Option<EngagementRunResult>, Box<Diagnostic>> {
        let grain = self.choose_resolution(options, source)?;
        let findings = match grain {
            StockResolution::Cell(_) => self.simulate_program(options, watch, sink)?.map(|ran| ran.findings),
            StockResolution::Layer(layer) => {
                self.find_layer_engagements(options, layer, watch, sink)?.map(|ran| ran.findings)
            }
        };
        let (lowest, _) = self.stock.bounds();
        Ok(findings.map(|findings| EngagementRunResult { grain, lowest, findings }))
    }

    fn find_layer_engagements(
        &self,
        options: &SimulationRunOptions,
        layer: f64,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&EngagedMotion<'_>),
    ) -> Result<Option<LayerRunResult>, Box<Diagnostic>> {
        let mills = self.list_flat_mills()?;
        let options =
            LayerRunOptions { tolerance: TOLERANCE, longest: options.longest, ..LayerRunOptions::new(layer) };
        let mut refused = None;
        let mut number = 0;
        let ran = self.simulate_layers(&options, watch, &mut |cut| {
            if refused.is_none() {
                refused = self.describe_refusal(cut);
            }
            let mill = cut.cutter.and_then(|index| mills.get(index));
            let pieces: Vec<(MotionPiece, Engagement)> = cut
                .pieces
                .iter()
                .filter_map(|(step, chip)| {
                    let chip = chip.as_ref().ok()?;
                    Some((*step, measure_engagement(chip, mill?, &step.piece, options.tolerance)))
                })
                .collect();
            sink(&EngagedMotion { motion: cut.motion, number, cutter: cut.cutter, pieces: &pieces });
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
    fn list_flat_mills(&self) -> Result<Vec<FlatMill>, Box<Diagnostic>> {
        let mill = |(index, cutter)| {
            to_flat_mill(cutter).map_err(|has| {
                let called =
                    self.tooling.tool_of_cutter(index).map(|tool| tool.display_name()).unwrap_or_default();
                let message = format!("{called} has {has}; layers are for flat end mills");
                let first =
                    self.program.motions().find(|motion| self.tooling.cutter_index(motion) == Some(index));
                let span = first.map(|motion| statement_span(self.program, motion.last_statement()));
                let found = Diagnostic::new(codes::NOT_IN_LAYERS, message);
                Box::new(found.with_label(
                    self.program.source(),
                    span.unwrap_or_default(),
                    "its first motion",
                ))
            })
        };
        self.tooling.cutters().iter().enumerate().map(mill).collect()
    }

    /// Why a motion cannot be modelled, with its place.
    fn describe_refusal(&self, cut: &MotionChips<'_>) -> Option<Box<Diagnostic>> {
        let (refusal, _) = cut.first_refusal()?;
        let message = format!("this motion cannot be modelled in layers: {refusal}");
        let span = statement_span(self.program, cut.motion.last_statement());
        let found = Diagnostic::new(codes::NOT_IN_LAYERS, message);
        Some(Box::new(found.with_label(self.program.source(), span, "not modelled")))
    }
}
