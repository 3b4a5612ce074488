//! Any bytes as remaining stock: refused, or read and written back as they were.

#![no_main]

use clsmith::stock::stock_file;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    check(bytes);
    // With the checksum that belongs to them, or hardly anything would pass.
    let mut sealed = bytes.to_vec();
    sealed.extend(crc32fast::hash(bytes).to_le_bytes());
    check(&sealed);
});

fn check(bytes: &[u8]) {
    let Ok(dexels) = stock_file::read_clstock(bytes) else { return };
    let mut again = Vec::new();
    stock_file::write_clstock(&dexels, &mut again).expect("memory takes everything");
    assert!(again == bytes, "the bytes changed");
}
