// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The state of the page, and the observers of its changes.
//
//   state.watch(['show', 'brush'], draw);   // called once now, and after every change of either
//   state.set({show: 'area', brush: null});
//   state.set(state.defaults);              // as at the beginning

export class State {
  constructor(values) {
    Object.assign(this, values, {defaults: values});
    this.watchers = [];
  }

  watch(names, call) {
    this.watchers.push({names, call});
    call();
  }

  set(changes) {
    const changed = Object.keys(changes).filter((name) => this[name] !== changes[name]);
    Object.assign(this, changes);
    for (const {names, call} of this.watchers)
      if (names.some((name) => changed.includes(name))) call();
  }
}
