#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares majorant/_core.pyi with the module: names and arguments; tests that the package is annotated."""
import ast
import inspect
import os
import re
import subprocess
import sys

import helpers
import pytest

import majorant
from majorant import _core

STUB = ast.parse((helpers.SOURCE / 'python/majorant/_core.pyi').read_text())
ALIASES = {target.id for node in STUB.body if isinstance(node, ast.Assign) for target in node.targets}


def functions(body):
    return {node.name: [a.arg for a in node.args.args] for node in body if isinstance(node, ast.FunctionDef)}


def public(thing):
    return {name for name in vars(thing) if not name.startswith('_')}


def arguments(function):
    """Returns the argument names in the first line of pybind11's docstring: "name(self: ..., x: int = 3) -> ..."."""
    return re.findall(r'(\w+):', re.sub(r'\[[^]]*\]', '', function.__doc__.split(') ->')[0].replace('::', '')))


def test_the_module_agrees_with_the_stub():
    classes = {node.name for node in STUB.body if isinstance(node, ast.ClassDef)}
    variables = {node.target.id for node in STUB.body if isinstance(node, ast.AnnAssign)}
    assert public(_core) == classes | set(functions(STUB.body)) | variables
    assert not ALIASES & public(_core)


@pytest.mark.parametrize('node', [n for n in STUB.body if isinstance(n, ast.ClassDef)], ids=lambda n: n.name)
def test_classes(node):
    found = getattr(_core, node.name)
    printed = functions(node.body)
    assert public(found) == set(printed) - {'__init__'}
    for name, names in printed.items():
        member = vars(found)[name]
        if isinstance(member, property):
            assert names == ['self'], name
        else:
            assert arguments(member) == names, name


@pytest.mark.parametrize('name, names', functions(STUB.body).items())
def test_functions(name, names):
    assert arguments(getattr(_core, name)) == names


@pytest.mark.parametrize('name', majorant.__all__)
def test_the_package_is_annotated(name):
    thing = getattr(majorant, name)
    members = [thing]
    if inspect.isclass(thing) and thing.__module__ != 'majorant._core':
        members = [m for n, m in vars(thing).items() if inspect.isfunction(m) and not n.startswith('_')]
        members += [m.fget for m in vars(thing).values() if isinstance(m, property)]
    for member in members:
        if inspect.isfunction(member):
            signature = inspect.signature(member)
            assert signature.return_annotation is not inspect.Signature.empty, member
            for parameter in signature.parameters.values():
                assert parameter.name == 'self' or parameter.annotation is not inspect.Parameter.empty, member


CALLER = """
import majorant, numpy as np
from numpy.typing import NDArray
V, F = majorant.read_mesh('a.obj')
uv: NDArray[np.float64] = majorant.flatten(V.tolist(), [[0, 1, 2], [0, 2, 3, 4]])
r: majorant.Map = majorant.parametrize(V, F, energy=[(majorant.Density('x', lambda J: J.sum()), 1.0)], pins={3: (0, 1)})
cells: NDArray[np.int32] = r.cells
x: NDArray[np.float64] = majorant.Problem(3).minimize([0, 1, 2.5]).x
"""
WRONG = ("majorant.flatten(V, F, 3)", "majorant.parametrize(V, F, degree='3')", "uv: str = majorant.flatten(V, F)",
         "majorant.Problem('3')", "r.cells.foo", "majorant.parametrize(object(), F)", "majorant.unwrap(V, F, energy=3)")


def test_types_are_consistent(tmp_path):
    """mypy accepts the package and correct calls, and rejects each wrong call."""
    pytest.importorskip('mypy')

    def complaints(*words):
        done = subprocess.run([sys.executable, '-m', 'mypy', '--cache-dir', tmp_path / 'cache', '--config-file', os.devnull,
                               '--ignore-missing-imports', '--no-error-summary', *words],
                              capture_output=True, text=True, cwd=tmp_path,
                              env={**helpers.environment(), 'MYPYPATH': str(helpers.SOURCE / 'python')})
        return done.stdout

    assert not complaints(helpers.SOURCE / 'python/majorant')
    lines = CALLER.strip().split('\n')
    (tmp_path / 'caller.py').write_text('\n'.join([*lines, *WRONG]) + '\n')
    found = {int(n) for n in re.findall(r'^caller.py:(\d+): error', complaints('caller.py'), re.M)}
    assert found == set(range(len(lines) + 1, len(lines) + len(WRONG) + 1))


def test_marked_as_typed():
    assert (helpers.PACKAGE / 'majorant/py.typed').exists() and (helpers.PACKAGE / 'majorant/_core.pyi').exists()


if __name__ == '__main__':
    helpers.main(__file__)
