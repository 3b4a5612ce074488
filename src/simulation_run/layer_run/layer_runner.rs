//! This module runs a program over the layers of its stock.

use super::flat_mills::{NotFlat, to_flat_mill};
use super::layer_cost::can_divide_stock;
use super::stock_reach::can_reach_stock;
use super::{LayerRunOptions, LayerRunResult, MotionChips, UncutReason};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::{MotionPiece, PathLinearizer, PathPiece};
use crate::layered_chips::chip::{Chip, cut_chips_until};
use crate::layered_chips::stack::{LayerStack, LayerStackError};
use crate::layered_chips::{FlatMill, LayerFrame, MillStepError};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{Program, StatementId};
use crate::simulation_run::faults::FaultCollector;
use crate::simulation_run::tooling::statement_span;
use crate::simulation_run::{Machining, RunPhase, RunWatcher, SimulationBudget};
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::OnceLock;

/// The number of pieces that are cut together: enough for every thread, and few enough to need little memory.
const BATCH: usize = 512;

/// The length below which a motion does not move the tip, in the file's unit. It is finer than any file's
/// decimals.
const SAME_PLACE: f64 = 1e-9;

/// The angle in radians below which a motion does not turn the axis. It moves a point at 100 mm by 0.00001
/// mm.
const SAME_AXIS: f64 = 1e-7;

impl Machining<'_> {
    /// Runs the program in layers, up to the last line that is asked for. `sink` gets every motion in order
    /// with its chips.
    ///
    /// ```
    /// use clsmith::parse::parse;
    /// use clsmith::program::LengthUnit;
    /// use clsmith::setup::Setup;
    /// use clsmith::simulation_run::layer_run::LayerRunOptions;
    /// use clsmith::simulation_run::{Machining, SilentWatcher};
    /// use clsmith::source::Source;
    ///
    /// let shop = b"stock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }\n\
    ///     tools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]\n";
    /// let setup = Setup::load(&Source::new("shop.yaml", shop.to_vec())?)?;
    /// let part = b"LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-10,0,-2\n\
    ///     FEDRAT/MMPM,1000.\nGOTO/20,0,-2\n";
    /// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
    /// let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new())?;
    /// let mut volume_mm3 = 0.0;
    /// machining.simulate_layers(&LayerRunOptions::new(0.5), &SilentWatcher, &mut |motion| {
    ///     volume_mm3 += motion.volume_mm3();
    /// })?;
    /// // A slot of 20 mm that ends in a half circle, 10 mm wide and 2 mm deep.
    /// let exact = 2.0 * (10.0 * 20.0 + std::f64::consts::PI * 25.0 / 2.0);
    /// assert!((volume_mm3 - exact).abs() < 0.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns [`codes::LAYERS`] if the stock cannot be divided in such layers, [`codes::TOO_MUCH`] or
    /// [`codes::TOO_MANY_PIECES`] if the run would take far too much, and [`Failure::Interrupted`] if `watch`
    /// stopped the run.
    pub fn simulate_layers(
        &self,
        options: &LayerRunOptions,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&MotionChips<'_>),
    ) -> Result<LayerRunResult, Failure> {
        watch.begin_phase(RunPhase::Simulating);
        let mills: Vec<_> = self.tooling.cutters().iter().map(|cutter| to_flat_mill(cutter).ok()).collect();
        let most = watch.memory_limit_bytes().unwrap_or(SimulationBudget::default().bytes);
        let frame = self.find_layer_frame(options)?;
        let refuse = |error: LayerStackError| {
            let message = format!("the stock cannot be cut into layers of {} mm: {error}", options.layer_mm);
            Diagnostic::new(codes::LAYERS, message)
        };
        let stock = frame.turn_stock(&self.stock).map_err(refuse)?;
        // A thickness that cannot be used is refused below, with its own code.
        if can_divide_stock(&stock, options.layer_mm) {
            let cost = self.estimate_layer_cost(options, (&frame, stock.bounds()), &mills, most)?;
            watch.report_estimate(&cost.to_estimate());
        }
        let stack = LayerStack::new(&stock, options.layer_mm).map_err(refuse)?;
        let before_mm3 = stack.volume_mm3();
        let mut running = LayerRunner::new(self, options, frame, stack);
        let unit = self.units.mm_per_unit();
        let last = *options.lines.end();
        let motions =
            || self.program.motions().map(|motion| (end_line_number(self.program, &motion), motion));
        // The whole length is needed for progress; it only counts the motions that will be run.
        let whole: f64 =
            motions().take_while(|(line, _)| *line <= last).map(|(_, motion)| motion.length() * unit).sum();
        let mut done = 0.0;
        for (line, motion) in motions().take_while(|(line, _)| *line <= last) {
            done += motion.length() * unit;
            let alone = options.one_by_one && options.lines.contains(&line);
            // The queue is emptied before and after such a motion, so that the stack is right when it reaches
            // the sink.
            if alone {
                running.cut_queued(watch, sink)?;
            }
            running.queue_motion(line, motion);
            if alone || running.steps.len() >= BATCH {
                running.cut_queued(watch, sink)?;
                watch.report_progress(done, whole);
            }
            watch.check_stop()?;
        }
        running.cut_queued(watch, sink)?;
        let findings = running.collect_findings();
        Ok(LayerRunResult { left: running.stack, frame, before_mm3, findings })
    }
}

