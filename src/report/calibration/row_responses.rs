//! This module finds what a unit of each coefficient adds to the means of measured rows.

use super::{MeasuredRow, NAMES, from_list};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::CuttingLaw;
use crate::program::motion::Motion;
use crate::report::simulation::SimulationReport;
use crate::simulation_run::{ForceRequest, Machining, RunWatcher, SimulationRunOptions};
use crate::source::Source;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::sync::Arc;

/// A stretch is the mean of so many places.
const PLACES_OF_A_STRETCH: f64 = 8.0;

/// Means of a row.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct RowMeans {
    pub force_n: [f64; 3],
    pub power_kw: f64,
}

/// What a unit of each coefficient adds to the means of a row.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct RowResponse {
    pub units: [RowMeans; 6],
}

impl RowResponse {
    /// Returns the mean forces by coefficients.
    pub(super) fn forces_n(&self, values: &[f64; 6]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (unit, value) in self.units.iter().zip(values) {
            sum.iter_mut().zip(unit.force_n).for_each(|(sum, force)| *sum += force * value);
        }
        sum
    }

    /// Returns the mean power by coefficients.
    pub(super) fn power_kw(&self, values: &[f64; 6]) -> f64 {
        self.units.iter().zip(values).map(|(unit, value)| unit.power_kw * value).sum()
    }
}

/// The responses of all rows, and the cuts that they are about.
pub(super) struct RowResponses {
    pub of_rows: Vec<RowResponse>,
    pub tool: String,
    /// The number of different tools of the cuts.
    pub tool_count: usize,
    pub chip_range_mm: [f64; 2],
    pub speed_range_m_min: [f64; 2],
    pub depth_range_mm: [f64; 2],
}

/// The motions of a row, each with its time in s.
type PickedMotions = Vec<(usize, f64)>;

/// Finds the responses of rows.
///
/// # Errors
/// Returns [`codes::MEASURED_FORCES`] with the row that picks no cut, and the errors of the simulation.
pub(super) fn find_responses(
    machining: &Machining<'_>,
    source: &Arc<Source>,
    rows: &[MeasuredRow],
    watch: &dyn RunWatcher,
) -> Result<RowResponses, Failure> {
    let report = SimulationReport::simulate_program(machining, &SimulationRunOptions::default(), watch)?;
    let picked: Result<Vec<PickedMotions>, Failure> =
        rows.iter().map(|row| pick_motions(&report, machining, row, source)).collect();
    let picked = picked?;
    let all: BTreeSet<usize> = picked.iter().flatten().map(|(number, _)| *number).collect();
    let mut of_rows = vec![RowResponse::default(); rows.len()];
    for index in 0..NAMES.len() {
        let mut values = [0.0; 6];
        if let Some(value) = values.get_mut(index) {
            *value = 1.0;
        }
        let law = CuttingLaw::Linear(from_list(&values));
        let speed = |number: usize, motion: &Motion| {
            machining.cutting_speed_of(motion).filter(|_| all.contains(&number))
        };
        let request = ForceRequest { law, speed_of: &speed };
        let refused = || {
            Failure::from(Diagnostic::new(codes::MEASURED_FORCES, "the forces of this stock are not known"))
        };
        let found = machining.find_motion_forces(&request, watch)?.ok_or_else(refused)?;
        for ((row, picked), response) in rows.iter().zip(&picked).zip(&mut of_rows) {
            let mut parts = Vec::new();
            match row.stretch_mm {
                Some(stretch) => {
                    let Some((number, _)) = picked.first() else { continue };
                    parts = find_stretch(machining, (*number, stretch), law, watch)?;
                }
                None => {
                    for (number, seconds) in picked {
                        if let Some(forces) = found.get(number) {
                            parts.push((
                                RowMeans { force_n: forces.mean_n, power_kw: forces.power_mean_kw },
                                *seconds,
                            ));
                        }
                    }
                }
            }
            if let Some(unit) = response.units.get_mut(index) {
                *unit = average(&parts);
            }
        }
    }
    Ok(tell_cuts(&report, machining, &all, of_rows))
}

