// Charts as SVG, and the panels under the view.

const kInks = ['var(--mark)', '#3b78b5', '#5b8c3a', '#8a4f9e', '#b03a48', '#3d8f8a', '#a98b2d', '#6b6f76'];

function niceStep(span, most) {
  const raw = Math.max(span / most, 1e-300), power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find((m) => m * power >= raw * 0.999);
}

function ticks(low, high, most) {
  const step = niceStep(high - low, most), out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push(k * step);
  return out;
}

// As many digits as tell neighbours apart: coordinates of maps are large and their steps small.
const tickText = (x, step) => Math.abs(x) >= 1e7 || step < 1e-4 ? x.toPrecision(3)
  : x.toFixed(Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));

// lines: [{name, x, y}]; a NaN in y is a gap.
function chart(lines, xName, yName, equalScales) {
  const [W, H, left, right, top, bottom] = [520, 220, 62, 12, 8, 34];
  const finite = (values) => values.filter(Number.isFinite);
  const xs = finite(lines.flatMap((l) => l.x)), ys = finite(lines.flatMap((l) => l.y));
  if (xs.length === 0 || ys.length === 0) return '<p class="note">Nothing to show.</p>';
  let [x0, x1] = [xs.reduce((a, b) => Math.min(a, b)), xs.reduce((a, b) => Math.max(a, b))];
  let [y0, y1] = [ys.reduce((a, b) => Math.min(a, b)), ys.reduce((a, b) => Math.max(a, b))];
  if (x1 <= x0) x1 = x0 + 1;
  if (y1 <= y0) [y0, y1] = [y0 - 0.5, y1 + 0.5];
  if (equalScales) {
    const need = (x1 - x0) * (H - top - bottom) / (W - left - right), grow = Math.max(0, (need - (y1 - y0)) / 2);
    [y0, y1] = [y0 - grow, y1 + grow];
  }
  const margin = 0.04 * (y1 - y0);
  [y0, y1] = [y0 - margin, y1 + margin];
  const X = (x) => left + (x - x0) / (x1 - x0) * (W - left - right), Y = (y) => H - bottom - (y - y0) / (y1 - y0) * (H - top - bottom);
  const [xStep, yStep] = [niceStep(x1 - x0, 6), niceStep(y1 - y0, 5)];
  const grid = ticks(y0, y1, 5).map((y) => `<line x1="${left}" x2="${W - right}" y1="${Y(y)}" y2="${Y(y)}" stroke="var(--line)"/>` +
    `<text x="${left - 6}" y="${Y(y) + 4}" text-anchor="end">${tickText(y, yStep)}</text>`).join('') +
    ticks(x0, x1, 6).map((x) => `<text x="${X(x)}" y="${H - bottom + 16}" text-anchor="middle">${tickText(x, xStep)}</text>`).join('');
  const drawn = lines.map((line, k) => {
    let path = '', pen = 'M';
    line.y.forEach((y, i) => {
      if (!Number.isFinite(y)) { pen = 'M'; return; }
      path += `${pen}${X(line.x[i]).toFixed(1)} ${Y(y).toFixed(1)}`;
      pen = 'L';
    });
    return `<path d="${path}" fill="none" stroke="${kInks[k % kInks.length]}" stroke-width="1.8"${line.dash ? ' stroke-dasharray="5 4"' : ''}/>`;
  }).join('');
  const keys = lines.map((l, k) => `<span><i style="background:${kInks[k % kInks.length]}"></i>${escapeText(l.name)}</span>`).join('');
  return `<div class="keys">${keys}</div><svg viewBox="0 0 ${W} ${H}" font-size="11" fill="currentColor" role="img">${grid}${drawn}` +
    `<text x="${(left + W - right) / 2}" y="${H - 3}" text-anchor="middle">${xName}</text>` +
    `<text transform="translate(12 ${(top + H - bottom) / 2}) rotate(-90)" text-anchor="middle">${yName}</text></svg>`;
}

function escapeText(text) {
  return String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
}

