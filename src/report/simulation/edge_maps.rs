//! This module holds the chip thickness over edges in the middle of motions: by the place on the edge and the rotation of the
//! spindle, as a table, and with the stock around the tool for the drawing.

use super::SimulationReport;
use super::edge_drawing::MOST_DRAWN_MAPS;
use super::stock_window::StockWindow;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::{CuttingCoefficients, CuttingLaw, ToothThickness};
use crate::report::rounding::round_to_micro;
use crate::report::table::{Column, ColumnUnit, CsvTable, DisplayUnits};
use crate::simulation_run::{EdgeMoment, ForceRequest, Machining, RunWatcher, SimulationRunOptions};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::ops::RangeInclusive;

/// The rotations and the points of an edge of a map.
const GRID: [usize; 2] = [360, 64];

/// The most motions of which maps are made.
const MOST_MOTIONS: usize = 1000;

/// No forces are asked for: thickness needs no material.
const NO_LAW: CuttingLaw = CuttingLaw::Linear(CuttingCoefficients::NONE);

/// The chips over edges in the middle of a motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EdgeMapReport {
    /// The line of the statement that ends the motion.
    pub line: usize,
    /// The place, and the thickness over edges and rotations there.
    pub moment: EdgeMoment,
    /// The stock around the tool at that moment, if [`SimulationReport::find_stock_at_edges`] was called.
    pub(super) stock: Option<StockWindow>,
    /// The number of the motion.
    number: usize,
}

/// One cell of a map.
#[derive(Debug, Clone, Copy)]
struct EdgeCell {
    line: usize,
    tooth: usize,
    rotation_deg: f64,
    along_mm: f64,
    height_mm: f64,
    radius_mm: f64,
    thickness_mm: f64,
}

impl SimulationReport {
    /// Maps the chip thickness over edges in the middle of each motion at feed that ends on one of some lines.
    ///
    /// # Errors
    /// Returns a finding if there is no such motion of a cutter whose teeth, feed and speed are known, if there are too many,
    /// or if the stock does not permit it, and [`Failure::Interrupted`] if `watch` has stopped the run.
    pub fn find_edge_maps(
        &mut self,
        machining: &Machining<'_>,
        lines: &RangeInclusive<usize>,
        watch: &dyn RunWatcher,
    ) -> Result<(), Failure> {
        let numbers = self.number_rows(machining);
        let line_of = |number: usize| {
            let row = numbers.get(&number).and_then(|row| self.motions.rows.get(*row))?;
            row.line.filter(|line| lines.contains(line) && !row.rapid)
        };
        let asked = numbers.keys().filter(|number| line_of(**number).is_some()).count();
        if asked > MOST_MOTIONS {
            let message = format!(
                "{asked} motions at feed end on these lines; edges of at most {MOST_MOTIONS} are mapped"
            );
            return Err(Diagnostic::new(codes::NO_FORCES_THERE, message)
                .with_help("Ask for fewer lines.")
                .into());
        }
        let request = ForceRequest {
            law: NO_LAW,
            speed_of: &|number, motion| {
                machining.cutting_speed_of(motion).filter(|_| line_of(number).is_some())
            },
        };
        let found = machining.find_edge_moments(&request, GRID, watch)?;
        let found = found.ok_or_else(super::force_places::refuse_stock)?;
        if found.is_empty() {
            let message = "no motion at feed, with a feed, a speed, teeth and a whole bottom that are known, ends on these lines";
            let help = "Lines are those of GOTOs, as the first column of `--csv` tells them; edges that leave the middle free are not mapped.";
            return Err(Diagnostic::new(codes::NO_FORCES_THERE, message).with_help(help).into());
        }
        self.edge_maps = found
            .into_iter()
            .filter_map(|(number, moment)| {
                Some(EdgeMapReport { line: line_of(number)?, moment, stock: None, number })
            })
            .collect();
        Ok(())
    }

    /// Checks that the maps are few enough for one drawing.
    ///
    /// # Errors
    /// Returns a finding if they are not.
    pub fn check_edge_drawing(&self) -> Result<(), Failure> {
        let maps: usize = self.edge_maps.iter().map(|map| map.moment.map.teeth.len()).sum();
        if maps <= MOST_DRAWN_MAPS {
            return Ok(());
        }
        let message = format!("{maps} maps of edges do not fit in one drawing; {MOST_DRAWN_MAPS} do");
        Err(Diagnostic::new(codes::NO_FORCES_THERE, message).with_help("Ask for fewer lines.").into())
    }

    /// Finds the stock around the tool at the moments of the maps, for their drawing. The program is cut once more for that, up to
    /// the last of them.
    ///
    /// # Errors
    /// Returns the errors of [`SimulationReport::simulate_program`].
    pub fn find_stock_at_edges(
        &mut self,
        machining: &Machining<'_>,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
    ) -> Result<(), Failure> {
        let numbers: BTreeSet<usize> = self.edge_maps.iter().map(|map| map.number).collect();
        let mut windows: BTreeMap<usize, StockWindow> = BTreeMap::new();
        let moments: BTreeMap<usize, &EdgeMoment> =
            self.edge_maps.iter().map(|map| (map.number, &map.moment)).collect();
        machining.show_stock_at_middles(&numbers, options, watch, &mut |number, stock| {
            if let Some(moment) = moments.get(&number) {
                windows.insert(number, StockWindow::around_tool(stock, moment));
            }
        })?;
        for map in &mut self.edge_maps {
            map.stock = windows.remove(&map.number);
        }
        Ok(())
    }
}

