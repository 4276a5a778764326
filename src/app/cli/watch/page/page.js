'use strict';
// The page of a live scene. Everything that viewers change goes to the server, which sends the state to all of them.
const $ = id => document.getElementById(id);
/** Changes properties of a node that have other values: a new value, even an equal one, may cost a layout. */
function set(node, properties) {
  for (const [key, value] of Object.entries(properties)) if (node[key] !== value) node[key] = value;
}
const canvas = $('picture'), context = canvas.getContext('2d');
/** The state of the last event. */
let state = null;
/** Number of pictures shown since the page was loaded. */
let pictures = 0;

let timer = 0;
function say(text) {
  $('message').textContent = text;
  clearTimeout(timer);
  timer = setTimeout(() => { $('message').textContent = ''; }, 6000);
}

// Changes: one request at a time; while it is on its way, those of one kind are merged.
const waiting = new Map();
let isSending = false;
const merge = {
  orbit: (a, b) => a.map((x, i) => x + b[i]),
  pan: (a, b) => a.map((x, i) => x + b[i]),
  walk: (a, b) => a.map((x, i) => x + b[i]),
  zoom: (a, b) => a * b,
  roll: (a, b) => a + b,
};
function move(kind, value) {
  if (state && state.camera === null) {
    say('This camera cannot be moved: its vectors are skewed, or it has a normal, meshes, functions or a bokeh.');
    return;
  }
  const before = waiting.get(kind);
  waiting.set(kind, before ? { move: { [kind]: merge[kind](before.move[kind], value) } } : { move: { [kind]: value } });
  send();
}
function change(key, value) {
  waiting.set(key, value);
  send();
}
async function send() {
  if (isSending) return;
  isSending = true;
  for (const [key] of waiting) {
    const body = JSON.stringify(waiting.get(key));
    waiting.delete(key);
    try {
      const reply = await fetch('change', { method: 'POST', body });
      if (!reply.ok) say(await reply.text());
      else if (key.startsWith('write')) say('Written to the file.');
    } catch {
      say('The server does not answer.');
    }
  }
  isSending = false;
  if (waiting.size) send();
}

// The picture, and the view beside it.
let base = null, over = null;
/** Draws both: the picture to the left of the divider, the view to its right. */
function paint() {
  const { width, height } = canvas;
  if (base === null) return;
  context.clearRect(0, 0, width, height);
  context.drawImage(base, 0, 0, width, height);
  if (over === null || chosen !== null) return;
  const at = Math.round(width * $('divider').valueAsNumber / 100);
  context.save();
  context.beginPath();
  context.rect(at, 0, width - at, height);
  context.clip();
  context.drawImage(over, 0, 0, width, height);
  context.restore();
  context.fillStyle = '#fff';
  context.fillRect(at - 1, 0, 2, height);
}
async function bitmapOf(path) {
  const reply = await fetch(path);
  return reply.status === 200 ? createImageBitmap(await reply.blob()) : null;
}
/** The bitmap of a PNG file in base64. */
function bitmapIn(png) {
  const text = atob(png), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return createImageBitmap(new Blob([bytes], { type: 'image/png' }));
}
let loadedView = null;
const UNITS = { rays: 'rays', time: 'µs', error: 'steps of 1/255' };
const short = number => String(Number(number.toPrecision(3)));
async function showView(now) {
  set($('view'), { value: now.overlay ?? '' });
  set($('view').querySelector('[value=povray]'), { disabled: !now.has_povray });
  const [number, view] = now.overlaid ?? [null, null];
  for (const part of document.querySelectorAll('.divided')) set(part, { hidden: now.overlay === null });
  set($('legend'), { hidden: now.overlay === null });
  set($('scale'), { hidden: !view?.scale });
  if (view?.scale) {
    const { brightest, largest, mean } = view.scale;
    $('legend-text').textContent = `0 to ${short(brightest)} ${UNITS[view.kind]} a pixel, logarithmic; mean ${short(mean)}, largest `
      + `${short(largest)}; made in ${view.seconds.toFixed(2)} s`;
  } else {
    $('legend-text').textContent = view ? `${view.note} (${view.seconds.toFixed(2)} s)` : 'It is made after the whole picture …';
  }
  if (number === loadedView) return;
  loadedView = number;
  const wanted = number === null ? null : await bitmapOf('overlay.png?' + number);
  if (loadedView !== number) return;
  over = wanted;
  canvas.dataset.view = over === null ? '' : view.kind;
  paint();
}
$('view').addEventListener('change', () => change('overlay', { overlay: $('view').value || null }));
$('divider').addEventListener('input', paint);
/** The number of the picture in `base`, and of the one for which it was fetched last, with or without success. */
let loaded = -1, fetched = -1;
/** True if the picture in `base` is shown as what it is: a later one than asked for may be taken for a preview. */
let isKnown = false;
let isLoading = false, chosen = null;
/** The patch of the current picture, if it belongs to the one that the page shows. */
const patchToDraw = () => chosen === null && state.patch?.over === loaded ? state.patch : null;
/** True if the page shows the current picture, from its file or as a patch. */
const isCurrent = () =>
  patchToDraw() === null &&
  (fetched === state.picture || isKnown && loaded === state.picture || loaded === state.patch?.number);
