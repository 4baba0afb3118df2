// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Markers and a chart. It only uses the <svg> that it is given.

import {draw, drawAxes, linearScale, logScale} from '../charts/axes.js';

const dashes = ['', '7 4', '2 4', '10 4 2 4', '14 5', '5 3 1 3 1 3', '1 3'];
const markers = [
  'M-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0 -7 0z',    // disc
  'M-3.2 -3.2h6.4v6.4h-6.4z',                         // square
  'M0 -4.2L4 3H-4z',                                  // triangle
  'M0 -4.6L4.6 0L0 4.6L-4.6 0z',                      // diamond
  'M0 4.2L4 -3H-4z',                                  // triangle, point down
  'M0 -4.4L4.3 -1.3L2.7 3.7H-2.7L-4.3 -1.3z',         // pentagon
  'M-1.6 -4.4H1.6V-1.6H4.4V1.6H1.6V4.4H-1.6V1.6H-4.4V-1.6H-1.6z',  // cross
];

const colors = 14;  // number of colours in comparison_page.css

// Colour, line and marker change at different rates: the first 14 runs have different colours, and
// the first 98 different looks.
export function styleOf(index) {
  const shift = Math.floor(index / 7);
  return {
    color: `var(--color${index % colors})`,
    dash: dashes[(index + shift) % 7],
    marker: markers[(index + 2 * shift) % 7],
  };
}

// Draws `runs` [{index, method, style, points}] into the svg. `x` and `y` are {key, kind, name,
// least, step}; y also has targets [{value, label}]. Returns the places of all points: [{run,
// index, x, y}].
export function drawChart(svg, runs, x, y, title) {
  const width = Math.max(280, svg.clientWidth || 600);
  const height = Math.round(Math.min(440, Math.max(260, 0.62 * width)));
  const margin = y.targets.length > 0 ? 50 : 14;
  const box = {left: 58, right: width - margin, top: 12, bottom: height - 46};
  svg.replaceChildren();
  svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
  draw(svg, 'title', {}, title);

  const drawn = runs.map((run) => run.points.filter((p) => p.drawable));
  const scale = (axis, place) => (axis.kind === 'log' ? logScale : linearScale)(
    drawn.flatMap((points) => points.map((p) => p[axis.key])), {...axis, ...place});
  const across = scale(x, {begin: box.left + 8, end: box.right - 8, spacing: 64});
  const up = scale(y, {begin: box.bottom - 8, end: box.top + 8, spacing: 40});
  drawAxes(svg, box, across, up, x.name);
  for (const target of y.targets) drawTarget(svg, box, up.at(target.value), target.label);

  const placed = [];
  for (const run of runs) {
    const group = draw(svg, 'g', {class: 'run', 'data-run': run.index});
    group.style.stroke = group.style.color = run.style.color;
    placed.push(...drawRun(group, run, (p) => across.at(p[x.key]), (p) => up.at(p[y.key])));
  }
  if (placed.length === 0) {
    draw(svg, 'text', {x: width / 2, y: height / 2, 'text-anchor': 'middle'}, 'nothing to draw');
  }
  draw(svg, 'path', {class: 'focus'});
  return placed;
}

function drawTarget(svg, box, at, label) {
  if (!(at > box.top && at < box.bottom)) return;
  draw(svg, 'path', {class: 'target', d: `M${box.left} ${at}H${box.right}`});
  draw(svg, 'text', {class: 'target-name', x: box.right + 6, y: at + 4}, label);
}

// Draws a line, interrupted where there is no number, and markers at least 26 pixels apart.
function drawRun(group, run, across, up) {
  const placed = [];
  let line = '';
  let pen = 'M';
  run.points.forEach((point, index) => {
    const [x, y] = [across(point), up(point)];
    if (!point.drawable || !Number.isFinite(x) || !Number.isFinite(y)) {
      pen = 'M';
      return;
    }
    line += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
    pen = 'L';
    placed.push({run, index, x, y});
  });
  draw(group, 'path', {d: line, 'stroke-dasharray': run.style.dash});
  let last;
  placed.forEach((place, i) => {
    const end = i === placed.length - 1;
    if (last && !end && Math.hypot(place.x - last.x, place.y - last.y) < 26) return;
    last = place;
    draw(group, 'path', {class: end ? 'marker last' : 'marker', d: run.style.marker,
                         transform: `translate(${place.x.toFixed(1)} ${place.y.toFixed(1)})`});
  });
  return placed;
}
