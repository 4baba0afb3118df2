// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// "Save picture": writes both views with title and legend as a PNG.

import {summaryOf} from './facts.js';
import {degreeName} from './numbers.js';

const kBarHeight = 14;  // CSS pixels

function drawLegend(pen, app, x, y, width, pixel) {
  const {scale} = app;
  if (!scale) return;
  pen.font = `${13 * pixel}px system-ui, sans-serif`;
  pen.textAlign = 'left';
  pen.fillText(app.titles[app.state.show], x, y - 7 * pixel);
  for (let k = 0; k < 256; ++k) {
    pen.fillStyle = scale.color((k + 0.5) / 256);
    pen.fillRect(x + width * k / 256, y, width / 256 + 1, kBarHeight * pixel);
  }
  pen.fillStyle = app.css('--ink');
  pen.textAlign = 'center';
  for (const {label, position} of scale.ticks) {
    pen.fillRect(x + width * position - 0.5 * pixel, y, pixel, (kBarHeight + 4) * pixel);
    pen.fillText(label, x + width * position, y + (kBarHeight + 18) * pixel);
  }
}

// Returns what is shown left and right of the slider's line.
export const sidesOf = (map) => ['straight', degreeName(map.degree)];

// Draws the line between two maps in one view, and their names. top: of the views, in device
// pixels.
function drawWipe(pen, app, view, top) {
  const {stage, state, map} = app;
  const {x, y, width, height, pixel} = stage.rectangleOf(view);
  const bottom = stage.canvas.height - y * pixel + top;
  const at = (x + state.wipe * width) * pixel, above = bottom - height * pixel;
  pen.strokeStyle = app.css('--ink');
  pen.lineWidth = 1.5 * pixel;
  pen.setLineDash([6 * pixel, 4 * pixel]);
  pen.beginPath();
  pen.moveTo(at, above);
  pen.lineTo(at, bottom);
  pen.stroke();
  pen.setLineDash([]);
  pen.font = `${13 * pixel}px system-ui, sans-serif`;
  sidesOf(map).forEach((name, side) => {
    const wide = pen.measureText(name).width, gap = 7 * pixel;
    const from = side === 0 ? at - gap - wide : at + gap;
    pen.fillStyle = app.css('--back');
    pen.fillRect(from - 4 * pixel, above + 6 * pixel, wide + 8 * pixel, 20 * pixel);
    pen.fillStyle = app.css('--ink');
    pen.fillText(name, from, above + 21 * pixel);
  });
}

// Returns a canvas with the current picture, `state.pictureScale` pixels per CSS pixel.
export function pictureOf(app) {
  const {stage, state} = app;
  return stage.drawnAt(state.pictureScale, () => composed(app));
}

// Composes the drawn views with title and legend.
function composed(app) {
  const {stage, state} = app;
  const source = stage.canvas;
  const pixel = stage.renderer.getPixelRatio();
  const canvas = document.createElement('canvas');
  const legend = app.scale ? 76 * pixel : 0;
  const head = 44 * pixel;
  canvas.width = source.width;
  canvas.height = source.height + head + legend;
  const pen = canvas.getContext('2d');
  pen.fillStyle = app.css('--back');
  if (!state.isTransparent) pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = app.css('--ink');
  pen.font = `600 ${17 * pixel}px system-ui, sans-serif`;
  pen.fillText(document.title, 14 * pixel, 28 * pixel);
  const after = pen.measureText(`${document.title}   `).width;
  pen.font = `${14 * pixel}px system-ui, sans-serif`;
  pen.fillText(summaryOf(app.map, state.frame, app.other), 14 * pixel + after, 28 * pixel);
  pen.drawImage(source, 0, head);
  if (state.wipe > 0)
    for (const view of stage.views) drawWipe(pen, app, view, head);
  drawLegend(pen, app, 24 * pixel, source.height + head + 28 * pixel,
             Math.min(420 * pixel, canvas.width - 48 * pixel), pixel);
  return canvas;
}

export function savePicture(app) {
  pictureOf(app).toBlob((blob) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `${app.map.title.replace(/.*[/\\]/, '').replace(/\.[^.]*$/, '')}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1e4);
  });
}
