// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Two maps of one surface side by side: data of the second one, and linked movements. Faces of both
// have the same numbers, so that places {face, xi} are common.

import {byId, element} from './elements.js';
import {degreeName, readable} from './numbers.js';
import {extremePlaces, sampleSingularValues} from './sampling.js';
import {DifferenceScale, valuesOf} from './scales.js';

const letters = ['A', 'B'];

const captionOf = (map) => {
  const value = Number.isFinite(map.claims.value) ? ` ${readable(map.claims.value)}` : '';
  return `: ${map.title}, ${degreeName(map.degree)}, ${map.claims.energy ?? ''}${value}`;
};

// Describes the two maps in words.
export const captionsOf = (maps) => maps.map((map, side) => element('p', {className: 'said'},
    element('b', {}, letters[side]), captionOf(map)));

// Makes the scale of the difference of densities, from the range of both maps.
export function differenceScale(map, other, energy, like) {
  const places = extremePlaces(Math.max(map.degree, other.degree));
  const [a, b] = [map, other].map((one) => sampleSingularValues(one, one.uv, places));
  const values = a.S.map((S, at) => (a.s[at] > 0 && b.s[at] > 0
      ? valuesOf.difference(S, a.s[at], energy, b.S[at], b.s[at]) : NaN));
  const areas = values.map((_, at) => map.areas[Math.floor(at / a.perFace)]);
  return new DifferenceScale(like, new DifferenceScale(like, 1).fitted(values, areas)[1]);
}

// Makes a second pair of views, below the first one on narrow windows, beside it on others.
export function makeRoom(maps) {
  document.body.classList.add('pair');
  for (const id of ['surface', 'layout']) {
    const first = byId(id);
    const second = first.cloneNode(true);
    second.id = `${id}-other`;
    [first, second].forEach((view, side) => {
      view.setAttribute('aria-label', `${letters[side]}: ${view.getAttribute('aria-label')}`);
      view.append(element('span', {className: 'caption'}, element('b', {}, letters[side]),
                          element('span', {}, captionOf(maps[side]))));
    });
    byId('stage').append(second);
  }
  byId('stage').append(byId('surface'), byId('surface-other'), byId('layout'), byId('layout-other'));
}

// Moves a view when its partner is moved.
export function link(views) {
  let isFollowing = false;
  for (const [view, other] of [views, [...views].reverse()])
    view.controls.addEventListener('change', () => {
      if (isFollowing) return;
      isFollowing = true;
      other.setPose(view.pose());
      isFollowing = false;
    });
}
