//! This module reads and writes `.clstock` files, which keep the stock that a program left for the next
//! program.
//!
//! All numbers are little-endian. The file has a head of 56 bytes, the columns, and a checksum:
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `\x89CLSTK\r\n`: no text file begins so, and one that was sent as text has lost it |
//! | 4 | version of the format, 1 |
//! | 4 | 0 |
//! | 8 | distance between columns, mm (`f64`, as the next three) |
//! | 8, 8, 8 | x and y of the first column's centre, the height that intervals count from; mm |
//! | 4, 4 | columns in x, columns in y |
//! | per column | row by row: number of intervals (`u32`), then each from above to below (two `f32`) |
//! | 4 | CRC-32 (IEEE) of everything before |
//!
//! The two `f32` of an interval are its lower and its upper end, in mm above the base.
//! A column takes at least 4 bytes. So no file can ask for more memory than twice its own length, apart from
//! the intervals.

use crate::stock::{DexelGrid, DexelSpan, Dexels, NoMemory};
use std::io::{self, Write};

const MAGIC: [u8; 8] = *b"\x89CLSTK\r\n";
const VERSION: u32 = 1;
const CHECKSUM: usize = 4;

/// The reason why bytes are not a `.clstock` file. `at` is the offset in the file.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StockFileError {
    /// The file was not written by this program, or was changed when it was sent as text.
    #[error("this is no .clstock file")]
    Foreign,
    /// The file was written by a later version of this program.
    #[error("version {version} of the format is not known here (byte {at})")]
    Version {
        /// The version that the file states.
        version: u32,
        /// The offset of the version in bytes.
        at: usize,
    },
    /// The file ends too early.
    #[error("the file ends at byte {at}, but {needed} more bytes are needed at least")]
    Truncated {
        /// The length of the file in bytes.
        at: usize,
        /// The least number of bytes that are missing.
        needed: u64,
    },
    /// The file has a number that this format does not allow.
    #[error("the file is damaged at byte {at}: {reason}")]
    Damaged {
        /// The offset of the number in bytes.
        at: usize,
        /// A description of what is wrong.
        reason: &'static str,
    },
    /// There is no memory for the columns.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    /// The checksum does not fit, so something in the file has changed since it was written.
    #[error("the file is damaged: its checksum at byte {at} does not fit")]
    Checksum {
        /// The offset of the checksum in bytes.
        at: usize,
    },
}

/// Writes remaining stock as a `.clstock` file.
///
/// ```
/// use clsmith::stock::stock_file::{read_clstock, write_clstock};
/// use clsmith::stock::{SolidBody, Stock};
///
/// let block = SolidBody::Block { from: [0.0, 0.0, 0.0], to: [10.0, 10.0, 5.0] };
/// let columns = Stock::new(vec![block], 0.0)?.to_dexels(1.0, 1000)?;
/// let mut file = Vec::new();
/// write_clstock(&columns, &mut file)?;
/// assert_eq!(read_clstock(&file)?.volume_mm3(), columns.volume_mm3());
/// file[40] ^= 1;
/// assert!(read_clstock(&file).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the errors of `out`, and an error if a row has more columns than the format can count (2^32).
pub fn write_clstock(dexels: &Dexels, out: &mut dyn Write) -> io::Result<()> {
    let layout = dexels.grid();
    let count = |count: usize| u32::try_from(count).map_err(io::Error::other);
    let mut sum = crc32fast::Hasher::new();
    let mut buffer = Vec::new();
    buffer.extend(MAGIC);
    buffer.extend(VERSION.to_le_bytes());
    buffer.extend([0; 4]);
    for value in [layout.cell_mm].into_iter().chain(layout.origin_mm).chain([layout.base_mm]) {
        buffer.extend(value.to_le_bytes());
    }
    buffer.extend(count(layout.columns)?.to_le_bytes());
    buffer.extend(count(layout.rows)?.to_le_bytes());
    // Band by band, so that the memory does not grow with the stock.
    for band in dexels.bands() {
        for index in 0..band.row_count() * band.columns {
            buffer.extend(count(band.column_spans(index).count())?.to_le_bytes());
            buffer.extend(band.column_spans(index).flatten().flat_map(f32::to_le_bytes));
        }
        sum.update(&buffer);
        out.write_all(&buffer)?;
        buffer.clear();
    }
    // Without bands, the buffer still holds the head.
    sum.update(&buffer);
    out.write_all(&buffer)?;
    out.write_all(&sum.finalize().to_le_bytes())
}

