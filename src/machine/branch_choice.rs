//! This module chooses branches and turns of the rotary axes over a whole program.
//!
//! Each direction of the tool has two solutions, and each value may be turned by 360 degrees as far as the limits
//! allow. The best way has the fewest values outside their limits, then the least sum of the steps of the rotary
//! axes, from 0 on, rapid and feed alike. It is found by dynamic programming over the states of each pose; the nearest
//! solution at every pose makes longer ways and runs into limits.

use super::joint_values::JointValues;
use super::kinematic_chain::KinematicChain;
use super::machine_axis::{LIMIT_SLACK, MachineAxis};
use super::rotary_geometry::to_half_turn;
use nalgebra::{Point3, Vector3};

/// A rotary axis with more turns than this between its limits is taken for one without limits while turns are
/// chosen. The values are still compared with the limits.
const MOST_TURNS: f64 = 30.0;

/// The number of poses after which the way so far is looked at: where all states come from one, it is settled.
const SETTLE_AFTER: usize = 2048;

/// The values of the axes at a pose of the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChosenPose {
    /// The values.
    pub joints: JointValues,
    /// Whether the tool lies along the first rotary axis, so that this one keeps its value.
    pub is_pole: bool,
    /// The side of its pole value on which the second rotary axis stands: 1, -1, or 0 at the pole.
    pub side: i8,
}

/// A rotary axis as the choice sees it.
#[derive(Debug, Clone, Copy)]
struct TurnRange {
    /// Least and largest value; `None` where turns do not count.
    limits: Option<[f64; 2]>,
}

impl TurnRange {
    fn new(axis: &MachineAxis) -> Self {
        Self { limits: axis.limits.filter(|[low, high]| high - low <= 360.0 * MOST_TURNS) }
    }

    /// Calls `add` with each value that the axis may have for one from -180 to 180 degrees, and whether it is outside
    /// the limits. Where none is inside, those next to the limits are the choice.
    fn each_value(&self, value: f64, mut add: impl FnMut(f64, bool)) {
        let Some([low, high]) = self.limits else { return add(value, false) };
        let turns = |from: f64, to: f64| (((from - value) / 360.0).ceil(), ((to - value) / 360.0).floor());
        let (first, last) = turns(low - LIMIT_SLACK, high + LIMIT_SLACK);
        let (inside, (first, last)) = match first <= last {
            true => (true, (first, last)),
            false => (false, turns(low - 360.0, high + 360.0)),
        };
        let mut turn = first;
        while turn <= last {
            add(value + 360.0 * turn, !inside);
            turn += 1.0;
        }
    }

    /// Returns the step from one value to another.
    fn step(&self, from: f64, to: f64) -> f64 {
        if self.limits.is_some() { to - from } else { to_half_turn(to - from) }
    }
}

/// One way to stand at a pose.
#[derive(Debug, Clone, Copy)]
struct PathState {
    rotaries: [f64; 2],
    /// How many values were outside on the best way to here.
    outside: u32,
    /// The best way to here, degrees.
    way: f64,
    /// The state of the pose before from which that comes, counted within its pose.
    parent: u32,
    is_pole: bool,
    side: i8,
}

/// A pose whose state is not chosen yet.
#[derive(Debug, Clone, Copy)]
struct OpenPose {
    /// The number of the pose in the program.
    number: usize,
    tip: Point3<f64>,
    /// Where its states begin.
    first: usize,
}

/// Chooses the values of all axes over a program.
///
/// Poses are added in their order, and what is settled comes out: `None` for a pose that the machine cannot reach.
#[derive(Debug)]
pub struct BranchChoice<'c> {
    chain: &'c KinematicChain,
    ranges: [TurnRange; 2],
    /// The distance of a tip from the zero of the workpiece up to which no linear axis can be outside its limits.
    safe_reach: f64,
    states: Vec<PathState>,
    open: Vec<OpenPose>,
    /// The states of the pose before.
    before: Vec<PathState>,
    next: Vec<PathState>,
    /// The number of poses so far.
    added: usize,
    settle_at: usize,
    /// The rotary values at the last settled pose, turns included.
    last: [f64; 2],
    /// Values that are settled.
    out: Vec<Option<ChosenPose>>,
}

