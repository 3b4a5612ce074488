//! Solids that the tests are about, with all digits of their corners.

use clsmith::stock::Mesh;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

pub type Triangles = Vec<[[f64; 3]; 3]>;

/// Equal corners are one vertex.
pub fn mesh(triangles: &Triangles) -> Mesh {
    let mut known = HashMap::new();
    let mut vertices = Vec::new();
    let mut index = |at: [f64; 3]| {
        *known.entry(at.map(|value| (value + 0.0).to_bits())).or_insert_with(|| {
            vertices.push(at);
            vertices.len() as u32 - 1
        })
    };
    let triangles = triangles.iter().map(|triangle| triangle.map(&mut index)).collect();
    Mesh::new(vertices, triangles).unwrap()
}

/// A tetrahedron, facing outwards whichever way its corners go.
pub fn tetrahedron([a, b, c, d]: [[f64; 3]; 4]) -> Triangles {
    let [u, v, w] = [b, c, d].map(|corner| [0, 1, 2].map(|axis| corner[axis] - a[axis]));
    let volume = u[0] * (v[1] * w[2] - v[2] * w[1])
        + u[1] * (v[2] * w[0] - v[0] * w[2])
        + u[2] * (v[0] * w[1] - v[1] * w[0]);
    let (b, c) = if volume > 0.0 { (c, b) } else { (b, c) };
    vec![[a, b, c], [a, c, d], [a, d, b], [b, d, c]]
}

/// A box along the axes.
pub fn cube(from: [f64; 3], to: [f64; 3]) -> Triangles {
    let at = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { from[axis] } else { to[axis] });
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        .map(|q| q.map(at));
    quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// From z = -50 up to a height over the square within `half` of the origin, in `count` squares along each side.
pub fn terrain(half: f64, count: usize, height: impl Fn(f64, f64) -> f64) -> Triangles {
    let at = |i: usize| half * (2.0 * i as f64 / count as f64 - 1.0);
    let top = |i: usize, j: usize| [at(i), at(j), height(at(i), at(j))];
    let low = |i: usize, j: usize| [at(i), at(j), -50.0];
    let mut all = Vec::new();
    for j in 0..count {
        for i in 0..count {
            let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let (t, l) = ([a, b, c, d].map(|(i, j)| top(i, j)), [a, b, c, d].map(|(i, j)| low(i, j)));
            all.extend([[t[0], t[1], t[2]], [t[0], t[2], t[3]], [l[0], l[2], l[1]], [l[0], l[3], l[2]]]);
        }
        let n = count;
        for (a, b) in [((j, 0), (j + 1, 0)), ((j + 1, n), (j, n)), ((0, j + 1), (0, j)), ((n, j), (n, j + 1))]
        {
            let [ta, tb, la, lb] = [top(a.0, a.1), top(b.0, b.1), low(a.0, a.1), low(b.0, b.1)];
            all.extend([[ta, la, lb], [ta, lb, tb]]);
        }
    }
    all
}

/// A blade down to z = -50 with its edge between two points, 0.02 mm thick at the bottom.
pub fn blade(from: [f64; 3], to: [f64; 3]) -> Triangles {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let scale = 0.01 / f64::hypot(dx, dy);
    let below = |p: [f64; 3], side: f64| [p[0] - side * dy * scale, p[1] + side * dx * scale, -50.0];
    let [a, b, c, d] = [below(from, -1.0), below(from, 1.0), below(to, 1.0), below(to, -1.0)];
    let quad = |a, b, c, d| [[a, b, c], [a, c, d]];
    let mut all: Triangles = Vec::from([[from, b, a], [to, d, c]]);
    all.extend(quad(from, to, c, b));
    all.extend(quad(to, from, a, d));
    all.extend(quad(a, b, c, d));
    all
}

/// A needle down to z = -50, 0.02 mm thick there.
pub fn needle([x, y, z]: [f64; 3]) -> Triangles {
    let foot = |i: u32| {
        let (sin, cos) = (f64::from(i) * TAU / 3.0).sin_cos();
        [x + 0.01 * cos, y + 0.01 * sin, -50.0]
    };
    tetrahedron([[x, y, z], foot(0), foot(1), foot(2)])
}

/// A ball of triangles with their corners on it, round the origin.
pub fn sphere(radius: f64, fineness: usize) -> Triangles {
    let point = |i: usize, j: usize| {
        let (u, v) =
            ((i % (2 * fineness)) as f64 * TAU / (2 * fineness) as f64, j as f64 * PI / fineness as f64);
        if j == 0 || j == fineness {
            return [0.0, 0.0, if j == 0 { -radius } else { radius }];
        }
        [radius * v.sin() * u.cos(), radius * v.sin() * u.sin(), -radius * v.cos()]
    };
    let mut all = Vec::new();
    for i in 0..2 * fineness {
        for j in 0..fineness {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            all.extend([[a, b, c], [a, c, d]]);
        }
    }
    all.retain(|[a, b, c]| a != b && b != c && c != a);
    all
}
