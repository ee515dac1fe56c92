// A trained generator at work: its shaders (learnt/export_glsl.h) in WebGL 2, pass after pass.

// --- the shaders: each script beside the page calls liveData() with its own --------------------------

const liveLoads = new Map();  // file -> promise of the shaders' text
const liveArrivals = new Map();
function liveData(file, text) { liveArrivals.get(file)?.(text); }

function loadLive(file) {
  if (!liveLoads.has(file))
    liveLoads.set(file, new Promise((done, fail) => {
      liveArrivals.set(file, done);
      const script = el('script', { src: address(file) });
      script.onload = () => script.remove();
      script.onerror = () => { script.remove(); fail(new Error(`${file} is missing`)); };
      document.head.append(script);
    }));
  return liveLoads.get(file);
}

/** A pass's own text: what stands before the first pass, and between its "#if" and "#endif". */
function passText(shaders, k) {
  const begin = shaders.indexOf('\n#if PASS == 0\n'), from = shaders.indexOf(`\n#if PASS == ${k}\n`);
  return shaders.slice(shaders.indexOf('*/') + 2, begin) + shaders.slice(from, shaders.indexOf('\n#endif\n', from) + 8);
}

// --- where the levels lie: one axis ------------------------------------------------------------------

function axisOf(levels, length, tiles) {
  const axes = [];
  for (let k = levels.length - 1, own = length; k >= 0; --k) {
    const half = Math.max(1, Math.floor((own + 1) / 2));
    axes[k] = { whole: tiles ? own : 0, coarser: tiles ? half : 0 };
    own = half;
  }
  for (let k = levels.length - 1, first = 0, size = length; k >= 0; --k) {
    Object.assign(axes[k], { first, size });
    const [fine, coarse] = tiles ? [axes[k].whole, axes[k].coarser] : [2, 1];
    const between = (x) => Math.floor(((2 * x + 1) * coarse - fine) / (2 * fine));
    const { border } = levels[k];
    const next = between(first - border);
    size = between(first + size + border - 1) + 2 - next;
    first = next;
  }
  return axes;
}

// --- drawing -----------------------------------------------------------------------------------------

const showShader = `#version 300 es
precision highp float;
uniform highp sampler2DArray values;
uniform int channels;
out vec4 shown;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 v = texelFetch(values, ivec3(at.x, textureSize(values, 0).y - 1 - at.y, 0), 0);
  shown = vec4(channels < 3 ? v.rrr : v.rgb, 1);
}`;

function liveProgram(gl, fragment) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return program;
}

let live = null;  // {canvas, gl, file, header, programs, seed}

/** Of one model at a time: browsers allow few canvases of this kind. */
async function startLive(file) {
  if (live?.file === file) return live;
  const shaders = await loadLive(file);
  const canvas = live?.canvas ?? el('canvas', { class: 'live' });
  const gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true });
  if (!gl) throw new Error('this browser has no WebGL 2');
  if (!gl.getExtension('EXT_color_buffer_float')) throw new Error('this browser draws to no float textures');
  live?.programs.forEach((program) => gl.deleteProgram(program));
  live = null;
  const header = JSON.parse(shaders.slice(3, shaders.indexOf('\n')));
  const sources = header.passes.map((_, k) => `#version 300 es\n#define PASS ${k}\n${passText(shaders, k)}`);
  const programs = [...sources, showShader].map((source) => liveProgram(gl, source));
  const broken = programs.find((program) => !gl.getProgramParameter(program, gl.LINK_STATUS));
  if (broken) throw new Error(`a shader does not compile: ${gl.getProgramInfoLog(broken)}`);
  canvas.addEventListener('webglcontextlost', () => { live = null; }, { once: true });
  live = { canvas, gl, file, header, programs, seed: null };
  return live;
}

