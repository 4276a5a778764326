'use strict';
const table = document.querySelector('.scenes');
const body = table.tBodies[0];
const tiles = document.querySelector('.tiles').tBodies[0];
const rows = [...body.rows];
const search = document.querySelector('#search');
const order = document.querySelector('#order');
const chips = [...document.querySelectorAll('.chip')];
const grid = document.querySelector('#grid');
const heads = [...table.querySelectorAll('th[data-key]')];

// ---- The scale of differences: every doubling is as far as every other, so that one step is seen beside many.
const STOPS = [[0, 0, 0, 0], [0.05, 70, 80, 220], [0.3, 160, 50, 190], [0.55, 220, 60, 70], [0.8, 250, 160, 40], [1, 255, 255, 200]];
const COLORS = Array.from({ length: 256 }, (_, step) => {
  if (step === 0) return [0, 0, 0];
  const at = 0.05 + 0.95 * Math.log2(step) / Math.log2(255);
  const i = Math.max(1, STOPS.findIndex(stop => stop[0] >= at - 1e-9));
  const [a, b] = [STOPS[i - 1], STOPS[i]];
  const t = Math.min(1, (at - a[0]) / (b[0] - a[0]));
  return [1, 2, 3].map(c => Math.round(a[c] + t * (b[c] - a[c])));
});

function canvasOf(image) {
  const canvas = document.createElement('canvas');
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  canvas.getContext('2d', { willReadFrequently: true }).drawImage(image, 0, 0);
  return canvas;
}

// The differences in colour; each pixel shows the largest within `reach`, so that single ones are seen in small pictures.
function colored(image, reach) {
  const canvas = canvasOf(image);
  const { width, height } = canvas;
  const context = canvas.getContext('2d', { willReadFrequently: true });
  const data = context.getImageData(0, 0, width, height);
  const steps = Uint8Array.from({ length: width * height }, (_, at) => data.data[4 * at]);
  const widened = steps.slice();
  if (reach) {
    steps.forEach((step, at) => {
      if (step === 0) return;
      const [x, y] = [at % width, Math.floor(at / width)];
      for (let v = Math.max(0, y - reach); v <= Math.min(height - 1, y + reach); v++) {
        for (let u = Math.max(0, x - reach); u <= Math.min(width - 1, x + reach); u++) {
          widened[v * width + u] = Math.max(widened[v * width + u], step);
        }
      }
    });
  }
  widened.forEach((step, at) => data.data.set([...COLORS[step], 255], 4 * at));
  context.putImageData(data, 0, 0);
  return canvas;
}

for (const canvas of document.querySelectorAll('.scale canvas')) {
  canvas.width = 512; canvas.height = 1;
  const context = canvas.getContext('2d');
  for (let x = 0; x < 512; x++) {
    const step = Math.round(2 ** (Math.log2(255) * x / 511));
    context.fillStyle = `rgb(${COLORS[Math.min(255, step)]})`;
    context.fillRect(x, 0, 1, 1);
  }
}

const paint = new IntersectionObserver(seen => {
  for (const { target, isIntersecting } of seen) {
    if (!isIntersecting) continue;
    paint.unobserve(target);
    target.decode().then(() => {
      const canvas = colored(target, 1);
      canvas.className = 'painted';
      target.hidden = true;
      target.after(canvas);
    }).catch(() => {});
  }
}, { rootMargin: '600px' });
document.querySelectorAll('img.steps').forEach(image => paint.observe(image));

// ---- Order and choice.
const number = (row, key) => row.dataset[key] === undefined || row.dataset[key] === '' ? NaN : Number(row.dataset[key]);
const BY_NAME = (a, b) => a.dataset.name.localeCompare(b.dataset.name, 'en', { numeric: true });
let sorting = { key: 'worst', ascending: false };

