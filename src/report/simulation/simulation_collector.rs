//! This module collects the rows and sums of a simulation, motion by motion.

use super::range_watch::RangeWatch;
use super::removal_peak::RemovalPeakFinder;
use super::unknown_feeds::UnknownFeedCollector;
use super::{MotionRow, MotionRows, OperationSums, SimulationFaultCounts, SimulationSums};
use crate::cutter::{CutterModel, Teeth};
use crate::diagnostic::{Diagnostic, Severity};
use crate::engagement::{CuttingLoads, Engagement, LoadModel, removal_window_mm};
use crate::program::geometry::MotionPath;
use crate::program::motion::{ActiveTool, Motion};
use crate::program::operation;
use crate::program::record::SpindleDirection;
use crate::report::machine_time::{GroupTimer, MachineClock};
use crate::report::table::DisplayUnits;
use crate::report::{statement_line, tool_name};
use crate::simulation_run::{EngagedMotion, Machining, MotionForces};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The state while motions are processed.
pub(super) struct SimulationCollector<'m, 'p> {
    machining: &'m Machining<'p>,
    /// A removed volume below this, in mm3, is rounding.
    speck: f64,
    /// The machine's rapid feed, mm/min.
    rapid: Option<f64>,
    /// The load models of all cutters for a spindle that turns clockwise and counterclockwise, if the
    /// material is known, for motions whose forces are not found from the motions themselves.
    models: Option<Vec<Option<[LoadModel; 2]>>>,
    /// The forces that were found from the motions themselves.
    forces: BTreeMap<usize, MotionForces>,
    /// The number of cuts whose loads are those of columns.
    loads_of_columns: usize,
    motions: MotionRows,
    tools: Vec<Option<Arc<ActiveTool>>>,
    totals: SimulationSums,
    operations: Vec<(Option<usize>, SimulationSums)>,
    timer: GroupTimer,
    clock: MachineClock,
    /// A timer for each operation.
    operation_timers: Vec<GroupTimer>,
    removal: RemovalPeakFinder,
    /// The tool of the motion before, if that was at feed: then windows of removal rates may continue into
    /// the next motion of the tool.
    chained: Option<usize>,
    faults: SimulationFaultCounts,
    unknown: UnknownFeedCollector,
    ranges: RangeWatch,
    /// The number of cuts for which the direction of the spindle is not stated.
    senseless: usize,
}

/// The collected results.
pub(super) struct CollectedSimulation {
    pub motions: MotionRows,
    pub totals: SimulationSums,
    pub operations: Vec<OperationSums>,
    pub faults: SimulationFaultCounts,
    pub assumptions: Vec<String>,
    pub findings: Vec<Diagnostic>,
}

impl<'m, 'p> SimulationCollector<'m, 'p> {
    /// Starts with the forces of motions, by their numbers, as far as they were found.
    pub(super) fn new(
        machining: &'m Machining<'p>,
        cell: f64,
        forces: BTreeMap<usize, MotionForces>,
    ) -> Self {
        let machine = &machining.setup().machine;
        let rapid = machine.rapid_feed.map(|feed| feed.get());
        let material = machining.setup().require_material().ok();
        let names = operation::find_operations(machining.program());
        let sums = SimulationSums::new(rapid.is_some());
        let clock = MachineClock::new(machining.program(), machining.length_unit(), machining.setup());
        let operation_timers = vec![clock.start_timer(); names.len()];
        let timer = clock.start_timer();
        Self {
            machining,
            speck: cell.powi(3),
            rapid,
            models: material.map(|material| machining.tooling().build_load_models(&material.law)),
            forces,
            loads_of_columns: 0,
            totals: sums,
            operations: vec![(None, sums); names.len()],
            motions: MotionRows {
                operations: names.into_iter().map(|operation| operation.name).collect(),
                ..MotionRows::default()
            },
            tools: Vec::new(),
            timer,
            clock,
            operation_timers,
            removal: RemovalPeakFinder::new(removal_window_mm(cell)),
            chained: None,
            faults: SimulationFaultCounts::default(),
            unknown: UnknownFeedCollector::default(),
            ranges: RangeWatch::new(material.map(|material| &material.origin)),
            senseless: 0,
        }
    }

