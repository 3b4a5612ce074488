//! A comparison as one HTML page that needs no network and no other file.
//!
//! Tables, findings and texts stand in the page as they are. Charts, the path in 3D and the listing are drawn
//! by the scripts in `page/` from arrays (`encode`): little-endian numbers whose bytes of equal significance
//! stand together, deflated, in base64. A motion costs some 28 bytes of page with its line, before and after.
//! Charts are drawn by uPlot and the 3D by three.js; both are part of the page, with their licences
//! (`vendor/`).
//!
//! Everything that comes from a file is escaped. The page's own policy (CSP) lets only scripts run whose
//! hashes it names, so text that got through the escaping would still do nothing. The same comparison makes
//! the same bytes.
//!
//! Motions before and after are paired by their statements: a point that a step put in belongs to the next
//! motion of the file. The page times its frames. A path that takes long is drawn with every nth point first
//! and whole once the view rests, if that takes less than 1.5 s; else the page says that it is coarse. Clicks
//! always look at all motions.

mod array_encoding;
mod listing;
mod markup;
mod motion_arrays;
mod motion_change;
mod page_arrays;
mod page_assets;
mod sections;
mod stock_height_field;

use super::comparison::Comparison;
use std::io::{self, Write};

/// Writes the page.
///
/// # Errors
/// What `out` returns.
pub fn write_page(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let arrays = page_arrays::PageArrays::from_comparison(comparison);
    for (at, text) in page_assets::split_template() {
        match at {
            None => {}
            Some("title") => markup::write_text(out, comparison.subject.program.source().name())?,
            Some("policy") => out.write_all(page_assets::content_security_policy().as_bytes())?,
            Some("styles") => page_assets::write_styles(out)?,
            Some("scripts") => page_assets::write_scripts(out)?,
            Some("licences") => page_assets::write_licences(out)?,
            Some("data") => arrays.write_elements(out)?,
            Some(section) => sections::write_section(section, comparison, &arrays.missing, out)?,
        }
        out.write_all(text.as_bytes())?;
    }
    Ok(())
}
