//! This module holds the chip of a part of a motion, with the forces over one revolution in the part's middle.

use super::{ChipLayerRow, ChipReport};
use crate::diagnostic::Failure;
use crate::report::simulation::{RotationRow, refuse_stock};
use crate::simulation_run::{ForceRequest, Machining, MotionForces, RunWatcher};

/// The rotations of one revolution at a moment.
const ROTATIONS: usize = 120;

/// One of the equal parts of a motion.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct ChipMoment {
    /// Its number, from 1.
    pub number: usize,
    /// Where it begins and ends, mm from the start of the motion.
    pub along_mm: [f64; 2],
    /// Volume of its chip, mm3.
    pub volume_mm3: f64,
    /// The thickest chip of a tooth, mm; 0 in air, `None` if it is not known.
    pub chip_thickness_mm: Option<f64>,
    /// Its layers from below, as those of a motion.
    pub layers: Vec<ChipLayerRow>,
    /// The forces in its middle; `None` if they are not known.
    pub forces: Option<MotionForces>,
    /// The forces over one revolution there.
    pub rotations: Vec<RotationRow>,
}

impl ChipReport {
    /// Finds the forces at the moments of all motions that cut. Without a material in the setup there are none.
    ///
    /// # Errors
    /// Returns a finding where the stock does not permit it, and [`Failure::Interrupted`] if `watch` has stopped the run.
    pub fn find_moment_forces(
        &mut self,
        machining: &Machining<'_>,
        watch: &dyn RunWatcher,
    ) -> Result<(), Failure> {
        let Ok(material) = machining.setup().require_material() else {
            self.assumptions.push("the setup names no material: no forces at the moments".to_owned());
            return Ok(());
        };
        let cuts = |row: &&super::ChipRow| !row.rapid && row.volume_mm3 > 0.0 && !row.moments.is_empty();
        let cutting: Vec<usize> = self.rows.iter().filter(cuts).map(|row| row.motion).collect();
        let request = ForceRequest {
            law: material.law,
            speed_of: &|number, motion| {
                machining.cutting_speed_of(motion).filter(|_| cutting.binary_search(&number).is_ok())
            },
        };
        let parts = [self.options.moments, ROTATIONS];
        let mut found = machining.find_moment_periods(&request, parts, watch)?.ok_or_else(refuse_stock)?;
        for row in &mut self.rows {
            let periods = found.remove(&row.motion).unwrap_or_default();
            for (moment, period) in row.moments.iter_mut().zip(periods) {
                moment.forces = Some(period.forces);
                let rotations = period.rotations.into_iter();
                moment.rotations = rotations.map(RotationRow::from_parts).collect();
            }
        }
        Ok(())
    }
}
