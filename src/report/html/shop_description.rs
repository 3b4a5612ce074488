//! This module describes machine, stock and material of a page in sentences.

use crate::report::comparison::Comparison;
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::report::text_format::format_short;
use crate::setup::{MaterialChoice, Setup, StockBodyShape};

/// Returns rows of a title and a description.
pub(super) fn describe_shop(comparison: &Comparison<'_>) -> Vec<(&'static str, String)> {
    let (setup, units) = (comparison.subject.setup, comparison.units());
    let mut rows = vec![("Machine", describe_machine(setup, units)), ("Stock", describe_stock(setup, units))];
    let simulated = comparison.runs.after.as_ref();
    let told = simulated.and_then(|simulated| simulated.material.clone());
    let given = setup.material.as_ref().map(|material| match material {
        MaterialChoice::Given(_) => "given by its coefficients".to_owned(),
        MaterialChoice::File(file) => file.written.clone(),
    });
    rows.push(("Material", told.or(given).unwrap_or_else(|| "not given, so no forces".to_owned())));
    if let Some(simulated) = simulated {
        // Volumes shrink with the cube of the unit, as removal rates do.
        let volume = |mm3: f64| {
            let symbol = ColumnUnit::Volume.marked_symbol(units.shown_in);
            format!("{} {symbol}", format_short(units.convert(ColumnUnit::Volume, mm3)))
        };
        let stock = &simulated.stock;
        rows.push((
            "Removed",
            format!(
                "{} of {}; {} are left",
                volume(stock.removed_mm3),
                volume(stock.before_mm3),
                volume(stock.left_mm3)
            ),
        ));
        if let Some(target) = &simulated.target {
            rows.push((
                "Target",
                format!(
                    "{}: {} too much removed, {} left over, beyond {}",
                    target.file,
                    volume(target.gouge.volume_mm3),
                    volume(target.excess.volume_mm3),
                    units.tell_trimmed(ColumnUnit::Length, target.tolerance_mm, 3)
                ),
            ));
        }
    }
    rows
}

fn describe_machine(setup: &Setup, units: DisplayUnits) -> String {
    let machine = &setup.machine;
    let feed = |value: f64| {
        let unit = ColumnUnit::FeedPerMinute;
        format!("{} {}", format_short(units.convert(unit, value)), unit.marked_symbol(units.shown_in))
    };
    let mut said: Vec<String> = machine.name.iter().cloned().collect();
    if let Some(chain) = &machine.chain {
        said.push(format!("{} axes", chain.axes().len()));
    }
    said.extend(machine.max_feed.map(|most| format!("feeds up to {}", feed(most.get()))));
    said.extend(machine.rapid_feed.map(|rapid| format!("rapids at {}", feed(rapid.get()))));
    said.extend(
        machine.max_acceleration.map(|most| format!("feeds change by {} in a second", feed(most.get()))),
    );
    if said.is_empty() { "not given".to_owned() } else { said.join(", ") }
}

fn describe_stock(setup: &Setup, units: DisplayUnits) -> String {
    let tell = |value: f64| units.tell_trimmed(ColumnUnit::Length, value, 3);
    let point = |at: &[f64; 3]| {
        let at = at.map(|value| {
            crate::report::text_format::format_trimmed(units.convert(ColumnUnit::Length, value), 3)
        });
        format!("({})", at.join(", "))
    };
    let Some(stock) = &setup.stock else { return "not given, so nothing is simulated".to_owned() };
    let bodies = stock.bodies.iter().map(|body| match &body.shape {
        StockBodyShape::Block { low, high } => format!("block from {} to {}", point(low), point(high)),
        StockBodyShape::Cylinder { diameter, from, to } => {
            format!("cylinder of diameter {} from {} to {}", tell(*diameter), point(from), point(to))
        }
        StockBodyShape::Stl { file, .. } | StockBodyShape::Saved(file) => format!("of {}", file.written),
        StockBodyShape::Around { file, .. } => format!("around {}", file.written),
    });
    let mut said: Vec<String> = bodies.collect();
    if stock.allowance_mm > 0.0 {
        said.push(format!("up to {} more on it", tell(stock.allowance_mm)));
    }
    said.join("; ")
}
