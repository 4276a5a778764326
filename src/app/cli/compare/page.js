'use strict';
const table = document.querySelector('.scenes');
const body = table.tBodies[0];
const rows = [...body.rows];
const search = document.querySelector('#search');
const order = document.querySelector('#order');
const chips = [...document.querySelectorAll('.chip')];
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

function colored(image) {
  const canvas = canvasOf(image);
  const context = canvas.getContext('2d', { willReadFrequently: true });
  const data = context.getImageData(0, 0, canvas.width, canvas.height);
  for (let i = 0; i < data.data.length; i += 4) {
    const [r, g, b] = COLORS[data.data[i]];
    data.data[i] = r; data.data[i + 1] = g; data.data[i + 2] = b; data.data[i + 3] = 255;
  }
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
      const canvas = colored(target);
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
  body.append(...rows);
  for (const head of heads) {
    if (head.dataset.key === key) head.setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
    else head.removeAttribute('aria-sort');
  }
  const option = [...order.options].find(option => option.value === `${key}${ascending ? '+' : '-'}`);
  order.value = option ? option.value : '';
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

function figure(title, canvas, factor) {
  const figure = document.createElement('figure');
  const caption = document.createElement('figcaption');
  caption.textContent = title;
  canvas.style.width = `${canvas.width * factor}px`;
  const holder = document.createElement('div');
  holder.style.position = 'relative';
  holder.append(canvas);
  figure.append(caption, holder);
  stage.append(figure);
  return { caption, holder };
}

function over(holder, canvas, factor) {
  canvas.style.width = `${canvas.width * factor}px`;
  canvas.className = 'over';
  holder.append(canvas);
}

async function view(row, wanted) {
  viewed = row;
  if (wanted) mode = wanted;
  clearInterval(flicker);
  stage.replaceChildren();
  pixel.textContent = '';
  dialog.querySelector('h2').textContent = row.dataset.name;
  dialog.querySelector('#numbers').textContent = row.dataset.numbers;
  modes.forEach(button => button.setAttribute('aria-pressed', String(button.dataset.mode === mode)));
  if (!dialog.open) dialog.showModal();
  const images = [...row.querySelectorAll('img')];
  // Pictures far down the page are read when they are first needed.
  images.forEach(image => { image.loading = 'eager'; });
  const unread = images.filter(image => !image.complete);
  if (unread.length) await Promise.all(unread.map(image => image.decode().catch(() => {})));
  const named = name => images.find(image => image.classList.contains(name));
  const [theirs, ours, steps] = ['theirs', 'ours', 'steps'].map(named);
  const first = theirs || ours;
  if (!first || viewed !== row) return;
  const across = mode === 'beside' ? 2 : 1;
  const room = [(stage.clientWidth - 24) / across - 8, stage.clientHeight - 48];
  const fit = Math.min(room[0] / first.naturalWidth, room[1] / first.naturalHeight);
  const factor = zoom.value === 'fit' ? (fit >= 1 ? Math.floor(fit) : fit) : Number(zoom.value);
  slide.hidden = mode !== 'slider' || !ours || !theirs;
  const [a, b] = [theirs, ours].map(image => image && canvasOf(image));
  if (mode === 'difference' && steps) {
    const { holder } = figure('Difference: the most different channel', colored(steps), factor);
    if (row.dataset.x) {
      const mark = document.createElement('div');
      mark.className = 'mark';
      mark.title = 'the largest difference';
      mark.style.left = `${(Number(row.dataset.x) + 0.5) * factor}px`;
      mark.style.top = `${(Number(row.dataset.y) + 0.5) * factor}px`;
      holder.append(mark);
    }
  } else if (mode === 'beside' || !a || !b) {
    if (a) figure(row.dataset.left, a, factor);
    if (b) figure(row.dataset.right, b, factor);
  } else {
    const { caption, holder } = figure('', a, factor);
    over(holder, b, factor);
    if (mode === 'slider') {
      const set = () => {
        b.style.clipPath = `inset(0 0 0 ${slide.value}%)`;
        caption.textContent = `left ${row.dataset.left}, right ${row.dataset.right}`;
      };
      slide.oninput = set;
      set();
    } else {
      const swap = () => {
        b.hidden = !b.hidden;
        caption.textContent = b.hidden ? row.dataset.left : row.dataset.right;
      };
      swap();
      flicker = setInterval(swap, 600);
    }
  }
  stage.onpointermove = event => {
    const canvas = event.target.closest('canvas');
    if (!canvas || !a || !b) return;
    const box = canvas.getBoundingClientRect();
    const x = Math.floor((event.clientX - box.left) / box.width * canvas.width);
    const y = Math.floor((event.clientY - box.top) / box.height * canvas.height);
    if (x < 0 || y < 0 || x >= canvas.width || y >= canvas.height) return;
    const at = from => [...from.getContext('2d').getImageData(x, y, 1, 1).data.slice(0, 3)].join(' ');
    pixel.textContent = `column ${x}, row ${y}: ${row.dataset.left} ${at(a)} | ${row.dataset.right} ${at(b)}`;
  };
}

function step(by) {
  const open = rows.filter(row => !row.hidden && row.querySelector('img'));
  const next = open[open.indexOf(viewed) + by];
  if (next) view(next);
}

body.addEventListener('click', event => {
  const button = event.target.closest('.pictures button');
  if (button) view(button.closest('tr'), button.dataset.open);
});
modes.forEach(button => button.addEventListener('click', () => view(viewed, button.dataset.mode)));
zoom.addEventListener('change', () => view(viewed));
dialog.querySelector('#close').addEventListener('click', () => dialog.close());
dialog.querySelector('#next').addEventListener('click', () => step(1));
dialog.querySelector('#previous').addEventListener('click', () => step(-1));
dialog.addEventListener('close', () => clearInterval(flicker));
dialog.addEventListener('keydown', event => {
  if (event.target.matches('input, select')) return;
  const by = { ArrowRight: 1, ArrowLeft: -1, j: 1, k: -1 }[event.key];
  const named = { 1: 'beside', 2: 'slider', 3: 'flicker', 4: 'difference' }[event.key];
  if (by) step(by);
  if (named) view(viewed, named);
});
choose();
