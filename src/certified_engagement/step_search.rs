//! This module searches the surface of a cutter on one step for the largest chip, by branch and bound.
//!
//! Patches wait in a queue, the one with the largest upper bound first. A patch that is proved to be without
//! material is dropped; from others a point is tried as a witness, which raises the lower bound, and they
//! are halved. The search ends when no patch can exceed the lower bound by more than the tolerance, or when
//! the budget is used.

use super::advance::AdvanceField;
use super::block_bound::EngagementOptions;
use super::certified_program::{CertifiedProgram, SearchedStep};
use super::cover_test::{CoverBuffers, MATERIAL_TOLERANCE_MM};
use super::cutter_contour::CutterContour;
use super::known_patches::KnownPatches;
use super::material_witness::{EngagementWitness, WitnessPlace};
use super::near_steps::NearSteps;
use super::surface_patch::{SurfacePatch, root_patches, surface_point};
use super::swept_step::SweptStep;
use std::collections::BinaryHeap;

/// What is bounded.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum EngagementCriterion {
    /// The largest share: the speed along the surface's normal, divided by the speed of the tip.
    Share,
    /// The largest chip thickness in mm: share times feed per tooth, and never more than the material along
    /// the normal.
    Chip {
        /// The feed per tooth, mm.
        feed_per_tooth_mm: f64,
    },
}

/// Shares below this count as none: with a feed per tooth of 0.1 mm such a chip is as thin as the tolerance.
const LEAST_SHARE: f64 = 1e-5;
/// The most points around which a fan is searched.
const MOST_FANS: usize = 4;
/// The most climbs of one step.
const MOST_CLIMBS: usize = 6;
/// After so many patches without any material, points all over the surface are tried.
const PATCHES_BEFORE_SEEDS: usize = 64;

impl EngagementCriterion {
    /// Returns by what a share is multiplied.
    pub(super) fn scale(self) -> f64 {
        match self {
            Self::Share => 1.0,
            Self::Chip { feed_per_tooth_mm } => feed_per_tooth_mm,
        }
    }

    /// Returns the value below which there is none.
    pub(super) fn floor(self) -> f64 {
        match self {
            Self::Share => LEAST_SHARE,
            Self::Chip { .. } => MATERIAL_TOLERANCE_MM,
        }
    }
}

/// The search on one step.
pub(super) struct StepSearch<'a> {
    pub program: &'a CertifiedProgram,
    pub options: &'a EngagementOptions,
    pub criterion: EngagementCriterion,
    /// The first sweep of the own step, and their number.
    pub own_first: u32,
    pub own_count: u32,
    /// The part of the block's time that the step takes.
    pub time_part: [f64; 2],
    pub step: &'a SweptStep,
    pub contour: &'a CutterContour,
    pub advance: AdvanceField,
    pub reference: f64,
    pub heading: f64,
    /// Steps from this number on are not earlier.
    pub before: u32,
    pub lower: f64,
    /// What the point that is tried could reach.
    pub potential: f64,
    pub witness: Option<WitnessPlace>,
    pub found: Option<EngagementWitness>,
    pub buffers: CoverBuffers,
    /// The steps that covered patches last.
    pub hot: Vec<u32>,
    /// How many more patches may be examined.
    pub budget: usize,
    pub patches: usize,
    pub near_steps: NearSteps,
    pub coincident: Option<Vec<[f64; 2]>>,
    /// The patches that are done with, for the next block; `None` if it has no use of them.
    pub known: Option<KnownPatches>,
    /// Buffers: the steps that are tried first, and those that may touch a patch.
    pub quick: Vec<u32>,
    pub near: Vec<u32>,
    queue: BinaryHeap<SurfacePatch>,
    pub settled: f64,
    pub climbs: usize,
    /// How many more points into which the search zooms are looked around.
    pub fans: usize,
    /// How many more patches of this step may be examined.
    pub rounds: usize,
    /// How many lines may be tested against sweeps.
    pub most_line_tests: u64,
}

impl<'a> StepSearch<'a> {
    /// Prepares the search on a step; `None` if the program has no such step.
    pub(super) fn new(
        program: &'a CertifiedProgram,
        options: &'a EngagementOptions,
        criterion: EngagementCriterion,
        own: &SearchedStep<'a>,
    ) -> Option<Self> {
        let step = own.step;
        let contour = program.cutters().get(step.cutter)?;
        let advance = AdvanceField::new(step, own.reference);
        let before = match criterion {
            EngagementCriterion::Share if own.sweep_count > 1 => own.first_sweep + own.sweep_count,
            EngagementCriterion::Share => own.first_sweep,
            // A chip is what is left by other blocks: all of a cutter's inside was in its own sweep.
            EngagementCriterion::Chip { .. } => program.first_step_of(step.block)?,
        };
        Some(Self {
            program,
            options,
            criterion,
            own_first: own.first_sweep,
            own_count: own.sweep_count,
            time_part: own.time_part,
            step,
            contour,
            advance,
            reference: own.reference,
            heading: advance.heading(),
            before,
            lower: 0.0,
            potential: 0.0,
            witness: None,
            found: None,
            buffers: CoverBuffers::default(),
            hot: Vec::new(),
            budget: options.most_patches,
            patches: 0,
            near_steps: NearSteps { caps: [f64::INFINITY; 4], lists: Default::default() },
            coincident: None,
            known: None,
            quick: Vec::new(),
            near: Vec::new(),
            queue: BinaryHeap::new(),
            settled: 0.0,
            climbs: MOST_CLIMBS,
            fans: MOST_FANS,
            rounds: options.most_patches,
            most_line_tests: options.most_line_tests,
        })
    }

