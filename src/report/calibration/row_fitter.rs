//! This module fits coefficients to rows, leaves out rows that do not fit the others, and tells how far each is off.

use super::coefficient_fit::{CoefficientFit, FitEquation, fit_coefficients};
use super::row_responses::RowResponse;
use super::{CalibrationRow, CoefficientOrigin, CoefficientPlan, MeasuredRow};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::source::Source;
use std::sync::Arc;

/// A row is an outlier if it is off by so many times the others' root of the mean square, when it is left out, and by at
/// least this part.
const OUTLIER_TIMES: f64 = 4.0;
const OUTLIER_PART: f64 = 0.1;
/// The most rows that are left out, as a part of all.
const MOST_LEFT_OUT: usize = 4;
/// The fewest rows among which one may be left out.
const FEWEST_ROWS: usize = 4;

/// Fits rows by a plan.
pub(super) struct RowFitter<'a> {
    pub rows: &'a [MeasuredRow],
    pub responses: &'a [RowResponse],
    pub plan: [CoefficientPlan; 6],
    pub guess: [f64; 6],
}

/// How far a row is off a fit without it; `None` if that tells fewer coefficients apart.
pub(super) type LeftOutErrors = Vec<(Option<f64>, bool)>;

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
    pub(super) fn fit_without_outliers(
        &self,
        source: &Arc<Source>,
    ) -> Result<(CoefficientFit, LeftOutErrors), Failure> {
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
    pub(super) fn complete(&self, values: &[f64]) -> [f64; 6] {
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

    pub(super) fn tell_origins(&self, errors: &[f64]) -> [CoefficientOrigin; 6] {
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

    pub(super) fn tell_rows(&self, values: &[f64; 6], left_out: &LeftOutErrors) -> Vec<CalibrationRow> {
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

/// Lists the equations of all rows. A power counts where no force was measured; elsewhere it is compared afterwards.
pub(super) fn list_equations(rows: &[MeasuredRow], responses: &[RowResponse]) -> Vec<FitEquation> {
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

pub(super) fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), value| (sum + value * value, count + 1));
    if count > 0 { (sum / count as f64).sqrt() } else { 0.0 }
}
