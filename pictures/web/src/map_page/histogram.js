// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The scale of the shown quantity: a histogram by area over its colours, with ticks, and a brush
// that selects a part of the scale.

import {spacedTicks} from '../charts/axes.js';
import {byId, element, svgElement} from './elements.js';
import {percent, readable} from './numbers.js';
import {evenPlaces, sampleSingularValues} from './sampling.js';
import {valuesOf} from './scales.js';

const kBins = 96;
const kPlaces = 3;  // places per edge of curved faces: 9 per face
const kHeight = 74, kBar = 12, kSide = 14;  // sizes of the drawing in CSS pixels
const kStep = 1 / 64;  // step of the brush by keys

export class Histogram {
  constructor(app) {
    this.app = app;
    this.section = byId('scale');
    this.heading = element('h2');
    this.note = element('p', {className: 'note'});
    this.svg = svgElement('svg', {'role': 'group', 'aria-label': 'Histogram by area',
                                    'shape-rendering': 'crispEdges'});
    this.fit = element('button', {
      type: 'button', className: 'plain', title: 'Colours from isometry to what 99.5 % of the ' +
          'surface are within; again: the scale that all maps share',
      onclick: () => app.state.set({range: app.state.range ? null : this.fittedRange(), brush: null}),
    }, 'fit colours');
    this.section.append(element('div', {className: 'heading'}, this.heading, this.fit), this.svg,
                        this.note);
    this.listen();
    app.state.watch(['show', 'frame', 'range'], () => this.fill());
    app.state.watch(['brush'], () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.section);
  }

  get scale() { return this.app.scale; }

  // Places in a face: one if all maps are affine.
  get places() {
    const {map, other} = this.app;
    return evenPlaces(Math.max(map.degree, other?.degree ?? 1) === 1 ? 1 : kPlaces);
  }

  samples() {
    const {map, uv} = this.app;
    if (this.sampledUv !== uv) {
      this.sampled = sampleSingularValues(map, uv, this.places);
      this.sampledUv = uv;
    }
    return this.sampled;
  }

  // Returns the values of the map, or of both, at the places of samples(); NaN at inverted faces.
  values() {
    const {map, other, energy, state} = this.app;
    const {S, s, perFace} = this.samples();
    const value = valuesOf[state.show];
    if (state.show === 'deviation')
      return S.map((_, at) => map.quads[Math.floor(at / perFace / 2)].deviation);
    if (state.show !== 'difference')
      return S.map((_, at) => (s[at] > 0 ? value(S[at], s[at], energy) : NaN));
    this.beyond ??= sampleSingularValues(other, other.uv, this.places);
    const {S: T, s: t} = this.beyond;
    return S.map((_, at) => (s[at] > 0 && t[at] > 0
        ? value(S[at], s[at], energy, T[at], t[at]) : NaN));
  }

  fittedRange() {
    const {map, state, scales} = this.app;
    const {S, perFace} = this.samples();
    return scales[state.show].fitted(this.values(),
                                     S.map((_, at) => map.areas[Math.floor(at / perFace)]));
  }

  // Sums areas of the surface by position on the scale.
  fill() {
    this.section.hidden = !this.scale;
    if (!this.scale) return;
    const {map} = this.app;
    const {perFace} = this.samples();
    this.bins = new Float64Array(kBins);
    this.below = this.above = this.flipped = this.total = 0;
    this.values().forEach((x, at) => {
      const area = map.areas[Math.floor(at / perFace)] / perFace;
      this.total += area;
      if (Number.isNaN(x)) {
        this.flipped += area;
        return;
      }
      this.bins[Math.min(kBins - 1, Math.floor(this.scale.position(x) * kBins))] += area;
      if (x < this.scale.low) this.below += area;
      if (x > this.scale.high) this.above += area;
    });
    this.draw();
  }

  // Returns the share of the surface that the brush selects, to within a bin.
  selectedShare([from, to]) {
    let area = 0;
    for (let k = 0; k < kBins; ++k)
      if ((k + 0.5) / kBins >= from && (k + 0.5) / kBins <= to) area += this.bins[k];
    return area / this.total;
  }

  draw() {
    if (!this.scale || !this.bins) return;
    const width = Math.max(200, this.section.clientWidth);
    const inner = width - 2 * kSide;
    const x = (position) => kSide + inner * position;
    this.x = x;
    this.svg.setAttribute('viewBox', `0 0 ${width} ${kHeight + kBar + 26}`);
    this.svg.setAttribute('height', kHeight + kBar + 26);
    const most = Math.max(...this.bins);
    const brush = this.app.state.brush;
    const parts = [];
    this.bins.forEach((area, k) => {
      const middle = (k + 0.5) / kBins;
      const height = most > 0 ? (kHeight - 6) * area / most : 0;
      const outside = brush && (middle < brush[0] || middle > brush[1]);
      if (height > 0)
        parts.push(svgElement('rect', {
          x: x(k / kBins), width: inner / kBins + 0.3, y: kHeight - Math.max(height, 1),
          height: Math.max(height, 1), className: outside ? 'bin outside' : 'bin',
        }));
    });
    for (let k = 0; k < 128; ++k)
      parts.push(svgElement('rect', {x: x(k / 128), y: kHeight + 2, width: inner / 128 + 0.5,
                                     height: kBar, fill: this.scale.color((k + 0.5) / 128)}));
    this.addTicks(parts, x);
    this.addBrush(parts, x);
    const focused = document.activeElement?.getAttribute?.('data-handle');
    this.svg.replaceChildren(...parts);
    if (focused) this.svg.querySelector(`[data-handle="${focused}"]`)?.focus();
    this.write();
  }

