//! This module holds the bytes of a file and places in them.
//!
//! All other modules give places as a [`Span`] of bytes; only people see lines and columns.

mod bounded_read;
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
mod given_files;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
pub use given_files::give_file;

pub use bounded_read::{
    LARGEST_FILE_BYTES, LARGEST_STREAM_BYTES, read_file_bytes, read_file_or_pipe, read_open_file_bytes,
    read_stream_bytes, refuse_device,
};

use std::fmt;
use std::sync::{Arc, OnceLock};

/// A half-open range of bytes in a [`Source`].
///
/// 32 bits are enough because [`Source::new`] refuses files of 4 GiB and more. They make a statement 8 bytes
/// smaller.
///
/// ```
/// use clsmith::source::{Source, Span};
///
/// let source = Source::new("part.cls", b"FEDRAT/MMPM,1200.0\n".to_vec())?;
/// let fields = Span::new(7, 18);
/// assert_eq!(source.slice(fields), b"MMPM,1200.0");
/// assert_eq!(source.slice(fields.sub_span(5, 11)), b"1200.0");
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, PartialOrd, Ord)]
pub struct Span {
    /// The offset of the first byte.
    pub start: u32,
    /// The offset behind the last byte.
    pub end: u32,
}

impl Span {
    /// Makes the span of the bytes `start..end`. Offsets come from a [`Source`], so they fit in 32 bits.
    pub fn new(start: usize, end: usize) -> Self {
        Self { start: start as u32, end: end.max(start) as u32 }
    }

    /// Returns the number of bytes.
    pub fn len(self) -> usize {
        (self.end - self.start) as usize
    }

    /// Returns whether the span has no byte.
    pub fn is_empty(self) -> bool {
        self.start == self.end
    }

    /// Returns the span as a range of `usize`.
    pub fn to_range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Returns a span inside this one, given by offsets from its start.
    pub fn sub_span(self, from: usize, to: usize) -> Self {
        let start = self.start as usize;
        Self::new(start + from, (start + to).min(self.end as usize))
    }
}

impl fmt::Debug for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.start, self.end)
    }
}

/// A file that was read: its name and its bytes, which never change.
///
/// ```
/// use clsmith::source::Source;
///
/// let source = Source::new("part.cls", b"RAPID\nGOTO/1,2,3\n".to_vec())?;
/// assert_eq!(source.line_column(11), (2, 6));
/// let line = source.line_span(2).expect("there are two lines");
/// assert_eq!(source.slice(line), b"GOTO/1,2,3");
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
pub struct Source {
    name: String,
    bytes: Vec<u8>,
    line_starts: OnceLock<Vec<u32>>,
}

/// The bytes are more than clsmith reads.
#[derive(Debug, Clone, Copy, thiserror::Error)]
#[non_exhaustive]
pub enum SourceTooLarge {
    /// A file is too large for 32-bit spans.
    #[error("the file has {bytes} bytes; clsmith reads files below 4 GiB")]
    File {
        /// The size of the refused file.
        bytes: u64,
    },
    /// A pipe has not ended where reading must stop.
    #[error("it has given {bytes} bytes and no end; no more is read from a pipe")]
    Stream {
        /// The number of bytes that were read.
        bytes: u64,
    },
}

/// A file cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum SourceReadError {
    /// The system gives no bytes.
    #[error("{name} cannot be read: {error}")]
    Unreadable {
        /// The name of the file.
        name: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// The file is too large.
    #[error(transparent)]
    TooLarge(#[from] SourceTooLarge),
}

impl Source {
    /// Takes the bytes of a file; `name` is its name in diagnostics.
    ///
    /// # Errors
    /// Returns [`SourceTooLarge`] for 4 GiB and more.
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> Result<Arc<Self>, SourceTooLarge> {
        if bytes.len() >= u32::MAX as usize {
            return Err(SourceTooLarge::File { bytes: bytes.len() as u64 });
        }
        Ok(Arc::new(Self { name: name.into(), bytes, line_starts: OnceLock::new() }))
    }

    /// Returns the name of the file in diagnostics.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns all bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Gives the bytes back.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Returns the bytes of a span, or no bytes if the span is not in this file.
    pub fn slice(&self, span: Span) -> &[u8] {
        self.bytes.get(span.to_range()).unwrap_or_default()
    }

    /// Returns the line and the column (in bytes) of an offset, both counted from 1. Lines end at LF, CRLF or
    /// a lone CR.
    pub fn line_column(&self, offset: u32) -> (usize, usize) {
        let starts = self.line_starts.get_or_init(|| find_line_starts(&self.bytes));
        let line = starts.partition_point(|&start| start <= offset).max(1);
        let start = starts.get(line - 1).copied().unwrap_or(0);
        (line, (offset - start) as usize + 1)
    }

    /// Returns the span of a line, counted from 1, without its line end. Returns `None` past the last line.
    pub fn line_span(&self, line: usize) -> Option<Span> {
        let starts = self.line_starts.get_or_init(|| find_line_starts(&self.bytes));
        let start = *starts.get(line.checked_sub(1)?)? as usize;
        let end = starts.get(line).map_or(self.bytes.len(), |&next| next as usize);
        let text = self.bytes.get(start..end)?;
        let kept = text.iter().rposition(|b| !matches!(b, b'\n' | b'\r')).map_or(0, |last| last + 1);
        Some(Span::new(start, start + kept))
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Source({:?}, {} bytes)", self.name, self.bytes.len())
    }
}

/// Returns the offsets at which lines start.
fn find_line_starts(bytes: &[u8]) -> Vec<u32> {
    let mut starts = vec![0];
    for at in memchr::memchr2_iter(b'\n', b'\r', bytes) {
        let crlf = bytes.get(at) == Some(&b'\r') && bytes.get(at + 1) == Some(&b'\n');
        if !crlf {
            starts.push(at as u32 + 1);
        }
    }
    starts
}
