//! This module reads tables of measured forces.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::source::{Source, Span};
use std::sync::Arc;

/// The columns that a table may have, in small letters.
const COLUMNS: [&str; 13] = [
    "line",
    "line_from",
    "line_to",
    "operation",
    "from_mm",
    "to_mm",
    "fx_mean_n",
    "fy_mean_n",
    "fz_mean_n",
    "power_kw",
    "spindle_current_a",
    "idle_current_a",
    "weight",
];

/// Columns without a unit, and what they have to be.
const WITHOUT_UNIT: [(&str, &str); 10] = [
    ("fx", "fx_mean_n"),
    ("fy", "fy_mean_n"),
    ("fz", "fz_mean_n"),
    ("fx_mean", "fx_mean_n"),
    ("fy_mean", "fy_mean_n"),
    ("fz_mean", "fz_mean_n"),
    ("power", "power_kw"),
    ("spindle_current", "spindle_current_a"),
    ("idle_current", "idle_current_a"),
    ("current", "spindle_current_a"),
];

/// Means that were measured on some motions.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeasuredRow {
    /// The lines of the motions, from the first to the last, both included; all lines if none are given.
    pub lines: Option<[usize; 2]>,
    /// The name of their operation; any if none is given.
    pub operation: Option<String>,
    /// The stretch that was measured, mm from the start of the one motion.
    pub stretch_mm: Option<[f64; 2]>,
    /// The mean forces on the workpiece in program axes, N, as far as they were measured.
    pub force_n: [Option<f64>; 3],
    /// The mean cutting power, kW, without the idle power of the spindle.
    pub power_kw: Option<f64>,
    /// The current of the spindle while it cuts and while it idles, A.
    pub current_a: Option<[f64; 2]>,
    /// How much the row counts by another one; 1 if it is not given.
    pub weight: f64,
    /// The place of the row in the table.
    pub span: Span,
}

impl MeasuredRow {
    /// Returns which motions are meant, for people.
    pub fn name(&self) -> String {
        let lines = match self.lines {
            Some([from, to]) if from == to => Some(format!("line {from}")),
            Some([from, to]) => Some(format!("lines {from} to {to}")),
            None => None,
        };
        let operation = self.operation.as_ref().map(|name| format!("operation {name}"));
        let stretch = self.stretch_mm.map(|[from, to]| format!("{from} to {to} mm"));
        [operation, lines, stretch].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// Reads a table: CSV with a head, `#` before comments. A row picks motions by `line`, or `line_from` and `line_to`, or
/// `operation`, and of one motion a stretch by `from_mm` and `to_mm`. It carries `fx_mean_N`, `fy_mean_N`, `fz_mean_N`,
/// `power_kW`, or `spindle_current_A` with `idle_current_A`, and may have a `weight`.
///
/// # Errors
/// Returns [`codes::MEASURED_FORCES`] with the row that cannot be read.
pub fn read_measured_forces(source: &Arc<Source>) -> Result<Vec<MeasuredRow>, Failure> {
    let mut rows = Vec::new();
    let mut head: Option<Vec<String>> = None;
    let mut start = 0;
    for raw in source.bytes().split(|byte| *byte == b'\n') {
        let span = Span::new(start, start + raw.len());
        start += raw.len() + 1;
        let text = String::from_utf8_lossy(raw);
        let text = text.trim().trim_start_matches('\u{feff}');
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> = text.split([',', ';']).map(str::trim).collect();
        match &head {
            None => head = Some(read_head(&cells, source, span)?),
            Some(head) => rows.push(TableRow { head, cells: &cells, source, span }.read()?),
        }
    }
    if rows.is_empty() {
        let message = format!("{} has no measured rows", source.name());
        return Err(Diagnostic::new(codes::MEASURED_FORCES, message).into());
    }
    Ok(rows)
}

fn read_head(cells: &[&str], source: &Arc<Source>, span: Span) -> Result<Vec<String>, Failure> {
    let names: Vec<String> = cells.iter().map(|cell| cell.to_lowercase()).collect();
    let fault = |message: String, label: String| -> Failure {
        Diagnostic::new(codes::MEASURED_FORCES, message).with_label(source, span, label).into()
    };
    for name in &names {
        if COLUMNS.contains(&name.as_str()) {
            continue;
        }
        let unit = WITHOUT_UNIT.iter().find(|(without, _)| without == name);
        return Err(match unit {
            Some((_, with)) => {
                fault(format!("the unit of `{name}` is missing"), format!("name the column `{with}`"))
            }
            None => fault(
                format!("`{name}` is no column of measured forces"),
                format!("the columns are {}", COLUMNS.join(", ")),
            ),
        });
    }
    let has = |name: &str| names.iter().any(|column| column == name);
    if !has("line") && !has("line_from") && !has("operation") {
        let message = "no column says which motions were measured".to_owned();
        return Err(fault(message, "add `line`, `line_from` and `line_to`, or `operation`".to_owned()));
    }
    let measured = ["fx_mean_n", "fy_mean_n", "fz_mean_n", "power_kw", "spindle_current_a"];
    if !measured.into_iter().any(has) {
        let message = "no column holds what was measured".to_owned();
        return Err(fault(message, format!("add one of {}", measured.join(", "))));
    }
    Ok(names)
}

/// A row with what is needed to say where it is wrong.
struct TableRow<'r> {
    head: &'r [String],
    cells: &'r [&'r str],
    source: &'r Arc<Source>,
    span: Span,
}