async function load() {
  if (isLoading || !state || state.width === null || isCurrent()) return;
  isLoading = true;
  const wanted = state, patch = patchToDraw(), of = chosen;
  try {
    await (patch === null ? loadPicture(wanted, of) : loadPatch(patch));
  } catch {
    // The stream of events reports a server that has ended. A patch that cannot be drawn is not tried again.
    wanted.patch = null;
  }
  if (patch === null && chosen === of) fetched = wanted.picture;
  isLoading = false;
  if (state && !isCurrent()) load();
}
/** Loads the current picture, or this one of the history. */
async function loadPicture(wanted, of) {
  let number = wanted.picture, bitmap;
  if (of === null && wanted.preview !== null) {
    bitmap = await bitmapIn(wanted.preview);
  } else {
    const reply = await fetch(of === null ? 'picture.png?' + wanted.picture : 'history.png?' + of);
    if (reply.status !== 200) return;
    bitmap = await createImageBitmap(await reply.blob());
    // There may be a later one already.
    number = Number(reply.headers.get('picture-number') ?? wanted.picture);
  }
  // Another picture may be chosen by now.
  if (chosen !== of) return bitmap.close();
  loaded = number;
  isKnown = loaded === wanted.picture;
  if (canvas.width !== wanted.width || canvas.height !== wanted.height) {
    canvas.width = wanted.width;
    canvas.height = wanted.height;
    canvas.style.setProperty('--ratio', wanted.width / wanted.height);
  }
  base ??= document.createElement('canvas');
  base.width = bitmap.width;
  base.height = bitmap.height;
  base.getContext('2d').drawImage(bitmap, 0, 0);
  bitmap.close();
  showBase(of === null && !wanted.is_preview);
}
/** Draws a patch over the picture that it belongs to. */
async function loadPatch({ number, over, column, row, png }) {
  const bitmap = await bitmapIn(png);
  if (chosen !== null || loaded !== over) return bitmap.close();
  const to = base.getContext('2d');
  to.clearRect(column, row, bitmap.width, bitmap.height);
  to.drawImage(bitmap, column, row);
  bitmap.close();
  loaded = number;
  isKnown = true;
  showBase(true);
}
function showBase(isFinal) {
  paint();
  pictures++;
  canvas.dataset.pictures = pictures;
  canvas.dataset.final = isFinal;
}