function sort(key, ascending) {
  sorting = { key, ascending };
  const sign = ascending ? 1 : -1;
  rows.sort((a, b) => {
    if (key === 'name') return sign * BY_NAME(a, b);
    const [x, y] = [number(a, key), number(b, key)];
    if (isNaN(x) || isNaN(y)) return isNaN(x) - isNaN(y) || BY_NAME(a, b);
    return sign * (x - y) || BY_NAME(a, b);
  });
  arrange();
  for (const head of heads) {
    if (head.dataset.key === key) head.setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
    else head.removeAttribute('aria-sort');
  }
  const option = [...order.options].find(option => option.value === `${key}${ascending ? '+' : '-'}`);
  order.value = option ? option.value : '';
}

// Scenes that pass are tiles below the rows, unless they are what the table is about.
function arrange() {
  const passes = row => grid.checked && row.dataset.status === 'pass';
  body.append(...rows.filter(row => !passes(row)));
  tiles.append(...rows.filter(passes));
  table.hidden = !body.rows.length;
}

function choose() {
  const words = search.value.toLowerCase().split(/\s+/).filter(word => word);
  const statuses = chips.filter(chip => chip.getAttribute('aria-pressed') === 'true').map(chip => chip.dataset.status);
  let shown = 0;
  for (const row of rows) {
    const text = row.dataset.text;
    row.hidden = !(statuses.includes(row.dataset.status) && words.every(word => text.includes(word)));
    shown += !row.hidden;
  }
  document.querySelector('#shown').textContent = `${shown} of ${rows.length}`;
  document.querySelector('#empty').hidden = shown > 0;
}

heads.forEach(head => head.querySelector('button').addEventListener('click', () => {
  const key = head.dataset.key;
  sort(key, sorting.key === key ? !sorting.ascending : key === 'name' || key === 'psnr' || key === 'ratio');
}));
grid.addEventListener('change', arrange);
order.addEventListener('change', () => sort(order.value.slice(0, -1), order.value.endsWith('+')));
search.addEventListener('input', choose);
chips.forEach(chip => chip.addEventListener('click', event => {
  const others = chips.filter(other => other !== chip);
  if (event.shiftKey) {
    chip.setAttribute('aria-pressed', 'true');
    others.forEach(other => other.setAttribute('aria-pressed', 'false'));
  } else {
    chip.setAttribute('aria-pressed', String(chip.getAttribute('aria-pressed') !== 'true'));
  }
  choose();
}));
document.querySelectorAll('.words button').forEach(button => button.addEventListener('click', () => {
  search.value = button.dataset.word;
  chips.forEach(chip => chip.setAttribute('aria-pressed', 'true'));
  choose();
  document.querySelector('.bar').scrollIntoView();
}));

// ---- The viewer.
const dialog = document.querySelector('dialog');
const stage = dialog.querySelector('.stage');
const pixel = dialog.querySelector('#pixel');
const slide = dialog.querySelector('#slide');
const modes = [...dialog.querySelectorAll('[data-mode]')];
const zoom = dialog.querySelector('#zoom');
let viewed = null, mode = 'slider', flicker = 0;
// All pictures are seen through windows of one size, enlarged and moved in step. `fit` is the factor that fills a window.
const lens = { fit: 1, factor: 1, x: 0, y: 0 };
let windows = [], update = () => {};

function pane(title, canvas) {
  const figure = document.createElement('figure');
  const caption = document.createElement('figcaption');
  caption.textContent = title;
  const pane = document.createElement('div');
  pane.className = 'window';
  pane.style.width = `${Math.round(canvas.width * lens.fit)}px`;
  pane.style.height = `${Math.round(canvas.height * lens.fit)}px`;
  pane.append(canvas);
  figure.append(caption, pane);
  stage.append(figure);
  windows.push(pane);
  return { caption, pane };
}

function focus() {
  const pane = windows[0];
  if (!pane) return;
  const canvas = pane.querySelector('canvas');
  const limit = (offset, window, size) => Math.min(0, Math.max(window - size * lens.factor, offset));
  lens.x = limit(lens.x, pane.clientWidth, canvas.width);
  lens.y = limit(lens.y, pane.clientHeight, canvas.height);
  for (const canvas of stage.querySelectorAll('canvas')) {
    canvas.style.transform = `translate(${lens.x}px, ${lens.y}px) scale(${lens.factor})`;
  }
  update();
}