impl<'c> BranchChoice<'c> {
    /// Begins with all rotary axes at 0.
    pub fn new(chain: &'c KinematicChain) -> Self {
        let mut ranges = [TurnRange { limits: None }; 2];
        for (range, axis) in ranges.iter_mut().zip(chain.rotary_axes()) {
            *range = TurnRange::new(axis);
        }
        let start =
            PathState { rotaries: [0.0; 2], outside: 0, way: 0.0, parent: 0, is_pole: false, side: 0 };
        Self {
            chain,
            ranges,
            safe_reach: chain.safe_reach_mm(),
            states: Vec::new(),
            open: Vec::new(),
            before: vec![start],
            next: Vec::new(),
            added: 0,
            settle_at: SETTLE_AFTER,
            last: [0.0; 2],
            out: Vec::new(),
        }
    }

    /// Chooses the values at all poses: tips in mm and unit vectors of the tool axis, in the workpiece frame.
    pub fn choose_values(
        chain: &'c KinematicChain,
        poses: impl IntoIterator<Item = (Point3<f64>, Vector3<f64>)>,
    ) -> Vec<Option<ChosenPose>> {
        let mut choice = Self::new(chain);
        poses.into_iter().for_each(|(tip, axis)| choice.add_pose(tip, &axis));
        choice.finish_choice()
    }

    /// Adds a pose: the tip in mm, and the unit vector of the tool axis.
    pub fn add_pose(&mut self, tip: Point3<f64>, axis: &Vector3<f64>) {
        let number = self.added;
        self.added += 1;
        self.next.clear();
        let solutions = self.chain.solve_rotaries(axis);
        for solution in solutions.iter() {
            let outside = self.count_linears_outside(solution.values, &tip, solution.is_pole);
            let Some(outside) = outside else { continue };
            match solution.is_pole {
                true => self.add_pole_states(solution.values[1], outside),
                false => self.add_states(solution.values, outside, solution.side),
            }
        }
        if self.next.is_empty() {
            return;
        }
        self.open.push(OpenPose { number, tip, first: self.states.len() });
        self.states.extend_from_slice(&self.next);
        std::mem::swap(&mut self.before, &mut self.next);
        if self.open.len() >= self.settle_at {
            self.settle_common_way();
        }
    }

    /// Ends the program and returns the values at all poses.
    pub fn finish_choice(mut self) -> Vec<Option<ChosenPose>> {
        let ends = self.before.iter().enumerate();
        let best = ends.min_by(|(_, a), (_, b)| a.outside.cmp(&b.outside).then(a.way.total_cmp(&b.way)));
        if let Some((end, _)) = best.filter(|_| !self.open.is_empty()) {
            self.settle_until(self.open.len(), end as u32);
        }
        self.out.resize(self.added, None);
        self.out
    }

    /// Returns how many linear axes are outside their limits; `None` where the tip cannot be reached. At a pole the
    /// first axis is not known, and nothing is counted.
    fn count_linears_outside(&self, rotaries: [f64; 2], tip: &Point3<f64>, is_pole: bool) -> Option<u32> {
        if is_pole || tip.coords.norm() <= self.safe_reach {
            return Some(0);
        }
        let linears = self.chain.solve_linears(rotaries, tip)?;
        let outside = self.chain.linear_axes().zip(linears).filter(|(axis, at)| !axis.allows_value(*at));
        Some(outside.count() as u32)
    }

