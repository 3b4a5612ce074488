//! This module defines the figures of a program as columns (name, unit, value and printing) and makes the
//! tables of a comparison from them.

use super::{Comparison, ComparisonFigures, ComparisonPeak, ComparisonRow};
use crate::presentation::safe_text::to_safe_line;
use crate::report::table::{
    Column, ColumnUnit, PeakPlace, PrintedTable, TableLooks, TableValue, compare_figures, list_figures,
    pick_columns, print_change,
};
use crate::report::text_format::format_count;

/// The keys of the figures in the table of the whole program, in this order.
const WHOLE: [&str; 18] = [
    "feed_time",
    "rapid_time",
    "standing_time",
    "machine_time",
    "feed_length",
    "rapid_length",
    "slowest_feed",
    "fastest_feed",
    "chip_thickness",
    "chip_thickness_bound",
    "removal_rate",
    "force",
    "torque",
    "power",
    "bending",
    "deflection",
    "bending_stress",
    "surface_error",
];

pub(super) fn figure_columns() -> Vec<Column<ComparisonFigures>> {
    let mut columns = path_columns();
    columns.extend(load_columns());
    columns
}

/// Returns the columns of the figures that need no simulation.
fn path_columns() -> Vec<Column<ComparisonFigures>> {
    use ColumnUnit as Unit;
    vec![
        Column::new("feed_time", Unit::Duration, |figures: &ComparisonFigures| TableValue::Duration {
            seconds: figures.feed_seconds,
            // A time that leaves out motions is a lower bound.
            is_lower_bound: figures.untimed > 0,
        })
        .titled("time without acceleration")
        .worded_as("time at feed, without acceleration", 1),
        Column::new("accelerated_time", Unit::Duration, |figures: &ComparisonFigures| {
            let is_lower_bound = figures.untimed > 0;
            let time = |seconds| TableValue::Duration { seconds, is_lower_bound };
            figures.accelerated_seconds.map_or(TableValue::Missing, time)
        })
        .titled("time with acceleration")
        .worded_as("time at feed, with acceleration", 1),
        Column::new("rapid_time", Unit::Duration, |figures: &ComparisonFigures| {
            TableValue::duration(figures.rapid_seconds)
        })
        .titled("time at rapid"),
        Column::new("standing_time", Unit::Duration, |figures: &ComparisonFigures| {
            TableValue::duration(figures.standing_seconds)
        })
        .titled("time for tool changes, spindle starts and dwells"),
        Column::new("machine_time", Unit::Duration, |figures: &ComparisonFigures| {
            TableValue::duration(figures.machine_seconds())
        })
        .titled("time on the machine"),
        Column::new("feed_length", Unit::Length, |figures: &ComparisonFigures| figures.feed_mm.into())
            .titled("length at feed")
            .decimals(1),
        Column::new("rapid_length", Unit::Length, |figures: &ComparisonFigures| figures.rapid_mm.into())
            .titled("length at rapid")
            .decimals(1),
        Column::new("feed", Unit::FeedPerMinute, |figures: &ComparisonFigures| {
            figures.feed_range_mm_min.map_or(TableValue::Missing, TableValue::Range)
        }),
        Column::new("slowest_feed", Unit::FeedPerMinute, |figures: &ComparisonFigures| {
            figures.feed_range_mm_min.map(|[low, _]| low).into()
        })
        .titled("slowest feed"),
        Column::new("fastest_feed", Unit::FeedPerMinute, |figures: &ComparisonFigures| {
            figures.feed_range_mm_min.map(|[_, high]| high).into()
        })
        .titled("fastest feed"),
    ]
}

/// Returns the columns of the figures that only a simulation gives.
fn load_columns() -> Vec<Column<ComparisonFigures>> {
    use ColumnUnit as Unit;
    vec![
        Column::new("chip_thickness", Unit::Length, |figures: &ComparisonFigures| {
            peak_value(figures.chip_thickness_mm)
        })
        .titled("thickest chip")
        .decimals(4),
        Column::new("chip_thickness_bound", Unit::Length, |figures: &ComparisonFigures| {
            peak_value(figures.chip_thickness_bound_mm)
        })
        .titled("thickest chip at most")
        .decimals(4),
        Column::new("removal_rate", Unit::RemovalRate, |figures: &ComparisonFigures| {
            peak_value(figures.removal_rate_mm3_min)
        })
        .titled("largest removal rate")
        .decimals(0),
        Column::new("force", Unit::Force, |figures: &ComparisonFigures| peak_value(figures.force_n))
            .titled("largest force")
            .decimals(0),
        Column::new("torque", Unit::Torque, |figures: &ComparisonFigures| peak_value(figures.torque_nm))
            .titled("largest torque")
            .decimals(2),
        Column::new("power", Unit::Power, |figures: &ComparisonFigures| peak_value(figures.power_kw))
            .titled("largest power")
            .decimals(3),
        Column::new("bending", Unit::Force, |figures: &ComparisonFigures| peak_value(figures.bending_n))
            .titled("largest force across the tool")
            .decimals(0),
        Column::new("deflection", Unit::Length, |figures: &ComparisonFigures| {
            peak_value(figures.deflection_mm)
        })
        .titled("largest deflection of a tool")
        .decimals(4),
        Column::new("bending_stress", Unit::Stress, |figures: &ComparisonFigures| {
            peak_value(figures.bending_stress_mpa)
        })
        .titled("largest bending stress")
        .decimals(0),
        Column::new("surface_error", Unit::Length, |figures: &ComparisonFigures| {
            peak_value(figures.surface_error_mm)
        })
        .titled("largest error of a wall by deflection")
        .decimals(4),
    ]
}

