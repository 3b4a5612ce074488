//! This module finds the coefficients of a material from measured means of one's own cuts.
//!
//! [`read_measured_forces`] reads the table, [`Calibration::fit_rows`] simulates the program, picks the motions of each row
//! and fits the coefficients, which are linear in the means. Rows that do not fit the others are left out by name. Where
//! every row has the same chips, a cutting coefficient and its edge term cannot be told apart; then the edge term is kept
//! from the setup's material, or one number is fitted for both ([`EdgeTerms`]).

mod calibration_row;
mod calibration_text;
mod coefficient_fit;
mod measured_rows;
mod row_fitter;
mod row_responses;

pub use calibration_row::CalibrationRow;
pub use measured_rows::{MeasuredRow, read_measured_forces};

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::{CuttingCoefficients, CuttingLaw};
use crate::simulation_run::{Machining, RunWatcher};
use crate::source::Source;
use coefficient_fit::{FitEquation, fit_coefficients, rank_of_columns};
use row_fitter::{RowFitter, list_equations, root_mean_square};
use std::sync::Arc;

/// The names of the coefficients, in the order of the fit.
pub(super) const NAMES: [&str; 6] = ["k_tc", "k_te", "k_rc", "k_re", "k_ac", "k_ae"];

/// A power is beyond what forces explain if it is larger by this part than that of the other rows.
const VIBRATION_PART: f64 = 0.2;
/// What is done where a cutting coefficient and its edge term cannot be told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EdgeTerms {
    /// The edge term of the setup's material stays, and the cutting coefficient is fitted.
    #[default]
    Keep,
    /// The cutting coefficient is fitted alone: one number for both, which holds for chips like those measured.
    OneNumber,
}

/// Where a coefficient comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CoefficientOrigin {
    /// It was fitted; its standard error.
    Fitted(f64),
    /// It is that of the setup's material, since the rows do not tell it.
    Kept,
    /// It is 0, and its cutting coefficient stands for both.
    InOtherNumber,
}

/// The coefficients of a material, and how well they fit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Calibration {
    /// The name of the material.
    pub name: Option<String>,
    /// The coefficients.
    pub coefficients: CuttingCoefficients,
    /// Where each comes from, in the order k_tc, k_te, k_rc, k_re, k_ac, k_ae.
    pub origins: [CoefficientOrigin; 6],
    /// How many of the six coefficients the rows tell apart.
    pub rank: usize,
    /// The condition of the fit: how much larger an error of the worst combination is than one of the best.
    pub condition: f64,
    /// The rows.
    pub rows: Vec<CalibrationRow>,
    /// The root of the mean square of the residuals, as a part of the measurements.
    pub residual_part: f64,
    /// The same of rows that were left out of the fit one by one.
    pub left_out_part: f64,
    /// The tool of the cuts, in words.
    pub tool: String,
    /// The thickest chips of the cuts, mm: least and largest.
    pub chip_range_mm: [f64; 2],
    /// The cutting speeds, m/min.
    pub speed_range_m_min: [f64; 2],
    /// The axial depths, mm.
    pub depth_range_mm: [f64; 2],
}

/// What the fit decides for each coefficient: its column among the unknowns, or what it is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum CoefficientPlan {
    Fit,
    Keep,
    InOther,
}

