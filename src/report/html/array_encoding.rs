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
pub enum PageArray {
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

    /// Returns the array as an element of the page. Browsers read a template's text three times as fast as that of a script
    /// that is none, and show neither. `base` is the name of an array of numbers like these and the array: where most numbers
    /// are the same in both, the bits that differ are stored.
    pub(super) fn to_element(&self, name: &str, base: Option<(&str, &Self)>) -> io::Result<String> {
        let changed = base.and_then(|(base, array)| Some((base, self.changed_bits(array)?)));
        let (over, planes) = match changed {
            Some((base, bits)) => (format!(" data-over=\"{base}\""), bits),
            None => (String::new(), self.byte_planes()),
        };
        let mut deflated = DeflateEncoder::new(Vec::new(), Compression::new(6));
        deflated.write_all(&planes)?;
        let text = STANDARD.encode(deflated.finish()?);
        Ok(format!(
            "<template data-array=\"{name}\" data-kind=\"{}\"{over}>{text}</template>\n",
            self.kind_name()
        ))
    }

    /// Returns the planes of the bits in which measured numbers differ from others, if most of them do not differ.
    fn changed_bits(&self, base: &Self) -> Option<Vec<u8>> {
        let (Self::F32(values), Self::F32(others)) = (self, base) else { return None };
        let bits = || values.iter().zip(others).map(|(value, other)| value.to_bits() ^ other.to_bits());
        let same = bits().filter(|bits| *bits == 0).count();
        (values.len() == others.len() && 2 * same > values.len())
            .then(|| split_byte_planes(bits().map(u32::to_le_bytes)))
    }
}

/// Returns the first bytes of all numbers, then all second bytes, and so on.
fn split_byte_planes<const N: usize>(numbers: impl Iterator<Item = [u8; N]> + Clone) -> Vec<u8> {
    (0..N).flat_map(|plane| numbers.clone().filter_map(move |bytes| bytes.get(plane).copied())).collect()
}
