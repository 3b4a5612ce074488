//! This module writes what a plot shows as JSON.

use super::{CurvePanel, PlotAbscissa, PlotCurve, PlotQuantity};
use crate::diagnostic::Diagnostic;
use crate::program::LengthUnit;
use crate::report::DisplayUnits;
use crate::report::render::json::FindingsJson;
use crate::report::rounding::round_to_micro;
use serde::Serialize;

/// What a plot shows, and where it was written.
#[derive(Debug, Clone, Copy)]
pub struct PlotSubject<'a> {
    /// The name of the program.
    pub file: &'a str,
    /// The name of the program that is drawn over it.
    pub after: Option<&'a str>,
    /// The horizontal axis.
    pub along: PlotAbscissa,
    /// The units that a reader sees.
    pub units: DisplayUnits,
    /// The quantities and their panels; none if the program could not be drawn.
    pub panels: &'a [(PlotQuantity, CurvePanel)],
    /// The file of the drawing; `None` if nothing was written.
    pub written: Option<&'a str>,
}

/// Returns what a plot shows as a JSON document, indented and with a line end. `findings` are those of the
/// run, after the policy.
pub fn plot_to_json(subject: &PlotSubject<'_>, findings: &[Diagnostic]) -> String {
    let units = subject.units;
    crate::report::to_json_text(&PlotDocument {
        version: 1,
        file: subject.file,
        after: subject.after,
        units: units.shown_in,
        along: subject.along.axis_title(units),
        written: subject.written,
        panels: subject.panels.iter().map(|panel| PlotPanelJson::from_panel(panel, units)).collect(),
        findings: FindingsJson::from_findings(findings),
    })
}

/// The JSON document of `plot`. `version` goes up when a reader of the old structure would fail. New keys may
/// be added without that.
#[derive(Serialize)]
struct PlotDocument<'a> {
    version: u32,
    file: &'a str,
    after: Option<&'a str>,
    units: LengthUnit,
    /// The horizontal axis with its unit.
    along: String,
    /// The file of the drawing; `null` if nothing was drawn.
    written: Option<&'a str>,
    panels: Vec<PlotPanelJson<'a>>,
    findings: FindingsJson<'a>,
}

#[derive(Serialize)]
struct PlotPanelJson<'a> {
    /// The name on the command line.
    quantity: &'static str,
    /// The vertical axis with its unit.
    title: String,
    is_empty: bool,
    curves: Vec<PlotCurveJson<'a>>,
}

impl<'a> PlotPanelJson<'a> {
    fn from_panel((quantity, panel): &'a (PlotQuantity, CurvePanel), units: DisplayUnits) -> Self {
        Self {
            quantity: quantity.name(),
            title: quantity.axis_title(units),
            is_empty: panel.is_empty(),
            curves: panel.curves.iter().map(PlotCurveJson::from_curve).collect(),
        }
    }
}

/// A curve by its extent.
#[derive(Serialize)]
struct PlotCurveJson<'a> {
    name: &'a str,
    /// The pieces of the curve, and those of them whose values are known.
    pieces: usize,
    known_pieces: usize,
    /// Where it ends along the horizontal axis.
    end: f64,
    /// Its least and its largest value; `null` if none is known.
    min: Option<f64>,
    max: Option<f64>,
}

impl<'a> PlotCurveJson<'a> {
    fn from_curve(curve: &'a PlotCurve) -> Self {
        let known = || curve.segments.iter().filter_map(|segment| segment.values);
        let values = || known().flatten().filter(|value| value.is_finite());
        Self {
            name: &curve.name,
            pieces: curve.segments.len(),
            known_pieces: known().count(),
            end: round_to_micro(curve.segments.last().map_or(0.0, |segment| segment.to)),
            min: values().reduce(f64::min).map(round_to_micro),
            max: values().reduce(f64::max).map(round_to_micro),
        }
    }
}