impl EdgeMapReport {
    fn cells<'a>(&'a self, tooth: &'a ToothThickness) -> impl Iterator<Item = EdgeCell> + 'a {
        let map = &self.moment.map;
        let places = map
            .rotations_rad
            .iter()
            .flat_map(|rotation| map.points.iter().map(move |point| (rotation.to_degrees(), point)));
        places.zip(&tooth.thickness_mm).map(|((rotation_deg, point), thickness_mm)| EdgeCell {
            line: self.line,
            tooth: tooth.tooth,
            rotation_deg,
            along_mm: point.along_mm,
            height_mm: point.height_mm,
            radius_mm: point.radius_mm,
            thickness_mm: *thickness_mm,
        })
    }
}

fn cell_columns() -> [Column<EdgeCell>; 7] {
    [
        Column::new("line", ColumnUnit::None, |cell: &EdgeCell| cell.line.into()),
        Column::new("tooth", ColumnUnit::None, |cell: &EdgeCell| cell.tooth.into()),
        Column::new("rotation", ColumnUnit::Angle, |cell: &EdgeCell| cell.rotation_deg.into()),
        Column::new("along", ColumnUnit::Length, |cell: &EdgeCell| cell.along_mm.into()),
        Column::new("height", ColumnUnit::Length, |cell: &EdgeCell| cell.height_mm.into()),
        Column::new("radius", ColumnUnit::Length, |cell: &EdgeCell| cell.radius_mm.into()),
        Column::new("chip_thickness", ColumnUnit::Length, |cell: &EdgeCell| cell.thickness_mm.into()),
    ]
}

/// Writes the maps as a table with a row for each tooth, rotation and point.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_edges_csv(simulated: &SimulationReport, out: &mut dyn Write) -> io::Result<()> {
    let mut table = CsvTable::begin(&cell_columns(), simulated.units, out)?;
    for map in &simulated.edge_maps {
        for cell in map.moment.map.teeth.iter().flat_map(|tooth| map.cells(tooth)) {
            table.write_row(&cell)?;
        }
    }
    table.finish()
}

/// Returns a sentence for people about each map.
pub(super) fn describe_edge_maps(simulated: &SimulationReport) -> Vec<String> {
    let units = simulated.units;
    let describe = |edges: &EdgeMapReport| {
        let map = &edges.moment.map;
        let Some((thickness, [tooth, rotation, point])) = map.find_thickest() else {
            return format!("no edge cuts in the middle of the motion to line {}", edges.line);
        };
        let along = map.points.get(point).map_or(0.0, |point| point.along_mm);
        let turned = map.rotations_rad.get(rotation).map_or(0.0, |rotation| rotation.to_degrees());
        format!(
            "edges in the middle of the motion to line {}: thickest chip {}, {} along the edge from the tip, tooth {} turned by {turned:.0} deg",
            edges.line,
            units.tell_fixed(ColumnUnit::Length, thickness, 4),
            units.tell_fixed(ColumnUnit::Length, along, 2),
            map.teeth.get(tooth).map_or(1, |tooth| tooth.tooth),
        )
    };
    simulated.edge_maps.iter().map(describe).collect()
}

/// The maps as JSON: for each tooth lists of points, of rotations, and of thicknesses, one list for each rotation.
pub(super) struct EdgeMapsJson<'a> {
    pub maps: &'a [EdgeMapReport],
    pub units: DisplayUnits,
}

impl Serialize for EdgeMapsJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let teeth = self.maps.iter().flat_map(|edges| {
            edges.moment.map.teeth.iter().map(|tooth| ToothMapJson { edges, tooth, units: self.units })
        });
        serializer.collect_seq(teeth)
    }
}

struct ToothMapJson<'a> {
    edges: &'a EdgeMapReport,
    tooth: &'a ToothThickness,
    units: DisplayUnits,
}

impl Serialize for ToothMapJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (map, units) = (&self.edges.moment.map, self.units);
        let length = |value: f64| round_to_micro(units.convert(ColumnUnit::Length, value));
        let points = |value: fn(&crate::engagement::EdgePoint) -> f64| -> Vec<f64> {
            map.points.iter().map(|point| length(value(point))).collect()
        };
        let key = |name: &'static str| units.key(name, ColumnUnit::Length);
        let rotations: Vec<f64> =
            map.rotations_rad.iter().map(|rotation| round_to_micro(rotation.to_degrees())).collect();
        let thickness: Vec<Vec<f64>> = self
            .tooth
            .thickness_mm
            .chunks(map.points.len().max(1))
            .map(|row| row.iter().map(|thickness| length(*thickness)).collect())
            .collect();
        let mut entries = serializer.serialize_map(None)?;
        entries.serialize_entry("line", &self.edges.line)?;
        entries.serialize_entry("tooth", &self.tooth.tooth)?;
        entries.serialize_entry(&key("along"), &points(|point| point.along_mm))?;
        entries.serialize_entry(&key("height"), &points(|point| point.height_mm))?;
        entries.serialize_entry(&key("radius"), &points(|point| point.radius_mm))?;
        entries.serialize_entry("rotation_deg", &rotations)?;
        entries.serialize_entry(&key("chip_thickness"), &thickness)?;
        entries.end()
    }
}