impl Machining<'_> {
    /// Returns the lines on which motions end, counted from 1, in the order of the program.
    pub(crate) fn motion_lines(&self) -> Vec<usize> {
        self.program.motions().map(|motion| end_line_number(self.program, &motion)).collect()
    }
}

/// Returns the line of the statement that ends a motion, counted from 1.
pub(super) fn end_line_number(program: &Program, motion: &Motion) -> usize {
    let start = program.statement(motion.last_statement()).origin().start;
    program.source().line_column(start).0
}

/// A motion that waits to be cut together with others.
struct WaitingMotion {
    motion: Motion,
    number: usize,
    line: usize,
    cutter: Option<usize>,
    left_out: Option<UncutReason>,
    steps: Range<usize>,
}

/// The state of a run.
struct LayerRunner<'r> {
    machining: &'r Machining<'r>,
    options: &'r LayerRunOptions,
    frame: LayerFrame,
    stack: LayerStack,
    trace: PathLinearizer,
    /// The number of the next motion in the program.
    number: usize,
    /// The mills, one for each cutter; those that are not flat end mills are never cut with.
    mills: Vec<Result<FlatMill, UnsuitableTool>>,
    faults: FaultCollector,
    steps: Vec<MotionPiece>,
    waiting: Vec<WaitingMotion>,
}

/// A tool that is not a flat end mill, with the number of its motions and the statement of the first one.
struct UnsuitableTool {
    has: NotFlat,
    motions: usize,
    first: Option<StatementId>,
}

impl<'r> LayerRunner<'r> {
    fn new(
        machining: &'r Machining<'_>,
        options: &'r LayerRunOptions,
        frame: LayerFrame,
        stack: LayerStack,
    ) -> Self {
        let other = |has: NotFlat| UnsuitableTool { has, motions: 0, first: None };
        let mills =
            machining.tooling.cutters().iter().map(|cutter| to_flat_mill(cutter).map_err(other)).collect();
        Self {
            machining,
            options,
            frame,
            stack,
            trace: machining
                .start_path(options.tolerance_mm, options.longest_piece_mm)
                .with_air_clip(machining.surroundings_of_stock()),
            number: 0,
            mills,
            faults: FaultCollector::for_units(machining.units),
            steps: Vec::new(),
            waiting: Vec::new(),
        }
    }

    /// Adds a motion to those that wait, with its pieces if it is cut.
    fn queue_motion(&mut self, line: usize, motion: Motion) {
        self.trace.adopt_workpiece_frame(&motion);
        let number = self.number;
        self.number += 1;
        let start = self.steps.len();
        let cutter = self.machining.tooling.cutter_index(&motion);
        // A motion that is left out stays in the queue without pieces, so that the sink gets every motion.
        let left_out = self.check_uncut(&motion, cutter);
        if let Some(cutter) = cutter.filter(|_| left_out.is_none()) {
            self.trace.append_pieces((number, &motion), cutter, &mut self.steps);
            if self.options.moments > 1 && self.options.lines.contains(&line) {
                let whole = self.steps.split_off(start);
                self.steps
                    .extend(whole.iter().flat_map(|step| divide_at_moments(step, self.options.moments)));
            }
        }
        if self.trace.take_limit_reached() {
            self.faults.report_piece_limit(self.machining.program, &motion);
        }
        let steps = start..self.steps.len();
        self.waiting.push(WaitingMotion { motion, number, line, cutter, left_out, steps });
    }

