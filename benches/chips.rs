//! How many layer sections of five-axis chips a second: `cargo bench --bench chips`.
//!
//! A flat end mill of 10 mm winds through a block in steps of 0.5 mm while its axis turns by a degree or two each, 8 mm deep in layers of
//! 0.5 mm. Single thread, by time of the processor. Beside it the brute force: the union of sections sampled along the step, in halves and
//! halves of those, with more and more samples up to 2,000, and with finer chords.

// A benchmark that cannot make its block has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::engagement::PathPiece;
use clsmith::layered_chips::{
    BoundaryDiagram, FlatMill, LayerStack, LayerSweptArea, MillStep, Polygon, RimDirections, SectionFamily,
    cut_chips,
};
use clsmith::program::geometry::Pose;
use clsmith::stock::{SolidBody, Stock};
use geo::{Area, BooleanOps, Coord, LineString, MultiPolygon};
use nalgebra::{Point3, Vector3};
use std::hint::black_box;
use std::time::Instant;

const MILL: FlatMill = FlatMill { radius_mm: 5.0, flute_length_mm: f64::INFINITY };
const TOLERANCE: f64 = 0.002;

/// Seconds of the processor that this process has used (Linux), else by the clock.
fn seconds(start: Instant) -> f64 {
    let used = || {
        let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
        let mut fields = stat.rsplit(')').next()?.split_whitespace().skip(11);
        let ticks: f64 = fields.next()?.parse::<f64>().ok()? + fields.next()?.parse::<f64>().ok()?;
        Some(ticks / 100.0)
    };
    used().unwrap_or_else(|| start.elapsed().as_secs_f64())
}

fn timed<T>(start: Instant, work: impl FnOnce() -> T) -> (T, f64) {
    let before = seconds(start);
    let done = work();
    (done, (seconds(start) - before).max(0.01))
}

/// A path that winds, with an axis that leans and swings.
fn path(count: usize) -> Vec<PathPiece> {
    let place = |index: usize| {
        let s = index as f64 * 0.5;
        let (lean, towards) = (0.25 + 0.2 * (s / 9.0).sin(), s / 15.0);
        let axis = Vector3::new(lean.sin() * towards.cos(), lean.sin() * towards.sin(), lean.cos());
        Pose { point: Point3::new(s, 12.0 * (s / 20.0).sin(), -8.0 + (s / 11.0).cos()), axis }
    };
    (0..count).map(|index| PathPiece { from: place(index), to: place(index + 1), cutter: 0 }).collect()
}

fn layers() -> impl Iterator<Item = f64> {
    (0..20).map(|index| -9.75 + 0.5 * f64::from(index))
}

fn diagrams(pieces: &[PathPiece]) -> Vec<BoundaryDiagram> {
    let steps = pieces.iter().map(|piece| MillStep::new(MILL, piece).expect("a step that can be modelled"));
    steps
        .flat_map(|step| layers().map(move |z| BoundaryDiagram::new(&SectionFamily::new(&step, z))))
        .collect()
}

fn covers(pieces: &[PathPiece], tolerance: f64) -> Vec<LayerSweptArea> {
    let mut all = Vec::new();
    for piece in pieces {
        let step = MillStep::new(MILL, piece).expect("a step that can be modelled");
        let rim = RimDirections::new(&step, tolerance);
        for z in layers() {
            all.push(LayerSweptArea::new(&BoundaryDiagram::new(&SectionFamily::new(&step, z)), &rim));
        }
    }
    all
}

fn polygon(border: &[[f64; 2]]) -> MultiPolygon {
    let ring: LineString = border.iter().map(|[x, y]| Coord { x: *x, y: *y }).collect();
    MultiPolygon::new(vec![geo::Polygon::new(ring, Vec::new())])
}

fn union(sections: &[Vec<[f64; 2]>]) -> MultiPolygon {
    match sections {
        [] => MultiPolygon::new(Vec::new()),
        [border] => polygon(border),
        _ => {
            let (one, other) = sections.split_at(sections.len() / 2);
            union(one).union(&union(other))
        }
    }
}

/// Area covered but not at first, from `count` sections.
fn dense(piece: &PathPiece, z: f64, count: usize, tolerance: f64) -> f64 {
    let step = MillStep::new(MILL, piece).expect("a step that can be modelled");
    let (family, rim) = (SectionFamily::new(&step, z), RimDirections::new(&step, tolerance));
    let mut sections = LayerSweptArea::sections_at_slices(&family, &rim, count);
    let first = sections.first().cloned().unwrap_or_default();
    sections.retain(|border| border.len() > 2);
    union(&sections).difference(&polygon(&first)).unsigned_area()
}

