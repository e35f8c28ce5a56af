// The ground at a time, and its colours.

const kSinkageRamp = [[0.13, 0.29, 0.66], [0.86, 0.85, 0.82], [0.69, 0.18, 0.1]];  // raised, unmoved, sunk
const kHeightRamp = [[0.16, 0.35, 0.24], [0.72, 0.68, 0.46], [0.98, 0.98, 0.96]];
const kGroundColor = [0.62, 0.52, 0.39];
const kMaterialColors = [[0.62, 0.52, 0.39], [0.35, 0.36, 0.38], [0.45, 0.33, 0.22], [0.82, 0.74, 0.52],
                         [0.36, 0.5, 0.27], [0.7, 0.7, 0.72], [0.55, 0.25, 0.2], [0.3, 0.45, 0.6]];

function ramp(stops, t) {
  const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2), s = at - k;
  return stops[k].map((low, i) => low + s * (stops[k + 1][i] - low));
}

function cssRamp(stops) {
  return `linear-gradient(to top, ${stops.map((c) => `rgb(${c.map((x) => Math.round(255 * x))})`).join(', ')})`;
}

class Ground {
  constructor(run) {
    this.run = run;
    this.mode = 'sinkage';
    this.mesh = null;  // index into run.meshes
    this.geometry = new THREE.BufferGeometry();
    this.solid = new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors, side: THREE.DoubleSide });
    this.object = new THREE.Mesh(this.geometry, this.solid);
    this.largest = 1e-6;  // m, of all sinkage up or down: the scale does not change with time
    run.frames.forEach((frame, k) => {
      for (let i = 2; i < frame.offset.length; i += 3)
        this.largest = Math.max(this.largest, Math.abs(frame.offset[i]) * facts.frames[k].step);
    });
    [this.low, this.high] = [Infinity, -Infinity];
    for (let i = 2; i < run.meshes[0].start.length; i += 3) {
      this.low = Math.min(this.low, run.meshes[0].start[i]);
      this.high = Math.max(this.high, run.meshes[0].start[i]);
    }
  }

  useMesh(index) {
    if (this.mesh === index) return;
    this.mesh = index;
    const mesh = this.run.meshes[index];
    this.geometry.dispose();
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(mesh.start), 3));
    this.geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(mesh.start.length), 3));
    this.geometry.setIndex(new THREE.BufferAttribute(mesh.triangles, 1));
    this.object.geometry = this.geometry;
  }

  // Positions between frame k and the next; `share` of the way.
  show(k, share) {
    const about = facts.frames[k];
    this.useMesh(about.mesh);
    const start = this.run.meshes[about.mesh].start, position = this.geometry.attributes.position.array;
    position.set(start);
    const next = facts.frames[k + 1];
    const blend = next && next.mesh === about.mesh ? share : 0;
    this.add(position, k, 1 - blend);
    if (blend > 0) this.add(position, k + 1, blend);
    this.geometry.attributes.position.needsUpdate = true;
    this.geometry.computeVertexNormals();
    this.geometry.computeBoundingSphere();
    this.paint();
  }

  add(position, k, weight) {
    const { vertices, offset } = this.run.frames[k], step = facts.frames[k].step * weight;
    for (let i = 0; i < vertices.length; ++i)
      for (let c = 0; c < 3; ++c) position[3 * vertices[i] + c] += step * offset[3 * i + c];
  }

  paint() {
    const { start, materials } = this.run.meshes[this.mesh], position = this.geometry.attributes.position.array;
    const color = this.geometry.attributes.color.array;
    for (let v = 0; v < materials.length; ++v) {
      let c = kGroundColor;
      const z = position[3 * v + 2];
      // Marks of millimetres beside a crater of metres stay visible under a root.
      if (this.mode === 'sinkage') {
        const s = (start[3 * v + 2] - z) / this.largest;
        c = ramp(kSinkageRamp, 0.5 + 0.5 * Math.sign(s) * Math.sqrt(Math.abs(s)));
      }
      if (this.mode === 'height') c = ramp(kHeightRamp, (z - this.low) / Math.max(this.high - this.low, 1e-6));
      if (this.mode === 'material') c = kMaterialColors[materials[v] % kMaterialColors.length];
      color[3 * v] = c[0], color[3 * v + 1] = c[1], color[3 * v + 2] = c[2];
    }
    this.geometry.attributes.color.needsUpdate = true;
  }

  legend() {
    const length = (m) => `${Number(m.toPrecision(3))} m`;
    if (this.mode === 'sinkage') return { stops: kSinkageRamp, high: `${length(this.largest)} sunk`, low: `${length(this.largest)} raised` };
    if (this.mode === 'height') return { stops: kHeightRamp, high: length(this.high + facts.origin[2]), low: length(this.low + facts.origin[2]) };
    return null;
  }
}
