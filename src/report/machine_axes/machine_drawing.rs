//! This module draws a machine: its axes where they lie with all values at 0, seen from the front and the side.

use crate::machine::{AxisKind, AxisMount, KinematicChain, MachineAxis};
use crate::report::escaping::escape_html;
use crate::report::text_format::format_short;
use nalgebra::{Point3, Vector3};
use std::fmt::Write as _;

/// The size of a view and the margin around it, in pixels.
const VIEW: f64 = 520.0;
const MARGIN: f64 = 60.0;

/// A direction of view, as the directions that go right and up in the drawing.
struct MachineView {
    title: &'static str,
    right: Vector3<f64>,
    up: Vector3<f64>,
}

/// Draws a machine as SVG. Lines are rotary axes, with an arrow in their positive sense; short arrows are the motions of
/// linear axes; the tool stands at the zero of the workpiece.
pub fn draw_machine(chain: &KinematicChain, name: &str) -> String {
    let views = [
        MachineView { title: "from the front: x, z", right: Vector3::x(), up: Vector3::z() },
        MachineView { title: "from the right: y, z", right: Vector3::y(), up: Vector3::z() },
    ];
    let reach = chain.rotary_axes().map(|axis| axis.point.coords.norm()).fold(50.0, f64::max) * 1.3;
    let (width, height) = (2.0 * VIEW, VIEW + MARGIN);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    let _ = writeln!(out, "<text x=\"20\" y=\"30\" font-size=\"18\">{}</text>", escape_html(name));
    for (index, view) in views.iter().enumerate() {
        let scale = (VIEW / 2.0 - MARGIN) / reach;
        let center = (VIEW * (index as f64 + 0.5), MARGIN + VIEW / 2.0);
        let drawing = ViewDrawing { view, scale, center, reach };
        drawing.draw_view(chain, &mut out);
    }
    out.push_str("</svg>\n");
    out
}

/// Returns the colour of an axis: blue in the table, red in the head.
fn color_of(axis: &MachineAxis) -> &'static str {
    if axis.mount == AxisMount::Table { "#005ab5" } else { "#dc3220" }
}

struct ViewDrawing<'v> {
    view: &'v MachineView,
    scale: f64,
    center: (f64, f64),
    reach: f64,
}

impl ViewDrawing<'_> {
    /// Returns how far an axis goes into the drawing, from 0 to 1.
    fn depth(&self, axis: &MachineAxis) -> f64 {
        self.view.right.cross(&self.view.up).dot(&axis.direction).abs()
    }

    fn place(&self, point: &Vector3<f64>) -> (f64, f64) {
        let (right, up) = (self.view.right.dot(point), self.view.up.dot(point));
        (self.center.0 + right * self.scale, self.center.1 - up * self.scale)
    }

    fn draw_view(&self, chain: &KinematicChain, out: &mut String) {
        let (x, y) = self.center;
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#555\">{}</text>",
            x,
            y + VIEW / 2.0 - 16.0,
            self.view.title
        );
        let origin = Vector3::zeros();
        let tool = *chain.tool_axis() * (self.reach * 0.35);
        self.draw_line(&origin, &tool, "#888", 9.0, out);
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"black\"/>");
        let mut linears: Vec<&MachineAxis> = chain.linear_axes().collect();
        // What goes into the drawing lies on the arrows of the others.
        linears.sort_by(|a, b| self.depth(a).total_cmp(&self.depth(b)));
        for axis in linears {
            self.draw_linear(axis, out);
        }
        for axis in chain.rotary_axes() {
            self.draw_rotary(axis, out);
        }
    }

    fn draw_line(&self, from: &Vector3<f64>, to: &Vector3<f64>, color: &str, width: f64, out: &mut String) {
        let ((x1, y1), (x2, y2)) = (self.place(from), self.place(to));
        let _ = writeln!(
            out,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{color}\" stroke-width=\"{width}\"/>"
        );
    }

    fn draw_text(&self, at: &Vector3<f64>, text: &str, color: &str, out: &mut String) {
        let (x, y) = self.place(at);
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" fill=\"{color}\">{}</text>",
            x + 8.0,
            y - 8.0,
            escape_html(text)
        );
    }

    /// Draws a rotary axis as a line through its point, with an arrow head at its positive end. One that goes into the
    /// drawing is a circle with a dot.
    fn draw_rotary(&self, axis: &MachineAxis, out: &mut String) {
        let color = color_of(axis);
        let point = Point3::from(axis.point).coords;
        let half = *axis.direction * (self.reach * 0.6);
        self.draw_arrow(&(point - half), &(point + half), color, out);
        let (x, y) = self.place(&point);
        let _ = writeln!(
            out,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>"
        );
        let range = match axis.limits {
            Some([low, high]) => format!("{low} to {high} deg"),
            None => "without end".to_owned(),
        };
        let [px, py, pz] = <[f64; 3]>::from(point).map(format_short);
        let label = format!("{}: {range}, through ({px}, {py}, {pz})", axis.name);
        self.draw_text(&point, &label, color, out);
    }

    /// Draws the motion of a linear axis in the corner of the view. One that goes into the drawing is a circle.
    fn draw_linear(&self, axis: &MachineAxis, out: &mut String) {
        debug_assert!(axis.kind == AxisKind::Linear, "rotary axes are drawn as lines");
        let color = color_of(axis);
        let corner = (self.view.right + self.view.up) * (-0.8 * self.reach);
        let end = corner + *axis.direction * (0.25 * self.reach);
        let ((x1, y1), (x2, y2)) = (self.place(&corner), self.place(&end));
        if (x2 - x1).hypot(y2 - y1) >= 1.0 {
            self.draw_arrow(&corner, &end, color, out);
            return self.draw_text(&end, &axis.name, color, out);
        }
        let _ = writeln!(
            out,
            "<circle cx=\"{x1:.1}\" cy=\"{y1:.1}\" r=\"5\" fill=\"white\" stroke=\"{color}\" stroke-width=\"2\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" fill=\"{color}\">{}</text>",
            x1 - 20.0,
            y1 + 18.0,
            escape_html(&axis.name)
        );
    }

    fn draw_arrow(&self, from: &Vector3<f64>, to: &Vector3<f64>, color: &str, out: &mut String) {
        self.draw_line(from, to, color, 2.5, out);
        let ((x1, y1), (x2, y2)) = (self.place(from), self.place(to));
        let (dx, dy) = (x2 - x1, y2 - y1);
        let length = dx.hypot(dy);
        if length < 1.0 {
            return;
        }
        let (ux, uy) = (dx / length * 10.0, dy / length * 10.0);
        let _ = writeln!(
            out,
            "<polygon points=\"{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}\" fill=\"{color}\"/>",
            x2,
            y2,
            x2 - ux - uy * 0.5,
            y2 - uy + ux * 0.5,
            x2 - ux + uy * 0.5,
            y2 - uy - ux * 0.5
        );
    }
}
