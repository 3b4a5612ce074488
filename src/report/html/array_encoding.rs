//! This module encodes the arrays of the page: numbers as little-endian bytes, grouped by significance,
//! deflated, in base64.
//!
//! Bytes of the same significance are stored together, because those of neighbouring numbers are similar. Row
//! numbers are stored as differences for the same reason. `page/data.js` decodes them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::{self, Write};

/// An array of the page.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum PageArray {
    /// Measured numbers. NaN means that the number is not known.
    F32(Vec<f32>),
    /// Ascending numbers, which are stored as their differences.
    Growing(Vec<u32>),
    /// Small indices.
    U16(Vec<u16>),
    /// Bytes.
    U8(Vec<u8>),
}

impl PageArray {
    fn kind_name(&self) -> &'static str {
        match self {
            Self::F32(_) => "f32",
            Self::Growing(_) => "growing",
            Self::U16(_) => "u16",
            Self::U8(_) => "u8",
        }
    }

    fn byte_planes(&self) -> Vec<u8> {
        match self {
            Self::F32(values) => split_byte_planes(values.iter().map(|value| value.to_le_bytes())),
            Self::Growing(values) => {
                let before = std::iter::once(0).chain(values.iter().copied());
                split_byte_planes(
                    // `NONE` is the largest number, so a difference can be negative. It wraps here, and wraps
                    // back when the page adds it up in 32 bits.
                    values.iter().zip(before).map(|(value, before)| value.wrapping_sub(before).to_le_bytes()),
                )
            }
            Self::U16(values) => split_byte_planes(values.iter().map(|value| value.to_le_bytes())),
            Self::U8(values) => values.clone(),
        }
    }

    /// Returns the array as an element of the page. The browser does not execute scripts of an unknown type.
    pub(super) fn to_element(&self, name: &str) -> io::Result<String> {
        let mut deflated = DeflateEncoder::new(Vec::new(), Compression::new(6));
        deflated.write_all(&self.byte_planes())?;
        let text = STANDARD.encode(deflated.finish()?);
        Ok(format!(
            "<script type=\"text/plain\" data-array=\"{name}\" data-kind=\"{}\">{text}</script>\n",
            self.kind_name()
        ))
    }
}

/// Returns the first bytes of all numbers, then all second bytes, and so on.
fn split_byte_planes<const N: usize>(numbers: impl Iterator<Item = [u8; N]> + Clone) -> Vec<u8> {
    (0..N).flat_map(|plane| numbers.clone().filter_map(move |bytes| bytes.get(plane).copied())).collect()
}
