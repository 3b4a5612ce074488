//! Running a program over its stock.

use super::faults::Faults;
use super::{Machining, Options, Watch};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::motion::Motion;
use crate::sim::{Dexels, Engagement, Piece, Simulation, Step, Trace};

/// Pieces that are worked on together: enough for every thread, few enough to stay small.
const BATCH: usize = 1024;

/// Largest distance of a chord from its arc, as a share of a cell and in mm.
const SAGITTA: (f64, f64) = (0.02, 0.002);

/// How far the chords of arcs and splines are from them at most, mm, with columns `cell` mm apart.
pub fn chord_mm(cell: f64) -> f64 {
    (cell * SAGITTA.0).min(SAGITTA.1)
}

/// A motion and what it engaged.
#[derive(Debug)]
pub struct Cut<'a> {
    /// The motion.
    pub motion: &'a Motion,
    /// Its number among all motions of the program.
    pub number: usize,
    /// Index of its cutter; `None` where the shape of a tool in a rapid is not known.
    pub cutter: Option<usize>,
    /// Its pieces in order, with the share of its length where each begins and ends; none for a motion that stays.
    pub pieces: &'a [(Step, Engagement)],
}

impl Cut<'_> {
    /// What the whole motion engaged; `None` for one that stays.
    pub fn whole(&self) -> Option<Engagement> {
        let (first, rest) = self.pieces.split_first()?;
        let mut whole = first.1.clone();
        rest.iter().for_each(|(_, piece)| whole.absorb(piece));
        Some(whole)
    }
}

/// What is left after a run.
#[derive(Debug)]
pub struct Ran {
    /// The stock that is left.
    pub left: Dexels,
    /// Volume of the stock before, mm3.
    pub before_mm3: f64,
    /// Distance of columns, mm.
    pub cell: f64,
    /// Collisions, cuts at rapid or without spindle.
    pub findings: Vec<Diagnostic>,
}

impl Machining<'_> {
    /// Runs the whole program. `sink` gets every motion in order with what it engaged. `None` when `watch` stopped it.
    ///
    /// # Errors
    /// As [`Machining::plan`].
    pub fn run(
        &self,
        options: &Options,
        watch: &dyn Watch,
        sink: &mut dyn FnMut(&Cut<'_>),
    ) -> Result<Option<Ran>, Box<Diagnostic>> {
        let plan = self.plan(options)?;
        let stock = self.stock.dexels(plan.cell, usize::MAX).map_err(|error| {
            Box::new(Diagnostic::new(codes::TOO_MUCH, format!("the stock cannot be simulated: {error}")))
        })?;
        let before_mm3 = stock.volume_mm3();
        let mut simulation = Simulation::new(stock, options.forces);
        let mut trace = Trace::new(self.units.in_mm(), chord_mm(plan.cell), options.longest);
        let mut faults = Faults::default();
        let mut batch = Batch::default();
        let mut done = 0.0;
        let mut motions = self.program.motions().enumerate();
        loop {
            let next = motions.next();
            if let Some((number, motion)) = &next {
                trace.see(motion);
                let cutter = self.tooling.cutter_of(motion);
                let start = batch.steps.len();
                if let Some(cutter) = cutter {
                    trace.pieces(motion, cutter, &mut batch.steps);
                }
                done += motion.length() * self.units.in_mm();
                batch.motions.push((*number, motion.clone(), cutter, start..batch.steps.len()));
            }
            if batch.steps.len() >= BATCH || next.is_none() {
                batch.run(self, &mut simulation, plan.cell, &mut faults, sink);
                watch.progress(done, plan.path_mm);
                if watch.is_stopped() {
                    return Ok(None);
                }
            }
            if next.is_none() {
                break;
            }
        }
        let findings = faults.end(self.program);
        Ok(Some(Ran { left: simulation.into_stock(), before_mm3, cell: plan.cell, findings }))
    }
}

/// Motions that wait to be simulated together.
#[derive(Default)]
struct Batch {
    steps: Vec<Step>,
    motions: Vec<(usize, Motion, Option<usize>, std::ops::Range<usize>)>,
}

impl Batch {
    fn run(
        &mut self,
        machining: &Machining<'_>,
        simulation: &mut Simulation,
        cell: f64,
        faults: &mut Faults,
        sink: &mut dyn FnMut(&Cut<'_>),
    ) {
        let cutters = machining.tooling.cutters();
        let pieces: Vec<Piece> = self.steps.iter().map(|step| step.piece).collect();
        let engaged = simulation.run(&pieces, cutters);
        let found: Vec<(Step, Engagement)> = self.steps.drain(..).zip(engaged).collect();
        for (number, motion, cutter, range) in self.motions.drain(..) {
            let cut = Cut { motion: &motion, number, cutter, pieces: found.get(range).unwrap_or_default() };
            if let (Some(whole), Some(cutter)) = (cut.whole(), cutter.and_then(|index| cutters.get(index))) {
                faults.look(machining.program, &motion, &whole, cutter, cell);
            }
            sink(&cut);
        }
    }
}
