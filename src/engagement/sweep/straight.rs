//! This module sweeps straight pieces of a three-axis path.

use super::band_engagement::BandEngagement;
use super::cutter_underside::{CutterUnderside, SweepPath, SweepRow};
use super::dead_middle_sweep::DeadMiddleSweep;
use super::straight_contact::{RemovedColumn, StraightContactFinder};
use super::straight_footprint::StraightFootprint;
use crate::cutter::{CutterModel, Meridian, NonCuttingCylinder};
use crate::engagement::{PillarContact, RemovalProfile};
use crate::stock::dexel::{DexelBand, DexelGrid, THINNEST};

/// The number of columns that are tested together.
const STEP: usize = 16;

/// A straight piece that is prepared for any band of columns.
#[derive(Debug, Clone)]
pub(in crate::engagement) struct StraightSweep {
    /// The x and y of the tip at the start.
    from: [f64; 2],
    path: SweepPath,
    surface: CutterUnderside,
    motion: StraightContactFinder,
    extent: StraightFootprint,
    /// The height of the flutes' upper end above the grid's base at the start; infinite if no material
    /// reaches above it.
    flutes_end: f32,
    /// The upper side of a cutter that is narrower above its widest place.
    upper: Option<UpperSweep>,
    /// The middle of an indexable cutter.
    middle: Option<DeadMiddleSweep>,
    collars: Vec<(usize, NonCuttingCylinder, CutterUnderside)>,
    layout: DexelGrid,
    /// The empty profile of where the piece removes material.
    removal: RemovalProfile,
    ends: bool,
    /// The radius of the cutter where the flank leaves the stock. On a tapered cutter it is less than the
    /// largest radius.
    widest: f64,
}

/// The sweep of a cutter's upper side: that of the underside of the same body upside down, along the path upside
/// down. What it computes is the negative of the upper end.
#[derive(Debug, Clone)]
struct UpperSweep {
    surface: CutterUnderside,
    path: SweepPath,
    rises: bool,
    /// The radius at the upper end of the flutes, within which their end cuts the upper side off.
    neck: f64,
}

impl UpperSweep {
    /// Prepares the upper side for a piece whose tip goes from one height to another, above the grid's base,
    /// over a horizontal length.
    fn new(profile: &Meridian, [from, to]: [f64; 2], length: f64) -> Option<Self> {
        let top = profile.top()?;
        let vertical = length <= 0.0;
        let slope = if vertical { 0.0 } else { (to - from) / length };
        let highest = if vertical { from.max(to) } else { from };
        let path = SweepPath {
            ux: 1.0,
            uy: 0.0,
            length: length as f32,
            slope: -slope as f32,
            start: -(highest + top.height_mm) as f32,
        };
        Some(Self {
            surface: CutterUnderside::new(&top.profile, -slope),
            path,
            rises: to > from,
            neck: profile.upper_radius_mm(),
        })
    }

    /// Returns the upper end of the sweep over a column, above the grid's base.
    fn top_over(&self, along: f64, left: f64, cell: f64) -> f32 {
        let mut height = [0.0];
        let row = SweepRow { x: along as f32, y: left as f32, cell: cell as f32 };
        self.surface.sweep_heights(&mut height, row, self.path);
        -height[0]
    }
}

/// The facts about a piece that are known before its columns are examined.
#[derive(Debug, Clone, Copy)]
pub(in crate::engagement) struct SweepContext {
    /// Whether the piece before ended at this start with the same cutter and removed the material there.
    pub continues: bool,
    /// The z of the highest material there ever was, mm.
    pub highest: f64,
    /// Whether the next piece does not continue in about the same direction, so that no sweep will examine
    /// what is ahead of the end.
    pub ends: bool,
    /// Whether the engagement must be fine enough for forces.
    pub detail: bool,
    /// The window over which the largest removal rate is wanted, mm; `None` if it is not.
    pub removal_window_mm: Option<f64>,
}

