// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Quantities and their fixed scales: values to positions in 0..1 to colours, as the page's data say
// (pictures/color_scale.h is where they come from).

import {densityAt} from './energies.js';

export const valuesOf = {
  'density': (S, s, energy) => densityAt(energy, S, s),
  'area': (S, s) => S * s,
  'angle': (S, s) => (s > 0 ? S / s : Infinity),
  'sigma-max': (S) => S,
  'sigma-min': (S, s) => s,
};

export class Scale {
  constructor(data) {
    Object.assign(this, data);  // name, label, diverging, low, high, neutral, unit, ticks
    const text = atob(data.colors);
    this.bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  }

  // log s of a value, which positions are linear in.
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

  // Its inverse.
  value(position) {
    const [low, high] = [this.stretched(this.low), this.stretched(this.high)];
    if (!this.diverging)
      return this.neutral + this.unit * Math.expm1(low + position * (high - low));
    return this.neutral *
        Math.exp(position < 0.5 ? (1 - 2 * position) * low : (2 * position - 1) * high);
  }

  color(position) {
    const at = 3 * Math.round(255 * position);
    return `rgb(${this.bytes[at]} ${this.bytes[at + 1]} ${this.bytes[at + 2]})`;
  }

  // For uScale and uUnit of the shaders.
  get uniform() {
    return [this.diverging ? 1 : 0, this.stretched(this.low), this.stretched(this.high),
            this.neutral];
  }
}
