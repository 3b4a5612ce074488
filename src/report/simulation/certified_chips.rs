//! This module replaces the chips that columns estimate by certified ones, so that a report and the step that set the
//! feeds tell the same figures.

use super::SimulationReport;
use crate::cutter::Teeth;
use crate::diagnostic::Failure;
use crate::engagement::thickest_chip_of_share_mm;
use crate::program::geometry::MotionPath;
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::report::text_format::format_counted;
use crate::simulation_run::{KnownShares, Machining, RunWatcher};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// How the chips of a report were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct ChipCertainty {
    /// The number of motions at feed whose thickest chip is bounded from the motions themselves: a point is known that
    /// has [`super::MotionRow::chip_thickness_mm`], and no point has more than the bound.
    pub certified: usize,
    /// The number of those whose bound is wider than was asked, because the search had used its budget.
    pub wide: usize,
    /// The number of cutting motions at feed whose chip is still the estimate of columns.
    pub by_columns: usize,
}

/// The chip of a motion, mm: what a point is known to have, and what no point exceeds.
struct CertifiedChip {
    lower_mm: f64,
    upper_mm: f64,
    is_tight: bool,
}

impl SimulationReport {
    /// Replaces the chips of columns by certified ones where the stock and the tool permit it. `known` are shares that
    /// are known of these motions already. Chips of other motions stay those of columns, and
    /// [`SimulationReport::chips`] tells how many.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run, or the findings of a run that takes too long.
    pub fn certify_chips(
        &mut self,
        machining: &Machining<'_>,
        known: &KnownShares,
        watch: &dyn RunWatcher,
    ) -> Result<(), Failure> {
        let chips = find_certified_chips(machining, known, watch)?;
        let mut certainty = ChipCertainty::default();
        // The first point of a program is no motion, so it has no row.
        let motions = machining.program().motions().enumerate();
        let with_rows = motions.filter(|(_, motion)| motion.path != MotionPath::Start);
        for ((number, _), row) in with_rows.zip(&mut self.motions.rows) {
            match chips.get(&number) {
                Some(chip) => {
                    row.chip_thickness_mm = Some(chip.lower_mm);
                    row.chip_thickness_bound_mm = Some(chip.upper_mm);
                    certainty.certified += 1;
                    certainty.wide += usize::from(!chip.is_tight);
                }
                None => {
                    let is_cut = !row.rapid && row.chip_thickness_bound_mm.is_some_and(|chip| chip > 0.0);
                    certainty.by_columns += usize::from(is_cut);
                }
            }
        }
        self.chips = Some(certainty);
        self.raise_chips_anew();
        Ok(())
    }

    /// Tells how far the thickest chips are known, as a sentence without its full stop, for a reader of these units.
    pub fn describe_chip_certainty(&self, units: DisplayUnits) -> String {
        let cell = units.tell_trimmed(ColumnUnit::Length, self.accuracy.cell_mm, 3);
        let by_columns = format!("with what columns {cell} apart may have missed");
        let Some(chips) = self.chips.filter(|chips| chips.certified > 0) else {
            return format!("chips at most: {by_columns}");
        };
        let mut told =
            "chips are proved from the motions: a point cuts with the first figure, none with more than \
                        the second"
                .to_owned();
        let motions = |count: usize| format_counted(count, "motion", "motions");
        if chips.wide > 0 {
            told.push_str(&format!("; for {} the search ended early", motions(chips.wide)));
        }
        if chips.by_columns > 0 {
            told.push_str(&format!("; for {} {by_columns}", motions(chips.by_columns)));
        }
        told
    }

    fn raise_chips_anew(&mut self) {
        self.totals.forget_chips();
        self.operations.iter_mut().for_each(|operation| operation.sums.forget_chips());
        // Only operations that move have sums.
        let moving: BTreeSet<usize> = self.motions.rows.iter().map(|row| row.operation).collect();
        let places: BTreeMap<usize, usize> = moving.into_iter().zip(0..).collect();
        debug_assert_eq!(places.len(), self.operations.len(), "every operation that moves has sums");
        for row in &self.motions.rows {
            self.totals.raise_chips(row);
            let place = places.get(&row.operation).and_then(|place| self.operations.get_mut(*place));
            if let Some(operation) = place {
                operation.sums.raise_chips(row);
            }
        }
    }
}

/// Returns the chips of the motions at feed whose feed, spindle speed and teeth are known, by the motions' numbers.
fn find_certified_chips(
    machining: &Machining<'_>,
    known: &KnownShares,
    watch: &dyn RunWatcher,
) -> Result<BTreeMap<usize, CertifiedChip>, Failure> {
    let tooling = machining.tooling();
    let mut asked: BTreeMap<usize, (&Teeth, f64, f64)> = BTreeMap::new();
    for (number, motion) in machining.program().motions().enumerate() {
        if motion.rapid || motion.path == MotionPath::Start {
            continue;
        }
        let cutter = tooling.cutter_index(&motion).and_then(|index| tooling.cutters().get(index));
        let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
        let length = Some(motion.length());
        let feed = motion.feed.and_then(|feed| feed.mm_per_minute(machining.length_unit(), rpm, length));
        let teeth = cutter.and_then(|cutter| cutter.teeth.as_ref());
        if let (Some(teeth), Some(feed), Some(rpm)) = (teeth, feed.filter(|feed| *feed > 0.0), rpm) {
            asked.insert(number, (teeth, feed, rpm));
        }
    }
    let shares = machining.certify_whole_motions(&|motion| asked.contains_key(&motion), known, watch)?;
    let Some(shares) = shares else { return Ok(BTreeMap::new()) };
    let chip = |(number, (teeth, feed, rpm)): (&usize, &(&Teeth, f64, f64))| {
        let pieces = shares.pieces_of(*number)?;
        let largest = |shares: [f64; 2], piece: [f64; 2]| [shares[0].max(piece[0]), shares[1].max(piece[1])];
        let interval = pieces.iter().map(|piece| [piece.lower, piece.upper]).fold([0.0; 2], largest);
        let [lower_mm, upper_mm] = interval.map(|share| thickest_chip_of_share_mm(share, teeth, *feed, *rpm));
        // Where nothing limits a share, columns say more.
        let is_bounded = upper_mm.is_finite();
        let is_tight = pieces.iter().all(|piece| piece.is_tight);
        is_bounded.then_some((*number, CertifiedChip { lower_mm, upper_mm, is_tight }))
    };
    Ok(asked.iter().filter_map(chip).collect())
}
