// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Images on the map: one chosen by the user, and squares with names.

import {CanvasTexture, RepeatWrapping, Texture} from 'three';

import {byId} from './elements.js';

const kAnisotropy = 8;

// Takes images from the disk, by the button or dropped anywhere.
export function takeImages(app) {
  const {state, stage} = app;
  const input = byId('image-file');
  const take = async (file) => {
    if (!file) return;
    try {
      const image = new Texture(await createImageBitmap(file, {imageOrientation: 'flipY'}));
      image.flipY = false;
      image.wrapS = image.wrapT = RepeatWrapping;
      image.anisotropy = kAnisotropy;
      image.needsUpdate = true;
      app.image?.dispose();
      app.image = image;
      state.set({show: 'texture', texture: 'image'});
      app.layImage();
      stage.request();
      byId('notice').hidden = true;
    } catch {
      byId('notice').textContent = `${file.name} is no image that this browser reads.`;
      byId('notice').hidden = false;
    }
  };
  input.addEventListener('change', () => take(input.files[0]));
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    take(event.dataTransfer.files[0]);
  });
}

const kSquares = 10;  // squares along a side: A1 is lower left, J10 upper right
const kPixels = 2048;

// Draws squares of different hues with a name each.
export function numberedSquares() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = kPixels;
  const pen = canvas.getContext('2d');
  const side = kPixels / kSquares;
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  pen.font = `600 ${0.36 * side}px system-ui, sans-serif`;
  for (let column = 0; column < kSquares; ++column)
    for (let row = 0; row < kSquares; ++row) {
      const [x, y] = [column * side, kPixels - (row + 1) * side];
      const light = (column + row) % 2 === 0 ? 86 : 76;
      pen.fillStyle = `hsl(${36 * column} ${30 + 5 * row}% ${light}%)`;
      pen.fillRect(x, y, side, side);
      pen.fillStyle = '#26303a';
      pen.fillText('ABCDEFGHIJ'[column] + (row + 1), x + side / 2, y + side / 2);
    }
  const texture = new CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.anisotropy = kAnisotropy;
  return texture;
}