function status(now) {
  if (now.scene === null) return 'choose a scene';
  if (now.width === null) return now.errors ? 'not drawn' : 'waiting for the first picture';
  if (now.errors) return 'not drawn: showing the last good picture';
  if (now.is_preview) return 'drawing …';
  return `${now.width} × ${now.height}, drawn in ${now.seconds.toFixed(2)} s`;
}
function show(now) {
  const before = state;
  state = now;
  if (chosen !== null && !now.history.includes(chosen)) chosen = null;
  // The picture is decoded while the rest is shown.
  if (now.scene !== null) load();
  set($('errors'), { textContent: now.errors });
  set($('warnings'), { textContent: now.errors ? '' : now.warnings });
  document.body.classList.toggle('wrong', now.errors !== '');
  document.body.classList.toggle('drawing', now.is_preview && now.errors === '');
  set($('state'), { textContent: status(now) });
  set($('title'), { textContent: now.scene ?? 'povr' });
  set(document, { title: now.scene === null ? 'povr' : `${now.scene} – povr` });
  document.querySelector('main').classList.toggle('gallery', now.scene === null);
  showScenes(before, now);
  set($('camera'), { textContent: now.camera ?? 'This camera cannot be moved by hand.' });
  set($('copy'), { disabled: now.camera === null });
  for (const id of ['write-camera', 'reset-camera']) set($(id), { disabled: !now.is_moved });
  const isChanged = now.values.length > 0;
  set($('write-values'), { disabled: !isChanged });
  set($('reset-values'), { disabled: !isChanged && now.clock === null });
  const clock = now.clock ?? now.own_clock ?? 0;
  const [low, high] = now.clocks;
  const ends = [Math.min(low, high), Math.max(low, high), Math.abs(high - low) / 100 || 'any'].map(String);
  set($('clock'), { min: ends[0], max: ends[1], step: ends[2] });
  if (document.activeElement !== $('clock')) set($('clock'), { value: String(clock) });
  set($('clock-value'), { textContent: clock.toFixed(2) });
  showControls(now);
  showHistory(now);
  showPixel(now.picked);
  showPlan(now);
  showView(now);
  if (now.scene === null) return;
  if (before === null || before.text !== now.text) {
    clearTimeout(sourceTimer);
    sourceTimer = setTimeout(loadSource, before === null ? 0 : SOURCE_DELAY);
  } else if (JSON.stringify(now.values) !== marked) markNumbers();
}

// Sliders.
function setValue(text, { start, end }, value) {
  change('value' + start, { value: { text, start, end, value } });
}
const value = (now, control) => now.values.find(([start]) => start === control.start)?.[1] ?? control.value;
function rounded(number) {
  return String(Number(number.toPrecision(5)));
}
let controls = '';
function showControls(now) {
  const box = $('sliders');
  const key = JSON.stringify(now.controls);
  if (key !== controls) {
    controls = key;
    $('no-sliders').hidden = now.controls.length > 0;
    box.replaceChildren(...now.controls.map((control, index) => {
      const row = document.createElement('p');
      row.className = 'row';
      const label = document.createElement('label');
      label.textContent = control.name;
      label.htmlFor = 'slider' + index;
      const input = document.createElement('input');
      Object.assign(input, { type: 'range', id: 'slider' + index, min: control.low, max: control.high, step: 'any' });
      const output = document.createElement('output');
      output.htmlFor = input.id;
      input.addEventListener('input', () => {
        const text = rounded(input.valueAsNumber);
        output.textContent = text;
        setValue(state?.text, control, text);
      });
      row.append(label, input, output);
      return row;
    }));
  }
  [...box.children].forEach((row, index) => {
    const input = row.querySelector('input'), text = value(now, now.controls[index]);
    if (document.activeElement !== input) set(input, { value: text });
    set(row.querySelector('output'), { textContent: text });
  });
}

