//! The file that keeps remaining stock.

use super::shapes::columns;
use clsmith::stock::{DexelGrid, Dexels, StockFileError, stock_file};
use proptest::prelude::*;

fn bytes(dexels: &Dexels) -> Vec<u8> {
    let mut bytes = Vec::new();
    stock_file::write_clstock(dexels, &mut bytes).unwrap();
    bytes
}

fn example() -> Dexels {
    let layout = DexelGrid { origin_mm: [1.0, 2.0], base_mm: -3.0, cell_mm: 0.5, columns: 2, rows: 1 };
    let mut dexels = Dexels::with_empty_columns(layout);
    dexels.set_column(1, 0, &[[4.0, 5.0], [1.0, 2.5]]);
    dexels
}

#[test]
fn the_format_stays() {
    let expected = [
        b"\x89CLSTK\r\n".as_slice(),
        &[1, 0, 0, 0, 0, 0, 0, 0],
        &0.5f64.to_le_bytes(),
        &1.0f64.to_le_bytes(),
        &2.0f64.to_le_bytes(),
        &(-3.0f64).to_le_bytes(),
        &[2, 0, 0, 0, 1, 0, 0, 0],
        &[0, 0, 0, 0, 2, 0, 0, 0],
        &[4.0f32, 5.0, 1.0, 2.5].map(f32::to_le_bytes).concat(),
    ]
    .concat();
    let found = bytes(&example());
    assert_eq!(found[..found.len() - 4], expected);
    // The sum as zlib makes it.
    assert_eq!(found[found.len() - 4..], 0xCBB7_B97Fu32.to_le_bytes());
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let good = bytes(&example());
    let with = |at: usize, value: &[u8]| {
        let mut bytes = good.clone();
        bytes[at..at + value.len()].copy_from_slice(value);
        stock_file::read_clstock(&bytes).unwrap_err()
    };
    assert_eq!(stock_file::read_clstock(b"solid cube\n"), Err(StockFileError::Foreign));
    assert_eq!(stock_file::read_clstock(b""), Err(StockFileError::Truncated { at: 0, needed: 8 }));
    assert_eq!(with(8, &[2]), StockFileError::Version { version: 2, at: 8 });
    assert!(matches!(with(13, &[2]), StockFileError::Damaged { at: 12, .. }));
    assert!(matches!(with(16, &f64::NAN.to_le_bytes()), StockFileError::Damaged { at: 16, .. }));
    assert!(matches!(with(16, &(-1.0f64).to_le_bytes()), StockFileError::Damaged { at: 16, .. }));
    assert!(matches!(with(48, &[0]), StockFileError::Damaged { at: 48, .. }), "rows without columns");
    assert!(matches!(with(64, &9.0f32.to_le_bytes()), StockFileError::Damaged { at: 64, .. }), "upside down");
    assert_eq!(with(64, &4.5f32.to_le_bytes()), StockFileError::Checksum { at: good.len() - 4 });
    let longer = [good.as_slice(), &[0]].concat();
    assert!(matches!(stock_file::read_clstock(&longer), Err(StockFileError::Damaged { .. })));
}

#[test]
fn absurd_sizes_are_refused_before_memory_is_asked_for() {
    let mut huge = bytes(&example());
    huge[48..56].fill(0xff);
    let needed = (u64::from(u32::MAX) * u64::from(u32::MAX)).saturating_mul(4);
    let Err(StockFileError::Truncated { at, needed: found }) = stock_file::read_clstock(&huge) else {
        panic!()
    };
    assert_eq!(at, huge.len());
    assert!(found > needed / 2);
    let mut deep = bytes(&example());
    deep[56..60].fill(0xff);
    assert!(matches!(stock_file::read_clstock(&deep), Err(StockFileError::Truncated { .. })));
}

#[test]
fn every_cut_and_every_flipped_bit_is_noticed() {
    let good = bytes(&example());
    for end in 0..good.len() {
        let Err(StockFileError::Truncated { at, .. }) = stock_file::read_clstock(&good[..end]) else {
            panic!("{end}")
        };
        assert_eq!(at, end);
    }
    for bit in 0..good.len() * 8 {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(stock_file::read_clstock(&bytes).is_err(), "bit {bit}");
    }
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn written_and_read_it_is_the_same(dexels in columns()) {
        prop_assert_eq!(stock_file::read_clstock(&bytes(&dexels)), Ok(dexels));
    }

    #[test]
    fn any_bytes_are_read_or_refused(tail in proptest::collection::vec(any::<u8>(), 0..200)) {
        let _ = stock_file::read_clstock(&[b"\x89CLSTK\r\n\x01\0\0\0\0\0\0\0".as_slice(), &tail].concat());
    }
}
