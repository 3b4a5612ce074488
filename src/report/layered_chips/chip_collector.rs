//! This module collects the rows, sums and pictures of a chip report, motion by motion.

use super::chip_merging::merge_piece_chips;
use super::chip_thickness::{ChipThicknessModel, LEAST_TRAVEL_MM, tip_travel_mm};
use super::move_scene::{MoveScene, build_scene};
use super::{
    ChipLayerRow, ChipMoment, ChipReport, ChipReportOptions, ChipRow, ChipTotals, OperationChips, UncutMotion,
};
use crate::engagement::MotionPiece;
use crate::layered_chips::Polygon;
use crate::layered_chips::chip::LayerChip;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::operation;
use crate::report::table::DisplayUnits;
use crate::report::text_format::format_counted;
use crate::report::tool_name;
use crate::simulation_run::Machining;
use crate::simulation_run::layer_run::{
    LayerRunOptions, LayerRunResult, MotionChips, UncutReason, to_flat_mill,
};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// The state while motions are processed.
pub(super) struct ChipCollector<'m, 'p> {
    machining: &'m Machining<'p>,
    keep: ChipReportOptions,
    /// The largest distance between boundaries and their chords, mm.
    tolerance: f64,
    /// In how many parts motions are told.
    moments: usize,
    /// The machine's rapid feed, mm/min.
    rapid: Option<f64>,
    names: Vec<String>,
    operations: Vec<OperationChips>,
    totals: ChipTotals,
    pub rows: Vec<ChipRow>,
    pub skipped: Vec<UncutMotion>,
    /// About how many bytes the layers of the rows take.
    pub kept_bytes: u64,
    scenes: Vec<MoveScene>,
    /// The tools that cut although their teeth are not known.
    toothless: BTreeSet<String>,
    /// The number of cuts whose feed or spindle speed is not known.
    unknown: usize,
    /// The number of cuts that turn about a tip at rest.
    standing: usize,
    /// The number of rapids of tools whose shape is not known.
    shapeless: usize,
    /// The number of motions that neither move the tip nor turn the axis.
    still: usize,
}

impl<'m, 'p> ChipCollector<'m, 'p> {
    pub(super) fn new(
        machining: &'m Machining<'p>,
        keep: ChipReportOptions,
        options: &LayerRunOptions,
    ) -> Self {
        let names = operation::find_operations(machining.program()).into_iter().map(|found| found.name);
        let names: Vec<String> = names.collect();
        let operation = |name: &String| OperationChips { name: name.clone(), ..OperationChips::default() };
        Self {
            machining,
            keep,
            tolerance: options.tolerance_mm,
            moments: options.moments,
            rapid: machining.setup().machine.rapid_feed.map(|feed| feed.get()),
            operations: names.iter().map(operation).collect(),
            names,
            totals: ChipTotals::default(),
            rows: Vec::new(),
            skipped: Vec::new(),
            kept_bytes: 0,
            scenes: Vec::new(),
            toothless: BTreeSet::new(),
            unknown: 0,
            standing: 0,
            shapeless: 0,
            still: 0,
        }
    }

    /// Adds a motion.
    pub(super) fn add_motion(&mut self, cut: &MotionChips<'_>) {
        if cut.motion.path == MotionPath::Start {
            return;
        }
        self.totals.motions += 1;
        self.totals.chips_mm3 += cut.volume_mm3();
        let layers = || cut.piece_chips().flat_map(|chip| &chip.layers);
        let inside_mm3: f64 = layers().map(|layer| layer.inside_mm2 * layer.thickness_mm).sum();
        self.totals.inside_mm3 += inside_mm3;
        let reason = self.find_uncut_reason(cut);
        self.totals.skipped += usize::from(reason.is_some());
        if !cut.asked {
            return;
        }
        let tool = tool_name(cut.motion.tool.as_deref());
        let operation = self.names.get(cut.motion.operation).cloned().unwrap_or_default();
        if let Some(reason) = reason {
            let (operation, tool) = (operation.clone(), tool.clone());
            self.skipped.push(UncutMotion { line: cut.line, operation, tool, reason });
        }
        if cut.left_out.is_some() || (!cut.pieces.is_empty() && cut.piece_chips().next().is_none()) {
            return;
        }
        let pace = self.build_thickness_model(cut, &tool);
        let drawn = self.is_scene_wanted(cut);
        let measured = measure_layers(cut, &pace);
        let merge = |share: [f64; 2], borders: bool| {
            let chips = measured.iter().filter(|layer| is_within(share, layer.step));
            let chips = chips.map(|layer| (layer.chip, layer.thickness_mm));
            merge_piece_chips(chips, cut.stack.grid(), borders)
        };
        let mut layers = merge([0.0, 1.0], self.keep.borders || drawn);
        if drawn {
            self.scenes.extend(build_scene(cut, &layers, self.machining));
        }
        if !self.keep.borders {
            layers.iter_mut().for_each(|layer| layer.polygons.clear());
        }
        let length_mm = cut.motion.length() * self.machining.length_unit().mm_per_unit();
        let thickest = |layers: &[ChipLayerRow], volume_mm3: f64| match find_thickest_chip_mm(layers) {
            _ if volume_mm3 <= 0.0 => Some(0.0),
            // A rapid in the material is a crash: no tooth makes a chip that anybody would ask for.
            _ if cut.motion.rapid => None,
            most => most.filter(|_| pace.known),
        };
        let part = |number: usize| {
            let share = [number, number + 1].map(|at| at as f64 / self.moments as f64);
            let layers = merge(share, self.keep.borders);
            let volume_mm3 = layers.iter().map(|layer| layer.area_mm2 * layer.thickness_mm).sum();
            ChipMoment {
                number: number + 1,
                along_mm: share.map(|share| share * length_mm),
                volume_mm3,
                chip_thickness_mm: thickest(&layers, volume_mm3),
                layers,
                ..ChipMoment::default()
            }
        };
        let moments = if self.moments > 1 { (0..self.moments).map(part).collect() } else { Vec::new() };
        let row = ChipRow {
            line: cut.line,
            motion: cut.number,
            operation,
            rapid: cut.motion.rapid,
            length_mm,
            feed_mm_min: self.motion_feed_mm_min(cut.motion),
            volume_mm3: cut.volume_mm3(),
            inside_mm3,
            chip_thickness_mm: thickest(&layers, cut.volume_mm3()),
            layers,
            moments,
            tool,
        };
        self.push_row(cut.motion.operation, row);
    }

