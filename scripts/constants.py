#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The numbers that decide results, with their origins: prints the tables of docs/constants.md.

What counts: in ROOMS, every `constexpr` kName whatever its type; every number with a default in a
struct whose name ends in Rules or Options or that is in OPTIONS, and every number that a field of
another such struct begins with there (`kept{.below = 1e-4}`); every number that a function
*_rules() assigns to a field. A value without a digit outside of strings names other constants and
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
         'parametrization/drive', 'parametrization/atlas', 'io', 'pictures', 'results', 'distributed',
         'apps/compare']
OPTIONS = ('MapObjective',)  # beside all *Rules and *Options
# "file kName", or a file with all of its constants.
EXEMPT = {
    'distributed/processes.cpp kTag': 'a mark',
    'elements/bernstein_element.h kMidpoint': 'a mark',
    'elements/internal/bernstein.h kMaxDegree': 'size of a table',
    'elements/internal/node_lattice.cpp kMaxCorners': 'size of a table',
    'framework/internal/rounding.h kExactIntegers': 'mathematics',
    'framework/internal/rounding.h kUnitRoundoff': 'mathematics',
    'elements/internal/step_polynomial.cpp kLarge': 'range of doubles',
    'elements/internal/step_polynomial.cpp kNone': 'a mark',
    'mesh/internal/triangulate_polygon.cpp kSmall': 'how often limits are looked at',
    'parametrization/fields/cross_field.cpp kNotAligned': 'a mark',
    'parametrization/fields/cross_field.cpp kSymmetry': 'mathematics',
    'parametrization/fields/internal/field_geometry.h kQuarter': 'mathematics',
    'parametrization/injectivity/internal/box_pairs.h kLeaf': 'size of a node',
    'parametrization/injectivity/global_injectivity.h kMostContacts': 'length of a message',
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
    'io/internal/repaired_match.cpp kNew': 'a mark',
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
    'elements/bezier_tetrahedron_space.cpp kEdges': 'numbering',
    'elements/bezier_tetrahedron_space.cpp kFaces': 'numbering',
    'mesh/internal/cut_shortening.cpp kNoSide': 'a mark',
    'constraints/seamless_constraint.cpp kTable': 'mathematics',
    'parametrization/starts/make_seamless.h SeamlessOptions.threads': 'threads',
    'parametrization/drive/solve_options.h SolveOptions.quadrature_points': 'a mark',
    'parametrization/drive/solve_options.h SolveOptions.threads': 'threads',
    'parametrization/maps/map_objective.h MapObjective.energy': 'mathematics',
    'framework/ceres_minimizer.h CeresOptions.scale': 'mathematics',
    'io/internal/atomic_file.cpp kNewFileMode': 'as the kernel',
    'io/internal/atomic_file.cpp kPermissions': 'as the kernel',
    'io/internal/atomic_file.cpp kOwnerOnly': 'as the kernel',
    'io/internal/base64.cpp kInvalid': 'a mark',
    'io/internal/msh_content.h kMshTriangles': 'the format',
    'io/internal/ply_header.cpp kSizes': 'the format',
    'io/vtu_read.cpp kTriangle': 'the format',
    'io/vtu_read.cpp kQuadraticTriangle': 'the format',
    'io/vtu_read.cpp kLagrangeTriangle': 'the format',
    'io/vtu_read.cpp kBezierTriangle': 'the format',
    'io/write_obj.h TessellationOptions.refine': 'mathematics',
    'pictures/color_scale.h kFlippedColor': 'looks of a picture',
    'pictures/internal/pixel_font.cpp kBox': 'looks of a picture',
    'pictures/internal/pixel_font.cpp kGlyphs': 'looks of a picture',
    'pictures/internal/png_file.cpp kLargestImage': 'size of a read',
    'elements/jacobian_net.cpp kRounding': 'mathematics',
    'results/internal/check_claims.cpp kEpsilon': 'mathematics',
    'results/internal/solver_ladder.h LadderOptions.direct_below': 'a mark',
    'distributed/internal/checkpoint_file.cpp kPrime': 'the format',
    'distributed/internal/checkpoint_file.h kNothingHashed': 'the format',
    'apps/compare/comparison_table.cpp kTextColumns': 'looks of a table',
    'apps/compare/comparison_table.h kComparisonFractions': 'what is reported',
    'apps/compare/methods.cpp kNoExactTail': 'a mark',
    'apps/compare/write_comparison.cpp kDrawnPoints': 'looks of a picture',
    'apps/compare/write_comparison.cpp kHalf': 'looks of a picture',
}
PAGE = 'docs/constants.md'
BEGIN, END = '<!-- begin: scripts/constants.py -->\n', '<!-- end: scripts/constants.py -->\n'

