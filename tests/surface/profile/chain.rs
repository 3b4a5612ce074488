//! What makes a chain.

use clsmith::internals::surface::profile::{Chain, ChainError, ChainPiece, LARGEST, Point};
use std::f64::consts::PI;

const O: Point = Point::new(0.0, 0.0);

#[test]
fn pieces_must_meet() {
    let line = ChainPiece::line(O, Point::new(1.0, 0.0));
    let arc = ChainPiece::arc(Point::new(1.0, 1.0), 1.0, -PI / 2.0, PI / 2.0);
    let chain = Chain::new(vec![line, arc]).unwrap();
    assert!(chain.end().distance(Point::new(2.0, 1.0)) < 1e-12);
    assert!((chain.length_mm() - 1.0 - PI / 2.0).abs() < 1e-12);
    assert_eq!(chain.vertices().count(), 3);
    let apart = Chain::new(vec![line, arc.shifted(0.0, 2e-6)]);
    assert!(matches!(apart, Err(ChainError::Gap { piece: 1, gap }) if (gap - 2e-6).abs() < 1e-9));
    assert!(Chain::new(vec![line, arc.shifted(0.0, 0.9e-6)]).is_ok());
}

#[test]
fn numbers_must_be_numbers() {
    assert_eq!(Chain::new(vec![]), Err(ChainError::Empty));
    assert_eq!(Chain::from_points(&[O]), Err(ChainError::Empty));
    for wrong in [f64::NAN, f64::INFINITY, 2.0 * LARGEST] {
        let ends = [O, Point::new(1.0, 0.0), Point::new(1.0, wrong)];
        assert_eq!(Chain::from_points(&ends), Err(ChainError::Number { piece: 1 }));
        assert_eq!(
            Chain::new(vec![ChainPiece::arc(O, 1.0, wrong, 1.0)]),
            Err(ChainError::Number { piece: 0 })
        );
    }
    assert_eq!(Chain::new(vec![ChainPiece::arc(O, 0.0, 0.0, 1.0)]), Err(ChainError::Arc { piece: 0 }));
    assert_eq!(Chain::new(vec![ChainPiece::arc(O, 1.0, 0.0, 7.0)]), Err(ChainError::Arc { piece: 0 }));
}

#[test]
fn turned_and_moved() {
    let arc = ChainPiece::arc(Point::new(1.0, 2.0), 3.0, 0.5, -1.5);
    let chain = Chain::new(vec![arc, ChainPiece::line(arc.end(), Point::new(9.0, 9.0))]).unwrap();
    assert_eq!(chain.reversed().start(), Point::new(9.0, 9.0));
    assert!(chain.reversed().reversed().end().distance(chain.end()) < 1e-12);
    let over = chain.flipped();
    assert!(over.start().distance(Point::new(chain.start().u, -chain.start().z)) < 1e-12);
    assert!(over.pieces()[0].end().distance(over.pieces()[1].start()) < 1e-12);
    assert!(chain.tip_to_centre(5.0).centre_to_tip(5.0).end().distance(chain.end()) < 1e-12);
    let half = arc.sub_piece(0.0, 0.5);
    assert!(half.end().distance(arc.point_at(0.5)) < 1e-12);
    let (a, b) = (arc.point_at(0.4999), arc.point_at(0.5001));
    let direction = arc.direction_at(0.5);
    assert!(((b.u - a.u) * direction.u + (b.z - a.z) * direction.z - a.distance(b)).abs() < 1e-9);
}
