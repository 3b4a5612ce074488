//! This module converts motions to straight pieces in the workpiece frame, in mm.
//!
//! The workpiece frame is the frame of the program's first motion. The stock stands in it, its dexels stand
//! along its z axis, and motions in another MSYS or CSYS are converted to it.

use super::machine_path::{MachinePath, follow_machine_path};
use super::path_piece::{STILL, slerp_axis};
use crate::engagement::PathPiece;
use crate::program::geometry::Pose;
use crate::program::geometry::{CircularArc, MotionPath, Spline};
use crate::program::motion::{CoordinateFrame, Motion};
use crate::stock::AirClip;
use nalgebra::{Point3, Vector3};
use std::sync::Arc;

/// A piece of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPiece {
    /// The path of the cutter on the piece.
    pub piece: PathPiece,
    /// The position at which the piece begins, as a fraction of the motion's length.
    pub from: f64,
    /// The position at which it ends, as a fraction of the motion's length.
    pub to: f64,
    /// The speed of the tip on the piece by that of the motion as it is programmed. It is 1 but where a machine without
    /// control of the tip takes it beside its line.
    pub pace: f64,
}

/// The largest number of pieces of one motion. With so many, their engagements take about a gigabyte.
pub const MOST_PIECES: usize = 100_000;

/// How often a knot span of a spline is halved at most, which makes 256 chords of it.
const SPLINE_HALVINGS: u32 = 8;

/// Converts motions to pieces.
///
/// A motion that is divided is divided where it is near the stock, if [`PathLinearizer::with_air_clip`] says where
/// that is: a part that is far longer than the stock is cut at its box. A motion has at most [`MOST_PIECES`] pieces;
/// one that would need more is divided less finely, and [`PathLinearizer::take_limit_reached`] says so.
///
/// Motions in another frame than that of the program's first motion (NX's MSYS, a CSYS) are converted to it.
/// Arcs and splines become chords that are at most `sagitta_mm` from the curve, and so do motions that a machine makes in
/// another way than they are programmed ([`PathLinearizer::with_machine_path`]).
#[derive(Debug, Clone)]
pub(crate) struct PathLinearizer {
    mm_per_unit: f64,
    home: Option<Option<CoordinateFrame>>,
    air: Option<AirClip>,
    machine: Option<Arc<dyn MachinePath>>,
    is_limit_reached: bool,
    /// The largest distance of a chord from its curve, mm.
    pub sagitta_mm: f64,
    /// The length of the longest piece, mm.
    pub longest_piece_mm: f64,
}

impl PathLinearizer {
    /// Makes a converter for a file whose lengths are in units of `mm_per_unit` mm.
    pub(crate) fn new(mm_per_unit: f64, sagitta_mm: f64, longest_piece_mm: f64) -> Self {
        Self {
            mm_per_unit,
            home: None,
            air: None,
            machine: None,
            is_limit_reached: false,
            sagitta_mm,
            longest_piece_mm,
        }
    }

    /// Follows the path on which a machine takes the tool, where it is not the programmed one.
    #[must_use]
    pub(crate) fn with_machine_path(self, machine: Option<Arc<dyn MachinePath>>) -> Self {
        Self { machine, ..self }
    }

    /// Returns whether a motion is made in another way than it is programmed.
    pub(crate) fn leaves_programmed_path(&self, number: usize) -> bool {
        self.machine.as_ref().is_some_and(|machine| machine.even_parts(number).is_some())
    }

    /// Cuts long motions where they enter and leave the surroundings of the stock, in the workpiece frame, and divides
    /// no part that is outside.
    #[must_use]
    pub(crate) fn with_air_clip(self, air: AirClip) -> Self {
        Self { air: Some(air), ..self }
    }

    /// Returns whether a motion since the last call would have needed more than [`MOST_PIECES`] pieces.
    pub(crate) fn take_limit_reached(&mut self) -> bool {
        std::mem::take(&mut self.is_limit_reached)
    }

