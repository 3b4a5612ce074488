//! This module checks the endings of output files, because other programs infer from its ending what a file
//! contains.

use super::input_files::STANDARD;
use std::path::Path;

/// The content of an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OutputContent {
    /// CL data, for a post.
    Program,
    /// An HTML page.
    Page,
    /// Markdown.
    Markdown,
    /// JSON.
    Json,
    /// A table.
    Csv,
    /// A mesh.
    Stl,
    /// Stock for the next program.
    Stock,
    /// A drawing as SVG or PNG.
    Drawing,
    /// An array of numbers for NumPy.
    Array,
    /// A text for people, or for other programs in a form of text of its own.
    Text,
}

/// Endings of files that contain no CL data: programs that a post has made, and other kinds of outputs.
const NO_PROGRAM: &[&str] = &[
    "nc", "ngc", "cnc", "tap", "mpf", "spf", "h", "i", "eia", "gcode", "min", "pdf", "html", "htm", "md",
    "json", "jsonl", "csv", "svg", "png", "stl", "npy", "clstock", "yaml", "yml", "zip",
];

/// Endings of files that are more than text: CL data, programs that a post has made, drawings, meshes and pages.
const NO_TEXT: &[&str] = &[
    "cls",
    "clsf",
    "apt",
    "aptsource",
    "ncl",
    "clt",
    "cl",
    "cldata",
    "nc",
    "ngc",
    "cnc",
    "tap",
    "mpf",
    "spf",
    "h",
    "i",
    "eia",
    "gcode",
    "min",
    "pdf",
    "html",
    "htm",
    "csv",
    "svg",
    "png",
    "stl",
    "npy",
    "clstock",
    "zip",
];

impl OutputContent {
    /// Returns the endings that fit, with the usual one first. The list is empty for CL data, which may have
    /// any ending that is not in [`NO_PROGRAM`], and for text, which may have any that is not in [`NO_TEXT`].
    fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Program => &[],
            Self::Page => &["html", "htm"],
            Self::Markdown => &["md", "markdown", "txt"],
            Self::Json => &["json"],
            Self::Csv => &["csv", "txt"],
            Self::Stl => &["stl"],
            Self::Stock => &["clstock"],
            Self::Drawing => &["svg", "png"],
            Self::Array => &["npy"],
            Self::Text => &[],
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Program => "CL data",
            Self::Page => "an HTML page",
            Self::Markdown => "Markdown",
            Self::Json => "JSON",
            Self::Csv => "a table (CSV)",
            Self::Stl => "a mesh (STL)",
            Self::Stock => "stock (clstock)",
            Self::Drawing => "a drawing (SVG or PNG)",
            Self::Array => "an array (NPY)",
            Self::Text => "text",
        }
    }
}

/// Returns a sentence about the first output whose ending does not fit its content, with endings that fit. A
/// file without an ending may contain anything.
pub(super) fn find_wrong_ending<'a>(
    outputs: impl IntoIterator<Item = (&'static str, Option<&'a Path>, OutputContent)>,
) -> Option<String> {
    outputs.into_iter().find_map(|(option, path, content)| {
        let path = path.filter(|path| *path != Path::new(STANDARD))?;
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        let fits = match content {
            OutputContent::Program => !NO_PROGRAM.contains(&ending.as_str()),
            OutputContent::Text => !NO_TEXT.contains(&ending.as_str()),
            other => other.endings().contains(&ending.as_str()),
        };
        if fits {
            return None;
        }
        let proposed: Vec<String> = content.endings().iter().map(|ending| format!(".{ending}")).collect();
        let instead = match content {
            OutputContent::Program => "the input's ending".to_owned(),
            OutputContent::Text => ".txt".to_owned(),
            _ => proposed.join(" or "),
        };
        let (shown, what) = (path.display(), content.name());
        Some(format!("{option} writes {what}, and `{shown}` ends in .{ending}; give it {instead}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(content: OutputContent, path: &str) -> Option<String> {
        find_wrong_ending([("--option", Some(Path::new(path)), content)])
    }

    #[test]
    fn an_ending_that_promises_something_else_is_refused() {
        for (content, path) in [
            (OutputContent::Page, "report.pdf"),
            (OutputContent::Drawing, "layers.pdf"),
            (OutputContent::Program, "done/part.NC"),
            (OutputContent::Json, "a.yaml"),
            (OutputContent::Stl, "a.obj"),
            (OutputContent::Text, "stats.cls"),
            (OutputContent::Text, "stats.pdf"),
            (OutputContent::Text, "part.aptsource"),
        ] {
            let said = wrong(content, path).expect(path);
            assert!(said.starts_with("--option writes ") && said.contains("give it "), "{said}");
        }
    }

    #[test]
    fn usual_endings_and_none_at_all_are_good() {
        for (content, path) in [
            (OutputContent::Page, "a.HTML"),
            (OutputContent::Drawing, "a.png"),
            (OutputContent::Program, "a.cls"),
            (OutputContent::Program, "a.aptsource"),
            (OutputContent::Program, "a.anything"),
            (OutputContent::Json, "-"),
            (OutputContent::Csv, "/dev/stdout"),
            (OutputContent::Text, "stats.txt"),
            (OutputContent::Text, "out.sarif"),
            (OutputContent::Text, "clsmith.fish"),
        ] {
            assert_eq!(wrong(content, path), None, "{path}");
        }
    }
}
