//! Programs as CAM systems write them, made anew: the shares of their statements, the lengths of their lines and
//! their columns are those of real files, their numbers are computed.

use std::fmt::Write as _;

/// What a benchmark's program is like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mix {
    /// Six-value GOTOs and nothing else.
    Gotos,
    /// NX: of 1,000 statements 555 GOTO (a tenth with six values), 110 CIRCLE, 105 PAINT, 60 RAPID, 40 CUTCOM,
    /// 30 FEDRAT, further comments, tools, speeds and the frame of an operation every 4,000.
    Nx,
    /// CATIA: aligned columns, arcs in three lines continued with `$`, a feed every eleven statements, numbers and
    /// words broken in column 72.
    Catia,
}

impl Mix {
    /// Returns a program of at least so many bytes.
    pub fn write_program(self, bytes: usize) -> String {
        let mut text = String::with_capacity(bytes + 4096);
        match self {
            Self::Gotos => write_gotos(&mut text, bytes),
            Self::Nx => write_nx(&mut text, bytes),
            Self::Catia => write_catia(&mut text, bytes),
        }
        text
    }

    /// The name in the table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gotos => "six-value GOTOs",
            Self::Nx => "NX mix",
            Self::Catia => "CATIA mix",
        }
    }

    /// The ending of its files.
    pub fn file_name(self) -> &'static str {
        if self == Self::Catia { "part.aptsource" } else { "part.cls" }
    }
}

/// Writes to a string, which cannot fail.
macro_rules! put {
    ($text:expr, $($part:tt)*) => { writeln!($text, $($part)*).expect("a string grows") };
}

fn write_gotos(text: &mut String, bytes: usize) {
    text.push_str("TOOL PATH/BENCH,TOOL,BALL\nTLDATA/MILL,10.0000,5.0000,75.0000,0.0000,0.0000\n");
    text.push_str("FEDRAT/MMPM,1000.0000\n");
    let mut step = 0.0_f64;
    while text.len() < bytes {
        let (sin, cos) = (step * 0.01).sin_cos();
        let tilt = 0.3 * (step * 0.003).sin();
        let (x, y, z) = (300.0 * cos, 300.0 * sin, step * 1e-4);
        let (i, j, k) = (tilt * cos, tilt * sin, (1.0 - tilt * tilt).sqrt());
        put!(text, "GOTO/{x:.4},{y:.4},{z:.4},{i:.7},{j:.7},{k:.7}");
        step += 1.0;
    }
    text.push_str("END-OF-PATH\n");
}

/// One level after the other: down, in by an arc, along walls and round corners, out by an arc, over at rapid.
fn write_nx(text: &mut String, bytes: usize) {
    let mut level = 0_u32;
    while text.len() < bytes {
        if level.is_multiple_of(200) {
            start_nx_operation(text, level / 200);
        }
        let depth = -0.5 - f64::from(level % 200) * 0.25;
        let (x, y) = (f64::from(level % 37) * 3.25, f64::from(level % 23) * 2.5 - 20.0);
        put!(text, "PAINT/COLOR,211\nRAPID\nGOTO/{x:.4},{y:.4},25.0000");
        put!(text, "PAINT/COLOR,186\nRAPID\nGOTO/{x:.4},{y:.4},{:.4}", depth + 3.0);
        put!(
            text,
            "PAINT/COLOR,42\nFEDRAT/MMPM,{}.0000\nGOTO/{x:.4},{y:.4},{depth:.4}",
            200 + level % 7 * 50
        );
        put!(text, "CUTCOM/LEFT,XYPLAN");
        write_nx_corner(text, (x, y), depth, 4.0, 0.0);
        put!(text, "PAINT/COLOR,31\nFEDRAT/{}.0000", 800 + level % 5 * 100);
        for corner in 0..4_u8 {
            let angle = f64::from(corner) * std::f64::consts::FRAC_PI_2;
            for point in 0..4_u8 {
                let along = f64::from(point) * 7.3 + 1.1;
                let (px, py) = (x + along * angle.cos(), y + along * angle.sin());
                if point == 2 && corner % 2 == 1 {
                    let tilt = 0.002 * f64::from(level % 90 + 1);
                    let k = (1.0 - tilt * tilt).sqrt();
                    put!(text, "GOTO/{px:.4},{py:.4},{depth:.4},{tilt:.7},0.0000000,{k:.7}");
                } else {
                    put!(text, "GOTO/{px:.4},{py:.4},{depth:.4}");
                }
            }
            write_nx_corner(text, (x, y), depth, 26.0, angle);
        }
        put!(text, "PAINT/COLOR,37");
        write_nx_corner(text, (x + 1.0, y), depth, 4.0, 1.0);
        put!(text, "CUTCOM/OFF\nGOTO/{x:.4},{y:.4},{:.4},0.0000000,0.0000000,1.0000000", depth + 1.0);
        if level.is_multiple_of(3) {
            put!(text, "$$ level {level} of the pocket");
        }
        level += 1;
    }
    text.push_str("PAINT/SPEED,10\nPAINT/TOOL,NOMORE\nEND-OF-PATH\n");
}

