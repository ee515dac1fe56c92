// The data, what is chosen of it, and helpers that all parts of the page share.

const data = JSON.parse(document.getElementById('data').textContent);

/** An element with attributes ("onclick": a listener) and children; texts stay texts. */
function el(tag, attributes = {}, ...children) {
  const svg = ['svg', 'g', 'path', 'line', 'circle', 'rect', 'text', 'title', 'tspan'];
  const node = svg.includes(tag) ? document.createElementNS('http://www.w3.org/2000/svg', tag)
                                 : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, '');
    else if (value !== false && value != null) node.setAttribute(name, value);
  }
  node.append(...children.flat(3).filter((child) => child != null && child !== false));
  return node;
}

const byId = (id) => document.getElementById(id);
const fill = (id, ...children) => byId(id).replaceChildren(...children.flat(3).filter(Boolean));
/** A path in the run's folder as an address: names may hold "#", "%" and spaces. */
const address = (path) => path.split('/').map(encodeURIComponent).join('/');
const plural = (n, one, many = one + 's') => `${n} ${n === 1 ? one : many}`;
const seeds = [...new Set(data.jobs.map((job) => job.seed))];

// --- scores: those of the metrics' list, and the costs ------------------------------------------

const pair = ({ exemplar, method }) => JSON.stringify([exemplar, method]);
const diversities = new Map(data.diversity.map((of) => [pair(of), of.value]));
for (const job of data.jobs)
  if (diversities.has(pair(job))) job.metrics = { ...job.metrics, diversity: diversities.get(pair(job)) };

const valueOf = (job, key) => {
  const value = key === 'seconds' || key === 'peak_memory_mb' ? job[key] : job.metrics?.[key];
  return typeof value === 'number' && job.status === 'done' ? value : null;
};

const known = new Set(data.metrics.map((metric) => metric.name));
const unknown = new Set(data.jobs.flatMap((job) => Object.keys(job.metrics ?? {}))
  .filter((name) => !known.has(name)));
/** Every score that some job has: {key, label, group, higher: true, false or null, …}. */
const scores = [
  ...data.metrics.map((metric) => ({
    ...metric, key: metric.name,
    label: metric.name.replaceAll('_', ' ').replace('autocorr', 'auto\u00adcorr'),
    higher: metric.higher_is_better,
  })),
  ...[...unknown].map((name) => ({ key: name, label: name, group: 'other', higher: null,
    meaning: '', range: '' })),
  { key: 'seconds', label: 'seconds', group: 'cost', higher: false, range: 'from 0',
    meaning: 'time that the method took' },
  { key: 'peak_memory_mb', label: 'memory, MB', group: 'cost', higher: false, range: 'from 0',
    meaning: 'peak memory of the process while the method worked' },
].filter((score) => data.jobs.some((job) => valueOf(job, score.key) !== null));

const arrow = (score) => (score.higher === null ? '' : score.higher ? '↑' : '↓');
const direction = (score) => score.higher === null ? ''
  : score.higher ? 'higher is better' : 'lower is better';
/** Negative when a is the better value; missing ones come last. */
function compare(score, a, b) {
  if (a === null || b === null) return (a === null) - (b === null);
  return score.higher ? b - a : a - b;
}
function best(score, values) {
  const there = values.filter((value) => value !== null);
  if (score.higher === null || there.length < 2) return null;
  return score.higher ? Math.max(...there) : Math.min(...there);
}

/** Decimals that give a middling value of this score three digits. */
function decimalsOf(score) {
  const sizes = data.jobs.map((job) => Math.abs(valueOf(job, score.key))).filter((size) => size > 0)
    .sort((a, b) => a - b);
  const middle = sizes[Math.floor(sizes.length / 2)] ?? 1;
  return Math.min(3, Math.max(0, 2 - Math.floor(Math.log10(middle))));
}
const decimals = new Map(scores.map((score) => [score.key, decimalsOf(score)]));
/** Times span too many decades for one number of decimals: they have three digits each. */
const duration = (seconds) => seconds >= 100 ? String(Math.round(seconds))
  : seconds >= 0.001 ? String(Number(seconds.toPrecision(seconds < 0.1 ? 2 : 3))) : seconds > 0 ? '<0.001' : '0';
function show(score, value) {
  if (value === null) return '–';
  if (score.key === 'seconds') return duration(value);
  return value.toFixed(decimals.get(score.key)).replace('-', '−');
}

// --- how a method looks in plots --------------------------------------------------------------------

