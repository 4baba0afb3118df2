#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The numbers that decide results, with their origins: prints the tables of docs/constants.md.

What counts: in ROOMS, every `constexpr` number kName, and every number with a default in a struct
whose name ends in Rules or that is in OPTIONS. A value without a digit names another constant and
does not count; neither do those in EXEMPT, which change no digit of a result. The comment in front
of a declaration (it holds down to the next blank line or comment) or behind it says what the number
is and, after `Origin:`, where it comes from.

Fails (exit 1) on a constant without an origin and on an exemption that is not needed.

Sample runs:
  scripts/constants.py
  scripts/constants.py --write        (into docs/constants.md, between its marks)
"""
import argparse
import re
import sys
from collections import namedtuple
from pathlib import Path

ROOMS = ['framework', 'terms', 'elements', 'mesh', 'energies', 'constraints', 'parametrization/fields',
         'parametrization/cuts', 'parametrization/maps', 'parametrization/injectivity',
         'parametrization/starts', 'parametrization/scaffold', 'parametrization/packing',
         'parametrization/drive', 'parametrization/atlas', 'io', 'pictures', 'distributed']
OPTIONS = ('LineSearchOptions', 'NewtonOptions', 'LbfgsOptions', 'BarrierOptions')
# "file kName", or a file with all of its constants.
EXEMPT = {
    'distributed/processes.cpp kTag': 'a mark',
    'elements/bernstein_element.h kMidpoint': 'a mark',
    'elements/internal/bernstein.h kMaxDegree': 'size of a table',
    'elements/internal/node_lattice.cpp kMaxCorners': 'size of a table',
    'elements/internal/rounding.h kExactIntegers': 'mathematics',
    'elements/internal/rounding.h kUnitRoundoff': 'mathematics',
    'elements/internal/step_polynomial.cpp kLarge': 'range of doubles',
    'elements/internal/step_polynomial.cpp kNone': 'a mark',
    'mesh/internal/triangulate_polygon.cpp kSmall': 'how often limits are looked at',
    'parametrization/fields/cross_field.cpp kNotAligned': 'a mark',
    'parametrization/fields/cross_field.cpp kSymmetry': 'mathematics',
    'parametrization/fields/internal/field_geometry.h kQuarter': 'mathematics',
    'parametrization/injectivity/internal/box_pairs.h kLeaf': 'size of a node',
    'parametrization/injectivity/internal/check_layout.cpp kMaxContacts': 'length of a message',
    'parametrization/injectivity/internal/check_layout.cpp kMostPairsLeft': 'length of a count',
    'parametrization/injectivity/internal/curve_contact.cpp kRelativeSize': 'places in messages',
    'parametrization/injectivity/internal/curve_contact.cpp kUnasked': 'how often limits are looked at',
    'parametrization/injectivity/internal/curve_graph.h kCompositionSize': 'size of a table',
    'parametrization/injectivity/internal/curve_graph.h kSamples': 'size of a table',
    'io/internal/atomic_file.cpp kMostLinks': 'as the kernel',
    'io/internal/cut_pieces.cpp kMostNamedCells': 'length of a message',
    'io/internal/inflate.cpp kBlock': 'size of a read',
    'io/internal/inflate.cpp kGzip': 'the format',
    'io/internal/inflate.cpp kLargestRatio': 'the format',
    'io/internal/inflate.cpp kOverhead': 'the format',
    'io/internal/read_obj.cpp kMostNamed': 'length of a message',
    'mesh/internal/place_text.cpp kShown': 'length of a message',
    'mesh/internal/t_junctions.cpp kLeaf': 'size of a node',
    'io/internal/input_file.cpp kRead': 'size of a read',
    'io/internal/input_file.cpp kLongest': 'length of a message',
    'io/internal/line_cursor.cpp kMostDigits': 'mathematics',
    'io/internal/line_cursor.cpp kMostPower': 'mathematics',
    'io/internal/map_pieces.cpp kMostRefine': 'range of integers',
    'io/internal/read_stl.cpp kFacet': 'a mark',
    'io/internal/read_stl.cpp kFacetBytes': 'the format',
    'io/internal/read_stl.cpp kHeaderBytes': 'the format',
    'io/internal/read_stl.cpp kOutside': 'a mark',
    'io/internal/surface_match.cpp kNone': 'a mark',
    'io/internal/surface_match.cpp kOutside': 'a mark',
    'io/internal/surface_match.cpp kUnknown': 'a mark',
    'pictures/film.h kMostBytes': 'looks of pictures',
    'pictures/color_scale.cpp': 'looks of a picture',
    'pictures/color_scale.h kColors': 'size of a table',
    'pictures/internal/first_view.cpp': 'looks of a picture',
    'pictures/internal/legend.cpp': 'looks of a picture',
    'pictures/internal/pixel_font.h': 'looks of a picture',
    'pictures/internal/png_legend.cpp': 'looks of a picture',
    'pictures/internal/png_painter.cpp': 'looks of a picture',
    'pictures/internal/raster_scene.cpp': 'looks of a picture',
    'pictures/internal/rasterizer.cpp': 'looks of a picture',
    'pictures/internal/rasterizer.h': 'looks of a picture',
    'pictures/internal/svg_legend.cpp': 'looks of a picture',
    'pictures/internal/svg_legend.h': 'looks of a picture',
    'pictures/write_png.cpp': 'looks of a picture',
    'pictures/write_png.h': 'looks of a picture',
    'pictures/internal/svg_layout.cpp': 'looks of a picture',
    'pictures/internal/svg_layout.h': 'looks of a picture',
    'pictures/internal/svg_marks.cpp': 'looks of a picture',
    'io/internal/temporary_file.cpp kLongestExtension': 'size of a table',
    'io/internal/temporary_file.cpp kSlots': 'size of a table',
    'io/internal/tessellate_map.cpp kAlwaysSimple': 'mathematics',
    'io/map_proof.cpp kCellsPerPoll': 'how often limits are looked at',
    'pictures/write_svg.cpp': 'looks of a picture',
    'framework/energy_term.h kMaxSize': 'size of a chunk',
    'framework/energy_term.h kAlign': 'alignment',
    'framework/evaluator.cpp kParallelChunks': 'threads',
    'framework/internal/backtracking.h kGiveUp': 'an answer',
    'framework/internal/backtracking.h kHalve': 'an answer',
    'framework/internal/backtracking.h kTake': 'an answer',
    'framework/run_record.h kGrace': 'seconds',
    'framework/stop_check.h kPeriod': 'how often limits are looked at',
    'energies/detail/point_functions.h kMost': 'size of a table',
    'energies/detail/contraction_frame.h kMaxDirections': 'size of a table',
    'energies/detail/contraction_kernel.h kWidest': 'size of a batch',
    'energies/detail/isotropic.h kSmallestA': 'range of doubles',
    'energies/quadratic_penalty.h kLongestRow': 'size of a table',
    'constraints/local_injectivity.cpp kParallelElements': 'threads',
    'constraints/local_injectivity.cpp kPolledElements': 'how often limits are looked at',
    'constraints/local_injectivity.cpp kTwoPi': 'mathematics',
    'parametrization/maps/map_objective.h kLargestFactor': 'range of doubles',
    'parametrization/starts/make_seamless.cpp kNamedCones': 'length of a message',
}
PAGE = 'docs/constants.md'
BEGIN, END = '<!-- begin: scripts/constants.py -->\n', '<!-- end: scripts/constants.py -->\n'

NUMBER = r'(?:double|int|long|Index|std::size_t|std::array<(?:double|int), \d+>)'
CONSTANT = re.compile(r'^\s*(?:inline |static )*constexpr ' + NUMBER + r' (k[A-Z].*)$')
FIELD = re.compile(r'^\s+' + NUMBER + r' ([a-z]\w*(?: = |\{).*)$')
STRUCT = re.compile(r'^struct (\w+Rules|' + '|'.join(OPTIONS) + r') \{$')
ONE = re.compile(r'(\w+)\s*(?:=\s*([^,]+)|\{([^}]*)\})(?:,\s*|$)')

Constant = namedtuple('Constant', 'file name value what origin')


def statement(lines, k, first):
    """The declaration that begins with `first` in line k, on one line: (text, comment behind it)."""
    code, _, behind = first.partition('//')
    while ';' not in code:
        k += 1
        code += ' ' + lines[k].strip()
    return code.strip().rstrip(';'), behind.strip()


def constants_of(text, file):
    found, comment, struct, lines = [], [], None, text.splitlines()
    after_comment = False
    for k, line in enumerate(lines):
        started = STRUCT.match(line)
        if started or line.startswith('};'):
            struct = started[1] if started else None
        stripped = line.strip()
        if stripped.startswith('//'):
            comment = comment + [stripped[2:].strip()] if after_comment else [stripped[2:].strip()]
            after_comment = True
            continue
        after_comment = False
        if not stripped:
            comment = []
        match = CONSTANT.match(line) or (FIELD.match(line) if struct else None)
        if not match:
            continue
        code, behind = statement(lines, k, match[1])
        for name, value, braced in ONE.findall(code):
            value = value or braced
            if not re.search(r'(?<![A-Za-z_])\d', value):
                continue
            what, _, origin = (behind or ' '.join(comment)).partition('Origin:')
            full = name if name.startswith('k') else '%s.%s' % (struct, name)
            found.append(Constant(file, full, value.strip(), what.strip(), origin.strip()))
    return found


def all_constants(root):
    found = []
    for room in ROOMS:
        place = root / room
        paths = [place] if place.is_file() else sorted(p for p in place.rglob('*') if p.suffix in ('.h', '.cpp'))
        for path in paths:
            found += constants_of(path.read_text(), str(path.relative_to(root)))
    return found


def is_exempt(c):
    return c.file in EXEMPT or '%s %s' % (c.file, c.name) in EXEMPT


def faults(found):
    keys = {key for c in found for key in (c.file, '%s %s' % (c.file, c.name))}
    yield from ('%s: exempt without need' % key for key in sorted(set(EXEMPT) - keys))
    for c in found:
        if not c.origin and not is_exempt(c):
            yield '%s: %s = %s has no origin' % (c.file, c.name, c.value)


def tables(found):
    """The Markdown between the marks of the page."""
    out = []
    counted = [c for c in found if not is_exempt(c)]
    for file in dict.fromkeys(c.file for c in counted):
        out += ['### `%s`' % file, '', '| name | value | what | origin |', '|---|---|---|---|']
        for c in counted:
            if c.file == file:
                cells = ['`%s`' % c.name, '`%s`' % c.value, c.what.rstrip('.') or 'formula at the struct', c.origin.rstrip('.')]
                out.append('| %s |' % ' | '.join(cell.replace('|', '\\|') for cell in cells))
        out.append('')
    out.append('%d numbers. Not counted: %s.\n' % (len(counted), ', '.join(
        '`%s` (%s)' % (key.split()[-1], why) for key, why in EXEMPT.items())))
    return '\n'.join(out)


def page_parts(text):
    """What is in front of the tables, the tables, what is behind."""
    before, rest = text.split(BEGIN, 1)
    inside, after = rest.split(END, 1)
    return before, inside, after


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--root', type=Path, default=Path(__file__).resolve().parent.parent)
    parser.add_argument('--write', action='store_true')
    options = parser.parse_args()
    found = all_constants(options.root)
    text = tables(found)
    if options.write:
        before, _, after = page_parts((options.root / PAGE).read_text())
        (options.root / PAGE).write_text(before + BEGIN + text + END + after)
    else:
        print(text)
    wrong = list(faults(found))
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
