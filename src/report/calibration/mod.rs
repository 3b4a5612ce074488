//! This module finds the coefficients of a material from measured means of one's own cuts.
//!
//! [`read_measured_forces`] reads the table, [`Calibration::fit_rows`] simulates the program, picks the motions of each row
//! and fits the coefficients, which are linear in the means. Rows that do not fit the others are left out by name. Where
//! every row has the same chips, a cutting coefficient and its edge term cannot be told apart; then the edge term is kept
//! from the setup's material, or one number is fitted for both ([`EdgeTerms`]).

mod calibration_text;
mod coefficient_fit;
mod measured_rows;
mod row_responses;

pub use measured_rows::{MeasuredRow, read_measured_forces};

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::{CuttingCoefficients, CuttingLaw};
use crate::simulation_run::{Machining, RunWatcher};
use crate::source::Source;
use coefficient_fit::{CoefficientFit, FitEquation, fit_coefficients, rank_of_columns};
use row_responses::RowResponse;
use std::sync::Arc;

/// The names of the coefficients, in the order of the fit.
pub(super) const NAMES: [&str; 6] = ["k_tc", "k_te", "k_rc", "k_re", "k_ac", "k_ae"];

/// A row is an outlier if it is off by so many times the others' root of the mean square, when it is left out, and by at
/// least this part.
const OUTLIER_TIMES: f64 = 4.0;
const OUTLIER_PART: f64 = 0.1;
/// A power is beyond what forces explain if it is larger by this part than that of the other rows.
const VIBRATION_PART: f64 = 0.2;
/// The most rows that are left out, as a part of all.
const MOST_LEFT_OUT: usize = 4;
/// The fewest rows among which one may be left out.
const FEWEST_ROWS: usize = 4;

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

/// A row and how it fits.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct CalibrationRow {
    /// What was measured.
    pub measured: MeasuredRow,
    /// The means by the fitted coefficients, N.
    pub fitted_n: [f64; 3],
    /// The power by the fitted coefficients, kW.
    pub fitted_kw: f64,
    /// How far the measurement is off the fit, as a part of it.
    pub residual_part: f64,
    /// The same for a fit without the row; `None` if that tells fewer coefficients apart.
    pub left_out_part: Option<f64>,
    /// The measured power, or the current above idle in its place, by what the fit explains, where the other rows are at 1.
    pub power_ratio: Option<f64>,
    /// Whether it does not fit the others, and was left out.
    pub is_outlier: bool,
    /// Whether its power stands out while its forces do not.
    pub is_likely_vibration: bool,
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

impl CalibrationRow {
    fn has_forces(&self) -> bool {
        self.measured.force_n.iter().any(Option::is_some)
    }

    fn tell_fault(&self, source: &Arc<Source>) -> Option<Diagnostic> {
        let percent = |part: f64| format!("{:.0} %", part * 100.0);
        let name = self.measured.name();
        if self.is_outlier {
            let off = percent(self.left_out_part.unwrap_or(self.residual_part));
            let message = format!("{name} does not fit the other rows: it is off by {off}, and was left out");
            let found = Diagnostic::new(codes::OUTLIER, message);
            return Some(found.with_label(source, self.measured.span, "left out of the fit"));
        }
        if self.is_likely_vibration {
            let more = percent(self.power_ratio.unwrap_or(1.0) - 1.0);
            let message =
                format!("{name} takes {more} more power than its mean force explains: likely a vibration");
            let found = Diagnostic::new(codes::LIKELY_VIBRATION, message);
            return Some(found.with_label(
                source,
                self.measured.span,
                "its forces are in the fit, its power is not",
            ));
        }
        None
    }
}

/// Fits rows by a plan.
struct RowFitter<'a> {
    rows: &'a [MeasuredRow],
    responses: &'a [RowResponse],
    plan: [CoefficientPlan; 6],
    guess: [f64; 6],
}

/// How far a row is off a fit without it; `None` if that tells fewer coefficients apart.
type LeftOutErrors = Vec<(Option<f64>, bool)>;

