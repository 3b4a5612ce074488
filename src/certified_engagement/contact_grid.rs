//! This module tells what of a cutter may cut in each part of a block's time, in rows along its edge and directions around
//! its axis.

use super::block_bound::EngagementOptions;
use super::certified_program::{CertifiedProgram, SearchedStep};
use super::contour_element::ContourElement;
use super::engaged_cells::{CONTACT_DIRECTIONS, EngagedCell};
use super::step_search::{EngagementCriterion, StepSearch};
use super::surface_patch::largest_radius;
use std::f64::consts::{PI, TAU};

/// The largest angle that the normal turns in a row, radians.
const ROW_TURN_RAD: f64 = 0.1;
/// The most rows of one element of the contour.
const MOST_ROWS: usize = 128;
/// The length of path of one part of the time, as a part of the cutter's radius, and the most parts of a step.
const SLICE_PART: f64 = 0.1;
const MOST_SLICES: f64 = 16.0;

/// What of a cutter may cut in a part of a block's time.
#[derive(Debug, Clone)]
pub struct ContactGrid {
    /// The rows, from the tip upwards, each with a contact in [`CONTACT_DIRECTIONS`] directions. Directions are counted
    /// from behind the way of the tip, counter-clockwise as seen from the holder.
    pub rows: Vec<ContactRow>,
}

/// A row along the edge.
#[derive(Debug, Clone)]
pub struct ContactRow {
    /// The heights of its ends above the tip, mm.
    pub heights_mm: [f64; 2],
    /// The angle of the outward normal from straight down in its middle, radians.
    pub normal_rad: f64,
    /// The largest angle between the normal in the middle and another one of the row, radians.
    pub half_turn_rad: f64,
    /// The contacts in all directions.
    pub contacts: Vec<RowContact>,
}

/// What may cut of a row in one direction: all zero where nothing does.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RowContact {
    /// The share that no point exceeds.
    pub share: f64,
    /// The length along the edge, mm.
    pub length_mm: f64,
    /// The integral of the radius over that length, mm2.
    pub moment_mm2: f64,
    /// The integral of share times radius over that length, mm2: times the width of a direction it is the removed volume
    /// per mm of path, and times the advance it is the chip's lever.
    pub swept_mm2: f64,
}

impl ContactGrid {
    /// Refers shares to the speed of a motion as it is programmed. `pace` is the speed of the tip by that one.
    #[must_use]
    pub fn at_pace(mut self, pace: f64) -> Self {
        if pace != 1.0 {
            for contact in self.rows.iter_mut().flat_map(|row| &mut row.contacts) {
                contact.share *= pace;
                contact.swept_mm2 *= pace;
            }
        }
        self
    }
}

impl CertifiedProgram {
    /// Returns what may cut in each part of a block's time. `lag_rad_per_mm` is by how much the edge lags behind the tip
    /// per mm of height, at the most, so that rows are as low as the helix asks for.
    ///
    /// A block that does not exist has no contacts.
    pub fn bound_contacts(
        &self,
        block: usize,
        lag_rad_per_mm: f64,
        options: &EngagementOptions,
    ) -> Vec<ContactGrid> {
        let steps = self.searched_steps(block);
        steps.iter().flat_map(|step| self.bound_step_contacts(step, lag_rad_per_mm, options)).collect()
    }

    fn bound_step_contacts(
        &self,
        own: &SearchedStep<'_>,
        lag_rad_per_mm: f64,
        options: &EngagementOptions,
    ) -> Vec<ContactGrid> {
        let Some(mut search) = StepSearch::new(self, options, EngagementCriterion::Share, own) else {
            return Vec::new();
        };
        let cells = search.collect_cells();
        if cells.is_empty() {
            return Vec::new();
        }
        let radius = search.contour.radius_mm();
        let slices = (own.reference / (SLICE_PART * radius)).ceil().clamp(1.0, MOST_SLICES);
        let slice = |number: u32| {
            let times = [f64::from(number) / slices, f64::from(number + 1) / slices];
            fill_grid(&search, &cells, times, lag_rad_per_mm)
        };
        (0..slices as u32).filter_map(slice).collect()
    }
}

/// Fills the grid of a part of a step's time; `None` if nothing may cut in it.
fn fill_grid(
    search: &StepSearch<'_>,
    cells: &[EngagedCell],
    times: [f64; 2],
    lag_rad_per_mm: f64,
) -> Option<ContactGrid> {
    let mut grid = ElementRows::list(search.contour.elements(), cells, lag_rad_per_mm);
    let mut is_empty = true;
    for cell in cells {
        let meets = |[from, to]: &[f64; 2]| *from <= times[1] && *to >= times[0];
        if !cell.times.iter().any(meets) {
            continue;
        }
        let Some(rows) = grid.iter_mut().find(|rows| rows.element == cell.element) else { continue };
        is_empty = false;
        let need = [
            cell.times.first().map_or(times[0], |first| first[0].max(times[0])),
            cell.times.last().map_or(times[1], |last| last[1].min(times[1])),
        ];
        rows.add_cell(search, cell, need);
    }
    if is_empty {
        return None;
    }
    let rows = grid.into_iter().flat_map(ElementRows::into_contact_rows);
    Some(ContactGrid { rows: rows.filter(|row| row.contacts.iter().any(|at| at.length_mm > 0.0)).collect() })
}

