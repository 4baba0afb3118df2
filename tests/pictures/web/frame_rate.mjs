// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// frame_rate.mjs PAGES {seconds, rounds, width, height}: measures the frames of pages whose views
// are rotated and moved by keys, alternating between pages. Every frame is completed by reading
// back a pixel. Answers [{page, show, view, frames, seconds, cpu}]; cpu: seconds of the browser's
// processes.
import {readFileSync, readdirSync} from 'node:fs';

import {answer, visit} from './visit.mjs';

const [pages, options] = process.argv.slice(2).map((text) => JSON.parse(text));
const kTick = 0.01;  // seconds per tick of /proc/PID/stat

// Returns the CPU seconds of all processes below this one.
function cpuSeconds() {
  const stats = new Map();
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const text = readFileSync(`/proc/${pid}/stat`, 'utf8');
      const fields = text.slice(text.lastIndexOf(')') + 2).split(' ').map(Number);
      stats.set(Number(pid), {parent: fields[1], time: kTick * (fields[11] + fields[12])});
    } catch {
      // The process has ended meanwhile.
    }
  }
  const isBelow = (pid) => pid === process.pid || (stats.has(pid) && isBelow(stats.get(pid).parent));
  return [...stats].filter(([, {parent}]) => isBelow(parent))
      .reduce((sum, [, {time}]) => sum + time, 0);
}

// Runs in the page. Returns the number of drawn frames, and their time in seconds.
async function turn({view, seconds}) {
  const gl = document.getElementById('canvas').getContext('webgl2');
  const element = document.getElementById(view);
  const pixel = new Uint8Array(4);
  const frame = (key) => new Promise((done) => {
    element.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
    requestAnimationFrame(() => {
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      done();
    });
  });
  const start = performance.now();
  let frames = 0;
  for (; performance.now() - start < 1000 * seconds; ++frames)
    await frame(frames % 2 ? 'ArrowRight' : 'ArrowLeft');
  return {frames, seconds: (performance.now() - start) / 1000};
}

async function measure(page, file) {
  // Sets the canvas to the requested size.
  await page.evaluate(([width, height]) => {
    document.getElementById('stage').style.cssText = `width: ${width}px; height: ${height}px`;
  }, [options.width, options.height]);
  const found = [];
  for (const show of ['texture', 'density']) {
    await page.click(`#show button[data-value="${show}"]`);
    for (const view of ['surface', 'layout']) {
      await page.evaluate(turn, {view, seconds: 0.5});  // until programs are compiled
      const before = cpuSeconds();
      const run = await page.evaluate(turn, {view, seconds: options.seconds});
      found.push({page: file, show, view, ...run, cpu: cpuSeconds() - before});
    }
  }
  return found;
}

const answers = [];
for (let round = 0; round < options.rounds; ++round)
  for (const file of pages) {
    const size = {width: options.width + 100, height: options.height + 400};
    const {result, surprises} = await visit(file, size, (page) => measure(page, file));
    if (surprises.length > 0) throw new Error(surprises.join('\n'));
    answers.push(...result);
  }
answer(answers);
