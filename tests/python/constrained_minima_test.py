#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Problems of tests/campaigns/constrained_minima.py whose violation falls slowly, far from its minima: they are not
"infeasible", which is for stationary violations alone."""
import sys

import helpers
import pytest

sys.path.insert(0, str(helpers.SOURCE / 'tests/campaigns'))
import constrained_minima  # noqa: E402


def test_a_slow_violation_is_met():
    # Where the violation is 1.7e-5 its descents hardly lessen it, and it is not least.
    problem = constrained_minima.RandomProblem(21)
    solution = problem.solve()
    assert solution.status == 'converged' and problem.faults(solution) == []


def test_a_violation_that_is_not_least_proves_nothing():
    # SLSQP finds feasible points of this problem. The largest violation where the run ends is 0.9.
    problem = constrained_minima.RandomProblem(83)
    solution = problem.solve()
    if solution.status == 'converged':
        assert problem.faults(solution) == []
    else:
        assert solution.status == 'stalled' and 'no proof' in solution.message


@pytest.mark.parametrize('seed', [3, 9])
def test_thin_sets_are_met(seed):
    problem = constrained_minima.ThinProblem(seed)
    solution = problem.solve()
    assert solution.status == 'converged' and problem.faults(solution) == []


if __name__ == '__main__':
    helpers.main(__file__)
