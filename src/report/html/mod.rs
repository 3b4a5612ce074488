//! A comparison as one HTML page that needs nothing else: no network, no other file.
//!
//! Tables, findings and texts stand in the page as they are; charts, the path in 3D and the listing are drawn by the scripts in `page/`
//! from arrays that travel as compressed base64 (`encode`). Charts are uPlot's, the 3D is three.js's; both are part of the page, with
//! their licences (`vendor/`). Everything that comes from a file is escaped, and the page's own policy lets no other script run than the
//! page's, which it knows by their hashes. The same comparison makes the same bytes.

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