fn start_nx_operation(text: &mut String, number: u32) {
    if number > 0 {
        text.push_str("PAINT/SPEED,10\nPAINT/TOOL,NOMORE\nEND-OF-PATH\n");
    }
    put!(text, "TOOL PATH/FINISH_{number},TOOL,MILL_{}", number % 12);
    put!(text, "TLDATA/MILL,10.0000,1.0000,75.0000,0.0000,0.0000");
    put!(text, "MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000");
    put!(text, "$$ centerline data\nPAINT/PATH\nPAINT/SPEED,10\nLOAD/TOOL,{0},ADJUST,{0}", number % 12 + 1);
    put!(text, "SPINDL/RPM,{},CLW ", 4000 + number % 10 * 250);
    put!(text, "COOLNT/FLOOD\nGOTO/0.0000,0.0000,50.0000,0.0000000,0.0000000,1.0000000");
}

/// A quarter of a circle from the point that lies at an angle, with the move to its start.
fn write_nx_corner(text: &mut String, (x, y): (f64, f64), z: f64, radius: f64, angle: f64) {
    let (sin, cos) = angle.sin_cos();
    put!(text, "GOTO/{:.4},{:.4},{z:.4}", x + radius * cos, y + radius * sin);
    put!(
        text,
        "CIRCLE/{x:.4},{y:.4},{z:.4},0.0000000,0.0000000,-1.0000000,{radius:.4},0.0600,0.5000,10.0000,1.0000"
    );
    put!(text, "GOTO/{:.4},{:.4},{z:.4}", x - radius * sin, y + radius * cos);
}

fn write_catia(text: &mut String, bytes: usize) {
    let rule = "-".repeat(65);
    put!(
        text,
        "$$ {rule}\n$$     Generated on Monday, January 5, 2026 08:00:00\n$$     CATIA APT VERSION 1.0"
    );
    put!(text, "$$ {rule}\n$$ Manufacturing Program.1\n$$  Part Operation.1\n$$*CATIA0\n$$ Part Operation.1");
    for row in [
        "1.00000     0.00000     0.00000",
        "0.00000     1.00000     0.00000",
        "0.00000     0.00000     1.00000",
    ] {
        put!(text, "$$     {row}     0.00000");
    }
    put!(text, "PARTNO PART TO BE MACHINED");
    let mut ring = 0_u32;
    while text.len() < bytes {
        if ring.is_multiple_of(300) {
            start_catia_operation(text, ring / 300);
        }
        write_catia_ring(text, ring);
        ring += 1;
    }
    put!(text, "SPINDL/OFF\nREWIND/0\nEND\n");
}

