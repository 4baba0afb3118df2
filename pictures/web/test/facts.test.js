// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Tests the line below the title of a page.

import assert from 'node:assert/strict';
import test from 'node:test';

import {summaryOf} from '../src/map_page/facts.js';

const page = (facts, faults) => ({
  facts: {status: 'invalid', ...facts}, faults, isOfElements: true, chart: [0, 0, 1, 1],
  snapshots: [], claims: {}, faceCount: 4, degree: 1,
});

test('elements of the mesh are counted, and all that fail, not those of the page', () => {
  const mesh = {checked: 3072, valid: 1698};
  assert.equal(summaryOf(page({result: {mesh}}, [{face: 0}, {face: 2}]), null),
               '3,072 elements · invalid · 1,374 elements fail');
});