    /// Returns the number of motions so far, without first points.
    pub(super) fn motion_count(&self) -> usize {
        self.motions.rows.len()
    }

    /// Adds a motion.
    pub(super) fn add_motion(&mut self, cut: &EngagedMotion<'_>) {
        let motion = cut.motion;
        if motion.path == MotionPath::Start {
            return;
        }
        let program = self.machining.program();
        let unit = self.machining.length_unit();
        let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
        let feed = if motion.rapid {
            self.rapid
        } else {
            let length = Some(motion.length());
            motion.feed.and_then(|feed| feed.mm_per_minute(unit, rpm, length)).filter(|feed| *feed > 0.0)
        };
        let length_mm = motion.length() * unit.mm_per_unit();
        let statement = program.statement(motion.last_statement());
        let time = self.clock.motion_time(self.motions.rows.len());
        let mut row = MotionRow {
            line: statement_line(program, statement),
            operation: motion.operation,
            tool: self.tool_index(motion),
            rapid: motion.rapid,
            length_mm,
            feed_mm_min: feed,
            seconds: if length_mm > 0.0 { feed.map(|feed| length_mm / feed * 60.0) } else { Some(0.0) },
            machine_seconds: time.and_then(|time| time.seconds),
            standing_seconds: time.map(|time| time.standing_s),
            ..MotionRow::default()
        };
        let whole = cut.whole_engagement();
        let removed = whole.as_ref().map_or(0.0, |whole| whole.removed_mm3);
        let cutters = self.machining.tooling().cutters();
        match (&whole, cut.cutter.and_then(|index| cutters.get(index))) {
            (Some(whole), Some(cutter)) if whole.has_removed_material() => {
                self.fill_cutting_row(cut, whole, cutter, rpm, &mut row)
            }
            (_, Some(_)) => self.fill_air_row(cut, &mut row),
            (_, None) => {}
        }
        if let Some(whole) = &whole {
            self.faults.collisions += usize::from(whole.contact.is_some());
            row.is_crash = whole.contact.is_some();
            if whole.has_removed_material() && removed >= self.speck {
                let stands = motion.spindle.as_deref().is_none_or(|spindle| !spindle.on);
                self.faults.rapids_in_material += usize::from(motion.rapid);
                row.is_crash |= motion.rapid;
                self.faults.spindle_stands += usize::from(!motion.rapid && stands);
                self.unknown.check_motion(program, motion, feed, rpm);
            }
        }
        self.follow_feed_path(cut, &row);
        self.totals.add_motion(&row, removed);
        if let Some((tool, sums)) = self.operations.get_mut(row.operation) {
            tool.get_or_insert(row.tool);
            sums.add_motion(&row, removed);
        }
        self.motions.rows.push(row);
    }

