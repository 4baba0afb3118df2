// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// picture.mjs PAGE OUT.png {width, height, hash, dark, click}: writes a picture of the window;
// click: the text of a button.
import {answer, visit} from './visit.mjs';

const [page, out, options] = process.argv.slice(2).map((text) => JSON.parse(text));
answer(await visit(page, options, async (tab) => {
  for (const text of options.click ?? []) await tab.click(`button:text-is("${text}")`);
  await tab.mouse.move(0, 0);
  await tab.evaluate(() => document.activeElement?.blur());
  await tab.waitForTimeout(1000);
  await tab.screenshot({path: out});
}));
