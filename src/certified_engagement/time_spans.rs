//! This module holds short lists of times: when a point is inside a shape that is not convex, or that it
//! passes on an arc.

/// The most spans of a list.
const MOST: usize = 8;

/// Spans of time in order, apart from each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TimeSpans {
    spans: [[f64; 2]; MOST],
    count: usize,
    /// What a full list does with one more span: it widens its last one, or leaves the new one out.
    widens: bool,
}

impl TimeSpans {
    /// Makes an empty list. One that `widens` never says too little, another one never too much.
    pub(super) fn none(widens: bool) -> Self {
        Self { spans: [[0.0; 2]; MOST], count: 0, widens }
    }

    /// Makes a list of one span.
    pub(super) fn one(span: [f64; 2], widens: bool) -> Self {
        let mut list = Self::none(widens);
        list.push(span);
        list
    }

    /// Adds a span that begins where the last one ends, or later.
    pub(super) fn push(&mut self, [from, to]: [f64; 2]) {
        if let Some(last) = self.count.checked_sub(1).and_then(|at| self.spans.get_mut(at))
            && from <= last[1]
        {
            last[1] = last[1].max(to);
            return;
        }
        match self.spans.get_mut(self.count) {
            Some(place) => {
                *place = [from, to];
                self.count += 1;
            }
            None => {
                if let (true, Some(last)) = (self.widens, self.spans.last_mut()) {
                    last[1] = last[1].max(to);
                }
            }
        }
    }

    /// Returns the spans.
    pub(super) fn spans(&self) -> &[[f64; 2]] {
        self.spans.get(..self.count).unwrap_or_default()
    }

    /// Returns whether there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Returns the span from the first to the last time.
    pub(super) fn hull(&self) -> Option<[f64; 2]> {
        let (first, last) = (self.spans().first()?, self.spans().last()?);
        Some([first[0], last[1]])
    }

    /// Returns the times in both lists.
    pub(super) fn common(&self, other: &Self) -> Self {
        let mut both = Self::none(self.widens);
        let (mut a, mut b) = (self.spans().iter().peekable(), other.spans().iter().peekable());
        while let (Some(first), Some(second)) = (a.peek(), b.peek()) {
            let (from, to) = (first[0].max(second[0]), first[1].min(second[1]));
            if from <= to {
                both.push([from, to]);
            }
            if first[1] < second[1] {
                a.next();
            } else {
                b.next();
            }
        }
        both
    }
}

/// The most questions of one halving: with what `widens`, which only proposes where to look, and without.
const MOST_QUESTIONS: [usize; 2] = [90, 240];
/// The bend that is small enough for what only proposes, mm.
const SMALL_PROPOSED: f64 = 1e-7;
/// How often a span is narrowed while a time inside is looked for, and how often an end is halved.
const NARROWINGS: usize = 24;

/// A gap over time, which is nearly convex over short times.
pub(super) struct MovingGap<'a> {
    /// The gap, mm.
    pub gap: &'a dyn Fn(f64) -> f64,
    /// By how much it changes per unit of time at the most.
    pub speed: f64,
    /// How far it is from a convex function over a span of times, at the most, mm.
    pub bend: &'a dyn Fn([f64; 2]) -> f64,
    /// The bend that is small enough, mm.
    pub small: f64,
}