/// Reads a `.clstock` file.
///
/// # Errors
/// Returns an error, with its place, for anything that [`write_clstock()`] does not write. Memory is only
/// allocated for columns that the file's length can hold.
pub fn read_clstock(bytes: &[u8]) -> Result<Dexels, StockFileError> {
    let mut reader = StockFileReader { bytes, at: 0 };
    if !bytes.starts_with(&MAGIC) {
        // A prefix of the magic bytes is our own file cut short; anything else is foreign.
        let start = MAGIC.starts_with(bytes);
        let needed = (MAGIC.len() - bytes.len().min(MAGIC.len())) as u64;
        return Err(if start {
            StockFileError::Truncated { at: bytes.len(), needed }
        } else {
            StockFileError::Foreign
        });
    }
    reader.at = MAGIC.len();
    let at = reader.at;
    let version = reader.read_u32()?;
    if version != VERSION {
        return Err(StockFileError::Version { version, at });
    }
    let at = reader.at;
    if reader.read_u32()? != 0 {
        return Err(StockFileError::Damaged { at, reason: "something stands where nothing should" });
    }
    let layout = reader.read_grid()?;
    let mut dexels = Dexels::try_with_empty_columns(layout)?;
    let mut intervals = Vec::new();
    for row in 0..layout.rows {
        for column in 0..layout.columns {
            reader.read_column(&mut intervals)?;
            if !intervals.is_empty() {
                dexels.set_column(column, row, &intervals);
            }
        }
    }
    let at = reader.at;
    // The checksum is compared last, so that a file that is cut short or from another version says so.
    let sum = reader.read_u32()?;
    if reader.at < bytes.len() {
        return Err(StockFileError::Damaged { at: reader.at, reason: "it goes on after its end" });
    }
    match bytes.get(..at).map(crc32fast::hash) {
        Some(found) if found == sum => Ok(dexels),
        _ => Err(StockFileError::Checksum { at }),
    }
}

/// The bytes of a file, and the offset up to which they are read.
struct StockFileReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl StockFileReader<'_> {
    /// Takes the next N bytes.
    fn take_bytes<const N: usize>(&mut self) -> Result<[u8; N], StockFileError> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let taken = rest.first_chunk::<N>().copied();
        let needed = (N - rest.len().min(N)) as u64;
        let taken = taken.ok_or(StockFileError::Truncated { at: self.bytes.len(), needed })?;
        self.at += N;
        Ok(taken)
    }

    /// Checks that at least this many bytes and the checksum follow.
    fn expect_bytes(&self, count: u64) -> Result<(), StockFileError> {
        let rest = self.bytes.len().saturating_sub(self.at) as u64;
        let needed = count.saturating_add(CHECKSUM as u64).saturating_sub(rest);
        if needed > 0 { Err(StockFileError::Truncated { at: self.bytes.len(), needed }) } else { Ok(()) }
    }

    fn read_u32(&mut self) -> Result<u32, StockFileError> {
        self.take_bytes().map(u32::from_le_bytes)
    }

    fn read_length_mm(&mut self) -> Result<f64, StockFileError> {
        let at = self.at;
        let value = self.take_bytes().map(f64::from_le_bytes)?;
        // Farther out than this, the centres of neighbouring columns would have the same coordinates.
        if value.abs() <= 1e9 {
            Ok(value)
        } else {
            Err(StockFileError::Damaged { at, reason: "this is no length" })
        }
    }

    /// Reads the grid and checks that the file is long enough for its columns.
    fn read_grid(&mut self) -> Result<DexelGrid, StockFileError> {
        let at = self.at;
        let cell = self.read_length_mm()?;
        if cell < 1e-6 {
            return Err(StockFileError::Damaged { at, reason: "columns are no distance apart" });
        }
        let origin = [self.read_length_mm()?, self.read_length_mm()?];
        let base = self.read_length_mm()?;
        let at = self.at;
        let (columns, rows) = (self.read_u32()?, self.read_u32()?);
        if (columns == 0) != (rows == 0) {
            return Err(StockFileError::Damaged { at, reason: "there are rows without columns" });
        }
        self.expect_bytes((u64::from(columns) * u64::from(rows)).saturating_mul(4))?;
        Ok(DexelGrid {
            origin_mm: origin,
            base_mm: base,
            cell_mm: cell,
            columns: columns as usize,
            rows: rows as usize,
        })
    }

    /// Reads the intervals of one column, which must go from above to below without touching.
    fn read_column(&mut self, intervals: &mut Vec<DexelSpan>) -> Result<(), StockFileError> {
        intervals.clear();
        let count = self.read_u32()?;
        self.expect_bytes(u64::from(count) * 8)?;
        let mut above = f32::INFINITY;
        for _ in 0..count {
            let at = self.at;
            let [low, top] =
                [self.take_bytes().map(f32::from_le_bytes)?, self.take_bytes().map(f32::from_le_bytes)?];
            if !(low.is_finite() && low < top && top < above) {
                return Err(StockFileError::Damaged {
                    at,
                    reason: "intervals do not go from above to below",
                });
            }
            intervals.push([low, top]);
            above = low;
        }
        Ok(())
    }
}
