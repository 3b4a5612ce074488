//! This module describes the tools of a program for the page: their shapes as numbers for the 3D view, in words, and
//! as pictures.

use crate::cutter::{CutterModel, NonCuttingKind};
use crate::program::LengthUnit;
use crate::program::motion::ActiveTool;
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::setup::Setup;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The number of points of a meridian in the page.
const MERIDIAN_POINTS: usize = 33;

/// The height and the largest width of a picture, in pixels.
const PICTURE: [f64; 2] = [120.0, 90.0];

/// A tool of the page.
#[derive(Debug, Clone, Default)]
pub(super) struct PageTool {
    /// Its number and name.
    pub name: String,
    /// Its shape, if it is known.
    pub cutter: Option<CutterModel>,
}

impl PageTool {
    /// Makes the tool of a program whose lengths are in `units`.
    pub(super) fn from_active_tool(tool: &ActiveTool, setup: &Setup, units: LengthUnit) -> Self {
        let cutter = setup.resolve_cutter(tool, units).ok().map(|resolved| resolved.cutter);
        Self { name: tool.display_name(), cutter }
    }

    /// Returns the points (r, z) of the meridian from the tip up, mm.
    fn meridian_points_mm(cutter: &CutterModel) -> Vec<[f64; 2]> {
        let length = cutter.profile.arc_length_mm();
        let place = |index: usize| length * index as f64 / (MERIDIAN_POINTS - 1) as f64;
        // Where bottom, corner and flank meet there may be an edge, which equal steps would cut off.
        let edges = [cutter.profile.bottom_arc_length_mm(), cutter.profile.flank_start_arc_length_mm()];
        let mut places: Vec<f64> = (0..MERIDIAN_POINTS).map(place).chain(edges).collect();
        places.sort_by(f64::total_cmp);
        let points = places.into_iter().map(|place| cutter.profile.point_at_arc_length(place));
        let mut points: Vec<[f64; 2]> = points.map(|point| [point.r.max(0.0), point.z]).collect();
        // A cutter that is narrower above its widest place ends there.
        let top = [cutter.profile.upper_radius_mm(), cutter.flute_length_mm()];
        if points.last().is_none_or(|[_, z]| top[1] - z > 1e-9) {
            points.push(top);
        }
        points
    }

    /// Returns the shape as the 3D view reads it, in the units that a reader sees; null if it is not known.
    pub(super) fn to_json(&self, units: DisplayUnits) -> Value {
        let shown = |value: f64| units.convert(ColumnUnit::Length, value);
        let Some(cutter) = &self.cutter else { return Value::Null };
        let collars = cutter.collars.iter().map(|collar| {
            json!({
                "kind": kind_name(collar.kind), "radius": shown(collar.radius_mm), "from": shown(collar.from_mm),
                "to": shown(collar.to_mm),
            })
        });
        json!({
            "profile": Self::meridian_points_mm(cutter).into_iter().map(|point| point.map(shown)).collect::<Vec<_>>(),
            "collars": collars.collect::<Vec<_>>(),
        })
    }

    /// Returns the shape in words.
    pub(super) fn describe_shape(&self, units: DisplayUnits) -> String {
        let Some(cutter) = &self.cutter else { return "its shape is not known".to_owned() };
        let tell = |value: f64| units.tell_trimmed(ColumnUnit::Length, value, 3);
        let (radius, corner) = (cutter.radius_mm(), cutter.profile.corner_radius_mm());
        let mut said = vec![format!("diameter {}", tell(2.0 * radius))];
        if corner > 0.0 {
            said.push(format!("corner radius {}", tell(corner)));
        }
        if cutter.profile.taper_rad() != 0.0 {
            said.push(format!("taper {:.2}°", cutter.profile.taper_rad().to_degrees()));
        }
        said.push(format!("flutes {} long", tell(cutter.flute_length_mm())));
        said.push(match &cutter.teeth {
            Some(teeth) => match teeth.count() {
                1 => "1 tooth".to_owned(),
                count => format!("{count} teeth"),
            },
            None => "teeth not known".to_owned(),
        });
        said.extend(cutter.collars.iter().map(|collar| {
            format!(
                "{} diameter {} up to {}",
                kind_name(collar.kind),
                tell(2.0 * collar.radius_mm),
                tell(collar.to_mm)
            )
        }));
        said.join(", ")
    }

    /// Writes a picture of the tool from the side. Nothing is written if its shape is not known.
    pub(super) fn write_picture(&self, out: &mut dyn Write) -> io::Result<()> {
        let Some(cutter) = &self.cutter else { return Ok(()) };
        let widest = cutter.collars.iter().map(|collar| collar.radius_mm).fold(cutter.radius_mm(), f64::max);
        let longest =
            cutter.collars.iter().map(|collar| collar.to_mm).fold(cutter.flute_length_mm(), f64::max);
        let [height, width] = PICTURE;
        let scale = (height / longest).min(width / (2.0 * widest));
        let (tall, wide) = (longest * scale, 2.0 * widest * scale);
        let place = |r: f64, z: f64| format!("{:.2} {:.2}", wide / 2.0 + r * scale, tall - z * scale);
        let points = Self::meridian_points_mm(cutter);
        let right = points.iter().map(|[r, z]| place(*r, *z));
        let left = points.iter().rev().map(|[r, z]| place(-r, *z));
        let outline: Vec<String> = right.chain(left).collect();
        write!(
            out,
            "<svg class=\"tool\" role=\"img\" aria-label=\"the tool from the side\" width=\"{0:.0}\" height=\"{1:.0}\" \
             viewBox=\"-1 -1 {0:.2} {1:.2}\">",
            wide + 2.0,
            tall + 2.0
        )?;
        for collar in &cutter.collars {
            write!(
                out,
                "<rect class=\"{}\" x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\"/>",
                kind_name(collar.kind),
                wide / 2.0 - collar.radius_mm * scale,
                tall - collar.to_mm * scale,
                2.0 * collar.radius_mm * scale,
                (collar.to_mm - collar.from_mm) * scale
            )?;
        }
        write!(out, "<path class=\"flutes\" d=\"M{}Z\"/></svg>", outline.join("L"))
    }
}

fn kind_name(kind: NonCuttingKind) -> &'static str {
    match kind {
        NonCuttingKind::Shank => "shank",
        NonCuttingKind::Holder => "holder",
    }
}
