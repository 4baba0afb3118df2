// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// A strip of colours that stays in sight of the views on narrow windows, where the histogram is
// below them.

import {byId, element} from './elements.js';

export class Legend {
  constructor(app) {
    this.app = app;
    app.state.watch(['show', 'range'], () => this.write());
  }

  write() {
    const {scale, titles, state} = this.app;
    const strip = byId('legend');
    strip.hidden = !scale;
    if (!scale) return;
    const colors = Array.from({length: 33}, (_, k) => scale.color(k / 32));
    const bar = element('i', {style: `background: linear-gradient(90deg, ${colors.join(', ')})`});
    const ticks = scale.ticks.filter(({position}, k, {length}) =>
        k === 0 || k === length - 1 || (position > 0.12 && position < 0.88 && length < 8));
    const labels = ticks.map(({label, position}, k) => element('b', {
      style: `left: ${100 * position}%; transform: translateX(${-100 * position}%)`,
    }, label));
    strip.replaceChildren(element('span', {}, titles[state.show]), bar,
                          element('span', {className: 'ticks'}, ...labels));
  }
}
