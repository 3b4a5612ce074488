//! This module writes a simulation as a JSON document, in the unit of length that its reader sees.

use super::edge_maps::EdgeMapsJson;
use super::force_places::{named_places, place_columns, rotation_columns};
use super::motion_row::motion_columns;
use super::sum_columns::sum_columns;
use super::target_comparison::{TargetComparison, TargetMismatch};
use super::{
    OperationSums, ReportedCost, RotationRow, SimulationAccuracy, SimulationReport, SimulationSums,
    StockVolumes, ToothPeriodReport,
};
use crate::diagnostic::Diagnostic;
use crate::report::render::json::FindingsJson;
use crate::report::rounding::round_to_micro;
use crate::report::table::{Column, ColumnUnit, DisplayUnits, JsonColumns, RecordNumbers};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Returns the simulation as a JSON document, indented and with a line end. `findings` are those of the whole
/// run, after the policy; they are written under the key `findings`.
pub fn to_json(simulated: &SimulationReport, findings: &[Diagnostic]) -> String {
    crate::report::to_json_text(&SimulationDocument { simulated, findings })
}

struct SimulationDocument<'a> {
    simulated: &'a SimulationReport,
    findings: &'a [Diagnostic],
}

impl Serialize for SimulationDocument<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let simulated = self.simulated;
        let units = simulated.units;
        let mut map = serializer.serialize_map(None)?;
        // The version goes up when a reader of the old structure would fail. New keys may be added without
        // that.
        map.serialize_entry("version", &1)?;
        map.serialize_entry("file", &simulated.file)?;
        map.serialize_entry("units", &units.shown_in)?;
        map.serialize_entry("material", &simulated.material)?;
        map.serialize_entry("cost", &json_columns(&cost_columns(), units).object(&simulated.cost))?;
        let accuracy = json_columns(&accuracy_columns(), units);
        map.serialize_entry("accuracy", &accuracy.object(&simulated.accuracy))?;
        map.serialize_entry("stock", &json_columns(&stock_columns(), units).object(&simulated.stock))?;
        let sums = json_columns(&sum_columns(), units);
        map.serialize_entry("totals", &sums.object(&simulated.totals))?;
        map.serialize_entry("accelerated_seconds", &simulated.accelerated_seconds.map(round_to_micro))?;
        map.serialize_entry("chips", &simulated.chips)?;
        map.serialize_entry("faults", &simulated.faults)?;
        map.serialize_entry("assumptions", &simulated.assumptions)?;
        let operation = |operation| OperationJson { operation, sums: &sums };
        map.serialize_entry("operations", &simulated.operations.iter().map(operation).collect::<Vec<_>>())?;
        let target = simulated.target.as_ref().map(|target| TargetJson { target, units });
        map.serialize_entry("target", &target)?;
        map.serialize_entry("motions", &MotionsJson(simulated))?;
        if !simulated.force_places.is_empty() {
            map.serialize_entry("force_places", &PlacesJson(simulated))?;
        }
        if let Some(period) = &simulated.tooth_period {
            map.serialize_entry("tooth_period", &ToothPeriodJson { period, units })?;
        }
        if !simulated.edge_maps.is_empty() {
            map.serialize_entry("edges", &EdgeMapsJson { maps: &simulated.edge_maps, units })?;
        }
        map.serialize_entry("findings", &FindingsJson::from_findings(self.findings))?;
        map.end()
    }
}

fn json_columns<R>(columns: &[Column<R>], units: DisplayUnits) -> JsonColumns<R> {
    JsonColumns::new(columns, units, RecordNumbers::Rounded)
}

fn cost_columns() -> [Column<ReportedCost>; 4] {
    use ColumnUnit as Unit;
    [
        Column::new("columns", Unit::None, |cost: &ReportedCost| (cost.columns as usize).into()),
        Column::new("bytes", Unit::None, |cost: &ReportedCost| (cost.bytes as usize).into()),
        Column::new("visits", Unit::None, |cost: &ReportedCost| cost.visits.into()),
        Column::new("path", Unit::Length, |cost: &ReportedCost| cost.path_mm.into()),
    ]
}