TYPE = r'[A-Za-z_][\w:]*(?: (?:long|int))?(?:<[^=;(]*>)?'
CONSTANT = re.compile(r'^\s*(?:inline |static )*constexpr (?:const )?(?:' + TYPE + r'[ *&]+)(k[A-Z].*)$')
FIELD = re.compile(r'^\s+(?:' + TYPE + r') ([a-z]\w*(?: = |\{).*)$')
STRUCT = re.compile(r'^struct (\w+Rules|\w+Options|' + '|'.join(OPTIONS) + r') (?:final )?\{$')
FUNCTION = re.compile(r'^\w+ (\w+_rules)\(.*\{$')
ASSIGNED = re.compile(r'^\s+\w+\.([a-z][\w.]* = .*)$')
DECLARATOR = re.compile(r'^(\.?\w[\w.]*)(?:<\w+>)?(?:\[\w*\])*\s*(?:=\s*(.+)|([{(].*[})]))$')
WORDS = re.compile(r'"[^"]*"|\'[^\']*\'')  # digits of strings count nothing

Constant = namedtuple('Constant', 'file name value what origin')


def statement(lines, k, first):
    """The declaration that begins with `first` in line k, on one line: (text, comment behind it)."""
    code, _, behind = first.partition('//')
    while ';' not in code:
        k += 1
        code += ' ' + lines[k].partition('//')[0].strip()
    return code.strip().rstrip(';'), behind.strip()


def parts(code):
    """Splits at commas that are in no brackets."""
    depth, start = 0, 0
    for k, c in enumerate(code):
        depth += (c in '{([') - (c in '})]')
        if c == ',' and depth == 0:
            yield code[start:k].strip()
            start = k + 1
    yield code[start:].strip()


def numbers_of(code):
    """(name, value) of what a declaration begins with: `kA = 1, kB = 2`, `kept{.below = 1e-4}`."""
    for part in parts(code):
        match = DECLARATOR.match(part)
        if not match or not re.search(r'(?<!\w)\d', WORDS.sub('', part[match.end(1):])):
            continue
        value = match[2] or match[3][1:-1]
        inner = value[1:-1].strip() if value.startswith('{') else value
        if inner.startswith('.'):
            yield from ((match[1] + name, number) for name, number in numbers_of(inner))
        else:
            yield match[1], value.strip()


def constants_of(text, file):
    found, comment, owner, lines = [], [], None, text.splitlines()
    after_comment = in_function = False
    for k, line in enumerate(lines):
        struct, function = STRUCT.match(line), FUNCTION.match(line)
        if struct or function:
            owner, in_function = (struct or function)[1], bool(function)
        elif line.startswith('}'):
            owner, in_function = None, False
        stripped = line.strip()
        if stripped.startswith('//'):
            comment = comment + [stripped[2:].strip()] if after_comment else [stripped[2:].strip()]
            after_comment = True
            continue
        after_comment = False
        if not stripped:
            comment = []
        match = CONSTANT.match(line) or owner and (ASSIGNED if in_function else FIELD).match(line)
        if not match:
            continue
        code, behind = statement(lines, k, match[1])
        for name, value in numbers_of(code):
            what, _, origin = (behind or ' '.join(comment)).partition('Origin:')
            full = name if name.startswith('k') and name[1:2].isupper() else '%s.%s' % (owner, name)
            found.append(Constant(file, full, value, what.strip(), origin.strip()))
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
