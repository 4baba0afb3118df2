// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The facts about the map as text: one line below the title, numbers, proofs, faults.

import {byId, element} from './elements.js';
import {middleOf, nameOf} from './map_data.js';
import {count, degreeName, readable} from './numbers.js';
import {captionsOf} from './pair.js';
import {extremePlaces, sampleSingularValues} from './sampling.js';
import {valuesOf} from './scales.js';

const resultNames = [
  ['value', 'energy'], ['max_density', 'largest density'], ['sigma_max', 'largest \u03c3\u2081'],
  ['sigma_min', 'smallest \u03c3\u2082'], ['min_det_bound', 'det J at least'],
  ['charts', 'charts'], ['stretch_l2', 'stretch L\u00b2'], ['stretch_linf', 'stretch L\u221e'],
  ['seam_length_relative', 'seam length'], ['fill', 'square filled'],
  ['irregular', 'irregular vertices'], ['angle_deviation', 'angles off 90\u00b0, mean'],
  ['jacobian_min', 'least scaled Jacobian'], ['jacobian_mean', 'mean scaled Jacobian'],
];

// A page of elements shows a part of the mesh: the report has the numbers of all elements and of
// failures.
const elementsOf = ({facts}) => facts.result?.mesh;
const failingCount = (map) => {
  const elements = elementsOf(map);
  return elements ? elements.checked - elements.valid : map.faults.length;
};
const failing = (map) => count(failingCount(map), ...(map.isOfElements
    ? ['element fails', 'elements fail'] : ['face fails', 'faces fail']));

const wordsOf = (status) => String(status ?? 'status').replaceAll('_', ' ');

// Describes a picture with fewer faces than the map (pictures/large_page.h).
function coarserText({faceCount, facts: {picture}}) {
  const shown = faceCount < picture.map_faces
      ? `This page shows ${readable(faceCount)} of ${count(picture.map_faces, 'face')}, as ` +
        'browsers are slow with all of them: outlines, seams and marks are complete, corners are ' +
        'at their places, and distortions are those of the triangles between them. Faces are ' +
        'numbered within this picture. '
      : '';
  const straight = picture.map_degree > 1
      ? `The map has degree ${picture.map_degree}; its edges are drawn straight. ` : '';
  return `${shown}${straight}The numbers are those of the whole map.`;
}

// frame: of the film; null: the map itself.
export function summaryOf(map, frame, other = null) {
  if (other) return `${count(map.faceCount, 'face')}, two maps of one surface`;
  const {facts} = map;
  if (map.snapshots[frame]) {
    const {iteration, degree, energy} = map.snapshots[frame];
    return [`iteration ${readable(iteration)}, ${degreeName(degree)}`,
            count(map.faceCount, 'face'), `energy ${readable(energy, 6)}`].join(' \u00b7 ');
  }
  const {picture} = facts;
  const parts = [picture
      ? `${degreeName(picture.map_degree)}, ${readable(map.faceCount)} of ` +
        `${count(picture.map_faces, 'face')} shown`
      : `${degreeName(map.degree)}, ${count(map.faceCount, 'face')}`];
  if (map.isOfElements)
    parts[0] = count(elementsOf(map)?.checked ?? new Set(map.chart).size, 'element');
  if (map.isOfQuads) parts[0] = count(map.quads.length, 'quad');
  const energy = map.claims.energy;
  const value = facts.result?.value ?? map.claims.value;
  if (energy && Number.isFinite(value)) parts.push(`${energy} ${readable(value)}`);
  else if (energy) parts.push(energy);
  if (facts.status) parts.push(wordsOf(facts.status));
  if (facts.result?.overlaps) parts.push(String(facts.result.overlaps));
  if (failingCount(map) > 0) parts.push(failing(map));
  return parts.join(' \u00b7 ');
}

function numbersOf(facts) {
  const list = element('dl');
  const {quads} = facts.result ?? {};
  const ofQuads = {...quads, jacobian_min: quads?.scaled_jacobian?.min,
                   jacobian_mean: quads?.scaled_jacobian?.mean};
  const sources = {...facts.result, ...facts.distortion, ...facts.result?.distortion, ...ofQuads};
  for (const [key, name] of resultNames)
    if (typeof sources[key] === 'number')
      list.append(element('dt', {}, name), element('dd', {}, readable(sources[key])));
  return list;
}

