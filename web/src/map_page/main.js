// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The page: its parts, and what they share (`app`).

import {RepeatWrapping, Texture} from 'three';

import {byId, choice, element} from './elements.js';
import {parseEnergy} from './energies.js';
import {listFaults, listOverlaps, writeFacts} from './facts.js';
import {showWithoutWebGl} from './fallback.js';
import {Film} from './film.js';
import {Histogram} from './histogram.js';
import {followKeys} from './keyboard.js';
import {LayoutView} from './layout_view.js';
import {keepAddress} from './link.js';
import {readMap} from './map_data.js';
import {Marks, themeColor} from './marks.js';
import {pictureOf, savePicture, sidesOf} from './picture.js';
import {followPointer} from './pointer.js';
import {Readout, measure} from './readout.js';
import {Scale} from './scales.js';
import {Stage, flatGeometry} from './stage.js';
import {State} from './state.js';
import {SurfaceView} from './surface_view.js';
import {fillControl} from './textures.js';
import {makeUniforms} from './uniforms.js';

const symbols = {
  'sigma-max': '\u03c3\u2081', 'sigma-min': '\u03c3\u2082', 'area': '\u03c3\u2081\u03c3\u2082',
  'angle': '\u03c3\u2081/\u03c3\u2082', 'density': 'density',
};
const labels = {...symbols, texture: 'texture', area: 'area', angle: 'angle', chart: 'charts'};

function titlesOf(map, scales) {
  const known = {
    'density': `Density of ${map.claims.energy}`,
    'area': 'Area distortion \u03c3\u2081\u03c3\u2082',
    'angle': 'Angle distortion \u03c3\u2081/\u03c3\u2082',
    'sigma-max': 'Larger singular value \u03c3\u2081',
    'sigma-min': 'Smaller singular value \u03c3\u2082',
  };
  const titles = {texture: 'Texture'};
  for (const name of Object.keys(scales)) titles[name] = known[name];
  if (map.chart) titles.chart = 'Charts';
  return titles;
}

function makeApp() {
  const data = JSON.parse(byId('data').textContent);
  const map = readMap(data);
  const scales = Object.fromEntries(data.scales.map((scale) => [scale.name, new Scale(scale)]));
  const state = new State({
    show: data.scales.some(({name}) => name === data.show) ? data.show : 'texture', texture: 'checker', wipe: 0, edges: true, seams: true, cones: true,
    points: true, scaffold: true, faults: true, overlaps: map.cones.length === 0, brush: null, hovered: null, pinned: null,
    frame: null, theme: 0,
  });
  return {
    map, scales, state, symbols, energy: parseEnergy(map.claims.energy), uv: map.uv,
    titles: titlesOf(map, scales), firstShown: state.show,
    css: (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim(),
  };
}

function makeToolbar({state, titles}) {
  choice(byId('show'), Object.keys(titles).map((name) => [name, labels[name], titles[name]]),
         state, 'show', (name) => state.set({show: name, brush: null}));
}

// What only makes sense where there are pictures.
function makeViewTools(app) {
  const {state, marks} = app;
  choice(byId('texture'), [['checker', 'checker'], ['grid', 'grid'], ['image', 'image\u2026']],
         state, 'texture', (texture) => {
           if (texture === 'image') byId('image-file').click();
           else state.set({texture});
         });
  state.watch(['show'], () => { byId('texture').hidden = state.show !== 'texture'; });
  byId('wipe').addEventListener('input', () => state.set({wipe: byId('wipe').value / 100}));
  const toggles = [['edges', 'edges'], ['seams', 'seams'], ['cones', 'cones'],
                   ['points', 'points'], ['scaffold', 'scaffold'], ['overlaps', 'overlaps'], ['faults', 'faults']];
  for (const [name, label] of toggles) {
    if (name !== 'edges' && !marks.has[name]) continue;
    const button = element('button', {
      type: 'button', onclick: () => state.set({[name]: !state[name]}),
    }, label);
    state.watch([name], () => button.setAttribute('aria-pressed', state[name]));
    byId('toggles').append(button);
  }
  byId('home').addEventListener('click', () => app.goHome());
  byId('save').addEventListener('click', () => savePicture(app));
}

// An image from the disk, by the button or dropped anywhere.
function takeImages(app) {
  const {state, uniforms, stage} = app;
  const input = byId('image-file');
  const take = async (file) => {
    if (!file) return;
    try {
      const image = new Texture(await createImageBitmap(file, {imageOrientation: 'flipY'}));
      image.flipY = false;
      image.wrapS = image.wrapT = RepeatWrapping;
      image.anisotropy = 8;
      image.needsUpdate = true;
      uniforms.uImage.value?.dispose();
      uniforms.uImage.value = image;
      state.set({show: 'texture', texture: 'image'});
      stage.request();
      byId('notice').hidden = true;
    } catch {
      byId('notice').textContent = `${file.name} is no image that this browser reads.`;
      byId('notice').hidden = false;
    }
  };
  input.addEventListener('change', () => take(input.files[0]));
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    take(event.dataTransfer.files[0]);
  });
}

