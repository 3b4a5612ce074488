//! This module gives the stock of a setup to the certified engagement, which asks how far a point is from it.

use crate::certified_engagement::{BoxGap, ColumnGap, CylinderGap, FunctionGap, MeshGap, StockGap};
use crate::stock::{Dexels, Mesh, SolidBody, Stock};
use nalgebra::Vector3;

/// Returns the gaps of the bodies of a stock, grown by its allowance. Returns `None` if a body has no gap, which a mesh
/// has that is not closed and remains have that are empty.
pub(super) fn list_stock_gaps(stock: &Stock) -> Option<Vec<Box<dyn StockGap>>> {
    let grown_mm = stock.allowance_mm();
    stock.bodies().iter().map(|body| make_gap(body, grown_mm)).collect()
}

fn make_gap(body: &SolidBody, grown_mm: f64) -> Option<Box<dyn StockGap>> {
    match body {
        SolidBody::Block { from, to } => {
            let low = Vector3::from(*from).add_scalar(-grown_mm);
            let high = Vector3::from(*to).add_scalar(grown_mm);
            Some(Box::new(BoxGap::new(low, high)))
        }
        SolidBody::Cylinder { diameter, from, to } => {
            let (from, to) = (Vector3::from(*from), Vector3::from(*to));
            let longer = (to - from).try_normalize(0.0)? * grown_mm;
            Some(Box::new(CylinderGap::new(diameter / 2.0 + grown_mm, from - longer, to + longer)?))
        }
        SolidBody::Mesh(mesh) => grow_gap(make_mesh_gap(mesh)?, grown_mm),
        SolidBody::Remains(dexels) => grow_gap(make_column_gap(dexels)?, grown_mm),
    }
}

/// Grows a body by a ball.
fn grow_gap(gap: impl StockGap + 'static, grown_mm: f64) -> Option<Box<dyn StockGap>> {
    if grown_mm == 0.0 {
        return Some(Box::new(gap));
    }
    let [low, high] = gap.bounds();
    let bounds = [low.add_scalar(-grown_mm), high.add_scalar(grown_mm)];
    Some(Box::new(FunctionGap::new(move |point: &Vector3<f64>| gap.gap(point) - grown_mm, bounds)))
}

fn make_mesh_gap(mesh: &Mesh) -> Option<MeshGap> {
    let corners: Vec<[Vector3<f64>; 3]> =
        mesh.triangle_corners().map(|corners| corners.map(Vector3::from)).collect();
    MeshGap::new(&corners).ok()
}

/// Makes the prisms of all columns: what a column holds stands for its cell.
fn make_column_gap(dexels: &Dexels) -> Option<ColumnGap> {
    let layout = dexels.grid();
    let origin = layout.origin_mm.map(|centre| centre - layout.cell_mm / 2.0);
    let spans = dexels.bands().iter().flat_map(|band| {
        (0..band.row_count() * band.columns).map(move |index| {
            let full = band.column_spans(index);
            full.map(|span| span.map(|height| layout.base_mm + f64::from(height))).collect::<Vec<_>>()
        })
    });
    ColumnGap::new(origin, layout.cell_mm, layout.columns, spans.collect())
}
