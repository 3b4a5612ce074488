//! This module collects everything that the scripts of the page draw.

use super::array_encoding::PageArray;
use super::listing::ProgramListing;
use super::motion_arrays::{PageMotionArrays, show_values};
use super::stock_height_field::StockHeightField;
use super::{markup, motion_change};
use crate::presentation::safe_text::to_safe_line;
use crate::program::{MotionClass, Program};
use crate::report::comparison::{Comparison, ComparisonSubject};
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::report::text_format::format_count;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest number of statements in a page. Browsers fail to open larger pages.
const MOST_STATEMENTS: usize = 6_000_000;

/// The largest program in a page, in bytes, for the same reason.
const MOST_TEXT: usize = 300 << 20;

/// The arrays, and the facts without which they cannot be drawn: names, units, origin and sizes.
#[derive(Debug)]
pub(super) struct PageArrays {
    facts: Value,
    arrays: Vec<(String, PageArray)>,
    /// Sentences about what is not drawn, and about how the drawing is simplified.
    pub missing: Vec<String>,
}

impl PageArrays {
    pub(super) fn from_comparison(comparison: &Comparison<'_>) -> Self {
        let subject = &comparison.subject;
        let program = subject.program;
        let mut missing = Vec::new();
        let statements = program.statements().len();
        if statements > MOST_STATEMENTS || program.source().bytes().len() > MOST_TEXT {
            let statements = format_count(statements as u64);
            missing.push(format!("a program of {statements} statements is too large to be drawn in a page"));
            return Self { facts: json!({ "sides": [] }), arrays: Vec::new(), missing };
        }
        let listing = ProgramListing::from_program(program);
        let units = subject.display_units();
        let origin = choose_drawing_origin(subject, program);
        let runs = comparison.runs;
        let mut after =
            PageMotionArrays::from_program(subject, program, runs.after.as_ref(), &listing.after, origin);
        let mut before = subject.before.map(|before| {
            PageMotionArrays::from_program(subject, before, runs.before.as_ref(), &listing.before, origin)
        });
        if let Some(before) = &mut before {
            motion_change::pair_motions(before, &mut after, &listing);
        }
        let stock = runs.after.as_ref().and_then(|simulated| StockHeightField::from_dexels(&simulated.left));
        if let Some(stock) = &stock {
            missing.push(format!(
                "the stock that is left is drawn as {} x {} columns {} apart, each as high as the highest material in it{}; \
                 undercuts are not drawn",
                stock.columns,
                stock.rows,
                units.tell_trimmed(ColumnUnit::Length, stock.cell_mm, 3),
                if stock.coarser > 1 {
                    format!(" ({0} x {0} columns of the simulation)", stock.coarser)
                } else {
                    String::new()
                },
            ));
        }
        let facts = build_facts(comparison, before.as_ref(), &after, stock.as_ref(), origin);
        let mut arrays = vec![
            ("text".to_owned(), PageArray::U8(listing.text)),
            ("kinds".to_owned(), PageArray::U8(listing.kinds)),
            ("steps".to_owned(), PageArray::U16(listing.steps)),
        ];
        arrays.extend(before.map(|side| side.into_arrays("before", units)).into_iter().flatten());
        arrays.extend(after.into_arrays("after", units));
        arrays.extend(stock.map(|stock| {
            let heights = show_values(units, ColumnUnit::Length, stock.heights);
            ("stock".to_owned(), PageArray::F32(heights))
        }));
        Self { facts, arrays, missing }
    }

    /// Writes them as elements of the page.
    pub(super) fn write_elements(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            "<script type=\"application/json\" id=\"facts\">{}</script>",
            markup::to_script_json(&self.facts)
        )?;
        let elements: Vec<io::Result<String>> =
            self.arrays.par_iter().map(|(name, array)| array.to_element(name)).collect();
        elements.into_iter().try_for_each(|element| out.write_all(element?.as_bytes()))
    }
}

/// Returns the point from which the drawing's coordinates count, in mm. It is near the path, so that `f32` is
/// precise enough, and in whole mm, so that it is exact itself.
fn choose_drawing_origin(subject: &ComparisonSubject<'_>, program: &Program) -> [f64; 3] {
    let unit = subject.resolve_length_unit(program).unit.mm_per_unit();
    let first = ComparisonSubject::motions_after_start(program).next();
    first.map_or([0.0; 3], |motion| {
        [motion.to.point.x, motion.to.point.y, motion.to.point.z].map(|at| (at * unit).round())
    })
}

fn build_facts(
    comparison: &Comparison<'_>,
    before: Option<&PageMotionArrays>,
    after: &PageMotionArrays,
    stock: Option<&StockHeightField>,
    origin: [f64; 3],
) -> Value {
    let side = |name: &str, side: &PageMotionArrays| {
        let loads: Vec<&str> = side.loads.iter().map(|(name, ..)| *name).collect();
        let [tools, operations] = [&side.tools, &side.operations]
            .map(|names| names.iter().map(|name| to_safe_line(name)).collect::<Vec<_>>());
        json!({ "name": name, "tools": tools, "operations": operations, "loads": loads })
    };
    let steps: Vec<&str> =
        comparison.changes.iter().flat_map(|changes| &changes.steps).map(|step| step.name.as_str()).collect();
    let sides: Vec<Value> =
        before.map(|before| side("before", before)).into_iter().chain([side("after", after)]).collect();
    let units = comparison.units();
    let shown = |value: f64| units.convert(ColumnUnit::Length, value);
    json!({
        "sides": sides,
        "steps": steps,
        "classes": MotionClass::ALL.map(|class| class.to_string().replace('_', " ")),
        "units": unit_facts(units),
        "origin": origin.map(shown),
        "stock": stock.map(|stock| json!({
            "first": stock.first_mm.map(shown), "cell": shown(stock.cell_mm), "columns": stock.columns, "rows": stock.rows,
            "low": shown(stock.low_mm),
        })),
    })
}

/// Returns the names of the units for axes and values, and how many decimals values have more than in mm.
fn unit_facts(units: DisplayUnits) -> Value {
    let unit = |unit: ColumnUnit| json!({ "name": unit.marked_symbol(units.shown_in), "more": units.decimals(unit, 0) });
    json!({
        "length": unit(ColumnUnit::Length),
        "feed": unit(ColumnUnit::FeedPerMinute),
        "removal": unit(ColumnUnit::RemovalRate),
    })
}