// State to uniforms.
function drawState(app) {
  const {state, uniforms, map, stage} = app;
  const redraw = (names, change) => state.watch(names, () => {
    change();
    stage.request();
  });
  redraw(['show', 'texture'], () => {
    const scale = app.scales[state.show];
    app.picture = {name: state.show === 'chart' ? 'chart' : state.texture};
    if (!scale) return;
    app.picture = {name: 'heat', quantity: state.show};
    uniforms.uScale.value = scale.uniform;
    uniforms.uUnit.value = scale.unit;
    uniforms.uColors.value.image.data.forEach((_, k, bytes) => {
      bytes[k] = k % 4 === 3 ? 255 : scale.bytes[3 * Math.floor(k / 4) + (k % 4)];
    });
    uniforms.uColors.value.needsUpdate = true;
  });
  redraw(['brush'], () => { uniforms.uBrush.value = state.brush ?? [0, 1]; });
  redraw(['wipe'], () => {
    byId('wipe').value = 100 * state.wipe;
    for (const line of document.querySelectorAll('.wipe')) {
      line.hidden = state.wipe === 0;
      line.style.left = `${100 * state.wipe}%`;
      line.replaceChildren(...sidesOf(map).map((name) => element('b', {}, name)));
    }
  });
  redraw(['edges'], () => { uniforms.uEdges.value = state.edges ? 0.3 : 0; });
  redraw(['faults'], () => { uniforms.uFaultsShown.value = state.faults; });
  redraw(['scaffold'], () => {});
  redraw(['hovered', 'pinned'], () => {
    uniforms.uHovered.value = state.hovered?.face ?? -1;
    uniforms.uPinned.value = state.pinned?.face ?? -1;
  });
  redraw(['frame'], () => {
    const uv = map.snapshots[state.frame]?.uv ?? map.uv;
    if (uv === app.uv) return;
    app.uv = uv;
    fillControl(uniforms.uControl.value, map, map.uvBounds, uv);
  });
  redraw(['theme'], () => {
    for (const [name, color] of [['uAccent', '--accent'], ['uPaper', '--back'], ['uInk', '--ink']])
      uniforms[name].value = themeColor(color);
  });
}

function addViews(app) {
  const {state} = app;
  app.faulty = new Set(app.map.faults.map(({face}) => face));
  Object.assign(app, makeUniforms(app), {flatCells: flatGeometry(app.map.faceCount, app.faulty)});
  app.stage = new Stage(byId('canvas'));
  app.surface = new SurfaceView(app.stage, byId('surface'), app);
  app.layout = new LayoutView(app.stage, byId('layout'), app);
  app.goHome = () => {
    app.surface.setPose(app.surface.homePose);
    app.layout.setPose(app.layout.homePose);
  };
  app.focusOn = (place) => {
    state.set({pinned: place});
    for (const view of [app.surface, app.layout]) view.focusOn(place);
  };
  drawState(app);
  app.marks = new Marks(app);
  makeViewTools(app);
  takeImages(app);
  new Film(app);
  followPointer(app);
  followKeys(app);
  keepAddress(app);
  new ResizeObserver(() => app.stage.resize()).observe(byId('stage'));
}

// For tests and scripts; docs/pictures.md says how it is used.
function exposeApp(app) {
  window.majorantPage = {
    app,
    measure: (face, xi) => measure(app, {face, xi}),
    readPass: (view, mode, width, height) => app.stage.readPass(app[view], mode, width, height),
    picture: () => pictureOf(app).toDataURL(),
  };
}

function start() {
  const app = makeApp();
  matchMedia('(prefers-color-scheme: dark)').addEventListener(
      'change', () => app.state.set({theme: app.state.theme + 1}));
  writeFacts(app);
  const hasWebGl = document.createElement('canvas').getContext('webgl2') !== null;
  if (!hasWebGl) {
    delete app.titles.texture;
    app.state.show = Object.keys(app.titles)[0];
    app.focusOn = (place) => app.state.set({pinned: place});
  }
  makeToolbar(app);
  if (hasWebGl) addViews(app);
  else showWithoutWebGl(app);
  new Histogram(app);
  new Readout(app);
  listFaults(app);
  listOverlaps(app);
  exposeApp(app);
}

start();