impl Calibration {
    /// Fits the rows of a table to a program. Rows that do not fit, and coefficients that cannot be told apart, are added
    /// to `findings`.
    ///
    /// # Errors
    /// Returns [`codes::MEASURED_FORCES`] for rows that pick no cut or tell too little, and the errors of the simulation.
    pub fn fit_rows(
        machining: &Machining<'_>,
        (source, rows): (&Arc<Source>, Vec<MeasuredRow>),
        edge: EdgeTerms,
        watch: &dyn RunWatcher,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Failure> {
        let material = machining.setup().require_material()?;
        let CuttingLaw::Linear(guess) = material.law else {
            let message = "a calibration fits the linear law, and the setup's material has that of Kienzle";
            let help = "Give the material of the setup by `k_tc`; a guess will do.";
            return Err(Diagnostic::new(codes::MEASURED_FORCES, message).with_help(help).into());
        };
        let responses = row_responses::find_responses(machining, source, &rows, watch)?;
        if responses.tool_count > 1 {
            let message = format!("one fit is made of the cuts of several tools: {}", responses.tool);
            let help =
                "Calibrate each tool on its own: rake, rounding and wear of an edge are in its coefficients.";
            findings.push(Diagnostic::new(codes::SEVERAL_TOOLS, message).with_help(help));
        }
        let guess_values = to_list(&guess);
        let raw = list_equations(&rows, &responses.of_rows);
        let rank = fit_coefficients(&raw, NAMES.len());
        let plan = plan_coefficients(&raw, edge);
        findings.extend(tell_plan(&plan, rank.rank, edge));
        let fitter = RowFitter { rows: &rows, responses: &responses.of_rows, plan, guess: guess_values };
        let (fit, left_out) = fitter.fit_without_outliers(source)?;
        let values = fitter.complete(&fit.values);
        refuse_negative(&values)?;
        let mut calibration = Self {
            name: material.name.clone(),
            coefficients: from_list(&values),
            origins: fitter.tell_origins(&fit.errors),
            rank: rank.rank,
            condition: fit.condition,
            rows: fitter.tell_rows(&values, &left_out),
            residual_part: 0.0,
            left_out_part: 0.0,
            tool: responses.tool,
            chip_range_mm: responses.chip_range_mm,
            speed_range_m_min: responses.speed_range_m_min,
            depth_range_mm: responses.depth_range_mm,
        };
        calibration.compare_powers();
        let kept = || calibration.rows.iter().filter(|row| !row.is_outlier);
        let residual = root_mean_square(kept().map(|row| row.residual_part));
        let left_out = root_mean_square(kept().filter_map(|row| row.left_out_part));
        (calibration.residual_part, calibration.left_out_part) = (residual, left_out);
        findings.extend(calibration.rows.iter().filter_map(|row| row.tell_fault(source)));
        Ok(calibration)
    }

    /// Compares measured powers with what the fit explains. The middle of all ratios is taken as that of sound cuts: a
    /// measured power may have a loss in it, and a current no scale at all.
    fn compare_powers(&mut self) {
        for is_current in [false, true] {
            let measured = |row: &CalibrationRow| {
                let current = row.measured.current_a.map(|[current, idle]| current - idle);
                if is_current { current } else { row.measured.power_kw }
            };
            let ratio =
                |row: &CalibrationRow| Some(measured(row)? / row.fitted_kw).filter(|at| at.is_finite());
            let mut ratios: Vec<f64> = self.rows.iter().filter_map(ratio).collect();
            ratios.sort_by(f64::total_cmp);
            let Some(middle) = ratios.get(ratios.len() / 2).copied().filter(|middle| *middle > 0.0) else {
                continue;
            };
            for row in &mut self.rows {
                if row.power_ratio.is_none() {
                    row.power_ratio = ratio(row).map(|ratio| ratio / middle);
                }
            }
        }
        for row in &mut self.rows {
            let stands_out = row.power_ratio.is_some_and(|ratio| ratio > 1.0 + VIBRATION_PART);
            row.is_likely_vibration = stands_out && !row.is_outlier && row.has_forces();
        }
    }
}

/// Refuses coefficients that no cut has: only axial ones may be below 0.
fn refuse_negative(values: &[f64; 6]) -> Result<(), Failure> {
    let named = NAMES.into_iter().zip(values).take(4);
    let wrong = named.into_iter().find(|(name, value)| **value < 0.0 || *name == "k_tc" && **value <= 0.0);
    let Some((name, value)) = wrong else { return Ok(()) };
    let message = format!("the fit gives {name} = {value:.3}, which no cut has");
    let help = "Look at the signs: forces are on the workpiece, in the axes of the program. Chips that differ little tell edge terms \
                badly; `--edge one-number` fits one number a direction.";
    Err(Diagnostic::new(codes::MEASURED_FORCES, message).with_help(help).into())
}

/// Decides which coefficients are fitted.
fn plan_coefficients(equations: &[FitEquation], edge: EdgeTerms) -> [CoefficientPlan; 6] {
    let mut plan = [CoefficientPlan::Keep; 6];
    for (direction, pair) in plan.chunks_exact_mut(2).enumerate() {
        let rank = rank_of_columns(equations, [2 * direction, 2 * direction + 1]);
        let [cutting, edge_term] = pair else { continue };
        (*cutting, *edge_term) = match (rank, edge) {
            (0, _) => (CoefficientPlan::Keep, CoefficientPlan::Keep),
            (1, EdgeTerms::Keep) => (CoefficientPlan::Fit, CoefficientPlan::Keep),
            (1, EdgeTerms::OneNumber) => (CoefficientPlan::Fit, CoefficientPlan::InOther),
            _ => (CoefficientPlan::Fit, CoefficientPlan::Fit),
        };
    }
    plan
}

/// Says which coefficients the rows do not tell.
fn tell_plan(plan: &[CoefficientPlan; 6], rank: usize, edge: EdgeTerms) -> Option<Diagnostic> {
    let named = |wanted: CoefficientPlan| {
        let names = plan.iter().zip(NAMES).filter(|(plan, _)| **plan == wanted).map(|(_, name)| name);
        names.collect::<Vec<_>>().join(", ")
    };
    let (kept, in_other) = (named(CoefficientPlan::Keep), named(CoefficientPlan::InOther));
    let told = match edge {
        _ if kept.is_empty() && in_other.is_empty() => return None,
        EdgeTerms::OneNumber if !in_other.is_empty() => {
            let kept =
                if kept.is_empty() { String::new() } else { format!("; {kept} are those of the setup") };
            format!("{in_other} are 0, and their cutting coefficients stand for both{kept}")
        }
        _ => format!("{kept} are those of the setup's material"),
    };
    let message = format!("the rows tell {rank} of 6 coefficients apart: {told}");
    Some(Diagnostic::new(codes::NOT_SEPARABLE, message))
}

fn to_list(coefficients: &CuttingCoefficients) -> [f64; 6] {
    let CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae } = *coefficients;
    [k_tc, k_te, k_rc, k_re, k_ac, k_ae]
}

fn from_list(&[k_tc, k_te, k_rc, k_re, k_ac, k_ae]: &[f64; 6]) -> CuttingCoefficients {
    CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae }
}
