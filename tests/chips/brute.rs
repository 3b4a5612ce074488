//! Areas by brute force, with other means than the library's own.

use clsmith::internals::layered_chips::area::signed_area_mm2;
use clsmith::layered_chips::Polygon;
use geo::{Area, BooleanOps, Coord, LineString, MultiPolygon, unary_union};

/// Everything that is inside one of many sections, closed borders of x, y in mm.
pub fn dense_union(sections: &[Vec<[f64; 2]>]) -> Vec<Polygon> {
    polygons(union(sections))
}

/// What is inside one of some polygons and in none of others.
pub fn difference(of: &[Polygon], less: &[Polygon]) -> Vec<Polygon> {
    polygons(plane(of).difference(&plane(less)))
}

/// What is inside one of some polygons and one of others.
pub fn intersection(one: &[Polygon], other: &[Polygon]) -> Vec<Polygon> {
    polygons(plane(one).intersection(&plane(other)))
}

/// Area of all, mm2.
pub fn area(of: &[Polygon]) -> f64 {
    plane(of).unsigned_area()
}

/// By halves: neighbouring sections are alike, so their unions stay small.
fn union(sections: &[Vec<[f64; 2]>]) -> MultiPolygon {
    if sections.len() <= 4 {
        let all: Vec<geo::Polygon> =
            sections.iter().map(|border| geo::Polygon::new(line(border), Vec::new())).collect();
        return unary_union(&all);
    }
    let (one, other) = sections.split_at(sections.len() / 2);
    unary_union(&[union(one), union(other)])
}

fn plane(of: &[Polygon]) -> MultiPolygon {
    let polygon = |polygon: &Polygon| {
        geo::Polygon::new(line(&polygon.outer), polygon.holes.iter().map(|hole| line(hole)).collect())
    };
    of.iter().map(polygon).collect()
}

fn line(border: &[[f64; 2]]) -> LineString {
    border.iter().map(|[x, y]| Coord { x: *x, y: *y }).collect()
}

fn polygons(of: MultiPolygon) -> Vec<Polygon> {
    let border = |line: &LineString, outer: bool| {
        let mut border: Vec<[f64; 2]> = line.coords().map(|at| [at.x, at.y]).collect();
        border.pop();
        if (signed_area_mm2(&border) > 0.0) != outer {
            border.reverse();
        }
        border
    };
    let polygon = |polygon: geo::Polygon| Polygon {
        outer: border(polygon.exterior(), true),
        holes: polygon.interiors().iter().map(|hole| border(hole, false)).collect(),
    };
    of.into_iter().map(polygon).collect()
}

#[test]
fn two_squares_and_a_ring() {
    let square =
        |at: f64, size: f64| vec![[at, at], [at + size, at], [at + size, at + size], [at, at + size]];
    let both = dense_union(&[square(0.0, 2.0), square(1.0, 2.0)]);
    assert_eq!(both.len(), 1);
    assert!((area(&both) - 7.0).abs() < 1e-6 && (both[0].area_mm2() - 7.0).abs() < 1e-6);
    let ring = difference(&dense_union(&[square(0.0, 3.0)]), &dense_union(&[square(1.0, 1.0)]));
    assert_eq!(ring[0].holes.len(), 1);
    assert!((ring[0].area_mm2() - 8.0).abs() < 1e-6);
    assert!((area(&intersection(&ring, &both)) - 6.0).abs() < 1e-6);
}