    /// Converts a pose that stands in the frame of a motion to the workpiece frame, in mm.
    pub(crate) fn place_pose(&self, motion: &Motion, pose: Pose) -> Pose {
        self.to_workpiece_frame(motion.frame.as_deref(), pose)
    }

    /// Returns the pose at a fraction of an arc's motion in the workpiece frame, in mm. The ends are those of the motion.
    pub(crate) fn place_on_arc(&self, motion: &Motion, arc: &CircularArc, share: f64) -> Pose {
        let point = match share {
            0.0 => motion.from.point,
            1.0 => motion.to.point,
            _ => arc.point_at(share),
        };
        let turn = motion.from.axis.angle(&motion.to.axis);
        let axis = slerp_axis(&motion.from.axis, &motion.to.axis, turn, share);
        self.place_pose(motion, Pose { point, axis })
    }

    /// Returns the pose at a fraction of a straight motion in the workpiece frame, in mm.
    pub(crate) fn place_on_line(&self, motion: &Motion, share: f64) -> Pose {
        let point = match share {
            1.0 => motion.to.point,
            _ => motion.from.point + (motion.to.point - motion.from.point) * share,
        };
        let turn = motion.from.axis.angle(&motion.to.axis);
        let axis = slerp_axis(&motion.from.axis, &motion.to.axis, turn, share);
        self.place_pose(motion, Pose { point, axis })
    }

    /// Returns how far the end of a motion lies from the end of its arc, mm.
    pub(crate) fn slip_of_arc_mm(&self, motion: &Motion, arc: &CircularArc) -> f64 {
        (motion.to.point - arc.point_at(1.0)).norm() * self.mm_per_unit
    }

    /// Converts a pose of a motion to the workpiece frame, in mm.
    fn to_workpiece_frame(&self, frame: Option<&CoordinateFrame>, pose: Pose) -> Pose {
        let home = self.home.as_ref().and_then(Option::as_ref);
        let same = match (frame, home) {
            (None, None) => true,
            (Some(frame), Some(home)) => (frame.origin, frame.axes) == (home.origin, home.axes),
            _ => false,
        };
        let pose = if same { pose } else { pose_in_frame(home, pose_from_frame(frame, pose)) };
        let axis = pose.axis.try_normalize(1e-9).unwrap_or_else(Vector3::z);
        Pose { point: pose.point * self.mm_per_unit, axis }
    }

    /// Takes the frame of a motion as the workpiece frame if it is the first motion.
    pub(crate) fn adopt_workpiece_frame(&mut self, motion: &Motion) {
        self.home.get_or_insert_with(|| motion.frame.as_deref().cloned());
    }

    /// Adds the pieces of a motion, which is told with its number in the program. A motion that stays at its place has none.
    pub(crate) fn append_pieces(
        &mut self,
        (number, motion): (usize, &Motion),
        cutter: usize,
        out: &mut Vec<MotionPiece>,
    ) {
        self.adopt_workpiece_frame(motion);
        if motion.path == MotionPath::Start {
            return;
        }
        if let Some(places) = self.follow_machine(number, motion) {
            return self.append_machine_pieces(&places, cutter, out);
        }
        let vertices: Vec<Pose> = match self.find_straight_ends(motion) {
            // Nearly every motion of a large program is straight and short.
            Some([from, to]) if self.divide_chord(from.point, to.point, 1).is_empty() => {
                let piece = PathPiece { from, to, cutter };
                return out.push(MotionPiece { piece, from: 0.0, to: 1.0, pace: 1.0 });
            }
            Some(ends) => ends.to_vec(),
            None => self.list_vertices(motion),
        };
        let mut places: Vec<Pose> = Vec::with_capacity(vertices.len());
        for next in vertices {
            if let Some(last) = places.last().copied() {
                let turn = last.axis.angle(&next.axis);
                for share in self.divide_chord(last.point, next.point, places.len()) {
                    let point: Point3<f64> = last.point + (next.point - last.point) * share;
                    places.push(Pose { point, axis: slerp_axis(&last.axis, &next.axis, turn, share) });
                }
            }
            places.push(next);
        }
        let lengths = places.windows(2).map(|pair| match pair {
            [from, to] => (to.point - from.point).norm(),
            _ => 0.0,
        });
        let whole: f64 = lengths.clone().sum();
        let count = places.len().saturating_sub(1).max(1) as f64;
        let mut at = 0.0;
        for (index, (pair, length)) in places.windows(2).zip(lengths).enumerate() {
            let [from, to] = pair else { continue };
            // Positions follow the length; a motion that only turns the axis is divided by count.
            let end = if whole > 0.0 { at + length / whole } else { (index + 1) as f64 / count };
            let end = if index + 2 == places.len() { 1.0 } else { end };
            let piece = PathPiece { from: *from, to: *to, cutter };
            out.push(MotionPiece { piece, from: at, to: end, pace: 1.0 });
            at = end;
        }
    }

