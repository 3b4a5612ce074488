//! An output appears whole or not at all.

mod same;
mod statement_ids;
#[cfg(unix)]
mod unix;
mod values;
mod windows;

use clsmith::output_files::{Interrupt, WriteError, write_atomically, write_atomically_unless};
use std::fs;
use std::io;
use std::path::Path;

/// The names in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn write(path: &Path, text: &str) -> io::Result<()> {
    write_atomically(path, |out| out.write_all(text.as_bytes()))
}

#[test]
fn a_new_file_and_one_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    write(&path, "one").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"one");
    write(&path, "").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"");
    assert_eq!(names(folder.path()), ["part.cls"]);
}

#[test]
fn the_old_file_is_whole_until_the_new_one_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    write(&path, "old").unwrap();
    write_atomically(&path, |out| {
        out.write_all(&vec![b'x'; 3_000_000])?;
        assert_eq!(fs::read(&path).unwrap(), b"old");
        Ok(())
    })
    .unwrap();
    assert_eq!(fs::read(&path).unwrap().len(), 3_000_000);
}

#[test]
fn an_error_half_way_leaves_everything_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    let fail = |path: &Path| {
        write_atomically(path, |out| {
            out.write_all(&vec![b'x'; 3_000_000])?;
            Err(io::Error::new(io::ErrorKind::StorageFull, "the disk is full"))
        })
    };
    assert_eq!(fail(&path).unwrap_err().kind(), io::ErrorKind::StorageFull);
    assert_eq!(names(folder.path()), [""; 0]);
    write(&path, "old").unwrap();
    assert_eq!(fail(&path).unwrap_err().to_string(), "the disk is full");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["part.cls"]);
}

#[test]
fn a_panic_half_way_leaves_no_temporary_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    let outcome = std::panic::catch_unwind(|| write_atomically(&path, |_| panic!("a bug in a writer")));
    assert!(outcome.is_err());
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn an_interrupt_stops_between_chunks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    write(&path, "old").unwrap();
    let interrupt = Interrupt::new();
    let mut chunks = 0;
    let error = write_atomically_unless(&path, &interrupt, |out| {
        loop {
            out.write_all(&[b'x'; 100_000])?;
            chunks += 1;
            if chunks == 10 {
                interrupt.clone().raise();
            }
            assert!(chunks < 1000, "the writer must stop soon");
        }
    })
    .unwrap_err();
    assert!(matches!(error, WriteError::Interrupted), "{error:?}");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["part.cls"]);
}

#[test]
fn an_interrupt_after_the_last_byte_still_counts() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    let interrupt = Interrupt::new();
    let error = write_atomically_unless(&path, &interrupt, |out| {
        out.write_all(b"short")?;
        interrupt.raise();
        Ok(())
    })
    .unwrap_err();
    assert!(matches!(error, WriteError::Interrupted), "{error:?}");
    assert!(matches!(WriteError::from(io::Error::other("else")), WriteError::Io(_)));
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn no_folder_to_write_to() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    assert!(write(&file.join("part.cls"), "text").is_err());
    assert!(write(&folder.path().join("missing/part.cls"), "text").is_err());
    assert!(write(folder.path(), "text").is_err());
    assert_eq!(names(folder.path()), ["file"]);
}

#[test]
fn a_write_protected_file_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    write(&path, "released").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    assert_eq!(write(&path, "new").unwrap_err().kind(), io::ErrorKind::PermissionDenied);
    assert_eq!(fs::read(&path).unwrap(), b"released");
}

#[test]
fn left_overs_of_killed_runs_go_and_files_being_written_stay() {
    use clsmith::output_files::TemporaryFiles;
    use std::time::{Duration, SystemTime};
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let hour_ago = SystemTime::now() - Duration::from_secs(3600);
    for name in [".clsmith-killed.tmp", ".clsmith-held.tmp", ".clsmith-young.tmp", "part.cls", ".other.tmp"] {
        let file = fs::File::create(path(name)).unwrap();
        if name != ".clsmith-young.tmp" {
            file.set_modified(hour_ago).unwrap();
        }
    }
    // As the process that writes it holds it.
    let held = fs::File::open(path(".clsmith-held.tmp")).unwrap();
    held.lock().unwrap();
    assert_eq!(TemporaryFiles::default().remove_leftovers(folder.path()), 1);
    assert_eq!(names(folder.path()), [".clsmith-held.tmp", ".clsmith-young.tmp", ".other.tmp", "part.cls"]);
}

#[test]
fn a_file_being_written_is_locked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    write_atomically(&path, |out| {
        out.write_all(b"new")?;
        let temporary = folder.path().join(&names(folder.path())[0]);
        assert!(fs::File::open(temporary)?.try_lock().is_err());
        Ok(())
    })
    .unwrap();
}
