// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Bundles the pages into dist/, which is committed: building the command needs no npm.
//   npm ci && npm run build
import {build} from 'esbuild';

await build({
  entryPoints: {
    comparison_page: 'src/comparison_page/main.js',
    map_page: 'src/map_page/main.js',
  },
  outdir: process.argv[2] ?? 'dist',
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  charset: 'ascii',
  legalComments: 'eof',
  logLevel: 'warning',
});
