//! Names and paths of Windows.

use clsmith::output_files::WindowsName;
use std::path::Path;

#[test]
fn devices_of_windows_are_known_by_their_names() {
    let of = |name: &str| WindowsName::of_path(Path::new(name));
    for name in [
        "con",
        "PRN",
        "Aux.cls",
        "aux .cls",
        "done/com1.ncl.3",
        "LPT9",
        "lpt³.x",
        "conin$",
        "nul.cls",
        "AUX:",
    ] {
        assert_eq!(of(name), WindowsName::Device, "{name}");
    }
    for name in ["NUL", "done/nul"] {
        assert_eq!(of(name), WindowsName::Nothing, "{name}");
    }
    for name in [
        "console.cls",
        "aux1.cls",
        "com.cls",
        "com0.cls",
        "com10",
        "my aux.cls",
        "nulls",
        "con_1",
        "aux/part.cls",
        "",
    ] {
        assert_eq!(of(name), WindowsName::File, "{name}");
    }
}

#[test]
fn a_name_of_a_device_is_written_where_it_is_no_device() {
    let folder = tempfile::tempdir().unwrap();
    let done = super::write(&folder.path().join("aux.cls"), "GOTO/1,2,3\n");
    assert_eq!(done.is_ok(), cfg!(not(windows)));
    if cfg!(windows) {
        assert!(done.unwrap_err().to_string().contains("device"));
        super::write(Path::new("NUL"), "GOTO/1,2,3\n").unwrap();
        assert!(super::names(folder.path()).is_empty());
    } else {
        assert_eq!(super::names(folder.path()), ["aux.cls"]);
    }
}

#[test]
fn a_path_of_more_than_260_letters_is_written_and_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let deep = (0..6).fold(folder.path().to_path_buf(), |deep, _| deep.join("a".repeat(48)));
    std::fs::create_dir_all(&deep).unwrap();
    let path = deep.join("part.cls");
    for text in ["one", "another"] {
        super::write(&path, text).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    }
    assert_eq!(super::names(&deep), ["part.cls"]);
}
