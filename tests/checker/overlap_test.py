# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests overlap and touching of straight and curved images by brute force over all pairs of triangles, and on
cells that are known to be apart."""
import random
import unittest
from fractions import Fraction

from broken_vtu import RING
from check_map import check_overlap
from continuity import join
from exact import cross
from findings import Findings
from result_map import Cell, ResultMap
from small_maps import elevated, pieces, straight, strip


class Options:
    def __init__(self, may_touch):
        self.may_touch = may_touch


def judged(small, may_touch=False):
    """Returns the findings about the image of a small map."""
    result, findings = ResultMap('vtu', small.degree), Findings()
    result.cells = [Cell(list(corners), uv, 'cell')
                    for corners, uv in zip(small.corners, small.uv)]
    keys = [cell.corners for cell in result.cells]
    edges = join(result, keys, findings)
    check_overlap(result, keys, True, edges, Options(may_touch), findings)
    return findings


def apart(one, other, strictly):
    """Returns whether an edge of two positive triangles separates them; strictly: as closed triangles."""
    for p, q in ((one, other), (other, one)):
        for k in range(3):
            nearest = max(cross(p[k], p[(k + 1) % 3], x) for x in q)
            if nearest < 0 or (nearest == 0 and not strictly):
                return True
    return False


def random_triangles():
    size = random.choice([3, 6, 20, 1000])
    triangles = []
    for _ in range(random.randint(2, 7)):
        area = 0
        while area <= 0:
            x, y = random.randint(0, size), random.randint(0, size)
            reach = max(1, size // random.choice([1, 2, 4]))
            triangle = [(x + random.randint(0, reach), y + random.randint(0, reach))
                        for _ in range(3)]
            area = cross(*triangle)
        triangles.append(triangle)
    return triangles


class Overlap(unittest.TestCase):
    def setUp(self):
        random.seed(11)

    def test_separate_triangles_against_all_pairs(self):
        seen = set()
        for _ in range(400):
            triangles = random_triangles()
            pairs = [(p, q) for k, p in enumerate(triangles) for q in triangles[:k]]
            overlap = any(not apart(p, q, strictly=False) for p, q in pairs)
            touch = any(not apart(p, q, strictly=True) for p, q in pairs)
            found = judged(pieces(triangles)).violations
            self.assertEqual('overlap' in found, overlap, triangles)
            if not overlap:
                self.assertEqual('touching' in found, touch, triangles)
                self.assertEqual(judged(pieces(triangles), True).verdict, 'ok')
            # The same triangles as curves: every decision is right.
            curved = judged(pieces(triangles, degree=2))
            if 'overlap' in curved.violations:
                self.assertTrue(overlap, triangles)
            if curved.verdict == 'ok':
                self.assertFalse(touch, triangles)
            if not touch or (overlap and 'touching' not in found):
                self.assertNotEqual(curved.verdict, 'undecided', triangles)
            seen.add((overlap, touch, curved.verdict))
        for case in ((True, True, 'bad'), (False, True, 'bad'), (False, False, 'ok')):
            self.assertIn(case, seen)

    def test_rings_whose_ends_come_close(self):
        for degree in (1, 2, 3):
            for exponent in (2, 10, 30, 50):
                for sign, word in ((1, None), (-1, 'overlap')):
                    gap = sign * Fraction(1, 2 ** exponent)
                    # A point of the end approaches the diagonal, an edge of the start, from the left.
                    end = (Fraction(5, 8), Fraction(5, 8) + gap), (-1, 1)
                    found = judged(strip(RING + [end], degree))
                    self.assertEqual(found.verdict, 'bad' if word else 'ok', (degree, exponent))
                    self.assertEqual(set(found.violations), {word} if word else set())

    def test_a_parabola_over_a_line(self):
        for gap, verdict in ((Fraction(1, 64), 'ok'), (Fraction(1, 2 ** 40), 'ok'),
                             (Fraction(-1, 2 ** 40), 'bad'), (Fraction(0), 'bad')):
            small = pieces([[(0, 0), (4, 0), (0, 4)], [(0, -2), (2, -4), (4, -2)]], 2)
            # Its upper edge, from (4, -2) to (0, -2), rises to -gap in the middle.
            small.set(1, 5, (2, 2 - 2 * gap))
            found = judged(small)
            self.assertEqual(found.verdict, verdict, gap)
            self.assertEqual('touching' in found.violations, gap == 0)

    def test_nested_loops(self):
        # A triangle in the hole of a ring does not overlap; one on the ring does.
        for degree in (1, 2):
            for corner, verdict in ((Fraction(3, 2), 'ok'), (Fraction(1, 4), 'bad')):
                ring = strip(RING + RING[:1], degree)
                last = len(ring.surface[0]) - 2
                glue = {last: 0, last + 1: 1}
                ring.corners = [tuple(glue.get(v, v) for v in c) for c in ring.corners]
                size = Fraction(1, 4)
                ring.corners.append((100, 101, 102))
                ring.uv.append([tuple(map(float, p)) for p in elevated(
                    [(corner + size, corner), (corner + 2 * size, corner),
                     (corner + size, corner + size / 2)], degree)])
                found = judged(ring)
                self.assertEqual(found.verdict, verdict, found.summary())

    def test_far_and_tiny(self):
        for scale in (1e-150, 1.0, 1e150):
            small = pieces([[(0, 0), (1, 0), (0, 1)], [(2, 0), (3, 0), (2, 1)]], bend=straight)
            small.uv = [[(x * scale, y * scale) for x, y in uv] for uv in small.uv]
            self.assertEqual(judged(small).verdict, 'ok')
            small.shift([1], (-1.5 * scale, 0))
            self.assertIn('overlap', judged(small).violations)


if __name__ == '__main__':
    unittest.main()
