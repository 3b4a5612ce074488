//! This module holds the dialects of CL text: how they are detected, and the facts in which they differ.

use super::provenance_comments::ProvenanceComment;
use super::record::Record;
use super::syntax::{StatementKind, StatementSyntax};
use std::fmt;

/// A dialect of CL text. The names are those of `--dialect` and of reports.
///
/// ```
/// use clsmith::program::Dialect;
///
/// assert_eq!(Dialect::from_name("nx"), Some(Dialect::Nx));
/// assert_eq!(Dialect::ALL.map(Dialect::name).len(), 9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Dialect {
    /// Siemens NX CLSF.
    Nx,
    /// CATIA V5 APT.
    Catia,
    /// CATIA V5 APT through an ICAM table.
    CatiaIcam,
    /// PTC Creo NCL (`$$->` records).
    Creo,
    /// PTC Creo's G-POST input (`REMARK ->`, `PPWORD`).
    CreoGpost,
    /// SolidWorks CAM APT.
    SolidWorks,
    /// CAMWorks CLT.
    CamWorks,
    /// Makino FF cldata.
    MakinoFf,
    /// Plain ISO 4343 / APT words.
    #[default]
    Iso,
}

/// The direction in which an arc turns about the printed axis of a CIRCLE.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ArcRule {
    /// Left-hand: about +z the arc is clockwise (measured: NX 1,143 of 1,143 tangent arcs, FF 53 of 53).
    LeftHand,
    /// Right-hand: about +z the arc is counter-clockwise (measured: SolidWorks 2,914 of 2,953;
    /// documented: Creo).
    RightHand,
    /// A word in the record gives the direction.
    ByWord,
    /// Nothing gives the direction, and nobody has measured it (plain ISO). The arc takes the direction
    /// that continues the motion before it. If that does not decide, it is right-hand, as in ISO 4343, and a
    /// note says so.
    FromTangent,
}

impl Dialect {
    /// All dialects.
    pub const ALL: [Self; 9] = [
        Self::Nx,
        Self::Catia,
        Self::CatiaIcam,
        Self::Creo,
        Self::CreoGpost,
        Self::SolidWorks,
        Self::CamWorks,
        Self::MakinoFf,
        Self::Iso,
    ];

    /// Returns the name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nx => "nx",
            Self::Catia => "catia",
            Self::CatiaIcam => "catia-icam",
            Self::Creo => "creo",
            Self::CreoGpost => "creo-gpost",
            Self::SolidWorks => "solidworks",
            Self::CamWorks => "camworks",
            Self::MakinoFf => "makino-ff",
            Self::Iso => "iso",
        }
    }

    /// Returns the name that people use.
    pub fn display_name(self) -> &'static str {
        match self {
            Self::Nx => "Siemens NX CLSF",
            Self::Catia => "CATIA V5 APT",
            Self::CatiaIcam => "CATIA V5 APT (ICAM)",
            Self::Creo => "PTC Creo NCL",
            Self::CreoGpost => "PTC Creo NCL (G-POST)",
            Self::SolidWorks => "SolidWorks CAM APT",
            Self::CamWorks => "CAMWorks CLT",
            Self::MakinoFf => "Makino FF cldata",
            Self::Iso => "ISO 4343 / APT",
        }
    }

    /// Returns the dialect with a name, in upper or lower case.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|dialect| dialect.name().eq_ignore_ascii_case(name))
    }

    /// Returns the direction of arcs about the axis of a CIRCLE.
    pub fn arc_rule(self) -> ArcRule {
        match self {
            Self::Nx | Self::MakinoFf => ArcRule::LeftHand,
            Self::SolidWorks | Self::Creo | Self::CreoGpost => ArcRule::RightHand,
            Self::CamWorks => ArcRule::ByWord,
            Self::Catia | Self::CatiaIcam | Self::Iso => ArcRule::FromTangent,
        }
    }

    /// Returns whether numbers are right-aligned in columns.
    pub fn has_columns(self) -> bool {
        matches!(self, Self::Catia | Self::CatiaIcam)
    }

    /// Returns whether a program is expected to end in FINI (or END).
    pub fn ends_with_fini(self) -> bool {
        !matches!(self, Self::Nx | Self::MakinoFf | Self::Iso)
    }

    /// Returns the word of a FEDRAT for inverse time, where the records of the CAM system have one of their own. With
    /// others the post decides.
    pub fn inverse_time_word(self) -> Option<&'static str> {
        matches!(self, Self::Creo | Self::CreoGpost | Self::Iso).then_some("INVERS")
    }

    /// Returns whether `TLAXIS` gives the setup's orientation in the machine instead of the axis in the
    /// printed coordinates. CAMWorks CLT prints every setup in its own frame with the tool along z (the axis
    /// of its arcs is always 0,0,1).
    pub fn has_setup_axis(self) -> bool {
        self == Self::CamWorks
    }
}

