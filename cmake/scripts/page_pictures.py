#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/pictures/page_*.png: pages of several kinds of maps, as shown by Chromium.

Sample runs:
  cmake/scripts/page_pictures.py
  cmake/scripts/page_pictures.py atlas invalid      (only these)
Needs the packages of the tests of pages, and the meshes of ../shared.
"""
import math
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
os.environ.setdefault('MAJORANT_BUILD_DIR', os.path.join(ROOT, 'build', 'release'))
MAJORANT = os.environ.get('MAJORANT_BINARY',
                          os.path.join(os.environ['MAJORANT_BUILD_DIR'], 'apps', 'majorant'))
SHARED = os.environ.get('MAJORANT_SHARED_DIR', os.path.join(ROOT, '..', 'shared'))
sys.path.insert(0, os.path.join(ROOT, 'tests', 'pictures', 'web'))
import browser

COLORS = 256  # colours of a picture, which give a third of the bytes
WIDTH = 900   # width of a picture in pixels


def majorant(*args, code=0):
    done = subprocess.run([MAJORANT, *args], stderr=subprocess.PIPE, text=True)
    if done.returncode != code:
        sys.exit(done.stderr)


def public(*names):
    return os.path.join(SHARED, 'data', 'public', *names)


def bundled(name):
    return os.path.join(ROOT, 'examples/meshes', name)


def disk(folder, page):
    majorant('parametrize', bundled('creature.obj'), '--degree', '3', '--snapshots', '2', '-o', page)
    return {}


def seamless(folder, page):
    majorant('seamless', public('closed', 'spot_1654.obj'), '--degree', '3', '-o', page)
    return {'hash': 'texture=grid'}


def atlas(folder, page):
    majorant('unwrap', public('closed', 'spot_1654.obj'), '--seams', 'sharp=40', '-o', page)
    return {'click': ['charts']}


def deformation(folder, page):
    majorant('deform', public('deform2d', 'bar.obj'), '--handles', public('deform2d', 'bar.json'),
             '--bijective', '--degree', '2', '-o', page)
    return {'click': ['angle'], 'dark': True}


def invalid(folder, page):
    """Makes the page of the creature with one vertex of its layout moved away."""
    layout = os.path.join(folder, 'creature.obj')
    majorant('parametrize', bundled('creature.obj'), '--degree', '1', '-o', layout)
    with open(layout) as f:
        lines = f.read().splitlines()
    places = {i: tuple(map(float, line.split()[1:3])) for i, line in enumerate(lines)
              if line.startswith('vt ')}
    low, high = ([f(place[k] for place in places.values()) for k in (0, 1)] for f in (min, max))
    size = high[0] - low[0]
    aim = low[0] + 0.3 * size, low[1] + 0.65 * size
    line = min(places, key=lambda i: math.dist(places[i], aim))
    lines[line] = 'vt %r %r' % (places[line][0] + 0.15 * size, places[line][1])
    with open(layout, 'w') as f:
        f.write('\n'.join(lines) + '\n')
    majorant('check', layout, '-o', page, '--certify', code=5)
    return {'click': ['area']}


def main():
    kinds = {k.__name__: k for k in (disk, seamless, atlas, deformation, invalid)}
    for name in sys.argv[1:] or kinds:
        out = os.path.join(ROOT, 'docs', 'pictures', 'page_%s.png' % name)
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, name + '.html')
            options = dict({'width': 1280, 'height': 900}, **kinds[name](folder, page))
            found = browser.run('picture.mjs', page, out, options)
        if found['surprises'] or found['requests']:
            sys.exit('%s: %s' % (name, found))
        from PIL import Image
        image = Image.open(out).convert('RGB')
        image = image.resize((WIDTH, round(WIDTH * image.height / image.width)), Image.LANCZOS)
        image.quantize(COLORS, method=Image.Quantize.MAXCOVERAGE).save(out, optimize=True)


if __name__ == '__main__':
    main()