/// Returns a peak without its line, which these tables do not show.
fn peak_value(peak: Option<ComparisonPeak>) -> TableValue<'static> {
    let value = |peak: ComparisonPeak| TableValue::Peak { value: peak.value, place: PeakPlace::Line(None) };
    peak.map_or(TableValue::Missing, value)
}

/// Makes the table of the whole program: its figures before, after and their change, or those of one program
/// alone. Figures that are not known of any program are left out.
pub(in crate::report) fn build_whole_table(comparison: &Comparison<'_>) -> PrintedTable {
    let time = time_key(&comparison.whole);
    let keys = WHOLE.map(|key| if key == "feed_time" { time } else { key });
    let columns = pick_columns(&figure_columns(), &keys);
    let ComparisonRow { before, after, .. } = &comparison.whole;
    let looks = TableLooks::markup(comparison.units());
    match comparison.subject.before {
        Some(_) => compare_figures(&columns, before.as_ref(), after.as_ref(), looks),
        None => list_figures(&columns, after.as_ref(), looks),
    }
}

/// Makes the table of operations. If there is a program before, each figure takes two columns (before and
/// after), and a third one holds the change of the time in percent.
pub(in crate::report) fn build_operation_table(comparison: &Comparison<'_>) -> PrintedTable {
    let both = comparison.subject.before.is_some();
    let columns = pick_operation_figures(comparison);
    let looks = TableLooks::markup(comparison.units());
    let mut table = PrintedTable::default();
    for (head, is_left_aligned) in [("operation", true), ("tool", true), ("motions", false)] {
        table.push_column(head, is_left_aligned);
    }
    for (index, column) in columns.iter().enumerate() {
        table.push_column(column.head(looks), false);
        if both {
            table.push_column("after", false);
        }
        if both && index == 0 {
            table.push_column("change", false);
        }
    }
    for row in &comparison.operations {
        table.push_row(print_operation(&row.name, row, &columns, both, looks));
    }
    if comparison.operations.len() > 1 {
        table.push_row(print_operation("all", &comparison.whole, &columns, both, looks));
    }
    table
}

/// Returns the key of the time that stands for the whole: that on the machine if it is known, else that at feed.
pub(super) fn headline_time_key(whole: &ComparisonRow) -> &'static str {
    let figures = whole.after.or(whole.before);
    let is_known = figures.is_some_and(|figures| figures.machine_seconds().is_some());
    if is_known { "machine_time" } else { time_key(whole) }
}

/// Returns the key of the only time at feed that is shown: the one with the machine's acceleration if it is
/// known, else the one without.
fn time_key(whole: &ComparisonRow) -> &'static str {
    let is_known = whole.after.or(whole.before).is_some_and(|figures| figures.accelerated_seconds.is_some());
    if is_known { "accelerated_time" } else { "feed_time" }
}

fn print_operation(
    name: &str,
    row: &ComparisonRow,
    columns: &[Column<ComparisonFigures>],
    both: bool,
    looks: TableLooks,
) -> Vec<String> {
    let (before, after) = (row.before.as_ref(), row.after.as_ref());
    let motions = after.or(before).map_or(0, |figures| figures.motions);
    let mut cells =
        vec![to_safe_line(name), to_safe_line(&row.tools.join(", ")), format_count(motions as u64)];
    for (index, column) in columns.iter().enumerate() {
        let print = |figures: Option<&ComparisonFigures>| {
            figures.map(|figures| looks.print_cell(column, figures)).unwrap_or_default()
        };
        cells.extend(both.then(|| print(before)));
        cells.push(print(after));
        cells.extend((both && index == 0).then(|| print_change(column, before, after)));
    }
    cells
}

/// Returns the columns of the table of operations: time and feed, and the figures of a simulation if there
/// was one.
fn pick_operation_figures(comparison: &Comparison<'_>) -> Vec<Column<ComparisonFigures>> {
    let ComparisonRow { before, after, .. } = &comparison.whole;
    let is_known = |column: &Column<ComparisonFigures>| {
        [before, after].into_iter().flatten().any(|figures| !column.value(figures).is_missing())
    };
    let mut columns = pick_columns(&figure_columns(), &[time_key(&comparison.whole), "feed"]);
    let loads =
        pick_columns(&figure_columns(), &["chip_thickness", "chip_thickness_bound", "power", "deflection"]);
    columns.extend(loads.into_iter().filter(is_known));
    columns
}