impl fmt::Display for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.display_name())
    }
}

/// Detects the dialect while statements pass by.
#[derive(Debug, Default)]
pub(crate) struct DialectDetector {
    catia: bool,
    icam: bool,
    found: Option<Dialect>,
}

impl DialectDetector {
    /// Examines one statement. The marks are exact texts that only one system writes, so the first mark
    /// decides.
    pub(crate) fn observe_statement(&mut self, syntax: &StatementSyntax<'_>, record: &Record) {
        if self.found.is_some() {
            return;
        }
        self.found = match (syntax.form, record) {
            (StatementKind::OperationStart, _) => Some(Dialect::Nx),
            (StatementKind::FrameMark, _) => {
                self.catia = true;
                None
            }
            (StatementKind::Comment, _) => self.detect_in_comment(syntax.text),
            // Creo's own records are in `$$->` comments, its G-POST's in `REMARK ->`.
            (StatementKind::Structured, _) if syntax.text.trim_ascii_start().starts_with(b"$$") => {
                Some(Dialect::Creo)
            }
            (StatementKind::Structured, _) => Some(Dialect::CreoGpost),
            (StatementKind::FreeText, _) => detect_in_free_text(syntax),
            (StatementKind::Words, _) => detect_in_words(&syntax.major_word(), syntax),
            _ => None,
        };
    }

    /// Adds the marks of the statements that follow those that this one has seen.
    pub(crate) fn append(&mut self, behind: &Self) {
        self.catia |= behind.catia;
        self.icam |= behind.icam;
        self.found = self.found.or(behind.found);
    }

    /// Returns whether no statement behind can change the dialect.
    pub(crate) fn is_decided(&self) -> bool {
        self.found.is_some()
    }

    /// Returns whether a mark of any system was found.
    pub(crate) fn has_mark(&self) -> bool {
        self.found.is_some() || self.catia || self.icam
    }

    /// Returns the dialect, or [`Dialect::Iso`] if there was no mark.
    pub(crate) fn detected_dialect(&self) -> Dialect {
        match self.found {
            Some(found) => found,
            None if self.icam => Dialect::CatiaIcam,
            None if self.catia => Dialect::Catia,
            None => Dialect::Iso,
        }
    }

    /// Finds a mark in a comment. CATIA's marks are only remembered, since an ICAM mark may follow.
    fn detect_in_comment(&mut self, text: &[u8]) -> Option<Dialect> {
        if ProvenanceComment::from_text(text).is_some() {
            // Our own comments hold names of the user, which may contain any mark.
            return None;
        }
        let has = |mark: &[u8]| memchr::memmem::find(text, mark).is_some();
        self.catia |= has(b"CATIA APT VERSION");
        self.icam |= has(b"ICAM - ") || has(b"ICAM_");
        if has(b"Pro/CLfile") {
            return Some(Dialect::Creo);
        }
        None
    }
}

/// Finds a mark in a text for people.
fn detect_in_free_text(syntax: &StatementSyntax<'_>) -> Option<Dialect> {
    let text = syntax.fields.first().map(|field| syntax.bytes_at(&field.at)).unwrap_or_default();
    match syntax.major_word().as_ref() {
        "OPFEATSTART" => Some(Dialect::CamWorks),
        "PPRINT" if text.starts_with(b"APTCL-SPEC,MAKINO") => Some(Dialect::MakinoFf),
        _ => None,
    }
}

/// Finds a mark among the major words.
fn detect_in_words(major: &str, syntax: &StatementSyntax<'_>) -> Option<Dialect> {
    match major {
        "TLDATA" | "MSYS" | "PAINT" | "END-OF-PATH" => Some(Dialect::Nx),
        "CSI_SET_FLUTE_LENGTH" | "CSI_SET_EXTENSION_LENGTH" | "TRNTYP" => Some(Dialect::SolidWorks),
        "BOX" | "MOVE_ATTRIB" => Some(Dialect::CamWorks),
        "PPWORD" | "CAMERA" => Some(Dialect::CreoGpost),
        "CIRCLE" if has_trailing_sense_word(syntax) => Some(Dialect::CamWorks),
        _ => None,
    }
}

/// Returns whether a CIRCLE ends in a word for its direction, as CLT writes it.
fn has_trailing_sense_word(syntax: &StatementSyntax<'_>) -> bool {
    let last = syntax.fields.len().checked_sub(1).and_then(|last| syntax.word_at(last));
    matches!(last.as_deref(), Some("CLOCKWISE" | "COUNTERCLOCKWISE"))
}