function magnify(factor, x, y) {
  const next = Math.min(Math.max(factor, lens.fit), Math.max(64, lens.fit));
  lens.x = x - (x - lens.x) * next / lens.factor;
  lens.y = y - (y - lens.y) * next / lens.factor;
  lens.factor = next;
  focus();
}

async function view(row, wanted) {
  viewed = row;
  if (wanted) mode = wanted;
  clearInterval(flicker);
  stage.replaceChildren();
  windows = [];
  update = () => {};
  pixel.textContent = '';
  dialog.querySelector('h2').textContent = row.dataset.name;
  dialog.querySelector('#numbers').textContent = row.dataset.numbers;
  modes.forEach(button => button.setAttribute('aria-pressed', String(button.dataset.mode === mode)));
  if (!dialog.open) dialog.showModal();
  history.replaceState(null, '', `#${encodeURIComponent(row.dataset.name)}`);
  const images = [...row.querySelectorAll('img')];
  // Pictures far down the page are read when they are first needed.
  images.forEach(image => { image.loading = 'eager'; });
  const unread = images.filter(image => !image.complete);
  if (unread.length) await Promise.all(unread.map(image => image.decode().catch(() => {})));
  const named = name => images.find(image => image.classList.contains(name));
  const [theirs, ours, steps] = ['theirs', 'ours', 'steps'].map(named);
  const first = theirs || ours;
  if (!first || viewed !== row) return;
  const beside = mode === 'beside' && ours && theirs;
  const room = [stage.clientWidth - 24, stage.clientHeight - 24];
  const fits = (across, down) => Math.min((room[0] / across - 8) / first.naturalWidth, (room[1] / down - 28) / first.naturalHeight);
  const fit = beside ? Math.max(fits(2, 1), fits(1, 2)) : fits(1, 1);
  lens.fit = fit >= 1 ? Math.floor(fit) : Math.max(fit, 0.01);
  lens.factor = zoom.value === 'fit' ? lens.fit : Math.max(Number(zoom.value), lens.fit);
  lens.x = lens.y = 0;
  slide.hidden = mode !== 'slider' || !ours || !theirs;
  const [a, b] = [theirs, ours].map(image => image && canvasOf(image));
  if (mode === 'difference' && steps) {
    const { pane: holder } = pane('Difference: the most different channel', colored(steps, 0));
    if (row.dataset.x) {
      const mark = document.createElement('div');
      mark.className = 'mark';
      mark.title = 'the largest difference';
      update = () => {
        mark.style.left = `${lens.x + (Number(row.dataset.x) + 0.5) * lens.factor}px`;
        mark.style.top = `${lens.y + (Number(row.dataset.y) + 0.5) * lens.factor}px`;
      };
      holder.append(mark);
    }
  } else if (mode === 'beside' || !a || !b) {
    if (a) pane(row.dataset.left, a);
    if (b) pane(row.dataset.right, b);
  } else {
    const { caption, pane: holder } = pane('', a);
    const over = document.createElement('div');
    over.className = 'over';
    over.append(b);
    holder.append(over);
    if (mode === 'slider') {
      holder.classList.add('slides');
      caption.textContent = `left ${row.dataset.left}, right ${row.dataset.right}`;
      const line = document.createElement('div');
      line.className = 'line';
      holder.append(line);
      slide.oninput = () => {
        over.style.clipPath = `inset(0 0 0 ${slide.value}%)`;
        line.style.left = `${slide.value}%`;
      };
      slide.oninput();
    } else {
      const swap = () => {
        over.hidden = !over.hidden;
        caption.textContent = over.hidden ? row.dataset.left : row.dataset.right;
      };
      swap();
      flicker = setInterval(swap, 600);
    }
  }
  focus();
}

