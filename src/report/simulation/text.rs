//! A simulation as text for people.

use super::target::Differing;
use super::{OperationSums, Peak, Simulated, Sums};
use crate::report::render::text::one_line;
use crate::report::table::{count, counted, duration, fixed, short, table};
use std::fmt::Write;

/// Rows of a table that are shown; the JSON has all.
const MOST_ROWS: usize = 24;

/// The simulation as tables.
pub fn to_text(simulated: &Simulated) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", one_line(&simulated.file));
    stock(&mut out, simulated);
    time(&mut out, simulated);
    operations(&mut out, simulated);
    largest(&mut out, &simulated.totals);
    faults(&mut out, simulated);
    target(&mut out, simulated);
    for assumption in &simulated.assumptions {
        let _ = writeln!(out, "  assumed: {assumption}");
    }
    out
}

fn stock(out: &mut String, simulated: &Simulated) {
    let (cost, accuracy) = (&simulated.cost, &simulated.accuracy);
    let _ = writeln!(
        out,
        "  {} columns {} mm apart ({} MiB), about {:.0e} looks at them along {} mm of path",
        count(cost.columns),
        short(accuracy.cell_mm),
        fixed(cost.bytes as f64 / f64::from(1 << 20), 1),
        cost.visits,
        fixed(cost.path_mm, 1),
    );
    let _ = writeln!(
        out,
        "  borders of material are known to {} mm across z, curves to {} mm",
        precise(accuracy.lateral_mm),
        precise(accuracy.chord_mm),
    );
    let stock = &simulated.stock;
    let _ = writeln!(
        out,
        "  stock {} mm3, removed {} mm3, left {} mm3",
        fixed(stock.before_mm3, 1),
        fixed(stock.removed_mm3, 1),
        fixed(stock.left_mm3, 1),
    );
}

fn time(out: &mut String, simulated: &Simulated) {
    let totals = &simulated.totals;
    let mut parts = vec![format!("{} at feed", seconds(totals))];
    if let Some(with) = simulated.accelerated_seconds.filter(|_| totals.untimed == 0) {
        parts.push(format!("{} with the machine's acceleration", duration(with)));
    }
    if let Some(rapid) = totals.rapid_seconds {
        parts.push(format!("{} at rapid", duration(rapid)));
    }
    let _ = writeln!(out, "  time: {}", parts.join(", "));
    if totals.untimed > 0 {
        let motions = counted(totals.untimed, "motion", "motions");
        let _ = writeln!(out, "  {motions} at a feed that is not known, and without a time");
    }
}

/// A time that leaves motions out is a lower bound, and says so.
fn seconds(sums: &Sums) -> String {
    format!("{}{}", if sums.untimed > 0 { "> " } else { "" }, duration(sums.feed_seconds))
}

fn operations(out: &mut String, simulated: &Simulated) {
    let forces = simulated.motions.rows.iter().any(|row| row.force_n.is_some());
    let mut head = vec![
        "operation",
        "tool",
        "motions",
        "at feed, mm",
        "time",
        "mm3",
        "chip, mm",
        "mm3/min",
        "deep",
        "wide",
    ];
    if forces {
        head.extend(["N", "kW"]);
    }
    let mut rows: Vec<Vec<String>> = vec![head.into_iter().map(str::to_owned).collect()];
    rows.extend(simulated.operations.iter().take(MOST_ROWS).map(|operation| row(operation, forces)));
    out.push('\n');
    out.push_str(&table(&rows));
    let more = simulated.operations.len().saturating_sub(MOST_ROWS);
    if more > 0 {
        let _ = writeln!(out, "  and {} more", count(more as u64));
    }
    out.push('\n');
}

fn row(operation: &OperationSums, forces: bool) -> Vec<String> {
    let sums = &operation.sums;
    let peak = |peak: Option<Peak>, decimals: usize| {
        peak.map_or_else(|| "-".to_owned(), |peak| fixed(peak.value, decimals))
    };
    let mut row = vec![
        one_line(&operation.name),
        one_line(&operation.tool),
        count(sums.motions as u64),
        fixed(sums.feed_mm, 1),
        seconds(sums),
        fixed(sums.removed_mm3, 1),
        peak(sums.chip_thickness_mm, 4),
        peak(sums.removal_rate_mm3_min, 0),
        peak(sums.axial_depth_mm, 2),
        peak(sums.radial_depth_mm, 2),
    ];
    if forces {
        row.extend([peak(sums.force_n, 0), peak(sums.power_kw, 3)]);
    }
    row
}

fn largest(out: &mut String, totals: &Sums) {
    let all = [
        ("thickest chip", totals.chip_thickness_mm, 4, "mm"),
        ("largest removal rate", totals.removal_rate_mm3_min, 0, "mm3/min"),
        ("largest force", totals.force_n, 0, "N"),
        ("largest torque", totals.torque_nm, 2, "N m"),
        ("largest power", totals.power_kw, 3, "kW"),
    ];
    for (what, peak, decimals, unit) in all {
        let Some(peak) = peak else { continue };
        let line = peak.line.map_or_else(String::new, |line| format!(" on line {line}"));
        let _ = writeln!(out, "  {what}: {} {unit}{line}", fixed(peak.value, decimals));
    }
    if totals.cutting == 0 {
        let _ = writeln!(out, "  nothing is cut");
    }
}

fn faults(out: &mut String, simulated: &Simulated) {
    let faults = simulated.faults;
    let motions = |number: usize| counted(number, "motion", "motions");
    let _ = match faults.collisions {
        0 => writeln!(out, "  no collision of shank or holder"),
        some => writeln!(out, "  shank or holder in material: {}", motions(some)),
    };
    if faults.rapids_in_material > 0 {
        let _ = writeln!(out, "  rapids through material: {}", motions(faults.rapids_in_material));
    }
    if faults.spindle_stands > 0 {
        let _ = writeln!(out, "  cuts while the spindle stands: {}", motions(faults.spindle_stands));
    }
    if faults.unknown_feeds > 0 {
        let _ =
            writeln!(out, "  cuts at a feed or speed that is not known: {}", motions(faults.unknown_feeds));
    }
}

fn target(out: &mut String, simulated: &Simulated) {
    let Some(compared) = &simulated.target else { return };
    let name = one_line(&compared.file);
    let _ = writeln!(out, "  against {name}, tolerance {} mm:", precise(compared.tolerance_mm));
    let mut side = |what: &str, found: &Differing| {
        let _ = match &found.thickest {
            None => writeln!(out, "    no {what}"),
            Some(thickest) => {
                let [x, y, z] = thickest.at.map(|at| fixed(at, 3));
                writeln!(
                    out,
                    "    {what} {} mm3, at most {} mm along z, at x {x}, y {y}, z {z} mm",
                    fixed(found.volume_mm3, 1),
                    fixed(thickest.mm, 3),
                )
            }
        };
    };
    side("gouge", &compared.gouge);
    side("excess", &compared.excess);
}

/// A small length with the digits that it has, to a tenth of a micron.
fn precise(value: f64) -> String {
    let text = fixed(value, 4);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