/// Returns the motions of a row that cut.
fn pick_motions(
    report: &SimulationReport,
    machining: &Machining<'_>,
    row: &MeasuredRow,
    source: &Arc<Source>,
) -> Result<PickedMotions, Failure> {
    let fault = |message: String, label: &str| {
        let found = Diagnostic::new(codes::MEASURED_FORCES, message);
        Failure::from(found.with_label(source, row.span, label))
    };
    let mut picked = Vec::new();
    let mut without_forces = false;
    for (number, index) in report.number_rows(machining) {
        let Some(motion) = report.motions.rows.get(index) else { continue };
        let is_in = |[from, to]: [usize; 2]| motion.line.is_some_and(|line| (from..=to).contains(&line));
        let name = report.motions.operations.get(motion.operation);
        let is_meant = row.lines.is_none_or(is_in)
            && row.operation.as_ref().is_none_or(|operation| name == Some(operation));
        let cuts = motion.removal_rate_mm3_min.is_some_and(|rate| rate > 0.0);
        if !is_meant || motion.rapid || !cuts {
            continue;
        }
        match (motion.forces, motion.seconds) {
            (Some(_), Some(seconds)) => picked.push((number, seconds)),
            _ => without_forces = true,
        }
    }
    if picked.is_empty() && without_forces {
        let message = format!("the forces of {} cannot be found", row.name());
        return Err(fault(message, "its feed, its speed, or the teeth of its tool are not known"));
    }
    if picked.is_empty() {
        return Err(fault(format!("no motion at feed that cuts is at {}", row.name()), "selects nothing"));
    }
    if row.stretch_mm.is_some() && picked.len() > 1 {
        let message = format!("a stretch is part of one motion, and {} has {}", row.name(), picked.len());
        return Err(fault(message, "give one line"));
    }
    Ok(picked)
}

/// Returns the means at places of a stretch, each with its weight.
fn find_stretch(
    machining: &Machining<'_>,
    (motion, [from, to]): (usize, [f64; 2]),
    law: CuttingLaw,
    watch: &dyn RunWatcher,
) -> Result<Vec<(RowMeans, f64)>, Failure> {
    let speed = |number: usize, of: &Motion| machining.cutting_speed_of(of).filter(|_| number == motion);
    let request = ForceRequest { law, speed_of: &speed };
    let spacing = (to - from) / PLACES_OF_A_STRETCH;
    let found = machining.find_forces_along(&request, spacing.max(1e-3), watch)?.unwrap_or_default();
    let places = found.into_values().flatten().filter(|place| {
        let middle = (place.along_mm[0] + place.along_mm[1]) / 2.0;
        (from..=to).contains(&middle)
    });
    let means = |forces: &crate::simulation_run::MotionForces| RowMeans {
        force_n: forces.mean_n,
        power_kw: forces.power_mean_kw,
    };
    Ok(places.map(|place| (means(&place.forces), place.along_mm[1] - place.along_mm[0])).collect())
}

/// Returns the mean of parts by their weights.
fn average(parts: &[(RowMeans, f64)]) -> RowMeans {
    let all: f64 = parts.iter().map(|(_, weight)| weight).sum();
    let mut mean = RowMeans::default();
    if all <= 0.0 {
        return mean;
    }
    for (part, weight) in parts {
        mean.force_n.iter_mut().zip(part.force_n).for_each(|(sum, force)| *sum += force * weight / all);
        mean.power_kw += part.power_kw * weight / all;
    }
    mean
}

/// Adds the tool and the ranges of the cuts.
fn tell_cuts(
    report: &SimulationReport,
    machining: &Machining<'_>,
    all: &BTreeSet<usize>,
    of_rows: Vec<RowResponse>,
) -> RowResponses {
    let numbers: BTreeMap<usize, usize> = report.number_rows(machining);
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    let (mut chips, mut speeds, mut depths) = (none, none, none);
    let mut tools: BTreeSet<String> = BTreeSet::new();
    let widen = |range: &mut [f64; 2], value: Option<f64>| {
        if let Some(value) = value {
            *range = [range[0].min(value), range[1].max(value)];
        }
    };
    for (number, motion) in
        machining.program().motions().enumerate().filter(|(number, _)| all.contains(number))
    {
        let row = numbers.get(&number).and_then(|row| report.motions.rows.get(*row));
        widen(&mut chips, row.and_then(|row| row.chip_thickness_mm));
        widen(&mut depths, row.and_then(|row| row.axial_depth_mm));
        let index = machining.tooling().cutter_index(&motion);
        let cutter = index.and_then(|index| machining.tooling().cutters().get(index));
        let rpm = machining.cutting_speed_of(&motion).map(|speed| speed.rpm);
        if let Some(cutter) = cutter {
            let diameter = 2.0 * cutter.radius_mm();
            widen(&mut speeds, rpm.map(|rpm| PI * diameter * rpm / 1000.0));
            let teeth = cutter.teeth.as_ref().map_or(0, |teeth| teeth.count());
            let corner = cutter.profile.corner_radius_mm();
            let helix = cutter.teeth.as_ref().map_or(0.0, |teeth| teeth.helix_rad.to_degrees());
            tools.insert(format!("D{diameter:.3} R{corner:.3}, {teeth} teeth, helix {helix:.1} deg"));
        }
    }
    RowResponses {
        of_rows,
        tool_count: tools.len(),
        tool: tools.into_iter().collect::<Vec<_>>().join("; "),
        chip_range_mm: chips,
        speed_range_m_min: speeds,
        depth_range_mm: depths,
    }
}
