// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The page: data, switches, legend, tooltips, keys.

import {draw} from '../charts/axes.js';
import {readable} from '../map_page/numbers.js';
import {drawChart, styleOf} from './chart.js';

const data = JSON.parse(document.getElementById('data').textContent);
const columns = ['iteration', 'seconds', 'energy', 'gradient_norm', 'step', 'measure'];

function excessOf(energy) {
  if (!Number.isFinite(energy) || data.best === null) return null;
  return data.best === 0 ? energy : (energy - data.best) / Math.abs(data.best);
}

const runs = data.runs.map((run, index) => ({
  index,
  method: run.method,
  style: styleOf(index),
  shown: true,
  points: run.iteration.map((_, i) => {
    const point = Object.fromEntries(columns.map((name) => [name, run[name][i]]));
    point.excess = excessOf(point.energy);
    point.drawable = Number.isFinite(point.excess) && Number.isFinite(point.seconds);
    return point;
  }),
}));

// Chooses a logarithmic scale if the positive values span more than a factor of 100.
function usualKind(key) {
  const values = runs.flatMap((run) => run.points.filter((p) => p.drawable).map((p) => p[key]));
  if (key === 'energy' && values.some((v) => v <= 0)) return 'linear';
  const positive = values.filter((v) => v > 0);
  const least = positive.reduce((a, b) => Math.min(a, b), Infinity);
  const most = positive.reduce((a, b) => Math.max(a, b), 0);
  return most > 100 * least ? 'log' : 'linear';
}

const options = {
  view: 'excess',
  iteration: usualKind('iteration'),
  seconds: usualKind('seconds'),
};

const excessName = data.best === 0 ? 'energy' : 'excess energy';
const excessFloor = data.best === 0 ? 1e-300 : 1e-13;  // smaller values are rounding errors

function verticalAxis() {
  if (options.view === 'energy') {
    const kind = usualKind('energy');
    return {key: 'energy', kind, name: 'energy', least: 1e-300, step: 0, targets: []};
  }
  const targets = data.best === 0 ? [] : data.fractions.map(
    (value) => ({value, label: `${readable(100 * value)} %`}));
  return {key: 'excess', kind: 'log', name: excessName, least: excessFloor, step: 0, targets};
}

const charts = [
  {id: 'by-iteration', key: 'iteration', name: 'iterations', least: 1, step: 1},
  {id: 'by-seconds', key: 'seconds', name: 'seconds', least: 1e-9, step: 0},
].map((chart) => {
  const figure = document.getElementById(chart.id);
  const part = (selector) => figure.querySelector(selector);
  const parts = {svg: part('svg'), tip: part('.tip'), heading: part('.heading')};
  return {...chart, ...parts, figure, placed: []};
});

function render() {
  const y = verticalAxis();
  const shown = runs.filter((run) => run.shown);
  for (const chart of charts) {
    const x = {...chart, kind: options[chart.key]};
    const name = `${y.name[0].toUpperCase()}${y.name.slice(1)} over ${chart.name}`;
    chart.heading.textContent = name;
    const methods = shown.map((run) => run.method).join(', ');
    chart.placed = drawChart(chart.svg, shown, x, y, `${name}. Methods: ${methods}. ` +
                             'Arrow keys walk along the points; the table has the numbers.');
  }
  for (const group of document.querySelectorAll('[data-option]')) {
    for (const button of group.children) {
      button.setAttribute('aria-pressed', button.dataset.value === options[group.dataset.option]);
    }
  }
  focusOn(null);
}

// Tooltips: the point under the pointer is marked in both charts.
let focused = null;  // {run, index}

function fillTip(tip, run, point) {
  tip.replaceChildren();
  const name = tip.appendChild(document.createElement('strong'));
  name.textContent = run.method;
  name.style.color = run.style.color;
  const list = tip.appendChild(document.createElement('dl'));
  const percent = `${readable(100 * point.excess, 3)} %`;
  const excess = data.best === 0 ? readable(point.excess, 3) : percent;
  for (const [label, value] of [
    ['iteration', point.iteration], ['seconds', readable(point.seconds, 4)],
    ['energy', readable(point.energy, 10)], ['excess', excess],
    ['gradient norm', readable(point.gradient_norm, 3)], ['step', readable(point.step, 4)],
    ...(data.measure ? [[data.measure, readable(point.measure, 4)]] : []),
  ]) {
    list.appendChild(document.createElement('dt')).textContent = label;
    list.appendChild(document.createElement('dd')).textContent = value;
  }
}

function placeTip(chart, place) {
  const box = chart.svg.getBoundingClientRect();
  const around = chart.figure.getBoundingClientRect();
  const scale = box.width / chart.svg.viewBox.baseVal.width;
  const left = box.left - around.left + scale * place.x;
  const top = box.top - around.top + scale * place.y;
  const [width, height] = [chart.tip.offsetWidth, chart.tip.offsetHeight];
  const fits = left + 14 + width <= chart.figure.clientWidth;
  const lowest = chart.figure.clientHeight - height;
  chart.tip.style.left = `${fits ? left + 14 : Math.max(0, left - 14 - width)}px`;
  chart.tip.style.top = `${Math.max(0, Math.min(top - height / 2, lowest))}px`;
}

