//! This module writes a comparison as a single HTML page that needs no network and no other file.
//!
//! Tables, findings and texts are plain HTML. Charts, the path in 3D and the listing are drawn by the scripts
//! in `page/` from arrays (`array_encoding`): little-endian numbers whose bytes of equal significance are
//! stored together, deflated, in base64. In a page with a program before and after, a motion takes about 28
//! bytes, its lines of the listing included. The scripts draw charts as SVG, which
//! prints sharp, and three.js draws the 3D view. It is part of the page, with its licence (`vendor/`).
//!
//! Everything that comes from a file is escaped. The page's own policy (CSP) only lets scripts run whose
//! hashes it names, so text that got through the escaping would still do nothing. The same comparison gives
//! the same bytes.
//!
//! Motions before and after are paired by their statements. A point that a step has inserted belongs to the
//! next motion of the file. The page measures how long it takes to draw a frame. A path that takes too long
//! is first drawn with every nth point, and completely once the view rests, if that takes less than 1.5 s.
//! Otherwise a note says that the drawing is coarse. Clicks always consider all motions.

mod array_encoding;
mod findings_table;
mod listing;
mod markup;
mod motion_arrays;
mod motion_change;
mod page_arrays;
mod page_assets;
mod page_content;
mod page_files;
mod page_tools;
mod sections;
mod shop_description;
mod time_bars;

pub use array_encoding::PageArray;
pub use page_content::PageContent;

use super::comparison::Comparison;
use std::io::{self, Write};

/// Writes the page.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_page(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let arrays = page_arrays::PageArrays::from_comparison(comparison);
    for (at, text) in page_files::split_template() {
        match at {
            None => {}
            Some("title") => markup::write_text(out, comparison.subject.program.source().name())?,
            Some("policy") => out.write_all(page_assets::content_security_policy().as_bytes())?,
            Some("styles") => page_assets::write_styles(out)?,
            Some("scripts") => page_assets::write_scripts(out)?,
            Some("licences") => page_assets::write_licences(out)?,
            Some("data") => arrays.write_elements(out)?,
            Some(section) => sections::write_section(section, comparison, &arrays, out)?,
        }
        out.write_all(text.as_bytes())?;
    }
    Ok(())
}
