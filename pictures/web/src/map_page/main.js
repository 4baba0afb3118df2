// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The page: its parts, and the data that they share (`app`).

import {byId} from './elements.js';
import {parseEnergy} from './energies.js';
import {listFaults, listOverlaps, writeFacts} from './facts.js';
import {showWithoutWebGl} from './fallback.js';
import {Film} from './film.js';
import {addHelp} from './help.js';
import {Histogram} from './histogram.js';
import {numberedSquares, takeImages} from './images.js';
import {followKeys} from './keyboard.js';
import {LayoutView} from './layout_view.js';
import {Legend} from './legend.js';
import {keepAddress} from './link.js';
import {readMap} from './map_data.js';
import {Marks, themeColor} from './marks.js';
import {differenceScale, link, makeRoom} from './pair.js';
import {partnerOf} from './partner.js';
import {pictureOf} from './picture.js';
import {addSearch, facesOfChart, listCharts} from './places.js';
import {followPointer} from './pointer.js';
import {deviationScale, measureQuads} from './quads.js';
import {Readout, measure} from './readout.js';
import {Scale} from './scales.js';
import {Stage, flatGeometry} from './stage.js';
import {State} from './state.js';
import {SurfaceView} from './surface_view.js';
import {fillControl} from './textures.js';
import {makeChoices, makeViewTools} from './toolbar.js';
import {checkerFrame, checkerWidth, makeUniforms} from './uniforms.js';

const symbols = {
  'sigma-max': '\u03c3\u2081', 'sigma-min': '\u03c3\u2082', 'area': '\u03c3\u2081\u03c3\u2082',
  'angle': '\u03c3\u2081/\u03c3\u2082', 'density': 'density',
};

function titlesOf(map, scales) {
  const known = {
    'density': `Density of ${map.claims.energy}`,
    'area': 'Area distortion \u03c3\u2081\u03c3\u2082',
    'angle': 'Angle distortion \u03c3\u2081/\u03c3\u2082',
    'sigma-max': 'Larger singular value \u03c3\u2081',
    'sigma-min': 'Smaller singular value \u03c3\u2082',
    'difference': `Density of ${map.claims.energy}, A less B`,
  };
  // elements have no distortion
  if (map.isOfElements) return {chart: 'Elements', texture: 'Texture'};
  if (map.isOfQuads) {
    const titles = {deviation: 'Largest angle off 90\u00b0', texture: 'Texture'};
    if (map.chart) titles.chart = 'Patches';
    return titles;
  }
  const titles = {texture: 'Texture'};
  for (const name of Object.keys(scales)) titles[name] = known[name];
  if (map.chart) titles.chart = 'Charts';
  return titles;
}

