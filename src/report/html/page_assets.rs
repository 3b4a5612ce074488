//! This module writes the parts that are the same in every page, and the policy that allows only their scripts
//! to run.

use super::markup;
use super::page_files::{DATA_SCRIPT, LIBRARIES, STYLE, join_scripts};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};
use std::io::{self, Write};

/// Returns the Content-Security-Policy: nothing is loaded, and only these scripts and styles are allowed.
pub(super) fn content_security_policy() -> String {
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text.as_bytes())));
    let mut scripts: Vec<String> = LIBRARIES.iter().map(|(_, script, _)| hash(script)).collect();
    scripts.push(hash(&join_scripts(DATA_SCRIPT)));
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
    writeln!(out, "<script>{}</script>", join_scripts(DATA_SCRIPT))
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
        let own = join_scripts(DATA_SCRIPT);
        for script in LIBRARIES.iter().map(|(_, script, _)| *script).chain([own.as_str()]) {
            let lower = script.to_ascii_lowercase();
            assert!(!lower.contains("</script") && !lower.contains("<!--"));
        }
        assert!(!STYLE.to_ascii_lowercase().contains("</style"));
    }
}
