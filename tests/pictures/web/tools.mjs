// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// tools.mjs SCENE FILE OPTIONS: the controls around the views of a page, and their effects.
import {createRequire} from 'node:module';
import {readFileSync} from 'node:fs';

import {answer, visit} from './visit.mjs';

const [what, file, options = {}] = process.argv.slice(2).map((text) => JSON.parse(text));

const settled = (page) => page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

const stateOf = (page) => page.evaluate(() => {
  const {app} = window.majorantPage;
  const {hovered, theme, watchers, defaults, ...state} = app.state;
  return {...state, surface: app.surface.pose(), layout: app.layout.pose(), hash: location.hash};
});

// Returns the pixels of "save picture": bytes r, g, b, a as base64, and their frame.
const saved = (page) => page.evaluate(async () => {
  const {app, picture} = window.majorantPage;
  const image = new Image();
  image.src = picture();
  await image.decode();
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [image.width, image.height];
  const pen = canvas.getContext('2d');
  pen.drawImage(image, 0, 0);
  const {data} = pen.getImageData(0, 0, image.width, image.height);
  const text = [];
  for (let at = 0; at < data.length; at += 30000)
    text.push(String.fromCharCode(...data.subarray(at, at + 30000)));
  return {width: image.width, height: image.height, bytes: btoa(text.join('')),
          views: app.stage.views.map((view) => app.stage.rectangleOf(view)),
          pixelAfter: app.stage.renderer.getPixelRatio()};
});

