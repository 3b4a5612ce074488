//! The stock that a setup describes, with its files read.

use crate::diagnostic::{Diagnostic, codes};
use crate::program::LengthUnit;
use crate::setup::{BodyShape, FileRef, Setup};
use crate::sim::{Body, Mesh, MeshError, Stock, remains};
use std::sync::Arc;

/// The stock of a setup.
///
/// # Errors
/// When there is none, or a file of it cannot be used.
pub(super) fn of(setup: &Setup) -> Result<Stock, Vec<Diagnostic>> {
    let described = setup.stock().map_err(|found| vec![*found])?;
    let mut errors = Vec::new();
    let mut bodies = Vec::new();
    for body in &described.bodies {
        match &body.shape {
            BodyShape::Block { low, high } => bodies.push(Body::Block { from: *low, to: *high }),
            BodyShape::Cylinder { diameter, from, to } => {
                bodies.push(Body::Cylinder { diameter: *diameter, from: *from, to: *to });
            }
            BodyShape::Stl { file, units } => match stl(file, *units) {
                Ok(found) => bodies.push(Body::Mesh(Arc::new(found))),
                Err(found) => errors.push(found),
            },
            BodyShape::Saved(file) => match saved(file) {
                Ok(found) => bodies.push(found),
                Err(found) => errors.push(found),
            },
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    Stock::new(bodies, described.allowance_mm).map_err(|error| {
        let place = &described.place;
        let found = Diagnostic::new(codes::STOCK_FILE, format!("the stock cannot be used: {error}"));
        vec![found.label(place.source(), place.span(), "described here")]
    })
}

fn bytes(file: &FileRef) -> Result<Vec<u8>, Diagnostic> {
    std::fs::read(&file.path).map_err(|error| file.stock_fault(&error.to_string()))
}

fn stl(file: &FileRef, units: LengthUnit) -> Result<Mesh, Diagnostic> {
    mesh(&bytes(file)?, units).map_err(|error| file.stock_fault(&error.to_string()))
}

fn saved(file: &FileRef) -> Result<Body, Diagnostic> {
    let dexels = remains::read(&bytes(file)?).map_err(|error| file.stock_fault(&error.to_string()))?;
    Ok(Body::Remains(Arc::new(dexels)))
}

/// A mesh in millimetres.
pub(super) fn mesh(bytes: &[u8], units: LengthUnit) -> Result<Mesh, MeshError> {
    let mesh = Mesh::from_stl(bytes)?;
    if units == LengthUnit::Mm { Ok(mesh) } else { mesh.scaled(units.in_mm()) }
}