impl StraightSweep {
    /// Prepares a piece from tip to tip, with the axis along z.
    pub(crate) fn new(
        from: [f64; 3],
        to: [f64; 3],
        cutter: &CutterModel,
        layout: &DexelGrid,
        around: SweepContext,
    ) -> Self {
        let [dx, dy, dz] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let horizontal = dx.hypot(dy);
        let length = horizontal.hypot(dz);
        // On a steeper path the whole lateral offset is below 1e-6 mm, so the piece counts as a plunge.
        let vertical = horizontal < 1e-6;
        let profile = &cutter.profile;
        let slope = if vertical { 0.0 } else { dz / horizontal };
        let direction = if vertical { [0.0, 0.0] } else { [dx / horizontal, dy / horizontal] };
        let start = from[2].min(if vertical { to[2] } else { from[2] }) - layout.base_mm;
        let radius = profile.radius_mm();
        let margin = layout.cell_mm * 1e-2;
        let descends = dz < 0.0;
        let lowest_tip = from[2].min(to[2]);
        let reaches = |height: f64| around.highest > lowest_tip + height;
        // Ground counts as cleared only if the flutes were higher than all material: what was above them is
        // still there.
        let upper = UpperSweep::new(
            profile,
            [from[2] - layout.base_mm, to[2] - layout.base_mm],
            if vertical { 0.0 } else { horizontal },
        );
        let middle = DeadMiddleSweep::new(
            profile,
            [from[2] - layout.base_mm, to[2] - layout.base_mm],
            if vertical { 0.0 } else { horizontal },
        );
        let continues =
            around.continues && upper.is_none() && middle.is_none() && !reaches(cutter.flute_length_mm());
        let (cleared_before, cleared_disc) = match continues {
            // These values say which ground the piece before has cleared, so that columns there can be
            // skipped.
            false => (f64::NEG_INFINITY, 0.0),
            true if vertical && dz >= 0.0 => (f64::INFINITY, 0.0),
            true if vertical => (f64::NEG_INFINITY, 0.0),
            true if descends => {
                // On a descent, ground behind the start's lowest contact was cleared by the cutter at the
                // start. That contact is where the normal's angle is the path's: center + corner radius *
                // sin(slope angle).
                let sin = -slope / slope.hypot(1.0);
                let plain = profile.taper_rad() == 0.0 && profile.bottom_angle_rad() == 0.0;
                let reach = profile.corner_center()[0] + profile.corner_radius_mm() * sin;
                (-(if plain { reach } else { radius }) - margin, 0.0)
            }
            true => {
                // Level or rising, the piece before cleared everything behind the start, and all ground under
                // a flat bottom.
                let disc = if profile.bottom_angle_rad() == 0.0 { profile.bottom_radius_mm() } else { 0.0 };
                (-margin, (disc - margin).max(0.0))
            }
        };
        let extent = StraightFootprint {
            direction,
            length: if vertical { 0.0 } else { horizontal },
            radius,
            cleared_before,
            cleared_disc,
        };
        let flutes_end = if upper.is_some() || reaches(cutter.flute_length_mm()) {
            (from[2].max(if vertical { to[2] } else { from[2] }) + cutter.flute_length_mm() - layout.base_mm)
                as f32
        } else {
            f32::INFINITY
        };
        let near = cutter.collars.iter().copied().enumerate().filter(|(_, collar)| reaches(collar.from_mm));
        let collars = near
            .map(|(index, collar)| (index, collar, CutterUnderside::flat_disc(collar.radius_mm, slope)))
            .collect();
        Self {
            from: [from[0], from[1]],
            path: SweepPath {
                ux: if vertical { 1.0 } else { direction[0] as f32 },
                uy: direction[1] as f32,
                length: extent.length as f32,
                slope: slope as f32,
                start: start as f32,
            },
            surface: CutterUnderside::new(profile, slope),
            motion: StraightContactFinder {
                profile: profile.clone(),
                across: if length > 0.0 && !vertical { horizontal / length } else { 0.0 },
                along: if length > 0.0 { dz / length } else { 0.0 },
                start,
                first: from[2] - layout.base_mm,
                length: extent.length,
                drop: (from[2] - to[2]).max(0.0),
                part: around.removal_window_mm.map_or(f64::INFINITY, |window| window / 2.0),
                cell: layout.cell_mm,
                detail: around.detail,
                fresh: !around.continues,
            },
            extent,
            flutes_end,
            upper,
            middle,
            collars,
            layout: *layout,
            removal: RemovalProfile::empty_for_piece(length, around.removal_window_mm),
            ends: around.ends,
            widest: if profile.taper_rad() > 0.0 {
                profile.radius_at_height_mm(around.highest - lowest_tip)
            } else {
                radius
            },
        }
    }