const scenes = {
  // Changes all settings, opens the page of the resulting address, and uses "reset".
  link: async (page) => {
    const opened = await stateOf(page);
    for (const button of await page.locator('#toggles button').all()) await button.click();
    await page.click('#squares button >> nth=1');
    await page.click('#texture button[data-value="grid"]');
    await page.selectOption('#save-size', '4');
    await page.check('#save-transparent');
    await page.click('#show button[data-value="density"]');
    await page.click('#scale .heading button');
    await page.evaluate(() => {
      const {app} = window.majorantPage;
      app.state.set({brush: [0.25, 0.75], wipe: 0.5, pinned: {face: 3, xi: [0.5, 0.25, 0.25]}});
      app.layout.move(1, 0);
      app.surface.turn(0.2, 0);
      app.layout.zoomBy(1);
      app.surface.zoomBy(1);
    });
    await page.waitForFunction(() => location.hash.includes('eye='));
    const switched = await stateOf(page);
    const other = await page.context().newPage();
    await other.goto(await page.evaluate(() => location.href));
    await other.waitForFunction(() => window.majorantPage !== undefined);
    const followed = await stateOf(other);
    await other.close();
    await page.click('#home');
    await page.waitForFunction(() => location.hash === '');
    return {opened, switched, followed, reset: await stateOf(page),
            address: await page.evaluate(() => location.href)};
  },
  // Fits colours to the map, and resets them.
  fit: async (page) => {
    await page.click('#show button[data-value="density"]');
    const shown = () => page.evaluate(() => {
      const {app} = window.majorantPage;
      return {low: app.scale.low, high: app.scale.high, range: app.state.range,
              shader: app.uniforms.uScale.value,
              ticks: app.scale.ticks.map(({label}) => label),
              labels: [...document.querySelectorAll('#scale text')].map((t) => t.textContent),
              strip: document.getElementById('legend').textContent};
    });
    const before = await shown();
    await page.click('#scale .heading button');
    const fitted = await shown();
    await page.click('#scale .heading button');
    return {before, fitted, after: await shown()};
  },
  // Returns colours of the layout at places of uv: [[u, v], ...].
  colors: (page) => page.evaluate(async ([changes, places]) => {
    const {app} = window.majorantPage;
    app.state.set(changes);
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const {layout, stage, map: {uvBounds: {center, size}}} = app;
    stage.render();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [stage.canvas.width, stage.canvas.height];
    const pen = canvas.getContext('2d', {willReadFrequently: true});
    pen.drawImage(stage.canvas, 0, 0);
    const {x, y, width, height, pixel} = stage.rectangleOf(layout);
    const corner = layout.pointAt({face: 0, xi: [1, 0, 0]});
    return places.map((uv) => {
      const p = corner.clone().set(...uv.map((t, d) => (t - center[d]) / size), 0)
          .project(layout.camera);
      const at = [x + (p.x + 1) / 2 * width, y + (p.y + 1) / 2 * height].map((t) => t * pixel);
      const [left, top] = [at[0], canvas.height - at[1]].map(Math.round);
      return [...pen.getImageData(left - 6, top - 6, 13, 13).data];
    });
  }, [options.changes ?? {}, options.places]),
  // Returns the checkerboard in both views at the middles of faces, and its values by positions or
  // by uv.
  squares: (page) => page.evaluate(async (changes) => {
    const {app, readPass} = window.majorantPage;
    app.state.set(changes);
    const size = 900;
    const bytes = Object.fromEntries(['surface', 'layout'].map(
        (view) => [view, readPass(view, 'checker', size, size)]));
    const {map, uniforms} = app;
    const width = map.uvBounds.size / uniforms.uChecker.value[0];
    return Array.from({length: map.faceCount}, (_, face) => {
      const xi = [1 / 3, 1 / 3, 1 / 3];
      const {u, v} = window.majorantPage.measure(face, xi);
      const p = app.surface.pointAt({face, xi}).multiplyScalar(app.surfaceFrame.radius);
      const at = app.state.rest ? [p.x + app.surfaceFrame.center[0], p.y + app.surfaceFrame.center[1]]
                                : [u, v];
      const parts = at.map((x) => x / width - Math.floor(x / width));
      const seen = (view) => {
        const q = app[view].pointAt({face, xi}).project(app[view].camera);
        const [x, y] = [q.x, q.y].map((t) => Math.floor((t + 1) / 2 * size));
        return bytes[view][4 * (y * size + x)];
      };
      return {clear: Math.min(...parts.flatMap((x) => [x, 1 - x])) > 0.15,
              isLight: at.reduce((sum, x) => sum + Math.floor(x / width), 0) % 2 === 0,
              surface: seen('surface'), layout: seen('layout')};
    });
  }, options.changes),
  // Opens help by "?" and by the button.
  help: async (page) => {
    const isOpen = () => page.evaluate(() => document.getElementById('help').open);
    const states = [await isOpen()];
    await page.keyboard.press('?');
    states.push(await isOpen());
    const text = await page.innerText('#help');
    await page.keyboard.press('Escape');
    states.push(await isOpen());
    await page.click('#help-open');
    states.push(await isOpen());
    return {states, text};
  },
  // Searches by number: [[kind, number], ...].
  search: async (page) => {
    const found = [];
    for (const [kind, number] of options.searches) {
      await page.selectOption('#search-kind', kind);
      await page.fill('#search-number', number);
      await page.keyboard.press('Enter');
      await settled(page);
      found.push(await page.evaluate(() => {
        const {app} = window.majorantPage;
        const {pinned} = app.state;
        return {pinned, message: document.getElementById('search-said').textContent,
                at: pinned && app.surface.onScreen(pinned), zoom: app.layout.camera.zoom};
      }));
    }
    return found;
  },
  charts: async (page) => {
    const listed = await page.innerText('#charts');
    const found = [];
    for (const button of await page.locator('#charts button').all()) {
      await button.click();
      found.push(await page.evaluate(() => {
        const {app: {map, state: {pinned}, layout}} = window.majorantPage;
        const inside = (face) => [[1, 0, 0], [0, 1, 0], [0, 0, 1]].every((xi) => {
          const p = layout.pointAt({face, xi}).project(layout.camera);
          return Math.max(Math.abs(p.x), Math.abs(p.y)) <= 1;
        });
        const chart = map.chart[pinned.face];
        const faces = [...map.chart.keys()].filter((face) => map.chart[face] === chart);
        return {chart, count: faces.length, isSeen: faces.every(inside),
                zoom: layout.camera.zoom};
      }));
    }
    return {listed, found};
  },
  // Points at an edge of a cut. Returns what the page shows of the other side, and its position.
  partner: (page) => page.evaluate((place) => {
    const {app} = window.majorantPage;
    app.state.set({hovered: place});
    const partner = app.partnerOf(place);
    const off = partner && app.surface.pointAt(partner.foot)
        .distanceTo(app.surface.pointAt(partner.place));
    return {partner, off, readout: document.getElementById('readout').innerText,
            lines: app.layout.lineList.filter(({width}) => width === 4)
                .map(({face, edge}) => [face, edge])};
  }, options.place),
  picture: async (page) => {
    await page.evaluate((changes) => window.majorantPage.app.state.set(changes), options.changes);
    await settled(page);
    return saved(page);
  },
  // Two results: views that move together, and the differences that fragments of both sides show,
  // next to those of the numbers, as positions on the scale.
  pair: (page) => page.evaluate(async () => {
    const {app} = window.majorantPage;
    const {beside} = app;
    const first = app.state.show;
    app.state.set({show: 'difference'});
    // For the first views: the distance between the caption and the highest corner, in pixels.
    const above = app.stage.views.map((view) => {
      const {bottom} = view.element.querySelector('.caption').getBoundingClientRect();
      const box = view.element.getBoundingClientRect();
      const highest = Math.max(...Array.from({length: app.map.faceCount}, (_, face) =>
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((xi) => view.pointAt({face, xi}).project(view.camera).y))
        .flat());
      return box.top + (1 - highest) / 2 * box.height - bottom;
    });
    app.surface.turn(0.3, 0.1);
    app.surface.controls.dispatchEvent({type: 'change'});
    beside.layout.move(1, 0);
    beside.layout.controls.dispatchEvent({type: 'change'});
    const poses = {surface: [app, beside].map(({surface}) => surface.pose()),
                   layout: [app, beside].map(({layout}) => layout.pose())};
    app.goHome();
    const size = 700;
    const scale = app.scale;
    const sides = [app, beside].map((side) => {
      const bytes = app.stage.readPass(side.layout, 'quantityPass', size, size);
      return Array.from({length: app.map.faceCount}, (_, face) => {
        const place = {face, xi: [1 / 3, 1 / 3, 1 / 3]};
        const q = side.layout.pointAt(place).project(side.layout.camera);
        const [x, y] = [q.x, q.y].map((t) => Math.floor((t + 1) / 2 * size));
        const [high, low] = bytes.subarray(4 * (y * size + x));
        return (256 * high + low) / 65535;
      });
    });
    const positions = Array.from({length: app.map.faceCount}, (_, face) => {
      const [a, b] = [app, beside].map((side) => window.majorantPage.measureOf(
          side, {face, xi: [1 / 3, 1 / 3, 1 / 3]}).density);
      return scale.position(a - b);
    });
    app.state.set({hovered: {face: 5, xi: [0.2, 0.3, 0.5]}});
    return {poses, sides, positions, above, show: first, ends: [scale.low, scale.high],
            views: document.querySelectorAll('.view').length, heading: document.title,
            readout: document.getElementById('readout').innerText,
            marked: [app, beside].map(({uniforms}) => uniforms.uHovered.value)};
  }),
  // Returns the findings of axe-core, and whether the strip of colours is in sight.
  axe: async (page) => {
    const path = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
    await page.evaluate(readFileSync(path, 'utf8'));
    if (options.open) await page.click(options.open);
    return page.evaluate(async (changes) => {
      window.majorantPage?.app.state?.set(changes);
      const {violations, passes} = await window.axe.run();
      const strip = document.getElementById('legend')?.getBoundingClientRect();
      return {passes: passes.length, strip: strip && [strip.top, strip.bottom, innerHeight],
              overflow: document.documentElement.scrollWidth - innerWidth,
              violations: violations.map(({id, nodes}) =>
                  `${id}: ${nodes.map(({html}) => html).join(' ')}`)};
    }, options.changes ?? {});
  },
};

answer(await visit(file, options, scenes[what]));