    /// Adds a row to the report and to the sums of its operation.
    fn push_row(&mut self, operation: usize, row: ChipRow) {
        if let Some(sums) = self.operations.get_mut(operation) {
            if sums.motions == 0 {
                sums.tool.clone_from(&row.tool);
            }
            sums.add_motion(&row);
        }
        let layers = || row.layers.iter().chain(row.moments.iter().flat_map(|moment| &moment.layers));
        let points = layers().flat_map(|layer| &layer.polygons).map(Polygon::vertex_count).sum::<usize>();
        let kept = layers().count() * size_of::<ChipLayerRow>()
            + points * size_of::<[f64; 2]>()
            + row.moments.len() * size_of::<ChipMoment>();
        self.kept_bytes += (size_of::<ChipRow>() + kept) as u64;
        self.rows.push(row);
    }

    /// Returns the reason why a motion was not cut, or only in part.
    fn find_uncut_reason(&mut self, cut: &MotionChips<'_>) -> Option<String> {
        match cut.left_out {
            Some(UncutReason::Tool) => Some("the tool is no flat end mill".to_owned()),
            Some(UncutReason::Unknown) => {
                self.shapeless += 1;
                Some("a rapid of a tool whose shape is not known".to_owned())
            }
            // There is nothing to cut, so nothing was left out.
            Some(UncutReason::Still) => {
                self.still += 1;
                None
            }
            None => cut.first_refusal().map(|(refusal, count)| match cut.pieces.len() {
                1 => refusal.to_string(),
                all => format!("{count} of {all} pieces: {refusal}"),
            }),
        }
    }

    /// Returns the feed of a motion, mm/min.
    fn motion_feed_mm_min(&self, motion: &Motion) -> Option<f64> {
        if motion.rapid {
            return self.rapid;
        }
        let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
        let feed = motion.feed?.mm_per_minute(self.machining.length_unit(), rpm, Some(motion.length()));
        feed.filter(|feed| *feed > 0.0)
    }

