// A picture and its maps on a lit ball or as a wall, live: drawn by WebGL 2 from reduced copies that
// a small script beside the page holds, since browsers keep WebGL from picture files on disk.

const surface = {
  yaw: -0.3, pitch: -0.25, lightYaw: -0.6, lightPitch: 0.7, repeat: 1, depth: 0.04, drags: 'turn',
  off: new Set(),  // maps that are switched off
};
const surfaceMaps = ['normal', 'height', 'occlusion', 'roughness', 'metalness'];

// --- the data: each script calls surfaceData() with its own -------------------------------------

const surfaceLoads = new Map();  // file -> promise of {strength, tile, green, maps {name: image}}
const surfaceArrivals = new Map();
function surfaceData(file, found) { surfaceArrivals.get(file)?.(found); }

const decoded = (source) => new Promise((done, fail) => {
  const image = new Image();
  image.onload = () => done(image);
  image.onerror = () => fail(new Error('a picture is damaged'));
  image.src = source;
});

function loadSurface(file) {
  if (!surfaceLoads.has(file))
    surfaceLoads.set(file, new Promise((done, fail) => {
      surfaceArrivals.set(file, done);
      const script = el('script', { src: address(file) });
      script.onload = () => script.remove();
      script.onerror = () => { script.remove(); fail(new Error(`${file} is missing`)); };
      document.head.append(script);
    }).then(async (found) => {
      const maps = {};
      for (const [name, source] of Object.entries(found.maps)) maps[name] = await decoded(source);
      return { ...found, maps };
    }));
  return surfaceLoads.get(file);
}

// --- the program ---------------------------------------------------------------------------------

const vertexShader = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }`;

const fragmentShader = `#version 300 es
precision highp float;
uniform vec2 size;            // of the canvas
uniform mat3 turn;            // from the object's space to the eye's
uniform vec3 light;           // direction, in the eye's space
uniform bool wall, hasNormal, hasHeight, useNormal, useHeight, useOcclusion, useRoughness,
  useMetalness;
uniform float repeats, depth, strength, greenUp;  // depth in widths of the picture; strength in texels
uniform sampler2D colourMap, normalMap, heightMap, occlusionMap, roughnessMap, metalnessMap;
out vec4 shown;

vec2 gradientX, gradientY;    // of the picture's coordinates, per pixel
vec4 look(sampler2D map, vec2 at) { return textureGrad(map, at, gradientX, gradientY); }
float ground(vec2 at) { return look(heightMap, at).r; }

// Down the line of sight from the top (height 1) until it meets the ground.
vec2 displaced(vec2 at, vec3 eye) {
  const float steps = 32.0;
  vec2 whole = vec2(-eye.x, eye.y) / max(eye.z, 0.25) * depth;
  float before = 0.0, above = 1.0 - ground(at);
  if (above <= 0.0) return at;
  for (float i = 1.0; i <= steps; ++i) {
    float down = i / steps, gap = (1.0 - ground(at + whole * down)) - down;
    if (gap <= 0.0) {
      float share = above / max(above - gap, 1e-5);
      return at + whole * mix(before, down, share);
    }
    before = down;
    above = gap;
  }
  return at + whole;
}

float shadow(vec2 at, vec3 to) {
  if (to.z <= 0.0) return 0.0;
  float own = ground(at), lit = 1.0;
  vec2 whole = vec2(to.x, -to.y) / max(to.z, 0.15) * depth;
  for (float i = 1.0; i <= 16.0; ++i) {
    float up = (1.0 - own) * i / 16.0;
    lit = min(lit, 1.0 - 6.0 * (ground(at + whole * up) - own - up));
  }
  return clamp(lit, 0.0, 1.0);
}

vec3 bumps(vec2 at) {
  if (hasNormal) {
    vec3 n = look(normalMap, at).xyz * 2.0 - 1.0;
    return normalize(vec3(n.x, n.y * greenUp, max(n.z, 0.05)));
  }
  if (!hasHeight) return vec3(0, 0, 1);
  vec2 texel = 1.0 / vec2(textureSize(heightMap, 0));
  vec2 apart = max(texel, 0.5 * (abs(gradientX) + abs(gradientY)));
  float right = ground(at + vec2(apart.x, 0)) - ground(at - vec2(apart.x, 0));
  float down = ground(at + vec2(0, apart.y)) - ground(at - vec2(0, apart.y));
  return normalize(vec3(-strength * right * texel.x / (2.0 * apart.x),
                        strength * down * texel.y / (2.0 * apart.y), 1));
}

