//! This module writes the figures of a program over a surface as JSON, in the unit of the program.

use super::render::json::FindingsJson;
use super::rounding::round_to_micro;
use super::table::{Column, ColumnUnit, DisplayUnits, JsonColumns, RecordNumbers};
use crate::diagnostic::Diagnostic;
use crate::surface_milling::{SurfaceMillingOptions, SurfaceProgram};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Returns the figures of a program over a surface as a JSON document, indented and with a line end. `surfaced`
/// is not given if no program could be made; then `surface` is `null`. `written` is the file that the program
/// was written to. `findings` are those of the run, after the policy.
pub fn surface_to_json(
    file: &str,
    options: &SurfaceMillingOptions,
    surfaced: Option<&SurfaceProgram>,
    written: Option<&str>,
    findings: &[Diagnostic],
) -> String {
    let figures = surfaced.map(|surfaced| SurfaceFigures { surfaced, options });
    super::to_json_text(&SurfaceDocument { file, options, figures, written, findings })
}

struct SurfaceDocument<'a> {
    file: &'a str,
    options: &'a SurfaceMillingOptions,
    figures: Option<SurfaceFigures<'a>>,
    written: Option<&'a str>,
    findings: &'a [Diagnostic],
}

impl Serialize for SurfaceDocument<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let words = &self.options.words;
        let mut map = serializer.serialize_map(None)?;
        // The version goes up when a reader of the old structure would fail. New keys may be added without
        // that.
        map.serialize_entry("version", &1)?;
        map.serialize_entry("file", self.file)?;
        map.serialize_entry("units", &words.units)?;
        map.serialize_entry("dialect", words.dialect.name())?;
        map.serialize_entry("surface", &self.figures)?;
        map.serialize_entry("written", &self.written)?;
        map.serialize_entry("findings", &FindingsJson::from_findings(self.findings))?;
        map.end()
    }
}

/// A program and the options that it was made with, which together tell its figures.
struct SurfaceFigures<'a> {
    surfaced: &'a SurfaceProgram,
    options: &'a SurfaceMillingOptions,
}

fn figure_columns<'a>() -> [Column<SurfaceFigures<'a>>; 12] {
    type Row<'a> = SurfaceFigures<'a>;
    let (count, length) = (ColumnUnit::None, ColumnUnit::Length);
    [
        Column::new("planes", count, |row: &Row<'a>| row.surfaced.planes.into()),
        Column::new("empty_planes", count, |row: &Row<'a>| row.surfaced.empty.into()),
        Column::new("passes", count, |row: &Row<'a>| row.surfaced.passes.into()),
        Column::new("spacing", length, |row: &Row<'a>| row.surfaced.spacing_mm.into()),
        Column::new("cutting_motions", count, |row: &Row<'a>| row.surfaced.cutting_motion_count().into()),
        Column::new("cutting_length", length, |row: &Row<'a>| row.surfaced.cutting_length_mm().into()),
        Column::new("radius", length, |row: &Row<'a>| row.options.radius_mm.into()),
        Column::new("tolerance", length, |row: &Row<'a>| row.options.tolerance_mm.into()),
        Column::new("deepest_gouge", length, |row: &Row<'a>| row.surfaced.proof.gouge_mm.into()),
        Column::new("largest_gap", length, |row: &Row<'a>| row.surfaced.proof.gap_mm.into()),
        Column::new("check_may_miss", length, |row: &Row<'a>| row.surfaced.proof.bound_mm.into()),
        Column::new("scallop_height", length, |row: &Row<'a>| {
            row.surfaced.scallop_height_mm(row.options.radius_mm).into()
        }),
    ]
}

impl Serialize for SurfaceFigures<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let units = DisplayUnits::from_mm(self.options.words.units);
        let length = |length_mm: f64| round_to_micro(units.convert(ColumnUnit::Length, length_mm));
        let key = |name| units.key(name, ColumnUnit::Length);
        let proof = &self.surfaced.proof;
        let mut map = serializer.serialize_map(None)?;
        let columns = JsonColumns::new(&figure_columns(), units, RecordNumbers::Rounded);
        columns.object(self).serialize_entries(&mut map)?;
        map.serialize_entry(&key("deepest_gouge_at"), &proof.gouge_at_mm.map(length))?;
        map.serialize_entry(&key("largest_gap_at"), &proof.gap_at_mm.map(length))?;
        map.serialize_entry("is_within_tolerance", &proof.is_within(self.options.tolerance_mm))?;
        let parts = self.surfaced.unreached.iter().map(|part| UnreachedJson {
            from: [part.from.u, part.from.z].map(length),
            to: [part.to.u, part.to.z].map(length),
            left: length(part.left_mm),
        });
        map.serialize_entry("unreached", &parts.collect::<Vec<_>>())?;
        map.end()
    }
}

/// A part of a profile that the ball does not touch, as u and z in its plane, in the unit of the program.
#[derive(Serialize)]
struct UnreachedJson {
    from: [f64; 2],
    to: [f64; 2],
    left: f64,
}
