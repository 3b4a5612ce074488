//! Areas on the grid.

use super::brute;
use clsmith::internals::layered_chips::area::{AreaGrid, Clipper, GridArea, signed_area_mm2};
use clsmith::layered_chips::Polygon;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn grid() -> AreaGrid {
    AreaGrid::around_box([-50.0; 2], [50.0; 2]).unwrap()
}

pub fn circle([x, y]: [f64; 2], radius: f64, corners: usize) -> Vec<[f64; 2]> {
    let place = |index| {
        let (sin, cos) = (TAU * index as f64 / corners as f64).sin_cos();
        [x + radius * cos, y + radius * sin]
    };
    (0..corners).map(place).collect()
}

pub fn square([x, y]: [f64; 2], size: f64) -> Vec<[f64; 2]> {
    vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size]]
}

pub fn turned(mut border: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    border.reverse();
    border
}

fn region(borders: &[Vec<[f64; 2]>]) -> GridArea {
    GridArea::new(&grid(), borders.iter().map(Vec::as_slice))
}

fn cut(area: &GridArea, along: &GridArea) -> [GridArea; 2] {
    let (mut inside, mut outside) = (GridArea::default(), GridArea::default());
    if !Clipper::default().split_area(area, along, &mut inside, &mut outside) {
        assert!(inside.is_empty() && outside.is_empty());
        outside = area.clone();
    }
    [inside, outside]
}

fn polygons(area: &GridArea) -> Vec<Polygon> {
    Clipper::default().extract_polygons(area, &grid()).0
}

#[test]
fn steps_are_a_millionth_up_to_a_metre_and_double_beyond() {
    let step = |size: f64| AreaGrid::around_box([0.0; 2], [size, 1.0]).map(|grid| grid.step_mm());
    let finest = 2f64.powi(-20);
    assert_eq!(step(1.0), Some(finest));
    assert_eq!(step(1000.0), Some(finest));
    assert_eq!(step(2000.0), Some(2.0 * finest));
    assert_eq!(step(130_000.0), Some(2f64.powi(-13)));
    assert_eq!(step(140_000.0), None);
    assert_eq!(step(f64::NAN), None);
    assert_eq!(step(f64::INFINITY), None);
}

#[test]
fn round_fractions_are_exact() {
    let border = vec![[-3.25, 1.5], [7.125, 1.5], [7.125, 9.75], [-3.25, 9.75]];
    let found = polygons(&region(std::slice::from_ref(&border)));
    assert_eq!(found.len(), 1);
    let mut corners = found[0].outer.clone();
    let mut expected = border.clone();
    corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
    expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(corners, expected);
    assert_eq!(region(&[border]).area_mm2(&grid()), 10.375 * 8.25);
}

#[test]
fn a_square_cut_along_a_circle() {
    let [inside, outside] = cut(&region(&[square([0.0; 2], 10.0)]), &region(&[circle([5.0, 5.0], 3.0, 200)]));
    let disc = signed_area_mm2(&circle([5.0, 5.0], 3.0, 200));
    assert!((inside.area_mm2(&grid()) - disc).abs() < 1e-5);
    assert!((outside.area_mm2(&grid()) - (100.0 - disc)).abs() < 1e-5);
    let found = polygons(&outside);
    assert_eq!((found.len(), found[0].holes.len()), (1, 1));
    assert!(signed_area_mm2(&found[0].outer) > 0.0 && signed_area_mm2(&found[0].holes[0]) < 0.0);
    assert!((found[0].area_mm2() - (100.0 - disc)).abs() < 1e-5);
}

#[test]
fn borders_count_where_they_wind_at_all() {
    // Twice around the same place, and another one that overlaps it.
    let borders = [square([0.0; 2], 4.0), square([0.0; 2], 4.0), square([2.0, 2.0], 4.0)];
    let [inside, outside] = cut(&region(&[square([-10.0; 2], 30.0)]), &region(&borders));
    assert!((inside.area_mm2(&grid()) - 28.0).abs() < 1e-9);
    assert!((outside.area_mm2(&grid()) - 872.0).abs() < 1e-9);
    assert_eq!(polygons(&region(&borders)).len(), 1);
}

