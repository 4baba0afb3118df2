// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// behaviour.mjs WHAT FILE OPTIONS: one of the scenes below, played on a page.
import {answer, visit} from './visit.mjs';

const [what, file, options = {}] = process.argv.slice(2).map((text) => JSON.parse(text));

const settled = (page) => page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

// Everything that is focused by tabbing once around, and what a person without a mouse does.
async function walkWithKeys(page) {
  const stations = [];
  for (let k = 0; k < 80; ++k) {
    await page.keyboard.press('Tab');
    const station = await page.evaluate(() => {
      const e = document.activeElement;
      if (!e || e === document.body) return null;
      const style = getComputedStyle(e);
      const box = e.getBoundingClientRect();
      return {id: e.id, tag: e.tagName, text: e.textContent.trim().slice(0, 40),
              name: e.getAttribute('aria-label') ?? '',
              outline: style.outlineStyle !== 'none' || style.boxShadow !== 'none',
              visible: box.width > 0 && box.height > 0};
    });
    if (!station) break;
    stations.push(station);
  }
  const poses = () => page.evaluate(() => ({
    surface: window.majorantPage.app.surface.pose(), layout: window.majorantPage.app.layout.pose(),
    pinned: window.majorantPage.app.state.pinned, said: document.getElementById('said').textContent,
  }));
  await page.focus('#surface');
  const before = await poses();
  await page.keyboard.press('ArrowLeft');
  const turned = await poses();
  await page.keyboard.press('Enter');
  const chosen = await poses();
  await page.keyboard.press('Shift+ArrowRight');
  const neighbour = await poses();
  await page.keyboard.press('Escape');
  const free = await poses();
  await page.focus('#layout');
  await page.keyboard.press('ArrowUp');
  const moved = await poses();
  return {stations, before, turned, chosen, neighbour, free, moved};
}

const scenes = {
  facts: (page) => page.evaluate(() => ({
    title: document.title, heading: document.querySelector('h1').textContent,
    text: document.body.innerText, elements: document.querySelectorAll('script').length,
    hasWebGl: document.createElement('canvas').getContext('webgl2') !== null,
    overflow: document.documentElement.scrollWidth - innerWidth,
  })),
  draw: async (page) => {
    const calls = [];
    for (const show of await page.evaluate(() =>
        [...document.querySelectorAll('#show button')].map((b) => b.textContent))) {
      await page.click(`#show button:text-is("${show}")`);
      await settled(page);
      calls.push(await page.evaluate(() => {
        const {stage} = window.majorantPage.app;
        stage.render();
        return stage.drawCalls;
      }));
    }
    return calls;
  },
  // The pointer over the middle of faces as the views show them.
  hover: async (page) => {
    const found = [];
    for (const view of ['surface', 'layout'])
      for (const face of options.faces) {
        await page.evaluate((face) => {
          window.majorantPage.app.focusOn({face, xi: [0.2, 0.3, 0.5]});
        }, face);
        await settled(page);
        const at = await page.evaluate(([view, face]) => {
          const {app} = window.majorantPage;
          const place = {face, xi: [0.2, 0.3, 0.5]};
          const p = app[view].pointAt(place).project(app[view].camera);
          const box = app[view].element.getBoundingClientRect();
          return [box.left + (p.x + 1) / 2 * box.width, box.top + (1 - p.y) / 2 * box.height];
        }, [view, face]);
        await page.mouse.move(...at);
        await settled(page);
        found.push(await page.evaluate(([view, face]) => {
          const {app, measure} = window.majorantPage;
          const place = app.state.hovered;
          return {view, face, place, values: place && measure(place.face, place.xi),
                  text: document.getElementById('readout').innerText};
        }, [view, face]));
      }
    return found;
  },
  // The face that the layout shows at the middle of each that fails.
  faults: (page) => page.evaluate((size) => {
    const {app, readPass} = window.majorantPage;
    const bytes = readPass('layout', 'facePass', size, size);
    return app.map.faults.map(({face}) => {
      const p = app.layout.pointAt({face, xi: [1 / 3, 1 / 3, 1 / 3]}).project(app.layout.camera);
      const [x, y] = [p.x, p.y].map((t) => Math.floor((t + 1) / 2 * size));
      const [high, middle, low] = bytes.subarray(4 * (y * size + x));
      return {face, seen: 65536 * high + 256 * middle + low - 1};
    });
  }, 1600),
  keys: walkWithKeys,
};

answer(await visit(file, options, scenes[what]));