const hues = 8;
const methodIndex = new Map(data.methods.map((name, i) => [name, i]));
/** Colour and shape; beyond eight methods a colour comes back with another shape. */
function look(index) {
  const round = Math.floor(index / hues);
  return { colour: `var(--hue-${index % hues})`, shape: (index + round) % hues,
    dash: ['', '6 3', '2 3', '8 3 2 3'][round % 4] };
}
const lookOf = (method) => look(methodIndex.get(method));

const shapes = [
  (r) => `M${-r},0A${r},${r} 0 1 0 ${r},0A${r},${r} 0 1 0 ${-r},0Z`,
  (r) => `M${-r},${-r}H${r}V${r}H${-r}Z`,
  (r) => `M0,${-1.25 * r}L${1.2 * r},${r}H${-1.2 * r}Z`,
  (r) => `M0,${-1.35 * r}L${1.35 * r},0L0,${1.35 * r}L${-1.35 * r},0Z`,
  (r) => `M0,${1.25 * r}L${1.2 * r},${-r}H${-1.2 * r}Z`,
  (r) => `M${-r},${-0.4 * r}H${-0.4 * r}V${-r}H${0.4 * r}V${-0.4 * r}H${r}V${0.4 * r}H${0.4 * r}V${r}H${-0.4 * r}V${0.4 * r}H${-r}Z`,
  (r) => `M${-r},${r}V${-r}L${r},${r}Z`,
  (r) => `M${-1.2 * r},0L${-0.5 * r},${-r}H${0.5 * r}L${1.2 * r},0L${0.5 * r},${r}H${-0.5 * r}Z`,
];
function mark(index, x, y, r, attributes = {}) {
  const { colour, shape } = look(index);
  return el('path', { d: shapes[shape](r), transform: `translate(${x},${y})`, fill: colour,
    ...attributes });
}
const swatch = (method) => el('svg', { class: 'swatch', viewBox: '-6 -6 12 12', 'aria-hidden': 'true' },
  mark(methodIndex.get(method), 0, 0, 4));

// --- what is chosen ------------------------------------------------------------------------------------

const chosen = {
  exemplar: '',                       // one of them, or all
  methods: new Set(data.methods),     // those that are shown
  score: (scores[0] ?? {}).key,       // under the pictures and in the plots
  scale: 'auto',                      // CSS pixels a pixel
  picked: false,                      // those that are picked alone
};
const chosenScore = () => scores.find((score) => score.key === chosen.score);
const isShown = (job) => (!chosen.exemplar || job.exemplar === chosen.exemplar) &&
  chosen.methods.has(job.method) && (!chosen.picked || picks.has(job.name));
const shownJobs = () => data.jobs.filter(isShown);
const shownExemplars = () => {
  const names = new Set(shownJobs().map((job) => job.exemplar));
  return data.exemplars.filter(({ name }) => names.has(name));
};
const jobLabel = (job) => job.method + (seeds.length > 1 ? `, seed ${job.seed}` : '');

const parts = [];  // functions that draw a part of the page anew
const update = () => parts.forEach((draw) => draw());

function choice(label, options, value, onChoice) {
  return el('label', { class: 'choice' }, el('span', {}, label),
    el('select', { onchange: (event) => onChoice(event.target.value) },
      options.map(([key, text]) => el('option', { value: key, selected: key === value }, text))));
}

/** Buttons of which one is on. */
function segments(label, options, value, onChoice) {
  return el('div', { class: 'segments', role: 'group', 'aria-label': label },
    options.map(([key, text, hint]) => el('button', { type: 'button', title: hint,
      'aria-pressed': String(key === value()), onclick: (event) => {
        onChoice(key);
        for (const button of event.currentTarget.parentNode.children)
          button.setAttribute('aria-pressed', String(button === event.currentTarget));
      } }, text)));
}

const ruler = document.createElement('canvas').getContext('2d');
/** How wide a text is in a plot. */
function textWidth(text) {
  ruler.font = `12px ${getComputedStyle(document.body).fontFamily}`;
  return ruler.measureText(text).width;
}

/** A button that copies what `text` returns. */
function copyButton(text, label) {
  return el('button', { type: 'button', class: 'copy', 'aria-label': label, onclick: async (event) => {
    const button = event.currentTarget;
    let done = true;
    try {
      await navigator.clipboard.writeText(text());
    } catch {
      // Some browsers keep the clipboard from pages on disk: the older way.
      const area = el('textarea', { class: 'off-screen' });
      area.value = text();
      button.after(area);
      area.select();
      done = document.execCommand('copy');
      area.remove();
      button.focus();
    }
    button.textContent = done ? 'copied' : 'not copied';
    setTimeout(() => { button.textContent = 'copy'; }, 1500);
  } }, 'copy');
}
