// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Controls the views by keys alone.

import {neighboursOf, surfaceEdges} from './neighbours.js';

const kMiddle = [1 / 3, 1 / 3, 1 / 3];
const kTurn = Math.PI / 24;
const ways = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};

// Returns the neighbour of the selected face that lies furthest in a direction of the view.
function step(app, view, way) {
  const {state, map} = app;
  const here = view.onScreen(state.pinned);
  let best = null;
  for (const face of neighboursOf(surfaceEdges(map), state.pinned.face)) {
    const there = view.onScreen({face, xi: kMiddle});
    const [x, y] = [there[0] - here[0], there[1] - here[1]];
    const along = (x * way[0] + y * way[1]) / (Math.hypot(x, y) + 1e-30);
    if (!best || along > best.along) best = {along, face};
  }
  if (best) state.set({pinned: {face: best.face, xi: kMiddle}});
}

export function followKeys(app) {
  const {state, surface, layout} = app;
  for (const view of [surface, layout]) {
    view.element.addEventListener('keydown', (event) => {
      const way = ways[event.key];
      if (event.altKey || event.ctrlKey || event.metaKey) return;
      if (way && event.shiftKey && state.pinned) step(app, view, way);
      else if (way && view === surface) surface.turn(-way[0] * kTurn, -way[1] * kTurn);
      else if (way) layout.move(way[0], way[1]);
      else if (event.key === '+' || event.key === '=') view.zoomBy(1.25);
      else if (event.key === '-') view.zoomBy(0.8);
      else if (event.key === '0' || event.key === 'Home') app.goHome();
      else if (event.key === 'f' && state.pinned) app.focusOn(state.pinned);
      else if (event.key === 'Escape') state.set({pinned: null});
      else if (event.key === 'Enter' || event.key === ' ')
        state.set({pinned: view.pickMiddle() ?? {face: 0, xi: kMiddle}});
      else return;
      event.preventDefault();
    });
  }
}