    /// Returns the reason why a motion is not cut, and records it as a fault.
    fn check_uncut(&mut self, motion: &Motion, cutter: Option<usize>) -> Option<UncutReason> {
        if motion.path == MotionPath::Start {
            return None;
        }
        let turns = motion.from.axis.angle(&motion.to.axis) > SAME_AXIS;
        if motion.length() <= SAME_PLACE && !turns {
            let message = "this motion goes nowhere: place and axis are those before it".to_owned();
            let found = Diagnostic::new(codes::STILL_MOTION, message);
            self.faults.add_finding(self.machining.program, motion, found, "stays");
            return Some(UncutReason::Still);
        }
        match cutter.and_then(|index| self.mills.get_mut(index)) {
            Some(Ok(_)) => None,
            // Its motions are only counted here; one finding for each tool follows at the end.
            Some(Err(other)) => {
                other.motions += 1;
                other.first.get_or_insert(motion.last_statement());
                Some(UncutReason::Tool)
            }
            None => Some(UncutReason::Unknown),
        }
    }

    /// Cuts the waiting pieces and gives each waiting motion to `sink`. Many layers take long, so `watch` is asked within.
    fn cut_queued(
        &mut self,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&MotionChips<'_>),
    ) -> Result<(), Failure> {
        // A tool that is not a flat end mill has no pieces; an empty mill keeps its index free.
        let nothing = FlatMill { radius_mm: 0.0, flute_length_mm: 0.0 };
        let mills: Vec<FlatMill> =
            self.mills.iter().map(|mill| mill.as_ref().copied().unwrap_or(nothing)).collect();
        let air = self.machining.surroundings_of_stock();
        // A piece that goes far away through the air cuts nothing, but finding that out would take long.
        let near = |step: &MotionPiece| {
            let [from, to] = [step.piece.from.point, step.piece.to.point].map(|point| point.coords.into());
            let is_air = air.is_far_air(from, to);
            if is_air { PathPiece { to: step.piece.from, ..step.piece } } else { step.piece }
        };
        let frame = self.frame;
        let pieces: Vec<PathPiece> = self.steps.iter().map(|step| frame.turn_piece(&near(step))).collect();
        // The first reason to stop is kept: the chips of a run that was stopped within are not whole.
        let stopped: OnceLock<Failure> = OnceLock::new();
        let is_stopped = || match watch.check_stop() {
            Ok(()) => stopped.get().is_some(),
            Err(reason) => {
                let _ = stopped.set(reason);
                true
            }
        };
        let chips = cut_chips_until(&mut self.stack, &mills, &pieces, self.options.tolerance_mm, &is_stopped);
        if let Some(reason) = stopped.into_inner() {
            return Err(reason);
        }
        let bounds = self.machining.stock.bounds();
        let harmless = |step: &MotionPiece| {
            mills.get(step.piece.cutter).is_some_and(|mill| !can_reach_stock(&step.piece, mill, bounds))
        };
        let found: Vec<(MotionPiece, Result<Chip, MillStepError>)> = self
            .steps
            .drain(..)
            .zip(chips)
            .map(|(step, chip)| match chip {
                // The chord of an arc that rounding has made a point, or a piece that cannot reach any
                // material.
                Err(MillStepError::Still) => (step, Ok(Chip::default())),
                Err(_) if harmless(&step) => (step, Ok(Chip::default())),
                chip => (step, chip),
            })
            .map(|(step, chip)| (MotionPiece { piece: frame.turn_piece(&step.piece), ..step }, chip))
            .collect();
        for WaitingMotion { motion, number, line, cutter, left_out, steps } in
            std::mem::take(&mut self.waiting)
        {
            let pieces = found.get(steps);
            debug_assert!(pieces.is_some(), "a motion has pieces of this batch");
            let cut = MotionChips {
                motion: &motion,
                number,
                line,
                asked: self.options.lines.contains(&line),
                cutter,
                left_out,
                pieces: pieces.unwrap_or_default(),
                stack: &self.stack,
            };
            check_layer_motion(&mut self.faults, self.machining, self.options, &mills, &cut);
            sink(&cut);
        }
        Ok(())
    }

