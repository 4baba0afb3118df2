# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Types of arguments and results."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from ._core import Step
    from ._densities import Density

Doubles = NDArray[np.float64]
Integers = NDArray[np.int32]
Flags = NDArray[np.bool_]
Faces = Union[ArrayLike, Sequence[ArrayLike]]
Nodes = Union[ArrayLike, Sequence[ArrayLike]]  # an array if all elements have equally many nodes
Energy = Union[str, 'Density', Sequence[tuple[Any, float]]]
Points = Mapping[int, Union[Sequence[float], Doubles, None]]
Callback = Callable[['Step'], Any]