    /// Returns the ends of a straight motion as programmed, in the workpiece frame, mm; `None` for another motion.
    fn find_straight_ends(&self, motion: &Motion) -> Option<[Pose; 2]> {
        if motion.path != MotionPath::Line {
            return None;
        }
        let Pose { point, axis } = motion.to;
        let is_turned = axis != motion.from.axis;
        // A turn too small to be told is none, as in `slerp_axis`.
        let is_turned = is_turned && motion.from.axis.angle(&axis) != 0.0;
        let to = Pose { point, axis: if is_turned { axis } else { motion.from.axis } };
        Some([motion.from, to].map(|pose| self.to_workpiece_frame(motion.frame.as_deref(), pose)))
    }

    /// Returns the poses between which a motion as programmed is straight enough, in the workpiece frame, mm.
    fn list_vertices(&mut self, motion: &Motion) -> Vec<Pose> {
        let shares = match &motion.path {
            MotionPath::Start | MotionPath::Line => even_fractions(1),
            MotionPath::Arc(arc) => even_fractions(self.count_chords(arc)),
            MotionPath::Spline(spline) => self.subdivide_spline(spline),
        };
        let point = |share: f64| match &motion.path {
            MotionPath::Arc(arc) => arc.point_at(share),
            MotionPath::Spline(spline) => spline.point_at(share),
            MotionPath::Line | MotionPath::Start => {
                motion.from.point + (motion.to.point - motion.from.point) * share
            }
        };
        let turn = motion.from.axis.angle(&motion.to.axis);
        let place = |share: f64| {
            // The ends are taken from the motion itself, so that neighbouring motions meet without rounding.
            let point = match share {
                0.0 => motion.from.point,
                1.0 => motion.to.point,
                _ => point(share),
            };
            let axis = slerp_axis(&motion.from.axis, &motion.to.axis, turn, share);
            self.to_workpiece_frame(motion.frame.as_deref(), Pose { point, axis })
        };
        shares.into_iter().map(place).collect()
    }

    /// Returns the places of a motion on the path of the machine, each with its share of the motion; `None` where that is
    /// the programmed path.
    fn follow_machine(&self, number: usize, motion: &Motion) -> Option<Vec<(f64, Pose)>> {
        let mut places = follow_machine_path(self.machine.as_deref()?, number, self.sagitta_mm)?;
        // Neighbouring motions meet without rounding.
        if let Some(first) = places.first_mut() {
            first.1 = self.place_pose(motion, motion.from);
        }
        if let Some(last) = places.last_mut() {
            last.1 = self.place_pose(motion, motion.to);
        }
        Some(places)
    }

