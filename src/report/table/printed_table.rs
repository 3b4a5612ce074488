//! This module holds tables with printed cells, as plain text, Markdown and HTML.

use super::column::Column;
use super::table_looks::TableLooks;
use crate::report::escaping::{escape_html, escape_markdown};
use crate::report::text_format::{format_count, format_table};
use std::io::{self, Write};

/// A table of printed cells.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct PrintedTable {
    head: Vec<PrintedHead>,
    rows: Vec<Vec<String>>,
    rows_left_out: usize,
}

/// The head of a printed column.
#[derive(Debug, Clone, PartialEq, Eq)]
struct PrintedHead {
    text: String,
    is_left_aligned: bool,
}

impl PrintedTable {
    /// Prints rows by their columns.
    pub(crate) fn from_rows<'r, R: 'r>(
        columns: &[Column<R>],
        rows: impl IntoIterator<Item = &'r R>,
        looks: TableLooks,
    ) -> Self {
        let mut table = Self::default();
        for column in columns {
            table.push_column(column.head(looks), column.is_left_aligned());
        }
        for row in rows {
            table.push_row(columns.iter().map(|column| looks.print_cell(column, row)).collect());
        }
        table
    }

    /// Adds a column to the right, before any row is added.
    pub(crate) fn push_column(&mut self, head: impl Into<String>, is_left_aligned: bool) {
        debug_assert!(self.rows.is_empty(), "the rows that are there have no cell for this column");
        self.head.push(PrintedHead { text: head.into(), is_left_aligned });
    }

    /// Adds a row with a cell for each column.
    pub(crate) fn push_row(&mut self, cells: Vec<String>) {
        debug_assert_eq!(cells.len(), self.head.len(), "a cell for each column");
        self.rows.push(cells);
    }

    /// Keeps the first rows and counts the others.
    pub(crate) fn keep_rows(mut self, most: usize) -> Self {
        self.rows_left_out += self.rows.len().saturating_sub(most);
        self.rows.truncate(most);
        self
    }

    /// Counts rows that were left out before they came here.
    pub(crate) fn leave_out(mut self, rows: usize) -> Self {
        self.rows_left_out += rows;
        self
    }

    /// Returns whether there is no row.
    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Returns the table as plain text, with the first column to the left, the others to the right, and a
    /// last line about the rows that are left out.
    pub(crate) fn to_text(&self) -> String {
        let head = self.head.iter().map(|head| head.text.clone()).collect();
        let mut all: Vec<Vec<String>> = vec![head];
        all.extend(self.rows.iter().cloned());
        let mut text = format_table(&all);
        if self.rows_left_out > 0 {
            text.push_str(&format!("  and {} more\n", format_count(self.rows_left_out as u64)));
        }
        text
    }

    /// Returns the table as Markdown (GitHub's and GitLab's tables) with an empty line after it: the first
    /// column to the left, the others to the right.
    pub(crate) fn to_markdown(&self) -> String {
        let join = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        // Heads are the program's own words, which need no escaping.
        let mut text = join(self.head.iter().map(|head| head.text.clone()).collect());
        let rule = |column: usize| if column == 0 { "---" } else { "---:" }.to_owned();
        text.push_str(&join((0..self.head.len()).map(rule).collect()));
        for row in &self.rows {
            text.push_str(&join(row.iter().map(|cell| escape_markdown(cell)).collect()));
        }
        text.push('\n');
        text
    }

    /// Writes the table as HTML, each column aligned as it asks for.
    ///
    /// # Errors
    /// Returns the errors of `out`.
    pub(crate) fn write_html(&self, out: &mut dyn Write) -> io::Result<()> {
        let class = |column: usize| {
            let is_left = self.head.get(column).is_some_and(|head| head.is_left_aligned);
            if is_left { "" } else { " class=\"n\"" }
        };
        out.write_all(b"<div class=\"wide\"><table><thead><tr>")?;
        for (column, head) in self.head.iter().enumerate() {
            write!(out, "<th{}>{}</th>", class(column), escape_html(&head.text))?;
        }
        out.write_all(b"</tr></thead><tbody>\n")?;
        for row in &self.rows {
            out.write_all(b"<tr>")?;
            for (column, cell) in row.iter().enumerate() {
                write!(out, "<td{}>{}</td>", class(column), escape_html(cell))?;
            }
            out.write_all(b"</tr>\n")?;
        }
        out.write_all(b"</tbody></table></div>\n")
    }
}
