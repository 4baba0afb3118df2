// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Goes to a face, a vertex or a chart by its number.

import {byId, element} from './elements.js';
import {cornersOf, nameOf} from './map_data.js';
import {count, percent, readable} from './numbers.js';

const kMiddle = [1 / 3, 1 / 3, 1 / 3];
const kMostCharts = 500;  // largest number of listed charts

// Returns the place of a vertex of the input, in the first face that has it; null if there is none.
function placeOfVertex(map, vertex) {
  for (let face = 0; face < map.faceCount; ++face) {
    const at = cornersOf(map, face).findIndex(
        (corner) => (map.inputVertex?.[corner] ?? corner) === vertex);
    if (at >= 0) return {face, xi: [0, 1, 2].map((k) => (k === at ? 1 : 0))};
  }
  return null;
}

const finders = {
  face: ({faceCount}, face) => (face < faceCount ? {face, xi: kMiddle} : null),
  vertex: placeOfVertex,
  quad: ({faceCount}, quad) => (2 * quad < faceCount ? {face: 2 * quad, xi: kMiddle} : null),
  element: ({inputFace}, number) => {
    const face = inputFace.indexOf(number);
    return face < 0 ? null : {face, xi: kMiddle};
  },
};

export function addSearch(app) {
  const {map} = app;
  const form = byId('search'), kind = byId('search-kind'), number = byId('search-number');
  if (map.isOfElements) kind.replaceChildren(element('option', {}, 'element'));
  if (map.isOfQuads) kind.firstElementChild.replaceWith(element('option', {selected: ''}, 'quad'));
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    const index = Number(number.value);
    const place = number.value !== '' && Number.isInteger(index) && index >= 0
        ? finders[kind.value](map, index) : null;
    number.setAttribute('aria-invalid', place === null);
    byId('search-said').textContent = place ? '' : `no ${kind.value} ${number.value} here`;
    if (place) app.focusOn(place);
  });
  number.addEventListener('input', () => number.removeAttribute('aria-invalid'));
}

// Returns {chart, faces, area, face}; the face is near the middle of the chart.
function chartsOf(map) {
  const charts = new Map();
  for (let face = 0; face < map.faceCount; ++face) {
    const chart = map.chart[face];
    if (!charts.has(chart)) charts.set(chart, {chart, faces: [], area: 0});
    const entry = charts.get(chart);
    entry.faces.push(face);
    entry.area += map.areas[face];
  }
  return [...charts.values()].sort((a, b) => b.area - a.area);
}

export const facesOfChart = (map, chart) =>
    Array.from(map.chart.keys()).filter((face) => map.chart[face] === chart);

// Returns the face whose corners are nearest to the mean of all in the layout.
function middleFace(map, faces) {
  const middleOf = (face) => cornersOf(map, face).reduce(
      ([u, v], corner) => [u + map.uv[2 * corner] / 3, v + map.uv[2 * corner + 1] / 3], [0, 0]);
  const middles = faces.map(middleOf);
  const mean = [0, 1].map((d) => middles.reduce((sum, m) => sum + m[d], 0) / faces.length);
  const far = middles.map((m) => Math.hypot(m[0] - mean[0], m[1] - mean[1]));
  return faces[far.reduce((best, x, k) => (x < far[best] ? k : best), 0)];
}

export function listCharts(app) {
  const {map} = app;
  if (!map.chart) return;
  const charts = chartsOf(map);
  const total = charts.reduce((sum, {area}) => sum + area, 0);
  const section = byId('charts');
  section.hidden = false;
  const show = ({faces}) => {
    app.state.set({pinned: {face: middleFace(map, faces), xi: kMiddle}});
    app.showFaces?.(faces);
  };
  const [one, many] = map.isOfElements ? ['element'] : map.isOfQuads ? ['patch', 'patches']
                                                                     : ['chart'];
  const sizeOf = ({faces: {length}}) => {
    if (map.isOfElements) return '';
    return ` ${map.isOfQuads ? count(length / 2, 'quad') : count(length, 'face')},`;
  };
  const items = charts.slice(0, kMostCharts).map((entry) => element('li', {},
      element('button', {type: 'button', onclick: () => show(entry)},
              map.isOfElements ? nameOf(map, entry.faces[0]) : `${one} ${readable(entry.chart)}`),
      `${sizeOf(entry)} ${percent(entry.area / total)} of the area`));
  section.append(element('h2', {}, count(charts.length, one, many)),
                 element('ul', {}, ...items));
  if (charts.length > kMostCharts)
    section.append(element('p', {className: 'note'}, `The largest ${kMostCharts} are listed.`));
}
