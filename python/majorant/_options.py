# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks names, types and ranges of options, and converts them for the compiled module."""
from __future__ import annotations

import difflib
import json
import math
from typing import Any, Callable, Mapping

from . import _arrays, _core
from ._errors import UsageError

TOLERANCE: float = _core.defaults['tolerance']
MAX_ITERATIONS: int = _core.defaults['max_iterations']
SOFT: float = _core.defaults['soft']
PADDING: float = _core.defaults['padding']
RESOLUTION: float = _core.defaults['resolution']
LARGEST: float = _core.defaults['largest_weight']
# The measures of distortion.
QUANTITIES = ('density', 'area', 'angle', 'sigma-max', 'sigma-min')


def choice(name: str, value: Any, words: tuple[str, ...]) -> str:
    if value not in words:
        raise UsageError(f'{name}={value!r} is none of {", ".join(repr(w) for w in words)}')
    return value


def integer(name: str, value: Any, low: int, high: int) -> int:
    if isinstance(value, bool) or not hasattr(value, '__index__') or not low <= int(value) <= high:
        raise UsageError(f'{name}={value!r} is no integer from {low} to {high}')
    return int(value)


def number(name: str, value: Any, low: float, high: float = math.inf, *, zero: bool = False,
           infinite: bool = False) -> float:
    """Returns the value if it is above low (zero: or equal to it), at most high, and finite unless infinite is true."""
    try:
        x = float(value)
    except (TypeError, ValueError):
        raise UsageError(f'{name}={value!r} is no number') from None
    if not (low <= x if zero else low < x) or not x <= high or (math.isinf(x) and not infinite):
        raise UsageError(f'{name}={value!r} is no number {"from" if zero else "above"} {low:g}'
                         + (f' to {high:g}' if high < math.inf else ''))
    return x


def truth(name: str, value: Any) -> bool:
    if value not in (True, False) or not hasattr(value, '__bool__'):
        raise UsageError(f'{name}={value!r} is neither True nor False')
    return bool(value)


def callback(value: Any) -> Callable[..., Any] | None:
    if value is not None and not callable(value):
        raise UsageError(f'callback={value!r} cannot be called')
    return value


def cones(value: Any, vertices: int) -> list[tuple[int, int]]:
    if not hasattr(value, 'items'):
        raise UsageError('cones is no dictionary {vertex: quarter turns}')
    return [(integer('vertex of a cone', v, 0, vertices - 1),
             integer(f'cones[{v}]', turns, 1, 2**20)) for v, turns in value.items()]


def energies(energy: Any) -> tuple[list[tuple[Any, float]], str]:
    """Returns the summands of an energy, and its name; empty for energies without a public name."""
    if isinstance(energy, str):
        return [_summand(energy, *word) for word in _core.split_energy(energy)], energy
    if hasattr(energy, 'evaluate') and hasattr(energy, 'name'):
        return [(energy, 1.0)], ''
    try:
        pairs = [(part, weight) for part, weight in energy]
    except (TypeError, ValueError):
        raise UsageError(f'energy={energy!r} is neither a name, a Density nor a list of '
                         '(energy, weight)') from None
    summands, names = [], []
    for part, weight in pairs:
        factor = number('weight', weight, 1 / LARGEST, LARGEST, zero=True)
        inner, name = energies(part)
        summands += [(e, w * factor) for e, w in inner]
        names.append(f'{factor!r}*{name}' if name and len(inner) == 1 and '*' not in name else '')
    if not summands:
        raise UsageError('energy is an empty list')
    return summands, ' + '.join(names) if all(names) else ''


def _summand(text: str, weight: str | None, name: str) -> tuple[str, float]:
    known = [energy for energy, _ in _core.energies()]
    if name not in known:
        close = difflib.get_close_matches(name, known, 1)
        raise UsageError(f"energy={text!r}: no energy is called '{name}'; " + (
            f"did you mean '{close[0]}'?" if close else
            f"there are {', '.join(known)}, and sums like 'symmetric-dirichlet + 0.1*asap'"))
    if weight is None:
        return name, 1.0
    return name, number(f"weight of '{name}'", weight, 1 / LARGEST, LARGEST, zero=True)


def keywords(mesh: _core.Mesh, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the options of the module's solvers. arguments: the values by name; missing arguments have no
    effect."""
    vertices = len(mesh.positions)
    faces = len(mesh.polygons[1]) - 1
    get = arguments.get
    summands, text = energies(get('energy', 'symmetric-dirichlet'))
    limit = get('time_limit')
    weights = get('weights')
    out = {
        'energies': summands,
        'energy_text': text,
        'degree': integer('degree', get('degree', 1), 1, _core.max_degree),
        'boundary': choice('boundary', get('boundary', 'free'), ('free', 'fixed')),
        'boundary_angles': truth('boundary_angles', get('boundary_angles', False)),
        'bijective': truth('bijective', get('bijective', False)),
        'seamless': truth('seamless', get('seamless', False)),
        'improve_mesh': truth('improve_mesh', get('improve_mesh', False)),
        'init': choice('init', get('init', 'auto'), ('auto', 'tutte', 'multiresolution', 'input')),
        'pins': _arrays.points('pins', get('pins'), vertices),
        'handles': _arrays.points('handles', get('handles'), vertices),
        'soft': number('soft', get('soft', SOFT), 1 / LARGEST, LARGEST, zero=True),
        'weights': None if weights is None else _weights(weights, faces),
        'curvature': choice('curvature', get('curvature', 'projected'),
                            ('projected', 'majorizer', 'paper-majorizer', 'exact', 'reweighted', 'absolute', 'adaptive')),
        'elevation': choice('elevation', get('elevation', 'incremental'), ('incremental', 'direct')),
        'effort': choice('effort', get('effort', 'normal'), ('normal', 'high')),
        'tolerance': number('tolerance', get('tolerance', TOLERANCE), 0),
        'quadrature': integer('quadrature', get('quadrature', 0), 0, 10000),
        'max_iterations': integer('max_iterations', get('max_iterations', MAX_ITERATIONS), 0, 2**31 - 1),
        'time_limit': math.inf if limit is None else number('time_limit', limit, 0, zero=True, infinite=True),
        'threads': integer('threads', get('threads', 0), 0, 1024),
    }
    if any(not isinstance(e, str) for e, _ in summands):
        # The multiresolution start moves single vertices; a call of Python for each would be far too slow.
        if out['init'] == 'multiresolution':
            raise UsageError("init='multiresolution' knows energies with a name only; take 'tutte'")
        out['init'] = 'tutte' if out['init'] == 'auto' else out['init']
    if out['soft'] != SOFT and not get('handles'):
        raise UsageError('soft is the weight of handles; give handles, or leave it out')
    if out['improve_mesh'] and weights is not None:
        raise UsageError('improve_mesh changes the faces that weights are for; leave one of the two out')
    out['as_json'] = json.dumps({name: _plain(value) for name, value in arguments.items()
                                 if name not in ('callback', 'energy', 'uv', 'objects')} | {'energy': text})
    return out


def _weights(weights: Any, faces: int) -> Any:
    array = _arrays.floats('weights', weights, (faces,))
    if not ((array >= 1 / LARGEST) & (array <= LARGEST)).all():
        raise UsageError('weights are no positive numbers')
    return array


def _plain(value: Any) -> Any:
    """Returns the value for reports, or its length if it is an array."""
    if isinstance(value, (bool, int, float, str)) or value is None:
        return value if not isinstance(value, float) or math.isfinite(value) else None
    try:
        return len(value)
    except TypeError:
        return float(value) if hasattr(value, '__float__') else str(value)