fn accuracy_columns() -> [Column<SimulationAccuracy>; 4] {
    let unit = ColumnUnit::Length;
    [
        Column::new("cell", unit, |accuracy: &SimulationAccuracy| accuracy.cell_mm.into()),
        Column::new("lateral", unit, |accuracy: &SimulationAccuracy| accuracy.lateral_mm.into()),
        Column::new("chord", unit, |accuracy: &SimulationAccuracy| accuracy.chord_mm.into()),
        Column::new("removal_window", unit, |accuracy: &SimulationAccuracy| {
            accuracy.removal_window_mm.into()
        }),
    ]
}

fn stock_columns() -> [Column<StockVolumes>; 3] {
    let unit = ColumnUnit::Volume;
    [
        Column::new("before", unit, |stock: &StockVolumes| stock.before_mm3.into()),
        Column::new("removed", unit, |stock: &StockVolumes| stock.removed_mm3.into()),
        Column::new("left", unit, |stock: &StockVolumes| stock.left_mm3.into()),
    ]
}

struct OperationJson<'a> {
    operation: &'a OperationSums,
    sums: &'a JsonColumns<SimulationSums>,
}

impl Serialize for OperationJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("name", &self.operation.name)?;
        map.serialize_entry("tool", &self.operation.tool)?;
        map.serialize_entry("sums", &self.sums.object(&self.operation.sums))?;
        map.end()
    }
}

struct MotionsJson<'a>(&'a SimulationReport);

impl Serialize for MotionsJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let columns = json_columns(&motion_columns(), self.0.units);
        columns.serialize_rows(self.0.motions.named_rows(), serializer)
    }
}

struct PlacesJson<'a>(&'a SimulationReport);

impl Serialize for PlacesJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        json_columns(&place_columns(), self.0.units).serialize_rows(named_places(self.0), serializer)
    }
}

struct ToothPeriodJson<'a> {
    period: &'a ToothPeriodReport,
    units: DisplayUnits,
}

impl Serialize for ToothPeriodJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("line", &self.period.line)?;
        map.serialize_entry(
            "rotations",
            &RotationsJson { rotations: &self.period.rotations, units: self.units },
        )?;
        map.end()
    }
}

struct RotationsJson<'a> {
    rotations: &'a [RotationRow],
    units: DisplayUnits,
}

impl Serialize for RotationsJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        json_columns(&rotation_columns(), self.units)
            .serialize_rows(self.rotations.iter().copied(), serializer)
    }
}

struct TargetJson<'a> {
    target: &'a TargetComparison,
    units: DisplayUnits,
}

impl Serialize for TargetJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { target, units } = *self;
        let length = |value: f64| round_to_micro(units.convert(ColumnUnit::Length, value));
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("file", &target.file)?;
        map.serialize_entry(&units.key("tolerance", ColumnUnit::Length), &length(target.tolerance_mm))?;
        map.serialize_entry("gouge", &MismatchJson { mismatch: &target.gouge, units })?;
        map.serialize_entry("excess", &MismatchJson { mismatch: &target.excess, units })?;
        map.end()
    }
}

struct MismatchJson<'a> {
    mismatch: &'a TargetMismatch,
    units: DisplayUnits,
}

impl Serialize for MismatchJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { mismatch, units } = *self;
        let number = |unit: ColumnUnit, value: f64| round_to_micro(units.convert(unit, value));
        // The key of the thickness is the unit alone.
        let key = ColumnUnit::Length.symbol(units.shown_in);
        let thickest = mismatch.thickest.map(|thickest| {
            serde_json::json!({
                key: number(ColumnUnit::Length, thickest.thickness_mm),
                "at": thickest.at_mm.map(|at| number(ColumnUnit::Length, at)),
            })
        });
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry(
            &units.key("volume", ColumnUnit::Volume),
            &number(ColumnUnit::Volume, mismatch.volume_mm3),
        )?;
        map.serialize_entry("columns", &mismatch.columns)?;
        map.serialize_entry("thickest", &thickest)?;
        map.end()
    }
}