/** Makes the picture of a seed, and shows it on the canvas. */
function makeLive(width, height, tile, seed) {
  const { gl, canvas, header, programs } = live;
  const x = axisOf(header.levels, width, tile === 'x' || tile === 'both');
  const y = axisOf(header.levels, height, tile === 'y' || tile === 'both');
  const made = new Map();
  const framebuffer = gl.createFramebuffer();
  const useProgram = (program, reads) => {
    gl.useProgram(program);
    Object.entries(reads).forEach(([uniform, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, made.get(texture));
      gl.uniform1i(gl.getUniformLocation(program, uniform), unit);
    });
  };
  const textureOf = (name) => {
    const { level, border, layers } = header.textures[name];
    if (!made.has(name)) {
      made.set(name, gl.createTexture());
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, made.get(name));
      gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA32F, x[level].size + 2 * border, y[level].size + 2 * border, layers);
      gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }
    return made.get(name);
  };
  header.passes.forEach(({ reads, writes, first, count }, k) => {
    const { level, border } = header.textures[writes];
    const texture = textureOf(writes);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    for (let i = 0; i < 4; ++i)
      gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, i < count ? texture : null, 0, i < count ? first + i : 0);
    gl.drawBuffers(Array.from({ length: count }, (_, i) => gl.COLOR_ATTACHMENT0 + i));
    gl.viewport(0, 0, x[level].size + 2 * border, y[level].size + 2 * border);
    useProgram(programs[k], reads);
    const uniform = (name) => gl.getUniformLocation(programs[k], name);
    gl.uniform1ui(uniform('seed'), seed);
    gl.uniform2i(uniform('origin'), x[level].first - border, y[level].first - border);
    gl.uniform2i(uniform('whole'), x[level].whole, y[level].whole);
    gl.uniform2i(uniform('coarserWhole'), x[level].coarser, y[level].coarser);
    if (level > 0) gl.uniform2i(uniform('coarserOrigin'), x[level - 1].first, y[level - 1].first);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    // What no later pass reads makes room.
    for (const name of Object.values(reads))
      if (!header.passes.slice(k + 1).some((later) => Object.values(later.reads).includes(name))) {
        gl.deleteTexture(made.get(name));
        made.delete(name);
      }
  });
  Object.assign(canvas, { width, height });
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.viewport(0, 0, width, height);
  useProgram(programs.at(-1), { values: 'picture' });
  gl.uniform1i(gl.getUniformLocation(programs.at(-1), 'channels'), header.channels);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  for (const texture of made.values()) gl.deleteTexture(texture);
  gl.deleteFramebuffer(framebuffer);
  live.seed = seed;
}

// --- its place in the viewer -------------------------------------------------------------------------

const isLive = (subject) => view.surface === 'live' && Boolean(subject.job?.live);

function drawLiveStage(shown) {
  return el('div', { id: 'stage', class: 'stage', tabindex: '0', 'data-keep': 'stage', role: 'group',
    'aria-label': `${describe(shown)}, made here and now` },
  el('div', { class: 'lit-place', id: 'live' }, el('p', { class: 'note' }, 'The shaders are compiled …')),
  el('span', { class: 'tag', id: 'live-tag', 'aria-live': 'polite' }, `${view.showB ? 'B' : 'A'} · ${shown.title}`));
}

function drawLiveControls() {
  const shown = view.showB ? view.b : view.a;
  return el('div', { class: 'pair' },
    el('button', { type: 'button', id: 'live-seed', 'data-keep': 'live-seed',
      onclick: () => showLive((live?.seed ?? shown.job.seed) + 1) }, 'another seed'));
}

/** The largest whole multiple that fits, or the fraction where none does. */
function fitLive() {
  if (!live) return;
  const { canvas } = live, stage = byId('stage');
  const fits = Math.min(stage.clientWidth / canvas.width, stage.clientHeight / canvas.height);
  const scale = fits >= 1 ? Math.floor(fits) : fits;
  canvas.style.width = `${Math.floor(canvas.width * scale)}px`;
  canvas.style.height = `${Math.floor(canvas.height * scale)}px`;
}

/** Fills the stage; of the job's own seed, or another. */
async function showLive(seed) {
  const shown = view.showB ? view.b : view.a;
  const place = byId('live');
  if (!place) return;
  const { live: found, width, height, seed: own } = shown.job;
  try {
    await new Promise((done) => setTimeout(done));  // the stage is seen first
    await startLive(found.file);
    if (!place.isConnected) return;
    const most = Math.min(1024, live.gl.getParameter(live.gl.MAX_TEXTURE_SIZE) / 2);
    if (Math.max(width, height) > most) throw new Error(`it is larger than ${most} pixels`);
    makeLive(width, height, found.tile, seed ?? own);
    if (place.firstChild !== live.canvas) place.replaceChildren(live.canvas);
    fitLive();
    byId('live-tag').textContent = `live · seed ${live.seed}`;
  } catch (error) {
    if (place.isConnected) place.replaceChildren(el('p', { class: 'note' }, `It cannot be made live: ${error.message}.`));
  }
}
