#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every file of SHARED/data/public/bad and checks exit codes, messages and leftover files.

Valid files must end with exit 0 and a map that verify.py accepts; the others must be refused with the exit
code of interface.md, one line on stderr that names the file, no output file and no NaN. Prints a Markdown
table; exit code 0 exactly if all of it holds.

Sample runs:
  tests/campaigns/bad_inputs.py
  tests/campaigns/bad_inputs.py --degree 1 --files 'slivers|huge' --binary build/debug/apps/majorant
"""
import argparse
import re
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

VALID = 'annulus tiny_1e-9 negative_indices crlf unreferenced_vertices all_reversed single_triangle syntax_zoo ' \
        'quads_and_polygons'
HARD = 'huge_offset_1e12 slivers_1e6'
UNREADABLE = 'binary_garbage truncated face_not_a_number vertex_two_coordinates html_error_page ' \
             'index_out_of_range index_zero index_overflow nan_coordinate inf_coordinate no_faces empty ' \
             'handles_out_of_range handles_truncated'
UNSUPPORTED = 'nonmanifold_edge nonmanifold_vertex duplicate_face zero_area_face coincident_vertices ' \
              'face_repeats_vertex flipped_faces moebius triangle_soup two_components closed_surface ' \
              'torus_one_hole uv_flipped_triangle uv_not_seamless uv_missing_on_some_faces'
CONTRADICTORY = 'handles_twice'
ALLOWED = {VALID: (0,), HARD: (0, 3), UNREADABLE: (2,), UNSUPPORTED: (3,), CONTRADICTORY: (2, 3)}
EXPECTED = {stem: codes for stems, codes in ALLOWED.items() for stem in stems.split()}
TRIANGLES_ONLY = {'quads_and_polygons'}           # verify.py reads triangles only: no --mesh


def command_of(options, path):
    """Returns (mesh, flags); a handle file is used as pins on a valid mesh."""
    if path.suffix == '.json':
        return options.shared / 'data/public/disks/spot_500.obj', ['--pins', path]
    return path, []


def accepted_problems(options, path, result):
    """Returns the defects of a run with exit code 0."""
    if not result.exists():
        return ['no result file']
    mesh = None if path.stem in TRIANGLES_ONLY else path
    return ['verify: ' + name for name in common.failed_checks(common.verify(options, result, mesh))]


def refused_problems(path, done, folder):
    """Returns the defects of a refusal; the report is the only file that may remain."""
    lines = done.stderr.strip().splitlines()
    problems = [] if len(lines) == 1 else ['%d lines on stderr' % len(lines)]
    if path.name not in done.stderr:
        problems.append('message does not name the file')
    if done.stdout:
        problems.append('text on stdout')
    left = sorted(item.name for item in folder.iterdir() if item.name != 'report.json')
    return problems + (['left behind: ' + ' '.join(left)] if left else [])


def report_problems(path, done):
    """Returns the defects of the report: it must exist after exit code 0, and must be JSON without NaN."""
    if done.code != 0 and not path.exists():
        return []
    report, problem = common.load_report(path)
    return [problem] if problem else []


def examine(options, path, folder):
    """Returns a row of the table, and whether all conditions hold."""
    mesh, flags = command_of(options, path)
    result, report = folder / 'out.vtu', folder / 'report.json'
    flags += ['--degree', options.degree] if options.degree else []
    done = common.parametrize(options, mesh, [result], *flags, '--report', report)
    allowed = EXPECTED.get(path.stem, ())
    problems = [] if done.code in allowed else ['exit code']
    if done.code == 0:
        problems += accepted_problems(options, path, result)
    else:
        problems += refused_problems(path, done, folder)
    problems += report_problems(report, done)
    message = ' / '.join(done.stderr.strip().splitlines()[:3]).replace('|', '\\|')
    expected = ' or '.join(map(str, allowed)) or 'unknown file'
    return [path.name, expected, done.code, '; '.join(problems) or 'ok', message], not problems


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser, timeout=60)
    parser.add_argument('--files', default='', metavar='REGEX', help='searched in the file names')
    parser.add_argument('--degree', type=int, help="the program's own default if not given")
    return parser.parse_args()


def main():
    options = parse_arguments()
    common.require_files(options)
    folder = options.shared.resolve() / 'data/public/bad'
    paths = sorted(path for path in folder.iterdir() if path.suffix in ('.obj', '.json'))
    rows, good = [], []
    for path in (path for path in paths if re.search(options.files, path.name)):
        with tempfile.TemporaryDirectory(prefix='majorant_bad_') as place:
            row, holds = examine(options, path, Path(place))
        rows.append(row)
        good.append(holds)
    print('\n'.join(common.markdown_table(['file', 'expected', 'exit', 'checks', 'message'], rows)))
    print('\n%d of %d files as expected' % (sum(good), len(good)))
    return 0 if good and all(good) else 1


if __name__ == '__main__':
    sys.exit(main())
