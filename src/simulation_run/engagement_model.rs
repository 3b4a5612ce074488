//! This module finds the engagement of every motion, from columns or from the exact chips of layers.

use super::layer_run::{LayerRunOptions, LayerRunResult, MotionChips, to_flat_mill};
use super::tooling::statement_span;
use super::{EngagedMotion, Machining, RunWatcher, SimulationRunOptions};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::{Engagement, MotionPiece};
use crate::layered_chips::{FlatMill, measure_engagement};

/// The model from which engagements are found.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) enum EngagementModel {
    /// Columns, which work for any cutter. Bounds of shares come from the motions themselves where they can.
    #[default]
    Certified,
    /// Columns alone, which are blind below their width.
    Dexels,
    /// Layers, which are exact within each layer and work for flat end mills. Shanks and holders are not
    /// examined.
    Layers {
        /// The thickness of the layers, mm; if not given, a fortieth of the smallest cutter's diameter.
        thickness: Option<f64>,
    },
}

/// The resolution at which the stock is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StockResolution {
    /// The distance of columns, mm.
    Cell(f64),
    /// The thickness of layers, mm.
    Layer(f64),
}

/// The result of a run that finds engagements.
#[derive(Debug)]
pub(crate) struct EngagementRunResult {
    /// The resolution of the run.
    pub resolution: StockResolution,
    /// The lowest corner of the box around the stock, mm.
    pub lowest_mm: [f64; 3],
    /// The findings: collisions, and cuts at rapid or with a spindle that does not turn.
    pub findings: Vec<Diagnostic>,
}

/// The number of layers in the smallest cutter's diameter if their thickness is not given.
const LAYERS_ACROSS: f64 = 40.0;

/// Returns how the thickness of layers is chosen if it is not given, for people.
pub(crate) fn describe_default_layer() -> String {
    format!(
        "the diameter of the smallest cutter divided by {LAYERS_ACROSS}, and at most the height of the stock"
    )
}

/// The largest distance of a boundary's chords from the curve, mm. It is finer than in the drawings of
/// `clsmith chips`, because directions are lost in the film that chords leave.
const TOLERANCE: f64 = 0.001;

impl Machining<'_> {
    /// Returns the resolution at which a run with these options divides the stock.
    ///
    /// # Errors
    /// For columns, returns the errors of [`Machining::estimate_cost`].
    pub(crate) fn choose_resolution(
        &self,
        options: &SimulationRunOptions,
        source: EngagementModel,
    ) -> Result<StockResolution, Failure> {
        match source {
            EngagementModel::Certified | EngagementModel::Dexels => {
                Ok(StockResolution::Cell(self.estimate_cost(options)?.cell_mm))
            }
            EngagementModel::Layers { thickness: Some(thickness) } => Ok(StockResolution::Layer(thickness)),
            EngagementModel::Layers { thickness: None } => {
                let diameters = self.tooling.cutters().iter().map(|cutter| 2.0 * cutter.radius_mm());
                let smallest = diameters.fold(f64::INFINITY, f64::min);
                let ([.., low], [.., high]) = self.stock.bounds();
                let usual = if smallest.is_finite() { smallest / LAYERS_ACROSS } else { 0.1 };
                // A layer must not be thicker than the stock is high.
                Ok(StockResolution::Layer(usual.min(high - low)))
            }
        }
    }

    /// Runs the whole program as [`Machining::simulate_program`] does.
    ///
    /// # Errors
    /// For columns, returns the errors of [`Machining::estimate_cost`]. For layers, returns [`codes::LAYERS`]
    /// for stock that cannot be divided in layers, and [`codes::NOT_IN_LAYERS`] for a motion that layers
    /// cannot model: such a motion has no engagement, and the material that it leaves would make later
    /// engagements wrong. Returns [`Failure::Interrupted`] if `watch` stopped the run.
    pub(crate) fn find_engagements(
        &self,
        options: &SimulationRunOptions,
        source: EngagementModel,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&EngagedMotion<'_>),
    ) -> Result<EngagementRunResult, Failure> {
        let resolution = self.choose_resolution(options, source)?;
        let findings = match resolution {
            StockResolution::Cell(_) => self.simulate_program(options, watch, sink)?.findings,
            StockResolution::Layer(layer) => {
                self.find_layer_engagements(options, layer, watch, sink)?.findings
            }
        };
        let (lowest, _) = self.stock.bounds();
        Ok(EngagementRunResult { resolution, lowest_mm: lowest, findings })
    }

    /// Finds engagements in layers; fails if any motion cannot be modelled.
    fn find_layer_engagements(
        &self,
        options: &SimulationRunOptions,
        layer: f64,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&EngagedMotion<'_>),
    ) -> Result<LayerRunResult, Failure> {
        let mills = self.list_flat_mills()?;
        let options = LayerRunOptions {
            tolerance_mm: TOLERANCE,
            longest_piece_mm: options.longest_piece_mm,
            ..LayerRunOptions::new(layer)
        };
        // The run cannot be stopped from within the sink, so the first refusal is kept and returned at the
        // end.
        let mut refused = None;
        let mut number = 0;
        let mut ran = self.simulate_layers(&options, watch, &mut |cut| {
            if refused.is_none() {
                refused = self.describe_refusal(cut);
            }
            let mill = cut.cutter.and_then(|index| mills.get(index));
            let pieces: Vec<(MotionPiece, Engagement)> = cut
                .pieces
                .iter()
                .filter_map(|(step, chip)| {
                    let chip = chip.as_ref().ok()?;
                    let engaged = measure_engagement(chip, mill?, &step.piece, options.tolerance_mm);
                    Some((*step, engaged.at_pace(step.pace)))
                })
                .collect();
            // Every motion passes here in order, so counting them gives their index.
            sink(&EngagedMotion { motion: cut.motion, number, cutter: cut.cutter, pieces: &pieces });
            number += 1;
        })?;
        if let Some(refused) = refused {
            return Err(refused.into());
        }
        // A repeated point has no effect on feeds.
        ran.findings.retain(|found| found.code != codes::STILL_MOTION);
        Ok(ran)
    }

    /// Returns the cutters as flat end mills, or a finding for the first one that is not a flat end mill.
    fn list_flat_mills(&self) -> Result<Vec<FlatMill>, Failure> {
        let mill = |(index, cutter)| {
            to_flat_mill(cutter).map_err(|has| {
                let called =
                    self.tooling.tool_of_cutter(index).map(|tool| tool.display_name()).unwrap_or_default();
                let message = format!("{called} has {has}; layers are for flat end mills");
                let first =
                    self.program.motions().find(|motion| self.tooling.cutter_index(motion) == Some(index));
                let span = first.map(|motion| statement_span(self.program, motion.last_statement()));
                let found = Diagnostic::new(codes::NOT_IN_LAYERS, message);
                found.with_label(self.program.source(), span.unwrap_or_default(), "its first motion").into()
            })
        };
        self.tooling.cutters().iter().enumerate().map(mill).collect()
    }

    /// Returns a finding for a motion that cannot be modelled, with its place; `None` if all its pieces can.
    fn describe_refusal(&self, cut: &MotionChips<'_>) -> Option<Diagnostic> {
        let (refusal, _) = cut.first_refusal()?;
        let message = format!("this motion cannot be modelled in layers: {refusal}");
        let span = statement_span(self.program, cut.motion.last_statement());
        let found = Diagnostic::new(codes::NOT_IN_LAYERS, message);
        Some(found.with_label(self.program.source(), span, "not modelled"))
    }
}