    /// Returns the model that computes chip thicknesses from advances. If the motion cuts and data is missing
    /// for that, it is counted as a reason.
    fn build_thickness_model(&mut self, cut: &MotionChips<'_>, tool: &str) -> ChipThicknessModel<'m> {
        let cutter = cut.cutter.and_then(|index| self.machining.tooling().cutters().get(index));
        let rpm = cut.motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
        let per_turn = self.motion_feed_mm_min(cut.motion).zip(rpm).map(|(feed, rpm)| feed / rpm);
        let mill = cutter.and_then(|cutter| to_flat_mill(cutter).ok());
        let mut pace = ChipThicknessModel {
            cutter,
            mill,
            feed_per_turn_mm: per_turn,
            tolerance_mm: self.tolerance,
            known: false,
        };
        let cuts = |(step, chip): &(MotionPiece, Result<crate::layered_chips::chip::Chip, _>)| {
            let removes =
                chip.as_ref().is_ok_and(|chip| chip.layers.iter().any(|layer| layer.area_mm2 > 0.0));
            removes.then(|| tip_travel_mm(step))
        };
        let ways: Vec<f64> = cut.pieces.iter().filter_map(cuts).collect();
        if ways.is_empty() {
            return pace;
        }
        if cutter.is_some_and(|cutter| cutter.teeth.is_none()) {
            self.toothless.insert(tool.to_owned());
        } else if pace.feed_per_turn_mm.is_none() {
            self.unknown += 1;
        } else if ways.iter().any(|way| *way <= LEAST_TRAVEL_MM) {
            self.standing += 1;
        } else {
            pace.known = true;
        }
        pace
    }

    /// Returns whether a motion is drawn.
    fn is_scene_wanted(&self, cut: &MotionChips<'_>) -> bool {
        let shown = |layer: &LayerChip| {
            let here = |z: f64| (z - layer.z_mm).abs() <= layer.thickness_mm / 2.0;
            layer.area_mm2 > 0.0 && self.keep.at_z_mm.is_none_or(here)
        };
        self.scenes.len() < self.keep.scenes && cut.piece_chips().flat_map(|chip| &chip.layers).any(shown)
    }

    /// Makes the report.
    pub(super) fn into_report(mut self, options: LayerRunOptions, ran: LayerRunResult) -> ChipReport {
        self.totals.stock_mm3 = ran.before_mm3;
        self.totals.left_mm3 = ran.left.volume_mm3();
        let assumptions = self.list_assumptions();
        ChipReport {
            file: self.machining.program().source().name().to_owned(),
            units: DisplayUnits::of_program(self.machining.length_unit(), None),
            options,
            totals: self.totals,
            operations: self.operations.into_iter().filter(|sums| sums.motions > 0).collect(),
            assumptions,
            skipped: self.skipped,
            rows: self.rows,
            scenes: self.scenes,
            findings: ran.findings,
            left: ran.left,
            frame: ran.frame,
        }
    }

    fn list_assumptions(&self) -> Vec<String> {
        let mut said =
            vec!["everything above the flutes is ignored; `clsmith simulate` finds collisions".to_owned()];
        let cuts = |count: usize| format_counted(count, "cut", "cuts");
        for tool in &self.toothless {
            let tool = if tool.is_empty() { "the tool".to_owned() } else { format!("tool {tool}") };
            said.push(format!("the teeth of {tool} are not given under `setup.tools`: no chip thickness"));
        }
        if self.unknown > 0 {
            let cuts = cuts(self.unknown);
            said.push(format!("feed or spindle speed of {cuts} is not known: no chip thickness"));
        }
        if self.standing > 0 {
            let cuts = cuts(self.standing);
            said.push(format!(
                "{cuts} turn about a tip at rest, and a feed does not say how fast: no chip thickness"
            ));
        }
        if self.totals.inside_mm3 > 5e-4 {
            said.push(format!(
                "{:.3} mm3 were inside a cutter where a motion began: removed, and part of no chip",
                self.totals.inside_mm3
            ));
        }
        if self.shapeless > 0 {
            let rapids = format_counted(self.shapeless, "rapid", "rapids");
            said.push(format!("{rapids} of tools whose shape is not known cut nothing"));
        }
        if self.still > 0 {
            let motions = format_counted(self.still, "motion goes", "motions go");
            said.push(format!("{motions} nowhere and cut nothing"));
        }
        said
    }
}

/// A layer of a piece's chip with the thickest chip of a tooth there.
struct MeasuredLayer<'c> {
    step: &'c MotionPiece,
    chip: &'c LayerChip,
    thickness_mm: Option<f64>,
}

/// Measures the layers of a motion's chips, in the order of its pieces. A rapid has no thickness.
fn measure_layers<'c>(cut: &MotionChips<'c>, pace: &ChipThicknessModel<'_>) -> Vec<MeasuredLayer<'c>> {
    let pieces = cut.pieces.iter().filter_map(|(step, chip)| Some((step, chip.as_ref().ok()?)));
    let layers: Vec<(&MotionPiece, &LayerChip)> =
        pieces.flat_map(|(step, chip)| chip.layers.iter().map(move |layer| (step, layer))).collect();
    let measure = |(step, chip): (&'c MotionPiece, &'c LayerChip)| {
        let thickness_mm = if cut.motion.rapid { None } else { pace.max_chip_thickness_mm(step, chip) };
        MeasuredLayer { step, chip, thickness_mm }
    };
    layers.into_par_iter().map(measure).collect()
}

/// Returns whether a piece is in a part of its motion, given by shares of its length.
fn is_within([from, to]: [f64; 2], step: &MotionPiece) -> bool {
    let middle = (step.from + step.to) / 2.0;
    from <= middle && (middle < to || to >= 1.0)
}

fn find_thickest_chip_mm(layers: &[ChipLayerRow]) -> Option<f64> {
    layers.iter().filter_map(|layer| layer.chip_thickness_mm).reduce(f64::max)
}
