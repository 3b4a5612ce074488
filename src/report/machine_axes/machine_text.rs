//! This module describes a machine for people.

use crate::machine::{AxisKind, AxisMount, MachineAxis};
use crate::presentation::text_format::format_table;
use crate::presentation::to_safe_line;
use crate::report::text_format::format_short;
use crate::setup::MachineLimits;
use std::fmt::Write as _;

/// Returns a description of a machine: its chain, and what is known of its motion.
pub fn describe_machine(machine: &MachineLimits) -> String {
    let mut out =
        format!("{}\n", to_safe_line(machine.name.as_deref().unwrap_or("a machine without a name")));
    match &machine.chain {
        Some(chain) => {
            let pole = match (chain.rotary_axes().count(), chain.has_pole()) {
                (2, true) => "two rotary axes, with a pole",
                (2, false) => "two rotary axes, without a pole",
                (1, _) => "one rotary axis",
                _ => "no rotary axes",
            };
            let kept = match (chain.rotary_axes().count(), machine.tcp) {
                (0, _) => "",
                (_, Some(false)) => "; the tip is not kept on its line (tcp: false)",
                _ => "; the tip is kept on its line (tcp)",
            };
            let [i, j, k] = <[f64; 3]>::from(*chain.tool_axis()).map(format_short);
            let _ = writeln!(out, "  {pole}{kept}; tool axis at zero [{i}, {j}, {k}]\n");
            out.push_str(&format_axes(chain.axes()));
        }
        None => out.push_str("  its axes are not described\n"),
    }
    out.push('\n');
    let facts = [
        ("highest feed", machine.max_feed.map(|value| value.get()), "mm/min"),
        ("rapid feed", machine.rapid_feed.map(|value| value.get()), "mm/min"),
        ("acceleration along the path", machine.max_acceleration.map(|value| value.get() / 60.0), "mm/s2"),
        ("jerk along the path", machine.path_jerk.map(|value| value.get()), "mm/s3"),
        (
            "corner constant",
            machine.corner_constant.map(|value| value.get() * 1000.0),
            "ms by the root of mm/s",
        ),
        ("tool change", machine.tool_change.map(|value| value.get()), "s"),
        ("spindle start", machine.spindle_start.map(|value| value.get()), "s"),
    ];
    for (name, value, unit) in facts {
        let value = value.map_or("not known".to_owned(), |value| format!("{} {unit}", format_short(value)));
        let _ = writeln!(out, "  {name}: {value}");
    }
    out
}

fn format_axes(axes: &[MachineAxis]) -> String {
    let head = ["axis", "in", "does", "direction", "point, mm", "limits", "feed/min", "rapid/min", "per s2"];
    let mut table = vec![head.map(str::to_owned).to_vec()];
    for axis in axes {
        let vector = |numbers: [f64; 3]| format!("[{}]", numbers.map(format_short).join(", "));
        let rotary = axis.kind == AxisKind::Rotary;
        let limits = match axis.limits {
            Some([low, high]) => format!("{low} to {high} {}", axis.value_unit()),
            None if rotary => "turns without end".to_owned(),
            None => "none".to_owned(),
        };
        table.push(vec![
            to_safe_line(&axis.name),
            if axis.mount == AxisMount::Table { "table" } else { "head" }.to_owned(),
            if rotary { "turns" } else { "slides" }.to_owned(),
            vector((*axis.direction).into()),
            if rotary { vector(axis.point.coords.into()) } else { "-".to_owned() },
            limits,
            format_short(axis.max_speed),
            format_short(axis.rapid),
            format_short(axis.acceleration),
        ]);
    }
    format_table(&table)
}
