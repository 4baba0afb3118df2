// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// gestures.mjs SCENE FILE OPTIONS: gestures by mouse, fingers and files.
import {readFileSync} from 'node:fs';

import {answer, visit} from './visit.mjs';

const [what, file, options = {}] = process.argv.slice(2).map((text) => JSON.parse(text));
const kSize = 240;

const settled = (page) => page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

const boxOf = (page, selector) => page.evaluate((selector) => {
  const {left, top, width, height} = document.querySelector(selector).getBoundingClientRect();
  return {left, top, width, height};
}, selector);

// Reads passes of a view: bytes r, g, b, a in base64, since the browser's connection takes seconds
// for lists of numbers.
const read = (page, view, names) => page.evaluate(([view, names, size]) => {
  const encoded = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  return Object.fromEntries(names.map(
      (name) => [name, encoded(window.majorantPage.readPass(view, name, size, size))]));
}, [view, names, kSize]);

const stateOf = (page) => page.evaluate(() => {
  const {app} = window.majorantPage;
  const {show, texture, brush, pinned, hovered, frame} = app.state;
  return {show, texture, brush, pinned, hovered, frame, surface: app.surface.pose(),
          layout: app.layout.pose(), hash: location.hash};
});

// Returns the position of a place of a view in the window.
const placeOn = (page, view, place) => page.evaluate(([view, place]) => {
  const {app} = window.majorantPage;
  const p = app[view].pointAt(place).project(app[view].camera);
  const box = app[view].element.getBoundingClientRect();
  return [box.left + (p.x + 1) / 2 * box.width, box.top + (1 - p.y) / 2 * box.height];
}, [view, place]);

// Returns the drawing of the histogram: bars, colours of the scale, ticks, handles, in fractions of
// its width.
const drawing = (page) => page.evaluate(() => {
  const svg = document.querySelector('#scale svg');
  const number = (element, name) => Number(element.getAttribute(name));
  return {
    width: svg.viewBox.baseVal.width,
    bins: [...svg.querySelectorAll('.bin')].map((bin) => ({
      x: number(bin, 'x'), height: number(bin, 'height'),
      outside: bin.classList.contains('outside')})),
    colors: [...svg.querySelectorAll('rect[fill]')].map((rect) => ({
      x: number(rect, 'x'), width: number(rect, 'width'), fill: rect.getAttribute('fill')})),
    ticks: [...svg.querySelectorAll('.tick')].map((tick) => number(tick, 'x1')),
    labels: [...svg.querySelectorAll('text')].map((text) => ({
      x: number(text, 'x'), text: text.textContent})),
    note: document.querySelector('#scale .note').textContent,
  };
});

async function brush(page) {
  await page.click('#show button[data-value="area"]');
  await page.evaluate(() => window.majorantPage.app.state.set({edges: false}));
  await settled(page);
  const before = await drawing(page);
  await page.locator('#scale svg').scrollIntoViewIfNeeded();
  const box = await boxOf(page, '#scale svg');
  const y = box.top + 30;
  await page.mouse.move(box.left + 0.3 * box.width, y);
  await page.mouse.down();
  await page.mouse.move(box.left + 0.45 * box.width, y, {steps: 3});
  await page.mouse.move(box.left + 0.5 * box.width, y);
  await page.mouse.up();
  await settled(page);
  const brushed = {...await stateOf(page), ...await drawing(page)};
  const views = {};
  for (const view of ['surface', 'layout']) views[view] = await read(page, view,
                                                                     ['heat', 'quantityPass']);
  await page.focus('[data-handle="to"]');
  await page.keyboard.press('ArrowRight');
  const wider = await stateOf(page);
  await page.keyboard.press('Escape');
  const after = {...await stateOf(page), ...await drawing(page)};
  return {before, brushed, views, wider, after};
}

async function film(page) {
  const at = async () => ({
    ...await stateOf(page), caption: await page.textContent('#film .said'),
    slider: await page.inputValue('#film input'),
    playShown: await page.isVisible('#film button'),
    measured: await page.evaluate((places) => places.map(
        ({face, xi}) => window.majorantPage.measure(face, xi)), options.places),
    uv: (await read(page, 'surface', ['uvPass'])).uvPass,
    layout: (await read(page, 'layout', ['facePass'])).facePass,
  });
  const end = await at();
  await page.focus('#film input');
  await page.keyboard.press('Home');
  const start = await at();
  await page.keyboard.press('ArrowRight');
  const second = await at();
  await page.keyboard.press('End');
  const again = await at();
  let played = null;
  if (end.playShown) {
    await page.click('#film button');
    await page.waitForFunction(() => window.majorantPage.app.state.frame !== null);
    await page.waitForFunction(() => window.majorantPage.app.state.frame === null);
    played = {label: await page.textContent('#film button'), ...await at()};
  }
  return {end, start, second, again, played};
}

async function drop(page) {
  const give = (name, bytes) => page.evaluate(async ([name, bytes]) => {
    const files = new DataTransfer();
    files.items.add(new File([Uint8Array.from(bytes)], name));
    document.dispatchEvent(new DragEvent('drop', {dataTransfer: files, bubbles: true,
                                                  cancelable: true}));
  }, [name, bytes]);
  await give('no.png', [1, 2, 3]);
  await page.waitForSelector('#notice:not([hidden])');
  const refused = {...await stateOf(page), notice: await page.textContent('#notice')};
  await page.click('#show button[data-value="area"]');
  await give('image.png', [...readFileSync(options.image)]);
  await page.waitForFunction(() => window.majorantPage.app.state.texture === 'image');
  const taken = {...await stateOf(page), noticeShown: await page.isVisible('#notice')};
  await page.evaluate(() => window.majorantPage.app.state.set({edges: false}));
  await settled(page);
  const views = {};
  for (const view of ['surface', 'layout']) views[view] = await read(page, view,
                                                                     ['image', 'uvPass']);
  const uvFrame = await page.evaluate(() => window.majorantPage.app.map.uvBounds);
  return {refused, taken, views, uvFrame};
}

