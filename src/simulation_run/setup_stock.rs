//! This module builds the stock that a setup describes and reads its files.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::LengthUnit;
use crate::setup::{BilletAllowances, BilletShape, FileRef, Setup, StockBodyShape};
use crate::source::read_file_bytes;
use crate::stock::{Mesh, MeshError, NoMemory, SolidBody, Stock, StockFileError, stock_file};
use std::sync::Arc;

/// Builds the stock of a setup.
///
/// # Errors
/// Returns a finding if the setup describes no stock or a file of it cannot be used.
pub(super) fn build_stock(setup: &Setup) -> Result<Stock, Failure> {
    let described = setup.require_stock()?;
    // All files are read before an error is returned, so that the user sees every fault at once.
    let mut errors = Vec::new();
    let mut bodies = Vec::new();
    for body in &described.bodies {
        match &body.shape {
            StockBodyShape::Block { low, high } => bodies.push(SolidBody::Block { from: *low, to: *high }),
            StockBodyShape::Cylinder { diameter, from, to } => {
                bodies.push(SolidBody::Cylinder { diameter: *diameter, from: *from, to: *to });
            }
            StockBodyShape::Stl { file, units } => match read_stl_mesh(file, *units) {
                Ok(found) => bodies.push(SolidBody::Mesh(Arc::new(found))),
                Err(found) => errors.push(found),
            },
            StockBodyShape::Around { file, units, allowances, shape } => match read_stl_mesh(file, *units) {
                Ok(model) => bodies.push(build_billet(&model, *allowances, *shape)),
                Err(found) => errors.push(found),
            },
            StockBodyShape::Saved(file) => match read_saved_stock(file) {
                Ok(found) => bodies.push(found),
                Err(found) => errors.push(found),
            },
        }
    }
    if !errors.is_empty() {
        return Err(errors.into());
    }
    let stock = Stock::new(bodies, described.allowance_mm).map_err(|error| {
        let place = &described.place;
        let found = Diagnostic::new(codes::STOCK_FILE, format!("the stock cannot be used: {error}"));
        found.with_label(place.source(), place.value_span(), "described here")
    })?;
    Ok(stock)
}

/// Builds a billet around a model. A cylinder stands around the middle of the model's box and is as wide as the vertex
/// needs that is farthest from there.
fn build_billet(model: &Mesh, allowances: BilletAllowances, shape: BilletShape) -> SolidBody {
    let BilletAllowances { sides_mm, top_mm, bottom_mm } = allowances;
    let ([x0, y0, z0], [x1, y1, z1]) = model.bounds();
    let (bottom, top) = (z0 - bottom_mm, z1 + top_mm);
    match shape {
        BilletShape::Cylinder => {
            let [x, y] = [f64::midpoint(x0, x1), f64::midpoint(y0, y1)];
            let vertices = model.triangle_vertices().flatten();
            let radius = vertices.map(|[u, v, _]| (u - x).hypot(v - y)).fold(0.0, f64::max) + sides_mm;
            SolidBody::Cylinder { diameter: 2.0 * radius, from: [x, y, bottom], to: [x, y, top] }
        }
        BilletShape::Block => SolidBody::Block {
            from: [x0 - sides_mm, y0 - sides_mm, bottom],
            to: [x1 + sides_mm, y1 + sides_mm, top],
        },
    }
}

fn read_stock_file(file: &FileRef) -> Result<Vec<u8>, Diagnostic> {
    read_file_bytes(&file.path).map_err(|error| file.make_stock_finding(&error.to_string()))
}

fn read_stl_mesh(file: &FileRef, units: LengthUnit) -> Result<Mesh, Diagnostic> {
    read_mesh_mm(&read_stock_file(file)?, units).map_err(|error| match error {
        MeshError::NoMemory(error) => report_no_memory(file, error),
        error => file.make_stock_finding(&error.to_string()),
    })
}

fn read_saved_stock(file: &FileRef) -> Result<SolidBody, Diagnostic> {
    let dexels = stock_file::read_clstock(&read_stock_file(file)?).map_err(|error| match error {
        StockFileError::NoMemory(error) => report_no_memory(file, error),
        error => file.make_stock_finding(&error.to_string()),
    })?;
    Ok(SolidBody::Remains(Arc::new(dexels)))
}

/// Reports a file of the stock for which there is no memory.
fn report_no_memory(file: &FileRef, error: NoMemory) -> Diagnostic {
    file.make_finding(codes::MEMORY_LIMIT, format!("the stock file `{}`: {error}", file.written))
}

/// Reads a mesh from STL and converts it to mm.
pub(super) fn read_mesh_mm(bytes: &[u8], units: LengthUnit) -> Result<Mesh, MeshError> {
    let mesh = Mesh::from_stl(bytes)?;
    if units == LengthUnit::Mm { Ok(mesh) } else { mesh.scaled(units.mm_per_unit()) }
}