impl MovingGap<'_> {
    /// Returns the times within `need` at which the gap is at most a bound. A list that `widens` also has the
    /// times that are not decided to `precision` mm of way, another one leaves them out.
    pub(super) fn times_within(&self, need: [f64; 2], bound: f64, precision: f64, widens: bool) -> TimeSpans {
        let mut found = TimeSpans::none(widens);
        let mut waiting = vec![need];
        let (mut questions, [few, many]) = (0, MOST_QUESTIONS);
        let most = if widens { few } else { many };
        while let Some([from, to]) = waiting.pop() {
            let middle = (from + to) / 2.0;
            let reach = self.speed * (to - from) / 2.0;
            let at = (self.gap)(middle);
            questions += 1;
            if at + reach <= bound {
                found.push([from, to]);
            } else if at - reach <= bound {
                let bend = (self.bend)([from, to]);
                let is_over = reach <= precision || questions + waiting.len() > most;
                if widens && (is_over || bend <= SMALL_PROPOSED.max(self.small)) {
                    questions += if is_over { 0 } else { NARROWINGS / 4 };
                    let whole = is_over || reach <= precision * 8.0;
                    found.push(if whole { [from, to] } else { self.wide_span([from, to], bound, bend) });
                } else if !widens && (is_over || bend <= self.small) {
                    questions += NARROWINGS / 4;
                    if let Some(span) = self.convex_span([from, to], bound - 2.0 * bend) {
                        found.push(span);
                    }
                } else {
                    waiting.push([middle, to]);
                    waiting.push([from, middle]);
                }
            }
        }
        found
    }

    /// Returns a span between two times at which the gap is at most a bound. If the bound has twice the bend
    /// off, everything between them is inside.
    fn convex_span(&self, [from, to]: [f64; 2], bound: f64) -> Option<[f64; 2]> {
        let is_in = |time: f64| (self.gap)(time) <= bound;
        let (first, last) = (is_in(from), is_in(to));
        if first && last {
            return Some([from, to]);
        }
        let inside = match (first, last) {
            (true, _) => from,
            (_, true) => to,
            _ => self.time_inside([from, to], bound)?,
        };
        let end = |mut outside: f64| {
            let mut within = inside;
            for _ in 0..NARROWINGS {
                let middle = (outside + within) / 2.0;
                if is_in(middle) { within = middle } else { outside = middle }
            }
            within
        };
        let span = [if first { from } else { end(from) }, if last { to } else { end(to) }];
        (span[0] < span[1]).then_some(span)
    }

    /// Returns a span outside of which the gap is above a bound. A convex function that is at most `bend` off
    /// is at an end of the span at most three bends above the bound, and more where the gap is four bends
    /// above it; so from there on it goes up.
    fn wide_span(&self, [from, to]: [f64; 2], bound: f64, bend: f64) -> [f64; 2] {
        let is_low = |time: f64| (self.gap)(time) <= bound + 2.0 * bend;
        let is_high = |time: f64| (self.gap)(time) > bound + 4.0 * bend;
        let end = |mut within: f64, mut outside: f64| {
            for _ in 0..NARROWINGS {
                let middle = (outside + within) / 2.0;
                if is_high(middle) { outside = middle } else { within = middle }
            }
            outside
        };
        match (is_low(from), is_low(to)) {
            (true, false) if is_high(to) => [from, end(from, to)],
            (false, true) if is_high(from) => [end(to, from), to],
            _ => [from, to],
        }
    }

    /// Returns a time at which the gap is at most a bound, if golden sections find one.
    fn time_inside(&self, [mut from, mut to]: [f64; 2], bound: f64) -> Option<f64> {
        const PART: f64 = 0.381_966;
        let (mut a, mut b) = (from + (to - from) * PART, to - (to - from) * PART);
        let (mut low, mut high) = ((self.gap)(a), (self.gap)(b));
        for _ in 0..NARROWINGS {
            if low <= bound {
                return Some(a);
            }
            if high <= bound {
                return Some(b);
            }
            if low < high {
                (to, b, high) = (b, a, low);
                a = from + (to - from) * PART;
                low = (self.gap)(a);
            } else {
                (from, a, low) = (a, b, high);
                b = to - (to - from) * PART;
                high = (self.gap)(b);
            }
            if low.min(high) - self.speed * (to - from) > bound {
                return None;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_merge_and_have_common_times() {
        let mut first = TimeSpans::none(false);
        for span in [[0.0, 0.2], [0.2, 0.3], [0.5, 0.9]] {
            first.push(span);
        }
        assert_eq!(first.spans(), [[0.0, 0.3], [0.5, 0.9]]);
        let second = TimeSpans::one([0.25, 0.6], false);
        assert_eq!(first.common(&second).spans(), [[0.25, 0.3], [0.5, 0.6]]);
    }

    #[test]
    fn halving_brackets_the_times_of_a_gap() {
        let gap = |t: f64| (10.0 * t).sin();
        // sin is at most an eighth of the squared angle from its chords.
        let bend = |[from, to]: [f64; 2]| 100.0 * (to - from) * (to - from) / 8.0;
        let moving = MovingGap { gap: &gap, speed: 10.0, bend: &bend, small: 1e-6 };
        let inner = moving.times_within([0.0, 1.0], 0.0, 1e-6, false);
        let outer = moving.times_within([0.0, 1.0], 0.0, 1e-6, true);
        let pi = std::f64::consts::PI / 10.0;
        assert!((inner.spans()[0][0] - pi).abs() < 1e-5 && inner.spans()[0][0] >= pi, "{inner:?}");
        assert!(outer.spans().iter().any(|[from, to]| *from <= pi && (to - 2.0 * pi).abs() < 1e-5));
    }

    #[test]
    fn a_gap_that_grazes_its_bound_is_inside() {
        let gap = |t: f64| -1e-9 * (1.0 + t);
        let bend = |_: [f64; 2]| 0.0;
        let moving = MovingGap { gap: &gap, speed: 10.0, bend: &bend, small: 1e-8 };
        assert_eq!(moving.times_within([0.0, 1.0], 0.0, 1e-9, false).spans(), [[0.0, 1.0]]);
    }
}
