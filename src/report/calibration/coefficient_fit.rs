//! This module fits coefficients to measured means by weighted least squares: means are linear in the coefficients.

use nalgebra::{DMatrix, DVector};

/// Singular values below this part of the largest one are none: what is told apart by less is noise.
const RANK_TOLERANCE: f64 = 2e-3;

/// One measured number: how it depends on the unknowns, its value less what is known, and its standard deviation up to a
/// common factor.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FitEquation {
    /// The number of the measured row.
    pub row: usize,
    /// What a unit of each unknown adds to the number.
    pub parts: Vec<f64>,
    /// The number.
    pub value: f64,
    /// What counts as equally wrong.
    pub scale: f64,
}

/// Coefficients that were fitted.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CoefficientFit {
    /// The values of the unknowns.
    pub values: Vec<f64>,
    /// Their standard errors; infinite where there are no more equations than unknowns.
    pub errors: Vec<f64>,
    /// The number of unknowns that the equations tell apart.
    pub rank: usize,
    /// The largest singular value by the least one that counts, of columns of equal length.
    pub condition: f64,
}

/// Fits the unknowns. Where the equations do not tell all apart, the shortest solution is taken.
pub(super) fn fit_coefficients(equations: &[FitEquation], unknowns: usize) -> CoefficientFit {
    let nothing = CoefficientFit {
        values: vec![0.0; unknowns],
        errors: vec![f64::INFINITY; unknowns],
        rank: 0,
        condition: f64::INFINITY,
    };
    if equations.is_empty() || unknowns == 0 {
        return nothing;
    }
    let weighted = |equation: &FitEquation, column: usize| {
        equation.parts.get(column).copied().unwrap_or(0.0) / equation.scale
    };
    let mut matrix = DMatrix::from_fn(equations.len(), unknowns, |row, column| {
        equations.get(row).map_or(0.0, |equation| weighted(equation, column))
    });
    let values = DVector::from_iterator(
        equations.len(),
        equations.iter().map(|equation| equation.value / equation.scale),
    );
    // Columns of equal length: coefficients of cutting and of edges have other units.
    let lengths: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    for (mut column, length) in matrix.column_iter_mut().zip(&lengths) {
        if *length > 0.0 {
            column /= *length;
        }
    }
    let svd = matrix.clone().svd(true, true);
    let largest = svd.singular_values.iter().copied().fold(0.0, f64::max);
    let counts = |value: &f64| *value > largest * RANK_TOLERANCE;
    let (Some(u), Some(v_t)) = (&svd.u, &svd.v_t) else { return nothing };
    if largest <= 0.0 {
        return nothing;
    }
    let rank = svd.singular_values.iter().filter(|value| counts(value)).count();
    let least = svd.singular_values.iter().copied().filter(counts).fold(f64::INFINITY, f64::min);
    let mut solved = DVector::zeros(unknowns);
    let mut spread = vec![0.0; unknowns];
    for (index, value) in svd.singular_values.iter().enumerate().filter(|(_, value)| counts(value)) {
        let along = u.column(index).dot(&values) / value;
        let direction = v_t.row(index).transpose();
        solved += &direction * along;
        for (sum, part) in spread.iter_mut().zip(direction.iter()) {
            *sum += (part / value) * (part / value);
        }
    }
    let rest = (&matrix * &solved - &values).norm_squared();
    let freedom = equations.len().saturating_sub(rank);
    let variance = if freedom > 0 { rest / freedom as f64 } else { f64::INFINITY };
    let unscaled = |value: f64, length: &f64| if *length > 0.0 { value / length } else { 0.0 };
    CoefficientFit {
        values: solved.iter().zip(&lengths).map(|(value, length)| unscaled(*value, length)).collect(),
        errors: spread
            .iter()
            .zip(&lengths)
            .map(|(sum, length)| unscaled((variance * sum).sqrt(), length))
            .collect(),
        rank,
        condition: largest / least,
    }
}

/// Returns the number of unknowns that equations tell apart, of some columns only.
pub(super) fn rank_of_columns(equations: &[FitEquation], columns: [usize; 2]) -> usize {
    let picked: Vec<FitEquation> = equations
        .iter()
        .map(|equation| FitEquation {
            parts: columns.iter().filter_map(|column| equation.parts.get(*column).copied()).collect(),
            ..equation.clone()
        })
        .collect();
    fit_coefficients(&picked, columns.len()).rank
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(x: f64, y: f64, row: usize) -> FitEquation {
        FitEquation { row, parts: vec![x, 1.0], value: y, scale: 1.0 }
    }

    #[test]
    fn a_line_through_points_has_the_errors_of_the_book() {
        // y = 2 x + 1 with errors +1, -2, +1 at x = 0, 1, 2: they change neither slope nor the mean.
        let points = [line(0.0, 2.0, 0), line(1.0, 1.0, 1), line(2.0, 6.0, 2)];
        let found = fit_coefficients(&points, 2);
        assert!((found.values[0] - 2.0).abs() < 1e-12 && (found.values[1] - 1.0).abs() < 1e-12, "{found:?}");
        assert_eq!(found.rank, 2);
        // s² = 6 / 1; the slope's variance is s² / sum (x - mean)² = 6 / 2.
        assert!((found.errors[0] - 3.0_f64.sqrt()).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn what_is_proportional_is_not_told_apart() {
        let twice = |value: f64| FitEquation { row: 0, parts: vec![value, 2.0 * value], value, scale: 1.0 };
        let found = fit_coefficients(&[twice(1.0), twice(2.0), twice(3.0)], 2);
        assert_eq!(found.rank, 1);
        assert_eq!(rank_of_columns(&[twice(1.0), twice(2.0)], [0, 1]), 1);
    }
}
