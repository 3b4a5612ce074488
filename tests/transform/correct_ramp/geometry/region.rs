//! Where the tool may go.

use clsmith::internals::transform::correct_ramp::tool_region::{ToolRegion, ToolRegionError};
use nalgebra::Point2;

/// A square of 30 mm with a notch from above, 10 mm wide and 20 mm deep.
const NOTCHED: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [30.0, 0.0],
    [30.0, 30.0],
    [20.0, 30.0],
    [20.0, 10.0],
    [10.0, 10.0],
    [10.0, 30.0],
    [0.0, 30.0],
];

fn holds(region: &ToolRegion, path: &[[f64; 2]]) -> bool {
    region.contains_path(&path.iter().map(|place| Point2::from(*place)).collect::<Vec<_>>())
}

#[test]
fn corners_that_enclose_no_single_area_are_refused() {
    let refused = |corners: &[[f64; 2]]| ToolRegion::from_polygon(corners).unwrap_err();
    assert_eq!(refused(&[]), ToolRegionError::TooFew);
    assert_eq!(refused(&[[0.0, 0.0], [1.0, 0.0]]), ToolRegionError::TooFew);
    assert_eq!(refused(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]), ToolRegionError::TooFew);
    assert_eq!(refused(&[[0.0, 0.0], [10.0, 10.0], [10.0, 0.0], [0.0, 10.0]]), ToolRegionError::Crossing);
    assert_eq!(refused(&[[0.0, 0.0], [5.0, 5.0], [10.0, 10.0]]), ToolRegionError::Crossing);
    assert_eq!(refused(&[[3.0, 3.0]; 4]), ToolRegionError::Crossing);
    assert_eq!(refused(&[[0.0, 0.0], [f64::NAN, 5.0], [10.0, 0.0]]), ToolRegionError::Crossing);
    assert_eq!(refused(&[[0.0, 0.0], [f64::INFINITY, 5.0], [10.0, 0.0]]), ToolRegionError::Crossing);
}

#[test]
fn either_way_around_and_with_or_without_the_first_corner_again() {
    let mut corners = NOTCHED.to_vec();
    for _ in 0..2 {
        assert!(holds(&ToolRegion::from_polygon(&corners).unwrap(), &[[1.0, 1.0], [29.0, 9.0]]));
        corners.reverse();
    }
    corners.push(corners[0]);
    assert!(holds(&ToolRegion::from_polygon(&corners).unwrap(), &[[1.0, 1.0], [29.0, 9.0]]));
}

#[test]
fn a_way_over_a_notch_leaves_it_though_both_ends_are_inside() {
    let region = ToolRegion::from_polygon(&NOTCHED).unwrap();
    assert!(!holds(&region, &[[5.0, 20.0], [25.0, 20.0]]));
    assert!(!holds(&region, &[[5.0, 30.0], [25.0, 30.0]]), "along the border's line, over the notch");
    assert!(!holds(&region, &[[9.0, 11.5], [12.0, 8.5], [9.0, 20.0]]), "over a corner of the notch");
    assert!(holds(&region, &[[5.0, 20.0], [5.0, 5.0], [25.0, 5.0], [25.0, 20.0]]));
    assert!(holds(&region, &[[5.0, 15.0], [10.0, 10.0], [15.0, 5.0]]), "touching a corner from inside");
    assert!(!holds(&region, &[[5.0, 5.0], [31.0, 5.0]]));
    assert!(!holds(&region, &[[-5.0, 5.0], [35.0, 5.0]]));
}

#[test]
fn the_border_belongs_to_it() {
    let region = ToolRegion::from_polygon(&NOTCHED).unwrap();
    let border: Vec<[f64; 2]> = NOTCHED.iter().copied().chain([NOTCHED[0]]).collect();
    assert!(holds(&region, &border));
    assert!(holds(&region, &[[0.0, -0.9e-5], [30.0, -0.9e-5]]), "as far as rounding goes");
    assert!(!holds(&region, &[[0.0, -1.1e-5], [30.0, -1.1e-5]]));
}

#[test]
fn a_way_that_stays_in_one_place_is_where_it_is() {
    let region = ToolRegion::from_polygon(&NOTCHED).unwrap();
    assert!(holds(&region, &[[5.0, 5.0], [5.0, 5.0]]));
    assert!(!holds(&region, &[[15.0, 15.0], [15.0, 15.0]]));
}

#[test]
fn a_hull_of_points_in_line_is_the_line() {
    let hull = |points: &[[f64; 2]]| ToolRegion::from_hull(points.iter().map(|place| Point2::from(*place)));
    let line = hull(&[[0.0, 0.0], [2.0, 2.0], [8.0, 8.0], [5.0, 5.0]]);
    assert!(holds(&line, &[[1.0, 1.0], [8.0, 8.0]]));
    assert!(!holds(&line, &[[1.0, 1.0], [9.0, 9.0]]));
    assert!(!holds(&line, &[[1.0, 1.0], [4.0, 4.1]]));
    let point = hull(&[[3.0, 3.0], [3.0, 3.0]]);
    assert!(holds(&point, &[[3.0, 3.0], [3.0, 3.0]]) && !holds(&point, &[[3.0, 3.0], [4.0, 3.0]]));
    assert!(!holds(&hull(&[]), &[[0.0, 0.0], [1.0, 0.0]]), "nothing holds nothing");
    assert!(!holds(&hull(&[[f64::NAN, 0.0]]), &[[0.0, 0.0], [1.0, 0.0]]));
    assert!(holds(&ToolRegion::Everywhere, &[[0.0, 0.0], [1e9, 0.0]]));
}

#[test]
fn a_hull_bridges_what_its_points_leave_open() {
    let hull = ToolRegion::from_hull(NOTCHED.iter().map(|place| Point2::from(*place)));
    assert!(holds(&hull, &[[5.0, 20.0], [25.0, 20.0], [15.0, 30.0]]));
    assert!(!holds(&hull, &[[5.0, 20.0], [15.0, 30.1]]));
}