    /// Fills the row of a motion that cuts.
    fn fill_cutting_row(
        &mut self,
        cut: &EngagedMotion<'_>,
        whole: &Engagement,
        cutter: &CutterModel,
        rpm: Option<f64>,
        row: &mut MotionRow,
    ) {
        let told = cut.motion.spindle.as_deref().and_then(|spindle| spindle.direction);
        self.senseless += usize::from(told.is_none() && rpm.is_some());
        let sense = told.unwrap_or(SpindleDirection::Clockwise);
        let [_, high] = whole.height_mm;
        row.axial_depth_mm = Some(whole.axial_depth_mm());
        row.radial_depth_mm =
            Some(whole.radial_depth_mm().min(2.0 * cutter.profile.radius_at_height_mm(high)));
        let angles = whole.immersion_deg(&cutter.profile, sense);
        row.engagement_start_deg = angles.map(|[start, _]| start);
        row.engagement_end_deg = angles.map(|[_, end]| end);
        row.removal_rate_mm3_min = row.feed_mm_min.map(|feed| whole.removal_rate_mm3_min(feed));
        let Some((feed, rpm)) = row.feed_mm_min.zip(rpm) else { return };
        let pieces =
            || cut.pieces.iter().map(|(_, piece)| piece).filter(|piece| piece.has_removed_material());
        row.chip_thickness_mm = cutter
            .teeth
            .as_ref()
            .map(|teeth| pieces().map(|piece| piece.chip_thickness_mm(teeth, feed, rpm)).fold(0.0, f64::max));
        if !row.rapid {
            let speed = std::f64::consts::PI * 2.0 * cutter.radius_mm() * rpm / 1000.0;
            self.ranges.check_cut(row.chip_thickness_mm, Some(speed), row.axial_depth_mm);
        }
        let bound = |piece: &Engagement, teeth: &Teeth| piece.chip_thickness_bound_mm(teeth, feed, rpm);
        row.chip_thickness_bound_mm =
            cutter.teeth.as_ref().map(|teeth| pieces().map(|piece| bound(piece, teeth)).fold(0.0, f64::max));
        if let Some(forces) = self.forces.get(&cut.number) {
            row.fill_forces(forces);
            return;
        }
        let models =
            self.models.as_ref().zip(cut.cutter).and_then(|(models, index)| models.get(index)?.as_ref());
        let Some([clockwise, counter]) = models else { return };
        let model = if sense == SpindleDirection::Clockwise { clockwise } else { counter };
        self.loads_of_columns += 1;
        // The loads are computed piece by piece, because the ends of an arc are not engaged at the same time.
        let none = CuttingLoads { force_n: 0.0, torque_nm: 0.0, power_kw: 0.0 };
        let largest =
            pieces().map(|piece| model.cutting_loads(piece, feed, rpm)).fold(none, |a, b| CuttingLoads {
                force_n: a.force_n.max(b.force_n),
                torque_nm: a.torque_nm.max(b.torque_nm),
                power_kw: a.power_kw.max(b.power_kw),
            });
        row.force_n = Some(largest.force_n);
        row.torque_nm = Some(largest.torque_nm);
        row.power_kw = Some(largest.power_kw);
    }

    /// Fills the row of a motion that cuts nothing.
    fn fill_air_row(&self, cut: &EngagedMotion<'_>, row: &mut MotionRow) {
        let zero = Some(0.0);
        row.chip_thickness_mm = zero;
        row.chip_thickness_bound_mm = zero;
        row.removal_rate_mm3_min = zero;
        row.axial_depth_mm = zero;
        row.radial_depth_mm = zero;
        match self.forces.get(&cut.number) {
            // What is thinner than a column is known to the motions.
            Some(forces) => row.fill_forces(forces),
            None if self.models.is_some() => {
                let beam = cut.cutter.and_then(|index| self.machining.tooling().beam_of_cutter(index));
                row.fill_forces(&MotionForces::in_air(beam.is_some()));
            }
            None => {}
        }
    }

    /// Adds a motion to the path at feed, for the time with acceleration and for the largest removal rate. A
    /// rapid, another tool or a feed that is not known ends the path over which removal rates are averaged.
    fn follow_feed_path(&mut self, cut: &EngagedMotion<'_>, row: &MotionRow) {
        let program = self.machining.program();
        let (number, moved) = (self.motions.rows.len(), (row.length_mm, row.feed_mm_min));
        self.timer.add_motion(program, cut.motion, number, moved);
        if let Some(timer) = self.operation_timers.get_mut(row.operation) {
            timer.add_motion(program, cut.motion, number, moved);
        }
        let at_feed = row.feed_mm_min.filter(|_| !row.rapid && cut.cutter.is_some());
        if at_feed.is_none() || self.chained != Some(row.tool) {
            self.removal.end_path();
        }
        self.chained = at_feed.map(|_| row.tool);
        let Some(feed) = at_feed else { return };
        for (step, engaged) in cut.pieces {
            let length = (step.piece.to.point - step.piece.from.point).norm();
            // On the path of a machine the tip is faster or slower than programmed.
            self.removal.add_piece(
                self.motions.rows.len(),
                feed,
                length / step.pace.max(f64::MIN_POSITIVE),
                engaged,
            );
        }
    }

