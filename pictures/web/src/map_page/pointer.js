// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Mouse and touch on the views: pointing shows a place, a click keeps it. Cameras handle dragging,
// with two fingers on touch screens, where one finger scrolls the page.

const kClickSlack = 5;  // CSS pixels a click may move
const kHintTime = 1600;  // ms

// Leaves one-finger gestures to the browser, and shows a hint when one moves on a view.
function shareFingers({element}) {
  element.style.touchAction = 'pan-x pan-y';
  let timer = null;
  const hint = (isShown) => {
    element.classList.toggle('hinting', isShown);
    clearTimeout(timer);
    if (isShown) timer = setTimeout(hint, kHintTime, false);
  };
  for (const kind of ['touchstart', 'touchmove'])
    element.addEventListener(kind, (event) => {
      const isOne = event.touches.length < 2;
      if (!isOne) event.preventDefault();
      if (kind === 'touchmove' || !isOne) hint(isOne);
    }, {passive: false});
}

export function followPointer(app) {
  const {state, surface, layout} = app;
  for (const view of [surface, layout]) {
    shareFingers(view);
    let down = null;
    let waiting = null;
    const show = () => {
      const place = waiting && view.pick(waiting);
      waiting = null;
      state.set({hovered: place});
    };
    view.element.addEventListener('pointermove', (event) => {
      if (event.pointerType === 'touch' || event.buttons !== 0) return;
      if (!waiting) requestAnimationFrame(show);
      waiting = {clientX: event.clientX, clientY: event.clientY};
    });
    view.element.addEventListener('pointerleave', () => {
      waiting = null;
      state.set({hovered: null});
    });
    view.element.addEventListener('pointerdown', (event) => {
      down = event.isPrimary ? {x: event.clientX, y: event.clientY} : null;
    });
    view.element.addEventListener('pointerup', (event) => {
      if (!down || !event.isPrimary || event.button !== 0) return;
      if (Math.hypot(event.clientX - down.x, event.clientY - down.y) > kClickSlack) return;
      const place = view.pick(event);
      state.set({pinned: place && place.face === state.pinned?.face ? null : place});
    });
    view.element.addEventListener('dblclick', (event) => {
      const place = view.pick(event);
      if (place) app.focusOn(place);
    });
  }
}
