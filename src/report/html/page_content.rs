//! This module hands over what a page shows, for a program that fills the page's template itself.

use super::array_encoding::PageArray;
use super::markup;
use super::page_arrays::PageArrays;
use super::page_files::split_template;
use super::sections;
use crate::report::comparison::Comparison;
use std::io;

/// The marks of the template that are the same in every page, and the one of the arrays.
const NO_SECTIONS: [&str; 5] = ["policy", "styles", "scripts", "licences", "data"];

/// What a page shows: its sections as HTML, and what its scripts draw. A browser that has the page's template, style and
/// scripts already (the viewer in `web/`) makes the page from it, without numbers that are written as text and read again.
#[derive(Debug)]
#[non_exhaustive]
pub struct PageContent {
    /// The sections by their marks in the template. All text that comes from a file is escaped.
    pub sections: Vec<(&'static str, String)>,
    /// The facts without which the arrays cannot be drawn, as JSON.
    pub facts: String,
    /// The arrays by name. `text` holds the rows of the listing, each with LF at its end.
    pub arrays: Vec<(String, PageArray)>,
}

impl PageContent {
    /// Makes the content of a comparison's page.
    ///
    /// # Errors
    /// Returns the errors of writing into memory.
    pub fn from_comparison(comparison: &Comparison<'_>) -> io::Result<Self> {
        let arrays = PageArrays::from_comparison(comparison);
        let marks = split_template().filter_map(|(mark, _)| mark).filter(|mark| !NO_SECTIONS.contains(mark));
        let mut sections: Vec<(&'static str, String)> = Vec::new();
        for mark in marks {
            // The title stands in the template twice.
            if sections.iter().any(|(known, _)| *known == mark) {
                continue;
            }
            let mut html = Vec::new();
            match mark {
                "title" => markup::write_text(&mut html, comparison.subject.program.source().name())?,
                section => sections::write_section(section, comparison, &arrays, &mut html)?,
            }
            sections.push((mark, String::from_utf8_lossy(&html).into_owned()));
        }
        let (facts, arrays) = arrays.into_parts();
        Ok(Self { sections, facts: facts.to_string(), arrays })
    }
}
