// One picture enlarged: flipped with any other, tiled, its copy map, its settings and its command.

const view = { a: null, b: null, showB: false, label: 'picture', tiled: false,
  surface: null };  // 'ball', 'wall': lit; 'live': made anew; 'before': against the baseline
const dialog = byId('viewer');

/** The picture that stands in for `subject` in another exemplar's row: the same method and seed. */
const counterpart = (subject, exemplar) => subjectsOf.get(exemplar).find((other) => (subject.job
  ? other.job?.method === subject.job.method && other.job.seed === subject.job.seed
  : !other.job));
const rowOfView = () => subjectsOf.get(view.a.exemplar).filter((subject) =>
  !subject.job || isShown(subject.job) || subject === view.a);

function openViewer(subject, surface = null) {
  const own = subjectsOf.get(subject.exemplar);
  const source = own.find((other) => !other.job);
  const others = own.filter((other) => other !== subject && other.views.length > 0);
  Object.assign(view, { a: subject, b: subject === source ? others[0] ?? null : source ?? others[0] ?? null,
    showB: false, label: 'picture', tiled: false, surface });
  drawViewer();
  if (!dialog.open) dialog.showModal();
  fitStage();
  byId('stage').focus();
}

function showSubject(subject) {
  if (!subject) return;
  if (view.b && view.b.exemplar === view.a.exemplar && subject.exemplar !== view.a.exemplar)
    view.b = counterpart(view.b, subject.exemplar) ?? view.b;
  view.a = subject;
  view.showB = false;
  const focus = document.activeElement?.dataset?.keep;
  drawViewer();
  fitStage();
  (dialog.querySelector(`[data-keep="${focus}"]`) ?? byId('stage')).focus();
}

function step(by) {
  const row = rowOfView();
  showSubject(row[(row.indexOf(view.a) + by + row.length) % row.length]);
}

function stepExemplar(by) {
  const names = shownExemplars().map(({ name }) => name);
  const name = names[(names.indexOf(view.a.exemplar) + by + names.length) % names.length];
  if (name !== view.a.exemplar) showSubject(counterpart(view.a, name));
}

function flip() {
  if (!view.b) return;
  view.showB = !view.showB;
  drawViewer();
  fitStage();
}

/** The file of a subject in the chosen view; one that lacks this view shows its picture. */
const fileOf = (subject) =>
  (subject.views.find(({ label }) => label === view.label) ?? subject.views[0])?.file;

// Both pictures of the pair lie on one another, so that flipping moves nothing.
function layer(subject, hidden) {
  const file = fileOf(subject);
  if (!file) {
    const [state, why] = stateOf(subject.job);
    return el('div', { class: 'layer message', hidden }, el('strong', {}, state), el('span', {}, why));
  }
  const copies = view.tiled ? 4 : 1;
  return el('div', { class: view.tiled ? 'layer tiled' : 'layer', hidden,
    'data-width': subject.width, 'data-height': subject.height },
  Array.from({ length: copies }, (_, i) => el('img', { src: address(file),
    alt: i ? '' : `${describe(subject)}${view.label === 'picture' ? '' : `: ${view.label}`}` })));
}

function drawStage() {
  const shown = view.showB ? view.b : view.a;
  if (isLive(shown)) return drawLiveStage(shown);
  if (isBefore(shown)) return drawBeforeStage(shown);
  if (isLit(shown)) return drawSurfaceStage(shown);
  return el('div', { id: 'stage', class: 'stage', tabindex: '0', 'data-keep': 'stage', onclick: flip,
    'aria-label': `${describe(shown)}. Space flips`, role: 'group' },
  layer(view.a, view.showB), view.b && layer(view.b, !view.showB),
  el('span', { class: 'tag', 'aria-live': 'polite' },
    `${view.showB ? 'B' : 'A'} · ${view.a.exemplar === view.b?.exemplar ? '' : `${shown.exemplar} · `}${shown.title}`));
}

