//! This module collects everything that the scripts of the page draw.

use super::array_encoding::PageArray;
use super::listing::ProgramListing;
use super::motion_arrays::{PageMotionArrays, show_values};
use super::page_tools::PageTool;
use super::{markup, motion_change};
use crate::presentation::safe_text::to_safe_line;
use crate::program::{MotionClass, Program};
use crate::report::comparison::{Comparison, ComparisonSubject};
use crate::report::simulation::StockStates;
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::report::text_format::format_count;
use crate::transform::{DrawnLimit, LimitedQuantity};
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
    /// The tools of the current program.
    pub tools: Vec<PageTool>,
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
            return Self { facts: json!({ "sides": [] }), arrays: Vec::new(), tools: Vec::new(), missing };
        }
        let listing = match (subject.other_file(), &comparison.differences) {
            (Some(other), Some(differences)) => {
                ProgramListing::from_files(other, program, &differences.alignment)
            }
            _ => ProgramListing::from_program(program),
        };
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
        let stocks = [("before", &runs.before), ("after", &runs.after)]
            .map(|(side, run)| (side, run.as_ref().and_then(|simulated| simulated.states.as_ref())));
        if let [_, (_, Some(stock))] = &stocks {
            missing.push(describe_drawn_stock(stock, units));
        }
        let facts = build_facts(comparison, before.as_ref(), &after, &stocks, origin);
        let tools = after.tools.clone();
        let mut arrays = vec![
            ("text".to_owned(), PageArray::U8(listing.text)),
            ("kinds".to_owned(), PageArray::U8(listing.kinds)),
            ("steps".to_owned(), PageArray::U16(listing.steps)),
        ];
        arrays.extend(before.map(|side| side.into_arrays("before", units)).into_iter().flatten());
        arrays.extend(after.into_arrays("after", units));
        for (side, stock) in stocks {
            let heights = stock.map(|stock| encode_states(stock, units));
            arrays.extend(heights.map(|heights| (format!("{side}.stock"), PageArray::F32(heights))));
        }
        let deviations = runs.after.as_ref().and_then(|simulated| simulated.deviations_mm.clone());
        arrays.extend(deviations.map(|deviations| {
            ("deviation".to_owned(), PageArray::F32(show_values(units, ColumnUnit::Length, deviations)))
        }));
        Self { facts, arrays, tools, missing }
    }

    /// Returns the facts and the arrays by name.
    pub(super) fn into_parts(self) -> (Value, Vec<(String, PageArray)>) {
        (self.facts, self.arrays)
    }

    /// Writes them as elements of the page.
    pub(super) fn write_elements(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            "<script type=\"application/json\" id=\"facts\">{}</script>",
            markup::to_script_json(&self.facts)
        )?;
        // Most of what a step leaves alone is the same before and after.
        let base_of = |name: &str| {
            let wanted = format!("before.{}", name.strip_prefix("after.")?);
            let found = self.arrays.iter().find(|(name, _)| *name == wanted);
            found.map(|(name, array)| (name.as_str(), array))
        };
        let elements: Vec<io::Result<String>> =
            self.arrays.par_iter().map(|(name, array)| array.to_element(name, base_of(name))).collect();
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
    stocks: &[(&str, Option<&StockStates>); 2],
    origin: [f64; 3],
) -> Value {
    let units = comparison.units();
    let shown = |value: f64| units.convert(ColumnUnit::Length, value);
    let side = |name: &str, side: &PageMotionArrays| {
        let loads: Vec<&str> = side.loads.iter().map(|(name, ..)| *name).collect();
        let operations: Vec<String> = side.operations.iter().map(|name| to_safe_line(name)).collect();
        let tools: Vec<String> = side.tools.iter().map(|tool| to_safe_line(&tool.name)).collect();
        let shapes: Vec<Value> = side.tools.iter().map(|tool| tool.to_json(units)).collect();
        let stock = stocks.iter().find(|(side, _)| *side == name).and_then(|(_, stock)| *stock);
        let kept = stock.map(|stock| stock.states.iter().map(|state| state.motions).collect::<Vec<_>>());
        json!({
            "name": name, "tools": tools, "shapes": shapes, "operations": operations, "loads": loads, "kept": kept,
        })
    };
    let steps: Vec<&str> =
        comparison.changes.iter().flat_map(|changes| &changes.steps).map(|step| step.name.as_str()).collect();
    let sides: Vec<Value> =
        before.map(|before| side("before", before)).into_iter().chain([side("after", after)]).collect();
    let layout = stocks.iter().find_map(|(_, stock)| stock.map(|stock| stock.layout));
    json!({
        "sides": sides,
        "file": to_safe_line(comparison.subject.program.source().name()),
        "steps": steps,
        "classes": MotionClass::ALL.map(|class| class.to_string().replace('_', " ")),
        "units": unit_facts(units),
        "origin": origin.map(shown),
        // Places along time are those of the machine only where it is known.
        "machineTime": comparison.subject.setup.machine.dynamics().is_some(),
        "limits": build_limit_facts(comparison),
        "stock": layout.map(|layout| json!({
            "first": layout.first_mm.map(shown), "cell": shown(layout.cell_mm), "columns": layout.columns,
            "rows": layout.rows, "low": shown(layout.base_mm),
        })),
    })
}