    /// Adds the states of a solution: one for each of its turns.
    fn add_states(&mut self, values: [f64; 2], outside: u32, side: i8) {
        let Self { ranges: [first_range, second_range], before, next, .. } = self;
        first_range.each_value(values[0], |first, first_out| {
            second_range.each_value(values[1], |second, second_out| {
                let own = outside + u32::from(first_out) + u32::from(second_out);
                let mut best = PathState {
                    rotaries: [first, second],
                    outside: u32::MAX,
                    way: f64::INFINITY,
                    parent: 0,
                    is_pole: false,
                    side,
                };
                for (parent, from) in before.iter().enumerate() {
                    let way = from.way
                        + first_range.step(from.rotaries[0], first).abs()
                        + second_range.step(from.rotaries[1], second).abs();
                    let outside = from.outside + own;
                    if outside < best.outside || (outside == best.outside && way < best.way) {
                        best = PathState { outside, way, parent: parent as u32, ..best };
                    }
                }
                next.push(best);
            });
        });
    }

    /// Adds the states at a pole: the first axis keeps the value of each state before.
    fn add_pole_states(&mut self, value: f64, outside: u32) {
        let Self { ranges: [first_range, second_range], before, next, .. } = self;
        second_range.each_value(value, |second, second_out| {
            for (parent, from) in before.iter().enumerate() {
                let first = from.rotaries[0];
                let first_out = first_range
                    .limits
                    .is_some_and(|[low, high]| first < low - LIMIT_SLACK || first > high + LIMIT_SLACK);
                let state = PathState {
                    rotaries: [first, second],
                    outside: from.outside + outside + u32::from(first_out) + u32::from(second_out),
                    way: from.way + second_range.step(from.rotaries[1], second).abs(),
                    parent: parent as u32,
                    is_pole: true,
                    side: 0,
                };
                match next.iter_mut().find(|known| known.rotaries == state.rotaries) {
                    Some(known) if (state.outside, state.way) < (known.outside, known.way) => *known = state,
                    Some(_) => {}
                    None => next.push(state),
                }
            }
        });
    }

    /// Settles the way up to the last pose at which all states of today come from one.
    fn settle_common_way(&mut self) {
        let mut alive: Vec<u32> = (0..self.before.len() as u32).collect();
        for index in (1..self.open.len()).rev() {
            let parents = alive.iter().map(|state| self.state_at(index, *state).map_or(0, |at| at.parent));
            let mut parents: Vec<u32> = parents.collect();
            parents.sort_unstable();
            parents.dedup();
            alive = parents;
            if let [common] = *alive {
                self.settle_until(index, common);
                break;
            }
        }
        // Where nothing settles, the next look comes later, so that looking stays linear.
        self.settle_at = self.open.len() * 2 + SETTLE_AFTER;
    }

    fn state_at(&self, index: usize, state: u32) -> Option<&PathState> {
        let pose = self.open.get(index)?;
        self.states.get(pose.first + state as usize)
    }

    /// Settles the first `count` open poses, of which the last one has the state `state`.
    fn settle_until(&mut self, count: usize, mut state: u32) {
        let mut chosen = Vec::with_capacity(count);
        for index in (0..count).rev() {
            let (Some(pose), Some(at)) = (self.open.get(index), self.state_at(index, state)) else { return };
            chosen.push((*pose, *at));
            state = at.parent;
        }
        for (pose, at) in chosen.into_iter().rev() {
            let mut rotaries = self.last;
            for ((value, to), range) in rotaries.iter_mut().zip(at.rotaries).zip(&self.ranges) {
                *value = if range.limits.is_some() { to } else { *value + range.step(*value, to) };
            }
            if at.is_pole {
                rotaries[0] = self.last[0];
            }
            self.last = rotaries;
            self.out.resize(pose.number, None);
            let linears = self.chain.solve_linears(rotaries, &pose.tip);
            self.out.push(linears.map(|linears| ChosenPose {
                joints: JointValues { rotaries, linears },
                is_pole: at.is_pole,
                side: at.side,
            }));
        }
        self.drop_settled(count);
    }

    /// Forgets the first `count` open poses.
    fn drop_settled(&mut self, count: usize) {
        let first = self.open.get(count).map_or(self.states.len(), |pose| pose.first);
        self.states.drain(..first);
        self.open.drain(..count);
        self.open.iter_mut().for_each(|pose| pose.first -= first);
    }
}