function focusOn(target, active = null) {
  focused = target;
  for (const chart of charts) {
    const mark = chart.svg.querySelector('.focus');
    const place = target &&
        chart.placed.find((p) => p.run === target.run && p.index === target.index);
    chart.tip.hidden = !place || chart !== active;
    mark.setAttribute('d', place ? 'M-7 0a7 7 0 1 0 14 0a7 7 0 1 0 -14 0z' : '');
    if (!place) continue;
    mark.setAttribute('transform', `translate(${place.x} ${place.y})`);
    mark.style.stroke = target.run.style.color;
    if (chart !== active) continue;
    fillTip(chart.tip, target.run, target.run.points[target.index]);
    placeTip(chart, place);
  }
}

function nearest(chart, event) {
  const box = chart.svg.getBoundingClientRect();
  const scale = chart.svg.viewBox.baseVal.width / box.width;
  const [x, y] = [scale * (event.clientX - box.left), scale * (event.clientY - box.top)];
  let best = null;
  let distance = 40;
  for (const place of chart.placed) {
    const d = Math.hypot(place.x - x, place.y - y);
    if (d < distance) [best, distance] = [place, d];
  }
  return best;
}

// Left and right move along a run, up and down between runs.
function walk(chart, key) {
  const place = focused &&
      chart.placed.findIndex((p) => p.run === focused.run && p.index === focused.index);
  if (!focused || place < 0) return chart.placed[0] || null;
  const current = chart.placed[place];
  if (key === 'ArrowLeft' || key === 'ArrowRight') {
    const next = chart.placed[place + (key === 'ArrowRight' ? 1 : -1)];
    return next && next.run === current.run ? next : current;
  }
  const order = [...new Set(chart.placed.map((p) => p.run))];
  const turn = order.indexOf(current.run) + (key === 'ArrowDown' ? 1 : order.length - 1);
  const others = chart.placed.filter((p) => p.run === order[turn % order.length]);
  const away = (place) => Math.abs(place.x - current.x);
  return others.reduce((a, b) => away(b) < away(a) ? b : a);
}

for (const chart of charts) {
  const {svg} = chart;
  const follow = (event) => focusOn(nearest(chart, event), chart);
  svg.addEventListener('pointermove', follow);
  svg.addEventListener('pointerdown', follow);
  svg.addEventListener('pointerleave', () => focusOn(null));
  svg.addEventListener('blur', () => focusOn(null));
  svg.addEventListener('keydown', (event) => {
    if (event.key === 'Escape') focusOn(null);
    if (!event.key.startsWith('Arrow')) return;
    event.preventDefault();
    focusOn(walk(chart, event.key), chart);
  });
}

function swatch(parent, run) {
  const size = {width: 30, height: 12, viewBox: '0 0 30 12'};
  const svg = draw(parent, 'svg', {...size, 'aria-hidden': true});
  const group = draw(svg, 'g', {class: 'run'});
  group.style.stroke = group.style.color = run.style.color;
  draw(group, 'path', {d: 'M0 6H30', 'stroke-dasharray': run.style.dash});
  draw(group, 'path', {class: 'marker last', d: run.style.marker, transform: 'translate(15 6)'});
  parent.prepend(svg);
}

function fade(chosen) {
  for (const group of document.querySelectorAll('#charts figure .run')) {
    group.classList.toggle('faded', chosen !== null && Number(group.dataset.run) !== chosen.index);
  }
}

for (const run of runs) {
  const button = document.getElementById('legend').appendChild(document.createElement('button'));
  button.type = 'button';
  button.append(run.method);
  button.setAttribute('aria-pressed', true);
  swatch(button, run);
  button.addEventListener('click', () => {
    run.shown = !run.shown;
    button.setAttribute('aria-pressed', run.shown);
    render();
  });
  button.addEventListener('pointerenter', () => fade(run.shown ? run : null));
  button.addEventListener('pointerleave', () => fade(null));
  swatch(document.querySelector(`th > [data-run="${run.index}"]`), run);
}

for (const group of document.querySelectorAll('[data-option]')) {
  group.addEventListener('click', (event) => {
    if (!event.target.dataset.value) return;
    options[group.dataset.option] = event.target.dataset.value;
    render();
  });
}

let width = 0;
new ResizeObserver(() => {
  if (charts[0].svg.clientWidth === width) return;
  width = charts[0].svg.clientWidth;
  render();
}).observe(charts[0].figure);
const table = document.querySelector('.scroll');
new ResizeObserver(() => {
  document.getElementById('goes-on').hidden = table.scrollWidth <= table.clientWidth;
}).observe(table);
render();
document.documentElement.dataset.ready = 'yes';
window.comparisonPage = {charts};  // for tests