/// Returns the targets and limits that charts draw: those of the recipe's steps, and those of the machine.
fn build_limit_facts(comparison: &Comparison<'_>) -> Vec<Value> {
    let (subject, units) = (&comparison.subject, comparison.units());
    let machine = subject.setup.machine.max_feed;
    let machine =
        machine.map(|most| DrawnLimit::new(LimitedQuantity::Feed, most.get(), "max_feed of the machine"));
    let steps = subject.recipe.into_iter().flat_map(|recipe| {
        let mm_per_unit = recipe.units.mm_per_unit();
        recipe.steps.iter().flat_map(move |step| step.transform().drawn_limits(mm_per_unit))
    });
    let drawn = machine.into_iter().chain(steps).map(|limit| {
        let (name, unit) = match limit.quantity {
            LimitedQuantity::Feed => ("feed", ColumnUnit::FeedPerMinute),
            LimitedQuantity::Chip => ("chip", ColumnUnit::Length),
            LimitedQuantity::Removal => ("removal", ColumnUnit::RemovalRate),
            LimitedQuantity::Force => ("force", ColumnUnit::Force),
            LimitedQuantity::Torque => ("torque", ColumnUnit::Torque),
            LimitedQuantity::Power => ("power", ColumnUnit::Power),
            LimitedQuantity::Deflection => ("deflection", ColumnUnit::Length),
            LimitedQuantity::BendingStress => ("stress", ColumnUnit::Stress),
        };
        json!({ "quantity": name, "value": units.convert(unit, limit.value), "name": limit.name })
    });
    drawn.collect()
}

/// Returns how the drawing of the stock is simplified.
fn describe_drawn_stock(stock: &StockStates, units: DisplayUnits) -> String {
    let layout = &stock.layout;
    let coarser = match layout.coarser {
        0 | 1 => String::new(),
        coarser => format!(" ({coarser} x {coarser} columns of the simulation)"),
    };
    format!(
        "the stock is drawn as {} x {} columns {} apart, each as high as the highest material in it{coarser}; undercuts are \
         not drawn; {} states of it are kept, and between them the page lowers it along the path, where tools stand upright",
        layout.columns,
        layout.rows,
        units.tell_trimmed(ColumnUnit::Length, layout.cell_mm, 3),
        stock.states.len(),
    )
}

/// The height that stands for one that is as in the state before. No height is below 0.
const UNCHANGED: f32 = -1.0;

/// Returns the heights of all states in the units that a reader sees. Those that have not changed since the state
/// before are [`UNCHANGED`], which makes the page small.
fn encode_states(stock: &StockStates, units: DisplayUnits) -> Vec<f32> {
    let mut before: Option<&Vec<f32>> = None;
    let mut all = Vec::new();
    for state in &stock.states {
        let shown = show_values(units, ColumnUnit::Length, state.heights.clone());
        match before {
            None => all.extend(shown),
            Some(before) => {
                all.extend(shown.iter().zip(&state.heights).zip(before).map(|((shown, now), was)| {
                    if now.to_bits() == was.to_bits() { UNCHANGED } else { *shown }
                }))
            }
        }
        before = Some(&state.heights);
    }
    all
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
