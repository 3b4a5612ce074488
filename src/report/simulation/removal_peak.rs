//! This module finds the largest removal rate in such a way that it does not depend on how a path is divided
//! into motions.
//!
//! The mean over a motion is small if most of the motion is in air, and it changes when the motion is
//! divided. So the rate is the mean over a window of path of a fixed length: the volume removed in it by the
//! time that it takes at the programmed feeds. The window slides along the path at feed, also across the ends
//! of motions, and the largest rate counts. A path at feed that is shorter than the window has a single rate,
//! its mean. Rapids, tool changes and feeds that are not known end a path. The rate belongs to the motion in
//! the middle of the window.
//!
//! Within a part of the path (half a window at most), volume and time are taken as evenly distributed. So the
//! window with the largest rate begins or ends where a part does, and only such windows are evaluated.

use crate::engagement::Engagement;
use std::collections::VecDeque;

/// A part of a path at feed. `from` and `to` are distances from the beginning of the path, mm.
#[derive(Debug, Clone, Copy)]
struct PathPart {
    from: f64,
    to: f64,
    volume_mm3: f64,
    minutes: f64,
    /// The volume and the time of the path before this part.
    before: [f64; 2],
    row: usize,
}

impl PathPart {
    /// Returns the volume and the time of the path up to a place in this part.
    fn sums_at(&self, place: f64) -> [f64; 2] {
        let length = self.to - self.from;
        let share = if length > 0.0 { ((place - self.from) / length).clamp(0.0, 1.0) } else { 1.0 };
        let [volume, minutes] = self.before;
        [volume + self.volume_mm3 * share, minutes + self.minutes * share]
    }
}

/// Finds the largest removal rate of each motion.
#[derive(Debug)]
pub(super) struct RemovalPeakFinder {
    window: f64,
    /// The parts in which windows may still begin or end.
    parts: VecDeque<PathPart>,
    /// How many of the first parts are done: the windows that begin at their ends were evaluated.
    through: usize,
    /// The length of the current path at feed so far, mm.
    end: f64,
    /// The largest rate of each motion, mm3/min.
    peaks: Vec<Option<f64>>,
}

impl RemovalPeakFinder {
    pub(super) fn new(window_mm: f64) -> Self {
        Self { window: window_mm, parts: VecDeque::new(), through: 0, end: 0.0, peaks: Vec::new() }
    }

    /// Adds a piece of the motion with the number `row` at a feed in mm/min.
    pub(super) fn add_piece(&mut self, row: usize, feed_mm_min: f64, length_mm: f64, engaged: &Engagement) {
        if length_mm <= 0.0 || feed_mm_min <= 0.0 {
            return;
        }
        let volumes = engaged.removal.volumes_mm3();
        if volumes.is_empty() {
            // A short piece is one part.
            let volume = (engaged.removed_mm3 - engaged.removal.at_start_mm3()).max(0.0);
            self.push_part(row, feed_mm_min, length_mm, volume);
            return;
        }
        let length = length_mm / volumes.len() as f64;
        for volume in volumes {
            self.push_part(row, feed_mm_min, length, f64::from(*volume));
        }
    }

    fn push_part(&mut self, row: usize, feed_mm_min: f64, length_mm: f64, volume_mm3: f64) {
        let minutes = length_mm / feed_mm_min;
        let to = self.end + length_mm;
        match self.parts.back_mut() {
            // A motion's way through air is one part, however long it is.
            Some(last) if volume_mm3 == 0.0 && last.volume_mm3 == 0.0 && last.row == row => {
                last.to = to;
                last.minutes += minutes;
            }
            last => {
                let before = last.map_or([0.0; 2], |last| last.sums_at(last.to));
                self.parts.push_back(PathPart { from: self.end, to, volume_mm3, minutes, before, row });
            }
        }
        self.end = to;
        if to >= self.window {
            self.look_at(to - self.window);
        }
        while let Some(part) = self.parts.get(self.through).copied()
            && part.to + self.window <= to
        {
            self.look_at(part.to);
            self.look_around(part);
            self.through += 1;
        }
        while self.through > 0 && self.parts.front().is_some_and(|part| part.to + 2.0 * self.window < to) {
            self.parts.pop_front();
            self.through -= 1;
        }
    }

    /// Evaluates the window that begins at a place.
    fn look_at(&mut self, from: f64) {
        let (to, middle) = (from + self.window, from + self.window / 2.0);
        let rate = self.rate_between(from, to);
        if let Some(row) = self.part_at(middle).map(|part| part.row) {
            self.raise_peak(row, rate);
        }
    }

    /// Evaluates the window around the middle of a part if its motion has no rate yet. The middle of no other
    /// window may be in a short motion.
    fn look_around(&mut self, part: PathPart) {
        if self.peaks.get(part.row).copied().flatten().is_none() {
            let middle = f64::midpoint(part.from, part.to);
            let from = (middle - self.window / 2.0).min(self.end - self.window).max(0.0);
            let rate = self.rate_between(from, from + self.window);
            self.raise_peak(part.row, rate);
        }
    }

    /// Returns the part at a place: the first one that does not end before it, or the last one.
    fn part_at(&self, place: f64) -> Option<&PathPart> {
        let index = self.parts.partition_point(|part| part.to < place);
        self.parts.get(index).or(self.parts.back())
    }

    /// Returns the volume between two places divided by the time between them, mm3/min.
    fn rate_between(&self, from: f64, to: f64) -> f64 {
        let sums = |place: f64| self.part_at(place).map_or([0.0; 2], |part| part.sums_at(place));
        let ([volume_before, minutes_before], [volume, minutes]) = (sums(from), sums(to));
        if minutes > minutes_before { (volume - volume_before) / (minutes - minutes_before) } else { 0.0 }
    }

    fn raise_peak(&mut self, row: usize, rate: f64) {
        if self.peaks.len() <= row {
            self.peaks.resize(row + 1, None);
        }
        if let Some(peak) = self.peaks.get_mut(row) {
            *peak = Some(peak.map_or(rate, |known| known.max(rate)));
        }
    }

    /// Ends a path at feed.
    pub(super) fn end_path(&mut self) {
        let rest: Vec<PathPart> = self.parts.iter().skip(self.through).copied().collect();
        let whole = (self.end < self.window).then(|| self.rate_between(0.0, self.end));
        for part in rest {
            match whole {
                Some(rate) => self.raise_peak(part.row, rate),
                None => self.look_around(part),
            }
        }
        self.parts.clear();
        (self.through, self.end) = (0, 0.0);
    }

    /// Returns the largest rate of each motion, by its number, mm3/min; `None` where it is not known.
    pub(super) fn into_peaks(mut self) -> Vec<Option<f64>> {
        self.end_path();
        self.peaks
    }
}
