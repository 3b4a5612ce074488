//! Prints `examples/figurine/part.cls`: a figurine of two blended spheres, roughed out of a round bar layer by layer.
//!
//! ```sh
//! cargo run --example figurine > examples/figurine/part.cls
//! ```
//!
//! # The part
//!
//! A solid of revolution about z. In the half-plane of r (distance from z) and z its outline is three arcs: a sphere of radius 12, a
//! fillet of radius 6, a sphere of radius 24 down to its equator. The spheres' centres are 24 apart, so the fillet's centre is as high
//! as the small sphere's: it is 12 + 6 from that one, 24 + 6 from the large one, and 18² + 24² = 30². With heights from the large
//! sphere's centre,
//!
//! ```text
//! 24.0 <= z <= 36.0    r(z) = sqrt(12² - (z - 24)²)
//! 19.2 <= z <= 24.0    r(z) = 18 - sqrt(6² - (z - 24)²)        19.2 = 24 * 24 / 30: where fillet and large sphere touch
//!  0.0 <= z <= 19.2    r(z) = sqrt(24² - z²)
//! ```
//!
//! It never gets narrower downwards, so a cutter from above reaches all of it.
//!
//! # The cutter
//!
//! The surface at a distance `d` outside the part has the same centres: spheres of radius 12 + d and 24 + d, a fillet of radius 6 - d. A
//! bull-nose cutter touches the part when the centre of its corner (radius c = 3) is c outside it. That centre is c above the tip, and
//! D/2 - c = 3 from the cutter's axis, so at the tip's height z the axis stays away from the part's by
//!
//! ```text
//! R(z) = D/2 - c + r_c(z + c)
//! ```
//!
//! and nothing of the cutter above the corner comes nearer, since the part only gets narrower there.

use std::io::{self, Write};

/// An arc of the outline; heights in the coordinates of the program.
struct OutlineArc {
    radius: f64,
    from_axis: f64,
    height: f64,
}

/// The bar's upper face is z 0; the figurine's top is as low as the first layer.
const SMALL: OutlineArc = OutlineArc { radius: 12.0, from_axis: 0.0, height: -13.0 };
const FILLET: OutlineArc = OutlineArc { radius: 6.0, from_axis: 18.0, height: -13.0 };
const LARGE: OutlineArc = OutlineArc { radius: 24.0, from_axis: 0.0, height: -37.0 };

const BAR_RADIUS: f64 = 30.0;
const CUTTER_RADIUS: f64 = 6.0;
const CORNER_RADIUS: f64 = 3.0;

/// Layers of 1 mm, down to the large sphere's equator.
const LAYERS: u32 = 37;
/// Between two circles of a layer.
const RADIAL_STEP: f64 = 1.0;
/// Less than this is not left for a circle of its own.
const LEAST_REST: f64 = 0.1;
/// mm/min for everything, made for the steps from circle to circle. They cut with full width, and 1 mm deep the corner's chip is
/// sqrt(1 - (2/3)²) = 0.745 of the feed per tooth: 0.060 mm with five teeth at 5000 rev/min, of 0.065 that the tool stands. Where such a
/// step ends at the part it also meets the stairs that the layers above have left, higher up on the corner: up to 0.080 mm.
const FEED: f64 = 2000.0;

/// Beside the bar, where the cutter goes down.
const BESIDE: f64 = BAR_RADIUS + CUTTER_RADIUS + 3.0;
/// Above everything.
const CLEAR: f64 = 10.0;

/// Distance from z of the surface `outside` the part, at a height. 0 where it is all below.
fn outline(outside: f64, height: f64) -> f64 {
    // Fillet and large sphere touch on the line between their centres.
    let touch = LARGE.height
        + (FILLET.height - LARGE.height) * (LARGE.radius + outside) / (LARGE.radius + FILLET.radius);
    let (arc, radius, side) = if height >= FILLET.height {
        (SMALL, SMALL.radius + outside, 1.0)
    } else if height >= touch {
        (FILLET, FILLET.radius - outside, -1.0)
    } else {
        (LARGE, LARGE.radius + outside, 1.0)
    };
    let half_chord = (radius.powi(2) - (height - arc.height).powi(2)).max(0.0).sqrt();
    arc.from_axis + side * half_chord
}