#[test]
fn pieces_are_apart_and_know_their_holes() {
    let borders = [
        square([0.0; 2], 10.0),
        turned(square([1.0; 2], 3.0)),
        turned(square([5.0; 2], 3.0)),
        square([2.0; 2], 1.0),
        square([20.0, 0.0], 1.0),
    ];
    let mut found = polygons(&region(&borders));
    found.sort_by(|a, b| a.area_mm2().total_cmp(&b.area_mm2()));
    let areas: Vec<(f64, usize)> = found.iter().map(|piece| (piece.area_mm2(), piece.holes.len())).collect();
    assert_eq!(areas, [(1.0, 0), (1.0, 0), (82.0, 2)]);
}

#[test]
fn what_has_no_area_is_nothing() {
    let line = vec![[0.0, 0.0], [5.0, 5.0], [1.0, 1.0]];
    let thin = vec![[0.0, 0.0], [5.0, 1e-7], [5.0, 2e-7]];
    for border in [line, thin, vec![], vec![[1.0, 1.0]], vec![[f64::NAN, 0.0], [1.0, 0.0], [0.0, 1.0]]] {
        let [inside, _] = cut(&region(&[square([-10.0; 2], 30.0)]), &region(&[border]));
        assert!(inside.is_empty());
    }
    let [inside, outside] = cut(&region(&[]), &region(&[square([0.0; 2], 1.0)]));
    assert!(inside.is_empty() && outside.is_empty());
}

#[test]
fn borders_far_beyond_the_grid_are_cut_off() {
    let part = region(&[square([-50.0; 2], 100.0)]);
    let far = [vec![[0.0, -1e7], [1e7, -1e7], [1e7, 1e7], [0.0, 1e7]]];
    let [inside, outside] = cut(&part, &region(&far));
    assert_eq!(inside.area_mm2(&grid()), 5000.0);
    assert_eq!(outside.area_mm2(&grid()), 5000.0);
    let slope = [vec![[-1e5, -1e5], [1e5, 1e5], [-1e5, 1e5]]];
    assert!((cut(&part, &region(&slope))[0].area_mm2(&grid()) - 5000.0).abs() < 1e-3);
    assert!(cut(&part, &region(&[square([1e6; 2], 1e5)]))[0].is_empty());
    let around = [square([-1e6; 2], 2e6)];
    assert_eq!(cut(&part, &region(&around))[0].area_mm2(&grid()), 10000.0);
}

prop_compose! {
    /// A star-shaped border.
    pub fn star()(
        center in prop::array::uniform2(-30.0..30.0),
        radii in prop::collection::vec(1.0..15.0f64, 3..40),
        from in 0.0..TAU,
    ) -> Vec<[f64; 2]> {
        let [x, y] = center;
        let count = radii.len();
        let place = |(index, radius): (usize, f64)| {
            let (sin, cos) = (from + TAU * index as f64 / count as f64).sin_cos();
            [x + radius * cos, y + radius * sin]
        };
        radii.into_iter().enumerate().map(place).collect()
    }
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn inside_and_outside_are_all(
        area in prop::collection::vec(star(), 1..6),
        along in prop::collection::vec(star(), 1..4),
    ) {
        let whole = Clipper::default().unite_boundaries(&region(&area));
        let [inside, outside] = cut(&whole, &region(&along));
        let [a, b, c] = [&whole, &inside, &outside].map(|part| part.area_mm2(&grid()));
        prop_assert!((a - b - c).abs() < 1e-3, "{a} {b} {c}");
        let (one, other) = (brute::dense_union(&area), brute::dense_union(&along));
        prop_assert!((brute::area(&brute::intersection(&one, &other)) - b).abs() < 1e-3);
        prop_assert!((brute::area(&brute::difference(&one, &other)) - c).abs() < 1e-3);
        // Connected, apart, with borders the right way round.
        for piece in polygons(&outside) {
            prop_assert!(piece.area_mm2() > 0.0 && signed_area_mm2(&piece.outer) > 0.0);
            prop_assert!(piece.holes.iter().all(|hole| signed_area_mm2(hole) < 0.0));
        }
        prop_assert!(cut(&outside, &region(&along))[0].area_mm2(&grid()) < 1e-4);
    }
}

#[test]
fn a_polygons_area_is_its_border_less_its_holes() {
    let piece = Polygon {
        outer: square([1e5, 1e5], 4.0),
        holes: vec![turned(circle([1e5 + 2.0, 1e5 + 2.0], 1.0, 2000))],
    };
    assert!((piece.area_mm2() - (16.0 - PI)).abs() < 1e-4);
}