    /// Returns the range of rows that the piece can change.
    pub(crate) fn row_range(&self) -> std::ops::Range<usize> {
        let [low, high] = self.extent.y_range();
        let reach = self
            .collars
            .iter()
            .map(|(_, collar, _)| collar.radius_mm - self.extent.radius)
            .fold(self.layout.cell_mm, f64::max);
        let row = |y: f64| (self.from[1] + y - self.layout.origin_mm[1]) / self.layout.cell_mm;
        let first = row(low - reach).ceil().max(0.0) as usize;
        let end = (row(high + reach).floor() + 1.0).max(0.0) as usize;
        first..end.min(self.layout.rows)
    }

    /// Returns the columns of a range of x that counts from the start.
    fn column_range(&self, [from, to]: [f64; 2]) -> std::ops::Range<usize> {
        let DexelGrid { origin_mm: [x0, _], cell_mm: cell, columns, .. } = self.layout;
        let column = |x: f64| (self.from[0] + x - x0) / cell;
        // Casts round towards zero and saturate. They are single instructions, whereas `ceil` and `floor` are
        // calls.
        let up = |at: f64| {
            let whole = at.max(0.0) as usize;
            whole.saturating_add(usize::from(at > whole as f64))
        };
        let first = up(column(from)).min(columns);
        let end = if column(to) < 0.0 { 0 } else { (column(to) as usize).saturating_add(1).min(columns) };
        first..end.max(first)
    }

    /// Removes what the piece sweeps from a band.
    pub(crate) fn sweep_band(&self, band: &mut DexelBand, scratch: &mut Vec<f32>) -> BandEngagement {
        let mut partial = BandEngagement::new(self.removal.clone());
        let rows = self.row_range();
        let (first, end) = (rows.start.max(band.first_row), rows.end.min(band.first_row + band.row_count()));
        // The rows go from the middle outwards, so that contacts that dominate others come first.
        let middle = (((self.from[1] - self.layout.origin_mm[1]) / self.layout.cell_mm).max(0.0) as usize)
            .clamp(first, end.max(first));
        for row in (middle..end).chain((first..middle).rev()) {
            let y = self.layout.column_center(0, row)[1] - self.from[1];
            for collar in &self.collars {
                self.check_collision(band, row, y, collar, scratch, &mut partial);
            }
            for stretch in self.extent.x_ranges(y) {
                self.cut_row(band, row, y, self.column_range(stretch), scratch, &mut partial);
            }
            if self.motion.across > 0.0
                && y.abs() <= self.extent.length + self.extent.radius + self.layout.cell_mm
            {
                self.add_hidden_slivers(band, row, y, &mut partial);
            }
        }
        partial
    }