// Numbers in the source.
const PARTS = /\/\/.*|\/\*[\s\S]*?\*\/|"(?:[^"\\]|\\.)*"|[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/g;
/** The longest source that is shown, in bytes. */
const LONGEST = 300000;
/** Time after which a changed source is shown, in milliseconds: laying out a long one would delay the picture. */
const SOURCE_DELAY = 100;
let sourceTimer = 0;
async function loadSource() {
  // The connection may have been opened again meanwhile.
  if (!state) return;
  const { text: number } = state;
  const box = $('source');
  // A scene that has just been opened has none yet.
  if (state.text_bytes === 0 || state.text_bytes > LONGEST) {
    box.textContent = state.text_bytes === 0 ? 'There is no text in UTF-8.' : 'The scene is too long to be shown.';
    return;
  }
  const reply = await fetch('scene.pov?' + number);
  const text = await reply.text();
  if (state?.text !== number) return;
  if (!reply.ok) {
    box.textContent = text;
    return;
  }
  const encoder = new TextEncoder(), pieces = [];
  let done = 0, bytes = 0, line = 1;
  for (const part of text.matchAll(PARTS)) {
    if (!/^[.\d]/.test(part[0])) continue;
    const before = text.slice(done, part.index);
    bytes += encoder.encode(before).length;
    line += before.split('\n').length - 1;
    pieces.push(before, numberIn(part[0], bytes, line, number));
    bytes += part[0].length;
    done = part.index + part[0].length;
  }
  pieces.push(text.slice(done));
  box.replaceChildren(...pieces);
  markNumbers();
}
function numberIn(text, start, line, source) {
  const span = document.createElement('span');
  span.className = 'number';
  span.textContent = text;
  span.tabIndex = 0;
  span.role = 'spinbutton';
  span.ariaLabel = 'number in line ' + line;
  span.ariaValueNow = text;
  Object.assign(span.dataset, { start, end: start + text.length, written: text });
  const give = number => {
    span.textContent = rounded(number);
    setValue(source, { start, end: start + text.length }, span.textContent);
  };
  const step = Math.max(Math.abs(Number(text)), 0.1) / 100;
  let from = null;
  span.addEventListener('pointerdown', event => {
    from = { x: event.clientX, number: Number(span.textContent) };
    span.setPointerCapture(event.pointerId);
    event.preventDefault();
    span.focus();
  });
  span.addEventListener('pointermove', event => {
    if (from && event.clientX !== from.x) give(from.number + (event.clientX - from.x) * step);
  });
  span.addEventListener('pointerup', () => { from = null; });
  span.addEventListener('pointercancel', () => { from = null; });
  span.addEventListener('keydown', event => {
    const sign = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
    if (!sign) return;
    event.preventDefault();
    give(Number(span.textContent) + sign * step * (event.shiftKey ? 10 : 1));
  });
  return span;
}
/** The values that the numbers show. */
let marked = '';
function markNumbers() {
  if (!state) return;
  marked = JSON.stringify(state.values);
  const values = new Map(state.values.map(([start, text]) => [String(start), text]));
  for (const span of document.querySelectorAll('.number')) {
    const changed = values.get(span.dataset.start);
    span.classList.toggle('changed', changed !== undefined);
    if (document.activeElement === span) marked = '';
    else set(span, { textContent: changed ?? span.dataset.written });
    span.ariaValueNow = span.textContent;
  }
}

// The pixel.
let reported = '';
function showPixel(picked) {
  const key = JSON.stringify(picked);
  if (picked === null || key === reported) return;
  reported = key;
  $('no-pixel').hidden = true;
  const vector = numbers => `<${numbers.map(number => Number(number.toPrecision(6))).join(', ')}>`;
  const { surface, rays } = picked;
  const total = Object.values(rays).reduce((a, b) => a + b, 0);
  const kinds = Object.entries(rays).filter(([, count]) => count).map(([kind, count]) => `${count} ${kind}`);
  const rows = [['pixel', `${picked.column}, ${picked.row}`]];
  if (surface) {
    const { object } = surface;
    rows.push(['object', object ? `${object.file}, line ${object.line}, column ${object.column}` : 'part of a larger one']);
    rows.push(['point', vector(surface.point)], ['normal', vector(surface.normal)]);
    rows.push(['distance', String(Number(surface.distance.toPrecision(6)))]);
  } else {
    rows.push(['object', 'none: the background']);
  }
  rows.push(['cost', `${total} rays (${kinds.join(', ')}), ${(picked.seconds * 1000).toFixed(2)} ms`]);
  fill($('pixel'), rows);
}

// The scenes of the folder.
let scenes = [], isListing = false;
async function showScenes(before, now) {
  const isNew = before === null || before.thumbnails !== now.thumbnails;
  if (isNew && !isListing) {
    isListing = true;
    const reply = await fetch('scenes.json');
    if (reply.ok) scenes = await reply.json();
    isListing = false;
    const buttons = new Map([...$('scenes').children].map(button => [button.dataset.name, button]));
    $('scenes').replaceChildren(...scenes.map(scene => {
      const button = buttons.get(scene.name);
      return button && button.dataset.thumbnail === String(scene.thumbnail) ? button : sceneButton(scene);
    }));
    $('scenes').hidden = state.scene !== null && scenes.length < 2;
    if (state.thumbnails !== now.thumbnails) showScenes(null, state);
  }
  for (const button of $('scenes').children) set(button, { ariaCurrent: String(button.dataset.name === state.scene) });
}
function sceneButton({ name, thumbnail }) {
  const button = document.createElement('button');
  Object.assign(button.dataset, { name, thumbnail });
  const picture = document.createElement(thumbnail === null ? 'span' : 'img');
  if (thumbnail === null) {
    picture.className = 'none';
  } else {
    picture.src = 'thumbnail.png?' + thumbnail;
    picture.alt = '';
  }
  button.append(picture, name);
  button.addEventListener('click', () => change('open', { open: name }));
  return button;
}

