//! Remaining stock as a surface.

use super::shapes::columns;
use clsmith::stock::{DexelGrid, Dexels, Mesh, stl_export};
use proptest::prelude::*;

fn surface(dexels: &Dexels) -> Vec<u8> {
    let mut bytes = Vec::new();
    stl_export::write_stl(dexels, &mut bytes).unwrap();
    bytes
}

/// Volume and twice the area vector of all triangles, and whether each has the normal that its corners say.
fn measure(bytes: &[u8]) -> (f64, [f64; 3], bool) {
    let mut cursor = std::io::Cursor::new(bytes);
    let (mut volume, mut area, mut agree) = (0.0, [0.0; 3], true);
    for triangle in stl_io::create_stl_reader(&mut cursor).unwrap() {
        let triangle = triangle.unwrap();
        let [a, b, c] = triangle.vertices.map(|vertex| vertex.0.map(f64::from));
        let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
        let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let along: f64 = (0..3).map(|i| cross[i] * f64::from(triangle.normal.0[i])).sum();
        let length = cross.iter().map(|part| part * part).sum::<f64>().sqrt();
        agree &= (along - length).abs() < 1e-9 && length > 0.0;
        (0..3).for_each(|i| area[i] += cross[i]);
        volume += (0..3).map(|i| a[i] * cross[i]).sum::<f64>() / 6.0;
    }
    (volume, area, agree)
}

#[test]
fn a_block_needs_few_triangles() {
    let layout = DexelGrid { origin_mm: [0.5, 0.5], base_mm: 0.0, cell_mm: 1.0, columns: 100, rows: 40 };
    let mut dexels = Dexels::with_empty_columns(layout);
    for index in 0..4000 {
        dexels.set_column(index % 100, index / 100, &[[0.0, 10.0]]);
    }
    let bytes = surface(&dexels);
    // A cap above and below and two ends for each row, two long sides.
    assert_eq!(bytes.len(), 84 + 50 * 2 * (40 * 4 + 2));
    let mesh = Mesh::from_stl(&bytes).unwrap();
    assert_eq!(mesh.bounds(), ([0.0; 3], [100.0, 40.0, 10.0]));
    assert!((mesh.volume_mm3() - 40000.0).abs() < 1e-6);
}

#[test]
fn nothing_left_is_an_empty_file() {
    let layout = DexelGrid { origin_mm: [0.5, 0.5], base_mm: 0.0, cell_mm: 1.0, columns: 3, rows: 2 };
    assert_eq!(surface(&Dexels::with_empty_columns(layout)).len(), 84);
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn the_surface_is_closed_and_holds_the_volume(dexels in columns()) {
        let bytes = surface(&dexels);
        let (volume, area, normals_agree) = measure(&bytes);
        prop_assert!((volume - dexels.volume_mm3()).abs() <= 1e-9 * (1.0 + volume), "{volume}");
        prop_assert!(area.iter().all(|part| part.abs() < 1e-9), "{area:?}");
        prop_assert!(normals_agree);
        if dexels.highest_z_mm().is_some() {
            // Read back as a mesh, it is the same columns.
            let mesh = Mesh::from_stl(&bytes).unwrap();
            prop_assert_eq!(mesh.to_dexels(*dexels.grid()).unwrap(), dexels);
        }
    }
}
