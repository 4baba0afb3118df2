# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant: low-distortion, injective, piecewise polynomial maps of surfaces onto the plane.

    import majorant

    V, F = majorant.read_mesh('bunny.obj')
    uv = majorant.flatten(V, F)                          # (#V, 2), no triangle turned over
    r = majorant.parametrize(V, F, degree=3)             # a curved map, certified
    r = majorant.unwrap(V, F)                            # any mesh, cut into charts
    r.save('bunny.vtu')

Arrays are float64 and int32 in C order and are returned without copies. Solvers release the interpreter's lock,
end on Ctrl-C, and give the same bits on any number of threads. docs/python.md has examples;
help(majorant.parametrize) lists all options.
"""
from . import _core
from ._core import Step
from ._bakes import Baked, bake
from ._comparison import ComparedMethod, Comparison, compare
from ._densities import Density
from ._errors import (Error, InfeasibleError, InternalError, InvalidError, ReadError, StoppedError,
                      UnsupportedError, UsageError)
from ._exchange import mesh_arrays
from ._framework import Adjoint, Factor, Problem, Solution, Space
from ._functions import (Verdict, check, deform, energies, flatten, kernels, parametrize, read, read_mesh,
                         seamless, unwrap)
from ._maps import Map
from ._places import InverseMap, NearestPoints, Places, Preimages, SurfaceTree
from ._quads import QuadMesh, quad_mesh
from ._terms import Equality, Inequality, Term, element_term, least_squares, linear_term, parameter_blocks, penalty
from ._volumes import VolumeMesh, optimize

__version__ = _core.version
__all__ = [
    'Adjoint', 'Baked', 'ComparedMethod', 'Comparison', 'Density', 'Equality', 'Error', 'Factor', 'Inequality', 'InfeasibleError', 'InternalError', 'InvalidError', 'InverseMap', 'Map',
    'NearestPoints', 'Places', 'Preimages', 'Problem', 'QuadMesh', 'ReadError', 'Solution', 'Space', 'Step',
    'StoppedError', 'SurfaceTree', 'Term', 'UnsupportedError', 'UsageError', 'Verdict', 'VolumeMesh',
    'bake', 'check', 'compare', 'deform', 'element_term', 'energies', 'flatten', 'kernels', 'least_squares', 'linear_term',
    'mesh_arrays', 'optimize', 'parameter_blocks', 'parametrize', 'penalty', 'quad_mesh', 'read', 'read_mesh',
    'seamless', 'unwrap',
]
