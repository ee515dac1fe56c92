// Sequences of poses that trained inferences have made: one frame large, all of them below.

const poseText = (pose) => Object.entries(pose)
  .map(([name, value]) => `${name} ${String(Number(value.toPrecision(4))).replace('-', '−')}`).join(', ');

function sequenceOf({ name, frames }) {
  const picture = el('img', { width: frames[0].width, height: frames[0].height, decoding: 'async' });
  const caption = el('figcaption', { 'aria-live': 'polite' });
  const thumbs = frames.map((frame, i) => el('button', { type: 'button', title: poseText(frame.pose), onclick: () => go(i),
    'aria-label': `Frame ${i + 1}: ${poseText(frame.pose)}` },
  el('img', { src: address(frame.shown), alt: '', loading: 'lazy', width: 44, height: 44 })));
  const slider = el('input', { type: 'range', min: 1, max: frames.length, value: 1, 'aria-label': `Frame of ${name}`,
    oninput: (event) => go(Number(event.target.value) - 1) });
  let shown = 0;
  function go(i) {
    thumbs[shown].removeAttribute('aria-current');
    shown = i;
    thumbs[i].setAttribute('aria-current', 'true');
    slider.value = i + 1;
    picture.src = address(frames[i].shown);
    picture.alt = `${name}, frame ${i + 1}`;
    caption.replaceChildren(`${i + 1} of ${frames.length}: ${poseText(frames[i].pose)} · `,
      el('a', { href: address(frames[i].file) }, frames[i].file.split('/').at(-1)));
  }
  go(0);
  return el('section', { class: 'row sequence', 'aria-label': name }, el('h3', {}, name),
    el('figure', {}, picture, slider, caption),
    el('div', { class: 'strip', role: 'group', 'aria-label': `Frames of ${name}` }, thumbs));
}

function drawSequences() {
  byId('sequences').hidden = byId('to-sequences').hidden = data.sequences.length === 0;
  fill('sequence-rows', data.sequences.map(sequenceOf));
}