    /// Adds the pieces between places on the path of a machine. All axes run evenly, so positions follow the time.
    fn append_machine_pieces(&mut self, places: &[(f64, Pose)], cutter: usize, out: &mut Vec<MotionPiece>) {
        let (Some((_, first)), Some((_, last))) = (places.first(), places.last()) else { return };
        let programmed = (last.point - first.point).norm();
        let start = out.len();
        for pair in places.windows(2) {
            let [(from_share, from), (to_share, to)] = pair else { continue };
            let turn = from.axis.angle(&to.axis);
            let mut at = (*from_share, *from);
            let cuts = self.divide_chord(from.point, to.point, out.len() - start);
            for share in cuts.into_iter().chain([1.0]) {
                let point = from.point + (to.point - from.point) * share;
                let next = match share {
                    1.0 => (*to_share, *to),
                    _ => {
                        let axis = slerp_axis(&from.axis, &to.axis, turn, share);
                        (from_share + (to_share - from_share) * share, Pose { point, axis })
                    }
                };
                let as_programmed = programmed * (next.0 - at.0);
                let way = (next.1.point - at.1.point).norm();
                // A tip that is programmed to stand has no speed to compare with.
                let pace = if as_programmed > STILL { way / as_programmed } else { 1.0 };
                let piece = PathPiece { from: at.1, to: next.1, cutter };
                out.push(MotionPiece { piece, from: at.0, to: next.0, pace });
                at = next;
            }
        }
    }

    /// Returns about how many pieces a motion needs if these are more than [`MOST_PIECES`]. It makes no pieces. A
    /// spline that has no more knots than pieces is divided for it, if its pieces have a longest length.
    pub(crate) fn find_too_many_pieces(&mut self, (number, motion): (usize, &Motion)) -> Option<f64> {
        let is_divided = self.longest_piece_mm.is_finite();
        if let Some(places) = self.follow_machine(number, motion) {
            let pieces = places.windows(2).map(|pair| match pair {
                [(_, from), (_, to)] => self.wanted_parts(from.point, to.point).2,
                _ => 0.0,
            });
            return Some(pieces.sum()).filter(|count| *count > MOST_PIECES as f64);
        }
        let shares = match &motion.path {
            MotionPath::Line if is_divided => vec![0.0, 1.0],
            MotionPath::Arc(arc) => {
                let wanted = self.wanted_chords(arc);
                if wanted > MOST_PIECES as f64 {
                    return Some(wanted);
                }
                // Without a longest length, each chord is a piece.
                if is_divided { even_fractions(wanted as usize) } else { return None }
            }
            MotionPath::Spline(spline) => {
                let may_be_many = spline.controls.len() > MOST_PIECES >> SPLINE_HALVINGS;
                if is_divided || may_be_many { self.subdivide_spline(spline) } else { return None }
            }
            MotionPath::Start | MotionPath::Line => return None,
        };
        let point = |share: f64| match &motion.path {
            MotionPath::Arc(arc) => arc.point_at(share),
            MotionPath::Spline(spline) => spline.point_at(share),
            MotionPath::Line | MotionPath::Start => {
                motion.from.point + (motion.to.point - motion.from.point) * share
            }
        };
        let place = |share: &f64| {
            let pose = Pose { point: point(*share), axis: motion.from.axis };
            self.to_workpiece_frame(motion.frame.as_deref(), pose).point
        };
        let (mut last, mut count) = (None, 0.0);
        for next in shares.iter().map(place) {
            count += last.map_or(0.0, |last| self.wanted_parts(last, next).2);
            last = Some(next);
        }
        (count > MOST_PIECES as f64).then_some(count)
    }

    /// Returns the shares at which a chord that is longer than the longest piece is divided. It is divided evenly, and
    /// its axis turns at a constant rate. `taken` pieces of the motion are there already.
    fn divide_chord(&mut self, from: Point3<f64>, to: Point3<f64>, taken: usize) -> Vec<f64> {
        let (enters, leaves, wanted) = self.wanted_parts(from, to);
        if enters >= leaves {
            return Vec::new();
        }
        let near = leaves - enters;
        let most = MOST_PIECES.saturating_sub(taken).max(1) as f64;
        self.is_limit_reached |= wanted > most;
        let parts = wanted.min(most);
        let enters_inside = (enters > 0.0).then_some(enters);
        let inner = (1..parts as usize).map(|part| enters + near * (part as f64 / parts));
        enters_inside.into_iter().chain(inner).chain((leaves < 1.0).then_some(leaves)).collect()
    }

