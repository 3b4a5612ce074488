//! What git does to files on Windows, where it likes to change line ends: nothing, but for scripts of cmd.exe.

use super::{git, output};

#[test]
fn a_checkout_on_windows_has_the_same_bytes() {
    let Some(git) = git() else { return };
    let files = output(&git, &["ls-files", "-z"]);
    let files: Vec<&str> = files.split_terminator('\0').collect();
    let mut scripts = 0;
    // In bites, since a command line is not endless.
    for some in files.chunks(200) {
        let told = output(&git, &[&["check-attr", "text", "eol", "--"], some].concat());
        for line in told.lines() {
            let (file, attribute) = line.rsplit_once(": ").map_or(("", ""), |(rest, value)| (rest, value));
            let is_script = [".bat: ", ".cmd: "].iter().any(|end| format!("{file} ").contains(end));
            let wanted = match (file.ends_with(": text"), is_script) {
                (true, true) => "set",
                (true, false) => "unset",
                (false, true) => "crlf",
                (false, false) => "unspecified",
            };
            scripts += usize::from(wanted == "crlf");
            assert_eq!(attribute, wanted, "{line}");
        }
    }
    assert!(scripts >= 3, "{scripts}");
}

#[test]
fn no_name_of_the_project_is_reserved_on_windows() {
    let Some(git) = git() else { return };
    let mut folded = std::collections::BTreeSet::new();
    for path in output(&git, &["ls-files", "-z"]).split_terminator('\0') {
        assert!(folded.insert(path.to_lowercase()), "{path}: another file differs by case alone");
        // Below a folder of 60 letters a path must fit into the 260 that old programs take.
        assert!(path.len() < 190, "{path}");
        for name in path.split('/') {
            let stem = name.split('.').next().unwrap().to_ascii_lowercase();
            let numbered = ["com", "lpt"]
                .iter()
                .any(|port| stem.strip_prefix(port).is_some_and(|rest| rest.len() == 1 && rest != "0"));
            assert!(!numbered && !["con", "prn", "aux", "nul"].contains(&stem.as_str()), "{path}");
            assert!(
                !name.ends_with([' ', '.']) && !name.contains(['<', '>', ':', '"', '\\', '|', '?', '*']),
                "{path}"
            );
        }
    }
    assert!(folded.len() > 500);
}
