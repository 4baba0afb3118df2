// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Formats numbers for readers.

// Makes 1.5e-7 of 1.5000e-7, and 1e9 of 1e+9.
const short = (text) => text.replace(/\.?0+e/, 'e').replace('e+', 'e');

export function readable(value, digits = 5) {
  if (value === null || value === undefined) return '\u2013';
  if (!Number.isFinite(value)) return value > 0 ? '\u221e' : Number.isNaN(value) ? '?' : '-\u221e';
  if (Number.isInteger(value) && Math.abs(value) < 1e9) return value.toLocaleString('en');
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) return short(value.toExponential(digits - 1));
  return String(Number(value.toPrecision(digits)));
}

const degreeNames = ['', 'linear', 'quadratic', 'cubic', 'quartic', 'quintic'];
export const degreeName = (n) => degreeNames[n] ?? `degree ${n}`;

export const count = (n, one, many = `${one}s`) => `${readable(n)} ${n === 1 ? one : many}`;

export const percent = (part) =>
    (part > 0 && part < 0.001 ? '<0.1 %' : `${Number((100 * part).toPrecision(2))} %`);
