//! This module collects the faults of a run as findings, each with its place.

use super::tooling::statement_span;
use crate::cutter::{CutterModel, NonCuttingKind};
use crate::diagnostic::{Diagnostic, codes};
use crate::engagement::{Engagement, PillarContact};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::presentation::text_format::format_fixed;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program};

/// Collects the faults of a run. They tell lengths in the unit of the program, whose lines stand beside them.
#[derive(Debug)]
pub(super) struct FaultCollector {
    found: Vec<Diagnostic>,
    units: DisplayUnits,
}

impl FaultCollector {
    /// Collects faults of a program whose lengths are in `units`.
    pub(super) fn for_units(units: LengthUnit) -> Self {
        Self { found: Vec::new(), units: DisplayUnits::from_mm(units) }
    }

    /// Checks the engagement of a motion. `cell_mm` is the distance of columns, mm.
    pub(super) fn check_engagement(
        &mut self,
        program: &Program,
        motion: &Motion,
        found: &Engagement,
        cutter: &CutterModel,
        cell_mm: f64,
    ) {
        if let Some((index, depth)) = found.contact {
            let what = match cutter.collars.get(index).map(|collar| collar.kind) {
                Some(NonCuttingKind::Holder) => "holder",
                _ => "shank",
            };
            let told = self.units.tell_fixed(ColumnUnit::Length, depth, 2);
            let message = format!("the {what} stands {told} deep in material");
            self.add_finding(
                program,
                motion,
                Diagnostic::new(codes::COLLISION, message).with_magnitude(depth),
                "on this motion",
            );
        }
        if let Some(pillar) = found.pillar {
            self.report_pillar(program, motion, pillar);
        }
        // A volume below a cell's cube is rounding, where a rapid touches the stock.
        if found.has_removed_material() && found.removed_mm3 >= cell_mm.powi(3) {
            self.check_removal(program, motion, found.removed_mm3);
        }
    }

    /// Reports material that the middle of an indexable cutter runs into.
    fn report_pillar(&mut self, program: &Program, motion: &Motion, pillar: PillarContact) {
        let tell = |mm: f64| self.units.tell_fixed(ColumnUnit::Length, mm, 2);
        let [x, y, z] = pillar.place_mm.map(|mm| {
            let decimals = self.units.decimals(ColumnUnit::Length, 2);
            format_fixed(self.units.convert(ColumnUnit::Length, mm), decimals)
        });
        let message = format!(
            "the middle of the cutter, which does not cut, runs into a pillar that stands {} above the tip at {x}, {y}, {z}; \
             the inserts clear {}, so {} are left over",
            tell(pillar.height_mm),
            tell(pillar.clearance_mm),
            tell(pillar.depth_mm())
        );
        let found = Diagnostic::new(codes::PILLAR, message).with_magnitude(pillar.depth_mm());
        self.add_finding(program, motion, found, "on this motion");
    }

    /// Notes that the middle of an indexable cutter is taken to cut where its axis is tilted.
    pub(super) fn note_tilted_middle(&mut self, program: &Program, motion: &Motion) {
        let message =
            "the axis is tilted from here on, and the middle of the cutter is taken to cut as its inserts do";
        self.add_finding(program, motion, Diagnostic::new(codes::ASSUMPTION, message), "tilted");
    }

    /// Checks a motion that removed a volume in mm3. No rapid may remove material, and no tool whose spindle
    /// does not turn.
    pub(super) fn check_removal(&mut self, program: &Program, motion: &Motion, removed_mm3: f64) {
        if motion.rapid {
            let removed = self.units.tell_fixed(ColumnUnit::Volume, removed_mm3, 3);
            let message = format!("a rapid goes through material and takes {removed} of it");
            let found = Diagnostic::new(codes::RAPID_THROUGH_STOCK, message).with_magnitude(removed_mm3);
            self.add_finding(program, motion, found, "at rapid");
        } else if motion.spindle.as_deref().is_none_or(|spindle| !spindle.on) {
            let message = "the tool cuts while the spindle stands".to_owned();
            self.add_finding(program, motion, Diagnostic::new(codes::SPINDLE_STANDS, message), "cuts");
        }
    }

    /// Reports a motion that is divided less finely than the tolerance asks for.
    pub(super) fn report_piece_limit(&mut self, program: &Program, motion: &Motion) {
        let message =
            "this motion bends too much for the pieces that it may have, and is divided less finely";
        self.add_finding(program, motion, Diagnostic::new(codes::PIECE_LIMIT, message), "divided coarsely");
    }

    /// Makes the error for a motion that tilts a cutter of which only upright sweeps are known.
    pub(super) fn refuse_tilted_undercut(&self, program: &Program, motion: &Motion) -> Diagnostic {
        let message = "a cutter that is narrower above its widest place is tilted here; only upright ones can be \
                       simulated";
        let at = statement_span(program, motion.last_statement());
        Diagnostic::new(codes::TILTED_UNDERCUT, message).with_label(program.source(), at, "tilted")
    }

    /// Adds a finding at a motion.
    pub(super) fn add_finding(&mut self, program: &Program, motion: &Motion, found: Diagnostic, label: &str) {
        let at = statement_span(program, motion.last_statement());
        self.found.push(found.with_label(program.source(), at, label));
    }

    /// Takes all findings, in the order of the motions.
    pub(super) fn take_findings(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.found)
    }
}
