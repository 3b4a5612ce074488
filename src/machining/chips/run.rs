//! The run itself.

use super::mills::flat;
use super::reach::reaches;
use super::{ChipCut, ChipOptions, ChipsRan, LeftOut};
use crate::chips::chip::{Chip, cut};
use crate::chips::stack::Stack;
use crate::chips::{FlatMill, Refusal};
use crate::diagnostic::{Diagnostic, codes};
use crate::machining::faults::Faults;
use crate::machining::tooling::place;
use crate::machining::{Machining, Watch};
use crate::program::geometry::Path;
use crate::program::motion::Motion;
use crate::program::{Program, Statement};
use crate::sim::{Piece, Step, Trace};
use std::f64::consts::TAU;
use std::ops::Range;

/// Pieces that are worked on together: enough for every thread, few enough to stay small.
const BATCH: usize = 512;

/// Ways below this in the file's unit are none: finer than any file's decimals.
const SAME_PLACE: f64 = 1e-9;

/// Turns below this many radians are none: 0.00001 mm at 100 mm.
const SAME_AXIS: f64 = 1e-7;

impl Machining<'_> {
    /// Runs the program in layers, up to the last line asked for. `sink` gets every motion in order with its chip. `None` when
    /// `watch` stopped it.
    ///
    /// # Errors
    /// [`codes::LAYERS`] when the stock cannot be cut into such layers.
    pub fn chips(
        &self,
        options: &ChipOptions,
        watch: &dyn Watch,
        sink: &mut dyn FnMut(&ChipCut<'_>),
    ) -> Result<Option<ChipsRan>, Box<Diagnostic>> {
        let stack = Stack::new(&self.stock, options.layer).map_err(|error| {
            let message = format!("the stock cannot be cut into layers of {} mm: {error}", options.layer);
            Box::new(Diagnostic::new(codes::LAYERS, message))
        })?;
        let before_mm3 = stack.volume_mm3();
        let mut running = Running::new(self, options, stack);
        let unit = self.units.in_mm();
        let last = *options.lines.end();
        let motions = || self.program.motions().map(|motion| (line(self.program, &motion), motion));
        let whole: f64 =
            motions().take_while(|(line, _)| *line <= last).map(|(_, motion)| motion.length() * unit).sum();
        let mut done = 0.0;
        for (line, motion) in motions().take_while(|(line, _)| *line <= last) {
            done += motion.length() * unit;
            let alone = options.one_by_one && options.lines.contains(&line);
            if alone {
                running.flush(sink);
            }
            running.add(line, motion);
            if alone || running.steps.len() >= BATCH {
                running.flush(sink);
                watch.progress(done, whole);
            }
            if watch.is_stopped() {
                return Ok(None);
            }
        }
        running.flush(sink);
        let findings = running.end();
        Ok(Some(ChipsRan { left: running.stack, before_mm3, findings }))
    }
}

/// 1-based line of the statement that ends a motion.
fn line(program: &Program, motion: &Motion) -> usize {
    let start = program.statement(motion.last_statement()).map(Statement::origin).unwrap_or_default().start;
    program.source().line_column(start).0
}

/// A motion that waits to be cut together with others.
struct Waiting {
    motion: Motion,
    line: usize,
    cutter: Option<usize>,
    left_out: Option<LeftOut>,
    steps: Range<usize>,
}

struct Running<'r> {
    machining: &'r Machining<'r>,
    options: &'r ChipOptions,
    stack: Stack,
    trace: Trace,
    /// One for each cutter; those that are no flat end mills stand empty and are never asked for.
    mills: Vec<Result<FlatMill, Other>>,
    faults: Faults,
    steps: Vec<Step>,
    waiting: Vec<Waiting>,
}

/// A tool that is no flat end mill.
struct Other {
    has: String,
    motions: usize,
    first: Option<usize>,
}

impl<'r> Running<'r> {
    fn new(machining: &'r Machining<'_>, options: &'r ChipOptions, stack: Stack) -> Self {
        let other = |has: String| Other { has, motions: 0, first: None };
        let mills = machining.tooling.cutters().iter().map(|cutter| flat(cutter).map_err(other)).collect();
        Self {
            machining,
            options,
            stack,
            trace: Trace::new(machining.units.in_mm(), options.tolerance, options.longest),
            mills,
            faults: Faults::default(),
            steps: Vec::new(),
            waiting: Vec::new(),
        }
    }

    /// Lets a motion wait, with its pieces where it has some.
    fn add(&mut self, line: usize, motion: Motion) {
        self.trace.see(&motion);
        let start = self.steps.len();
        let cutter = self.machining.tooling.cutter_of(&motion);
        let left_out = self.leaves_out(&motion, cutter);
        if let Some(cutter) = cutter.filter(|_| left_out.is_none()) {
            self.trace.pieces(&motion, cutter, &mut self.steps);
        }
        let steps = start..self.steps.len();
        self.waiting.push(Waiting { motion, line, cutter, left_out, steps });
    }

