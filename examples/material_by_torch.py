# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""How stiff a sheet of cloth is and how it resists bending, found by PyTorch from how it hangs.

Sample run (needs python3-torch): PYTHONPATH=build/release/python python3 examples/material_by_torch.py
"""
import numpy as np
import torch

import majorant
import majorant.torch

N, NODES = 8, np.arange(64).reshape(8, 8)


def runs(count):
    """Nodes that follow each other, in both directions."""
    return np.concatenate([np.stack([grid[:, k:N - count + 1 + k] for k in range(count)], -1).reshape(-1, count)
                           for grid in (NODES, NODES.T)])


def stretch(z, e, stiffness):
    return stiffness[0] * (((z[:, 3:] - z[:, :3]) ** 2).sum(1) - 1) ** 2


def bend(z, e, stiffness):
    return stiffness[0] * ((z[:, :3] - 2 * z[:, 3:6] + z[:, 6:]) ** 2).sum(1)


springs = majorant.element_term(runs(2), stretch, block=3, data=[1.0], name='springs')
hinges = majorant.element_term(runs(3), bend, block=3, data=[1.0], name='hinges')
held = (3 * NODES[:, [0, -1]].reshape(-1, 1) + np.arange(3)).ravel()
flat = np.stack([NODES % N, NODES // N, 0 * NODES], -1).reshape(-1).astype(float)
weight = np.tile([0, 0, 0.05], N * N)
problem = majorant.Problem(3 * N * N).add(springs).add(hinges).add(majorant.linear_term(weight))
problem.constrain(np.eye(3 * N * N)[held], flat[held])


def hanging(logarithms):
    numbers = torch.exp(logarithms)
    return majorant.torch.minimize(problem, flat, data={springs: numbers[:1], hinges: numbers[1:]})


truth = torch.tensor([3.0, 0.2], dtype=torch.float64)
seen = hanging(torch.log(truth))
material = torch.zeros(2, dtype=torch.float64, requires_grad=True)
descent = torch.optim.LBFGS([material], max_iter=60, line_search_fn='strong_wolfe', tolerance_grad=1e-10)


def misfit():
    descent.zero_grad()
    value = ((hanging(material) - seen) ** 2).sum()
    value.backward()
    return value


descent.step(misfit)
found = torch.exp(material).detach()
print('stiffness and bending:', found.tolist(), 'sought were', truth.tolist())
assert torch.allclose(found, truth, rtol=1e-3)
