// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Scales with ticks, linear and logarithmic, and the axes that show them.

import {svgElement} from '../map_page/elements.js';
import {readable} from '../map_page/numbers.js';

export function draw(parent, name, attributes = {}, text = '') {
  return parent.appendChild(svgElement(name, attributes, ...(text === '' ? [] : [text])));
}

// Returns those ticks {at, label}, by rising places in pixels, whose centred labels have room
// beside each other.
export function spacedTicks(ticks) {
  let last = -Infinity;
  return ticks.filter(({at, label}) => {
    if (at - last < 12 + 6 * label.length) return false;
    last = at;
    return true;
  });
}

function powerLabel(exponent, plain) {
  if (plain || exponent === 0 || exponent === 1) return String(Number(`1e${exponent}`));
  const raised = (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)];
  return '10' + String(exponent).replace(/./g, raised);
}

// The scales below map `values` to pixels from axis.begin to axis.end. They have at(value), and
// ticks {at, label} about axis.spacing apart. axis.step is the smallest step between ticks.
export function linearScale(values, axis) {
  const {begin, end} = axis;
  const numbers = values.filter(Number.isFinite);
  let low = numbers.length ? numbers.reduce((a, b) => Math.min(a, b)) : 0;
  let high = numbers.length ? numbers.reduce((a, b) => Math.max(a, b)) : 1;
  if (!(high - low > 1e-12 * Math.abs(high))) {
    const margin = 0.05 * Math.abs(high) || 1;
    [low, high] = [low - margin, high + margin];
  }
  const count = Math.max(2, Math.floor(Math.abs(end - begin) / axis.spacing));
  // Divides before subtracting, since the span of two doubles may overflow.
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

// Makes a logarithmic scale from axis.least up. Smaller values, zero and below have a slot of their
// own at the beginning.
export function logScale(values, axis) {
  const {begin, end, least} = axis;
  const numbers = values.filter(Number.isFinite);
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

// Draws lines and labels of both scales around the box {left, right, top, bottom}; labels that
// would touch are left out.
export function drawAxes(svg, box, across, up, name) {
  for (const {at} of across.ticks)
    draw(svg, 'path', {class: 'grid', d: `M${at} ${box.top}V${box.bottom}`});
  for (const {at, label} of spacedTicks(across.ticks))
    draw(svg, 'text', {x: at, y: box.bottom + 18, 'text-anchor': 'middle'}, label);
  let last = Infinity;
  for (const {at, label} of up.ticks) {
    draw(svg, 'path', {class: 'grid', d: `M${box.left} ${at}H${box.right}`});
    if (last - at < 14) continue;
    last = at;
    draw(svg, 'text', {x: box.left - 8, y: at + 4, 'text-anchor': 'end'}, label);
  }
  // An axis with a slot for 0 is interrupted where its logarithm ends.
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