// Returns the numbers of a map of the film, from its control points, at the sample places of
// reports.
function numbersOfFrame({map, energy, scales}, frame) {
  const {uv, degree, energy: value} = map.snapshots[frame];
  const {S, s} = sampleSingularValues(map, uv, extremePlaces(degree));
  const most = (from, of) => from.reduce((best, _, at) => Math.max(best, of(at)), -Infinity);
  const isOver = s.some((x) => !(x > 0));
  const rows = [['energy', value]];
  if (scales.density)
    rows.push(['largest density', isOver ? Infinity
                                         : most(S, (at) => valuesOf.density(S[at], s[at], energy))]);
  rows.push(['largest \u03c3\u2081', most(S, (at) => S[at])],
            ['smallest \u03c3\u2082', -most(s, (at) => -s[at])]);
  const list = element('dl');
  for (const [name, number] of rows)
    list.append(element('dt', {}, name), element('dd', {}, readable(number)));
  return list;
}

function proofsOf(facts) {
  const parts = [];
  const answered = Object.entries(facts.result?.proofs ?? {}).filter(([, p]) => p.answer !== 'not asked');
  if (answered.length > 0) {
    const list = element('dl', {className: 'proofs'});
    for (const [question, {answer, detail}] of answered)
      list.append(element('dt', {}, question),
                  element('dd', {className: answer}, detail ? `${answer}: ${detail}` : answer));
    parts.push(element('h2', {}, 'Proofs'), list);
  }
  const details = answered.map(([question, {detail}]) => `${question}: ${detail}`);
  for (const finding of (facts.result?.findings ?? []).filter((line) => !details.includes(line)))
    parts.push(element('p', {className: 'finding'}, String(finding)));
  return parts;
}

export function writeFacts(app) {
  const {map, state} = app;
  const {facts} = map;
  const ofResult = numbersOf(facts);
  const measured = element('div', {}, element('h2', {}, 'Measured'), ofResult);
  const parts = [...proofsOf(facts)];
  if (ofResult.childElementCount > 0) parts.unshift(measured);
  if (app.other) parts.unshift(...captionsOf([map, app.other]));
  if (facts.picture)
    parts.unshift(element('p', {className: 'note', id: 'coarser'}, coarserText(map)));
  const ending = element('p', {className: 'note'}, `${wordsOf(facts.status)}: ${facts.message}`);
  if (facts.message) parts.push(ending);
  if (Object.keys(facts).length > 0)
    parts.push(element('details', {}, element('summary', {}, 'all of the report'),
                       element('pre', {tabindex: 0}, JSON.stringify(facts, null, 1))));
  byId('facts').append(...parts);
  byId('facts').hidden = parts.length === 0;
  // While the film shows a map, the numbers are those of this map. The end of the run belongs to
  // the last map, and proofs to the result.
  state.watch(['frame'], () => {
    const isResult = state.frame === null;
    byId('summary').textContent = summaryOf(map, state.frame, app.other);
    byId('facts').classList.toggle('past', !isResult);
    ending.hidden = !isResult;
    measured.replaceChildren(
        element('h2', {}, isResult ? 'Measured'
            : `Measured, iteration ${readable(map.snapshots[state.frame].iteration)}`),
        isResult ? ofResult : numbersOfFrame(app, state.frame));
  });
}

// Lists places where the layout meets itself as buttons that show them. Images of cut surfaces with
// cones usually do.
export function listOverlaps(app) {
  const {contacts, cones, facts} = app.map;
  if (contacts.length === 0 || cones.length > 0) return;
  const section = byId('overlaps');
  section.hidden = false;
  const items = contacts.map(({edges, uv, places, certain}) => {
    const [{face, edge} = {face: 0, edge: 0}] = places;
    const names = edges.map((ends) => `(${ends.join(', ')})`).join(' and ');
    const at = `near (${uv.map((x) => readable(x, 4)).join(', ')})`;
    return element('li', {}, element('button', {
      type: 'button', onclick: () => app.focusOn({face, xi: middleOf(edge)}),
    }, `edges ${names}`), ` ${certain ? 'meet' : 'may meet'} ${at}`);
  });
  const some = facts.result.boundary.contacts_complete ? '' : 'at least ';
  section.append(element('h2', {}, `Boundary edges meet: ${some}${count(contacts.length, 'pair')}`),
                 element('ul', {}, ...items));
}

const kListed = 200;

// Lists faces or elements that fail as buttons that show them.
export function listFaults(app) {
  const {faults} = app.map;
  if (faults.length === 0) return;
  const section = byId('faults');
  section.hidden = false;
  const items = faults.slice(0, kListed).map(({face, text}) => element('li', {},
      element('button', {
        type: 'button', onclick: () => app.focusOn({face, xi: [1 / 3, 1 / 3, 1 / 3]}),
      }, nameOf(app.map, face)), ` ${text.replace(/^element \d+ /, '')}`));
  section.append(element('h2', {}, failing(app.map)),
                 element('ul', {}, ...items));
  const listed = Math.min(faults.length, kListed);
  if (listed < failingCount(app.map))
    section.append(element('p', {className: 'note'}, elementsOf(app.map)
        ? `The worst ${listed} are listed, as --list says.` : `The first ${listed} are listed.`));
}
