//! PNG from SVG, on white paper, with fonts that come along: the same bytes on every machine.

use std::fmt;
use std::sync::{Arc, OnceLock};

use resvg::{tiny_skia, usvg};

/// Why a picture could not be turned into a PNG.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PngFault(String);

impl fmt::Display for PngFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PngFault {}

/// Pixels per SVG pixel: sharp in print at column width.
const SCALE: f32 = 3.0;
/// Largest side in pixels.
const LARGEST: f32 = 16_384.0;

/// Renders a picture of [`super::draw`] at three times its size.
pub fn png(svg: &str) -> Result<Vec<u8>, PngFault> {
    let fault = |e: &dyn fmt::Display| PngFault(e.to_string());
    let options = usvg::Options {
        fontdb: fonts(),
        font_family: "Libertinus Serif".to_string(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|e| fault(&e))?;
    let size = tree.size();
    let scale = SCALE.min(LARGEST / size.width().max(size.height()));
    let pixels = |side: f32| (side * scale).ceil().max(1.0) as u32;
    let mut map = tiny_skia::Pixmap::new(pixels(size.width()), pixels(size.height()))
        .ok_or_else(|| PngFault("the picture is too large".to_string()))?;
    map.fill(tiny_skia::Color::WHITE);
    resvg::render(
        &tree,
        tiny_skia::Transform::from_scale(scale, scale),
        &mut map.as_mut(),
    );
    map.encode_png().map_err(|e| fault(&e))
}

fn fonts() -> Arc<usvg::fontdb::Database> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = usvg::fontdb::Database::new();
        typst_assets::fonts().for_each(|data| fonts.load_font_data(data.to_vec()));
        fonts.set_serif_family("Libertinus Serif");
        Arc::new(fonts)
    };
    FONTS.get_or_init(load).clone()
}
