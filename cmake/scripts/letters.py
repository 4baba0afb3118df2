#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes pictures/letters.txt: the outlines of DejaVu Sans for letters of PNG pictures.

Sample run:
  cmake/scripts/letters.py            (Debian: python3-fonttools, fonts-dejavu-core)

Each letter is a line: its code point, its advance, and its outline with y upwards: M, L, Q and Z as in SVG
paths, numbers in 2048ths of the font size.
"""
import os

from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FONT = '/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf'
LETTERS = [chr(c) for c in range(32, 127)]

HEADER = '''\
# SPDX-FileCopyrightText: 2003 Bitstream, Inc.
# SPDX-License-Identifier: Bitstream-Vera
#
# Outlines of DejaVu Sans (https://dejavu-fonts.github.io; the DejaVu changes are in the public domain),
# written by cmake/scripts/letters.py.
'''


class Outline(BasePen):
    def __init__(self, glyphs):
        super().__init__(glyphs)
        self.text = ''

    def add(self, verb, *points):
        self.text += verb + ' '.join('%d,%d' % p for p in points)

    def _moveTo(self, p):
        self.add('M', p)

    def _lineTo(self, p):
        self.add('L', p)

    def _qCurveToOne(self, p, q):
        self.add('Q', p, q)

    def _closePath(self):
        self.text += 'Z'


def main():
    font = TTFont(FONT)
    assert font['head'].unitsPerEm == 2048
    names, glyphs = font.getBestCmap(), font.getGlyphSet()
    lines = []
    for letter in LETTERS:
        glyph = glyphs[names[ord(letter)]]
        outline = Outline(glyphs)
        glyph.draw(outline)
        lines.append('%d %d %s' % (ord(letter), glyph.width, outline.text))
    with open(os.path.join(ROOT, 'pictures', 'letters.txt'), 'w') as f:
        f.write(HEADER + ''.join(line.rstrip() + '\n' for line in lines))


if __name__ == '__main__':
    main()
