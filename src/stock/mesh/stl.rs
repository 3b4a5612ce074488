//! This module reads STL files, binary and text.

use super::{Mesh, MeshError};
use crate::stock::memory::{self, NoMemory};
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, Cursor};

/// The bytes before the first triangle of a binary file, and the bytes of one triangle.
const HEAD: usize = 84;
const TRIANGLE: u64 = 50;

impl Mesh {
    /// Reads an STL file. Its numbers count as mm, its normals are ignored, and vertices with equal
    /// coordinates become one.
    ///
    /// # Errors
    /// Returns an error if the bytes are not STL, have no triangle or a number that is not finite, or do not
    /// form a closed surface (see [`Mesh::new`]).
    pub fn from_stl(bytes: &[u8]) -> Result<Self, MeshError> {
        let bytes = normalize_stl(bytes)?;
        let unreadable = |error: io::Error| MeshError::Stl { reason: error.to_string() };
        let mut cursor = Cursor::new(bytes.as_ref());
        // A closed surface has about half as many vertices as triangles, and a text takes more bytes a triangle.
        let most = bytes.len() / TRIANGLE as usize;
        let mut vertices = memory::reserve_values(most / 2, "the vertices of a mesh")?;
        let mut triangles = memory::reserve_values(most, "the triangles of a mesh")?;
        let mut known: HashMap<[u32; 3], u32> = HashMap::new();
        let no_table = |_| NoMemory { what: "the vertices of a mesh", bytes: most as u64 * 16 };
        known.try_reserve(most / 2).map_err(no_table)?;
        for triangle in stl_io::create_stl_reader(&mut cursor).map_err(unreadable)? {
            let mut corners = [0; 3];
            for (corner, vertex) in corners.iter_mut().zip(triangle.map_err(unreadable)?.vertices) {
                let next = u32::try_from(vertices.len())
                    .map_err(|_| MeshError::Stl { reason: "too many vertices".to_owned() })?;
                // Minus zero is the same place as zero.
                let place = vertex.0.map(|value| value + 0.0);
                *corner = *known.entry(place.map(f32::to_bits)).or_insert(next);
                if *corner == next {
                    vertices.push(place.map(f64::from));
                }
            }
            triangles.push(corners);
        }
        Self::new(vertices, triangles)
    }
}

/// Returns the file in a form that the reader recognizes correctly. The reader tells text from binary by a
/// first line that begins with `solid` and a blank, but many programs write such a head into binary files as
/// well, and some write text without a name or with several solids.
fn normalize_stl(bytes: &[u8]) -> Result<Cow<'_, [u8]>, MeshError> {
    let count = bytes.get(HEAD - 4..HEAD).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    let found = bytes.len() as u64;
    let expected = count.map(|count| HEAD as u64 + TRIANGLE * u64::from(count));
    let text = has_first_word(bytes, b"solid");
    // The length decides: a file that is exactly as long as its own number of triangles asks for is binary.
    if expected == Some(found) {
        if !text {
            return Ok(Cow::Borrowed(bytes));
        }
        let mut blank = bytes.to_vec();
        blank.iter_mut().take(HEAD - 4).for_each(|byte| *byte = 0);
        return Ok(Cow::Owned(blank));
    }
    match count.zip(expected) {
        _ if text => merge_solids(bytes).map(Cow::Owned),
        Some((triangles, expected)) => Err(MeshError::Length { triangles, expected, found }),
        None => Err(MeshError::Stl { reason: format!("{found} bytes are too few") }),
    }
}

/// Joins all solids of a text into one, in lower case.
fn merge_solids(bytes: &[u8]) -> Result<Vec<u8>, MeshError> {
    let mut all = b"solid part\n".to_vec();
    let mut within = false;
    for line in bytes.split(|byte| *byte == b'\n') {
        let (begin, end) = (has_first_word(line, b"solid"), has_first_word(line, b"endsolid"));
        if (begin && within) || (end && !within) {
            return Err(MeshError::Stl { reason: "a solid begins before the last one ends".to_owned() });
        }
        if begin || end {
            within = begin;
            continue;
        }
        all.extend(line.to_ascii_lowercase());
        all.push(b'\n');
    }
    if within {
        return Err(MeshError::Stl { reason: "the text ends before its last solid does".to_owned() });
    }
    all.extend(b"endsolid\n");
    Ok(all)
}

/// Returns whether a line's first word begins with `word`, in upper or lower case.
fn has_first_word(line: &[u8], word: &[u8]) -> bool {
    line.trim_ascii_start().get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
}