  addTicks(parts, x) {
    const ticks = this.scale.ticks.map((tick) => ({...tick, at: x(tick.position)}));
    const isNeutral = ({value}) => value === this.scale.neutral;
    for (const tick of ticks)
      parts.push(svgElement('line', {
        x1: tick.at, x2: tick.at, y1: kHeight + 2,
        y2: kHeight + kBar + (isNeutral(tick) ? 8 : 6), className: 'tick',
      }));
    for (const tick of spacedTicks(ticks))
      parts.push(svgElement('text', {x: tick.at, y: kHeight + kBar + 20,
                                     className: isNeutral(tick) ? 'neutral' : ''}, tick.label));
    // Values beyond an end have its colour, and a triangle marks it.
    const y = kHeight + 2 + kBar / 2;
    for (const [area, at, way] of [[this.below, x(0), -1], [this.above, x(1), 1]])
      if (area > 0)
        parts.push(svgElement('path', {
          d: `M${at + 2 * way},${y - kBar / 2}l${8 * way},${kBar / 2}l${-8 * way},${kBar / 2}z`,
          fill: this.scale.color(way < 0 ? 0 : 1),
        }));
  }

  addBrush(parts, x) {
    const brush = this.app.state.brush;
    const [from, to] = brush ?? [0, 1];
    if (brush)
      parts.push(svgElement('rect', {x: x(from), width: x(to) - x(from), y: 0, height: kHeight,
                                     className: 'brush'}));
    for (const [name, position] of [['from', from], ['to', to]]) {
      parts.push(svgElement('g', {
        'data-handle': name, 'tabindex': 0, 'role': 'slider', 'class': 'handle',
        'transform': `translate(${x(position)} 0)`,
        'aria-label': `Selected ${name}`, 'aria-valuemin': 0, 'aria-valuemax': 100,
        'aria-valuenow': Math.round(100 * position),
        'aria-valuetext': readable(this.scale.value(position), 3),
      }, svgElement('line', {y1: 0, y2: kHeight + kBar + 2}),
         svgElement('rect', {x: -4, y: kHeight / 2 - 11, width: 8, height: 22, rx: 4})));
    }
  }

  write() {
    const {state, map} = this.app;
    this.heading.textContent = this.app.titles[state.show];
    this.fit.setAttribute('aria-pressed', state.range !== null);
    const notes = [];
    if (state.brush) {
      const [from, to] = state.brush.map((position) => readable(this.scale.value(position), 3));
      notes.push(`${percent(this.selectedShare(state.brush))} of the surface between ${from} and ` +
                 `${to} (Escape: all)`);
    }
    if (this.below > 0) notes.push(`${percent(this.below / this.total)} below the scale`);
    if (this.above > 0) notes.push(`${percent(this.above / this.total)} above the scale`);
    if (this.flipped > 0) notes.push(`${percent(this.flipped / this.total)} turned over`);
    notes.push({angle: `${readable(this.scale.neutral)} is conformal`,
                deviation: 'a rectangle has 0',
                difference: 'red where A has more, blue where B has'}[state.show] ??
               `an isometry has ${readable(this.scale.neutral)}`);
    if (map.scaleIsAssumed && !map.isOfQuads && state.show !== 'angle')
      notes.push('the layout, whose scale is not known, taken as large as the surface');
    this.note.textContent = `By area; ${notes.join('; ')}.`;
  }

  listen() {
    const positionOf = (event) => {
      const box = this.svg.getBoundingClientRect();
      const inner = box.width - 2 * kSide;
      return Math.min(1, Math.max(0, (event.clientX - box.left - kSide) / inner));
    };
    let start = null;
    this.svg.addEventListener('pointerdown', (event) => {
      const handle = event.target.closest('[data-handle]')?.dataset.handle;
      const [from, to] = this.app.state.brush ?? [0, 1];
      start = handle ? (handle === 'from' ? to : from) : positionOf(event);
      this.svg.setPointerCapture(event.pointerId);
    });
    this.svg.addEventListener('pointermove', (event) => {
      if (start === null) return;
      const here = positionOf(event);
      if (Math.abs(here - start) < 0.01) return;
      this.select(Math.min(start, here), Math.max(start, here));
    });
    this.svg.addEventListener('pointerup', (event) => {
      if (start !== null && Math.abs(positionOf(event) - start) < 0.01) this.select(0, 1);
      start = null;
    });
    this.svg.addEventListener('keydown', (event) => {
      const handle = event.target.getAttribute('data-handle');
      const way = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: 8,
                   PageDown: -8, Home: -1e3, End: 1e3}[event.key];
      if (event.key === 'Escape') this.select(0, 1);
      if (!handle || !way) return;
      event.preventDefault();
      const brush = [...(this.app.state.brush ?? [0, 1])];
      const which = handle === 'from' ? 0 : 1;
      brush[which] = Math.min(1, Math.max(0, brush[which] + way * kStep));
      brush[which] = which === 0 ? Math.min(brush[0], brush[1] - kStep)
                                 : Math.max(brush[1], brush[0] + kStep);
      this.select(...brush);
    });
  }

  select(from, to) {
    this.app.state.set({brush: from <= 0 && to >= 1 ? null : [from, to]});
  }
}