// The plan.
let planned = '';
const count = (number, one, many) => `${number} ${number === 1 ? one : many}`;
const size = bytes => bytes < 1024 ? `${bytes} bytes` : bytes < 1 << 20 ? `${short(bytes / 1024)} kB` : `${short(bytes / (1 << 20))} MB`;
function showPlan({ statistics }) {
  const key = JSON.stringify(statistics);
  if (statistics === null || key === planned) return;
  planned = key;
  const { plan, rays, samples_per_pixel: samples } = statistics;
  const list = counts => Object.entries(counts).filter(([, n]) => n).map(([name, n]) => `${n} ${name}`).join(', ') || 'none';
  const rows = [
    ['objects', list(plan.primitives)],
    ['CSG', String(plan.combinations)],
    ['instances', plan.shared ? `${plan.instances} of ${count(plan.shared, 'union', 'unions')}, ${plan.instance_bytes} bytes each` : 'none'],
    ['in world space', `all but ${plan.behind_matrix}`],
    ['unbounded', String(plan.unbounded)],
    ['materials', String(plan.surfaces)],
    ['lights', String(plan.lights)],
    ['tree', size(plan.tree_bytes)],
    ['light buffers', size(plan.view_bytes)],
    ['left out', plan.left_out.join(', ') || 'nothing'],
    ['rays', list(rays)],
    ['samples', `${short(samples)} a pixel`],
  ];
  if (statistics.peak_bytes) rows.push(['memory', size(statistics.peak_bytes)]);
  fill($('plan'), rows);
}
/** Fills a list of terms. */
function fill(box, rows) {
  box.replaceChildren(...rows.flatMap(([name, text]) => {
    const term = document.createElement('dt'), value = document.createElement('dd');
    term.textContent = name;
    value.textContent = text;
    return [term, value];
  }));
}

// History.
let listed = '';
function showHistory(now) {
  const key = now.history.join();
  const box = $('history');
  if (key !== listed) {
    listed = key;
    box.replaceChildren(...now.history.map((number, index) => {
      const button = document.createElement('button');
      button.ariaLabel = `picture ${index + 1} of ${now.history.length}`;
      button.dataset.number = number;
      const image = document.createElement('img');
      image.src = 'history.png?' + number;
      image.alt = '';
      button.append(image);
      button.addEventListener('click', () => choose(chosen === number ? null : number));
      return button;
    }));
    box.scrollLeft = box.scrollWidth;
  }
  for (const button of box.children) set(button, { ariaPressed: String(Number(button.dataset.number) === chosen) });
}
function choose(number) {
  chosen = number;
  loaded = fetched = -1;
  if (state) showHistory(state);
  load();
}

// The mouse and fingers.
const fingers = new Map();
/** Start of a press, as long as it may be a click. */
let press = null;
/** The largest movement of a click in pixels. */
const CLICK = 3;
const place = event => ({ x: event.clientX / canvas.clientWidth, y: event.clientY / canvas.clientHeight });
function pair() {
  const [a, b] = [...fingers.values()];
  const [x, y] = [(b.x - a.x) * canvas.clientWidth, (b.y - a.y) * canvas.clientHeight];
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, length: Math.hypot(x, y), angle: Math.atan2(y, x) };
}
canvas.addEventListener('pointerdown', event => {
  if (chosen !== null) choose(null);
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, place(event));
  press = event.button === 0 && fingers.size === 1 ? { x: event.clientX, y: event.clientY } : null;
  canvas.focus({ preventScroll: true });
});
canvas.addEventListener('pointermove', event => {
  cursor(event);
  const before = fingers.get(event.pointerId);
  if (!before) return;
  const now = place(event);
  if (press && Math.hypot(event.clientX - press.x, event.clientY - press.y) <= CLICK) return;
  press = null;
  if (fingers.size === 2) {
    const from = pair();
    fingers.set(event.pointerId, now);
    const to = pair();
    move('pan', [to.x - from.x, to.y - from.y]);
    if (from.length > 0 && to.length > 0) move('zoom', to.length / from.length);
    let turn = (from.angle - to.angle) / (2 * Math.PI);
    turn -= Math.round(turn);
    if (turn) move('roll', turn);
    return;
  }
  fingers.set(event.pointerId, now);
  const kind = event.shiftKey || event.buttons & 6 ? 'pan' : 'orbit';
  move(kind, [now.x - before.x, now.y - before.y]);
});
for (const end of ['pointerup', 'pointercancel']) {
  canvas.addEventListener(end, event => {
    fingers.delete(event.pointerId);
    cursor(event);
    if (press && end === 'pointerup') pick(event);
    press = null;
  });
}
canvas.addEventListener('contextmenu', event => event.preventDefault());
canvas.addEventListener('wheel', event => {
  event.preventDefault();
  move('zoom', Math.exp(-Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 200) / 1000));
}, { passive: false });
function pick(event) {
  const box = canvas.getBoundingClientRect();
  change('pick', { pick: [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height] });
}
function cursor(event) {
  if (!state?.has_cursor) return;
  const box = canvas.getBoundingClientRect();
  const across = 2 * (event.clientX - box.left) / box.width - 1, up = 1 - 2 * (event.clientY - box.top) / box.height;
  const clamped = number => Math.max(-1, Math.min(1, number));
  change('cursor', { cursor: [clamped(across), clamped(up), event.buttons & 1] });
}

