# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The whole numbers of quads against HiGHS, which proves the least sum (n - wanted)^2 / max(wanted, 1)."""
import json
import os
import subprocess
import tempfile
import unittest

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import coo_matrix

ROUNDING = 1e-9  # of the sum


def least_sum(instance):
    """Every number is its least one and unit steps, whose costs rise: a linear problem in whole numbers."""
    required, least, edges = (np.array(instance[key], float) for key in ('wanted', 'least', 'edges'))
    weight = 1 / np.maximum(required, 1)

    def cost(n):
        return weight * (n - required) ** 2
    known = cost(edges).sum()
    # No number of a better solution costs more than all of a known one.
    low = np.maximum(least, np.ceil(required - np.sqrt(known / weight) - 1e-9))
    high = np.maximum(low, np.floor(required + np.sqrt(known / weight) + 1e-9))
    if not (high > low).any():
        return known, cost(low).sum()
    arc = np.repeat(np.arange(len(required)), (high - low).astype(int))
    step = np.concatenate([np.arange(h - l) for h, l in zip(high, low)])
    n = low[arc] + step
    prices = weight[arc] * ((n + 1 - required[arc]) ** 2 - (n - required[arc]) ** 2)
    rows, arcs, signs = [], [], []
    for p, sides in enumerate(instance['patches']):
        for s in range(2):
            for side, sign in ((sides[s], 1), (sides[s + 2], -1)):
                rows += [2 * p + s] * len(side)
                arcs += [h // 2 for h in side]
                signs += [sign] * len(side)
    of_arcs = coo_matrix((signs, (rows, arcs)), (2 * len(instance['patches']), len(required))).tocsr()
    of_steps = coo_matrix((np.ones(len(arc)), (arc, np.arange(len(arc)))), (len(required), len(arc))).tocsr()
    found = milp(prices, constraints=LinearConstraint(of_arcs @ of_steps, -(of_arcs @ low), -(of_arcs @ low)),
                 integrality=np.ones(len(arc)), bounds=Bounds(0, 1), options={'mip_rel_gap': 0, 'time_limit': 60})
    assert found.status == 0, found.message
    numbers = low + of_steps @ np.round(found.x)
    assert not (of_arcs @ numbers).any()
    return known, cost(numbers).sum()


class Oracle(unittest.TestCase):
    def test_least_sums(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'instances')
            program = os.path.join(os.environ['MAJORANT_BUILD_DIR'], 'tests', 'quads_tests')
            subprocess.run([program, 'quantization_test.cpp'], env={**os.environ, 'MAJORANT_QUANTIZATIONS': path}, check=True,
                           stdout=subprocess.DEVNULL)
            with open(path) as file:
                instances = [json.loads(line) for line in file]
        has_public = os.path.isdir(os.path.join(os.environ.get('MAJORANT_SHARED_DATA', ''), 'closed'))
        self.assertEqual(len(instances), 22 if has_public else 4)
        for instance in instances:
            with self.subTest(instance['name']):
                ours, least = least_sum(instance)
                print('%-28s %5d arcs  sum %9.4f  least %9.4f  %+.2f %%' % (
                    instance['name'], len(instance['wanted']), ours, least, 100 * (ours / max(least, 1e-300) - 1)), flush=True)
                self.assertLessEqual(least, ours * (1 + ROUNDING) + ROUNDING)
                self.assertLessEqual(ours, least * (1 + ROUNDING) + ROUNDING)


if __name__ == '__main__':
    unittest.main()
