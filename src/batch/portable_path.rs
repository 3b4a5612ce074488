//! This module holds the names of files, whatever their encoding.

use serde::de::{self, Deserialize, Deserializer};
use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::path::Path;

/// A path as journals and results contain it. No byte is lost, and it is the same on every machine.
///
/// In JSON, a name in UTF-8 is a string. Any other name is `{ "lossy": "part�.cls", "hex":
/// "70617274ff2e636c73" }`: the text for people, and the bytes of the name (WTF-8 on Windows). Folders are
/// separated by `/`. Names are ordered by their bytes.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PortablePath(Vec<u8>);

impl PortablePath {
    /// Makes the name of a path.
    pub fn from_path(path: &Path) -> Self {
        let mut bytes = path.as_os_str().as_encoded_bytes().to_vec();
        if std::path::MAIN_SEPARATOR == '\\' {
            bytes.iter_mut().filter(|byte| **byte == b'\\').for_each(|byte| *byte = b'/');
        }
        Self(bytes)
    }

    /// Returns the bytes of the name.
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }

    /// Returns the name with upper and lower case made equal, because on some disks `A.cls` and `a.cls` are
    /// the same file. Names that are not UTF-8 stay.
    pub(crate) fn fold_case(&self) -> Vec<u8> {
        match std::str::from_utf8(&self.0) {
            Ok(text) => text.to_lowercase().into_bytes(),
            Err(_) => self.0.clone(),
        }
    }
}

impl fmt::Display for PortablePath {
    /// Writes the name for people, on one line whatever it contains.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A name must not be able to send control characters to the terminal.
        f.write_str(&String::from_utf8_lossy(&self.0).replace(char::is_control, "?"))
    }
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(untagged)]
enum PortablePathText<'a> {
    Text(Cow<'a, str>),
    Bytes { lossy: Cow<'a, str>, hex: String },
}

impl Serialize for PortablePath {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let written = match std::str::from_utf8(&self.0) {
            Ok(text) => PortablePathText::Text(text.into()),
            Err(_) => PortablePathText::Bytes {
                lossy: String::from_utf8_lossy(&self.0),
                hex: self.0.iter().map(|byte| format!("{byte:02x}")).collect(),
            },
        };
        written.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for PortablePath {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match PortablePathText::deserialize(deserializer)? {
            PortablePathText::Text(text) => Ok(Self(text.into_owned().into_bytes())),
            PortablePathText::Bytes { hex, .. } => {
                decode_hex(&hex).map(Self).ok_or_else(|| de::Error::custom("`hex` is no list of bytes"))
            }
        }
    }
}

fn decode_hex(text: &str) -> Option<Vec<u8>> {
    let digits: Option<Vec<u32>> = text.chars().map(|digit| digit.to_digit(16)).collect();
    let digits = digits.filter(|digits| digits.len().is_multiple_of(2))?;
    digits
        .chunks_exact(2)
        .map(|pair| u8::try_from(pair.iter().fold(0, |value, digit| value * 16 + digit)).ok())
        .collect()
}
