//! This module computes checksums of a file block by block, which show where another file differs.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::de::{self, Deserialize, Deserializer};
use serde::{Serialize, Serializer};
use std::ops::Range;

/// The number of bytes in a block, about 25 lines.
const BLOCK_BYTES: usize = 1024;

/// The CRC-32 of every 1024 bytes of a file. Each has four bytes, and JSON contains them in base64.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BlockChecksums(Vec<u32>);

impl BlockChecksums {
    /// Computes the checksums of bytes that come in chunks. The sizes of the chunks do not matter.
    pub fn from_chunks<'a>(chunks: impl IntoIterator<Item = &'a [u8]>) -> Self {
        let mut found = Vec::new();
        let mut hasher = crc32fast::Hasher::new();
        let mut filled = 0;
        for mut chunk in chunks {
            while !chunk.is_empty() {
                let (now, rest) = chunk.split_at_checked(BLOCK_BYTES - filled).unwrap_or((chunk, &[]));
                hasher.update(now);
                filled += now.len();
                chunk = rest;
                if filled == BLOCK_BYTES {
                    found.push(std::mem::take(&mut hasher).finalize());
                    filled = 0;
                }
            }
        }
        if filled > 0 {
            found.push(hasher.finalize());
        }
        Self(found)
    }

    /// Returns the range of bytes in which another file first differs, as far as the checksums show it. The
    /// range is empty at the end of a file that only continues or ends there.
    pub fn find_first_difference(&self, other: &[u8]) -> Range<usize> {
        let theirs = Self::from_chunks([other]);
        let same = self.0.iter().zip(&theirs.0).take_while(|(ours, theirs)| ours == theirs).count();
        let start = (same * BLOCK_BYTES).min(other.len());
        start..(start + BLOCK_BYTES).min(other.len())
    }
}

impl Serialize for BlockChecksums {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let bytes: Vec<u8> = self.0.iter().flat_map(|sum| sum.to_le_bytes()).collect();
        serializer.serialize_str(&STANDARD.encode(bytes))
    }
}

impl<'de> Deserialize<'de> for BlockChecksums {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let bytes = STANDARD.decode(text).map_err(de::Error::custom)?;
        let (sums, rest) = bytes.as_chunks();
        if !rest.is_empty() {
            return Err(de::Error::custom("a checksum has four bytes"));
        }
        Ok(Self(sums.iter().map(|sum| u32::from_le_bytes(*sum)).collect()))
    }
}
