// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';

import {styleOf} from '../src/comparison_page/chart.js';

const style = readFileSync(new URL('../src/comparison_page.css', import.meta.url), 'utf8');

test('as many methods as there are have colours of their own, in both themes', () => {
  const methods = 13;  // number of methods of `majorant compare`
  const styles = Array.from({length: 98}, (_, index) => styleOf(index));
  const colors = new Set(styles.slice(0, methods).map(({color}) => color));
  assert.equal(colors.size, methods);
  for (const {color} of styles) {
    const values = [...style.matchAll(new RegExp(`${color.slice(4, -1)}: (#[0-9a-f]{6});`, 'g'))];
    assert.equal(values.length, 2, color);
  }
  const looks = new Set(styles.map((look) => Object.values(look).join()));
  assert.equal(looks.size, styles.length);
});