// Where the pointer is in a window.
function within(event) {
  const pane = event.target.closest('.window');
  if (!pane) return null;
  const box = pane.getBoundingClientRect();
  return { pane, x: event.clientX - box.left, y: event.clientY - box.top };
}

// A drag moves the line of the slider; elsewhere, and with the shift key, the pictures.
stage.addEventListener('pointerdown', event => {
  const at = within(event);
  if (!at || event.button !== 0) return;
  event.preventDefault();
  const slides = at.pane.classList.contains('slides') && !event.shiftKey;
  const box = at.pane.getBoundingClientRect();
  let last = event;
  const move = event => {
    if (slides) {
      slide.value = 100 * (event.clientX - box.left) / box.width;
      slide.oninput();
    } else {
      lens.x += event.clientX - last.clientX;
      lens.y += event.clientY - last.clientY;
      focus();
    }
    last = event;
  };
  move(event);
  addEventListener('pointermove', move);
  for (const end of ['pointerup', 'pointercancel']) {
    addEventListener(end, () => removeEventListener('pointermove', move), { once: true });
  }
});
stage.addEventListener('wheel', event => {
  const at = within(event);
  if (!at) return;
  event.preventDefault();
  magnify(lens.factor * 2 ** (-Math.sign(event.deltaY) / 2), at.x, at.y);
}, { passive: false });
stage.addEventListener('pointermove', event => {
  const at = within(event);
  const [a, b] = [...stage.querySelectorAll('canvas')];
  if (!at || !b) return;
  const x = Math.floor((at.x - lens.x) / lens.factor);
  const y = Math.floor((at.y - lens.y) / lens.factor);
  if (x < 0 || y < 0 || x >= a.width || y >= a.height) return;
  const color = from => [...from.getContext('2d').getImageData(x, y, 1, 1).data.slice(0, 3)].join(' ');
  pixel.textContent = `column ${x}, row ${y}: ${viewed.dataset.left} ${color(a)} | ${viewed.dataset.right} ${color(b)}`;
});

function step(by) {
  const open = [...body.rows, ...tiles.rows].filter(row => !row.hidden && row.querySelector('img'));
  const next = open[open.indexOf(viewed) + by];
  if (next) view(next);
}

function viewHash() {
  const name = decodeURIComponent(location.hash.slice(1));
  const row = name && rows.find(row => row.dataset.name === name);
  if (row && row.querySelector('img')) view(row);
}

document.querySelector('.wide').addEventListener('click', event => {
  const button = event.target.closest('.pictures button');
  if (button) view(button.closest('tr'), button.dataset.open);
});
modes.forEach(button => button.addEventListener('click', () => view(viewed, button.dataset.mode)));
zoom.addEventListener('change', () => view(viewed));
dialog.querySelector('#close').addEventListener('click', () => dialog.close());
dialog.querySelector('#next').addEventListener('click', () => step(1));
dialog.querySelector('#previous').addEventListener('click', () => step(-1));
dialog.addEventListener('close', () => {
  clearInterval(flicker);
  history.replaceState(null, '', location.pathname + location.search);
});
dialog.addEventListener('keydown', event => {
  if (event.target.matches('input, select')) return;
  const by = { ArrowRight: 1, ArrowLeft: -1, j: 1, k: -1 }[event.key];
  const named = { 1: 'beside', 2: 'slider', 3: 'flicker', 4: 'difference' }[event.key];
  const larger = { '+': Math.SQRT2, '-': Math.SQRT1_2 }[event.key];
  if (by) step(by);
  if (named) view(viewed, named);
  if (larger && windows[0]) magnify(lens.factor * larger, windows[0].clientWidth / 2, windows[0].clientHeight / 2);
});
addEventListener('hashchange', viewHash);

// The heads of the columns stay below the bar.
const bar = document.querySelector('.bar');
new ResizeObserver(() => {
  const height = getComputedStyle(bar).position === 'sticky' ? bar.offsetHeight : 0;
  document.documentElement.style.setProperty('--bar', `${height}px`);
}).observe(bar);
arrange();
choose();
viewHash();
