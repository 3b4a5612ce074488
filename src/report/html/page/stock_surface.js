// The stock as a surface: heights on a grid, walls down to its base where it ends, and the face of a section.

class StockSurface {
  constructor(states) {
    this.states = states;
    this.geometry = new THREE.BufferGeometry();
    const offset = { polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8, side: THREE.DoubleSide };
    this.plain = new THREE.MeshLambertMaterial({ ...offset, flatShading: true });
    // A surface that means something by its colours is drawn without light, so that it has those of the legend.
    this.flat = new THREE.MeshBasicMaterial({ ...offset, vertexColors: true });
    this.mesh = new THREE.Mesh(this.geometry, this.plain);
    this.mesh.frustumCulled = false;
    this.face = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
    this.face.frustumCulled = false;
    this.face.visible = false;
    this.recolor();
  }

  recolor() {
    const [r, g, b] = theme.colors.stock;
    this.plain.color.setRGB(r / 255, g / 255, b / 255);
    this.face.material.color.setRGB(r / 370, g / 370, b / 370);
  }

  // Shows heights over the base. `colorOf(cell)` gives colours that mean something; without it the stock is grey.
  show(heights, colorOf) {
    const { columns, rows, cell, x0, y0 } = this.states.grid, { base } = this.states;
    this.heights = heights;
    const places = [], colors = [], faces = [], number = new Int32Array(columns * rows).fill(-1);
    // Outer columns reach to the border of their cells.
    const border = (index, count) => index + (index === 0 ? -0.5 : index === count - 1 ? 0.5 : 0);
    for (let row = 0, at = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++, at++) {
        if (heights[at] !== heights[at]) continue;
        number[at] = places.length / 3;
        places.push(x0 + border(column, columns) * cell, y0 + border(row, rows) * cell, base + heights[at]);
        if (colorOf) colors.push(...colorOf(at), 255);
      }
    }
    const whole = (column, row) => {
      if (column < 0 || row < 0 || column >= columns - 1 || row >= rows - 1) return false;
      const at = row * columns + column;
      return number[at] >= 0 && number[at + 1] >= 0 && number[at + columns] >= 0 && number[at + columns + 1] >= 0;
    };
    const wall = (a, b) => {
      const start = places.length / 3;
      for (const i of [a, b]) {
        places.push(places[3 * i], places[3 * i + 1], base);
        if (colorOf) colors.push(...theme.colors.unknown, 255);
      }
      faces.push(a, start, start + 1, a, start + 1, b);
    };
    for (let row = 0; row < rows - 1; row++) {
      for (let column = 0; column < columns - 1; column++) {
        if (!whole(column, row)) continue;
        const at = row * columns + column;
        const [a, b, c, d] = [number[at], number[at + 1], number[at + columns + 1], number[at + columns]];
        faces.push(a, b, c, a, c, d);
        if (!whole(column, row - 1)) wall(a, b);
        if (!whole(column + 1, row)) wall(b, c);
        if (!whole(column, row + 1)) wall(c, d);
        if (!whole(column - 1, row)) wall(d, a);
      }
    }
    this.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places), 3));
    if (colorOf) this.geometry.setAttribute("color", new THREE.BufferAttribute(new Uint8Array(colors), 4, true));
    else this.geometry.deleteAttribute("color");
    this.geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(faces), 1));
    this.geometry.computeBoundingBox();
    this.mesh.material = colorOf ? this.flat : this.plain;
    this.cut();
  }

  // Where a section stands: its axis (0 is x, 1 is y) and place; null for none.
  setSection(section) {
    this.section = section;
    this.cut();
  }

  // The face of the section: from the base up to the heights along it.
  cut() {
    const { section } = this;
    this.face.visible = Boolean(section) && section.axis < 2;
    if (!this.face.visible) return;
    const { columns, rows, cell, x0, y0 } = this.states.grid, { base } = this.states, places = [], faces = [];
    const alongX = section.axis === 1, count = alongX ? columns : rows;
    const across = Math.round((section.at - (alongX ? y0 : x0)) / cell);
    if (across < 0 || across >= (alongX ? rows : columns)) { this.face.visible = false; return; }
    let open = false;
    for (let i = 0; i < count; i++) {
      const height = this.heights[alongX ? across * columns + i : i * columns + across];
      if (height !== height) { open = false; continue; }
      const [x, y] = alongX ? [x0 + i * cell, section.at] : [section.at, y0 + i * cell], at = places.length / 3;
      places.push(x, y, base, x, y, base + height);
      if (open) faces.push(at - 2, at, at - 1, at - 1, at, at + 1);
      open = true;
    }
    this.face.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places), 3));
    this.face.geometry.setIndex(faces);
  }
}

// How a cell is coloured by how far it is above or below the target: `colorOf`, and what the legend says.
function deviationColoring(deviations) {
  const sizes = Array.from(deviations).filter((value) => value === value).map(Math.abs).sort((a, b) => a - b);
  // A few columns at steep walls are off by their whole height, and would leave all others without colour.
  const most = sizes[Math.floor(sizes.length * 0.95)] || 1e-3, table = RAMP_TABLES.deviation;
  const colorOf = (cell) => {
    const off = deviations[cell];
    return off === off ? table[Math.round((Math.min(Math.max(off / most, -1), 1) + 1) * 127.5)] : theme.colors.unknown;
  };
  const end = most.toFixed(3 + MORE);
  return { colorOf, range: [`missing ${end}`, `left ${end}`], title: `off the target, ${LENGTH}`, table };
}
