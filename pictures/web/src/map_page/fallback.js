// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Without WebGL2: draws the layout on a plain canvas, one colour a cell, and shows the numbers.

import {combine} from './bezier.js';
import {CellFinder} from './cell_finder.js';
import {byId} from './elements.js';
import {evaluate} from './map_data.js';
import {rgbOf, tints} from './marks.js';
import {sampleSingularValues} from './sampling.js';
import {valuesOf} from './scales.js';

const kEdgePieces = 6;
const kMargin = 12;  // CSS pixels

// Returns the boundary of a cell: corners and points between them.
function outlineOf(map, face) {
  const pieces = map.degree === 1 ? 1 : kEdgePieces;
  const points = [];
  for (let edge = 0; edge < 3; ++edge)
    for (let k = 0; k < pieces; ++k) {
      const xi = [0, 0, 0];
      xi[edge] = 1 - k / pieces;
      xi[(edge + 1) % 3] = k / pieces;
      points.push(combine(evaluate(map, face, xi), xi));
    }
  return points;
}

function colorsOf(app) {
  const {map, state} = app;
  const {scale} = app;
  if (!scale)
    return (face) => (map.chart ? tints[map.chart[face] % tints.length] : app.css('--press'));
  const {S, s} = sampleSingularValues(map, map.uv, [[1 / 3, 1 / 3, 1 / 3]]);
  if (map.isOfQuads) {
    return (face) => scale.color(scale.position(map.quads[Math.floor(face / 2)].deviation));
  }
  const value = valuesOf[state.show];
  return (face) => (s[face] > 0 ? scale.color(scale.position(value(S[face], s[face], app.energy)))
                                : app.css('--wrong'));
}

// Maps uv to pixels of the canvas.
function placementOf({direction: [c, s], turnedBounds}, canvas, pixel) {
  const {low, high, center} = turnedBounds;
  const margin = 2 * kMargin * pixel;
  const fit = Math.min((canvas.width - margin) / (high[0] - low[0] || 1),
                       (canvas.height - margin) / (high[1] - low[1] || 1));
  return {
    place: ([u, v]) => [0.5 * canvas.width + fit * (c * u + s * v - center[0]),
                        0.5 * canvas.height - fit * (c * v - s * u - center[1])],
    unplace: ([x, y]) => {
      const right = (x - 0.5 * canvas.width) / fit + center[0];
      const up = (0.5 * canvas.height - y) / fit + center[1];
      return [c * right - s * up, s * right + c * up];
    },
  };
}

function draw(app, outlines, canvas, pixel) {
  const box = canvas.parentElement.getBoundingClientRect();
  canvas.width = box.width * pixel;
  canvas.height = box.height * pixel;
  const {place} = placementOf(app.map, canvas, pixel);
  const pen = canvas.getContext('2d');
  const color = colorsOf(app);
  pen.lineWidth = 0.5 * pixel;
  pen.strokeStyle = `rgb(${rgbOf('#5c6570').map((x) => 255 * x).join(' ')} / 0.6)`;
  outlines.forEach(({points, face}) => {
    pen.beginPath();
    for (const uv of points) pen.lineTo(...place(uv));
    pen.closePath();
    pen.fillStyle = color(face);
    pen.fill();
    pen.stroke();
  });
}

function pointAtCells(app, canvas, pixel) {
  const {map, state} = app;
  const cells = new CellFinder(map);
  const element = byId('layout');
  const find = (event) => {
    const box = canvas.getBoundingClientRect();
    const {unplace} = placementOf(map, canvas, pixel);
    return cells.find(map.uv, unplace([pixel * (event.clientX - box.left),
                                       pixel * (event.clientY - box.top)]));
  };
  element.addEventListener('pointermove', (event) => state.set({hovered: find(event)}));
  element.addEventListener('pointerleave', () => state.set({hovered: null}));
  element.addEventListener('click', (event) => state.set({pinned: find(event)}));
}

export function showWithoutWebGl(app) {
  const note = byId('notice');
  note.hidden = false;
  note.textContent = 'The surface is not drawn, as this browser offers no WebGL2 here. The ' +
      'layout is, in one colour a face, that of its middle.';
  document.body.classList.add('flat');
  const canvas = byId('canvas');
  const pixel = window.devicePixelRatio || 1;
  const outlines = Array.from({length: app.map.faceCount}, (_, face) => (
    {face, points: outlineOf(app.map, face)}));
  // Marks both halves of a quad at once.
  if (app.map.isOfQuads)
    outlines.forEach((half, k) => { if (k % 2 === 0) half.points.push(outlines[k + 1].points[2]); });
  const shown = app.map.isOfQuads ? outlines.filter(({face}) => face % 2 === 0) : outlines;
  app.state.watch(['show', 'range', 'theme'], () => draw(app, shown, canvas, pixel));
  new ResizeObserver(() => draw(app, shown, canvas, pixel)).observe(byId('stage'));
  pointAtCells(app, canvas, pixel);
}
