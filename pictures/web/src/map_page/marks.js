// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Lines and dots over cells: outlines, seams, cones, points, the place under the mouse.

import {cornerLocals, middleOf} from './map_data.js';
import {layoutEdges, surfaceEdges} from './neighbours.js';

// Colours of seams and charts: Okabe and Ito's, and a few similar ones.
export const tints = [
  '#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7a5195', '#6b8e23',
  '#b5651d', '#c43d5a',
];
export const kMeets = '#e6007a';  // colour of places where the layout meets itself
export const rgbOf = (hex) =>
    [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

// Returns [{face, edge, kind, number}]: kind is `boundary` of the surface, `cut` of the layout
// alone, or `seam`; number is that of the chain, or of the chart.
export function outlineEdges(map) {
  const inLayout = layoutEdges(map), onSurface = surfaceEdges(map);
  const edges = [];
  for (let face = 0; face < map.faceCount; ++face)
    for (let edge = 0; edge < 3; ++edge) {
      const chain = map.seamEdges ? map.seamEdges[3 * face + edge] : 0;
      const number = map.chart?.[face] ?? -1;
      if (chain > 0) edges.push({face, edge, kind: 'seam', number: chain - 1});
      else if (onSurface.countAt(face, edge) === 1)
        edges.push({face, edge, kind: 'boundary', number});
      else if (inLayout.countAt(face, edge) === 1) edges.push({face, edge, kind: 'cut', number});
    }
  return edges;
}

// Returns for every corner 3 times the first face that has it, plus its number in that face.
export function cornerPlaces(map) {
  const places = new Int32Array(map.cornerCount).fill(-1);
  const locals = cornerLocals(map.degree);
  for (let face = 0; face < map.faceCount; ++face)
    for (let c = 0; c < 3; ++c) {
      const corner = map.cells[face * map.size + locals[c]];
      if (places[corner] < 0) places[corner] = 3 * face + c;
    }
  return places;
}

const hexOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
export const themeColor = (name) => rgbOf(hexOf(name));

// Draws the requested marks into both views, and again when the state changes.
export class Marks {
  constructor(app) {
    this.app = app;
    this.edges = outlineEdges(app.map);
    this.places = cornerPlaces(app.map);
    app.state.watch(['seams', 'points', 'overlaps', 'square', 'theme'], () => this.drawLines());
    app.state.watch(['hovered', 'pinned'], () => this.followPartners());
    app.state.watch(['cones', 'points', 'overlaps', 'hovered', 'pinned', 'theme'],
                    () => this.drawDots());
  }

  // Returns which toggles have something to show.
  get has() {
    const {map, isDeformation} = this.app;
    const isOverlapping = map.facts.result?.globally_injective === false;
    return {
      edges: true,
      seams: this.edges.some((edge) => edge.kind !== 'boundary'),
      cones: map.cones.length > 0,
      points: map.points.length > 0,
      scaffold: map.scaffold !== null,
      square: !map.isOfQuads,
      rest: isDeformation,
      overlaps: map.contacts.length > 0 || isOverlapping,
      faults: map.faults.length > 0,
    };
  }

  placeOf(corner) {
    const place = this.places[corner];
    return {face: Math.floor(place / 3), corner: place % 3};
  }

  lineOf({face, edge, kind, number}) {
    if (kind === 'boundary') return {face, edge, width: 1, tint: themeColor('--outline')};
    const tint = kind === 'cut' && number < 0 ? themeColor('--accent')
                                              : rgbOf(tints[Math.max(0, number) % tints.length]);
    return {face, edge, width: kind === 'seam' ? 2.4 : 1.8, tint};
  }

  drawLines() {
    const {state, map, surface, layout, stage} = this.app;
    const lines = this.edges.filter((edge) => state.seams || edge.kind === 'boundary')
        .map((edge) => this.lineOf(edge));
    const targets = !state.points ? [] : map.points.flatMap(({corners, target, hold}) =>
        corners.map((corner) => ({
          ...this.placeOf(corner), edge: 3, width: 1.6, tint: this.tintOf(hold),
          target: this.framed(target),
        })));
    const meeting = this.meeting.map((place) => ({...place, width: 3.2, tint: rgbOf(kMeets)}));
    const sides = this.partners.flatMap(({here, there}) => [here, there])
        .map((side) => ({...side, width: 4, tint: themeColor('--accent')}));
    surface.setLines([...lines, ...meeting, ...sides]);
    layout.setLines([...lines, ...this.square, ...targets, ...meeting, ...sides]);
    stage.request();
  }

  // Returns uv in the frame of the layout.
  framed(uv) {
    const {center, size} = this.app.map.uvBounds;
    return uv.map((x, d) => (x - center[d % 2]) / size);
  }

  // Returns the unit square.
  get square() {
    if (!this.app.state.square) return [];
    return [[0, 0, 1, 0], [1, 0, 1, 1], [1, 1, 0, 1], [0, 1, 0, 0]].map((side) => ({
      face: 0, edge: 4, width: 1.4, tint: themeColor('--soft'), target: this.framed(side),
    }));
  }

  // Returns the cuts at the pointed and the selected place, with their other sides.
  get partners() {
    const {state: {hovered, pinned}, partnerOf} = this.app;
    return [hovered, pinned].filter(Boolean).map(partnerOf).filter(Boolean);
  }

  followPartners() {
    const key = this.partners.map(({here}) => `${here.face}/${here.edge}`).join();
    if (key === this.partnerKey) return;
    this.partnerKey = key;
    this.drawLines();
  }

  // Returns edges that meet others in the layout.
  get meeting() {
    const {state, map} = this.app;
    return state.overlaps ? map.contacts.flatMap(({places}) => places) : [];
  }

  tintOf(hold) { return hold === 'pin' ? [0.11, 0.12, 0.14] : rgbOf('#d55e00'); }

  dotAt(corner, radius, tint) {
    const {face, corner: c} = this.placeOf(corner);
    return {face, xi: [0, 1, 2].map((k) => (k === c ? 1 : 0)), radius, tint};
  }

  drawDots() {
    const {state, map, surface, layout, stage} = this.app;
    const dots = [];
    if (state.cones)
      for (const [corner, turns] of map.cones)
        dots.push(this.dotAt(corner, 4.5, rgbOf(turns < 4 ? '#0072b2' : '#009e73')));
    if (state.points)
      for (const {corners, hold} of map.points)
        for (const corner of corners) dots.push(this.dotAt(corner, 4, this.tintOf(hold)));
    for (const {face, edge} of this.meeting)
      dots.push({face, xi: middleOf(edge), radius: 5, tint: rgbOf(kMeets)});
    for (const {foot, place} of this.partners)
      for (const at of [foot, place]) dots.push({...at, radius: 4, tint: themeColor('--accent')});
    for (const place of [state.hovered, state.pinned])
      if (place) dots.push({...place, radius: 5, tint: themeColor('--accent')});
    for (const view of [surface, layout]) view.setDots(dots);
    stage.request();
  }
}
