// Marks that change often, in buffers that are made once and grow: points, lines, ellipses.

const above = 0.03;  // [m] marks lie above the ground

/** A round mark, as a picture for points. */
function roundMark() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const paint = canvas.getContext("2d");
  paint.fillStyle = "#fff";
  paint.arc(16, 16, 15, 0, 2 * Math.PI);
  paint.fill();
  return new THREE.CanvasTexture(canvas);
}
const roundTexture = roundMark();

/** Points of one colour, which keep their size on the screen. */
class Dots {
  constructor(colour, size) {
    this.capacity = 256;
    this.material = new THREE.PointsMaterial({ color: colour, size, map: roundTexture, alphaTest: 0.5, sizeAttenuation: false, depthTest: false, transparent: true });
    this.object = new THREE.Points(new THREE.BufferGeometry(), this.material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 3;
    this.count = 0;
    this.reserve(this.capacity);
  }

  reserve(count) {
    const values = new Float32Array(3 * count);
    if (this.values) values.set(this.values.subarray(0, 3 * this.count));
    this.values = values;
    this.capacity = count;
    this.object.geometry.dispose();
    this.object.geometry = new THREE.BufferGeometry();
    this.object.geometry.setAttribute("position", new THREE.BufferAttribute(values, 3));
  }

  put(number, x, y) {
    if (number >= this.capacity) this.reserve(Math.max(number + 1, 2 * this.capacity));
    this.values[3 * number] = x;
    this.values[3 * number + 1] = y;
    this.values[3 * number + 2] = above;
    this.count = Math.max(this.count, number + 1);
  }

  clear() { this.count = 0; }

  commit() {
    this.object.geometry.setDrawRange(0, this.count);
    this.object.geometry.attributes.position.needsUpdate = true;
  }
}

/** Straight lines, each end with a colour and all with one opacity. */
class Lines {
  constructor(most, opacity, order) {
    this.most = most;
    this.values = new Float32Array(6 * most);
    this.colours = new Float32Array(6 * most);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.values, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(this.colours, 3));
    const material = new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors, transparent: true, opacity, depthTest: false });
    this.object = new THREE.LineSegments(geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
    this.count = 0;
  }

  clear() { this.count = 0; }

  add(x1, y1, x2, y2, colour, z = above) {
    if (this.count >= this.most) return;
    const at = 6 * this.count++;
    this.values[at] = x1; this.values[at + 1] = y1; this.values[at + 2] = z;
    this.values[at + 3] = x2; this.values[at + 4] = y2; this.values[at + 5] = z;
    for (const end of [at, at + 3]) {
      this.colours[end] = colour.r; this.colours[end + 1] = colour.g; this.colours[end + 2] = colour.b;
    }
  }

  commit() {
    this.object.geometry.setDrawRange(0, 2 * this.count);
    this.object.geometry.attributes.position.needsUpdate = true;
    this.object.geometry.attributes.color.needsUpdate = true;
  }
}

const mostTrail = 20000;

/** A path; where it gets too long, every other point goes. */
class Trail {
  constructor(colour, order) {
    this.values = new Float32Array(3 * mostTrail);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.values, 3));
    this.object = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: colour, depthTest: false }));
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
    this.clear();
  }

  clear() { this.count = 0; }

  /** [x y x y ..] */
  append(points) {
    for (let i = 0; i + 1 < points.length; i += 2) {
      if (this.count >= mostTrail) this.halve();
      this.values[3 * this.count] = points[i];
      this.values[3 * this.count + 1] = points[i + 1];
      this.values[3 * this.count++ + 2] = 0.02;
    }
    this.object.geometry.setDrawRange(0, this.count);
    this.object.geometry.attributes.position.needsUpdate = true;
  }

  halve() {
    for (let i = 0; 2 * i < this.count; ++i)
      for (let axis = 0; axis < 3; ++axis) this.values[3 * i + axis] = this.values[6 * i + axis];
    this.count = Math.ceil(this.count / 2);
  }

  /** [x y x y ..] of all points. */
  points() {
    const points = new Float32Array(2 * this.count);
    for (let i = 0; i < this.count; ++i) {
      points[2 * i] = this.values[3 * i];
      points[2 * i + 1] = this.values[3 * i + 1];
    }
    return points;
  }
}

const mostEllipses = 1000;

/** Ellipses of two standard deviations: a pale disk and its edge. */
class Ellipses {
  constructor(colour) {
    this.object = new THREE.Group();
    this.disks = this.instances(new THREE.CircleBufferGeometry(1, 28), colour, 0.16);
    this.edges = this.instances(new THREE.RingBufferGeometry(0.93, 1, 28), colour, 0.85);
    this.matrix = new THREE.Matrix4();
    this.count = 0;
  }

  instances(geometry, colour, opacity) {
    const material = new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity, depthTest: false, side: THREE.DoubleSide });
    const mesh = new THREE.InstancedMesh(geometry, material, mostEllipses);
    mesh.frustumCulled = false;
    mesh.renderOrder = 1;
    mesh.count = 0;
    this.object.add(mesh);
    return mesh;
  }

  clear() { this.count = 0; }

  add(x, y, xx, xy, yy) {
    if (this.count >= mostEllipses) return;
    const middle = 0.5 * (xx + yy);
    const apart = Math.hypot(0.5 * (xx - yy), xy);
    const angle = 0.5 * Math.atan2(2 * xy, xx - yy);
    const a = 2 * Math.sqrt(Math.max(0, middle + apart));
    const b = 2 * Math.sqrt(Math.max(0, middle - apart));
    const c = Math.cos(angle), s = Math.sin(angle);
    this.matrix.set(a * c, -b * s, 0, x, a * s, b * c, 0, y, 0, 0, 1, above, 0, 0, 0, 1);
    this.disks.setMatrixAt(this.count, this.matrix);
    this.edges.setMatrixAt(this.count++, this.matrix);
  }

  commit() {
    for (const mesh of [this.disks, this.edges]) {
      mesh.count = this.count;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }
}
