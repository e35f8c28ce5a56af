// Puts the page together and plays the run.

class Player {
  constructor(stage) {
    this.stage = stage;
    this.time = facts.frames[0].time;
    this.playing = false;
    this.end = facts.frames[facts.frames.length - 1].time;
  }

  seek(time) {
    this.time = Math.min(Math.max(time, facts.frames[0].time), this.end);
    let k = 0;
    while (k + 2 < facts.frames.length && facts.frames[k + 1].time <= this.time) ++k;
    const from = facts.frames[k], to = facts.frames[k + 1];
    this.stage.show(k, to ? Math.min(Math.max((this.time - from.time) / (to.time - from.time), 0), 1) : 0);
    get('clock').textContent = `${this.time.toFixed(2)} s`;
    get('scrubber').value = this.time;
  }

  play(on) {
    this.playing = on;
    get('play').textContent = on ? 'Pause' : 'Play';
    if (!on) return;
    if (this.time >= this.end) this.seek(facts.frames[0].time);
    let before = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      this.seek(this.time + (now - before) / 1000 * Number(get('speed').value));
      before = now;
      if (this.time >= this.end) this.play(false);
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
}

const get = (id) => document.getElementById(id);

function showLegend(ground) {
  const legend = ground.legend();
  get('legend').style.display = legend ? '' : 'none';
  if (!legend) return;
  get('legend-high').textContent = legend.high;
  get('legend-low').textContent = legend.low;
  get('ramp').style.background = cssRamp(legend.stops);
}

function wire(player, stage) {
  get('play').onclick = () => player.play(!player.playing);
  get('scrubber').min = facts.frames[0].time;
  get('scrubber').max = player.end;
  get('scrubber').step = Math.max(player.end / 2000, 1e-6);
  get('scrubber').oninput = (e) => { player.play(false); player.seek(Number(e.target.value)); };
  get('wireframe').onchange = (e) => { stage.wireframe(e.target.checked); stage.draw(); };
  get('paths').onchange = (e) => { stage.paths.forEach((p) => { p.visible = e.target.checked; }); stage.draw(); };
  get('home').onclick = () => { stage.home(); stage.draw(); };
  get('colors').onchange = (e) => { stage.ground.mode = e.target.value; stage.ground.paint(); showLegend(stage.ground); stage.draw(); };
  document.addEventListener('keydown', (e) => {
    if (e.code !== 'Space' || /INPUT|SELECT|BUTTON/.test(e.target.tagName)) return;
    e.preventDefault();
    player.play(!player.playing);
  });
}

async function start() {
  get('name').textContent = facts.scene || 'divot';
  get('facts').textContent = `${facts.vertices} vertices, ${facts.triangles} triangles, ${facts.simulated_s.toFixed(2)} s in ` +
    `${facts.steps} steps, computed in ${facts.wall_s.toPrecision(3)} s (${facts.real_time_factor.toPrecision(3)} x real time)` +
    (facts.thinned ? `; drawn with every ${facts.thinned}th vertex` : '');
  get('scene').textContent = facts.scene_text;
  get('made').textContent = `Made by divot ${facts.version}; state hash ${facts.state_hash}. Drawn with three.js (MIT licence).`;
  panels();
  const stage = new Stage(get('view'), await loadRun());
  const player = new Player(stage);
  wire(player, stage);
  player.seek(player.end);
  showLegend(stage.ground);
  window.divotReport = { player, stage, facts };  // for tests and for the curious
}

start().catch((error) => {
  get('trouble').hidden = false;
  get('trouble').textContent = `The run cannot be drawn here: ${error.message}. It needs a browser with WebGL.`;
});
