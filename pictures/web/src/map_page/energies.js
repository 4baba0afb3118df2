// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Densities of the energies as functions of the singular values S >= s of the Jacobian: in doubles
// for the readout, in GLSL for the pictures. Infinite at s <= 0 for energies with a barrier.

const densities = {
  'symmetric-dirichlet': {
    value: (S, s) => S * S + s * s + 1 / (S * S) + 1 / (s * s),
    glsl: 'S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s)',
  },
  'asap': {value: (S, s) => (S - s) * (S - s), glsl: '(S - s) * (S - s)', noBarrier: true},
  'mips': {value: (S, s) => S / s + s / S, glsl: 'S / s + s / S'},
  'arap': {
    value: (S, s) => (S - 1) * (S - 1) + (s - 1) * (s - 1),
    glsl: '(S - 1.0) * (S - 1.0) + (s - 1.0) * (s - 1.0)',
    noBarrier: true,
  },
  'symmetric-arap': {
    value: (S, s) => (S - 1) ** 2 + (s - 1) ** 2 + (1 / S - 1) ** 2 + (1 / s - 1) ** 2,
    glsl: '(S - 1.0) * (S - 1.0) + (s - 1.0) * (s - 1.0)' +
        ' + (1.0 / S - 1.0) * (1.0 / S - 1.0) + (1.0 / s - 1.0) * (1.0 / s - 1.0)',
  },
  'log-isometric': {
    value: (S, s) => Math.log(S) ** 2 + Math.log(s) ** 2,
    glsl: 'log(S) * log(S) + log(s) * log(s)',
  },
  'authalic': {value: (S, s) => S * s + 1 / (S * s), glsl: 'S * s + 1.0 / (S * s)'},
  'amips-exponential': {
    value: (S, s) => Math.exp(5 * (0.25 * (S / s + s / S + S * s + 1 / (S * s)) - 1)),
    glsl: 'exp(min(5.0 * (0.25 * (S / s + s / S + S * s + 1.0 / (S * s)) - 1.0), 80.0))',
  },
};

export const energyNames = Object.keys(densities);

// Parses 'symmetric-dirichlet + 0.1*asap' to [{name, weight}]; null if it is no sum of known names.
export function parseEnergy(text) {
  const summands = [];
  // The sign of an exponent, 1e+3, does not separate summands.
  for (const part of (text ?? '').split(/(?<![0-9][eE])\+/)) {
    const found = /^\s*(?:([0-9.eE+-]+)\s*\*\s*)?([a-z-]+)\s*$/.exec(part);
    if (!found || !densities[found[2]]) return null;
    const weight = found[1] === undefined ? 1 : Number(found[1]);
    if (!(weight > 0)) return null;
    summands.push({name: found[2], weight});
  }
  return summands;
}

export function densityAt(energy, S, s) {
  let sum = 0;
  for (const {name, weight} of energy) {
    if (!(s > 0) && !densities[name].noBarrier) return Infinity;
    sum += weight * densities[name].value(S, s);
  }
  return sum;
}

const glslNumber = (x) => x.toExponential(8);

export const densityGlsl = (energy) =>
    energy.map(({name, weight}) => `${glslNumber(weight)} * (${densities[name].glsl})`).join(' + ');
