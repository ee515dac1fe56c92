// The head of the page, its toolbar, and the first drawing.

function summarySentence() {
  const count = (status) => data.jobs.filter((job) => job.status === status).length;
  const states = ['done', 'failed', 'interrupted', 'waiting']
    .map((status) => [status, count(status)]).filter(([, n]) => n > 0);
  const exemplars = data.exemplars.filter(({ image }) => image !== null).length;
  if (data.jobs.length === 0) return 'Trained models, without textures.';
  const what = `${plural(data.methods.length, 'method')}, ` +
    (exemplars > 0 ? `${plural(exemplars, 'exemplar')}, ` : '') +
    `${plural(seeds.length, 'seed')}: ${plural(data.jobs.length, 'job')}`;
  if (states.length === 1) return [`${what}, ${data.jobs.length > 1 ? 'all ' : ''}${states[0][0]}.`];
  return [`${what}. `, states.map(([status, n], i) => [i ? ', ' : '',
    status === 'failed'
      ? el('a', { class: 'bad', href: '#first-failed' }, `${n} failed`) : `${n} ${status}`]), '.'];
}

/** A word of a command line, for a POSIX shell. */
const quoted = (word) => /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;

function drawHead() {
  document.title = `${data.title} · gramloom`;
  fill('title', data.title);
  fill('summary', summarySentence());
  const { date, versions = {}, machine = {}, command = [] } = data.run;
  const line = command.map(quoted).join(' ');
  const when = date && new Date(date);
  const facts = [
    ['Date', when && el('time', { datetime: date }, when.toLocaleString('en-GB',
      { dateStyle: 'long', timeStyle: 'short', timeZone: 'UTC' }) + ' UTC')],
    ['Program', versions.gramloom && `gramloom ${versions.gramloom}`],
    ['Machine', machine.processor && [machine.processor,
      machine.threads && plural(machine.threads, 'thread')].filter(Boolean).join(', ')],
    ['Command', line && [el('code', {}, line), ' ', copyButton(() => line, 'Copy the command')]],
  ];
  fill('facts', facts.filter(([, value]) => value).map(([name, value]) =>
    el('div', {}, el('dt', {}, name), el('dd', {}, value))));
  fill('trouble', data.trouble.length > 0 && el('details', { class: 'trouble' },
    el('summary', {}, plural(data.trouble.length, 'picture') + ' could not be shown'),
    el('ul', {}, data.trouble.map((text) => el('li', {}, text)))));
  const libraries = Object.entries(versions).filter(([name]) => name !== 'gramloom')
    .map(([name, version]) => `${name} ${version}`).join(', ');
  fill('footer', el('p', {}, 'Everything here is also in files beside this page: ',
    el('a', { href: 'run.json' }, 'run.json'),
    ', and for each exemplar a folder with pictures and records. ',
    libraries && `Made with ${libraries}.`));
}

function drawToolbar() {
  const many = data.methods.length > 12;
  const chips = el('div', { class: 'chips', role: 'group', 'aria-label': 'Methods' },
    data.methods.map((method) => el('button', { type: 'button', 'aria-pressed': 'true',
      onclick: (event) => {
        const on = !chosen.methods.delete(method);
        if (on) chosen.methods.add(method);
        event.currentTarget.setAttribute('aria-pressed', String(on));
        update();
      } }, swatch(method), method)));
  const setAll = (on) => {
    chosen.methods = new Set(on ? data.methods : []);
    for (const chip of chips.children) chip.setAttribute('aria-pressed', String(on));
    update();
  };
  fill('toolbar',
    data.exemplars.length > 1 && choice('Exemplar',
      [['', 'all'], ...data.exemplars.map(({ name }) => [name, name])], '',
      (name) => { chosen.exemplar = name; update(); }),
    scores.length > 0 && choice('Score',
      scores.map((score) => [score.key, `${score.label} ${arrow(score)}`]), chosen.score,
      (key) => { chosen.score = key; update(); }),
    segments('Size of the pictures',
      [['auto', 'auto', 'fits the window'], ['0.5', '½', 'half size'], ['1', '1', 'a pixel is a pixel'],
        ['2', '2', 'double size'], ['4', '4', 'fourfold size']],
      () => chosen.scale, (scale) => { chosen.scale = scale; applyScale(); }),
    data.methods.length > 1 && (many
      ? el('details', { class: 'many' }, el('summary', {}, 'Methods'),
        el('p', {}, el('button', { type: 'button', onclick: () => setAll(true) }, 'all'), ' ',
          el('button', { type: 'button', onclick: () => setAll(false) }, 'none')), chips)
      : chips));
}

function drawGlossary() {
  fill('glossary', scores.map((score) => el('div', { id: `score-${score.key}` },
    el('dt', {}, score.label, ' ', el('span', { class: 'direction' },
      [direction(score), score.group].filter(Boolean).join(' · '))),
    el('dd', {}, score.meaning && `${score.meaning[0].toUpperCase()}${score.meaning.slice(1)}. `,
      score.range && `Range: ${score.range}.`,
      score.paper && el('span', { class: 'paper' }, ` ${score.paper}.`),
      score.fooled_by && el('span', { class: 'fooled' }, el('em', {}, 'Fooled by '),
        `${score.fooled_by}.`)))));
}

// --- light and dark: the system's choice, or the reader's -------------------------------------------------

const themes = ['auto', 'light', 'dark'];
function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  byId('theme').textContent = theme;
  byId('theme').setAttribute('aria-label', `Colours: ${theme}. Change`);
}
function startTheme() {
  const kept = store.get('gramloom-theme');
  setTheme(themes.includes(kept) ? kept : 'auto');
  byId('theme').addEventListener('click', () => {
    const next = themes[(themes.indexOf(document.documentElement.dataset.theme) + 1) % themes.length];
    setTheme(next);
    store.set('gramloom-theme', next);
  });
}

// A training of inferences alone has no textures, and nothing that is told of them.
if (data.jobs.length === 0)
  for (const part of ['toolbar', 'pictures', 'scores', 'plots', 'meaning']) {
    byId(part).hidden = true;
    for (const link of document.querySelectorAll(`nav [href="#${part}"]`)) link.hidden = true;
  }
startTheme();
readPicks();
drawHead();
drawToolbar();
drawGlossary();
parts.push(drawRows, drawTable, drawPlots);
drawChanges();
drawSequences();
drawTrainings();
update();
drawPicks();
startKeys();
startViewer();
let resizing = 0;
window.addEventListener('resize', () => {
  cancelAnimationFrame(resizing);
  resizing = requestAnimationFrame(() => { applyScale(); drawPlots(); fitStage(); });
});
