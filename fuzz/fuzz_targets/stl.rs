//! Any bytes as an STL file: refused, or a closed mesh, whose columns stay inside its box and have a closed surface again.

#![no_main]

use clsmith::stock::{Mesh, SolidBody, Stock, stl_export};
use libfuzzer_sys::fuzz_target;
use std::sync::Arc;

fuzz_target!(|bytes: &[u8]| {
    let Ok(mesh) = Mesh::from_stl(bytes) else { return };
    let (from, to) = mesh.bounds();
    let longest = (0..2).map(|axis| to[axis] - from[axis]).fold(0.0, f64::max);
    let Ok(stock) = Stock::new(vec![SolidBody::Mesh(Arc::new(mesh))], 0.0) else { return };
    let Ok(dexels) = stock.to_dexels(longest / 16.0, 1000) else { return };
    if let Some(highest) = dexels.highest_z_mm() {
        let height = to[2] - from[2];
        assert!(highest <= to[2] + 1e-5 * height, "material above the mesh");
        let mut surface = Vec::new();
        stl_export::write_stl(&dexels, &mut surface).expect("memory takes everything");
        // Far from the origin, f32 may leave nothing of a small body.
        if height.min(longest) > 1e-3 * from.iter().chain(&to).fold(0.0, |most: f64, at| most.max(at.abs())) {
            Mesh::from_stl(&surface).expect("a closed surface");
        }
    }
});