fn main() {
    let start = Instant::now();
    let pieces = path(400);
    let (diagrams, took) = timed(start, || black_box(diagrams(&pieces)));
    println!("diagrams: {:.0} a second", diagrams.len() as f64 / took);
    let (all, took) = timed(start, || black_box(covers(&pieces, TOLERANCE)));
    let touched = all.iter().filter(|cover| !cover.is_empty()).count();
    println!(
        "covered areas: {:.0} a second ({touched} of {} layers reached)",
        touched as f64 / took,
        all.len()
    );

    let block = SolidBody::Block { from: [-20.0, -30.0, -10.0], to: [220.0, 30.0, 0.0] };
    let stock = Stock::new(vec![block], 0.0).expect("a block");
    let mut stack = LayerStack::new(&stock, 0.5).expect("layers");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let (chips, took) = timed(start, || pool.install(|| cut_chips(&mut stack, &[MILL], &pieces, TOLERANCE)));
    let sections: usize = chips.iter().flatten().map(|chip| chip.layers.len()).sum();
    let volume: f64 = chips.iter().flatten().map(|chip| chip.volume_mm3()).sum();
    let borders: usize =
        stack.layers().iter().flat_map(|layer| layer.remaining_polygons()).map(|p| corners(&p)).sum();
    println!(
        "chips taken from a block: {:.0} layer sections a second, {:.0} moves a second ({sections} sections, {volume:.0} mm3, {borders} corners left)",
        sections as f64 / took,
        pieces.len() as f64 / took
    );

    // A few steps against the brute force.
    let few: Vec<(&PathPiece, f64)> =
        pieces.iter().step_by(37).flat_map(|piece| [(piece, -6.25), (piece, -2.25)]).collect();
    let truth: Vec<f64> = few.iter().map(|(piece, z)| dense(piece, *z, 4000, TOLERANCE / 20.0)).collect();
    let error = |found: &[f64]| {
        let off = found.iter().zip(&truth).map(|(found, truth)| (found / truth - 1.0).abs());
        off.fold(0.0, f64::max)
    };
    let area = |cover: &LayerSweptArea| {
        let mut one = LayerStack::new(
            &Stock::new(vec![SolidBody::Block { from: [-100.0, -100.0, 0.0], to: [300.0, 100.0, 1.0] }], 0.0)
                .expect("a block"),
            1.0,
        )
        .expect("a layer");
        let layer = one.layers_mut().first_mut().map(|layer| layer.remove_swept_area(cover));
        layer.map_or(0.0, |removed| removed.area_mm2)
    };
    let ours: Vec<f64> = few
        .iter()
        .map(|(piece, z)| {
            let step = MillStep::new(MILL, piece).expect("a step that can be modelled");
            area(&LayerSweptArea::new(
                &BoundaryDiagram::new(&SectionFamily::new(&step, *z)),
                &RimDirections::new(&step, TOLERANCE),
            ))
        })
        .collect();
    let goal = error(&ours);
    let rate = sections as f64 / took;
    println!("largest error in area: {:.5} %", goal * 100.0);
    // Finer chords than the chips', too, for with theirs the union of sections never becomes as exact.
    for tolerance in [TOLERANCE, TOLERANCE / 8.0] {
        for count in [25, 50, 100, 200, 500, 2000] {
            let (found, took) = timed(start, || {
                few.iter().map(|(piece, z)| dense(piece, *z, count, tolerance)).collect::<Vec<_>>()
            });
            let brute = few.len() as f64 / took;
            let reaches = match error(&found) {
                off if off <= goal => " (as exact as the chips)",
                off if off <= 1e-3 => " (within 0.1 %)",
                _ => "",
            };
            println!(
                "brute force, chords within {tolerance}, {count:>4} sections: {brute:>6.1} a second, error {:.4} %{reaches}, \
                 chips are {:.0} times as fast",
                error(&found) * 100.0,
                rate / brute
            );
        }
    }
}

fn corners(polygon: &Polygon) -> usize {
    polygon.outer.len() + polygon.holes.iter().map(Vec::len).sum::<usize>()
}
