#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Solutions as functions of PyTorch (python3-torch), tested by its check of gradients."""
import os
import subprocess
import sys
import unittest

import helpers
import numpy as np
import pytest

try:
    import torch
except ImportError as error:
    raise unittest.SkipTest('no PyTorch (python3-torch)') from error
import majorant  # noqa: E402
import majorant.torch  # noqa: E402

N = 6
EDGES = np.stack([np.arange(N), np.arange(1, N + 1)], axis=1)


def chain():
    def stretch(z, e, length):
        d = z[:, 2:] - z[:, :2]
        return ((d ** 2).sum(1) - length[:, 0] ** 2) ** 2

    springs = majorant.element_term(EDGES, stretch, block=2, data=np.full((N, 1), 1.1))
    ends = np.zeros((4, 2 * N + 2))
    ends[range(4), [0, 1, -2, -1]] = 1
    load = np.tile([0, 0.1], N + 1)
    problem = majorant.Problem(2 * N + 2).add(springs).add(majorant.linear_term(load)).constrain(ends, [0, 0, N, 0])
    x = np.linspace(0, N, N + 1)
    return problem, springs, np.stack([x, 0.1 * x * (x - N)], 1).ravel()


def test_gradients_are_those_that_torch_finds():
    problem, springs, start = chain()
    b = torch.tensor([0, 0, N, 0.3], dtype=torch.float64, requires_grad=True)
    lengths = torch.linspace(1.05, 1.2, N, dtype=torch.float64).reshape(N, 1).requires_grad_()

    def solve(b, lengths):
        return majorant.torch.minimize(problem, start, b=b, data={springs: lengths}, tolerance=1e-14)

    assert torch.autograd.gradcheck(solve, (b, lengths), eps=1e-3, atol=2e-4, rtol=1e-3)


def test_material_that_explains_a_shape():
    problem, springs, start = chain()
    truth = np.linspace(1.05, 1.2, N).reshape(N, 1)
    seen = torch.from_numpy(problem.update(springs, data=truth).minimize(start).x)
    lengths = torch.full((N, 1), 1.1, dtype=torch.float64, requires_grad=True)
    descent = torch.optim.LBFGS([lengths], max_iter=60, line_search_fn='strong_wolfe', tolerance_change=1e-14)

    def misfit():
        descent.zero_grad()
        value = ((majorant.torch.minimize(problem, start, data={springs: lengths}) - seen) ** 2).sum()
        value.backward()
        return value

    descent.step(misfit)
    assert abs(lengths.detach().numpy() - truth).max() < 1e-3


def test_the_example_finds_its_material():
    done = subprocess.run([sys.executable, helpers.SOURCE / 'examples/material_by_torch.py'], capture_output=True,
                          text=True, env={**helpers.environment(), 'PYTHONPATH': os.pathsep.join(sys.path)})
    assert done.returncode == 0, done.stderr


def test_other_sizes_are_refused():
    problem, springs, start = chain()
    with pytest.raises(majorant.UsageError):
        majorant.torch.minimize(problem, start, b=torch.zeros(3, dtype=torch.float64))
    with pytest.raises(majorant.UsageError):
        majorant.torch.minimize(problem, start, data={springs: torch.zeros(2, dtype=torch.float64)})


if __name__ == '__main__':
    helpers.main(__file__)
