// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Lists keys and gestures, on "?".

import {byId, element} from './elements.js';

const groups = [
  ['Mouse', [
    ['drag', 'turn the surface, move the layout'],
    ['wheel', 'zoom to the pointer'],
    ['click', 'keep the numbers of a face; again: let go'],
    ['double click', 'turn and zoom both views to it'],
    ['drop an image', 'lay it on the map'],
    ['drag, histogram', 'show only these values'],
  ]],
  ['Fingers', [
    ['one', 'scrolls the page; a tap selects'],
    ['two', 'turn or move, and zoom'],
  ]],
  ['Keys in a view', [
    ['arrows', 'turn the surface, move the layout'],
    ['+ \u2212 0', 'zoom; back to the first view'],
    ['Enter', 'select the face in the middle'],
    ['Shift and arrows', 'to the neighbour, across cuts too'],
    ['f', 'turn and zoom both views to it'],
    ['Escape', 'select nothing'],
  ]],
  ['Anywhere', [
    ['?', 'this'],
    ['straight', 'the slider lays the straight map of the same corners over the left part'],
    ['address', 'holds all that is switched: copy it to show what you see'],
  ]],
];

export function addHelp() {
  const dialog = byId('help');
  for (const [title, rows] of groups)
    dialog.querySelector('div').append(element('section', {}, element('h3', {}, title),
        element('dl', {}, ...rows.flatMap(
            ([what, does]) => [element('dt', {}, what), element('dd', {}, does)]))));
  byId('help-open').addEventListener('click', () => dialog.showModal());
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  document.addEventListener('keydown', (event) => {
    const isText = event.target.closest?.('input[type="text"], input[inputmode], select, textarea');
    if (event.key !== '?' || isText || dialog.open) return;
    event.preventDefault();
    dialog.showModal();
  });
}
