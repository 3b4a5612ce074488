//! This module holds points, lines and arcs in the (u, z) plane.

/// A point of the plane, mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// The coordinate along the pass.
    pub u: f64,
    /// The coordinate along the tool axis, upwards.
    pub z: f64,
}

impl Point {
    /// Makes the point at (u, z).
    pub const fn new(u: f64, z: f64) -> Self {
        Self { u, z }
    }

    /// Returns the distance to another point, mm.
    pub fn distance(self, other: Self) -> f64 {
        // Coordinates are at most ten kilometres, so squares cannot overflow, and `hypot` would be slow.
        let (du, dz) = (self.u - other.u, self.z - other.z);
        (du * du + dz * dz).sqrt()
    }

    /// Returns the point at the fraction `t` of the line to `other`.
    pub fn lerp(self, other: Self, t: f64) -> Self {
        Self { u: self.u + (other.u - self.u) * t, z: self.z + (other.z - self.z) * t }
    }
}

/// A straight piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePiece {
    /// The start.
    pub from: Point,
    /// The end.
    pub to: Point,
}

/// A piece of a circle; angles are in radians from +u towards +z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcPiece {
    /// The centre.
    pub centre: Point,
    /// The radius, mm.
    pub radius_mm: f64,
    /// The angle of the start, seen from the centre.
    pub start_rad: f64,
    /// The angle from start to end: positive from +u towards +z, negative in the other direction.
    pub sweep_rad: f64,
}

/// A line or an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChainPiece {
    /// A straight piece.
    Line(LinePiece),
    /// An arc.
    Arc(ArcPiece),
}

impl ArcPiece {
    /// Returns the point at an angle.
    pub fn point_at_angle(&self, angle_rad: f64) -> Point {
        let (sin, cos) = angle_rad.sin_cos();
        Point::new(self.centre.u + self.radius_mm * cos, self.centre.z + self.radius_mm * sin)
    }

    /// Returns the height of the arc over its chord (its sagitta), mm. For more than half a turn it is the
    /// distance of the furthest point.
    pub fn sagitta_mm(&self) -> f64 {
        self.radius_mm * (1.0 - (self.sweep_rad.abs() / 2.0).min(std::f64::consts::PI).cos())
    }
}

impl ChainPiece {
    /// Makes a straight piece.
    pub const fn line(from: Point, to: Point) -> Self {
        Self::Line(LinePiece { from, to })
    }

    /// Makes an arc.
    pub const fn arc(centre: Point, radius: f64, start: f64, sweep: f64) -> Self {
        Self::Arc(ArcPiece { centre, radius_mm: radius, start_rad: start, sweep_rad: sweep })
    }

    /// Returns the start.
    pub fn start(&self) -> Point {
        match self {
            Self::Line(line) => line.from,
            Self::Arc(arc) => arc.point_at_angle(arc.start_rad),
        }
    }

    /// Returns the end.
    pub fn end(&self) -> Point {
        match self {
            Self::Line(line) => line.to,
            Self::Arc(arc) => arc.point_at_angle(arc.start_rad + arc.sweep_rad),
        }
    }

    /// Returns the point at a fraction `t` (0 to 1) of the length.
    pub fn point_at(&self, t: f64) -> Point {
        match self {
            Self::Line(line) => line.from.lerp(line.to, t),
            Self::Arc(arc) => arc.point_at_angle(arc.start_rad + arc.sweep_rad * t),
        }
    }

    /// Returns the direction at a fraction `t` of the length as a unit vector, or zero if the piece has no
    /// length.
    pub fn direction_at(&self, t: f64) -> Point {
        match self {
            Self::Line(line) => {
                let length = line.from.distance(line.to);
                if length > 0.0 {
                    Point::new((line.to.u - line.from.u) / length, (line.to.z - line.from.z) / length)
                } else {
                    Point::default()
                }
            }
            Self::Arc(arc) => {
                let (sin, cos) = (arc.start_rad + arc.sweep_rad * t).sin_cos();
                let sense = if arc.sweep_rad == 0.0 { 0.0 } else { arc.sweep_rad.signum() };
                Point::new(-sin * sense, cos * sense)
            }
        }
    }

    /// Returns the length, mm.
    pub fn length_mm(&self) -> f64 {
        match self {
            Self::Line(line) => line.from.distance(line.to),
            Self::Arc(arc) => arc.radius_mm * arc.sweep_rad.abs(),
        }
    }

    /// Returns the same piece from its end to its start.
    pub fn reversed(&self) -> Self {
        match self {
            Self::Line(line) => Self::line(line.to, line.from),
            Self::Arc(arc) => Self::Arc(ArcPiece {
                start_rad: arc.start_rad + arc.sweep_rad,
                sweep_rad: -arc.sweep_rad,
                ..*arc
            }),
        }
    }

    /// Returns the same piece, moved.
    pub fn shifted(&self, du: f64, dz: f64) -> Self {
        let moved = |point: Point| Point::new(point.u + du, point.z + dz);
        match self {
            Self::Line(line) => Self::line(moved(line.from), moved(line.to)),
            Self::Arc(arc) => Self::Arc(ArcPiece { centre: moved(arc.centre), ..*arc }),
        }
    }

    /// Returns the same piece with z mirrored.
    pub fn flipped(&self) -> Self {
        let over = |point: Point| Point::new(point.u, -point.z);
        match self {
            Self::Line(line) => Self::line(over(line.from), over(line.to)),
            Self::Arc(arc) => Self::arc(over(arc.centre), arc.radius_mm, -arc.start_rad, -arc.sweep_rad),
        }
    }

    /// Returns the part between two fractions of the length.
    pub fn sub_piece(&self, from: f64, to: f64) -> Self {
        match self {
            Self::Line(_) => Self::line(self.point_at(from), self.point_at(to)),
            Self::Arc(arc) => Self::Arc(ArcPiece {
                start_rad: arc.start_rad + arc.sweep_rad * from,
                sweep_rad: arc.sweep_rad * (to - from),
                ..*arc
            }),
        }
    }
}
