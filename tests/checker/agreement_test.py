# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the checker with the independent tools of ../shared: positivity and overlap of OBJ files with
layout.py, of VTU files with verify.py."""
import contextlib
import io
import json
import os
import runpy
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
MAPS = os.path.join(HERE, '..', 'data', 'maps')
TOOLS = os.path.join(os.environ.get('MAJORANT_SHARED_DIR', os.path.join(HERE, '..', '..', '..',
                                                                        'shared')), 'tools')

import check_map
from vtu_file import Unreadable

# The files on which the checker and the tools differ, each with the reason.
DIFFERENT = {
    'broken/rational_by_attribute_3.vtu': 'verify.py reads the cells as polynomial',
    'broken/infinite.obj': 'layout.py reads decimals, for which 1e400 is a number',
    'good/equal_weights_2.vtu': 'verify.py refuses all weights',
    'broken/lagrange_bulging_2.vtu': 'verify.py knows no Lagrange cells',
    'broken/lagrange_torn_3.vtu': 'verify.py knows no Lagrange cells',
    'good/lagrange_2.vtu': 'verify.py knows no Lagrange cells',
    'good/lagrange_3.vtu': 'verify.py knows no Lagrange cells',
    'good/lagrange_4.vtu': 'verify.py knows no Lagrange cells',
    'broken/half_of_a_quad_twice_1.vtu': 'verify.py does not read the quad of its surface',
}
# Files that verify.py calls not injective in the plane, although the checker finds no overlap.
MORE_CONTACTS = {
    'broken/torn_edge_by_one_ulp_3.vtu': 'two curves one ulp apart: the checker cannot decide',
    'broken/torn_lens_2.vtu': 'a cut whose two ends close again: one point of the surface each',
    'broken/missing_face_1.vtu': 'the hole meets the boundary in a vertex of the surface',
    'broken/missing_face_3.vtu': 'the hole meets the boundary in a vertex of the surface',
    'broken/mirrored_cell_1.vtu': 'as if the mirrored cell were missing',
    'broken/mirrored_cell_4.vtu': 'as if the mirrored cell were missing',
    'broken/doubled_cell_elsewhere_2.vtu': 'verify.py welds the doubled edges; not judged here',
    'broken/not_flat_2.vtu': 'verify.py tells edges apart by their points in space',
    'good/positive_by_one_ulp_1.vtu': 'thinner than the rounding of verify.py',
    'good/apart_by_one_ulp_1.vtu': 'closer than the rounding of verify.py',
    'good/positive_valley_3.vtu': 'x depends on one parameter, y grows with the other: it is '
                                  'injective; verify.py reports a winding that it is not',
}


def where(name):
    """Returns a decorator that skips a test if a tool of ../shared is missing, as in a clone."""
    return unittest.skipUnless(os.path.exists(os.path.join(TOOLS, name)), 'no ../shared/tools/' + name)


def run_tool(name, *arguments):
    """Runs a tool in this process, since its imports take longer than its work. Returns (exit code, stdout)."""
    out, before = io.StringIO(), sys.argv
    sys.argv = [name] + list(arguments)
    sys.path.append(TOOLS)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            runpy.run_path(os.path.join(TOOLS, name), run_name='__main__')
        code = 0
    except SystemExit as end:
        code = 1 if isinstance(end.code, str) else end.code or 0
    except Exception as error:  # the tool fails on an unexpected input: counts as a refusal
        code = repr(error)
    finally:
        sys.path.remove(TOOLS)
        sys.argv = before
    return code, out.getvalue()


class Agreement(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(os.path.join(MAPS, 'index.json')) as file:
            cls.index = json.load(file)

    def files(self, extension):
        """Yields (path, entry, words) of every file; words: the checker's findings with --overlap, None for
        an unreadable file."""
        for path, entry in self.index.items():
            if not path.endswith(extension) or path in DIFFERENT:
                continue
            arguments = [os.path.join(MAPS, path), '--overlap'] + entry['options']
            if entry['surface']:
                arguments += ['--surface', self.surface(entry)]
            try:
                findings = check_map.check(arguments[0], check_map.parse(arguments))
                words = set(findings.violations)
            except Unreadable:
                words = None
            yield path, entry, words

    def surface(self, entry):
        return os.path.join(MAPS, 'surfaces', entry['surface'] + '.obj')

    @where('layout.py')
    def test_obj_files_with_layout(self):
        count = 0
        for path, _, words in self.files('.obj'):
            with self.subTest(path):
                plain, _ = run_tool('layout.py', os.path.join(MAPS, path))
                overlap, printed = run_tool('layout.py', os.path.join(MAPS, path), '--overlap')
                if words is None:
                    self.assertNotEqual(plain, 0)
                    continue
                self.assertEqual('positivity' in words, plain != 0, printed)
                self.assertEqual(bool({'positivity', 'overlap'} & words), overlap != 0, printed)
                count += 1
        self.assertGreater(count, 25)

    @where('verify.py')
    def test_vtu_files_with_verify(self):
        count = 0
        for path, entry, words in self.files('.vtu'):
            with self.subTest(path):
                arguments = [os.path.join(MAPS, path), '--no-energy', '--cuts', 'auto']
                if entry['surface']:
                    arguments += ['--mesh', self.surface(entry)]
                code, printed = run_tool('verify.py', *arguments)
                if words is None:
                    self.assertNotEqual(code, 0)
                    continue
                self.compare_with_verify(path, words, json.loads(printed))
                count += 1
        self.assertGreater(count, 50)

    def compare_with_verify(self, path, words, found):
        self.assertEqual('positivity' not in words, found['ok']['det_positive'])
        if 'positivity' in words:
            return  # the boundary of an image with folds cannot be judged
        self.assertEqual('angles' not in words, found['ok']['angle_sums'])
        if found['global_injectivity']['globally_injective']:
            self.assertFalse({'overlap', 'touching'} & words, words)
        elif path not in MORE_CONTACTS:
            self.assertTrue({'overlap', 'touching', 'angles'} & words, words)


if __name__ == '__main__':
    unittest.main()
