// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// same_view.mjs PAGE {picture, eye, image, width, height}: shows the surface with its texture from
// the direction `eye`, with the size and position that it has in `picture` (a PNG of width by
// height pixels, base64): silhouettes have the same area and the same centre. Answers the page's
// picture, a PNG as data URL.
import {answer, visit} from './visit.mjs';

const [file, options] = process.argv.slice(2).map((text) => JSON.parse(text));

// Runs in the page.
async function show({picture, eye, width, height}) {
  const {app} = window.majorantPage;
  const {stage, surface, state} = app;
  document.getElementById('stage').style.cssText = `width: ${2 * width + 10}px; height: ${height}px`;
  stage.resize();
  state.set({edges: false, seams: false, cones: false});
  surface.setLines([]);
  const canvas = document.createElement('canvas');
  Object.assign(canvas, {width, height});
  const pen = canvas.getContext('2d', {willReadFrequently: true});
  const draw = (source) => {
    pen.fillStyle = '#fff';
    pen.fillRect(0, 0, width, height);
    pen.drawImage(source, 0, 0);
  };
  // Returns area and centre of the pixels that are not white.
  const silhouette = () => {
    const {data} = pen.getImageData(0, 0, width, height);
    let area = 0, x = 0, y = 0;
    for (let p = 0; p < width * height; ++p) {
      if (Math.min(data[4 * p], data[4 * p + 1], data[4 * p + 2]) > 250) continue;
      ++area;
      x += p % width;
      y += Math.floor(p / width);
    }
    return {area, x: x / area, y: y / area};
  };
  draw(await createImageBitmap(new Blob([Uint8Array.from(atob(picture), (c) => c.charCodeAt(0))])));
  const required = silhouette();
  let pose = [...eye, 0, 0, 0, 1];
  for (let step = 0; step < 5; ++step) {
    surface.setPose(pose);
    stage.render();
    draw(stage.canvas);
    const found = silhouette();
    // The target of the camera moves in the opposite direction of the surface, in the plane of the
    // picture.
    const {camera} = surface;
    const unit = (camera.top - camera.bottom) / camera.zoom / height;
    const axis = (k) => camera.matrixWorld.elements.slice(4 * k, 4 * k + 3);
    const grow = Math.sqrt(required.area / found.area);
    const middle = [width / 2 - 0.5, height / 2 - 0.5];
    const move = [found.x - middle[0] - (required.x - middle[0]) / grow,
                  (required.y - middle[1]) / grow - (found.y - middle[1])];
    const target = [0, 1, 2].map((d) => pose[3 + d] + unit * (move[0] * axis(0)[d] +
                                                              move[1] * axis(1)[d]));
    pose = [...eye, ...target, pose[6] * grow];
  }
  surface.setPose(pose);
  stage.render();
  draw(stage.canvas);
  return {picture: canvas.toDataURL(), calls: stage.drawCalls, required, found: silhouette()};
}

answer(await visit(file, {width: 2 * options.width + 200, height: 1000}, async (page) => {
  if (options.image) {
    await page.setInputFiles('#image-file', options.image);
    await page.waitForFunction(() => window.majorantPage.app.state.texture === 'image');
  }
  return page.evaluate(show, options);
}));
