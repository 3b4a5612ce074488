//! This module holds the chain of axes from the workpiece to the frame and from the frame to the tool.

use super::machine_axis::{AxisKind, AxisMount, MachineAxis};
use super::rotary_geometry::RotaryGeometry;
use nalgebra::{Matrix3, Unit, Vector3};

/// The sine of the least angle between two directions that are not parallel, and the least volume that three linear
/// axes span: a tenth of a degree.
const LEAST_ANGLE: f64 = 1.7e-3;

/// A machine as a chain of axes: three linear ones, and none, one or two rotary ones in general position.
///
/// ```
/// use clsmith::machine::{AxisKind, AxisMount, KinematicChain, MachineAxis};
/// use clsmith::nalgebra::{Point3, Vector3};
///
/// let axis = |name: &str, mount, kind, direction| MachineAxis {
///     name: name.to_owned(),
///     mount,
///     kind,
///     direction,
///     point: Point3::origin(),
///     limits: None,
///     max_speed: 10000.0,
///     rapid: 20000.0,
///     acceleration: 3000.0,
///     jerk: None,
/// };
/// let chain = KinematicChain::new(
///     vec![
///         axis("C", AxisMount::Table, AxisKind::Rotary, Vector3::z_axis()),
///         axis("A", AxisMount::Table, AxisKind::Rotary, Vector3::x_axis()),
///         axis("X", AxisMount::Head, AxisKind::Linear, Vector3::x_axis()),
///         axis("Y", AxisMount::Head, AxisKind::Linear, Vector3::y_axis()),
///         axis("Z", AxisMount::Head, AxisKind::Linear, Vector3::z_axis()),
///     ],
///     Vector3::z_axis(),
/// )
/// .expect("the rotary axes are not parallel");
/// // The tool shall stand along x of the workpiece: A turns by 90 degrees, and C brings x to where y was.
/// let solutions = chain.solve_rotaries(&Vector3::x());
/// assert!(solutions.iter().any(|turned| (turned.values[0] - 90.0).abs() < 1e-9
///     && (turned.values[1] - 90.0).abs() < 1e-9));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct KinematicChain {
    axes: Vec<MachineAxis>,
    tool_axis: Unit<Vector3<f64>>,
    /// The places of the linear axes in `axes`.
    linears: [usize; 3],
    /// The places of the rotary axes in `axes`, the one next to the workpiece first.
    rotaries: Vec<usize>,
    /// The table axes from the workpiece on.
    pub(super) table_links: Vec<ChainLink>,
    /// The head axes from the tool on.
    pub(super) head_links: Vec<ChainLink>,
    /// The inverse of the directions in which the linear axes move the tool in the machine, where they are always
    /// the same.
    pub(super) fixed_directions: Option<Matrix3<f64>>,
    pub(super) geometry: RotaryGeometry,
}

/// One axis as the equations need it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ChainLink {
    /// A linear axis: which of the three, and its direction.
    Slide(usize, Vector3<f64>),
    /// A rotary axis: which of the two, its direction and a point on it.
    Turn(usize, Vector3<f64>, Vector3<f64>),
}

/// Why a list of axes is no machine.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ChainFault {
    /// There are not three linear axes but so many.
    LinearCount(usize),
    /// There are more than two rotary axes; the third one stands here.
    ThirdRotary(usize),
    /// The three linear axes lie in one plane.
    LinearsInPlane([usize; 3]),
    /// The two rotary axes are parallel.
    RotariesParallel([usize; 2]),
    /// The rotary axis next to the tool lies along the tool, and so only turns it about itself.
    RotaryAlongTool(usize),
}

