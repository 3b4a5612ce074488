//! This module completes words of CL data: major words at the start of a line, minor words behind the slash.

use crate::program::record::known_words;

/// A word that may stand at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct CompletionWord {
    /// The word.
    pub word: &'static str,
    /// What it is for; empty for words without an effect on the tool path.
    pub meaning: &'static str,
}

/// The major words that move the tool or change how it moves.
const MAJOR: &[(&str, &str)] = &[
    ("CIRCLE", "an arc to the next point"),
    ("COOLNT", "coolant on or off"),
    ("CUTCOM", "cutter compensation"),
    ("CUTTER", "the shape of the tool"),
    ("CYCLE", "a drilling cycle"),
    ("END", "the end of the program or operation"),
    ("END-OF-PATH", "the end of an NX operation"),
    ("FEDRAT", "the feed"),
    ("FINI", "the end of the program"),
    ("FROM", "where the tool begins"),
    ("GODLTA", "a step from where the tool is"),
    ("GOHOME", "a move to the machine's home"),
    ("GOTO", "a straight move to a point"),
    ("INDIRV", "the direction in which an arc starts"),
    ("LOAD", "loads a tool"),
    ("LOADTL", "loads a tool"),
    ("MOVARC", "an arc to the next point"),
    ("MSYS", "the frame of the points"),
    ("MULTAX", "points with tool axes"),
    ("ORIGIN", "the frame of the points"),
    ("PARTNO", "the name of the part"),
    ("RAPID", "the next move is at rapid"),
    ("SPINDL", "the spindle"),
    ("TLAXIS", "the tool axis"),
    ("TLDATA", "the shape of the tool"),
    ("TOOL PATH", "the start of an NX operation"),
    ("TRANS", "a shift of the points"),
    ("UNITS", "the unit of lengths"),
];

/// The minor words of major ones.
const MINOR: &[(&str, &[(&str, &str)])] = &[
    (
        "COOLNT",
        &[("ON", ""), ("OFF", ""), ("FLOOD", "a stream"), ("MIST", "a fog"), ("THRU", "through the spindle")],
    ),
    ("CUTCOM", &[("LEFT", ""), ("RIGHT", ""), ("OFF", ""), ("ON", "")]),
    (
        "CYCLE",
        &[
            ("DRILL", ""),
            ("DEEP", "with pecks"),
            ("BRKCHP", "with breaks of the chip"),
            ("TAP", ""),
            ("BORE", ""),
            ("REAM", ""),
            ("FACE", ""),
            ("CSINK", ""),
            ("ON", ""),
            ("OFF", ""),
        ],
    ),
    (
        "FEDRAT",
        &[
            ("MMPM", "mm/min"),
            ("MMPR", "mm/rev"),
            ("IPM", "inch/min"),
            ("IPR", "inch/rev"),
            ("PERMIN", "units of the file per minute"),
            ("PERREV", "units of the file per revolution"),
            ("INVERS", "moves per minute"),
        ],
    ),
    ("LOAD", &[("TOOL", "")]),
    ("MULTAX", &[("ON", ""), ("OFF", "")]),
    (
        "SPINDL",
        &[
            ("RPM", "rev/min"),
            ("SFM", "ft/min of surface"),
            ("SMM", "m/min of surface"),
            ("CLW", "clockwise"),
            ("CCLW", "counter-clockwise"),
            ("ON", ""),
            ("OFF", ""),
            ("MAXRPM", "the limit of the speed"),
        ],
    ),
    ("UNITS", &[("MM", ""), ("INCHES", "")]),
];

/// Returns the words that may stand behind the text of a line up to the cursor. Numbers, comments and text for people
/// are not completed.
///
/// ```
/// use clsmith::editor::complete_words;
///
/// let words = complete_words("FEDRAT/M");
/// assert_eq!(words.iter().map(|one| one.word).collect::<Vec<_>>(), ["MMPM", "MMPR"]);
/// assert!(complete_words("GO").iter().any(|one| one.word == "GOTO"));
/// assert!(complete_words("GOTO/1.").is_empty());
/// ```
pub fn complete_words(before: &str) -> Vec<CompletionWord> {
    let line = before.trim_start();
    if line.contains('$') {
        return Vec::new();
    }
    match line.split_once('/') {
        None => {
            let typed = line.to_ascii_uppercase();
            let told = MAJOR.iter().map(|(word, meaning)| CompletionWord { word, meaning });
            let others = known_words().iter().filter(|word| MAJOR.iter().all(|(told, _)| told != *word));
            let mut all: Vec<CompletionWord> =
                told.chain(others.map(|word| CompletionWord { word, meaning: "" })).collect();
            all.retain(|one| one.word.starts_with(&typed));
            all
        }
        Some((major, fields)) => {
            let major = major.trim().to_ascii_uppercase();
            let typed = fields.rsplit(',').next().unwrap_or_default().trim_start().to_ascii_uppercase();
            let words = MINOR.iter().find(|(word, _)| *word == major).map_or(&[][..], |(_, words)| *words);
            let fitting = words.iter().filter(|(word, _)| word.starts_with(&typed));
            fitting.map(|(word, meaning)| CompletionWord { word, meaning }).collect()
        }
    }
}
