//! A comparison as one HTML page that needs nothing else: no network, no other file.
//!
//! Tables, findings and texts stand in the page as they are; charts, the path in 3D and the listing are drawn by the scripts in `page/`
//! from arrays that travel as compressed base64 (`encode`). Charts are uPlot's, the 3D is three.js's; both are part of the page, with
//! their licences (`vendor/`). Everything that comes from a file is escaped, and the page's own policy lets no other script run than the
//! page's, which it knows by their hashes. The same comparison makes the same bytes.

mod arrays;
mod assets;
mod change;
mod encode;
mod listing;
mod markup;
mod sections;
mod side;
mod stock;

use super::comparison::Comparison;
use std::io::{self, Write};

/// Writes the page.
///
/// # Errors
/// What `out` returns.
pub fn page(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let arrays = arrays::Arrays::of(comparison);
    for (at, text) in assets::template() {
        match at {
            None => {}
            Some("title") => markup::text(out, comparison.subject.program.source().name())?,
            Some("policy") => out.write_all(assets::policy().as_bytes())?,
            Some("styles") => assets::styles(out)?,
            Some("scripts") => assets::scripts(out)?,
            Some("licences") => assets::licences(out)?,
            Some("data") => arrays.write(out)?,
            Some(section) => sections::write(section, comparison, &arrays.missing, out)?,
        }
        out.write_all(text.as_bytes())?;
    }
    Ok(())
}
