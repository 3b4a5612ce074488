//! This module reads files and streams whole, but never without an end.

use super::SourceTooLarge;
use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;

/// The size of the largest file that clsmith reads, in bytes: places in it are 32-bit numbers.
pub const LARGEST_FILE_BYTES: u64 = u32::MAX as u64 - 1;

/// The number of bytes that clsmith reads from a pipe, which may have no end: more than any CAM system writes.
pub const LARGEST_STREAM_BYTES: u64 = 1 << 30;

/// Reads a whole file, or a pipe that has an end.
///
/// A file that is too large is refused by its size, before it is opened. A pipe has no size: it is read to
/// [`LARGEST_STREAM_BYTES`] and one byte more.
///
/// ```
/// use clsmith::source::read_file_bytes;
/// use std::path::Path;
///
/// assert!(read_file_bytes(Path::new("README.md"))?.starts_with(b"# clsmith"));
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// Returns what the system says, [`io::ErrorKind::FileTooLarge`] for 4 GiB and more,
/// [`io::ErrorKind::OutOfMemory`] if there is no memory for the bytes, and an error for folders and devices.
pub fn read_file_bytes(path: &Path) -> io::Result<Vec<u8>> {
    read_file_or_pipe(path, LARGEST_STREAM_BYTES)
}

/// Reads a whole file, or a pipe that ends within `most` bytes.
///
/// # Errors
/// Returns the errors of [`read_file_bytes`].
pub fn read_file_or_pipe(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    #[cfg(all(target_family = "wasm", target_os = "unknown"))]
    return super::given_files::read_given_file(path, most);
    #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
    read_from_file_system(path, most)
}

#[cfg_attr(all(target_family = "wasm", target_os = "unknown"), expect(dead_code))]
fn read_from_file_system(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // The kind is asked for first, because a device may give bytes for ever.
    let there = fs::metadata(path)?;
    refuse_device(&there)?;
    if !there.is_file() {
        return read_stream_bytes(File::open(path)?, most);
    }
    read_open_file_bytes(&File::open(path)?, there.len())
}

/// Reads a file that is open to its end. `size` is its size in bytes when it was looked at; it may have grown since.
///
/// # Errors
/// Returns [`io::ErrorKind::FileTooLarge`] for 4 GiB and more, [`io::ErrorKind::OutOfMemory`] if there is no memory for
/// the bytes, and what the system says.
pub fn read_open_file_bytes(file: &File, size: u64) -> io::Result<Vec<u8>> {
    let too_large = |bytes| file_too_large(SourceTooLarge::File { bytes });
    if size > LARGEST_FILE_BYTES {
        return Err(too_large(size));
    }
    read_to_limit(file, size, LARGEST_FILE_BYTES, too_large)
}

/// Reads a stream to its end, if that comes within `most` bytes.
///
/// # Errors
/// Returns [`io::ErrorKind::FileTooLarge`] for a longer stream, which is then not read further,
/// [`io::ErrorKind::OutOfMemory`] if there is no memory for the bytes, and what the stream says.
pub fn read_stream_bytes(stream: impl Read, most: u64) -> io::Result<Vec<u8>> {
    read_to_limit(stream, 0, most, |bytes| file_too_large(SourceTooLarge::Stream { bytes }))
}

/// Reads to a limit and one byte more. `expected` is the size in bytes where that is known, else 0.
fn read_to_limit(
    stream: impl Read,
    expected: u64,
    limit: u64,
    too_large: impl FnOnce(u64) -> io::Error,
) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let expected = usize::try_from(expected.min(limit)).unwrap_or_default();
    bytes.try_reserve_exact(expected).map_err(|_| io::Error::from(io::ErrorKind::OutOfMemory))?;
    let read = stream.take(limit + 1).read_to_end(&mut bytes)? as u64;
    if read > limit { Err(too_large(read)) } else { Ok(bytes) }
}

/// Refuses a device: a disk, a terminal, `/dev/zero`.
///
/// # Errors
/// Returns an error for what is no file, no folder and no pipe. A folder is refused by the system when it is read.
pub fn refuse_device(there: &Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kind = there.file_type();
        if kind.is_char_device() || kind.is_block_device() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is a device, no file and no pipe"));
        }
    }
    #[cfg(not(unix))]
    let _ = there;
    Ok(())
}

fn file_too_large(reason: SourceTooLarge) -> io::Error {
    io::Error::new(io::ErrorKind::FileTooLarge, reason)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_is_read_to_its_limit_and_one_byte_more() {
        let mut endless = io::repeat(b'x');
        let refused = read_stream_bytes(&mut endless, 1000).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::FileTooLarge);
        assert!(refused.to_string().contains("no end"), "{refused}");
        let mut counted = io::Cursor::new(vec![b'x'; 3000]);
        assert!(read_stream_bytes(&mut counted, 1000).is_err());
        assert_eq!(counted.position(), 1001);
        assert_eq!(read_stream_bytes(&b"GOTO"[..], 4).unwrap(), b"GOTO");
    }

    #[test]
    fn memory_that_is_not_there_is_an_error() {
        // The expected size of a damaged file system may be anything; what is not there is not taken.
        let too_large = |bytes| file_too_large(SourceTooLarge::File { bytes });
        let refused = read_to_limit(&b""[..], u64::MAX, u64::MAX - 1, too_large).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::OutOfMemory);
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_refused_before_they_are_read() {
        let refused = read_file_bytes(Path::new("/dev/zero")).unwrap_err();
        assert_eq!(refused.to_string(), "it is a device, no file and no pipe");
    }

    #[cfg(unix)]
    #[test]
    fn a_sparse_file_above_4_gib_is_refused_by_its_size() {
        let path = std::env::temp_dir().join(format!("clsmith-large-{}", std::process::id()));
        File::create(&path).unwrap().set_len(5 << 30).unwrap();
        let refused = read_file_bytes(&path).unwrap_err();
        fs::remove_file(&path).unwrap();
        assert_eq!(refused.kind(), io::ErrorKind::FileTooLarge);
        assert!(refused.to_string().contains("5368709120 bytes"), "{refused}");
    }
}