function makeApp() {
  const data = JSON.parse(byId('data').textContent);
  const map = readMap(data);
  const ofMaps = Object.fromEntries(data.scales.map((scale) => [scale.name, new Scale(scale)]));
  const scales = map.isOfQuads ? {deviation: deviationScale(ofMaps.angle)} : ofMaps;
  if (map.isOfQuads) map.quads = measureQuads(map);
  const energy = parseEnergy(map.claims.energy);
  const other = data.other ? readMap(data.other) : null;
  if (other && scales.density)
    scales.difference = differenceScale(map, other, energy, scales.area);
  const isDeformation = map.claims.init === 'planar';
  const state = new State({
    show: map.isOfElements ? 'chart' : map.isOfQuads ? 'deviation'
        : scales[data.show] ? data.show
        : scales.difference ? 'density' : 'texture',
    texture: 'checker', squares: 0, rest: isDeformation, wipe: 0, range: null, brush: null,
    edges: true, seams: true, cones: true, points: true, scaffold: true, faults: true,
    overlaps: map.cones.length === 0, square: map.isInSquare && !map.isOfElements && !map.isOfQuads,
    hovered: null, pinned: null, frame: null, pictureScale: 1, isTransparent: false, theme: 0,
  });
  return {
    map, other, scales, state, symbols, isDeformation, energy, uv: map.uv,
    titles: titlesOf(map, scales),
    // Returns the scale of the shown quantity, with the chosen ends.
    get scale() {
      const scale = scales[state.show];
      return scale && state.range && scale.takes(state.range) ? scale.withRange(...state.range)
                                                              : scale;
    },
    css: (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim(),
  };
}

// Copies the state to uniforms.
function drawState(app) {
  const {state, uniforms, map, stage} = app;
  const redraw = (names, change) => state.watch(names, () => {
    change();
    stage.request();
  });
  app.layImage = () => {
    app.numbers ??= numberedSquares();
    uniforms.uImage.value = state.texture === 'image' ? app.image : app.numbers;
  };
  redraw(['squares'], () => {
    uniforms.uChecker.value =
        checkerFrame(map.uvBounds, checkerWidth(map.uvBounds, state.squares));
  });
  redraw(['show', 'texture', 'range', 'rest'], () => {
    const {scale} = app;
    const isImage = ['image', 'numbers'].includes(state.texture);
    app.picture = {name: isImage ? 'image' : state.texture, isAtRest: state.rest};
    if (state.show === 'chart') app.picture = {name: 'chart'};
    if (state.show === 'texture' && isImage) app.layImage();
    if (!scale) return;
    app.picture = {name: 'heat', quantity: state.show};
    if (state.show === 'difference')
      app.picture.other = {degree: app.beside.map.degree, sign: app.side === 0 ? 1 : -1};
    uniforms.uScale.value = scale.uniform;
    uniforms.uUnit.value = scale.unit;
    uniforms.uColors.value.image.data.forEach((_, k, bytes) => {
      bytes[k] = k % 4 === 3 ? 255 : scale.bytes[3 * Math.floor(k / 4) + (k % 4)];
    });
    uniforms.uColors.value.needsUpdate = true;
  });
  redraw(['brush'], () => { uniforms.uBrush.value = state.brush ?? [0, 1]; });
  redraw(['edges'], () => { uniforms.uEdges.value = state.edges ? 0.3 : 0; });
  redraw(['faults'], () => { uniforms.uFaultsShown.value = state.faults; });
  redraw(['scaffold', 'wipe', 'overlaps'], () => {});
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

// Makes views, marks and uniforms of a map. ids: of the elements that show it.
function addSide(app, ids) {
  const {map, stage} = app;
  app.faulty = new Set(map.faults.map(({face}) => face));
  Object.assign(app, makeUniforms(app), {flatCells: flatGeometry(map.faceCount, app.faulty)});
  app.surface = new SurfaceView(stage, byId(ids[0]), app);
  app.layout = new LayoutView(stage, byId(ids[1]), app);
  app.views = [app.surface, app.layout];
  app.partnerOf = partnerOf(map);
}

// Adds the second map of a comparison. Missing data are taken from the first.
function addOther(app) {
  const {other: map} = app;
  makeRoom([app.map, map]);
  const side = Object.assign(Object.create(app), {map, uv: map.uv, side: 1, beside: app});
  Object.assign(app, {side: 0, beside: side});
  return side;
}

function addViews(app) {
  const {state, other} = app;
  app.stage = new Stage(byId('canvas'));
  const sides = other ? [app, addOther(app)] : [app];
  addSide(app, ['surface', 'layout']);
  if (other) {
    const {beside} = app;
    addSide(beside, ['surface-other', 'layout-other']);
    const lengthOf = ({map}) => map.uvBounds.size * map.scale;
    for (const side of sides) {
      side.uniforms.uOther.value = side.beside.uniforms.uControl.value;
      side.uniforms.uOtherFactor.value = lengthOf(side.beside) / lengthOf(side);
    }
    app.views.forEach((view, k) => link([view, beside.views[k]]));
  }
  const allViews = sides.flatMap(({views}) => views);
  app.goHome = () => allViews.forEach((view) => view.setPose(view.homePose));
  app.focusOn = (place) => {
    state.set({pinned: place});
    if (app.map.isOfElements)
      return app.showFaces(facesOfChart(app.map, app.map.chart[place.face]));
    for (const view of allViews) view.focusOn(place);
  };
  app.showFaces = (faces) => allViews.forEach((view) => view.showFaces(faces));
  for (const side of sides) {
    drawState(side);
    side.marks = new Marks(side);
  }
  app.toggles = ['edges', 'seams', 'cones', 'points', 'scaffold', 'square', 'rest', 'overlaps',
                 'faults'].filter((name) => sides.some(({marks}) => marks.has[name]));
  makeViewTools(app);
  takeImages(app);
  new Film(app);
  for (const side of sides) {
    followPointer(side);
    followKeys(side);
  }
  keepAddress(app);
  new ResizeObserver(() => app.stage.resize()).observe(byId('stage'));
}

// For tests and scripts; docs/pictures.md describes its use.
function exposeApp(app) {
  window.majorantPage = {
    app,
    measure: (face, xi) => measure(app, {face, xi}),
    measureOf: measure,
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
    app.state.set({show: Object.keys(app.titles)[0]});
    app.focusOn = (place) => app.state.set({pinned: place});
  }
  makeChoices(app);
  if (hasWebGl) addViews(app);
  else showWithoutWebGl(app);
  new Histogram(app);
  new Legend(app);
  new Readout(app);
  listFaults(app);
  listOverlaps(app);
  listCharts(app);
  addSearch(app);
  addHelp();
  exposeApp(app);
}

start();