/** The largest whole multiple that both pictures fit with, or the fraction where none does. */
function fitStage() {
  const stage = byId('stage');
  if (!dialog.open || !stage) return;
  const shown = view.showB ? view.b : view.a;
  if (isLive(shown)) return void fitLive();
  if (isLit(shown)) return void paintSoon();
  const layers = [...stage.querySelectorAll('.layer[data-width]')];
  const beside = isBefore(shown) && stage.querySelector('.half') ? 2 : 1;
  const times = view.tiled && !isBefore(shown) ? 2 : 1;
  const width = Math.max(...layers.map((node) => Number(node.dataset.width)), 1) * times;
  const height = Math.max(...layers.map((node) => Number(node.dataset.height)), 1) * times;
  const fits = Math.min(stage.clientWidth / beside / width, stage.clientHeight / height);
  const scale = fits >= 1 ? Math.floor(fits) : fits;
  stage.classList.toggle('smooth', scale * devicePixelRatio < 1);
  for (const node of layers)
    for (const image of node.children) {
      image.style.width = `${Math.max(1, Math.floor(node.dataset.width * scale))}px`;
      image.style.height = `${Math.max(1, Math.floor(node.dataset.height * scale))}px`;
    }
  if (isBefore(shown)) fitBefore();
}

const manySubjects = 400;  // beyond these, lists hold those around the one that is shown

/** Those of a list that are near `subject`; all of a list that is not long. */
function around(list, subject, most) {
  const at = list.indexOf(subject);
  const first = Math.max(0, Math.min(at - most / 2, list.length - most));
  return list.slice(first, first + most);
}

function pairChoice(letter, subject, onChoice) {
  const offered = subjects.length <= manySubjects ? data.exemplars : [{ name: subject.exemplar }];
  const groups = offered.map(({ name }) => el('optgroup', { label: name },
    around(subjectsOf.get(name), subject, manySubjects).map((other) =>
      el('option', { value: other.id, selected: other === subject }, `${name} · ${other.title}`))));
  return el('label', { class: (letter === 'B') === view.showB ? 'choice on' : 'choice' },
    el('span', {}, letter),
    el('select', { 'data-keep': letter, onchange: (event) => onChoice(subjectById.get(event.target.value)) },
      groups));
}

function redraw(change) {
  change();
  const focus = document.activeElement?.dataset?.keep;
  drawViewer();
  fitStage();
  (dialog.querySelector(`[data-keep="${focus}"]`) ?? byId('stage')).focus();
}

function drawControls() {
  const shown = view.showB ? view.b : view.a;
  const labels = [...new Set([view.a, view.b].filter(Boolean)
    .flatMap((subject) => subject.views.map(({ label }) => label)))];
  const setLabel = (label) => {
    view.label = label;
    if (view.surface !== 'before') view.surface = null;
    view.showB &&= view.b.views.some((own) => own.label === label);
  };
  const button = (text, on, hint, change) => el('button', { type: 'button', title: hint,
    'data-keep': text, 'aria-pressed': String(on), onclick: () => redraw(change) }, text);
  return el('div', { class: 'viewer-controls' },
    el('div', { class: 'pair' },
      pairChoice('A', view.a, showSubject),
      view.b && el('button', { type: 'button', class: 'flip', 'data-keep': 'flip', title: 'Space',
        onclick: () => redraw(() => { view.showB = !view.showB; }) }, 'flip'),
      view.b && pairChoice('B', view.b, (subject) => redraw(() => { view.b = subject; view.showB = true; }))),
    el('div', { class: 'segments', role: 'group', 'aria-label': 'What of it' },
      button('2 × 2', view.tiled && !view.surface, 't', () => { view.tiled = Boolean(view.surface) || !view.tiled; view.surface = null; }),
      hasBefore(shown) && button('before', view.surface === 'before', 'b: against the baseline',
        () => { view.surface = view.surface === 'before' ? null : 'before'; }),
      surfaceFile(shown) && ['ball', 'wall'].map((shape) => button(shape, view.surface === shape,
        shape === 'ball' ? 'o: on a lit ball' : 'w: as a lit wall',
        () => { view.surface = view.surface === shape ? null : shape; })),
      shown.job?.live && button('live', view.surface === 'live', 'l: made anew, in this browser',
        () => { view.surface = view.surface === 'live' ? null : 'live'; }),
      labels.length > 1 && labels.length <= 5 && labels.map((label) => button(label,
        label === view.label && (!view.surface || isBefore(shown)),
        label === 'copy map' ? 'c: where in the exemplar each pixel came from' : null, () => setLabel(label)))),
    isLit(shown) && el('div', { class: 'pair', id: 'surface-controls' }),
    isLive(shown) && drawLiveControls(),
    isBefore(shown) && drawBeforeControls(),
    labels.length > 5 && choice('Show', labels.map((label) => [label, label]), view.label,
      (label) => redraw(() => setLabel(label))),
    el('p', { class: 'keys' }, isLit(shown)
      ? 'drag, or arrow keys: turn · with shift: the light · + − repeat · space flips · o ball · w wall · ? all keys · esc closes'
      : `← → pictures · ↑ ↓ exemplars · space flips · p picks · ${hasBefore(shown) ? 'b before · ' : ''}t 2 × 2 · ? all keys · esc closes`));
}