    /// Cuts a range of columns of one row.
    fn cut_row(
        &self,
        band: &mut DexelBand,
        row: usize,
        y: f64,
        columns: std::ops::Range<usize>,
        scratch: &mut Vec<f32>,
        partial: &mut BandEngagement,
    ) {
        if columns.is_empty() {
            return;
        }
        let x = self.layout.column_center(columns.start, row)[0] - self.from[0];
        let offset = (row - band.first_row) * band.columns;
        scratch.resize(columns.len(), 0.0);
        let seen = SweepRow { x: x as f32, y: y as f32, cell: self.layout.cell_mm as f32 };
        self.surface.sweep_heights(scratch, seen, self.path);
        let range = offset + columns.start..offset + columns.end;
        let [ux, uy] = [f64::from(self.path.ux), f64::from(self.path.uy)];
        // Coordinates along the path and to its left, for the column `hit` of the range.
        let place = |hit: usize| {
            let x = x + hit as f64 * self.layout.cell_mm;
            (x * ux + y * uy, y * ux - x * uy)
        };
        if let Some(middle) = &self.middle {
            let tops = band.top.get(range.clone()).unwrap_or_default();
            let row = [row, columns.start];
            self.spare_middle(middle, row, (tops, scratch), &place, partial);
        }
        // A usual cut lowers the top of a column's only interval. All other columns are processed after this
        // loop.
        let mut others = Vec::new();
        let simple = band.has_only_single_spans() && !self.flutes_end.is_finite();
        let (tops, lows) = band.tops_and_lows_mut(range.clone());
        for (step, ((tops, lows), heights)) in
            tops.chunks_mut(STEP).zip(lows.chunks(STEP)).zip(scratch.chunks(STEP)).enumerate()
        {
            if !tops.iter().zip(heights).fold(false, |any, (top, height)| any | (top > height)) {
                continue;
            }
            for (index, ((top, low), height)) in tops.iter_mut().zip(lows).zip(heights).enumerate() {
                if *top <= *height {
                    continue;
                }
                let hit = step * STEP + index;
                if !simple || *low + THINNEST >= *height {
                    others.push((hit, *height));
                    continue;
                }
                let (along, left) = place(hit);
                let column = RemovedColumn { along, left, low: f64::from(*height), top: f64::from(*top) };
                *top = *height;
                self.motion.add_column_contacts(column, &self.surface, partial);
            }
        }
        for (hit, lowest) in others {
            let (along, left) = place(hit);
            let upper =
                if self.flutes_end.is_finite() { self.flute_top_over(along, left) } else { f32::INFINITY };
            band.cut_column(range.start + hit, lowest, upper, |low, top| {
                if self.upper.as_ref().is_some_and(|upper| upper.rises) {
                    // The advance of the upper side on the way up is not measured: no share is larger than 1.
                    partial.graze = 1.0;
                }
                let column = RemovedColumn { along, left, low: f64::from(low), top: f64::from(top) };
                self.motion.add_column_contacts(column, &self.surface, partial);
            });
        }
    }

    /// Raises the heights of columns that the middle of an indexable cutter leaves, and records what its body runs
    /// into. `row` is the row and its first column.
    fn spare_middle(
        &self,
        middle: &DeadMiddleSweep,
        [row, first]: [usize; 2],
        (tops, heights): (&[f32], &mut [f32]),
        place: &dyn Fn(usize) -> (f64, f64),
        partial: &mut BandEngagement,
    ) {
        for (hit, (top, height)) in tops.iter().zip(heights).enumerate() {
            if *top <= *height {
                continue;
            }
            let (along, left) = place(hit);
            let (swept, top) = (f64::from(*height), f64::from(*top));
            let Some(column) = middle.judge_column([along, left], swept, top) else { continue };
            *height = column.height as f32;
            if let Some([above, stands]) = column.pillar {
                let [x, y] = self.layout.column_center(first + hit, row);
                let clearance_mm = middle.clearance_mm();
                let found = PillarContact {
                    height_mm: above,
                    clearance_mm,
                    place_mm: [x, y, stands + self.layout.base_mm],
                    volume_mm3: above - clearance_mm,
                };
                partial.pillar = PillarContact::merge_places(partial.pillar, Some(found));
            }
        }
    }

    /// Returns the upper end of the flutes' sweep over a column, above the grid's base.
    fn flute_top_over(&self, along: f64, left: f64) -> f32 {
        let side = self.upper.as_ref().map(|upper| upper.top_over(along, left, self.layout.cell_mm));
        let radius = self.upper.as_ref().map_or(self.extent.radius, |upper| upper.neck);
        if let Some(side) = side.filter(|_| left.abs() > radius) {
            return side;
        }
        // The upper plane is a disc; on a slope its highest place over the column is at one of the two
        // passages of its rim.
        let half = (radius * radius - left * left).max(0.0).sqrt();
        let slope = self.path.slope;
        let at = |at: f64| slope * at.clamp(0.0, self.extent.length) as f32;
        let end = self.flutes_end + at(along - half).max(at(along + half));
        side.map_or(end, |side| side.min(end))
    }

