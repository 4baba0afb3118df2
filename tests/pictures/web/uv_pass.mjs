// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// uv_pass.mjs [PAGE...] COUNT: reads fragments of the surface back at random views. Answers for
// each page {frame, fragments: [{face, xi, uv, pixel, camera}], surprises, requests}.
import {answer, visitEach} from './visit.mjs';

const [pages, count] = process.argv.slice(2).map((text) => JSON.parse(text));
const size = 400;

// Runs in the page. Random numbers have a fixed seed, so that views are the same every time.
function readViews({count, size, seed}) {
  const {app, readPass} = window.majorantPage;
  let state = seed;
  const random = () => {
    state = (state * 1664525 + 1013904223) % 4294967296;
    return state / 4294967296;
  };
  const views = 4;
  const fragments = [];
  for (let v = 0; v < views; ++v) {
    const [z, t] = [2 * random() - 1, 2 * Math.PI * random()];
    const r = Math.sqrt(1 - z * z);
    app.surface.setPose([r * Math.cos(t), r * Math.sin(t), z, 0.2 * random(), 0.2 * random(), 0,
                         1 + 3 * random()]);
    const [uv, face, bary] = ['uvPass', 'facePass', 'baryPass'].map(
        (mode) => readPass('surface', mode, size, size));
    const camera = app.surface.uniforms.uCamera.value.toArray();
    const drawn = [];
    for (let p = 0; p < size * size; ++p)
      if (face[4 * p + 3] > 0 && face[4 * p] + face[4 * p + 1] + face[4 * p + 2] > 0) drawn.push(p);
    if (drawn.length < size) throw new Error(`view ${v} shows ${drawn.length} pixels`);
    const pair = (bytes, p) => [(256 * bytes[4 * p] + bytes[4 * p + 1]) / 65535,
                                (256 * bytes[4 * p + 2] + bytes[4 * p + 3]) / 65535];
    for (let k = 0; k < count / views; ++k) {
      const p = drawn[Math.floor(random() * drawn.length)];
      fragments.push({
        face: 65536 * face[4 * p] + 256 * face[4 * p + 1] + face[4 * p + 2] - 1,
        uv: pair(uv, p), xi: pair(bary, p), camera,
        device: [2 * (p % size + 0.5) / size - 1, 2 * (Math.floor(p / size) + 0.5) / size - 1],
      });
    }
  }
  const {center, size: extent} = app.map.uvBounds;
  return {fragments, uvFrame: {center, size: extent},
          surfaceFrame: {...app.shared?.surfaceFrame ?? app.surface.shared.surfaceFrame}};
}

let seed = 0;
answer(await visitEach(pages, {width: 700, height: 400},
                       (page) => page.evaluate(readViews, {count, size, seed: ++seed})));
