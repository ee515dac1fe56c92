// Plots as inline SVG: a score against time, a score by method, the loss.

const plots = { loss: 'steps' };
const font = 12;

/** Numbers on an axis: round steps, or powers of ten with 2 and 5 where they are few. */
function ticksOf({ low, high, log }) {
  if (log) {
    const decades = Math.log10(high / low);
    const every = Math.max(1, Math.ceil(decades / 6));
    const factors = decades < 1.5 ? [1, 2, 5] : [1];
    const ticks = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
      if (e % every === 0) for (const factor of factors) ticks.push(factor * 10 ** e);
    return ticks.filter((tick) => tick >= low * 0.999 && tick <= high * 1.001);
  }
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const unit = [1, 2, 5, 10].find((factor) => factor * power >= rough) * power;
  const ticks = [];
  for (let i = Math.ceil(low / unit - 1e-9); i * unit <= high + 1e-9 * unit; ++i) ticks.push(i * unit);
  return ticks;
}
function tickText(tick, log) {
  if (log && (tick < 1e-3 || tick >= 1e5)) return [`${tick < 1e-3 || tick >= 1e5 ? '10' : ''}`,
    el('tspan', { 'baseline-shift': 'super', 'font-size': '75%' }, String(Math.round(Math.log10(tick))).replace('-', '−'))];
  return String(Number(tick.toPrecision(6))).replace('-', '−');
}

/** An axis over `values`, with a little room: a function from value to pixel, with its limits. */
function scaleOf(values, from, to, { log = false, zero = false } = {}) {
  const there = values.filter((value) => value !== null && (!log || value > 0));
  // Not Math.min(...there): a call takes only so many arguments, and traces have many points.
  let low = there.reduce((a, b) => Math.min(a, b), zero && !log ? 0 : Infinity);
  let high = there.reduce((a, b) => Math.max(a, b), zero && !log ? 0 : -Infinity);
  if (there.length === 0) [low, high] = log ? [0.1, 1] : [0, 1];
  if (log) { low /= 1.25; high *= 1.25; } else {
    const room = (high - low || Math.abs(high) || 1) * 0.05;
    if (!(zero && low === 0)) low -= room;
    high += room;
  }
  const way = log ? Math.log : (value) => value;
  const scale = (value) => from + (to - from) * (way(value) - way(low)) / (way(high) - way(low));
  return Object.assign(scale, { low, high, log });
}

function frame(width, height, label) {
  return el('svg', { width, height, viewBox: `0 0 ${width} ${height}`, role: 'img',
    'aria-label': label });
}
function axisX(svg, scale, y, top, label) {
  for (const tick of ticksOf(scale)) svg.append(
    el('line', { class: 'grid', x1: scale(tick), x2: scale(tick), y1: top, y2: y }),
    el('text', { x: scale(tick), y: y + font + 4, 'text-anchor': 'middle' }, tickText(tick, scale.log)));
  svg.append(el('text', { class: 'axis', x: scale(scale.high), y: y + 2 * font + 10, 'text-anchor': 'end' }, label));
}
function axisY(svg, scale, x, right, label) {
  for (const tick of ticksOf(scale)) svg.append(
    el('line', { class: 'grid', x1: x, x2: right, y1: scale(tick), y2: scale(tick) }),
    el('text', { x: x - 6, y: scale(tick) + 4, 'text-anchor': 'end' }, tickText(tick, scale.log)));
  svg.append(el('text', { class: 'axis', x: x - 40, y: font }, label));
}

const mean = (values) => values.reduce((a, b) => a + b, 0) / values.length;
const captioned = (id, title, note, ...content) => fill(id,
  el('figcaption', {}, el('strong', {}, title), ' ', note), ...content);
const widthOf = (id) => Math.max(260, Math.floor(byId(id).clientWidth));
const empty = (text) => el('p', { class: 'note' }, text);

// --- a score against seconds ----------------------------------------------------------------------------

const overlap = (a, b) => a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;

