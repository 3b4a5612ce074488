//! How many heights a second a lowered cutter finds: `cargo bench --bench surface`.
//!
//! A wavy block of 100 x 100 mm whose top has 20,000 or 180,000 triangles of one size, a cutter of 10 mm, places in rows 0.5 mm apart
//! (as a path asks for them) and strewn. Single thread, by time of the processor, so that what else runs does not count.

// A benchmark that cannot make its mesh has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::internals::surface::drop_cutter::{CutterClearanceField, DropCutter, DropCutterShape};
use clsmith::internals::surface::mesh_section::VerticalMeshSections;
use clsmith::stock::Mesh;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

/// A block from z = -20 up to waves around 0, with `side` squares of two triangles along each side.
fn waves(side: u32) -> Mesh {
    let height = |x: f64, y: f64| 4.0 * (x * TAU / 45.0).sin() * (y * TAU / 60.0).cos();
    let at =
        |i: u32, j: u32| [100.0 * f64::from(i) / f64::from(side), 100.0 * f64::from(j) / f64::from(side)];
    let row = side + 1;
    let layer = row * row;
    let places = || (0..row).flat_map(|j| (0..row).map(move |i| at(i, j)));
    let mut vertices: Vec<[f64; 3]> = places().map(|[x, y]| [x, y, height(x, y)]).collect();
    vertices.extend(places().map(|[x, y]| [x, y, -20.0]));
    let mut triangles = Vec::new();
    for j in 0..side {
        for i in 0..side {
            let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| j * row + i);
            triangles.extend([
                [a, b, c],
                [a, c, d],
                [a + layer, c + layer, b + layer],
                [a + layer, d + layer, c + layer],
            ]);
        }
        let walls = [
            (j, j + 1),
            (side * row + j + 1, side * row + j),
            ((j + 1) * row, j * row),
            (j * row + side, (j + 1) * row + side),
        ];
        for (from, to) in walls {
            triangles.extend([[from, from + layer, to + layer], [from, to + layer, to]]);
        }
    }
    Mesh::new(vertices, triangles).expect("a closed block")
}

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

fn timed<T>(mut work: impl FnMut() -> T) -> f64 {
    let start = Instant::now();
    let before = seconds(start);
    black_box(work());
    seconds(start) - before
}

fn main() {
    let rows: Vec<[f64; 2]> =
        (0..200).flat_map(|j| (0..1000).map(move |i| [0.1 * f64::from(i), 0.5 * f64::from(j)])).collect();
    // Steps by the golden ratio and another irrational strew evenly, and always alike.
    let strewn: Vec<[f64; 2]> = (0..200_000_u32)
        .map(|i| {
            [0.618_033_988_749_895, 0.414_213_562_373_095].map(|step| 100.0 * (f64::from(i) * step).fract())
        })
        .collect();
    println!(
        "{:<10}{:>10}{:>10}{:>14}{:>14}{:>16}",
        "cutter", "top", "sort s", "rows /s", "strewn /s", "follow mm/s"
    );
    for side in [100, 300] {
        let mesh = waves(side);
        for (name, corner) in [("ball", 5.0), ("bull R1", 1.0), ("flat", 0.0)] {
            let cutter = DropCutterShape::new(10.0, corner).expect("a cutter");
            let sort = timed(|| DropCutter::new(&mesh, cutter));
            let drop = DropCutter::new(&mesh, cutter);
            let rate = |places: &[[f64; 2]]| {
                let heights =
                    || places.iter().filter_map(|[x, y]| drop.drop_at(*x, *y)).map(|drop| drop.tip_z_mm);
                places.len() as f64 / timed(|| heights().sum::<f64>()).max(1e-9)
            };
            let (rows, strewn) = (rate(&rows), rate(&strewn));
            let passes: Vec<[[f64; 2]; 2]> =
                (0..20).map(|j| 2.5 + 5.0 * f64::from(j)).map(|y| [[0.0, y], [100.0, y]]).collect();
            let followed =
                timed(|| passes.iter().map(|pass| drop.follow_line(pass, 0.01)).collect::<Vec<_>>());
            let follow = 2000.0 / followed.max(1e-9);
            println!("{name:<10}{:>10}{sort:>10.2}{rows:>14.0}{strewn:>14.0}{follow:>16.0}", side * side * 2);
        }
        // The proof of `compensate_z`: 64 passes of 200 points, within a hundredth.
        for (name, corner) in [("bull R1", 1.0), ("flat", 0.0)] {
            let cutter = DropCutterShape::new(10.0, corner).expect("a cutter");
            let drop = DropCutter::new(&mesh, cutter);
            let tip = |x: f64, y: f64| drop.drop_at(x, y).map_or(0.0, |drop| drop.tip_z_mm);
            let passes: Vec<Vec<[f64; 3]>> = (0..64)
                .map(|j| 2.0 + 1.5 * f64::from(j))
                .map(|y| (0..200).map(|i| 0.5 * f64::from(i)).map(|x| [x, y, tip(x, y)]).collect())
                .collect();
            let proved = timed(|| {
                let field = CutterClearanceField::new(&mesh, cutter);
                let step = field.widest_step_mm(0.001).max(0.01);
                passes.iter().filter_map(|pass| field.measure_path(pass, step, 0.01)).count()
            });
            println!("{:<10}{:>10}{proved:>10.2}  s for the proof of 12,800 points", name, side * side * 2);
        }
        let cut = timed(|| VerticalMeshSections::new(&mesh, 0.3));
        let sections = VerticalMeshSections::new(&mesh, 0.3);
        let count = 200;
        let rate = f64::from(count)
            / timed(|| (0..count).map(|i| sections.section_at(0.3 * f64::from(i)).len()).sum::<usize>())
                .max(1e-9);
        println!("{:<10}{:>10}{cut:>10.2}{rate:>14.0}", "sections", side * side * 2);
    }
}
