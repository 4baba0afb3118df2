// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Quantities and their fixed scales, which map values to positions in 0..1 and to colours, by the
// page's data (pictures/color_scale.h defines them).

import {densityAt} from './energies.js';
import {readable} from './numbers.js';

const kBeyond = 0.005;    // fraction of the area beyond each end of a fitted scale
const kLeastSpan = 1e-3;  // least span in log s: maps close to isometric ones are not exaggerated

export const valuesOf = {
  'density': (S, s, energy) => densityAt(energy, S, s),
  'area': (S, s) => S * s,
  'angle': (S, s) => (s > 0 ? S / s : Infinity),
  'sigma-max': (S) => S,
  'sigma-min': (S, s) => s,
  // For quads T is their deviation (quads.js).
  'deviation': (S, s, energy, T) => T,
  // For two maps T >= t are those of the other one.
  'difference': (S, s, energy, T, t) => densityAt(energy, S, s) - densityAt(energy, T, t),
};

const rounded = (x) => Number(x.toPrecision(3));

export class Scale {
  constructor(data) {
    Object.assign(this, data);  // name, label, diverging, low, high, neutral, unit, ticks
    const text = atob(data.colors);
    this.bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  }

  // Returns log s of a value, in which positions are linear.
  stretched(value) {
    const ratio =
        this.diverging ? value / this.neutral : 1 + (value - this.neutral) / this.unit;
    return Math.log(Math.max(ratio, 1e-300));
  }

  position(value) {
    if (Number.isNaN(value)) return 1;
    const t = this.stretched(value);
    const [low, high] = [this.stretched(this.low), this.stretched(this.high)];
    let position = (t - low) / (high - low);
    if (this.diverging) position = t < 0 ? 0.5 - 0.5 * t / low : 0.5 + 0.5 * t / high;
    return Math.min(1, Math.max(0, position));
  }

  // Returns the value at a position, the inverse of position().
  value(position) {
    const [low, high] = [this.stretched(this.low), this.stretched(this.high)];
    if (!this.diverging)
      return this.neutral + this.unit * Math.expm1(low + position * (high - low));
    return this.neutral *
        Math.exp(position < 0.5 ? (1 - 2 * position) * low : (2 * position - 1) * high);
  }

  // Returns whether these numbers may be the ends: isometry is the lower one, or between them.
  takes([low, high]) {
    return this.diverging ? low > 0 && low < this.neutral && this.neutral < high
                          : low >= this.neutral && low < high;
  }

  // Returns the scale with other ends, which have ticks.
  withRange(low, high) {
    const scale = Object.assign(Object.create(Object.getPrototypeOf(this)), this, {low, high});
    const from = low < 0 || high > 2 * low ? 0 : low;  // offset of the rounded ticks
    const inner = [1, 2, 3].map((k) => from + Number((scale.value(k / 4) - from).toPrecision(2)));
    if (this.diverging) inner[1] = this.neutral;
    scale.ticks = [low, ...inner.filter((x) => x > low && x < high), high].map(
        (value) => ({value, label: readable(value, 5), position: scale.position(value)}));
    return scale;
  }

  // Returns the scale from isometry to the range of nearly all of the surface: `values`, each with
  // its area. Values beyond the ends have the colours of the ends.
  fitted(values, areas) {
    const order = Array.from(values.keys()).filter((k) => Number.isFinite(values[k]))
        .sort((a, b) => values[a] - values[b]);
    const total = order.reduce((sum, k) => sum + areas[k], 0);
    const quantile = (part) => {
      let sum = 0;
      return values[order.find((k) => (sum += areas[k]) >= part * total) ?? order.at(-1)];
    };
    if (order.length === 0) return [this.low, this.high];
    const far = Math.max(kLeastSpan, this.stretched(quantile(1 - kBeyond)),
                         this.diverging ? -this.stretched(quantile(kBeyond)) : 0);
    return this.rangeOf(far);
  }

  // Returns ends equally far from isometry in log s.
  rangeOf(far) {
    if (this.diverging)
      return [-far, far].map((x) => rounded(this.neutral * Math.exp(x)));
    return [this.neutral, this.neutral + rounded(this.unit * Math.expm1(far))];
  }

  color(position) {
    const at = 3 * Math.round(255 * position);
    return `rgb(${this.bytes[at]} ${this.bytes[at + 1]} ${this.bytes[at + 2]})`;
  }

  // Returns values for uScale and uUnit of the shaders.
  get uniform() {
    return [this.diverging ? 1 : 0, this.stretched(this.low), this.stretched(this.high),
            this.neutral];
  }
}

// A scale of differences: 0 is in the middle, and positions are linear in the value.
export class DifferenceScale extends Scale {
  // like: the scale whose colours are used; far: the end of the range.
  constructor(like, far) {
    super({...like, name: 'difference', label: 'difference', diverging: true, neutral: 0, low: -far,
           high: far});
    this.ticks = this.withRange(-far, far).ticks;
  }

  stretched(value) { return value; }

  value(position) {
    return position < 0.5 ? (1 - 2 * position) * this.low : (2 * position - 1) * this.high;
  }

  takes([low, high]) { return low < 0 && high > 0; }

  rangeOf(far) { return [-rounded(far), rounded(far)]; }

  get uniform() { return [2, this.low, this.high, 0]; }
}