impl KinematicChain {
    /// Makes the chain of axes: those of the table from the workpiece to the frame, then those of the head from the
    /// frame to the tool. `tool_axis` is the direction from the tip to the spindle with all axes at 0.
    ///
    /// # Errors
    /// Returns why these axes cannot bring a tool to every point, or cannot tilt it.
    pub fn new(axes: Vec<MachineAxis>, tool_axis: Unit<Vector3<f64>>) -> Result<Self, ChainFault> {
        let places = |kind| axes.iter().enumerate().filter(move |(_, axis)| axis.kind == kind);
        let linears: Vec<usize> = places(AxisKind::Linear).map(|(place, _)| place).collect();
        let rotaries: Vec<usize> = places(AxisKind::Rotary).map(|(place, _)| place).collect();
        let linears: [usize; 3] =
            linears.try_into().map_err(|all: Vec<_>| ChainFault::LinearCount(all.len()))?;
        if let Some(third) = rotaries.get(2) {
            return Err(ChainFault::ThirdRotary(*third));
        }
        let direction = |place: usize| axes.get(place).map_or_else(Vector3::zeros, |axis| *axis.direction);
        let [x, y, z] = linears.map(direction);
        if x.cross(&y).dot(&z).abs() < LEAST_ANGLE {
            return Err(ChainFault::LinearsInPlane(linears));
        }
        if let [first, second] = *rotaries
            && direction(first).cross(&direction(second)).norm() < LEAST_ANGLE
        {
            return Err(ChainFault::RotariesParallel([first, second]));
        }
        if let Some(last) = rotaries.last()
            && direction(*last).cross(&tool_axis).norm() < LEAST_ANGLE
        {
            return Err(ChainFault::RotaryAlongTool(*last));
        }
        let turned: Vec<_> = rotaries.iter().filter_map(|place| axes.get(*place)).collect();
        let geometry = RotaryGeometry::new(&turned, &tool_axis);
        let links = |mount: AxisMount| {
            let (mut slide, mut turn) = (0, 0);
            let mut links = Vec::new();
            for axis in &axes {
                let link = match axis.kind {
                    AxisKind::Linear => ChainLink::Slide(slide, *axis.direction),
                    AxisKind::Rotary => ChainLink::Turn(turn, *axis.direction, axis.point.coords),
                };
                slide += usize::from(axis.kind == AxisKind::Linear);
                turn += usize::from(axis.kind == AxisKind::Rotary);
                if axis.mount == mount {
                    links.push(link);
                }
            }
            links
        };
        let (table_links, mut head_links) = (links(AxisMount::Table), links(AxisMount::Head));
        head_links.reverse();
        let mut chain = Self {
            tool_axis,
            linears,
            rotaries,
            table_links,
            head_links,
            fixed_directions: None,
            geometry,
            axes,
        };
        if is_rigid(&chain.table_links) && is_rigid(&chain.head_links) {
            chain.fixed_directions =
                chain.carry_to_frame(&[(0.0, 1.0); 2], &Vector3::zeros()).1.try_inverse();
        }
        Ok(chain)
    }

    /// Returns the axes: those of the table from the workpiece on, then those of the head from the frame on.
    pub fn axes(&self) -> &[MachineAxis] {
        &self.axes
    }

    /// Returns the direction from the tip to the spindle with all axes at 0.
    pub fn tool_axis(&self) -> Unit<Vector3<f64>> {
        self.tool_axis
    }

    /// Returns the linear axes.
    pub fn linear_axes(&self) -> impl Iterator<Item = &MachineAxis> {
        self.linears.iter().filter_map(|place| self.axes.get(*place))
    }

    /// Returns the rotary axes, none to two. The first one is next to the workpiece.
    pub fn rotary_axes(&self) -> impl Iterator<Item = &MachineAxis> {
        self.rotaries.iter().filter_map(|place| self.axes.get(*place))
    }

    /// Returns the number of rotary axes.
    pub fn rotary_count(&self) -> usize {
        self.rotaries.len()
    }

    /// Returns the values of all axes in the order of [`KinematicChain::axes`].
    pub fn order_values(&self, linears: &[f64; 3], rotaries: &[f64; 2]) -> Vec<f64> {
        let mut values = vec![0.0; self.axes.len()];
        let linears = self.linears.iter().zip(linears);
        for (place, value) in linears.chain(self.rotaries.iter().zip(rotaries)) {
            if let Some(slot) = values.get_mut(*place) {
                *slot = *value;
            }
        }
        values
    }
}

/// Returns whether no rotary axis turns the direction of a linear one: seen from the workpiece or the tool, the
/// linear axes come last.
fn is_rigid(links: &[ChainLink]) -> bool {
    let first = links.iter().position(|link| matches!(link, ChainLink::Slide(..))).unwrap_or(links.len());
    links.iter().skip(first).all(|link| matches!(link, ChainLink::Slide(..)))
}
