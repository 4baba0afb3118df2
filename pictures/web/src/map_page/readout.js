// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The numbers of the place under the mouse, and of the selected one.

import {combine, singularValues} from './bezier.js';
import {byId, element} from './elements.js';
import {cornersOf, evaluate} from './map_data.js';
import {readable} from './numbers.js';
import {quadCorners} from './quads.js';
import {valuesOf} from './scales.js';

// Measures the map at a place {face, xi}, in doubles.
export function measure(app, {face, xi}) {
  const {map, uv, energy} = app;
  const q = evaluate(map, face, xi, uv);
  const [u, v] = combine(q, xi);
  const rest = map.rest.subarray(4 * face, 4 * face + 4);
  const [S, s] = singularValues(map.degree, q, rest, map.scale);
  const values = Object.fromEntries(Object.keys(app.scales).filter((name) => name !== 'difference')
      .map((name) => [name, valuesOf[name](S, s, energy)]));
  const corners = cornersOf(map, face);
  const [x, y, z] = [0, 1, 2].map((d) => corners.reduce(
      (sum, corner, c) => sum + xi[c] * map.positions[3 * corner + d], 0));
  return {face, xi, u, v, x, y, z, ...values, 'sigma-max': S, 'sigma-min': s};
}

function linesOf(app, place) {
  const {map} = app;
  const values = measure(app, place);
  const others = app.beside ? measure(app.beside, place) : null;
  const valueOf = (name) => readable(values[name], 6) +
      (others ? ` | ${readable(others[name], 6)}` : '');
  const {face} = place;
  const input = map.inputFace?.[face];
  const position = ['x y z', ['x', 'y', 'z'].map((name) => readable(values[name], 6)).join('  ')];
  if (map.isOfElements) return [['element', String(input)], position];
  if (map.isOfQuads) {
    const {deviation, jacobian} = map.quads[input];
    const corners = quadCorners(map, face).map((corner) => readable(map.inputVertex[corner]));
    return [['quad', readable(input)],
            ...(map.chart ? [['patch', readable(map.chart[face])]] : []),
            position, ['angles off', `${readable(deviation, 4)}\u00b0`],
            ['scaled Jacobian', readable(jacobian, 4)], ['vertices', corners.join('  ')]];
  }
  const lines = [['face', readable(face)]];
  if (input !== undefined && input !== face) lines.push(['of the input', readable(input)]);
  if (map.chart) lines.push(['chart', readable(map.chart[face])]);
  if (others) lines.push(['', 'A | B']);
  lines.push(['u', valueOf('u')], ['v', valueOf('v')]);
  lines.push(position);
  for (const name of ['sigma-max', 'sigma-min', 'area', 'angle', 'density'])
    if (name in values) lines.push([app.symbols[name], valueOf(name)]);
  if (others && 'density' in values)
    lines.push(['difference', readable(values.density - others.density, 6)]);
  const vertices = cornersOf(map, face).map((corner) => map.inputVertex?.[corner] ?? corner);
  lines.push(['vertices', vertices.map((x) => readable(x)).join('  ')]);
  const partner = app.partnerOf?.(place);
  if (partner) lines.push(['across the cut', `face ${readable(partner.place.face)}`]);
  const fault = map.faults.find((entry) => entry.face === face);
  if (fault) lines.push(['fails', fault.text]);
  return lines;
}

export class Readout {
  constructor(app) {
    this.app = app;
    this.body = element('div', {className: 'places'});
    byId('readout').append(this.body);
    app.state.watch(['hovered', 'pinned', 'frame'], () => this.write());
  }

  write() {
    const {state} = this.app;
    const column = (title, place) => {
      const list = element('dl');
      for (const [name, value] of linesOf(this.app, place))
        list.append(element('dt', {}, name), element('dd', {}, value));
      return element('div', {}, element('h2', {}, title), list);
    };
    const columns = [];
    if (state.pinned) columns.push(column('Selected', state.pinned));
    if (state.hovered) columns.push(column('Pointed at', state.hovered));
    if (columns.length === 0)
      columns.push(element('p', {className: 'note'},
                           this.app.map.isOfElements
                               ? 'Point at an element for its number; click to keep it.'
                               : `Point at a ${this.app.map.isOfQuads ? 'quad' : 'face'} for its ` +
                                   'numbers and, at a cut, for its other side; click to keep them.'));
    this.body.replaceChildren(...columns);
    const text = state.pinned ? linesOf(this.app, state.pinned).map((l) => l.join(' ')).join(', ')
                              : '';
    byId('said').textContent = text;
  }
}
