//! This module reads the words of the command line before clap does: the file behind `--json`, and spellings
//! of earlier versions.
//!
//! `--json` may stand alone or have a file. clap takes an optional value only behind `=`, because else it
//! would take the program in `clsmith stats --json part.cls` for the file. So a file behind a blank is joined
//! to `--json` here, if the word can only be meant as its file.

use clap::error::ErrorKind;
use clap::{ArgMatches, Command};
use std::ffi::{OsStr, OsString};

const JSON: &str = "--json";

/// Commands whose `--json` has always accepted a file behind a blank, whatever the file's ending.
const WITH_FILE: &[&str] = &["apply", "chips", "simulate"];

/// Spellings of earlier versions: command, old option, what to write instead. clap knows the old ones as
/// hidden aliases, or as options that it hides.
pub(super) const OLD_SPELLINGS: &[(&str, &str, &str)] = &[
    ("batch", "--out", "`--output`"),
    ("batch", "--jobs", "`--threads`"),
    ("chips", "--svg", "`--plot`"),
    ("init", "--out", "`--output`"),
    ("man", "--out", "`--output`"),
    ("simulate", "--budget", "`--memory` with a unit, as in `--memory 4GiB`"),
    ("watch", "--out", "`--output`"),
];

/// Reads the words of a command line. The first word is the name of this program.
///
/// # Errors
/// Returns the error of clap.
pub(super) fn parse_words(command: &Command, words: Vec<OsString>) -> Result<ArgMatches, clap::Error> {
    let read = |words: &[OsString]| command.clone().try_get_matches_from(words);
    let Some(joined) = join_json_file(&words) else { return read(&words) };
    // The word behind `--json` is either its file or an input of the command. The likelier reading is tried
    // first.
    let (first, second, otherwise) = match joined.is_likely {
        true => (&joined.words, &words, ErrorKind::MissingRequiredArgument),
        false => (&words, &joined.words, ErrorKind::UnknownArgument),
    };
    match read(first) {
        Err(error) if error.kind() == otherwise => read(second).map_err(|_| error),
        done => done,
    }
}

/// The words with `--json FILE` as one word.
struct JoinedWords {
    words: Vec<OsString>,
    /// Whether the word behind `--json` looks like its file.
    is_likely: bool,
}

fn join_json_file(words: &[OsString]) -> Option<JoinedWords> {
    let at = own_words(words).position(|word| word == JSON)?;
    let file = words.get(at + 1).filter(|_| own_words(words).count() > at + 1)?;
    let text = file.to_string_lossy();
    if text.starts_with('-') && text != "-" {
        return None;
    }
    let ends = std::path::Path::new(file).extension().is_some_and(|end| end.eq_ignore_ascii_case("json"));
    let has_file = words.get(1).is_some_and(|command| WITH_FILE.iter().any(|name| command == name));
    let is_likely = has_file || ends || text == "-" || text.starts_with("/dev/");
    let mut joined = OsString::from(JSON);
    joined.push("=");
    joined.push(file);
    let mut all = words.to_vec();
    all.splice(at..at + 2, [joined]);
    Some(JoinedWords { words: all, is_likely })
}

/// Returns the words in front of `--`. The words behind it belong to a post-processor.
fn own_words(words: &[OsString]) -> impl Iterator<Item = &OsStr> {
    words.iter().map(OsString::as_os_str).take_while(|word| *word != "--")
}

/// Returns a sentence for each old spelling among the words of a command.
pub(super) fn find_old_spellings(command: &str, words: &[OsString]) -> Vec<String> {
    let of_command = OLD_SPELLINGS.iter().filter(|(owner, _, _)| *owner == command);
    let used = of_command.filter(|(_, old, _)| {
        own_words(words).any(|word| {
            let word = word.to_string_lossy();
            word.strip_prefix(old).is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
        })
    });
    used.map(|(_, old, new)| format!("note: `{old}` is an older spelling; write {new}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<OsString> {
        line.split(' ').map(OsString::from).collect()
    }

    #[test]
    fn the_file_behind_json_is_joined_where_it_can_be_one() {
        let joined = |line: &str| {
            join_json_file(&words(line)).map(|joined| {
                let words: Vec<_> =
                    joined.words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
                (words.join(" "), joined.is_likely)
            })
        };
        let yes = |line: &str, is_likely: bool| Some((line.to_owned(), is_likely));
        assert_eq!(joined("clsmith stats --json out.JSON a"), yes("clsmith stats --json=out.JSON a", true));
        assert_eq!(joined("clsmith chips a --json -"), yes("clsmith chips a --json=-", true));
        assert_eq!(joined("clsmith apply r a --json b"), yes("clsmith apply r a --json=b", true));
        assert_eq!(joined("clsmith stats --json a.cls"), yes("clsmith stats --json=a.cls", false));
        assert_eq!(joined("clsmith stats a.cls --json"), None);
        assert_eq!(joined("clsmith stats --json -q a.cls"), None);
        assert_eq!(joined("clsmith hook a -- post --json {}"), None);
        assert_eq!(joined("clsmith hook a --json -- post {}"), None);
    }

    #[test]
    fn an_old_spelling_is_noted_with_the_new_one() {
        let noted = |line: &str| find_old_spellings(line.split(' ').nth(1).unwrap(), &words(line));
        assert_eq!(
            noted("clsmith chips --svg a.svg p"),
            ["note: `--svg` is an older spelling; write `--plot`"]
        );
        assert_eq!(
            noted("clsmith simulate --budget=4"),
            ["note: `--budget` is an older spelling; write `--memory` with a unit, as in `--memory 4GiB`"]
        );
        assert!(noted("clsmith stats --svg a.svg").is_empty());
        assert!(noted("clsmith batch --output a -- --out").is_empty());
    }
}
