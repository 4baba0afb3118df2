// The page: its parts, and what they share.

import {parseEnergy} from './energies.js';
import {LayoutView} from './layout_view.js';
import {readMap} from './map_data.js';
import {rgbOf, tints} from './marks.js';
import {modes} from './shaders.js';
import {Stage} from './stage.js';
import {SurfaceView} from './surface_view.js';
import * as textures from './textures.js';

const byId = (id) => document.getElementById(id);

// A number of cells along the layout so that one is 1, 2 or 5 times a power of ten wide.
function checkerCells({size, center}, scale) {
  const wanted = size / 24;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const width = power * ([1, 2, 5].find((digit) => digit * power >= wanted) ?? 10);
  return [size / width, ...center.map((c) => (c / width) % 2)];
}

function sharedOf(map) {
  const energy = parseEnergy(map.claims.energy);
  const radius = 0.5 * Math.hypot(...map.bounds.high.map((x, d) => x - map.bounds.low[d]));
  const surfaceFrame = {center: map.bounds.center, radius};
  const inFrame = (corner) => [0, 1, 2].map(
      (d) => (map.positions[3 * corner + d] - surfaceFrame.center[d]) / surfaceFrame.radius);
  const tintBytes = Uint8Array.from(tints.flatMap((hex) => rgbOf(hex).map((x) => 255 * x)));
  const uniforms = {
    uControl: {value: textures.controlTexture(map, map.uvBounds)},
    uCorner: {value: textures.cornerTexture(map, inFrame)},
    uNormal: {value: textures.cornerTexture(map, textures.smoothNormals(map))},
    uRest: {value: textures.restTexture(map)},
    uFace: {value: textures.faceTexture(map, tints.length)},
    uTints: {value: textures.colorTexture(tintBytes, textures.nearest)},
    uColors: {value: textures.colorTexture(new Uint8Array(768))},
    uImage: {value: null},
    uMode: {value: modes.checker},
    uQuantity: {value: 1},
    uHovered: {value: -1},
    uPinned: {value: -1},
    uScale: {value: [0, 0, 1, 0]},
    uUnit: {value: 1},
    uBrush: {value: [0, 1]},
    uChecker: {value: checkerCells(map.uvBounds, map.scale)},
    uAccent: {value: [0, 0.45, 0.7]},
    uFlipped: {value: [0.84, 0, 0.75]},
    uFault: {value: [0.84, 0, 0.75]},
    uEdges: {value: 0.3},
    uEye: {value: [0, 0, 1]},
    uPixel: {value: 1},
    uRim: {value: [1, 1, 1]},
    uPaper: {value: [1, 1, 1]},
    uInk: {value: [0, 0, 0]},
  };
  const scaffoldControl =
      map.scaffold ? textures.controlTexture(map.scaffold, map.uvBounds) : null;
  return {map, energy, surfaceFrame, uniforms, scaffoldControl, uv: map.uv, wipe: 0};
}

function start() {
  const map = readMap(JSON.parse(byId('data').textContent));
  const shared = sharedOf(map);
  const stage = new Stage(byId('canvas'));
  const surface = new SurfaceView(stage, byId('surface'), shared);
  const layout = new LayoutView(stage, byId('layout'), shared);
  byId('wipe').addEventListener('input', (event) => {
    shared.wipe = event.target.value / 100;
    stage.request();
  });
  new ResizeObserver(() => stage.resize()).observe(byId('stage'));
  window.majorantPage = {
    map, stage, surface, layout,
    readPass: (view, mode, width, height) => stage.readPass({surface, layout}[view], mode, width, height),
  };
  stage.resize();
}

start();
