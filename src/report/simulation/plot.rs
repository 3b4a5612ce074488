//! Chip thickness and feed along time, as a drawing.
//!
//! Two panels one above the other, as in the paper that block-by-block correction comes from: the criterion (the thickest chip of each
//! motion), and the feed. Several programs may be drawn over each other. The drawing has a fixed size and whole coordinates, and
//! needs no fonts, so the same series make the same bytes.

use super::Simulated;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::fmt::Display;
use std::io;

/// Width and height of the drawing.
const SIZE: (u32, u32) = (1200, 800);

/// Height of an axis, in largest values.
const ROOM: f64 = 1.08;

/// The same where the names of the programs stand above.
const ROOM_WITH_NAMES: f64 = 1.35;

/// More motions than this are drawn by the least and largest value of each of as many spans of time.
const MOST: usize = 2000;

/// A program in a drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    /// What it is called.
    pub name: String,
    /// Its motions along time.
    pub moments: Vec<Moment>,
}

/// A motion along time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// When it begins, s.
    pub from: f64,
    /// When it ends, s.
    pub to: f64,
    /// The thickest chip, mm.
    pub chip_thickness_mm: Option<f64>,
    /// The feed, mm/min; `None` in a rapid.
    pub feed_mm_min: Option<f64>,
}

impl Simulated {
    /// The motions along time. A motion whose time is not known, such as a rapid of a machine whose rapid feed nobody says, is left
    /// out.
    pub fn series(&self, name: impl Into<String>) -> Series {
        let mut at = 0.0;
        let timed = self.motions.rows.iter().filter_map(|row| {
            let seconds = row.seconds.filter(|seconds| *seconds > 0.0)?;
            let from = at;
            at += seconds;
            let feed_mm_min = row.feed_mm_min.filter(|_| !row.rapid);
            Some(Moment { from, to: at, chip_thickness_mm: row.chip_thickness_mm, feed_mm_min })
        });
        Series { name: name.into(), moments: timed.collect() }
    }
}

/// Draws programs as SVG. With several, all but the last are grey and stand behind it: what was before, and what is after.
///
/// # Errors
/// What the drawing library returns, which for a drawing in memory is nothing.
pub fn plot(series: &[Series]) -> io::Result<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE).map_err(error)?;
        let panels = root.split_evenly((2, 1));
        let [above, below] = panels.as_slice() else { return Err(io::Error::other("no panels")) };
        panel(above, series, "thickest chip, mm", true, |moment| moment.chip_thickness_mm)?;
        panel(below, series, "feed, mm/min", false, |moment| moment.feed_mm_min)?;
        root.present().map_err(error)?;
    }
    Ok(text)
}

fn panel(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    series: &[Series],
    what: &str,
    names: bool,
    value: impl Fn(&Moment) -> Option<f64> + Copy,
) -> io::Result<()> {
    let moments = || series.iter().flat_map(|series| &series.moments);
    let end = moments().map(|moment| moment.to).fold(0.0, f64::max);
    let most = moments().filter_map(value).fold(0.0, f64::max);
    // Axes without a length would have no marks.
    let [end, most] = [end, most].map(|most| if most > 0.0 && most.is_finite() { most } else { 1.0 });
    let mut chart = ChartBuilder::on(area)
        .margin(16)
        .set_label_area_size(LabelAreaPosition::Left, 80)
        .set_label_area_size(LabelAreaPosition::Bottom, 44)
        .build_cartesian_2d(0.0..end, 0.0..most * if names { ROOM_WITH_NAMES } else { ROOM })
        .map_err(error)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("time, s")
        .y_desc(what)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()
        .map_err(error)?;
    for (index, series) in series.iter().enumerate().map(|(index, one)| (series.len() - index, one)) {
        let color = if index > 1 { RGBColor(170, 170, 170) } else { RGBColor(0, 90, 181) };
        let mut lines = lines(&series.moments, end, value).into_iter();
        let first = lines.next().unwrap_or_default();
        let drawn = chart.draw_series(LineSeries::new(first, color.stroke_width(1))).map_err(error)?;
        drawn
            .label(series.name.as_str())
            .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 18, y)], color.stroke_width(3)));
        for line in lines {
            chart.draw_series(LineSeries::new(line, color.stroke_width(1))).map_err(error)?;
        }
    }
    if !names {
        return Ok(());
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font(("sans-serif", 14))
        .background_style(WHITE)
        .border_style(RGBColor(200, 200, 200))
        .draw()
        .map_err(error)
}

/// A value along time as lines, which end where it is not known.
fn lines(moments: &[Moment], end: f64, value: impl Fn(&Moment) -> Option<f64>) -> Vec<Vec<(f64, f64)>> {
    let mut lines = Lines::default();
    if moments.len() <= MOST {
        for moment in moments {
            lines.go_on(value(moment).map(|value| [(moment.from, value), (moment.to, value)]));
        }
        return lines.end();
    }
    let width = end / MOST as f64;
    let mut spans: Vec<Option<[f64; 2]>> = vec![None; MOST];
    for moment in moments {
        let Some(value) = value(moment) else { continue };
        let first = (moment.from / width) as usize;
        let last = ((moment.to / width) as usize).min(MOST - 1);
        for span in spans.iter_mut().take(last + 1).skip(first) {
            let [least, most] = span.unwrap_or([value; 2]);
            *span = Some([least.min(value), most.max(value)]);
        }
    }
    for (index, span) in spans.into_iter().enumerate() {
        let at = (index as f64 + 0.5) * width;
        lines.go_on(span.map(|[least, most]| [(at, least), (at, most)]));
    }
    lines.end()
}

/// Lines in the making.
#[derive(Default)]
struct Lines {
    done: Vec<Vec<(f64, f64)>>,
    open: Vec<(f64, f64)>,
}

impl Lines {
    fn go_on(&mut self, points: Option<[(f64, f64); 2]>) {
        match points {
            Some(points) => self.open.extend(points),
            None if !self.open.is_empty() => self.done.push(std::mem::take(&mut self.open)),
            None => {}
        }
    }

    fn end(mut self) -> Vec<Vec<(f64, f64)>> {
        self.go_on(None);
        self.done
    }
}

fn error(error: impl Display) -> io::Error {
    io::Error::other(format!("the drawing failed: {error}"))
}