fn start_catia_operation(text: &mut String, number: u32) {
    put!(text, "$$ OPERATION NAME : Tool Change.{number}\n$$  Start generation of : Tool Change.{number}");
    put!(text, "TLAXIS/ 0.000000, 0.000000, 1.000000\n$$ TOOLCHANGEBEGINNING");
    put!(
        text,
        "CUTTER/ 20.000000, 10.000000,  0.000000, 10.000000,  0.000000,$\n         0.000000, 90.000000"
    );
    put!(text, "TOOLNO/{number},   20.000000\nTPRINT/T{number} Ball D20,T{number} Ball D20");
    put!(text, "LOADTL/{number}\n$$ TOOLCHANGEEND\n$$  End of generation of : Tool Change.{number}");
    put!(text, "$$ OPERATION NAME : Contouring.{number}\n$$  Start generation of : Contouring.{number}");
    put!(text, "LOADTL/{number},1\nSPINDL/ 2500.0000,RPM,CLW\nPPRINT OPERATION: contour {number}");
}

/// A spiral in, two arcs that make a circle, and a spiral out; one with a tool that turns in seven.
fn write_catia_ring(text: &mut String, ring: u32) {
    let z = -0.2 * f64::from(ring % 300);
    let radius = 45.0 + f64::from(ring % 13) * 0.25;
    put!(text, "RAPID\nGOTO  /{radius:11.5},{:11.5},{:11.5}", 0.0, z + 5.0);
    put!(text, "FEDRAT/{:10.4},MMPM", 100.0 + f64::from(ring % 9) * 50.0);
    for point in 0..22_u8 {
        let (sin, cos) = (f64::from(21 - point) * 0.07).sin_cos();
        put!(text, "GOTO  /{:11.5},{:11.5},{:11.5}", radius - 2.0 + 2.0 * cos, 2.0 * sin, z);
    }
    put!(text, "FEDRAT/{:10.4},MMPM\nAUTOPS", 1000.0);
    // The first arc is longer than half a circle, which `2,INTOF` says.
    for (from, to) in [(0.0_f64, 200.0_f64), (200.0, 360.0)] {
        let (sin, cos) = from.to_radians().sin_cos();
        put!(text, "INDIRV/{:11.5},{cos:11.5},{:11.5}", -sin, 0.0);
        put!(text, "TLON,GOFWD/      (CIRCLE/{:13.5},{:13.5},{z:13.5},$", 0.0, 0.0);
        if to - from > 180.0 {
            put!(
                text,
                "{radius:14.5}),ON,2,INTOF,$\n                   (LINE/{:13.5},{:13.5},{z:13.5},$",
                0.0,
                0.0
            );
        } else {
            put!(text, "{radius:14.5}),ON,(LINE/{:13.5},{:13.5},{z:13.5},$", 0.0, 0.0);
        }
        let (sin, cos) = to.to_radians().sin_cos();
        put!(text, "                          {:13.5},{:13.5},{z:13.5})", radius * cos, radius * sin);
    }
    put!(text, "FEDRAT/{:10.4},MMPM", 1000.0);
    for point in 0..22_u8 {
        let (sin, cos) = (f64::from(point) * 0.07).sin_cos();
        put!(text, "GOTO  /{:11.5},{:11.5},{:11.5}", radius - 2.0 + 2.0 * cos, -2.0 * sin, z);
    }
    if ring.is_multiple_of(7) {
        write_catia_axes(text, radius, z);
    }
}

/// Moves with six values, each broken where its line is full: inside a number.
fn write_catia_axes(text: &mut String, radius: f64, z: f64) {
    put!(text, "MULTAX");
    for point in 0..8_u8 {
        let tilt = f64::from(point) * 0.01;
        let line = format!(
            "GOTO  /{radius:13.6},{:13.6},{z:13.6},{tilt:11.7},{:11.7},{:11.7}",
            f64::from(point),
            0.0,
            (1.0 - tilt * tilt).sqrt()
        );
        let (head, tail) = line.split_at(71);
        put!(text, "{head}$\n{tail}");
    }
}
