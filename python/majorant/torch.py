# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Solutions as differentiable functions of PyTorch: `import majorant.torch`. Only this module needs torch."""
from __future__ import annotations

from typing import Any, Mapping

import torch  # type: ignore

from ._framework import Problem
from ._terms import Term


class _Minimum(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, problem: Problem, x0: Any, options: dict[str, Any], terms: list[Term],  # type: ignore
                b: Any, *data: Any) -> Any:
        if b is not None:
            problem.set_right_hand_sides(b.detach().numpy())
        for term, numbers in zip(terms, data):
            problem.update(term, data=numbers.detach().numpy())
        ctx.solution, ctx.terms, ctx.has_b = problem.minimize(x0, **options), terms, b is not None
        return torch.from_numpy(ctx.solution.x.copy())

    @staticmethod
    def backward(ctx: Any, slope: Any) -> tuple[Any, ...]:  # type: ignore
        d = ctx.solution.adjoint(slope.numpy())
        return (None, None, None, None, torch.from_numpy(d.b) if ctx.has_b else None,
                *(torch.from_numpy(d.parameters[term]) for term in ctx.terms))


def minimize(problem: Problem, x0: Any, *, b: Any = None, data: Mapping[Term, Any] | None = None,
             **options: Any) -> Any:
    """Returns x of `problem.minimize(x0, **options)` as a tensor with derivatives by b, the right-hand sides of
    `Problem.constrain`, and by the data of terms, {term: tensor}. Tensors are float64 on the CPU."""
    given = dict(data or {})
    return _Minimum.apply(problem, x0, options, list(given), b, *given.values())
