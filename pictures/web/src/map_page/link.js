// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Stores the view in the address: #face=12&show=area&eye=0,0,1&... Words with their initial values
// are left out, and unknown ones are ignored.

const kPause = 250;  // ms after the last change

const rounded = (values) => values.map((x) => Number(x.toPrecision(5)))
    .map((x) => (Math.abs(x) < 1e-7 ? 0 : x)).join(',');

function numbersOf(text, length) {
  const numbers = (text ?? '').split(',').map(Number);
  return numbers.length === length && numbers.every(Number.isFinite) ? numbers : null;
}

const flag = (text) => ({0: false, 1: true})[text];
const oneOf = (values) => (text) => (values.includes(text) ? text : undefined);
const within = (low, high) => (text) =>
    (Number(text) >= low && Number(text) <= high ? Number(text) : undefined);
const rising = (text) => {
  const pair = numbersOf(text, 2);
  return pair && pair[0] < pair[1] ? pair : undefined;
};

// Returns the words of switches: the key in the state, and the meanings of their texts; undefined:
// none.
function wordsOf({map, titles, toggles}) {
  // The last map is the result, which needs no word.
  const frameOf = (text) =>
      (map.snapshots[text] && Number(text) < map.snapshots.length - 1 ? Number(text) : undefined);
  const words = {
    show: {of: 'show', read: oneOf(Object.keys(titles))},
    texture: {of: 'texture', read: oneOf(['checker', 'grid', 'numbers'])},
    squares: {of: 'squares', read: (text) => within(-9, 9)(text) && Math.round(Number(text))},
    range: {of: 'range', read: rising},
    brush: {of: 'brush', read: rising},
    straight: {of: 'wipe', read: within(0, 1)},
    frame: {of: 'frame', read: frameOf},
    picture: {of: 'pictureScale', read: (text) => ({2: 2, 4: 4})[text]},
    transparent: {of: 'isTransparent', read: flag},
  };
  for (const name of toggles) words[name] = {of: name, read: flag};
  return words;
}

const textOf = (value) => {
  if (Array.isArray(value)) return rounded(value);
  return typeof value === 'boolean' ? Number(value) : value;
};

function addressOf(app) {
  const {state, surface, layout} = app;
  const texts = new Map();
  if (state.pinned) {
    texts.set('face', state.pinned.face);
    if (state.pinned.xi.some((x) => Math.abs(x - 1 / 3) > 1e-6))
      texts.set('at', rounded(state.pinned.xi.slice(0, 2)));
  }
  for (const [word, {of, read}] of Object.entries(wordsOf(app))) {
    const text = textOf(state[of]);
    if (state[of] !== state.defaults[of] && read(String(text)) !== undefined) texts.set(word, text);
  }
  if (surface.wasMoved()) texts.set('eye', rounded(surface.pose()));
  if (layout.wasMoved()) texts.set('layout', rounded(layout.pose()));
  return [...texts].map(([word, text]) => `${word}=${text}`).join('&');
}

function follow(app) {
  const {state, map} = app;
  const texts = new Map(location.hash.slice(1).split('&').map((word) => word.split('=')));
  const changes = {pinned: null};
  const face = Number(texts.get('face') ?? NaN);
  if (Number.isInteger(face) && face >= 0 && face < map.faceCount) {
    const [a, b] = numbersOf(texts.get('at'), 2) ?? [1 / 3, 1 / 3];
    changes.pinned = {face, xi: [a, b, 1 - a - b]};
  }
  for (const [word, {of, read}] of Object.entries(wordsOf(app)))
    changes[of] = (texts.has(word) ? read(texts.get(word)) : undefined) ?? state.defaults[of];
  state.set(changes);
  app.goHome();
  const eye = numbersOf(texts.get('eye'), 7);
  if (eye) app.surface.setPose(eye);
  else if (changes.pinned) app.surface.turnTo(changes.pinned);
  const layout = numbersOf(texts.get('layout'), 3);
  if (layout) app.layout.setPose(layout);
}

export function keepAddress(app) {
  let timer = null;
  const write = () => {
    const address = addressOf(app);
    if (`#${address}` === location.hash || (!address && !location.hash)) return;
    history.replaceState(null, '', location.href.split('#')[0] + (address && `#${address}`));
  };
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(write, kPause);
  };
  follow(app);
  window.addEventListener('hashchange', () => follow(app));
  app.state.watch(['pinned', ...Object.values(wordsOf(app)).map(({of}) => of)], later);
  for (const view of [app.surface, app.layout])
    view.controls.addEventListener('change', later);
}