void main() {
  vec2 place = (gl_FragCoord.xy * 2.0 - size) / min(size.x, size.y);
  vec3 origin = vec3(0, 0, 4) * turn, ray = normalize(vec3(place * 0.29, -1)) * turn;  // by the transpose
  vec3 n, right, up;
  vec2 at;
  bool seen;
  if (wall) {
    vec3 hit = origin - ray * (origin.z / (abs(ray.z) < 1e-4 ? -1e-4 : ray.z));
    seen = origin.z > 0.0 && ray.z < 0.0 && max(abs(hit.x), abs(hit.y)) < 1.0;
    at = (hit.xy * vec2(0.5, -0.5) + 0.5) * repeats;
    n = vec3(0, 0, 1); right = vec3(1, 0, 0); up = vec3(0, 1, 0);
    gradientX = dFdx(at); gradientY = dFdy(at);
  } else {
    float along = dot(origin, ray), inside = along * along - dot(origin, origin) + 1.0;
    seen = inside > 0.0;
    n = normalize(origin + ray * (-along - sqrt(max(inside, 0.0))));
    float ring = max(length(n.xz), 1e-3);
    right = vec3(n.z, 0, -n.x) / ring;
    up = cross(n, right);
    at = vec2(atan(n.x, n.z) / 3.14159265 + 1.0, acos(clamp(n.y, -1.0, 1.0)) / 3.14159265) * repeats;
    vec3 dx = dFdx(n), dy = dFdy(n);
    gradientX = vec2(dot(dx, right) / ring, -dot(dx, up)) / 3.14159265 * repeats;
    gradientY = vec2(dot(dy, right) / ring, -dot(dy, up)) / 3.14159265 * repeats;
  }
  if (!seen) { shown = vec4(0); return; }
  mat3 frame = mat3(right, up, n);
  vec3 eye = -ray * frame, lamp = (light * turn) * frame;
  if (useHeight) at = displaced(at, eye);
  vec3 bump = useNormal ? bumps(at) : vec3(0, 0, 1);
  vec3 colour = look(colourMap, at).rgb;
  float occlusion = useOcclusion ? look(occlusionMap, at).r : 1.0;
  float rough = clamp(useRoughness ? look(roughnessMap, at).r : 0.6, 0.08, 1.0);
  // Bumps beyond the edge of the shadow are not lit, though some face the light.
  float facing = max(dot(bump, lamp), 0.0) * smoothstep(0.0, 0.2, lamp.z);
  if (useHeight && facing > 0.0) facing *= shadow(at, lamp);
  vec3 halfway = normalize(lamp + eye);
  float sharp = 2.0 / pow(rough, 4.0);
  float gloss = (sharp + 2.0) / 8.0 * pow(max(dot(bump, halfway), 0.0), sharp);
  // A metal has no colour but that of what it mirrors: the lamp, and a studio, light above.
  float metal = useMetalness ? clamp(look(metalnessMap, at).r, 0.0, 1.0) : 0.0;
  vec3 mirrors = mix(vec3(0.04), colour, metal);
  float above = (turn * (frame * reflect(-eye, bump))).y;
  float studio = mix(0.08, 0.7, smoothstep(-0.2 - rough, 0.2 + rough, above));
  vec3 sum = colour * (1.0 - metal) *
      (0.16 * occlusion * (0.75 + 0.25 * (turn * (frame * bump)).y) + 0.95 * facing)
    + min(mirrors * gloss, 2.0) * facing + colour * metal * studio * occlusion;
  shown = vec4(mix(1.055 * pow(max(sum, 0.0), vec3(1.0 / 2.4)) - 0.055, 12.92 * sum,
                   lessThan(sum, vec3(0.0031308))), 1);
}`;

// --- drawing: one canvas for all pictures, as browsers allow few -----------------------------------

let painter = null;  // {canvas, gl, uniforms, textures, found}

function startPainter() {
  const canvas = el('canvas', { class: 'surface' });
  const gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true });
  if (!gl) return null;
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  const uniforms = Object.fromEntries(Array.from({ length: count }, (_, i) => {
    const { name } = gl.getActiveUniform(program, i);
    return [name, gl.getUniformLocation(program, name)];
  }));
  canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
  canvas.addEventListener('webglcontextrestored', () => { painter = null; showSurface(); });
  return { canvas, gl, uniforms, textures: new Map(), found: null,
    halfFloats: gl.getExtension('EXT_color_buffer_float') };
}

/** Heights have 16 bits: the upper ones in red, the lower in green. */
function heightsOf(image) {
  const area = el('canvas', { width: image.width, height: image.height });
  const context = area.getContext('2d', { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  const { data: bytes } = context.getImageData(0, 0, image.width, image.height);
  return Float32Array.from({ length: bytes.length / 4 },
    (_, i) => (bytes[4 * i] * 256 + bytes[4 * i + 1]) / 65535);
}

function upload(name, image, found) {
  const { gl } = painter;
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  if (name === 'height')
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R16F, image.width, image.height, 0, gl.RED, gl.FLOAT,
      heightsOf(image));
  else
    gl.texImage2D(gl.TEXTURE_2D, 0, name === 'colour' ? gl.SRGB8_ALPHA8 : gl.RGBA8, gl.RGBA,
      gl.UNSIGNED_BYTE, image);
  const mips = name !== 'height' || painter.halfFloats;
  if (mips) gl.generateMipmap(gl.TEXTURE_2D);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, mips ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
  const wrap = (axis) => found.tile === axis || found.tile === 'both' ? gl.REPEAT : gl.MIRRORED_REPEAT;
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wrap('x'));
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wrap('y'));
  return texture;
}

function useMaps(found) {
  const { gl } = painter;
  if (painter.found === found) return;
  for (const texture of painter.textures.values()) gl.deleteTexture(texture);
  painter.textures = new Map(Object.entries(found.maps).map(([name, image]) =>
    [name, upload(name, image, found)]));
  painter.found = found;
}

function turned() {
  const [a, b] = [surface.yaw, surface.pitch];
  const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
  return [ca, sa * sb, -sa * cb, 0, cb, sb, sa, -ca * sb, ca * cb];  // columns: pitch after yaw
}

const lightDirection = () => [Math.sin(surface.lightYaw) * Math.cos(surface.lightPitch),
  Math.sin(surface.lightPitch), Math.cos(surface.lightYaw) * Math.cos(surface.lightPitch)];

function paint() {
  const { canvas, gl, uniforms, textures, found } = painter;
  const density = Math.min(devicePixelRatio, 2);
  canvas.width = Math.max(1, Math.round(canvas.clientWidth * density));
  canvas.height = Math.max(1, Math.round(canvas.clientHeight * density));
  gl.viewport(0, 0, canvas.width, canvas.height);
  ['colour', ...surfaceMaps].forEach((name, unit) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, textures.get(name) ?? textures.get('colour'));
    gl.uniform1i(uniforms[`${name}Map`], unit);
  });
  const has = (name) => textures.has(name);
  const on = (name) => !surface.off.has(name);
  const flags = { wall: view.surface === 'wall', hasNormal: has('normal'), hasHeight: has('height'),
    useNormal: on('normal') && (has('normal') || has('height')),
    useHeight: on('height') && has('height') && surface.depth > 0,
    useOcclusion: on('occlusion') && has('occlusion'),
    useRoughness: on('roughness') && has('roughness'),
    useMetalness: on('metalness') && has('metalness') };
  for (const [name, value] of Object.entries(flags)) gl.uniform1i(uniforms[name], value);
  gl.uniform2f(uniforms.size, canvas.width, canvas.height);
  gl.uniformMatrix3fv(uniforms.turn, false, turned());
  gl.uniform3fv(uniforms.light, lightDirection());
  gl.uniform1f(uniforms.repeats, surface.repeat);
  gl.uniform1f(uniforms.depth, surface.depth);
  gl.uniform1f(uniforms.strength, found.strength * (found.maps.height?.width ?? 1));
  gl.uniform1f(uniforms.greenUp, found.green === 'down' ? -1 : 1);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

// --- what the user does -----------------------------------------------------------------------------

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
function turnBy(across, down) {
  surface.yaw += across;
  surface.pitch = clamp(surface.pitch + down, -1.4, 1.4);
  if (view.surface === 'wall') surface.yaw = clamp(surface.yaw, -1.3, 1.3);
}
function moveLight(across, up) {
  surface.lightYaw = clamp(surface.lightYaw + across, -1.5, 1.5);
  surface.lightPitch = clamp(surface.lightPitch + up, -1.5, 1.5);
}

/** Whether the key was one for the surface. */
function surfaceKey(event) {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const [across, down] = arrows[event.key] ?? [0, 0];
  if (across || down) event.shiftKey ? moveLight(0.1 * across, -0.1 * down) : turnBy(0.1 * across, 0.1 * down);
  else if (event.key === '+' || event.key === '-') {
    surface.repeat = clamp(surface.repeat + (event.key === '+' ? 1 : -1), 1, 8);
    if (byId('surface-repeat')) byId('surface-repeat').value = surface.repeat;
  } else return false;
  event.preventDefault();
  paintSoon();
  return true;
}

let paintWaits = 0;
function paintSoon() {
  cancelAnimationFrame(paintWaits);
  paintWaits = requestAnimationFrame(() => { if (painter?.found && painter.canvas.isConnected) paint(); });
}

function listenToDrags(canvas) {
  let last = null;
  canvas.addEventListener('pointerdown', (event) => {
    last = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!last) return;
    const [across, down] = [event.clientX - last[0], event.clientY - last[1]].map((d) => d * 0.008);
    last = [event.clientX, event.clientY];
    (surface.drags === 'light') !== event.shiftKey ? moveLight(across, -down) : turnBy(across, down);
    paintSoon();
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { last = null; });
}

// --- its place in the viewer ----------------------------------------------------------------------------

const surfaceFile = (subject) => subject.job ? subject.job.view : subject.view;
const isLit = (subject) => ['ball', 'wall'].includes(view.surface) && Boolean(surfaceFile(subject));

/** Where nothing can be drawn live: a rendered preview, or a line that says why. */
function surfaceFallback(subject, why) {
  const preview = subject.views.find(({ label }) => /^preview(_|$)/.test(label));
  return preview
    ? [el('img', { class: 'surface', src: address(preview.file), alt: `${describe(subject)}, rendered` }),
      el('p', { class: 'small' }, why, ' This is the rendered preview.')]
    : el('p', { class: 'note' }, why);
}

function drawSurfaceStage(shown) {
  return el('div', { id: 'stage', class: 'stage lit', tabindex: '0', 'data-keep': 'stage', role: 'group',
    'aria-label': `${describe(shown)} ${view.surface === 'ball' ? 'on a ball' : 'as a wall'}. ` +
      'Arrow keys turn it, with shift they move the light, plus and minus repeat it' },
  el('div', { class: 'lit-place', id: 'surface' }),
  el('span', { class: 'tag', 'aria-live': 'polite' }, `${view.showB ? 'B' : 'A'} · ${shown.title}`));
}

function surfaceSlider(id, label, from, to, by, key) {
  return el('label', { class: 'choice' }, el('span', {}, label),
    el('input', { id, type: 'range', min: from, max: to, step: by, value: surface[key], 'data-keep': id,
      oninput: (event) => { surface[key] = Number(event.target.value); paintSoon(); } }));
}

function drawSurfaceControls(found) {
  const has = (name) => name in found.maps || (name === 'normal' && 'height' in found.maps);
  const names = { normal: 'normals', height: 'displacement' };
  return [
    segments('What dragging does', [['turn', 'turn', 'drag, or arrow keys'],
      ['light', 'light', 'drag with shift, or arrow keys with shift']], () => surface.drags,
    (drags) => { surface.drags = drags; }),
    surfaceSlider('surface-repeat', 'repeat', 1, 8, 1, 'repeat'),
    has('height') && surfaceSlider('surface-depth', 'depth', 0, 0.15, 0.005, 'depth'),
    surfaceMaps.some(has) && el('div', { class: 'segments', role: 'group', 'aria-label': 'Maps' },
      surfaceMaps.filter(has).map((name) => el('button', { type: 'button', 'data-map': name,
        'aria-pressed': String(!surface.off.has(name)), onclick: (event) => {
          const on = surface.off.delete(name);
          if (!on) surface.off.add(name);
          event.currentTarget.setAttribute('aria-pressed', String(on));
          paintSoon();
        } }, names[name] ?? name))),
  ].filter(Boolean);
}

/** Fills the stage of the viewer, when the data has come. */
async function showSurface() {
  const shown = view.showB ? view.b : view.a;
  const place = byId('surface');
  if (!place) return;
  const stillWanted = () => place.isConnected && view.surface;
  if (painter === null) painter = startPainter() ?? false;
  if (painter && !painter.listens) { listenToDrags(painter.canvas); painter.listens = true; }
  if (!painter) {
    place.replaceChildren(...[surfaceFallback(shown, 'This browser has no WebGL 2.')].flat());
    return;
  }
  try {
    const found = await loadSurface(surfaceFile(shown));
    if (!stillWanted()) return;
    useMaps(found);
    place.replaceChildren(painter.canvas);
    byId('surface-controls')?.replaceChildren(...drawSurfaceControls(found));
    paint();
  } catch (error) {
    if (stillWanted())
      place.replaceChildren(...[surfaceFallback(shown, `It cannot be shown: ${error.message}.`)].flat());
  }
}
