// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Opens a page in Debian's Chromium and records errors: messages on the console, exceptions, and
// any request except for the file itself.
//
//   const found = await visit(file, {width: 1200, height: 800}, async (page) => {
//     return page.evaluate(() => document.title);
//   });
//   // {result, surprises: [...], requests: [...]}
import {chromium} from 'playwright-core';
import {pathToFileURL} from 'node:url';

// Software rendering is the same on every machine. Services of the browser that use the network are
// disabled.
const flags = [
  '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
];

const kPatience = 120000;  // ms; the machine may be busy

// Opens a page. options: width, height, hash of the address, dark, touch, reducedMotion, flags:
// additional ones. The default window is small, since software rendering takes time for every
// pixel.
export const visit = async (file, options, act) => (await visitEach([file], options, act))[0];

// Opens several pages, one after the other, in one browser. Returns the findings of each.
export async function visitEach(files, options, act) {
  const browser = await chromium.launch({
    executablePath: process.env.MAJORANT_CHROMIUM,
    args: [...flags, ...(options.flags ?? [])],
  });
  try {
    const found = [];
    for (const file of files) found.push(await visitIn(browser, file, options, act));
    return found;
  } finally {
    await browser.close();
  }
}

async function visitIn(browser, file, options, act) {
  const context = await browser.newContext({
    viewport: {width: options.width ?? 720, height: options.height ?? 440},
    colorScheme: options.dark ? 'dark' : 'light',
    reducedMotion: options.reducedMotion ?? 'reduce',
    hasTouch: options.touch ?? false,
    acceptDownloads: true,
  });
  const page = await context.newPage();
  const url = pathToFileURL(file).href;
  const surprises = [];
  const requests = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) surprises.push(message.text());
  });
  page.on('pageerror', (error) => surprises.push(String(error.stack)));
  page.on('dialog', (dialog) => {
    surprises.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on('request', (request) => {
    const isLocal = /^(data|blob):/.test(request.url());
    if (!isLocal && request.url().split('#')[0] !== url) requests.push(request.url());
  });
  page.setDefaultTimeout(kPatience);
  await page.goto(url + (options.hash ? `#${options.hash}` : ''));
  if (!options.plain)
    await page.waitForFunction(() => window.majorantPage !== undefined);
  const result = await act(page);
  await context.close();
  return {result, surprises, requests};
}

// Returns the answer of a script to browser.py.
export const answer = (value) => process.stdout.write(JSON.stringify(value));