// Keys.
canvas.addEventListener('keydown', event => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const turns = { ArrowLeft: [-0.02, 0], ArrowRight: [0.02, 0], ArrowUp: [0, -0.02], ArrowDown: [0, 0.02] };
  const steps = { a: [-0.05, 0, 0], d: [0.05, 0, 0], r: [0, 0.05, 0], f: [0, -0.05, 0], w: [0, 0, 0.05], s: [0, 0, -0.05] };
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (turns[key]) move(event.shiftKey ? 'pan' : 'orbit', turns[key]);
  else if (steps[key]) move('walk', steps[key]);
  else if (key === '+' || key === '=') move('zoom', 1.1);
  else if (key === '-') move('zoom', 1 / 1.1);
  else if (key === 'q') move('roll', 0.01);
  else if (key === 'e') move('roll', -0.01);
  else if (key === '0') change('reset-camera', 'reset_camera');
  else return;
  event.preventDefault();
});

// Buttons.
$('copy').addEventListener('click', async () => {
  try {
    await navigator.clipboard.writeText(state.camera);
    say('Copied.');
  } catch {
    getSelection().selectAllChildren($('camera'));
    say('Selected: copy it with the keys of your browser.');
  }
});
$('write-camera').addEventListener('click', () => change('write-camera', 'write_camera'));
$('reset-camera').addEventListener('click', () => change('reset-camera', 'reset_camera'));
$('write-values').addEventListener('click', () => change('write-values', 'write_values'));
$('reset-values').addEventListener('click', () => change('reset-values', 'reset_values'));
$('actual').addEventListener('click', () => {
  const isActual = document.body.classList.toggle('actual');
  $('actual').setAttribute('aria-pressed', isActual);
});

$('clock').addEventListener('input', () => {
  $('clock-value').textContent = $('clock').valueAsNumber.toFixed(2);
  change('clock', { clock: $('clock').valueAsNumber });
});
/** Interval of the pictures of an animation in milliseconds, if they come in time. */
const FRAME = 40;
let player = null, played = -1;
function play() {
  if (pictures === played || waiting.size || isSending) return;
  played = pictures;
  const [first, last] = state.clocks, clock = (state.clock ?? state.own_clock) + (last - first) / 100;
  change('clock', { clock: (clock - last) * (last - first) > 0 ? first : clock });
}
$('play').addEventListener('click', () => {
  clearInterval(player);
  player = player === null ? setInterval(play, FRAME) : null;
  played = -1;
  $('play').ariaPressed = String(player !== null);
  $('play').textContent = player === null ? 'Play' : 'Stop';
});

/** Time after which a lost connection is tried again, in milliseconds. */
const AGAIN = 1000;
function listen() {
  const events = new EventSource('events');
  // A server that has been started again counts from the beginning.
  events.onopen = () => {
    state = chosen = null;
    loaded = fetched = -1;
    document.body.classList.remove('ended');
  };
  events.onmessage = event => {
    const now = JSON.parse(event.data);
    if (state === null || now.number !== state.number) show(now);
  };
  events.onerror = () => {
    $('state').textContent = 'povr does not answer: waiting for it to come back';
    document.body.classList.remove('drawing');
    document.body.classList.add('ended');
    events.close();
    setTimeout(listen, AGAIN);
  };
}
listen();