function panel(title, html, note) {
  const section = document.createElement('section');
  section.className = 'panel';
  section.innerHTML = `<h2>${title}</h2>${html}${note ? `<p class="note">${note}</p>` : ''}`;
  document.getElementById('panels').append(section);
}

function overTime(rows) {
  const x = facts.frames.map((f) => f.time);
  return rows.map(([name, of]) => ({ name, x, y: facts.frames.map(of) }));
}

function craterPanel(crater, k) {
  const lines = crater.lines.flatMap((line) => [
    { name: `${line.name}, at the end`, x: line.at, y: line.end },
    { name: `${line.name}, at the start`, x: line.at, y: line.start, dash: true }]);
  const d = (m) => `${Number(m.toPrecision(3))} m`;
  panel(`Crater ${k + 1}: ${Number(crater.yield_t.toPrecision(4))} t at (${crater.x.toFixed(1)}, ${crater.y.toFixed(1)})`,
    chart(lines, 'from ground zero, m', 'height, m'),
    crater.width_m > 0 ? `${d(crater.width_m)} wide, ${d(crater.depth_m)} deep, lip ${d(crater.lip_height_m)}; height is drawn to a scale of its own.`
      : 'It left no mark.');
}

function stagePanel() {
  const most = Math.max(...facts.stages.map((s) => s.ms), 1e-9);
  const rows = facts.stages.map((s) => `<tr><td>${s.name}</td><td>${s.ms.toFixed(1)}</td><td>${s.calls}</td>` +
    `<td>${(s.ms / Math.max(facts.steps, 1)).toFixed(4)}</td>` +
    `<td style="width:34%;text-align:left"><span class="bar" style="width:${100 * s.ms / most}%"></span></td></tr>`).join('');
  panel('Milliseconds per stage', `<table><tr><th>stage</th><th>ms</th><th>calls</th><th>ms a step</th><th></th></tr>${rows}</table>`);
  panel('Milliseconds a step over time', chart(overTime(facts.stages.map((s, i) => [s.name, (f) => f.stage_ms[i]])), 'time, s', 'ms a step'));
}

function panels() {
  facts.craters.forEach(craterPanel);
  if (facts.bodies.length > 0) {
    const body = (k, of) => (f) => f.bodies[k] ? of(f.bodies[k]) : NaN;
    panel('Speed of bodies', chart(overTime(facts.bodies.map((b, k) => [b.name, body(k, (s) => s[7])])), 'time, s', 'm/s'));
    panel('Sinkage of bodies', chart(overTime(facts.bodies.map((b, k) => [b.name, body(k, (s) => s[8])])), 'time, s', 'm'));
    panel('Paths of bodies', chart(facts.bodies.map((b, k) => ({
      name: b.name,
      x: facts.frames.map((f) => f.bodies[k] ? f.bodies[k][0] + facts.origin[0] : NaN),
      y: facts.frames.map((f) => f.bodies[k] ? f.bodies[k][1] + facts.origin[1] : NaN) })), 'x, m', 'y, m', true), 'Seen from above.');
  }
  const first = facts.frames[0].energy;
  panel('Energy', chart(overTime([
    ['bodies, motion', (f) => f.energy[0]],
    ['bodies, height against the start', (f) => f.energy[1] - first[1]],
    ['ground, motion', (f) => f.energy[2]],
    ['sum', (f) => f.energy[0] + f.energy[1] - first[1] + f.energy[2]]]), 'time, s', 'J'),
    'What the sum loses went into soil, friction and damping; what it gains came from bombs.');
  panel('Soil', chart(overTime([['displaced', (f) => f.soil[0]], ['compacted', (f) => f.soil[1]], ['deposited', (f) => f.soil[2]]]), 'time, s', 'm³'),
    `Displaced less compacted and deposited: ${(100 * facts.soil_error).toPrecision(2)} % at the end.`);
  panel('Particles awake', chart(overTime([['awake', (f) => f.particles]]), 'time, s', 'particles'));
  stagePanel();
}
