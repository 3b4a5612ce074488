//! This module writes the values of axes for other programs: CSV, JSON, and an array for NumPy.

use super::joint_table::{JointRow, JointTable};
use crate::diagnostic::Diagnostic;
use crate::presentation::display_units::ColumnUnit;
use crate::report::render::json::report_to_json;
use crate::report::table::to_csv_text;
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::io::{self, Write};

impl JointTable {
    /// Writes a row for each motion: line, kind, time, tip, tool axis, the values of the axes under their names, and what
    /// happens. What is not known is an empty cell.
    ///
    /// # Errors
    /// Returns the errors of the writer.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        let units = self.display_units();
        let tips = ["tip_x", "tip_y", "tip_z"].map(|name| units.key(name, ColumnUnit::Length));
        let axes = self.axes.iter().map(|(name, unit)| to_csv_text(&format!("{name}_{unit}")));
        let mut head = ["line", "motion", "time_s"].map(str::to_owned).to_vec();
        head.extend(tips.map(Cow::into_owned));
        head.extend(["axis_i", "axis_j", "axis_k"].map(str::to_owned));
        head.extend(axes);
        head.extend(["pole_deg", "pole", "flip", "rewind", "outside"].map(str::to_owned));
        head.push(units.key("sag", ColumnUnit::Length).into_owned());
        head.push(units.key("feed_limit", ColumnUnit::FeedPerMinute).into_owned());
        table.write_record(head)?;
        for row in &self.rows {
            table.write_record(self.csv_row(row))?;
        }
        table.flush()
    }

    fn csv_row(&self, row: &JointRow) -> Vec<String> {
        let optional = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        let mut cells = vec![
            row.line.map_or_else(String::new, |line| line.to_string()),
            motion_name(row).to_owned(),
            optional(row.time),
        ];
        cells.extend(row.tip.iter().chain(&row.axis).map(f64::to_string));
        cells.extend((0..self.axes.len()).map(|index| optional(row.joints.get(index).copied())));
        cells.push(optional(row.pole_angle));
        cells.extend([row.is_pole, row.is_flip, row.is_rewind].map(|flag| u8::from(flag).to_string()));
        cells.push(to_csv_text(&row.outside.join(" ")));
        cells.extend([row.sag, row.feed_limit].map(optional));
        cells
    }

    /// Returns the same as a JSON document, `"version": 1`, with the findings of the run. What is not known is `null`.
    pub fn to_json(&self, findings: &[Diagnostic]) -> String {
        let axes: Vec<Value> = self
            .axes
            .iter()
            .zip(&self.limits)
            .map(|((name, unit), limits)| json!({ "name": name, "unit": unit, "limits": limits }))
            .collect();
        let motions: Vec<Value> = self.rows.iter().map(|row| self.json_row(row)).collect();
        let document = json!({
            "version": 1,
            "file": self.file,
            "units": self.length_unit,
            "axes": axes,
            "rotary_way_deg": self.rotary_way,
            "seconds": self.seconds,
            "motions": motions,
        });
        report_to_json(&document, findings)
    }

    fn json_row(&self, row: &JointRow) -> Value {
        let units = self.display_units();
        let (sag, feed_limit) =
            (units.key("sag", ColumnUnit::Length), units.key("feed_limit", ColumnUnit::FeedPerMinute));
        let joints: Map<String, Value> = self
            .axes
            .iter()
            .zip(&row.joints)
            .map(|((name, _), value)| (name.clone(), json!(value)))
            .collect();
        json!({
            "line": row.line,
            "motion": motion_name(row),
            "time_s": row.time,
            "tip": row.tip,
            "axis": row.axis,
            "joints": if joints.is_empty() { Value::Null } else { Value::Object(joints) },
            "pole_deg": row.pole_angle,
            "pole": row.is_pole,
            "flip": row.is_flip,
            "rewind": row.is_rewind,
            "outside": row.outside,
            sag: row.sag,
            feed_limit: row.feed_limit,
        })
    }

    /// Writes an array of doubles for NumPy (`.npy`, version 1.0): a row for each motion with line, time and the values of
    /// the axes. What is not known is not a number.
    ///
    /// # Errors
    /// Returns the errors of the writer.
    pub fn write_npy(&self, out: &mut dyn Write) -> io::Result<()> {
        let columns = 2 + self.axes.len();
        let mut header = format!(
            "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {columns}), }}",
            self.rows.len()
        );
        // Magic, version, length and header fill a multiple of 64 bytes, and a line end is the last.
        let padding = (64 - (10 + header.len() + 1) % 64) % 64;
        header.push_str(&" ".repeat(padding));
        header.push('\n');
        out.write_all(b"\x93NUMPY\x01\x00")?;
        out.write_all(&(header.len() as u16).to_le_bytes())?;
        out.write_all(header.as_bytes())?;
        for row in &self.rows {
            let line = row.line.map_or(f64::NAN, |line| line as f64);
            let joints = (0..self.axes.len()).map(|index| row.joints.get(index).copied().unwrap_or(f64::NAN));
            for value in [line, row.time.unwrap_or(f64::NAN)].into_iter().chain(joints) {
                out.write_all(&value.to_le_bytes())?;
            }
        }
        Ok(())
    }
}

fn motion_name(row: &JointRow) -> &'static str {
    if row.rapid { "rapid" } else { "feed" }
}