    /// Returns the number below which sweeps are over at a time.
    pub(super) fn own_sweeps_over(&self, time: f64) -> u32 {
        self.own_first + (time * f64::from(self.own_count) - 1e-9).max(0.0) as u32
    }

    /// Returns the number below which sweeps may cover a patch from a time on. The own sweep that was just
    /// over touches the patch, and would cover what it is about to cut.
    pub(super) fn own_sweeps_apart(&self, time: f64) -> u32 {
        self.own_sweeps_over(time).saturating_sub(1).max(self.own_first)
    }

    /// Returns the value that a patch must exceed to be of interest.
    pub(super) fn threshold(&self) -> f64 {
        (self.lower * (1.0 + self.options.tolerance)).max(self.criterion.floor())
    }

    /// Runs the search. Returns a value that nothing on the step exceeds.
    pub(super) fn run(&mut self) -> f64 {
        if !self.program.is_near_stock(&self.step.bounds(self.contour, self.program.stock_top())) {
            return self.lower;
        }
        for patch in self.first_patches() {
            self.enqueue(patch);
        }
        if self.queue.is_empty() {
            self.keep_waiting(true);
            return self.settled;
        }
        if let Some(place) = self.witness.take() {
            self.try_witness(place);
        }
        let mut is_complete = true;
        while let Some(patch) = self.queue.pop() {
            let is_spent = self.budget == 0 || self.rounds == 0 || self.buffers.tests >= self.most_line_tests;
            if patch.upper <= self.threshold() || is_spent {
                self.settled = self.settled.max(patch.upper);
                self.keep_patch(&patch);
                is_complete = !is_spent;
                break;
            }
            self.budget -= 1;
            self.rounds -= 1;
            self.patches += 1;
            self.examine(patch);
            if self.lower == 0.0
                && (self.patches == PATCHES_BEFORE_SEEDS || self.patches == PATCHES_BEFORE_SEEDS * 16)
            {
                self.sow_seeds();
            }
        }
        self.keep_waiting(is_complete);
        self.settled.max(self.lower)
    }

    /// Returns the patches that the search begins with: those of the block before, if they are known.
    fn first_patches(&mut self) -> Vec<SurfacePatch> {
        let roots = self.roots();
        let farthest = self.farthest();
        let (cutter, heading) = (self.step.cutter, self.heading);
        let known = self.known.as_mut();
        known.and_then(|known| known.take_patches(cutter, farthest, heading)).unwrap_or(roots)
    }

    /// Notes a patch that is done with.
    pub(super) fn keep_patch(&mut self, patch: &SurfacePatch) {
        if let Some(known) = &mut self.known {
            known.add(patch, self.heading);
        }
    }

    /// Notes the patches that wait when the search ends.
    fn keep_waiting(&mut self, is_complete: bool) {
        let Some(known) = &mut self.known else { return };
        self.queue.drain().for_each(|patch| known.add(&patch, self.heading));
        known.finish(self.patches, is_complete);
    }

    /// Returns the patches that a search begins with, and sets the heights of lists of near steps.
    pub(super) fn roots(&mut self) -> Vec<SurfacePatch> {
        let lowest = self.step.tips[0].z.min(self.step.tips[1].z);
        if self.step.axes.iter().all(|axis| axis.z > 0.999) {
            let radius = self.contour.radius_mm();
            self.near_steps.caps = [0.5, 1.0, 2.0, f64::INFINITY].map(|part| lowest + radius * part);
        }
        root_patches(self.contour, self.heading, self.farthest())
    }

    /// Returns the height above the tip that no stock exceeds, mm. It is a whole number of radii, so that near blocks
    /// agree.
    fn farthest(&self) -> f64 {
        let radius = self.contour.radius_mm().max(1.0);
        ((self.program.farthest_from(&self.step.tips) + 1.0) / radius).ceil() * radius
    }

    /// Adds a patch to the queue, unless it is below the threshold.
    pub(super) fn enqueue(&mut self, mut patch: SurfacePatch) {
        let Some(element) = self.contour.elements().get(patch.element) else { return };
        let share = self.advance.upper(element, patch.range, patch.angles, patch.need);
        patch.upper = share * self.criterion.scale();
        if patch.upper > self.threshold() {
            self.queue.push(patch);
        } else {
            self.keep_patch(&patch);
            self.settled = self.settled.max(patch.upper);
        }
    }

    /// Tries the place where material was found on the step before.
    fn try_witness(&mut self, place: WitnessPlace) {
        let Some(element) = self.contour.elements().get(place.element) else { return };
        let angle = self.heading + place.from_heading;
        let path = self.step.path_of(&surface_point(element, place.parameter, angle, 0.0), [0.0, 1.0]);
        let highest = if self.step.is_straight() || self.step.is_upright() && self.step.flat.is_some() {
            path.at(0.0).z.max(path.at(1.0).z) + self.criterion.scale()
        } else {
            f64::MAX
        };
        let candidates = self.near_steps(highest);
        self.try_point((place.element, place.parameter, angle), 0.0, [0.0, 1.0], &candidates);
    }

    /// Returns the axis across which hulls are wider, or zero if it turns.
    pub(super) fn side_axis(&self) -> nalgebra::Vector3<f64> {
        if self.step.turn == 0.0 { self.step.axes[0] } else { nalgebra::Vector3::zeros() }
    }
}