function drawStrip() {
  return el('div', { class: 'strip', role: 'group', 'aria-label': `Pictures of ${view.a.exemplar}` },
    around(rowOfView(), view.a, 60).map((subject) => el('button', { type: 'button', title: subject.title,
      'aria-label': subject.title, 'aria-current': subject === view.a ? 'true' : null,
      onclick: () => showSubject(subject) },
    subject.views.length > 0
      ? el('img', { src: address(subject.views[0].file), alt: '', loading: 'lazy', width: 44, height: 44 })
      : el('span', {}, '×'))));
}

/** The address leads back to this picture, where the browser lets pages on disk have one. */
function setAddress(hash) {
  try {
    if (location.hash !== hash) history.replaceState(null, '', hash || location.pathname);
  } catch { /* not here */ }
}

function drawViewer() {
  const shown = view.showB ? view.b : view.a;
  dialog.replaceChildren(
    el('div', { class: 'viewer-head' },
      el('h2', { id: 'viewer-title' }, `${shown.exemplar} `, el('span', {}, shown.title)),
      el('span', { class: 'viewer-buttons' }, pickButton(shown),
        el('button', { type: 'button', class: 'close', 'aria-label': 'Close', onclick: () => dialog.close() }, '×'))),
    el('div', { class: 'viewer-body' },
      el('div', { class: 'viewer-left' }, drawStage(), drawControls(), drawStrip()),
      drawDetails(shown)));
  setAddress(`#view=${encodeURIComponent(view.a.id)}`);
  showSurface();
  showLive();
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const target = event.target.tagName;
  // A slider keeps the keys that move it.
  if (event.target.type === 'range' ? event.key.length > 1 : isTyping(event.target)) return;
  if (isLit(view.showB ? view.b : view.a) && event.target.id === 'stage' && surfaceKey(event)) return;
  const lit = (shape) => () => redraw(() => { view.surface = view.surface === shape ? null : shape; });
  const actions = {
    o: lit('ball'), w: lit('wall'), l: lit('live'),
    b: () => redraw(() => { view.surface = view.surface === 'before' ? null : 'before'; view.showB = false; }),
    j: () => step(1), k: () => step(-1), p: () => togglePick(view.showB ? view.b : view.a),
    ArrowLeft: () => step(-1), ArrowRight: () => step(1),
    ArrowUp: () => stepExemplar(-1), ArrowDown: () => stepExemplar(1),
    f: flip, t: () => redraw(() => { view.tiled = Boolean(view.surface) || !view.tiled; view.surface = null; }),
    c: () => redraw(() => {
      view.surface = null;
      view.label = view.label === 'copy map' ? 'picture' : 'copy map';
    }),
  };
  if (target !== 'BUTTON' && target !== 'A') actions[' '] = flip;
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  const inStage = ['stage', 'cut'].includes(document.activeElement?.id);
  action();
  if (inStage) (event.key === 'b' && byId('cut') || byId('stage')).focus();
}

function startViewer() {
  // Wherever the focus is: what had it may be drawn anew.
  document.addEventListener('keydown', (event) => { if (dialog.open && !byId('help').open) onKey(event); });
  dialog.addEventListener('close', () => {
    setAddress('');
    document.querySelector(`#rows [data-id="${CSS.escape(view.a.id)}"]`)?.focus();
  });
  const openFromAddress = () => {
    const found = location.hash.startsWith('#view=') &&
      subjectById.get(decodeURIComponent(location.hash.slice('#view='.length)));
    if (found && found !== (dialog.open ? view.a : null)) openViewer(found);
  };
  window.addEventListener('hashchange', openFromAddress);
  openFromAddress();
}
