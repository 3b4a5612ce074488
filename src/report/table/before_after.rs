//! This module prints figures before and after, with a row for each figure. Name, unit and printing of a
//! figure are those of its column.

use super::column::Column;
use super::printed_table::PrintedTable;
use super::table_looks::TableLooks;

/// Prints the figures of two programs side by side with their change in percent. A figure that is known of
/// neither is left out.
pub(crate) fn compare_figures<R>(
    columns: &[Column<R>],
    before: Option<&R>,
    after: Option<&R>,
    looks: TableLooks,
) -> PrintedTable {
    let mut table = PrintedTable::default();
    table.push_column("", true);
    for head in ["before", "after", "change"] {
        table.push_column(head, false);
    }
    for column in columns {
        let [old, new] = [before, after].map(|figures| print_known_figure(column, figures, looks));
        if old.is_some() || new.is_some() {
            let change = print_change(column, before, after);
            let cells = [Some(column.row_head(looks)), old, new, Some(change)];
            table.push_row(cells.map(Option::unwrap_or_default).into());
        }
    }
    table
}

/// Prints the figures of one program below each other.
pub(crate) fn list_figures<R>(columns: &[Column<R>], figures: Option<&R>, looks: TableLooks) -> PrintedTable {
    let mut table = PrintedTable::default();
    table.push_column("", true);
    table.push_column("value", false);
    for column in columns {
        if let Some(cell) = print_known_figure(column, figures, looks) {
            table.push_row(vec![column.row_head(looks), cell]);
        }
    }
    table
}

fn print_known_figure<R>(column: &Column<R>, figures: Option<&R>, looks: TableLooks) -> Option<String> {
    let figures = figures?;
    (!column.value(figures).is_missing()).then(|| looks.print_cell(column, figures))
}

/// Prints the change of a figure in percent: `+12.5 %`. It is empty where it would be 0.0 % or makes no
/// sense.
pub(crate) fn print_change<R>(column: &Column<R>, before: Option<&R>, after: Option<&R>) -> String {
    let number = |figures: Option<&R>| column.value(figures?).as_number();
    let Some((before, after)) = number(before).zip(number(after)) else { return String::new() };
    let change = (after / before - 1.0) * 100.0;
    if change.is_finite() && change.abs() >= 0.05 { format!("{change:+.1} %") } else { String::new() }
}