/// Radius of the circle on which the cutter, its tip at a height, touches the part.
fn touching(tip: f64) -> f64 {
    CUTTER_RADIUS - CORNER_RADIUS + outline(CORNER_RADIUS, tip + CORNER_RADIUS)
}

/// The circles of a layer: from outside inwards, the last one on the part.
fn circles(tip: f64) -> Vec<f64> {
    let last = touching(tip);
    let radii = (1..).map(|number| BAR_RADIUS + CUTTER_RADIUS - f64::from(number) * RADIAL_STEP);
    radii.take_while(|radius| *radius > last + LEAST_REST).chain([last]).collect()
}

/// What motions are for, in NX's colours.
#[derive(Clone, Copy)]
enum Color {
    Engage = 42,
    Cut = 31,
    StepOver = 36,
    Retract = 37,
    Rapid = 211,
}

/// The program's lines.
struct Lines(Vec<String>);

impl Lines {
    fn say(&mut self, line: &str) {
        self.0.push(line.to_owned());
    }

    fn color(&mut self, color: Color) {
        self.0.push(format!("PAINT/COLOR,{}", color as u8));
    }

    fn to(&mut self, x: f64, y: f64, z: f64) {
        self.0.push(format!("GOTO/{x:.4},{y:.4},{z:.4}"));
    }

    fn rapid(&mut self, x: f64, z: f64) {
        self.say("RAPID");
        self.to(x, 0.0, z);
    }

    /// Clockwise seen from above, so that a spindle that turns clockwise mills with the feed; in quarters, which NX marks by an axis that
    /// points up, since its arcs are left-handed.
    fn circle(&mut self, radius: f64, z: f64) {
        for (x, y) in [(0.0, -radius), (-radius, 0.0), (0.0, radius), (radius, 0.0)] {
            self.0.push(format!(
                "CIRCLE/0.0000,0.0000,{z:.4},0.0000000,0.0000000,1.0000000,{radius:.4},0.0600,0.5000,{:.4},{CORNER_RADIUS:.4}",
                2.0 * CUTTER_RADIUS
            ));
            self.to(x, y, z);
        }
    }

    /// Down beside the bar, in, round and round, and up again; `before` is what stands in front of the first cut.
    fn layer(&mut self, z: f64, before: Option<String>) {
        self.rapid(BESIDE, z + 1.0);
        self.color(Color::Engage);
        self.0.extend(before);
        self.to(BESIDE, 0.0, z);
        let mut radius = BESIDE;
        for next in circles(z) {
            if radius < BESIDE {
                self.color(Color::StepOver);
            }
            radius = next;
            self.to(radius, 0.0, z);
            self.color(Color::Cut);
            self.circle(radius, z);
        }
        self.color(Color::Retract);
        self.to(radius + 1.0, 0.0, z + 1.0);
        self.color(Color::Rapid);
        self.rapid(radius + 1.0, CLEAR);
    }
}

/// The whole program.
pub fn program() -> String {
    let mut lines = Lines(Vec::new());
    lines.say("TOOL PATH/FIGURINE_ROUGH,TOOL,BULL_D12R3");
    lines.say("TLDATA/MILL,12.0000,3.0000,60.0000,0.0000,0.0000");
    lines.say("MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000");
    lines.say("$$ centerline data");
    lines.say("PAINT/PATH");
    lines.say("PAINT/SPEED,10");
    lines.say("LOAD/TOOL,7,ADJUST,7");
    lines.say("SPINDL/RPM,5000,CLW");
    lines.say("COOLNT/ON");
    lines.say("PAINT/COLOR,186");
    lines.say("RAPID");
    lines.0.push(format!("GOTO/{BESIDE:.4},0.0000,{CLEAR:.4},0.0000000,0.0000000,1.0000000"));
    lines.color(Color::Rapid);
    for number in 1..=LAYERS {
        if number > 1 {
            lines.rapid(BESIDE, CLEAR);
        }
        lines.layer(-f64::from(number), (number == 1).then(|| format!("FEDRAT/MMPM,{FEED:.4}")));
    }
    lines.say("PAINT/SPEED,10");
    lines.say("PAINT/TOOL,NOMORE");
    lines.say("END-OF-PATH");
    lines.say("");
    lines.0.join("\n")
}

fn main() -> io::Result<()> {
    io::stdout().write_all(program().as_bytes())
}
