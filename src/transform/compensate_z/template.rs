//! The record that new arcs are modelled on.

use crate::program::record::{ArcSense, Circle};
use crate::program::{ArcRule, Program, Record};

/// A CIRCLE that new ones are modelled on.
pub(super) struct Template {
    pub statement: usize,
    /// Whether it prints its radius.
    pub has_radius: bool,
    /// 1 where the printed axis is right-hand, -1 where it is left-hand.
    pub hand: f64,
}

/// The first CIRCLE of the file whose sense is known.
pub(super) fn template(program: &Program) -> Option<Template> {
    let hand = match program.dialect().arc_rule() {
        ArcRule::LeftHand => -1.0,
        ArcRule::RightHand => 1.0,
        ArcRule::ByWord | ArcRule::FromTangent => return None,
    };
    let plain = |circle: &Circle| circle.times <= 1 && circle.sense == ArcSense::OfDialect;
    program.live().find_map(|(statement, found)| match found.record() {
        Record::Circle(circle) if plain(circle) => {
            Some(Template { statement, has_radius: circle.radius.is_some(), hand })
        }
        _ => None,
    })
}