    /// Why a motion is not cut; tells of it, too.
    fn leaves_out(&mut self, motion: &Motion, cutter: Option<usize>) -> Option<LeftOut> {
        if motion.path == Path::Start {
            return None;
        }
        let turns = motion.from.axis.angle(&motion.to.axis) > SAME_AXIS;
        if motion.length() <= SAME_PLACE && !turns {
            let message = "this motion goes nowhere: place and axis are those before it".to_owned();
            self.faults.tell(self.machining.program, motion, codes::STILL_MOTION, message, "stays");
            return Some(LeftOut::Still);
        }
        match cutter.and_then(|index| self.mills.get_mut(index)) {
            Some(Ok(_)) => None,
            Some(Err(other)) => {
                other.motions += 1;
                other.first.get_or_insert(motion.last_statement());
                Some(LeftOut::Tool)
            }
            None => Some(LeftOut::Unknown),
        }
    }

    /// Cuts what waits.
    fn flush(&mut self, sink: &mut dyn FnMut(&ChipCut<'_>)) {
        let nothing = FlatMill { radius: 0.0, flutes: 0.0 };
        let mills: Vec<FlatMill> =
            self.mills.iter().map(|mill| mill.as_ref().copied().unwrap_or(nothing)).collect();
        let pieces: Vec<Piece> = self.steps.iter().map(|step| step.piece).collect();
        let chips = cut(&mut self.stack, &mills, &pieces, self.options.tolerance);
        let bounds = self.machining.stock.bounds();
        let harmless = |step: &Step| {
            mills.get(step.piece.cutter).is_some_and(|mill| !reaches(&step.piece, mill, bounds))
        };
        let found: Vec<(Step, Result<Chip, Refusal>)> = self
            .steps
            .drain(..)
            .zip(chips)
            .map(|(step, chip)| match chip {
                // A chord of an arc that rounding has made a point, or a piece beside all material.
                Err(Refusal::Still) => (step, Ok(Chip::default())),
                Err(_) if harmless(&step) => (step, Ok(Chip::default())),
                chip => (step, chip),
            })
            .collect();
        for Waiting { motion, line, cutter, left_out, steps } in std::mem::take(&mut self.waiting) {
            let cut = ChipCut {
                motion: &motion,
                line,
                asked: self.options.lines.contains(&line),
                cutter,
                left_out,
                pieces: found.get(steps).unwrap_or_default(),
                stack: &self.stack,
            };
            look(&mut self.faults, self.machining, self.options, &mills, &cut);
            sink(&cut);
        }
    }

    /// All findings: those of motions, and one for each tool that is no flat end mill.
    fn end(&mut self) -> Vec<Diagnostic> {
        let program = self.machining.program;
        let mut findings = std::mem::take(&mut self.faults).end(program);
        for (index, other) in self.mills.iter().enumerate() {
            let (Err(other), Some(tool)) = (other, self.machining.tooling.tool(index)) else { continue };
            let Some(first) = other.first else { continue };
            let motions = match other.motions {
                1 => "its motion is left out, and the material that it".to_owned(),
                more => format!("its {more} motions are left out, and the material that they"),
            };
            let message = format!("{} has {}: {motions} would remove stays", tool.called(), other.has);
            let found = Diagnostic::new(codes::NO_FLAT_MILL, message);
            findings.push(found.label(program.source(), place(program, first), "its first motion"));
        }
        findings
    }
}

/// What is wrong with a motion.
fn look(
    faults: &mut Faults,
    machining: &Machining<'_>,
    options: &ChipOptions,
    mills: &[FlatMill],
    cut: &ChipCut<'_>,
) {
    if let Some((refusal, count)) = cut.refused() {
        let message = match cut.pieces.len() {
            1 => format!(
                "this motion cannot be modelled, and the material that it would remove stays: {refusal}"
            ),
            all => format!(
                "{count} of the {all} pieces of this motion cannot be modelled, and the material that they would remove stays: {refusal}"
            ),
        };
        faults.tell(machining.program, cut.motion, codes::CHIP_REFUSED, message, "left out");
    }
    let radius = cut.cutter.and_then(|index| mills.get(index)).map_or(0.0, |mill| mill.radius);
    let length = cut.motion.length() * machining.units.in_mm();
    // Slivers between the chords of one border and the next are no cuts.
    let sliver = options.tolerance * (length + TAU * radius);
    let layers = cut.chips().flat_map(|chip| &chip.layers).filter(|layer| layer.area_mm2 > sliver);
    let removed: f64 = layers.map(|layer| layer.area_mm2 * layer.thickness).sum();
    if removed > 0.0 {
        faults.removed(machining.program, cut.motion, removed);
    }
}