    /// Adds what is only known after the last motion: times with acceleration and largest removal rates.
    fn finish_sums(&mut self) {
        self.totals.accelerated_seconds = self.timer.feed_seconds();
        self.timer.replace_rapid_seconds(&mut self.totals.rapid_seconds);
        self.totals.standing_seconds = self.timer.standing_seconds();
        for ((_, sums), timer) in self.operations.iter_mut().zip(&self.operation_timers) {
            sums.accelerated_seconds = timer.feed_seconds();
            timer.replace_rapid_seconds(&mut sums.rapid_seconds);
            sums.standing_seconds = timer.standing_seconds();
        }
        let removal = std::mem::replace(&mut self.removal, RemovalPeakFinder::new(1.0));
        for (row, peak) in self.motions.rows.iter_mut().zip(removal.into_peaks()) {
            row.peak_removal_rate_mm3_min = peak;
            self.totals.add_removal_peak(row);
            if let Some((_, sums)) = self.operations.get_mut(row.operation) {
                sums.add_removal_peak(row);
            }
        }
    }

    /// Returns the index of a motion's tool.
    fn tool_index(&mut self, motion: &Motion) -> usize {
        let same = |known: &Option<Arc<ActiveTool>>| match (known, &motion.tool) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b) || (a.number, &a.name) == (b.number, &b.name),
            (None, None) => true,
            _ => false,
        };
        if let Some(index) = self.tools.iter().rposition(same) {
            return index;
        }
        self.tools.push(motion.tool.clone());
        self.motions.tools.push(tool_name(motion.tool.as_deref()));
        self.tools.len() - 1
    }

    /// Returns the results.
    pub(super) fn into_collected(mut self) -> CollectedSimulation {
        self.finish_sums();
        let program = self.machining.program();
        self.faults.unknown_feeds = self.unknown.count;
        let mut findings = self.unknown.into_findings();
        let units = DisplayUnits::of_program(self.machining.length_unit(), None);
        findings.extend(self.ranges.into_findings(units));
        let gaps = self.machining.tooling().find_missing_teeth(program, self.machining.setup(), &|_| true);
        // Without teeth only some cells of the rows stay empty, so this is a warning and no error.
        findings.extend(gaps.into_iter().map(|gap| Diagnostic { severity: Severity::Warning, ..gap }));
        let mut assumptions = Vec::new();
        if self.models.is_none() {
            assumptions.push("no material is given, so forces are not computed".to_owned());
        }
        if self.loads_of_columns > 0 {
            let count = self.loads_of_columns;
            let what = if count == 1 { "1 cut" } else { &format!("{count} cuts") };
            assumptions.push(format!(
                "force, torque and power of {what} are those of columns, and without means: the tool is narrower above its \
                 widest place or does not cut in its middle, or the stock is no closed body"
            ));
        }
        assumptions.extend(self.machining.told_machine_path().iter().cloned());
        if self.totals.rapid_seconds.is_none() && self.totals.rapid_mm > 0.0 {
            assumptions.push("the machine's rapid feed is not known, so rapids take no time".to_owned());
        }
        if self.senseless > 0 {
            let count = self.senseless;
            let what = if count == 1 { "1 cut" } else { &format!("{count} cuts") };
            assumptions
                .push(format!("the sense of the spindle is not stated for {what}: clockwise is assumed"));
        }
        let tools = &self.motions.tools;
        let named = self.operations.iter().zip(&self.motions.operations);
        let operations = named
            .filter(|((_, sums), _)| sums.motions > 0)
            .map(|((tool, sums), name)| OperationSums {
                name: name.clone(),
                tool: tool.and_then(|tool| tools.get(tool)).cloned().unwrap_or_default(),
                sums: *sums,
            })
            .collect();
        CollectedSimulation {
            totals: self.totals,
            operations,
            faults: self.faults,
            assumptions,
            findings,
            motions: self.motions,
        }
    }
}