// Moves fingers; each is a list of positions, all of the same length.
async function fingers(page, tracks) {
  const session = await page.context().newCDPSession(page);
  const points = (k) => tracks.map((track, id) => ({x: track[k][0], y: track[k][1], id}));
  await session.send('Input.dispatchTouchEvent', {type: 'touchStart', touchPoints: points(0)});
  for (let k = 1; k < tracks[0].length; ++k) {
    await session.send('Input.dispatchTouchEvent', {type: 'touchMove', touchPoints: points(k)});
    await settled(page);
  }
  await session.send('Input.dispatchTouchEvent', {type: 'touchEnd', touchPoints: []});
  await settled(page);
}

async function touch(page) {
  const found = {};
  for (const view of ['surface', 'layout']) {
    const box = await boxOf(page, `#${view}`);
    const at = (x, y) => [box.left + x * box.width, box.top + y * box.height];
    const before = await stateOf(page);
    await fingers(page, [[at(0.4, 0.5), at(0.5, 0.5), at(0.6, 0.55)]]);
    const dragged = await stateOf(page);
    const hinted = await page.evaluate(
        (view) => document.getElementById(view).classList.contains('hinting'), view);
    await fingers(page, [[at(0.3, 0.5), at(0.4, 0.5), at(0.5, 0.55)],
                         [at(0.5, 0.5), at(0.6, 0.5), at(0.7, 0.55)]]);
    const turned = await stateOf(page);
    await page.click('#home');
    await fingers(page, [[at(0.45, 0.5), at(0.4, 0.5), at(0.3, 0.5)],
                         [at(0.55, 0.5), at(0.6, 0.5), at(0.7, 0.5)]]);
    const pinched = await stateOf(page);
    await page.click('#home');
    await settled(page);
    const place = {face: options.face, xi: [0.4, 0.3, 0.3]};
    await page.touchscreen.tap(...await placeOn(page, view, place));
    await settled(page);
    const tapped = await stateOf(page);
    await page.evaluate(() => window.majorantPage.app.state.set({pinned: null}));
    found[view] = {before, dragged, hinted, turned, pinched, tapped};
  }
  const box = await boxOf(page, '#layout');
  const x = box.left + box.width / 2;
  await fingers(page, [[0.8, 0.6, 0.4, 0.2].map((y) => [x, box.top + y * box.height])]);
  await page.waitForTimeout(300);
  found.scroll = await page.evaluate(() => scrollY);
  return found;
}

async function choose(page) {
  const opened = await stateOf(page);
  await page.evaluate(() => window.majorantPage.app.state.set({pinned: null}));
  const found = {opened};
  for (const view of ['surface', 'layout']) {
    const place = {face: options.face, xi: [0.2, 0.5, 0.3]};
    await page.evaluate((place) => window.majorantPage.app.focusOn(place), place);
    await page.evaluate(() => window.majorantPage.app.state.set({pinned: null}));
    await settled(page);
    const plain = (await read(page, view, ['checker'])).checker;
    const at = await placeOn(page, view, place);
    await page.mouse.click(...at);
    await settled(page);
    const clicked = {...await stateOf(page), readout: await page.innerText('#readout')};
    const marked = await read(page, view, ['checker', 'facePass']);
    await page.waitForFunction((face) => location.hash.includes(`face=${face}`), options.face);
    await page.mouse.click(...at);
    const released = await stateOf(page);
    await page.mouse.move(...at);
    await page.mouse.move(at[0] + 1, at[1]);
    await settled(page);
    const hovered = await stateOf(page);
    const pointed = (await read(page, view, ['checker'])).checker;
    await page.mouse.move(1, 1);
    await settled(page);
    found[view] = {plain, clicked, marked, released, hovered, pointed,
                   left: await stateOf(page)};
  }
  return found;
}

async function save(page) {
  await page.click('#show button[data-value="density"]');
  await settled(page);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  await download.saveAs(options.out);
  const canvas = await boxOf(page, '#canvas');
  return {name: download.suggestedFilename(), canvas};
}

// Returns the positions of fragments, and their values of every quantity; for the layout also from
// very near.
async function quantities(page) {
  const names = Object.keys(await page.evaluate(() => window.majorantPage.app.scales));
  const places = ['facePass', 'baryPass', 'uvPass'];
  const found = {};
  for (const view of ['surface', 'layout']) {
    found[view] = await read(page, view, places);
    for (const name of names) {
      await page.click(`#show button[data-value="${name}"]`);
      found[view][name] = (await read(page, view, ['quantityPass'])).quantityPass;
    }
  }
  await page.evaluate((place) => window.majorantPage.app.layout.focusOn(place), options.place);
  await page.evaluate((zoom) => window.majorantPage.app.layout.zoomBy(zoom), options.zoom);
  found.near = await read(page, 'layout', places);
  return {...found, frame: await page.evaluate(() => {
    const {map, layout} = window.majorantPage.app;
    return {...map.uvBounds, zoom: layout.camera.zoom, extent: layout.extent};
  })};
}

answer(await visit(file, options, {brush, film, drop, touch, choose, save, quantities}[what]));
