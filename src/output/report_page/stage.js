// The scene in three dimensions: ground, bodies with their paths, camera.

const kBodyColors = ['#c8641e', '#2f6f9f', '#5b8c3a', '#8a4f9e', '#b03a48', '#3d8f8a'];

// A body as its triangles; what rolls is painted in two shades by quarters about its axis y, so that one sees it spin.
function bodyObject(body, k) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(body.vertices), 3));
  geometry.setIndex(body.triangles);
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  const position = flat.attributes.position.array, shade = new Float32Array(position.length);
  const color = new THREE.Color(kBodyColors[k % kBodyColors.length]);
  for (let i = 0; i < position.length; i += 9) {
    const middle = [0, 1, 2].map((c) => position[i + c] + position[i + 3 + c] + position[i + 6 + c]);
    const dark = body.rolls && (middle[0] > 0) !== (middle[2] > 0) ? 0.62 : 1;
    for (let v = 0; v < 3; ++v) shade.set([color.r * dark, color.g * dark, color.b * dark], i + 3 * v);
  }
  flat.setAttribute('color', new THREE.BufferAttribute(shade, 3));
  return new THREE.Mesh(flat, new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors }));
}

class Stage {
  constructor(canvas, run) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color('#c9d6e2');
    this.scene.add(new THREE.HemisphereLight('#f2f6ff', '#8a7d6a', 0.62));
    const sun = new THREE.DirectionalLight('#fff4e0', 0.55);
    sun.position.set(-0.6, -0.5, 0.7);
    this.scene.add(sun);
    this.ground = new Ground(run);
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: '#1c2126' }));
    this.lines.visible = false;
    this.scene.add(this.ground.object, this.lines);
    this.bodies = facts.bodies.map(bodyObject);
    this.paths = facts.bodies.map((body, k) => new THREE.Line(
      new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: kBodyColors[k % kBodyColors.length] })));
    this.paths.forEach((path, k) => path.geometry.setAttribute('position', new THREE.BufferAttribute(
      new Float32Array(facts.frames.flatMap((f) => f.bodies[k] ? f.bodies[k].slice(0, 3) : [])), 3)));
    this.paths.forEach((path) => { path.frustumCulled = false; });
    this.bodies.forEach((b) => this.scene.add(b));
    this.paths.forEach((p) => this.scene.add(p));
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.1, 1e6);
    this.camera.up.set(0, 0, 1);
    this.home();
    this.listen();
  }

  // Looks at all that happens: what moves and where bodies go, from the south-west.
  home() {
    const box = new THREE.Box3();
    for (const p of facts.focus) box.expandByPoint(new THREE.Vector3(...p));
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    this.target = sphere.center.clone();
    this.distance = Math.max(2.4 * sphere.radius, 1e-3);
    this.azimuth = -2.2;
    this.elevation = 0.6;
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener('pointerdown', (e) => { canvas.setPointerCapture(e.pointerId); this.drag = e; });
    canvas.addEventListener('pointerup', () => { this.drag = null; });
    canvas.addEventListener('pointermove', (e) => {
      if (!this.drag) return;
      const dx = e.clientX - this.drag.clientX, dy = e.clientY - this.drag.clientY;
      if (e.shiftKey || e.buttons & 6) this.pan(dx, dy);
      else this.turn(dx, dy);
      this.drag = e;
      this.draw();
    });
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    canvas.addEventListener('wheel', (e) => {
      e.preventDefault();
      this.distance *= Math.exp(0.001 * e.deltaY);
      this.draw();
    }, { passive: false });
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  turn(dx, dy) {
    this.azimuth -= 0.006 * dx;
    this.elevation = Math.min(Math.max(this.elevation + 0.006 * dy, 0.03), 1.55);
  }

  pan(dx, dy) {
    const scale = this.distance / this.canvas.clientHeight * 0.63;
    const right = new THREE.Vector3(-Math.sin(this.azimuth), Math.cos(this.azimuth), 0);
    const ahead = new THREE.Vector3(-Math.cos(this.azimuth), -Math.sin(this.azimuth), 0);
    this.target.addScaledVector(right, -dx * scale).addScaledVector(ahead, dy * scale);
  }

  wireframe(on) { this.lines.visible = on; this.ground.solid.polygonOffset = on; this.rebuildLines(); }

  rebuildLines() {
    const { ground, lines } = this;
    ground.solid.polygonOffsetFactor = ground.solid.polygonOffsetUnits = 1;
    if (!lines.visible) return;
    if (this.linesOf !== ground.mesh) {
      this.linesOf = ground.mesh;
      const t = ground.run.meshes[ground.mesh].triangles, edges = [];
      // Each inner edge is met twice, once each way.
      for (let i = 0; i < t.length; i += 3)
        for (let c = 0; c < 3; ++c) {
          const a = t[i + c], b = t[i + (c + 1) % 3];
          if (a < b) edges.push(a, b);
        }
      lines.geometry.dispose();
      lines.geometry = new THREE.BufferGeometry();
      lines.geometry.setIndex(edges.length < 65536 ? edges : new THREE.BufferAttribute(new Uint32Array(edges), 1));
    }
    lines.geometry.setAttribute('position', ground.geometry.attributes.position);
    lines.geometry.computeBoundingSphere();
  }

  show(k, share) {
    this.ground.show(k, share);
    this.rebuildLines();
    const now = facts.frames[k].bodies, next = (facts.frames[k + 1] || facts.frames[k]).bodies;
    this.bodies.forEach((object, b) => {
      object.visible = Boolean(now[b]);
      if (!now[b]) return;
      const from = now[b], to = next[b] || from;
      object.position.set(...[0, 1, 2].map((c) => from[c] + share * (to[c] - from[c])));
      object.quaternion.set(...from.slice(3, 7)).slerp(new THREE.Quaternion(...to.slice(3, 7)), share);
    });
    this.draw();
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    const flat = Math.cos(this.elevation);
    this.camera.position.set(Math.cos(this.azimuth) * flat, Math.sin(this.azimuth) * flat, Math.sin(this.elevation))
      .multiplyScalar(this.distance).add(this.target);
    this.camera.lookAt(this.target);
    this.camera.aspect = width / height;
    this.camera.near = this.distance / 200;
    this.camera.far = this.distance * 200;
    this.camera.updateProjectionMatrix();
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height, false);
    this.renderer.render(this.scene, this.camera);
  }
}
