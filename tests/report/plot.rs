//! Drawings of programs.

use super::simulation::{SHOP, SLOT, setup, simulate};
use crate::support::program;
use clsmith::program::LengthUnit;
use clsmith::report::DisplayUnits;
use clsmith::report::plot::{PlotAbscissa, PlotQuantity, PlottedProgram, draw_programs, render_png};

fn drawn(quantities: &[PlotQuantity], along: PlotAbscissa) -> String {
    let (before, after) = (SLOT, SLOT.replace("FEDRAT/MMPM,800", "FEDRAT/MMPM,400"));
    let simulated = [before, &after].map(|text| simulate(text, SHOP, LengthUnit::Mm).unwrap());
    let programs = [before, &after].map(program);
    let named = ["before.cls", "after.cls"].into_iter().zip(programs.iter().zip(&simulated));
    let shop = setup(SHOP);
    let plotted: Vec<PlottedProgram<'_>> = named
        .map(|(name, (program, simulated))| PlottedProgram {
            name,
            program,
            units: LengthUnit::Mm,
            setup: &shop,
            simulated: Some(simulated),
            lines: None,
        })
        .collect();
    draw_programs(&plotted, quantities, along, DisplayUnits::MM).unwrap()
}

/// Largest coordinate to the right of all lines.
fn ends(svg: &str) -> Vec<f64> {
    let lines = svg.split("<polyline").skip(1).filter_map(|rest| rest.split("points=\"").nth(1));
    let last = |points: &str| {
        let points = points.split_once('"').unwrap().0;
        points
            .split_whitespace()
            .map(|point| point.split_once(',').unwrap().0.parse::<f64>().unwrap())
            .fold(0.0, f64::max)
    };
    lines.map(last).collect()
}

#[test]
fn a_panel_for_each_quantity_and_a_line_for_each_program() {
    let svg = drawn(&PlotQuantity::ALL, PlotAbscissa::Time);
    let size = format!("<svg width=\"1200\" height=\"{}\"", 400 * PlotQuantity::ALL.len());
    assert!(svg.starts_with(&size), "{}", &svg[..80]);
    for quantity in PlotQuantity::ALL {
        assert!(svg.contains(&quantity.axis_title(DisplayUnits::MM)), "{}", quantity.name());
    }
    for name in ["before.cls", "after.cls"] {
        assert_eq!(svg.matches(name).count(), 1);
    }
    // Half the feed takes twice the time: before ends in the middle, but for the rapids.
    let feed = drawn(&[PlotQuantity::Feed], PlotAbscissa::Time);
    let found = ends(&feed);
    assert!(
        found.iter().any(|end| (630.0..680.0).contains(end)) && found.iter().any(|end| *end > 1170.0),
        "{found:?}"
    );
    // Along the path both end at the same place.
    let path = ends(&drawn(&[PlotQuantity::Z], PlotAbscissa::Path));
    assert!(path.iter().filter(|end| **end > 1170.0).count() >= 2, "{path:?}");
}

#[test]
fn the_same_bytes_as_svg_and_as_png() {
    let svg = drawn(&[PlotQuantity::Chip, PlotQuantity::Z], PlotAbscissa::Path);
    assert_eq!(svg, drawn(&[PlotQuantity::Chip, PlotQuantity::Z], PlotAbscissa::Path));
    let picture = render_png(&svg).unwrap();
    assert!(picture == render_png(&svg).unwrap());
    assert_eq!(&picture[..8], b"\x89PNG\r\n\x1a\n");
    let size = |at: usize| u32::from_be_bytes(picture[at..at + 4].try_into().unwrap());
    assert_eq!((size(16), size(20)), (2400, 1600));
    // The letters are drawn: without them the picture is another.
    let mute = svg.replace("thickest chip", "").replace("path, mm", "");
    assert!(render_png(&mute).unwrap() != picture);
    assert!(render_png("no drawing").is_err());
}
