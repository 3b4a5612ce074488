//! This module renders a drawing as PNG.

use resvg::{tiny_skia, usvg};
use std::io;
use std::sync::Arc;

/// The letters of drawings: a part of DejaVu Sans (`font/README.md`), so that the picture is the same on
/// every machine.
const FONT: &[u8] = include_bytes!("font/DejaVuSans.ttf");

/// The number of pixels of the picture for each one of the drawing, so that it is sharp on paper.
const SCALE: f32 = 2.0;

/// Renders an SVG drawing of this crate as PNG, twice as wide and high. Latin, Greek and Cyrillic letters are
/// drawn, others as boxes.
///
/// # Errors
/// Returns an error if the drawing cannot be read, or is larger than the memory.
pub fn render_png(svg: &str) -> io::Result<Vec<u8>> {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let options = usvg::Options {
        fontdb: Arc::new(fonts),
        font_family: "DejaVu Sans".to_owned(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options).map_err(io::Error::other)?;
    let size = tree.size().to_int_size().scale_by(SCALE);
    let pixels = size.and_then(|size| tiny_skia::Pixmap::new(size.width(), size.height()));
    let Some(mut pixels) = pixels else { return Err(io::Error::other("the picture is too large")) };
    resvg::render(&tree, tiny_skia::Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(io::Error::other)
}
