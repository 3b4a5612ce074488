//! This module holds the parts that are the same in every page, and the policy that allows only their scripts
//! to run.

use super::markup;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};
use std::io::{self, Write};

const TEMPLATE: &str = include_str!("page/page.html");

/// The libraries: name, script, licence.
const LIBRARIES: [(&str, &str, &str); 1] =
    [("three.js 0.187.0", include_str!("vendor/three.iife.min.js"), include_str!("vendor/three.LICENSE"))];

/// The page's own scripts, in the order in which they are read. They share one scope.
const SCRIPTS: [&str; 23] = [
    include_str!("page/data.js"),
    include_str!("page/program.js"),
    include_str!("page/theme.js"),
    include_str!("page/colors.js"),
    include_str!("page/chart_data.js"),
    include_str!("page/chart_scale.js"),
    include_str!("page/chart.js"),
    include_str!("page/charts.js"),
    include_str!("page/histogram.js"),
    include_str!("page/worst_places.js"),
    include_str!("page/path_lines.js"),
    include_str!("page/stock_states.js"),
    include_str!("page/stock_surface.js"),
    include_str!("page/tool_mesh.js"),
    include_str!("page/scene.js"),
    include_str!("page/hud.js"),
    include_str!("page/view.js"),
    include_str!("page/listing.js"),
    include_str!("page/readout.js"),
    include_str!("page/keyboard.js"),
    include_str!("page/printing.js"),
    include_str!("page/editor_link.js"),
    include_str!("page/main.js"),
];

const STYLE: &str = include_str!("page/page.css");

/// Splits the template at its marks, such as `{{title}}`. Returns the name of each mark and the text after
/// it; the text before the first mark has `None`.
pub(super) fn split_template() -> impl Iterator<Item = (Option<&'static str>, &'static str)> {
    TEMPLATE.split("{{").enumerate().map(|(index, piece)| match piece.split_once("}}") {
        Some((mark, text)) if index > 0 => (Some(mark), text),
        _ => (None, piece),
    })
}

/// Returns the scripts of the page as a single one.
fn page_script() -> String {
    format!("(() => {{\n\"use strict\";\n{}}})();\n", SCRIPTS.concat())
}

/// Returns the Content-Security-Policy: nothing is loaded, and only these scripts and styles are allowed.
pub(super) fn content_security_policy() -> String {
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text.as_bytes())));
    let mut scripts: Vec<String> = LIBRARIES.iter().map(|(_, script, _)| hash(script)).collect();
    scripts.push(hash(&page_script()));
    format!(
        "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data: blob:; style-src {}; script-src {}",
        hash(STYLE),
        scripts.join(" "),
    )
}

pub(super) fn write_styles(out: &mut dyn Write) -> io::Result<()> {
    write!(out, "<style>{}</style>", STYLE)
}

pub(super) fn write_scripts(out: &mut dyn Write) -> io::Result<()> {
    for (_, script, _) in LIBRARIES {
        // The hash in the policy covers every byte between the tags. With one more line break there, the
        // browser would not run the script.
        writeln!(out, "<script>{script}</script>")?;
    }
    writeln!(out, "<script>{}</script>", page_script())
}

pub(super) fn write_licences(out: &mut dyn Write) -> io::Result<()> {
    for (name, _, licence) in LIBRARIES {
        write!(out, "<h3>{name}</h3><pre>")?;
        markup::write_text(out, licence)?;
        out.write_all(b"</pre>")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_part_of_the_page_ends_its_element() {
        let own = page_script();
        for script in LIBRARIES.iter().map(|(_, script, _)| *script).chain([own.as_str()]) {
            let lower = script.to_ascii_lowercase();
            assert!(!lower.contains("</script") && !lower.contains("<!--"));
        }
        assert!(!STYLE.to_ascii_lowercase().contains("</style"));
    }
}
