//! This module holds the parts that are the same in every page: its template, its style and its scripts.
//!
//! It uses nothing of the crate, because the tool that puts the viewer of `web/` together reads this file, too: the report
//! and the viewer show programs with the same scripts.

/// The page, with marks such as `{{title}}`.
pub(super) const TEMPLATE: &str = include_str!("page/page.html");

/// The libraries: name, script, licence.
pub(super) const LIBRARIES: [(&str, &str, &str); 1] =
    [("three.js 0.187.0", include_str!("vendor/three.iife.min.js"), include_str!("vendor/three.LICENSE"))];

/// The script that reads facts and arrays from elements of the page. A page that gets them otherwise has another one.
pub(super) const DATA_SCRIPT: &str = include_str!("page/data.js");

/// The page's own scripts behind that one, in the order in which they are read. They share one scope.
const SCRIPTS: [&str; 22] = [
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

/// The style of the page.
pub(super) const STYLE: &str = include_str!("page/page.css");

/// Splits the template at its marks. Returns the name of each mark and the text after it; the text before the first mark
/// has `None`.
pub(super) fn split_template() -> impl Iterator<Item = (Option<&'static str>, &'static str)> {
    TEMPLATE.split("{{").enumerate().map(|(index, piece)| match piece.split_once("}}") {
        Some((mark, text)) if index > 0 => (Some(mark), text),
        _ => (None, piece),
    })
}

/// Returns the scripts of the page as a single one. `data` is the first of them: [`DATA_SCRIPT`], or another one that
/// defines the same names.
pub(super) fn join_scripts(data: &str) -> String {
    format!("(() => {{\n\"use strict\";\n{data}{}}})();\n", SCRIPTS.concat())
}
