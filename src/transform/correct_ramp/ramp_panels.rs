//! This module draws ramps from above, and their height along the path.

use super::report::{CorrectRampReport, RampOutcome, RampReport};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::presentation::path_panel::{PanelPath, PanelPathStyle, PathPanel};

/// The largest number of ramps that are drawn.
const MOST_DRAWN: usize = 12;

/// Two panels for each ramp that was corrected: across the tool axis, and height along the path, with the steepest slope allowed.
pub(super) fn build_ramp_panels(report: &CorrectRampReport, units: DisplayUnits) -> Vec<PathPanel> {
    let corrected = report.ramps.iter().filter(|ramp| ramp.outcome == RampOutcome::Corrected);
    let panels = corrected
        .take(MOST_DRAWN)
        .flat_map(|ramp| [build_top_view(ramp, units), build_height_panel(ramp, units)]);
    panels.map(|panel| panel.convert_lengths(units)).collect()
}

fn panel_title(ramp: &RampReport) -> String {
    let name = if ramp.operation.is_empty() { String::new() } else { format!("{}, ", ramp.operation) };
    format!("{name}line {}: {}", ramp.line, ramp.kind)
}

fn build_top_view(ramp: &RampReport, units: DisplayUnits) -> PathPanel {
    let flat = |path: &[[f64; 3]]| path.iter().map(|[x, y, _]| (*x, *y)).collect();
    let path = |name: &str, look: PanelPathStyle, points: &[[f64; 3]]| PanelPath {
        name: name.to_owned(),
        look,
        points: flat(points),
    };
    PathPanel {
        title: panel_title(ramp),
        right: units.title("x", ColumnUnit::Length),
        up: units.title("y", ColumnUnit::Length),
        one_scale: true,
        paths: vec![
            path("before", PanelPathStyle::Before, &ramp.path_before),
            path("after", PanelPathStyle::After, &ramp.path_after),
        ],
    }
}

fn build_height_panel(ramp: &RampReport, units: DisplayUnits) -> PathPanel {
    let before = unroll_heights(&ramp.path_before);
    let after = unroll_heights(&ramp.path_after);
    let end = before.last().map_or(0.0, |last| last.1);
    let height = before.first().map_or(0.0, |first| first.1) - end;
    // The line of the steepest allowed slope ends at the height where the ramp began.
    let across = height / ramp.limit_degrees.to_radians().tan();
    let limit = vec![(0.0, end + height), (across, end)];
    let path = |name: &str, look: PanelPathStyle, points: Vec<(f64, f64)>| PanelPath {
        name: name.to_owned(),
        look,
        points,
    };
    PathPanel {
        title: "height along the path".to_owned(),
        right: units.title("distance across the tool axis", ColumnUnit::Length),
        up: units.title("z", ColumnUnit::Length),
        one_scale: false,
        paths: vec![
            path(
                &format!("steepest allowed, {:.1} degrees", ramp.limit_degrees),
                PanelPathStyle::Reference,
                limit,
            ),
            path("before", PanelPathStyle::Before, before),
            path("after", PanelPathStyle::After, after),
        ],
    }
}

/// Returns the height over the distance covered across the axis.
fn unroll_heights(path: &[[f64; 3]]) -> Vec<(f64, f64)> {
    let mut gone = 0.0;
    let mut last: Option<[f64; 3]> = None;
    path.iter()
        .map(|[x, y, z]| {
            if let Some([x0, y0, _]) = last {
                gone += (x - x0).hypot(y - y0);
            }
            last = Some([*x, *y, *z]);
            (gone, *z)
        })
        .collect()
}
