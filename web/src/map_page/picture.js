// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// "Save picture": both views with title and legend, as a PNG.

import {summaryOf} from './facts.js';

const kBarHeight = 14;  // CSS pixels

function drawLegend(pen, app, x, y, width, pixel) {
  const scale = app.scales[app.state.show];
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

// A canvas with what is seen.
export function pictureOf(app) {
  const {stage, state} = app;
  stage.render();
  const source = stage.canvas;
  const pixel = stage.renderer.getPixelRatio();
  const canvas = document.createElement('canvas');
  const legend = app.scales[state.show] ? 76 * pixel : 0;
  const head = 44 * pixel;
  canvas.width = source.width;
  canvas.height = source.height + head + legend;
  const pen = canvas.getContext('2d');
  pen.fillStyle = app.css('--back');
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = app.css('--ink');
  pen.font = `600 ${17 * pixel}px system-ui, sans-serif`;
  pen.fillText(app.map.title, 14 * pixel, 28 * pixel);
  const after = pen.measureText(`${app.map.title}   `).width;
  pen.font = `${14 * pixel}px system-ui, sans-serif`;
  pen.fillText(summaryOf(app.map), 14 * pixel + after, 28 * pixel);
  pen.drawImage(source, 0, head);
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