impl RowFitter<'_> {
    fn unknowns(&self) -> Vec<usize> {
        let fitted = self.plan.iter().enumerate().filter(|(_, plan)| **plan == CoefficientPlan::Fit);
        fitted.map(|(index, _)| index).collect()
    }

    /// Returns the fit of some rows.
    fn fit(&self, is_in: &dyn Fn(usize) -> bool) -> CoefficientFit {
        let unknowns = self.unknowns();
        let equations: Vec<FitEquation> = list_equations(self.rows, self.responses)
            .into_iter()
            .filter(|equation| is_in(equation.row))
            .map(|equation| {
                let known = equation.parts.iter().zip(self.plan.iter().zip(&self.guess));
                let kept = known.filter(|(_, (plan, _))| **plan == CoefficientPlan::Keep);
                let value = equation.value - kept.map(|(part, (_, guess))| part * guess).sum::<f64>();
                let parts = unknowns.iter().filter_map(|index| equation.parts.get(*index).copied()).collect();
                FitEquation { parts, value, ..equation }
            })
            .collect();
        fit_coefficients(&equations, unknowns.len())
    }

    /// Fits all rows but those that do not fit the others.
    fn fit_without_outliers(&self, source: &Arc<Source>) -> Result<(CoefficientFit, LeftOutErrors), Failure> {
        let wanted = self.unknowns().len();
        let mut is_out = vec![false; self.rows.len()];
        let all = self.fit(&|_| true);
        if wanted == 0 || all.rank < wanted {
            let message = format!("the rows of {} do not tell the coefficients apart", source.name());
            let help = "Measure cuts of several feeds per tooth, and the forces in all directions that are asked for.";
            return Err(Diagnostic::new(codes::MEASURED_FORCES, message).with_help(help).into());
        }
        let mut outliers: Vec<(usize, f64)> = Vec::new();
        while self.rows.len() >= FEWEST_ROWS && outliers.len() < self.rows.len() / MOST_LEFT_OUT {
            let worst = (0..self.rows.len())
                .filter(|row| !is_out.get(*row).copied().unwrap_or(true))
                .filter_map(|row| {
                    let without =
                        self.fit(&|other| other != row && !is_out.get(other).copied().unwrap_or(true));
                    if without.rank < wanted {
                        return None;
                    }
                    let values = self.complete(&without.values);
                    let others = (0..self.rows.len())
                        .filter(|other| *other != row && !is_out.get(*other).copied().unwrap_or(true));
                    let usual = root_mean_square(others.map(|other| self.residual_of(other, &values)));
                    Some((row, self.residual_of(row, &values), usual))
                })
                .max_by(|a, b| (a.1 / a.2.max(1e-4)).total_cmp(&(b.1 / b.2.max(1e-4))));
            match worst {
                Some((row, off, usual)) if off > OUTLIER_PART.max(OUTLIER_TIMES * usual) => {
                    if let Some(mark) = is_out.get_mut(row) {
                        *mark = true;
                    }
                    outliers.push((row, off));
                }
                _ => break,
            }
        }
        let is_in = |row: usize| !is_out.get(row).copied().unwrap_or(true);
        let errors = (0..self.rows.len()).map(|row| {
            if let Some((_, off)) = outliers.iter().find(|(outlier, _)| *outlier == row) {
                return (Some(*off), true);
            }
            let without = self.fit(&|other| other != row && is_in(other));
            let off =
                (without.rank == wanted).then(|| self.residual_of(row, &self.complete(&without.values)));
            (off, false)
        });
        Ok((self.fit(&is_in), errors.collect()))
    }

    /// Returns all six coefficients from the unknowns.
    fn complete(&self, values: &[f64]) -> [f64; 6] {
        let mut fitted = values.iter().copied();
        let mut all = self.guess;
        for (value, plan) in all.iter_mut().zip(&self.plan) {
            match plan {
                CoefficientPlan::Fit => *value = fitted.next().unwrap_or(0.0),
                CoefficientPlan::Keep => {}
                CoefficientPlan::InOther => *value = 0.0,
            }
        }
        all
    }

    fn tell_origins(&self, errors: &[f64]) -> [CoefficientOrigin; 6] {
        let mut errors = errors.iter().copied();
        self.plan.map(|plan| match plan {
            CoefficientPlan::Fit => CoefficientOrigin::Fitted(errors.next().unwrap_or(f64::INFINITY)),
            CoefficientPlan::Keep => CoefficientOrigin::Kept,
            CoefficientPlan::InOther => CoefficientOrigin::InOtherNumber,
        })
    }

    /// Returns how far what was measured in a row is off the coefficients, as a part of it.
    fn residual_of(&self, row: usize, values: &[f64; 6]) -> f64 {
        let (Some(measured), Some(response)) = (self.rows.get(row), self.responses.get(row)) else {
            return 0.0;
        };
        let fitted = response.forces_n(values);
        let known = measured.force_n.iter().zip(fitted);
        let pairs: Vec<(f64, f64)> = known.filter_map(|(force, fitted)| Some(((*force)?, fitted))).collect();
        if pairs.is_empty() {
            let power = measured.power_kw.unwrap_or(0.0);
            return (power - response.power_kw(values)).abs() / power.abs().max(f64::MIN_POSITIVE);
        }
        let off: f64 = pairs.iter().map(|(force, fitted)| (force - fitted).powi(2)).sum();
        let all: f64 = pairs.iter().map(|(force, _)| force * force).sum();
        (off / all.max(f64::MIN_POSITIVE)).sqrt()
    }

    fn tell_rows(&self, values: &[f64; 6], left_out: &LeftOutErrors) -> Vec<CalibrationRow> {
        let rows = self.rows.iter().zip(self.responses).zip(left_out).enumerate();
        let told = rows.map(|(index, ((measured, response), (left_out_part, is_outlier)))| CalibrationRow {
            measured: measured.clone(),
            fitted_n: response.forces_n(values),
            fitted_kw: response.power_kw(values),
            residual_part: self.residual_of(index, values),
            left_out_part: *left_out_part,
            power_ratio: None,
            is_outlier: *is_outlier,
            is_likely_vibration: false,
        });
        told.collect()
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

/// Lists the equations of all rows. A power counts where no force was measured; elsewhere it is compared afterwards.
fn list_equations(rows: &[MeasuredRow], responses: &[RowResponse]) -> Vec<FitEquation> {
    let mut equations = Vec::new();
    for (row, (measured, response)) in rows.iter().zip(responses).enumerate() {
        let weight = measured.weight.sqrt();
        let resultant = measured.force_n.iter().flatten().map(|force| force * force).sum::<f64>().sqrt();
        let mut add = |parts: Vec<f64>, value: f64, size: f64| {
            if size > 0.0 {
                equations.push(FitEquation { row, parts, value, scale: size / weight });
            }
        };
        for (axis, force) in measured.force_n.iter().enumerate() {
            let Some(force) = force else { continue };
            let parts = response.units.iter().map(|unit| unit.force_n.get(axis).copied().unwrap_or(0.0));
            add(parts.collect(), *force, resultant);
        }
        if let Some(power) = measured.power_kw.filter(|_| resultant == 0.0) {
            add(response.units.iter().map(|unit| unit.power_kw).collect(), power, power.abs());
        }
    }
    equations
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

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), value| (sum + value * value, count + 1));
    if count > 0 { (sum / count as f64).sqrt() } else { 0.0 }
}

fn to_list(coefficients: &CuttingCoefficients) -> [f64; 6] {
    let CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae } = *coefficients;
    [k_tc, k_te, k_rc, k_re, k_ac, k_ae]
}

fn from_list(&[k_tc, k_te, k_rc, k_re, k_ac, k_ae]: &[f64; 6]) -> CuttingCoefficients {
    CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae }
}
