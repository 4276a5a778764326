'use strict';
// The filter, and the viewer: a click on a picture shows it large; arrow keys go on, Escape closes.
const figures = [...document.querySelectorAll('figure[id]')];
const filter = document.querySelector('#filter');
const dialog = document.querySelector('dialog');
const part = name => dialog.querySelector(name);
let viewed = null;

function shown() {
  return figures.filter(figure => !figure.hidden && figure.querySelector('img'));
}

function choose() {
  const words = filter.value.toLowerCase().split(/\s+/).filter(word => word);
  for (const figure of figures) {
    const text = figure.textContent.toLowerCase();
    figure.hidden = !words.every(word => text.includes(word));
  }
  for (const group of document.querySelectorAll('section.group')) {
    group.hidden = !group.querySelector('figure:not([hidden])');
  }
  document.querySelector('#shown').textContent = `${figures.filter(figure => !figure.hidden).length} of ${figures.length}`;
}

function view(figure) {
  viewed = figure;
  const all = shown();
  const images = [...figure.querySelectorAll('img')].map(image => Object.assign(new Image(), { src: image.src, alt: image.alt }));
  part('.stage').replaceChildren(...images);
  part('h2').textContent = `${figure.querySelector('figcaption b').textContent}  (${all.indexOf(figure) + 1} of ${all.length})`;
  const more = figure.querySelector('figcaption').cloneNode(true);
  more.querySelector('b').remove();
  part('footer').replaceChildren(...more.childNodes);
  history.replaceState(null, '', `#${encodeURIComponent(figure.id)}`);
  if (!dialog.open) dialog.showModal();
}

/** Takes the picture out of the address. */
function leave() {
  history.replaceState(null, '', location.pathname + location.search);
}

function step(by) {
  const all = shown();
  const next = all[all.indexOf(viewed) + by];
  if (next) view(next);
}

/** The figure that a part of an address names. */
function figureOf(hash) {
  const id = hash.slice(1);
  try {
    return document.getElementById(decodeURIComponent(id));
  } catch {
    return document.getElementById(id);
  }
}

function viewHash() {
  const figure = figureOf(location.hash);
  if (figure && figure.querySelector('img')) view(figure);
}

document.addEventListener('click', event => {
  const link = event.target.closest('a.shot');
  if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  view(link.closest('figure') || figureOf(link.hash));
});
dialog.addEventListener('keydown', event => {
  const by = { ArrowRight: 1, ArrowDown: 1, j: 1, ArrowLeft: -1, ArrowUp: -1, k: -1 }[event.key];
  if (by) { event.preventDefault(); step(by); }
});
part('#next').addEventListener('click', () => step(1));
part('#previous').addEventListener('click', () => step(-1));
part('#close').addEventListener('click', () => { dialog.close(); leave(); });
dialog.addEventListener('close', leave);
if (filter) {
  filter.addEventListener('input', choose);
  choose();
}
addEventListener('hashchange', viewHash);
viewHash();
const when = document.querySelector('#when');
if (when) when.textContent = new Date(document.lastModified).toLocaleString();
