'use strict';
// Scales, marks and one chart. Knows nothing of the page but the <svg> that it is given.

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

// Colour, line and marker change at different rates: no two of the first 49 runs look the same.
function styleOf(index) {
  const shift = Math.floor(index / 7);
  return {
    color: `var(--color${index % 7})`,
    dash: dashes[(index + shift) % 7],
    marker: markers[(index + 2 * shift) % 7],
  };
}

// Charts are drawn in this namespace; the page itself shows its name.
const svgNamespace = document.querySelector('svg').namespaceURI;

function draw(parent, name, attributes = {}, text = '') {
  const element = document.createElementNS(svgNamespace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== '') element.textContent = text;
  return parent.appendChild(element);
}

const isNumber = Number.isFinite;

function readable(value, digits = 6) {
  if (!isNumber(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) {
    return value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
  }
  return String(Number(value.toPrecision(digits)));
}

function powerLabel(exponent, plain) {
  if (plain || exponent === 0 || exponent === 1) return String(Number(`1e${exponent}`));
  const raised = (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)];
  return '10' + String(exponent).replace(/./g, raised);
}

// The scales below take `values` to pixels from axis.begin to axis.end: at(value), and ticks
// {at, label} about axis.spacing apart. axis.step is the smallest step between ticks.
function linearScale(values, axis) {
  const {begin, end} = axis;
  const numbers = values.filter(isNumber);
  let low = numbers.length ? numbers.reduce((a, b) => Math.min(a, b)) : 0;
  let high = numbers.length ? numbers.reduce((a, b) => Math.max(a, b)) : 1;
  if (!(high - low > 1e-12 * Math.abs(high))) {
    const margin = 0.05 * Math.abs(high) || 1;
    [low, high] = [low - margin, high + margin];
  }
  const count = Math.max(2, Math.floor(Math.abs(end - begin) / axis.spacing));
  // Divided before subtracted: the span of two doubles may overflow.
  const rough = high / count - low / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const nice = power * [1, 2, 5, 10].find((m) => m * power >= 0.999 * rough);
  const step = Math.max(axis.step, nice);
  const span = high / 2 - low / 2;
  const at = (value) => begin + (end - begin) * ((value / 2 - low / 2) / span);
  const steps = Math.max(Math.abs(low), Math.abs(high)) / step;
  const digits = Math.min(15, Math.max(1, Math.ceil(Math.log10(steps)) + 1));
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9 && ticks.length < 50; ++k) {
    ticks.push({at: at(k * step), label: readable(k * step, digits)});
  }
  return {at, ticks};
}

// By powers of ten from axis.least up. Zero and less, and what is below axis.least, have a slot of
// their own at the beginning, apart from the rest.
function logScale(values, axis) {
  const {begin, end, least} = axis;
  const numbers = values.filter(isNumber);
  const positive = numbers.filter((v) => v >= least);
  if (positive.length === 0) return linearScale(values, axis);
  const slotted = positive.length < numbers.length;
  const first = slotted ? begin + Math.sign(end - begin) * 26 : begin;
  let low = Math.log10(positive.reduce((a, b) => Math.min(a, b)));
  let high = Math.log10(positive.reduce((a, b) => Math.max(a, b)));
  const margin = Math.max(0.03 * (high - low), 0.08);
  [low, high] = [low - margin, high + margin];
  const place = (exponent) => first + (end - first) * ((exponent - low) / (high - low));
  const at = (value) => value >= least ? place(Math.log10(value)) : begin;
  const ticks = [];
  if (slotted) {
    const hidden = numbers.some((v) => v > 0 && v < least);
    ticks.push({at: begin, label: hidden ? '≈ 0' : '0'});
  }
  const stride = Math.max(1, Math.ceil((high - low) * axis.spacing / Math.abs(end - first)));
  const factors = high - low < 2.5 ? (high - low < 1 ? [1, 1.5, 2, 3, 4, 5, 7] : [1, 2, 5]) : [1];
  const plain = low >= -4 && high <= 5;
  for (let power = Math.floor(low); power <= high; ++power) {
    if (power % stride !== 0) continue;
    for (const factor of factors) {
      const exponent = power + Math.log10(factor);
      if (exponent < low || exponent > high) continue;
      const label = factor === 1 ? powerLabel(power, plain) : readable(factor * 10 ** power, 3);
      ticks.push({at: place(exponent), label});
    }
  }
  return {at, ticks, split: slotted ? (begin + first) / 2 : undefined};
}

// Draws `runs` [{index, method, style, points}] into the svg. `x` and `y` are {key, kind, name,
// least, step}, y with targets [{value, label}] too. Returns where each point is:
// [{run, index, x, y}].
function drawChart(svg, runs, x, y, title) {
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

function drawAxes(svg, box, across, up, name) {
  let last = -Infinity;
  for (const {at, label} of across.ticks) {
    draw(svg, 'path', {class: 'grid', d: `M${at} ${box.top}V${box.bottom}`});
    if (at - last < 12 + 6 * label.length) continue;
    last = at;
    draw(svg, 'text', {x: at, y: box.bottom + 18, 'text-anchor': 'middle'}, label);
  }
  last = Infinity;
  for (const {at, label} of up.ticks) {
    draw(svg, 'path', {class: 'grid', d: `M${box.left} ${at}H${box.right}`});
    if (last - at < 14) continue;
    last = at;
    draw(svg, 'text', {x: box.left - 8, y: at + 4, 'text-anchor': 'end'}, label);
  }
  // An axis with a slot for 0 is broken where its logarithm ends.
  const gap = 3;
  draw(svg, 'path', {class: 'axis', d: across.split === undefined
    ? `M${box.left} ${box.bottom}H${box.right}`
    : `M${box.left} ${box.bottom}H${across.split - gap}m0 4v-8m${2 * gap} 8v-8m0 4H${box.right}`});
  draw(svg, 'path', {class: 'axis', fill: 'none', d: up.split === undefined
    ? `M${box.left} ${box.bottom}V${box.top}`
    : `M${box.left} ${box.bottom}V${up.split + gap}m4 0h-8m8 ${-2 * gap}h-8m4 0V${box.top}`});
  const middle = (box.left + box.right) / 2;
  draw(svg, 'text', {x: middle, y: box.bottom + 38, 'text-anchor': 'middle'}, name);
}

function drawTarget(svg, box, at, label) {
  if (!(at > box.top && at < box.bottom)) return;
  draw(svg, 'path', {class: 'target', d: `M${box.left} ${at}H${box.right}`});
  draw(svg, 'text', {class: 'target-name', x: box.right + 6, y: at + 4}, label);
}

// The line, interrupted where there is no number, and markers at least 26 pixels apart.
function drawRun(group, run, across, up) {
  const placed = [];
  let line = '';
  let pen = 'M';
  run.points.forEach((point, index) => {
    const [x, y] = [across(point), up(point)];
    if (!point.drawable || !isNumber(x) || !isNumber(y)) {
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
