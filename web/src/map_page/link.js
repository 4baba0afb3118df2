// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The view as part of the address: #face=12&show=area&eye=0,0,1&... Unknown words are ignored.

const kPause = 250;  // ms after the last change

const rounded = (values) => values.map((x) => Number(x.toPrecision(5)))
    .map((x) => (Math.abs(x) < 1e-7 ? 0 : x)).join(',');

function numbersOf(text, length) {
  const numbers = (text ?? '').split(',').map(Number);
  return numbers.length === length && numbers.every(Number.isFinite) ? numbers : null;
}

function addressOf(app) {
  const {state, surface, layout} = app;
  const words = new Map();
  if (state.pinned) {
    words.set('face', state.pinned.face);
    if (state.pinned.xi.some((x) => Math.abs(x - 1 / 3) > 1e-6))
      words.set('at', rounded(state.pinned.xi.slice(0, 2)));
  }
  if (state.show !== app.firstShown) words.set('show', state.show);
  if (state.texture !== 'checker' && state.texture !== 'image') words.set('texture', state.texture);
  if (state.brush) words.set('brush', rounded(state.brush));
  if (state.wipe > 0) words.set('straight', state.wipe);
  if (state.frame !== null) words.set('frame', state.frame);
  if (surface.wasMoved()) words.set('eye', rounded(surface.pose()));
  if (layout.wasMoved()) words.set('layout', rounded(layout.pose()));
  return [...words].map(([name, value]) => `${name}=${value}`).join('&');
}

function follow(app) {
  const {state, map} = app;
  const words = new Map(location.hash.slice(1).split('&').map((word) => word.split('=')));
  const changes = {};
  const face = Number(words.get('face') ?? NaN);
  if (Number.isInteger(face) && face >= 0 && face < map.faceCount) {
    const [a, b] = numbersOf(words.get('at'), 2) ?? [1 / 3, 1 / 3];
    changes.pinned = {face, xi: [a, b, 1 - a - b]};
  }
  if (app.titles[words.get('show')]) changes.show = words.get('show');
  if (words.get('texture') === 'grid') changes.texture = 'grid';
  const brush = numbersOf(words.get('brush'), 2);
  if (brush && brush[0] < brush[1]) changes.brush = brush;
  const wipe = Number(words.get('straight') ?? NaN);
  if (wipe >= 0 && wipe <= 1) changes.wipe = wipe;
  const frame = Number(words.get('frame') ?? NaN);
  if (map.snapshots[frame]) changes.frame = frame;
  state.set(changes);
  const eye = numbersOf(words.get('eye'), 7);
  if (eye) app.surface.setPose(eye);
  else if (changes.pinned) app.surface.turnTo(changes.pinned);
  const layout = numbersOf(words.get('layout'), 3);
  if (layout) app.layout.setPose(layout);
}

export function keepAddress(app) {
  let timer = null;
  const write = () => {
    const address = addressOf(app);
    if (`#${address}` === location.hash || (!address && !location.hash)) return;
    history.replaceState(null, '', `#${address}`);
  };
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(write, kPause);
  };
  follow(app);
  window.addEventListener('hashchange', () => follow(app));
  app.state.watch(['pinned', 'show', 'texture', 'brush', 'wipe', 'frame'], later);
  for (const view of [app.surface, app.layout])
    view.controls.addEventListener('change', later);
}
