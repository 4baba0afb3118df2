// Without WebGL2: the layout on a plain canvas, a colour a cell, and the numbers.

import {combine} from './bezier.js';
import {byId} from './elements.js';
import {evaluate} from './map_data.js';
import {rgbOf, tints} from './marks.js';
import {sampleSingularValues} from './sampling.js';
import {valuesOf} from './scales.js';

const kEdgePieces = 6;
const kMargin = 12;

// The boundary of a cell, corners and points between them.
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
  const scale = app.scales[state.show];
  if (!scale)
    return (face) => (map.chart ? tints[map.chart[face] % tints.length] : app.css('--press'));
  const {S, s} = sampleSingularValues(map, map.uv, [[1 / 3, 1 / 3, 1 / 3]]);
  const value = valuesOf[state.show];
  return (face) => (s[face] > 0 ? scale.color(scale.position(value(S[face], s[face], app.energy)))
                                : app.css('--wrong'));
}

function draw(app, outlines) {
  const {map} = app;
  const canvas = byId('canvas');
  const box = canvas.parentElement.getBoundingClientRect();
  const pixel = window.devicePixelRatio || 1;
  canvas.width = box.width * pixel;
  canvas.height = box.height * pixel;
  const pen = canvas.getContext('2d');
  const {low, high, center} = map.uvBounds;
  const fit = Math.min((canvas.width - 2 * kMargin * pixel) / (high[0] - low[0] || 1),
                       (canvas.height - 2 * kMargin * pixel) / (high[1] - low[1] || 1));
  const color = colorsOf(app);
  pen.lineWidth = 0.5 * pixel;
  pen.strokeStyle = `rgb(${rgbOf('#5c6570').map((x) => 255 * x).join(' ')} / 0.6)`;
  outlines.forEach((points, face) => {
    pen.beginPath();
    for (const [u, v] of points)
      pen.lineTo(0.5 * canvas.width + fit * (u - center[0]),
                 0.5 * canvas.height - fit * (v - center[1]));
    pen.closePath();
    pen.fillStyle = color(face);
    pen.fill();
    pen.stroke();
  });
}

export function showWithoutWebGl(app, reason) {
  const note = byId('fallback');
  note.hidden = false;
  note.textContent = `The surface is not drawn: ${reason}. The layout is, with one colour a face, ` +
      'that of its middle.';
  document.body.classList.add('flat');
  const outlines = Array.from({length: app.map.faceCount}, (_, face) => outlineOf(app.map, face));
  app.state.watch(['show', 'theme'], () => draw(app, outlines));
  new ResizeObserver(() => draw(app, outlines)).observe(byId('stage'));
}