    /// Returns all findings: those of motions, and one for each tool that is not a flat end mill.
    fn collect_findings(&mut self) -> Vec<Diagnostic> {
        let program = self.machining.program;
        let mut findings = self.faults.take_findings();
        for (index, other) in self.mills.iter().enumerate() {
            let (Err(other), Some(tool)) = (other, self.machining.tooling.tool_of_cutter(index)) else {
                continue;
            };
            let Some(first) = other.first else { continue };
            let motions = match other.motions {
                1 => "its motion is left out, and the material that it".to_owned(),
                more => format!("its {more} motions are left out, and the material that they"),
            };
            let message = format!("{} has {}: {motions} would remove stays", tool.display_name(), other.has);
            let found = Diagnostic::new(codes::NO_FLAT_MILL, message);
            findings.push(found.with_label(
                program.source(),
                statement_span(program, first),
                "its first motion",
            ));
        }
        findings
    }
}

/// Divides a piece where equal parts of its motion end.
fn divide_at_moments(step: &MotionPiece, moments: usize) -> Vec<MotionPiece> {
    let (whole, length) = (moments as f64, step.to - step.from);
    // A part that is only rounding is none.
    let first = (step.from * whole + 1e-9).floor() as usize + 1;
    let inside = (first..moments).map(|number| number as f64 / whole).take_while(|at| *at < step.to - 1e-9);
    let mut ends: Vec<f64> = inside.collect();
    ends.push(step.to);
    let mut from = step.from;
    let part = |to: f64| {
        let share = |at: f64| if at == step.to { 1.0 } else { (at - step.from) / length };
        let shares = if length > 0.0 { [share(from), share(to)] } else { [0.0, 1.0] };
        let part = MotionPiece { piece: step.piece.part_between(shares), from, to, ..*step };
        from = to;
        part
    };
    ends.into_iter().map(part).collect()
}

/// Records the faults of a motion: pieces that cannot be modelled, and cuts at rapid or without spindle.
fn check_layer_motion(
    faults: &mut FaultCollector,
    machining: &Machining<'_>,
    options: &LayerRunOptions,
    mills: &[FlatMill],
    cut: &MotionChips<'_>,
) {
    if let Some((refusal, count)) = cut.first_refusal() {
        let message = match cut.pieces.len() {
            1 => format!(
                "this motion cannot be modelled, and the material that it would remove stays: {refusal}"
            ),
            all => format!(
                "{count} of the {all} pieces of this motion cannot be modelled, and the material that they would remove stays: {refusal}"
            ),
        };
        let mut found = Diagnostic::new(codes::CHIP_REFUSED, message);
        if matches!(refusal, MillStepError::Tilt { .. }) {
            found = found.with_help(
                "Layers may lie across any direction: `--layers-across tool` lays them across the axis of the first motion that is reported.",
            );
        }
        faults.add_finding(machining.program, cut.motion, found, "left out");
    }
    let radius = cut.cutter.and_then(|index| mills.get(index)).map_or(0.0, |mill| mill.radius_mm);
    let length = cut.motion.length() * machining.units.mm_per_unit();
    // Slivers between the chords of two boundaries are not cuts: at most the tolerance times the length of
    // the section's edge and path.
    let sliver = options.tolerance_mm * (length + TAU * radius);
    let layers = cut.piece_chips().flat_map(|chip| &chip.layers).filter(|layer| layer.area_mm2 > sliver);
    let removed: f64 = layers.map(|layer| layer.area_mm2 * layer.thickness_mm).sum();
    if removed > 0.0 {
        faults.check_removal(machining.program, cut.motion, removed);
    }
}
