// The tool at a place: flutes, shank and holder around its axis.

const AROUND = 40;

// Turns points (r, z) around z.
function turnedGeometry(points) {
  const places = [], faces = [];
  for (const [r, z] of points) {
    for (let i = 0; i < AROUND; i++) {
      const angle = (i / AROUND) * 2 * Math.PI;
      places.push(r * Math.cos(angle), r * Math.sin(angle), z);
    }
  }
  for (let ring = 0; ring + 1 < points.length; ring++) {
    for (let i = 0; i < AROUND; i++) {
      const a = ring * AROUND + i, b = ring * AROUND + ((i + 1) % AROUND);
      faces.push(a, b, b + AROUND, a, b + AROUND, a + AROUND);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places), 3));
  geometry.setIndex(faces);
  geometry.computeVertexNormals();
  return geometry;
}

class ToolMesh {
  constructor() {
    this.group = new THREE.Group();
    const material = () => new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.75, side: THREE.DoubleSide });
    this.materials = { flutes: material(), shank: material(), holder: material() };
    this.shape = null;
    this.recolor();
  }

  recolor() {
    const set = (material, [r, g, b]) => material.color.setRGB(r / 255, g / 255, b / 255);
    set(this.materials.flutes, theme.colors.flutes);
    set(this.materials.shank, theme.colors.holder);
    set(this.materials.holder, theme.colors.holder);
  }

  // Shows a tool (null where its shape is not known) with its tip at a point and its axis along a direction.
  show(shape, point, axis) {
    if (shape !== this.shape) {
      this.group.children.slice().forEach((mesh) => { this.group.remove(mesh); mesh.geometry.dispose(); });
      this.shape = shape;
      if (shape) {
        const top = shape.profile[shape.profile.length - 1];
        this.add([...shape.profile, [0, top[1]]], "flutes");
        for (const { kind, radius, from, to } of shape.collars) this.add([[0, from], [radius, from], [radius, to], [0, to]], kind);
      }
    }
    this.group.visible = this.wanted !== false && Boolean(shape);
    this.group.position.set(...point);
    this.group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...axis).normalize());
  }

  add(points, kind) {
    const mesh = new THREE.Mesh(turnedGeometry(points), this.materials[kind]);
    mesh.frustumCulled = false;
    this.group.add(mesh);
  }
}
