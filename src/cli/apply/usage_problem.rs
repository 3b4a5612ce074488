//! This module checks a command line of `apply`.

use super::ApplyArgs;
use crate::cli::input_files::STANDARD;
use crate::cli::output_endings::{OutputContent, find_wrong_ending};
use clsmith::output_files::is_same_file;
use std::path::{Path, PathBuf};

impl ApplyArgs {
    /// Returns what is wrong with the command line and cannot be found by clap, if there is anything.
    pub(super) fn find_usage_problem(&self) -> Option<String> {
        let standard = |path: &PathBuf| path == Path::new(STANDARD);
        if self.inputs.iter().filter(|path| standard(path)).count() > 1 {
            return Some("standard input can be read only once".into());
        }
        if self.diff && self.output.as_ref().is_some_and(standard) {
            return Some("--diff and -o - both write to standard output".into());
        }
        let several = self.inputs.len() > 1;
        let extra: Vec<(&str, &Path)> = self.named_outputs().chain(self.reports.named_outputs()).collect();
        let taken = self.diff || self.output.as_ref().is_some_and(standard);
        let on_standard: Vec<&str> =
            extra.iter().filter(|(_, path)| *path == Path::new(STANDARD)).map(|(name, _)| *name).collect();
        match on_standard.as_slice() {
            [name, ..] if taken => {
                return Some(format!("{name} - would go to standard output together with --diff or -o -"));
            }
            [name, other, ..] => {
                return Some(format!("{name} - and {other} - both write to standard output"));
            }
            _ => {}
        }
        let target = self.inputs.first().and_then(|input| self.output_path(input));
        let files = target.iter().map(|path| ("-o", path.as_path())).chain(extra.iter().copied());
        let files: Vec<(&str, &Path)> = files.filter(|(_, path)| *path != Path::new(STANDARD)).collect();
        for (index, (other, path)) in files.iter().enumerate() {
            let same = |(_, earlier): &&(&str, &Path)| earlier == path || is_same_file(earlier, path);
            if let Some((name, _)) = files.iter().take(index).find(same) {
                return Some(format!("{other} and {name} name one file"));
            }
        }
        if several && let Some((name, _)) = extra.first() {
            return Some(format!("{name} shows one program; there are several"));
        }
        let folder = self.output.as_deref().filter(|path| !path.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| several && !folder.is_dir()) {
            let folder = folder.display();
            return Some(format!(
                "with several inputs, -o must name an existing folder, which `{folder}` is not"
            ));
        }
        if several && self.output.is_some() {
            // Upper and lower case are ignored, because on some disks `A.cls` and `a.cls` are the same file.
            let name = |input: &PathBuf| {
                input.file_name().map(|name| name.to_string_lossy().to_lowercase()).unwrap_or_default()
            };
            let mut names: Vec<String> = self.inputs.iter().map(name).collect();
            names.sort();
            let twice = names.iter().zip(names.iter().skip(1)).find(|(one, next)| one == next);
            if let Some((name, _)) = twice {
                return Some(format!("two inputs are called {name}; their outputs would be one file"));
            }
        }
        None
    }

    /// Returns a sentence about the first output whose ending does not fit its content. It is called after
    /// the check that no output is an input.
    pub(super) fn find_wrong_ending(&self, target: Option<&Path>) -> Option<String> {
        let wrong = find_wrong_ending([
            ("-o", target, OutputContent::Program),
            ("--plot", self.plot.as_deref(), OutputContent::Drawing),
            ("--json", self.json.path(), OutputContent::Json),
        ]);
        wrong.or_else(|| self.reports.find_wrong_ending())
    }

    /// Returns the given options, besides those of reports, that name a file to write, with their files.
    pub(super) fn named_outputs(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let both = [("--plot", self.plot.as_deref()), ("--json", self.json.path())];
        both.into_iter().filter_map(|(name, path)| Some((name, path?)))
    }
}
