//! This module reads a profile file, and reports its faults at their places.

use super::curves::{build_curves, curve_end, meant_end};
use super::piece_fault::PieceFault;
use super::text::ProfileFileText;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::source::Source;
use crate::surface::profile::Point;
use crate::surface_milling::SectionProfile;
use crate::yaml::{YamlDocument, YamlPathSegment};
use std::sync::Arc;

/// The most faults that are reported. Whoever has more fixes the first ones first.
const MOST: usize = 20;

pub(super) fn read_profile(source: &Arc<Source>) -> Result<SectionProfile, Failure> {
    let document = YamlDocument::parse(source)?;
    let file: ProfileFileText = document.deserialize_checked(|_| None)?;
    let scale = file.units.mm_per_unit();
    let [u, z] = file.start.map(|value| value.get() * scale);
    let mut at = Point::new(u, z);
    let mut found = Vec::new();
    let mut profile =
        SectionProfile { curves: Vec::new(), width_mm: file.width.map(|width| width.get() * scale) };
    if file.pieces.is_empty() {
        found.push(locate_fault(
            &document,
            &[YamlPathSegment::Key("pieces")],
            &PieceFault::new("the profile has no piece", "empty"),
        ));
    }
    for (index, piece) in file.pieces.iter().enumerate() {
        match build_curves(piece, at, scale) {
            Ok(curves) => {
                if let Some(end) = curves.last().map(curve_end) {
                    at = end;
                }
                profile.curves.extend(curves);
            }
            Err(wrong) => {
                let kind = piece.yaml_key();
                let mut path = vec![
                    YamlPathSegment::Key("pieces"),
                    YamlPathSegment::Index(index),
                    YamlPathSegment::Key(kind),
                ];
                path.extend(wrong.key.map(YamlPathSegment::Key));
                path.extend(wrong.index.map(YamlPathSegment::Index));
                found.push(locate_fault(&document, &path, &wrong));
                // The next piece starts where this one was intended to end.
                at = meant_end(piece, scale).unwrap_or(at);
            }
        }
        if found.len() >= MOST {
            break;
        }
    }
    if found.is_empty() { Ok(profile) } else { Err(found.into()) }
}

fn locate_fault(document: &YamlDocument, path: &[YamlPathSegment<'_>], wrong: &PieceFault) -> Diagnostic {
    // The place is that of the innermost key that exists in the file.
    let paths = (0..=path.len()).rev().filter_map(|count| path.get(..count));
    let span = paths.filter_map(|path| document.value_span(path)).next().unwrap_or_default();
    let found = Diagnostic::new(codes::BAD_VALUE, wrong.message.clone()).with_label(
        document.source(),
        span,
        wrong.label,
    );
    match &wrong.help {
        Some(help) => found.with_help(help.clone()),
        None => found,
    }
}
