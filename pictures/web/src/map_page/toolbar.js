// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The controls above the views.

import {byId, choice, element} from './elements.js';
import {readable} from './numbers.js';
import {savePicture, sidesOf} from './picture.js';
import {checkerWidth} from './uniforms.js';

const labels = {
  'sigma-max': '\u03c3\u2081', 'sigma-min': '\u03c3\u2082', 'density': 'density',
  'difference': 'A \u2212 B', 'texture': 'texture', 'area': 'area', 'angle': 'angle', 'chart': 'charts',
  'deviation': 'angles',
};
const labelsOf = (map) => {
  if (map.isOfElements) return {...labels, chart: 'elements'};
  return map.isOfQuads ? {...labels, chart: 'patches'} : labels;
};
const names = {square: '0..1 square', rest: 'texture at rest'};
const namesOfQuads = {...names, seams: 'features', cones: 'irregular'};
const titles = {
  square: 'The unit square of texture coordinates',
  rest: 'The texture lies on the shape at rest and is bent with it',
  overlaps: 'Where the layout lies on itself, and edges that meet',
};

// Makes the controls of what is shown on the map.
export function makeChoices({state, map, titles}) {
  choice(byId('show'), Object.keys(titles).map((name) => [
    name, labelsOf(map)[name], titles[name]]),
         state, 'show', (name) => state.set({show: name, brush: null, range: null}));
}

function addToggles({state, map, toggles}) {
  for (const name of toggles) {
    const button = element('button', {
      type: 'button', title: titles[name], onclick: () => state.set({[name]: !state[name]}),
    }, (map.isOfQuads ? namesOfQuads : names)[name] ?? name);
    state.watch([name], () => button.setAttribute('aria-pressed', state[name]));
    byId('toggles').append(button);
  }
}

function addTextures({state, map}) {
  choice(byId('texture'), [['checker', 'checker'], ['grid', 'grid'], ['numbers', 'numbers'],
                           ['image', 'image\u2026']],
         state, 'texture', (texture) => {
           if (texture === 'image') byId('image-file').click();
           else state.set({texture});
         });
  const width = element('output', {});
  const step = (label, way, title) => element('button', {
    'type': 'button', title, 'aria-label': title,
    'onclick': () => state.set({squares: Math.min(9, Math.max(-9, state.squares + way))}),
  }, label);
  byId('squares').append(step('\u2212', -1, 'Smaller squares'), width,
                         step('+', 1, 'Larger squares'));
  state.watch(['squares'], () => {
    width.textContent = readable(checkerWidth(map.uvBounds, state.squares));
  });
  state.watch(['show', 'texture'], () => {
    byId('texture').hidden = state.show !== 'texture';
    byId('squares').hidden =
        state.show !== 'texture' || !['checker', 'grid'].includes(state.texture);
  });
}

function addSlider({state, map, other}) {
  byId('wipe').parentElement.hidden = Math.max(map.degree, other?.degree ?? 1) === 1;
  byId('wipe').addEventListener('input', () => state.set({wipe: byId('wipe').value / 100}));
  state.watch(['wipe'], () => {
    byId('wipe').value = 100 * state.wipe;
    for (const line of document.querySelectorAll('.wipe')) {
      line.hidden = state.wipe === 0;
      line.style.left = `${100 * state.wipe}%`;
      line.replaceChildren(...sidesOf(map).map((name) => element('b', {}, name)));
    }
  });
}

function addPictures(app) {
  const {state} = app;
  byId('save').addEventListener('click', () => savePicture(app));
  const size = byId('save-size'), paper = byId('save-transparent');
  size.addEventListener('change', () => state.set({pictureScale: Number(size.value)}));
  paper.addEventListener('change', () => state.set({isTransparent: paper.checked}));
  state.watch(['pictureScale', 'isTransparent'], () => {
    size.value = state.pictureScale;
    paper.checked = state.isTransparent;
  });
}

// Makes the tools that need pictures.
export function makeViewTools(app) {
  addTextures(app);
  addSlider(app);
  addToggles(app);
  addPictures(app);
  byId('home').addEventListener('click', () => {
    app.state.set(app.state.defaults);
    app.goHome();
  });
}