    /// Finds material that is closer to the flank than a cell, beside the path or ahead of its end. A sliver
    /// of it may be in the cutter's path without any column showing it. Material counts from the height at
    /// which the cutter is thinner by a cell than at its widest.
    fn add_hidden_slivers(&self, band: &DexelBand, row: usize, y: f64, partial: &mut BandEngagement) {
        let (radius, cell) = (self.widest, self.layout.cell_mm);
        let slope = f64::from(self.path.slope);
        let end = self.motion.start + slope * self.extent.length;
        let inner = (radius - cell).max(0.0);
        let above = self.motion.profile.height_at_radius_mm(inner) + 1e-3;
        let offset = (row - band.first_row) * band.columns;
        let tops = |columns: std::ops::Range<usize>| {
            band.top.get(offset + columns.start..offset + columns.end).unwrap_or_default()
        };
        // A sliver at lateral distance q touches the flank at sin(theta) = q / R, where the advance ratio is
        // across cos(theta). It may be a cell nearer to the middle than the column.
        let share = |side: f64| {
            let side = ((side - cell).max(0.0) / radius).min(1.0);
            (self.motion.across * (1.0 - side * side).sqrt()) as f32
        };
        if partial.graze < share(radius) {
            let level = (self.motion.start.min(end) + above) as f32;
            for lateral in [[radius, radius + cell], [-radius - cell, -radius]] {
                let columns = self.column_range(self.extent.x_range_beside(y, lateral));
                if tops(columns).iter().any(|top| *top > level) {
                    partial.graze = share(radius);
                }
            }
        }
        let level = (end + above) as f32;
        for stretch in (StraightFootprint { radius, ..self.extent })
            .x_ranges_ahead(y, cell)
            .into_iter()
            .filter(|_| self.ends)
        {
            let columns = self.column_range(stretch);
            let x = self.layout.column_center(columns.start, row)[0] - self.from[0];
            for (index, _) in tops(columns).iter().enumerate().filter(|(_, top)| **top > level) {
                let x = x + index as f64 * cell;
                let side = (y * f64::from(self.path.ux) - x * f64::from(self.path.uy)).abs();
                partial.graze = partial.graze.max(share(side));
            }
        }
    }

    /// Measures how deep a shank or holder is in material in one row. Its lower end is a disc that moves with
    /// the tip.
    fn check_collision(
        &self,
        band: &DexelBand,
        row: usize,
        y: f64,
        (index, collar, disc): &(usize, NonCuttingCylinder, CutterUnderside),
        scratch: &mut Vec<f32>,
        partial: &mut BandEngagement,
    ) {
        let extent = StraightFootprint {
            radius: collar.radius_mm,
            cleared_before: f64::NEG_INFINITY,
            cleared_disc: 0.0,
            ..self.extent
        };
        let path = SweepPath { start: self.path.start + collar.from_mm as f32, ..self.path };
        let offset = (row - band.first_row) * band.columns;
        for stretch in extent.x_ranges(y) {
            let columns = self.column_range(stretch);
            let x = self.layout.column_center(columns.start, row)[0] - self.from[0];
            scratch.resize(columns.len(), 0.0);
            disc.sweep_heights(
                scratch,
                SweepRow { x: x as f32, y: y as f32, cell: self.layout.cell_mm as f32 },
                path,
            );
            let tops = band.top.get(offset + columns.start..offset + columns.end).unwrap_or_default();
            let depth = tops.iter().zip(scratch.iter()).map(|(top, height)| top - height);
            let depth = f64::from(depth.fold(f32::NEG_INFINITY, f32::max));
            // Less depth than this may be the grid's own error.
            if depth > self.layout.cell_mm.min(0.05) {
                partial.record_collision(*index, depth);
            }
        }
    }
}