/** Where each point's label goes: beside, above or below it, clear of other marks and labels. */
function placeLabels(points, limits) {
  const taken = points.map(({ x, y }) => ({ x: x - 7, y: y - 7, w: 14, h: 14 }));
  return points.map(({ x, y, method }) => {
    const [w, h] = [textWidth(method), font + 2];
    const places = [[x + 11, y - h / 2], [x - 11 - w, y - h / 2], [x - w / 2, y - h - 9],
      [x - w / 2, y + 9], [x + 9, y - h - 5], [x + 9, y + 5], [x - 9 - w, y - h - 5], [x - 9 - w, y + 5]];
    const fits = (box) => box.x >= limits.left && box.x + w <= limits.right &&
      box.y + h <= limits.bottom && !taken.some((other) => overlap(box, other));
    const boxes = places.map(([bx, by]) => ({ x: bx, y: by, w, h }));
    const box = boxes.find(fits) ?? boxes[0];
    taken.push(box);
    return box;
  });
}

function drawTimePlot() {
  const id = 'plot-time';
  const score = chosenScore();
  const jobs = score ? shownJobs().filter((job) => valueOf(job, score.key) !== null && job.seconds > 0) : [];
  if (jobs.length === 0 || score.key === 'seconds')
    return captioned(id, 'Quality against time.', '', empty(score ? 'Choose a score.' : 'Nothing to plot.'));
  const [width, height] = [widthOf(id), 340];
  const [left, right, top, bottom] = [46, width - 12, 26, height - 40];
  const x = scaleOf(jobs.map((job) => job.seconds), left, right, { log: true });
  const y = scaleOf(jobs.map((job) => valueOf(job, score.key)), bottom, top);
  const svg = frame(width, height, `${score.label} of each picture against the seconds it took`);
  axisX(svg, x, bottom, top, 'seconds');
  axisY(svg, y, left, right, `${score.label} ${arrow(score)} ${direction(score)}`);
  for (const job of jobs) {
    const value = valueOf(job, score.key);
    svg.append(el('g', { class: 'point', onclick: () => openViewer(subjectById.get(job.name)) },
      mark(methodIndex.get(job.method), x(job.seconds), y(value), 3),
      el('title', {}, `${job.exemplar}, ${jobLabel(job)}: ${show(score, value)} in ${duration(job.seconds)} s`)));
  }
  const points = data.methods.map((method) => ({ method, own: jobs.filter((job) => job.method === method) }))
    .filter(({ own }) => own.length > 0).map(({ method, own }) => ({ method,
      x: x(Math.exp(mean(own.map((job) => Math.log(job.seconds))))),
      y: y(mean(own.map((job) => valueOf(job, score.key)))) }));
  svg.append(...points.map(({ method, x: px, y: py }) =>
    mark(methodIndex.get(method), px, py, 6, { class: 'mean' })));
  if (points.length <= 16)
    svg.append(...placeLabels(points, { left, right: width, bottom }).map((box, i) =>
      el('text', { class: 'label', x: box.x, y: box.y + font - 1 }, points[i].method)));
  captioned(id, 'Quality against time.', 'A small mark is one picture, a large one a method’s mean.', svg);
}

// --- a score by method --------------------------------------------------------------------------------------

function drawMethodPlot() {
  const id = 'plot-methods';
  const score = chosenScore();
  const rows = score ? data.methods.map((method) => ({ method, values: shownJobs()
    .filter((job) => job.method === method).map((job) => valueOf(job, score.key))
    .filter((value) => value !== null) })).filter(({ values }) => values.length > 0)
    .map((row) => ({ ...row, mean: mean(row.values) })) : [];
  if (rows.length === 0) return captioned(id, 'By method.', '', empty('Nothing to plot.'));
  if (score.higher !== null) rows.sort((a, b) => compare(score, a.mean, b.mean));
  const all = rows.flatMap(({ values }) => values);
  // Bars begin at zero. Where all values are far from it, their differences would not be seen: dots.
  const zero = Math.min(...all) < 0.5 * Math.max(...all);
  const width = widthOf(id);
  const line = rows.length > 20 ? 18 : Math.max(24, Math.floor(274 / rows.length));
  const longest = Math.max(...rows.map(({ method }) => textWidth(method)));
  const [left, right, top] = [Math.min(14 + longest, width * 0.45), width - 58, 26];
  const bottom = top + rows.length * line;
  const x = scaleOf(all, left, right, { zero });
  const svg = frame(width, bottom + 40, `${score.label} by method: mean, smallest and largest`);
  axisX(svg, x, bottom, top, `${score.label} ${arrow(score)} ${direction(score)}`);
  rows.forEach(({ method, values, mean: centre }, i) => {
    const y = top + (i + 0.5) * line;
    const colour = lookOf(method).colour;
    const [low, high] = [Math.min(...values), Math.max(...values)];
    svg.append(el('g', {},
      el('title', {}, `${method}: mean ${show(score, centre)}, from ${show(score, low)} to ${show(score, high)}`),
      el('text', { class: 'name', x: left - 10, y: y + 4, 'text-anchor': 'end' }, method),
      zero && el('rect', { class: 'bar', x: Math.min(x(0), x(centre)), width: Math.abs(x(centre) - x(0)),
        y: y - line * 0.3, height: line * 0.6, fill: colour }),
      el('line', { x1: x(low), x2: x(high), y1: y, y2: y, stroke: colour, 'stroke-width': 1.5 }),
      values.map((value) => el('line', { class: 'tick', x1: x(value), x2: x(value), y1: y - 4, y2: y + 4, stroke: colour })),
      mark(methodIndex.get(method), x(centre), y, 5, { class: 'mean' }),
      el('text', { class: 'number', x: width - 2, y: y + 4, 'text-anchor': 'end' }, show(score, centre))));
  });
  captioned(id, 'By method.', 'The mean, the smallest and the largest over all pictures shown; a stroke is one picture.', svg);
}