impl TableRow<'_> {
    fn fault(&self, message: String) -> Failure {
        let finding = Diagnostic::new(codes::MEASURED_FORCES, message);
        finding.with_label(self.source, self.span, "in this row").into()
    }

    fn text(&self, name: &str) -> Option<&str> {
        let index = self.head.iter().position(|column| column == name)?;
        self.cells.get(index).copied().filter(|cell| !cell.is_empty())
    }

    fn number(&self, name: &str) -> Result<Option<f64>, Failure> {
        let Some(text) = self.text(name) else { return Ok(None) };
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.map(Some).ok_or_else(|| self.fault(format!("`{text}` is no number ({name})")))
    }

    fn line(&self, name: &str) -> Result<Option<usize>, Failure> {
        let Some(text) = self.text(name) else { return Ok(None) };
        let line = text.parse::<usize>().ok().filter(|line| *line > 0);
        line.map(Some).ok_or_else(|| self.fault(format!("`{text}` is no line, which count from 1 ({name})")))
    }

    fn read(&self) -> Result<MeasuredRow, Failure> {
        if self.cells.len() > self.head.len() {
            return Err(self.fault(format!(
                "the row has {} cells, and the head names {} columns",
                self.cells.len(),
                self.head.len()
            )));
        }
        let one = self.line("line")?;
        let from = self.line("line_from")?.or(one);
        let to = self.line("line_to")?.or(from);
        let lines = match (from, to) {
            (Some(from), Some(to)) if from <= to => Some([from, to]),
            (Some(_), Some(_)) => return Err(self.fault("`line_to` is before `line_from`".to_owned())),
            (None, Some(_)) => return Err(self.fault("`line_from` is missing".to_owned())),
            _ => None,
        };
        let operation = self.text("operation").map(str::to_owned);
        if lines.is_none() && operation.is_none() {
            return Err(self.fault("the row does not say which motions were measured".to_owned()));
        }
        let stretch_mm = match (self.number("from_mm")?, self.number("to_mm")?) {
            (Some(from), Some(to)) if from < to => Some([from, to]),
            (None, None) => None,
            _ => return Err(self.fault("a stretch needs `from_mm`, and a larger `to_mm`".to_owned())),
        };
        let current_a = match (self.number("spindle_current_a")?, self.number("idle_current_a")?) {
            (Some(current), Some(idle)) if current > idle => Some([current, idle]),
            (Some(_), Some(_)) => {
                return Err(self.fault("the current is not above that of the idle spindle".to_owned()));
            }
            (Some(_), None) => {
                return Err(
                    self.fault("a current needs `idle_current_A`, that of the idle spindle".to_owned())
                );
            }
            (None, _) => None,
        };
        let row = MeasuredRow {
            lines,
            operation,
            stretch_mm,
            force_n: [self.number("fx_mean_n")?, self.number("fy_mean_n")?, self.number("fz_mean_n")?],
            power_kw: self.number("power_kw")?,
            current_a,
            weight: self.number("weight")?.unwrap_or(1.0),
            span: self.span,
        };
        if row.weight <= 0.0 {
            return Err(self.fault("a weight is above 0".to_owned()));
        }
        if row.force_n.iter().all(Option::is_none) && row.power_kw.is_none() && row.current_a.is_none() {
            return Err(self.fault("nothing was measured in this row".to_owned()));
        }
        Ok(row)
    }
}
