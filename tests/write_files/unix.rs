//! Links, permissions and things that are no files.

use super::{names, write};
use clsmith::output_files::{Interrupt, OutputAccess, TemporaryFiles};
use std::fs::{self, Permissions};
use std::io::Read;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o7777
}

#[test]
fn a_symbolic_link_stays_and_its_file_changes() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("real")).unwrap();
    fs::write(path("real/part.cls"), "old").unwrap();
    symlink("real/part.cls", path("one")).unwrap();
    symlink(path("one"), path("two")).unwrap();
    write(&path("two"), "new").unwrap();
    assert_eq!(fs::read(path("real/part.cls")).unwrap(), b"new");
    assert!(fs::symlink_metadata(path("one")).unwrap().is_symlink());
    assert!(fs::symlink_metadata(path("two")).unwrap().is_symlink());
    assert_eq!(names(&path("real")), ["part.cls"]);
}

#[test]
fn who_may_not_read_the_input_may_not_read_the_output() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let made_of = |input: u32| {
        fs::write(path("in"), "secret").unwrap();
        fs::set_permissions(path("in"), Permissions::from_mode(input)).unwrap();
        let access = OutputAccess::of_inputs([path("in").as_path()]);
        let files = TemporaryFiles::default().with_access(access);
        files.write_file(&path("out"), &Interrupt::new(), |out| out.write_all(b"new")).unwrap();
        let made = mode(&path("out"));
        fs::remove_file(path("in")).unwrap();
        fs::remove_file(path("out")).unwrap();
        made
    };
    // An input that all may read leaves the permissions to the user's umask.
    let usual = made_of(0o644);
    assert_eq!(made_of(0o444), usual);
    assert_eq!(made_of(0o600), usual & 0o600);
    assert_eq!(made_of(0o400), usual & 0o600);
    assert_eq!(made_of(0o640), usual & 0o660);
}

#[test]
fn a_dangling_link_creates_the_file_it_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    symlink("part.cls", path("link")).unwrap();
    write(&path("link"), "new").unwrap();
    assert_eq!(fs::read(path("part.cls")).unwrap(), b"new");
    assert!(fs::symlink_metadata(path("link")).unwrap().is_symlink());
}

#[test]
fn links_in_a_circle_are_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    symlink("b", path("a")).unwrap();
    symlink("a", path("b")).unwrap();
    assert!(write(&path("a"), "new").is_err());
    assert_eq!(names(folder.path()), ["a", "b"]);
}

#[test]
fn another_name_of_a_hard_link_keeps_the_old_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("part.cls"), "old").unwrap();
    fs::hard_link(path("part.cls"), path("backup.cls")).unwrap();
    write(&path("part.cls"), "new").unwrap();
    assert_eq!(fs::read(path("part.cls")).unwrap(), b"new");
    assert_eq!(fs::read(path("backup.cls")).unwrap(), b"old");
}

#[test]
fn permissions_are_kept_or_those_of_any_new_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("usual"), "").unwrap();
    write(&path("new"), "text").unwrap();
    assert_eq!(mode(&path("new")), mode(&path("usual")));
    fs::set_permissions(path("new"), Permissions::from_mode(0o764)).unwrap();
    write(&path("new"), "other").unwrap();
    assert_eq!(mode(&path("new")), 0o764);
}

#[test]
fn a_device_is_written_not_replaced() {
    write(Path::new("/dev/null"), "text").unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

#[test]
fn a_pipe_is_written_not_replaced() {
    let (mut reader, writer) = std::io::pipe().unwrap();
    let path = format!("/dev/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&writer));
    let Some(path) = crate::support::require_path(&path) else { return };
    write(&path, "text").unwrap();
    drop(writer);
    let mut text = String::new();
    reader.read_to_string(&mut text).unwrap();
    assert_eq!(text, "text");
}

#[test]
fn a_secret_file_is_secret_from_the_first_byte() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    fs::write(&path, "old").unwrap();
    fs::set_permissions(&path, Permissions::from_mode(0o600)).unwrap();
    clsmith::output_files::write_atomically(&path, |out| {
        out.write_all(b"new")?;
        let modes: Vec<u32> =
            names(folder.path()).iter().map(|name| mode(&folder.path().join(name))).collect();
        assert_eq!(modes, [0o600, 0o600]);
        Ok(())
    })
    .unwrap();
    assert_eq!((fs::read(&path).unwrap(), mode(&path)), (b"new".to_vec(), 0o600));
}