    /// Returns the shares of a chord between which it is near the stock, and into how many pieces that part is
    /// divided. A chord that is all air has one piece.
    fn wanted_parts(&self, from: Point3<f64>, to: Point3<f64>) -> (f64, f64, f64) {
        let far = self.air.and_then(|air| air.cut_far_way(from.coords.into(), to.coords.into()));
        let [enters, leaves] = far.unwrap_or([0.0, 1.0]);
        let near = (to - from).norm() * (leaves - enters).max(0.0);
        (enters, leaves, (near / self.longest_piece_mm).ceil().max(1.0))
    }

    /// Returns the number of chords that keep the sagitta, as far as a motion may have so many.
    fn count_chords(&mut self, arc: &CircularArc) -> usize {
        let wanted = self.wanted_chords(arc);
        self.is_limit_reached |= wanted > MOST_PIECES as f64;
        wanted.min(MOST_PIECES as f64) as usize
    }

    /// Returns the number of chords that keep the sagitta.
    fn wanted_chords(&self, arc: &CircularArc) -> f64 {
        let radius = arc.radius * self.mm_per_unit;
        // A chord over the angle a is R (1 - cos(a / 2)) from its arc; this is solved for a.
        let step = 2.0 * (1.0 - (self.sagitta_mm / radius).min(1.0)).acos();
        // The chords of a helix are no further from it than the chords of its circle.
        (arc.sweep / step.max(1e-4)).ceil().max(1.0)
    }

    /// Returns the parameters of a spline between which chords are close enough, found by bisection.
    fn subdivide_spline(&mut self, spline: &Spline) -> Vec<f64> {
        // There are as many equal parts to begin with as knot spans, so that no bend is missed.
        let spans = spline.controls.len().saturating_sub(3).max(1);
        let mut shares = vec![0.0];
        for span in 0..spans {
            let (from, to) = (span as f64 / spans as f64, (span + 1) as f64 / spans as f64);
            let is_fine = self.bisect_spline(spline, from, to, SPLINE_HALVINGS, &mut shares);
            self.is_limit_reached |= !is_fine;
        }
        shares
    }

    /// Bisects a part of a spline until three points within are at most the sagitta from the chord. Returns whether
    /// that was reached with so many halvings and pieces.
    fn bisect_spline(&self, spline: &Spline, from: f64, to: f64, depth: u32, shares: &mut Vec<f64>) -> bool {
        let [a, b] = [spline.point_at(from), spline.point_at(to)];
        let off = |share: f64| {
            let point = spline.point_at(from + (to - from) * share);
            let chord = b - a;
            let along = (point - a).dot(&chord) / chord.norm_squared().max(1e-300);
            (point - a - chord * along.clamp(0.0, 1.0)).norm() * self.mm_per_unit
        };
        let is_fine = [0.25, 0.5, 0.75].into_iter().all(|share| off(share) <= self.sagitta_mm);
        if is_fine || depth == 0 || shares.len() >= MOST_PIECES {
            shares.push(to);
            return is_fine;
        }
        let middle = (from + to) / 2.0;
        let first = self.bisect_spline(spline, from, middle, depth - 1, shares);
        self.bisect_spline(spline, middle, to, depth - 1, shares) && first
    }
}

/// Returns the fractions from 0 to 1 in `count` equal steps.
fn even_fractions(count: usize) -> Vec<f64> {
    (0..=count).map(|index| index as f64 / count as f64).collect()
}

/// Converts a pose from a frame to the frame that the file's numbers are given in without one.
fn pose_from_frame(frame: Option<&CoordinateFrame>, pose: Pose) -> Pose {
    frame.map_or(pose, |frame| Pose {
        point: (frame.origin + frame.axes * pose.point.coords).into(),
        axis: frame.axes * pose.axis,
    })
}

/// Converts a pose to a frame. A frame whose axes cannot be inverted leaves it unchanged.
fn pose_in_frame(frame: Option<&CoordinateFrame>, pose: Pose) -> Pose {
    let seen = frame.and_then(|frame| {
        let inverse = frame.axes.try_inverse()?;
        Some(Pose { point: (inverse * (pose.point.coords - frame.origin)).into(), axis: inverse * pose.axis })
    });
    seen.unwrap_or(pose)
}
