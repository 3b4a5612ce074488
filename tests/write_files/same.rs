//! Which paths lead to one file.

use clsmith::output_files::is_same_file;
use std::fs;

#[test]
fn spellings_and_files_that_do_not_exist() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("a.cls"), "").unwrap();
    fs::write(path("b.cls"), "").unwrap();
    fs::create_dir(path("sub")).unwrap();
    assert!(is_same_file(&path("a.cls"), &path("a.cls")));
    assert!(is_same_file(&path("a.cls"), &path("sub/../a.cls")));
    assert!(!is_same_file(&path("a.cls"), &path("b.cls")));
    assert!(!is_same_file(&path("a.cls"), &path("new.cls")));
    assert!(is_same_file(&path("new.cls"), &path("sub/../new.cls")));
    assert!(!is_same_file(&path("missing/a.cls"), &path("missing/a2.cls")));
}

#[cfg(unix)]
#[test]
fn links() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("a.cls"), "").unwrap();
    fs::hard_link(path("a.cls"), path("hard.cls")).unwrap();
    std::os::unix::fs::symlink("a.cls", path("soft.cls")).unwrap();
    std::os::unix::fs::symlink("new.cls", path("dangling.cls")).unwrap();
    assert!(is_same_file(&path("a.cls"), &path("hard.cls")));
    assert!(is_same_file(&path("a.cls"), &path("soft.cls")));
    assert!(is_same_file(&path("soft.cls"), &path("hard.cls")));
    assert!(is_same_file(&path("dangling.cls"), &path("new.cls")));
    assert!(!is_same_file(&path("dangling.cls"), &path("a.cls")));
}