/// The rows of one element of the contour.
struct ElementRows<'e> {
    element: usize,
    shape: &'e ContourElement,
    range: [f64; 2],
    rows: Vec<Vec<RowContact>>,
}

impl<'e> ElementRows<'e> {
    /// Lists the rows of all elements that have cells.
    fn list(elements: &'e [ContourElement], cells: &[EngagedCell], lag_rad_per_mm: f64) -> Vec<Self> {
        let mut grid = Vec::new();
        for (element, shape) in elements.iter().enumerate() {
            let of_element = cells.iter().filter(|cell| cell.element == element);
            let hull = of_element.map(|cell| cell.range).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
            let Some(range) = hull else { continue };
            let height = shape.point(range[1])[1] - shape.point(range[0])[1];
            let turn = match shape {
                ContourElement::Line { .. } => 0.0,
                ContourElement::Arc { .. } => range[1] - range[0],
            };
            let lag = height.abs() * lag_rad_per_mm.abs() / (TAU / CONTACT_DIRECTIONS as f64);
            let count = (turn / ROW_TURN_RAD).max(lag).ceil().clamp(1.0, MOST_ROWS as f64) as usize;
            let row = vec![RowContact::default(); CONTACT_DIRECTIONS];
            grid.push(Self { element, shape, range, rows: vec![row; count] });
        }
        grid
    }

    fn range_of_row(&self, number: usize) -> [f64; 2] {
        let part = (self.range[1] - self.range[0]) / self.rows.len() as f64;
        [number, number + 1].map(|number| self.range[0] + part * number as f64)
    }

    /// Adds a cell to all rows that it meets. `need` are the times.
    fn add_cell(&mut self, search: &StepSearch<'_>, cell: &EngagedCell, need: [f64; 2]) {
        let width = TAU / CONTACT_DIRECTIONS as f64;
        for number in 0..self.rows.len() {
            let [low, high] = self.range_of_row(number);
            let part = [low.max(cell.range[0]), high.min(cell.range[1])];
            if part[1] <= part[0] {
                continue;
            }
            let length = (part[1] - part[0]) * self.shape.length_per_unit();
            // The radius is a concave function along any element, so its middle is at least its mean.
            let [radius, _] = self.shape.point((part[0] + part[1]) / 2.0);
            let Some(row) = self.rows.get_mut(number) else { continue };
            for direction in cell.directions[0]..cell.directions[1] {
                let Some(contact) = row.get_mut(direction % CONTACT_DIRECTIONS) else { continue };
                let from = search.heading - PI + direction as f64 * width;
                let share = search.advance.upper(self.shape, part, [from, from + width], need).max(0.0);
                let mean = search.advance.mean_upper(self.shape, part, [from, from + width], need).max(0.0);
                contact.share = contact.share.max(share);
                contact.length_mm += length;
                contact.moment_mm2 += length * radius;
                contact.swept_mm2 += mean * length * radius;
            }
        }
    }

    fn into_contact_rows(self) -> impl Iterator<Item = ContactRow> {
        let ranges: Vec<[f64; 2]> = (0..self.rows.len()).map(|number| self.range_of_row(number)).collect();
        let Self { shape, rows, .. } = self;
        let shape = *shape;
        ranges.into_iter().zip(rows).map(move |(range, contacts)| {
            let full = (range[1] - range[0]) * shape.length_per_unit();
            // Parts of a row whose times meet in this slice may overlap; together they are no longer than the row.
            let cap = |contact: RowContact| {
                let part = if contact.length_mm > full { full / contact.length_mm } else { 1.0 };
                let radius = largest_radius(&shape, range);
                if part == 1.0 {
                    return contact;
                }
                RowContact {
                    share: contact.share,
                    length_mm: full,
                    moment_mm2: full * radius,
                    swept_mm2: contact.share * full * radius,
                }
            };
            let middle = shape.normal((range[0] + range[1]) / 2.0);
            ContactRow {
                heights_mm: range.map(|at| shape.point(at)[1]),
                normal_rad: middle[0].atan2(-middle[1]),
                half_turn_rad: match shape {
                    ContourElement::Line { .. } => 0.0,
                    ContourElement::Arc { .. } => (range[1] - range[0]) / 2.0,
                },
                contacts: contacts.into_iter().map(cap).collect(),
            }
        })
    }
}
