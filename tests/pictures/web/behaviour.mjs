// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// behaviour.mjs SCENE FILE OPTIONS: plays one of the scenes below on a page.
import {answer, visit} from './visit.mjs';

const [what, file, options = {}] = process.argv.slice(2).map((text) => JSON.parse(text));

const settled = (page) => page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

// Lists every element that is focused by tabbing once around, and tests control by keys alone.
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
    pinned: window.majorantPage.app.state.pinned, message: document.getElementById('said').textContent,
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
  // Points at the middles of faces in both views.
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
  // Returns for each failing face the face that the layout shows at its middle, on a grid of pixels
  // finer than these faces.
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
  // Returns the texts of the page while the film shows its first map, and at its end.
  film: async (page) => {
    const texts = () => page.evaluate(() => ({
      summary: document.getElementById('summary').textContent,
      heading: document.querySelector('#facts h2').textContent,
      isPast: document.getElementById('facts').classList.contains('past'),
      ending: document.querySelector('#facts > .note').checkVisibility(),
      // The largest distance of the shown layout from the centre of the view, in halves of the
      // view.
      reach: (({app}) => Math.max(...Array.from({length: app.map.faceCount}, (_, face) => {
        const p = app.layout.pointAt({face, xi: [1, 0, 0]}).project(app.layout.camera);
        return Math.max(Math.abs(p.x), Math.abs(p.y));
      })))(window.majorantPage),
      numbers: Object.fromEntries([...document.querySelectorAll('#facts div:first-child dt')].map(
          (name) => [name.textContent, name.nextSibling.textContent])),
    }));
    const atEnd = await texts();
    await page.evaluate(() => window.majorantPage.app.state.set({frame: 0}));
    const inFilm = await texts();
    await page.evaluate(() => window.majorantPage.app.state.set({frame: null}));
    return {atEnd, inFilm, after: await texts()};
  },
  // "Save picture": counts dark pixels in the column of the slider's line and beside it, in both
  // views.
  wipe: (page) => page.evaluate(async (wipe) => {
    const {app, picture} = window.majorantPage;
    app.state.set({wipe});
    const image = new Image();
    image.src = picture();
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const pen = canvas.getContext('2d', {willReadFrequently: true});
    pen.drawImage(image, 0, 0);
    const ink = (x, y, height) => {
      const {data} = pen.getImageData(x - 1, y, 3, height);
      let dark = 0;
      for (let k = 0; k < data.length; k += 4) dark += data[k] + data[k + 1] + data[k + 2] < 300;
      return dark / height;
    };
    const head = 44 * app.stage.renderer.getPixelRatio();
    return {
      labels: [...document.querySelectorAll('#layout .wipe b')].map((b) => b.textContent),
      ink: app.stage.views.map((view) => {
        const {x, width, height, pixel} = app.stage.rectangleOf(view);
        return ink(Math.round((x + wipe * width) * pixel), head, Math.round(height * pixel));
      }),
    };
  }, options.wipe),
  // Tests that places where the layout meets itself are listed, marked and found.
  overlaps: async (page) => {
    const listed = await page.evaluate(() => document.getElementById('overlaps').innerText);
    await page.click('#overlaps button');
    return page.evaluate((listed) => {
      const {app} = window.majorantPage;
      return {listed, pinned: app.state.pinned, shown: app.state.overlaps,
              marks: app.marks.meeting.length, contacts: app.map.contacts.length,
              toggles: [...document.querySelectorAll('#toggles button')].map((b) => b.textContent),
              summary: document.getElementById('summary').textContent};
    }, listed);
  },
  keys: walkWithKeys,
};

answer(await visit(file, options, scenes[what]));