// --- the loss --------------------------------------------------------------------------------------------------

function drawLossPlot() {
  const id = 'plot-loss';
  const jobs = shownJobs().filter((job) => job.trace && job.trace.loss.some((loss) => loss > 0));
  const figure = byId(id);
  figure.hidden = !data.jobs.some((job) => job.trace);
  if (figure.hidden) return;
  const switcher = segments('Loss against', [['steps', 'steps'], ['seconds', 'seconds']],
    () => plots.loss, (key) => { plots.loss = key; drawLossPlot(); });
  const note = 'Where a method goes from coarse to fine, each level begins with a jump.';
  if (jobs.length === 0) return captioned(id, 'Loss.', note, switcher, empty('No method shown here has one.'));
  // Colours tell methods apart or, where one method is left, exemplars.
  const oneMethod = new Set(jobs.map((job) => job.method)).size === 1;
  const keyOf = (job) => (oneMethod ? job.exemplar : job.method);
  const keys = [...new Set(jobs.map(keyOf))];
  const indexOf = (key) => (oneMethod ? keys.indexOf(key) : methodIndex.get(key));
  const [width, height] = [widthOf(id), 360];
  const [left, right, top, bottom] = [52, width - 12, 26, height - 40];
  const x = scaleOf([0, ...jobs.flatMap((job) => job.trace[plots.loss])], left, right, { zero: true });
  const y = scaleOf(jobs.flatMap((job) => job.trace.loss), bottom, top, { log: true });
  const svg = frame(width, height, `loss against ${plots.loss}`);
  svg.classList.add('loss');
  axisX(svg, x, bottom, top, plots.loss);
  axisY(svg, y, left, right, 'loss');
  for (const job of jobs) {
    const { colour, dash } = look(indexOf(keyOf(job)));
    const points = job.trace.loss.map((loss, i) => [job.trace[plots.loss][i], loss])
      .filter(([, loss]) => loss > 0);
    const path = points.map(([at, loss], i) => `${i ? 'L' : 'M'}${x(at).toFixed(1)},${y(loss).toFixed(1)}`).join('');
    svg.append(el('g', { class: 'series', 'data-key': keyOf(job), onclick: () => openViewer(subjectById.get(job.name)) },
      el('path', { class: 'hit', d: path }),
      el('path', { d: path, fill: 'none', stroke: colour, 'stroke-dasharray': dash || null, 'stroke-width': 1.4 }),
      el('title', {}, `${job.exemplar}, ${jobLabel(job)}`)));
  }
  const highlight = (key) => { for (const series of svg.querySelectorAll('.series'))
    series.classList.toggle('faded', key !== null && series.dataset.key !== key); };
  const legend = el('ul', { class: 'legend' }, keys.map((key) => {
    const { colour, dash } = look(indexOf(key));
    return el('li', { onmouseenter: () => highlight(key), onmouseleave: () => highlight(null) },
      el('svg', { width: 26, height: 10, 'aria-hidden': 'true' }, el('line', { x1: 1, x2: 25, y1: 5, y2: 5,
        stroke: colour, 'stroke-dasharray': dash || null, 'stroke-width': 2 })), key);
  }));
  captioned(id, 'Loss.', note, switcher, svg, legend);
}

function drawPlots() {
  drawTimePlot();
  drawMethodPlot();
  drawLossPlot();
}
