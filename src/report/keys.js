// The keys of the page, in a list that ? shows, and those that work while no picture is enlarged.

const keyHelp = [
  ['Anywhere', [
    ['?', 'this help'],
    ['j k', 'next and previous picture'],
    ['p', 'pick the picture, or put it back'],
    ['esc', 'close']]],
  ['Among the pictures', [
    ['← →', 'previous and next picture'],
    ['enter', 'enlarge'],
    ['b', 'to what changed against the baseline']]],
  ['In an enlarged picture', [
    ['← →', 'other pictures of the exemplar'],
    ['↑ ↓', 'other exemplars'],
    ['space', 'flip between A and B'],
    ['b', 'against the baseline: before and now'],
    ['t', 'tile 2 × 2'],
    ['c', 'copy map'],
    ['o w', 'on a lit ball, as a lit wall'],
    ['l', 'live, of a trained generator']]],
];

function showHelp() {
  const help = byId('help');
  help.replaceChildren(
    el('div', { class: 'viewer-head' }, el('h2', { id: 'help-title' }, 'Keys'),
      el('button', { type: 'button', class: 'close', 'aria-label': 'Close', onclick: () => help.close() }, '×')),
    el('div', { class: 'key-groups' }, keyHelp.map(([where, keys]) => el('section', {}, el('h3', {}, where),
      el('dl', {}, keys.map(([key, what]) => el('div', {},
        el('dt', {}, key.split(' ').map((one) => el('kbd', {}, one))), el('dd', {}, what))))))));
  if (!help.open) help.showModal();
}

const shownPictures = () => [...document.querySelectorAll('#rows .picture[data-id]')];
const focusedSubject = () => subjectById.get(document.activeElement?.closest?.('figure')
  ?.querySelector('.picture[data-id]')?.dataset.id);

function stepPicture(by) {
  const pictures = shownPictures();
  const at = pictures.findIndex((picture) => picture.dataset.id === focusedSubject()?.id);
  const next = pictures[at < 0 ? 0 : Math.min(Math.max(at + by, 0), pictures.length - 1)];
  next?.focus();
  next?.scrollIntoView({ block: 'nearest' });
}

const isTyping = (target) => ['SELECT', 'TEXTAREA', 'INPUT'].includes(target.tagName) || target.id === 'settings';

function onPageKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target) || byId('help').open) return;
  if (event.key === '?') {
    event.preventDefault();
    return void showHelp();
  }
  if (dialog.open) return;
  const among = document.activeElement?.closest?.('#rows figure');
  const actions = {
    j: () => stepPicture(1), k: () => stepPicture(-1),
    p: () => togglePick(focusedSubject()),
    b: data.baseline && (() => { byId('changes').scrollIntoView(); byId('changes').querySelector('button')?.focus({ preventScroll: true }); }),
    ...(among ? { ArrowRight: () => stepPicture(1), ArrowLeft: () => stepPicture(-1) } : {}),
  };
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

function startKeys() {
  document.addEventListener('keydown', onPageKey);
  byId('keys').addEventListener('click', showHelp);
}
