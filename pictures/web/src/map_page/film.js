// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The maps of the run: a slider over its iterations.

import {byId, element} from './elements.js';
import {degreeName, readable} from './numbers.js';

const kFrameTime = 120;  // ms

export class Film {
  constructor(app) {
    this.app = app;
    const {snapshots} = app.map;
    if (snapshots.length < 2) return;
    const section = byId('film');
    section.hidden = false;
    this.slider = element('input', {
      type: 'range', min: 0, max: this.last, value: this.last,
      'aria-label': 'Iteration', oninput: () => this.go(Number(this.slider.value)),
    });
    this.play = element('button', {type: 'button', className: 'plain',
                                   onclick: () => this.toggle()}, 'play');
    this.said = element('span', {className: 'said'});
    // Nothing moves automatically for users who prefer reduced motion.
    const still = matchMedia('(prefers-reduced-motion: reduce)');
    this.play.hidden = still.matches;
    still.addEventListener('change', () => {
      this.play.hidden = still.matches;
      if (still.matches) this.stop();
    });
    section.append(this.play, this.slider, this.said);
    app.state.watch(['frame'], () => this.write());
  }

  // the index of the result, which is the map itself
  get last() { return this.app.map.snapshots.length - 1; }

  go(frame) {
    this.app.state.set({frame: frame >= this.last ? null : frame});
  }

  write() {
    const {state, map} = this.app;
    this.slider.value = state.frame ?? this.last;
    const {iteration, degree, energy} = map.snapshots[state.frame ?? this.last];
    this.said.textContent = `iteration ${readable(iteration)}, ${degreeName(degree)}, ` +
        `energy ${readable(energy, 6)}`;
  }

  toggle() {
    if (this.timer) {
      this.stop();
      return;
    }
    this.play.textContent = 'stop';
    if (this.app.state.frame === null) this.go(0);
    this.timer = setInterval(() => {
      this.go(Number(this.slider.value) + 1);
      if (this.app.state.frame === null) this.stop();
    }, kFrameTime);
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
    this.play.textContent = 'play';
  }
}
