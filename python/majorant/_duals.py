# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of dual numbers of second order, which carry first and second derivatives through formulas in numpy.

    x = Dual.variables(np.array([[3.0, 4.0]]))      # one point of two variables
    r = np.sqrt((x ** 2).sum(axis=1))
    r.value, r.gradient, r.hessian                  # (1,), (1, 2), (1, 2, 2)

A Dual has the shape of its value. Indices, operators, the scalar functions in _CHAIN, and the array functions in
_FUNCTIONS and _LINEAR work as on plain arrays. All others raise TypeError, AttributeError or ValueError, and so
do operations that would lose derivatives: conversion to a plain array, assignment to entries, operators like +=.

Derivatives stand before the axes of the value, so that the same entry of all points is contiguous: k first
derivatives, and the lower triangle of second derivatives, row by row, or None if all of them are 0. An axis along
which all derivatives are equal has length 1. A linear function thus stores the derivatives of one point, and a
quadratic function the second derivatives of one point. At a kink, derivatives are those of one side.
"""
from __future__ import annotations

import functools
import math
from typing import Any, Callable

import numpy as np


class Dual(np.lib.mixins.NDArrayOperatorsMixin):
    __slots__ = ('value', '_d', '_h')

    def __init__(self, value: np.ndarray, d: np.ndarray, h: np.ndarray | None):
        self.value, self._d, self._h = value, d, h

    @staticmethod
    def variables(points: np.ndarray) -> 'Dual':
        """Returns the entries of points (q, ...) as variables of each point, in C order."""
        k, axes = math.prod(points.shape[1:]), range(points.ndim - 1)
        value = np.ascontiguousarray(points.transpose(*(a + 1 for a in axes), 0)).transpose(-1, *axes)
        return Dual(value, np.eye(k).reshape(k, 1, *points.shape[1:]), None)

    @property
    def gradient(self) -> np.ndarray:
        """The first derivatives, (..., k)."""
        return np.moveaxis(_wide(self._d, self.shape), 0, -1)

    @property
    def hessian(self) -> np.ndarray:
        """The second derivatives, (..., k, k)."""
        k = len(self._d)
        out = np.zeros((*self.shape, k, k))
        if self._h is not None:
            rows, columns = np.tril_indices(k)
            out[..., rows, columns] = out[..., columns, rows] = np.moveaxis(_wide(self._h, self.shape), 0, -1)
        return out

    def write_rows(self, gradient: np.ndarray, hessian: np.ndarray) -> None:
        """Copies the gradient to (k, ...), and the lower triangle of the Hessian to (k (k + 1) / 2, ...)."""
        gradient[...] = self._d
        hessian[...] = 0 if self._h is None else self._h

    # ---- members of an array ---------------------------------------------------------------------
    @property
    def shape(self) -> tuple[int, ...]:
        return self.value.shape

    @property
    def ndim(self) -> int:
        return self.value.ndim

    @property
    def size(self) -> int:
        return self.value.size

    @property
    def dtype(self) -> np.dtype:
        return self.value.dtype

    @property
    def T(self) -> 'Dual':
        return self.transpose()

    def transpose(self, *axes: Any) -> 'Dual':
        return _each(lambda part: part.transpose(*axes), self)

    def __len__(self) -> int:
        return len(self.value)

    def __iter__(self) -> Any:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, key: Any) -> 'Dual':
        keys = key if isinstance(key, tuple) else (key,)
        if all(k is None or k is Ellipsis or isinstance(k, (int, slice, np.integer)) for k in keys):
            return self._mapped(np.asarray(self.value[keys]), lambda part: part[self._keys_of(keys, part)])
        return _each(lambda part: part[key], self)

    def _keys_of(self, keys: tuple[Any, ...], part: np.ndarray) -> tuple[Any, ...]:
        """Returns the index into the derivatives for an index into the value. Axes of length 1 are kept or dropped."""
        if part.shape[1:] == self.shape:
            return (slice(None), *keys)
        if Ellipsis in keys:
            at = keys.index(Ellipsis)
            rest = self.ndim - sum(k is not None and k is not Ellipsis for k in keys)
            keys = (*keys[:at], *(slice(None),) * rest, *keys[at + 1:])
        out: list[Any] = [slice(None)]
        axis = 0
        for k in keys:
            axis += k is not None
            one = k is not None and part.shape[axis] == 1
            out.append(k if not one else slice(None) if isinstance(k, slice) else 0)
        return tuple(out)

    def reshape(self, *shape: Any) -> 'Dual':
        value = self.value.reshape(*shape)

        def reshaped(part: np.ndarray) -> np.ndarray:
            if part.shape[1:2] == (1,) and part.shape[2:] == self.shape[1:] and value.shape[:1] == self.shape[:1]:
                return part.reshape(len(part), 1, *value.shape[1:])
            return _thin(_wide(part, self.shape).reshape(len(part), *value.shape))
        return self._mapped(value, reshaped)

    def sum(self, axis: Any = None, keepdims: bool = False) -> 'Dual':
        axes = _axes(axis, self.ndim)

        def total(part: np.ndarray) -> np.ndarray:
            equal = math.prod(self.shape[a] for a in axes if part.shape[a + 1] == 1)
            out = part.sum(axis=tuple(a + 1 for a in axes), keepdims=keepdims)
            return out if equal == 1 else equal * out
        return self._mapped(np.asarray(self.value.sum(axis=axis, keepdims=keepdims)), total)

    def mean(self, axis: Any = None, keepdims: bool = False) -> 'Dual':
        return self.sum(axis, keepdims) / math.prod(self.shape[a] for a in _axes(axis, self.ndim))

    def prod(self, axis: int) -> 'Dual':
        before = (slice(None),) * (axis % self.ndim)
        factors = [self[(*before, i)] for i in range(self.shape[axis])]
        out = factors[0]
        for factor in factors[1:]:
            out = out * factor
        return out

    def max(self, axis: int) -> 'Dual':
        return self._chosen(np.argmax(self.value, axis), axis)

    def min(self, axis: int) -> 'Dual':
        return self._chosen(np.argmin(self.value, axis), axis)

    def clip(self, low: Any, high: Any) -> 'Dual':
        out = self if low is None else _RULES[np.maximum](self, low)
        return out if high is None else _RULES[np.minimum](out, high)

    def copy(self) -> 'Dual':
        return self

    def __getattr__(self, name: str) -> Any:
        function: Any = next((f for f in _LINEAR if f.__name__ == name), None)
        if function is None:
            raise AttributeError(f'dual numbers have no {name}')
        return lambda *arguments, **named: _each(lambda part: function(part, *arguments, **named), self)

    def __array__(self, *_: Any, **__: Any) -> np.ndarray:
        raise TypeError('a plain array would lose the derivatives of dual numbers')

    # ---- numpy's protocols -----------------------------------------------------------------------
    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **named: Any) -> Any:
        if method == '__call__' and not named:
            if ufunc in _PLAIN:
                return ufunc(*(x.value if isinstance(x, Dual) else x for x in inputs))
            if ufunc in _RULES:
                return _RULES[ufunc](*inputs)
            if ufunc in _CHAIN:
                return _chain(inputs[0], *_CHAIN[ufunc](inputs[0].value))
        return NotImplemented

    def __array_function__(self, function: Any, _: Any, arguments: Any, named: Any) -> Any:
        if function in _FUNCTIONS:
            return _FUNCTIONS[function](*arguments, **named)
        if function in _LINEAR and isinstance(arguments[0], Dual):
            return _each(lambda part: function(part, *arguments[1:], **named), arguments[0])
        return NotImplemented

    # ---- parts -----------------------------------------------------------------------------------
    def _mapped(self, value: np.ndarray, f: Callable[[np.ndarray], np.ndarray]) -> 'Dual':
        """Applies f to the derivatives. f: a linear map of the axes of the value, here the axes after the first one;
        an axis along which all derivatives are equal has length 1."""
        return Dual(value, f(self._d), None if self._h is None else f(self._h))

    def _chosen(self, where: np.ndarray, axis: int) -> 'Dual':
        index = np.expand_dims(where, axis)
        return _each(lambda part: np.take_along_axis(part, index, axis).squeeze(axis), self)


def _axes(axis: Any, ndim: int) -> tuple[int, ...]:
    if axis is None:
        return tuple(range(ndim))
    return tuple(a % ndim for a in (axis if isinstance(axis, tuple) else (axis,)))


def _each(f: Callable[[np.ndarray], np.ndarray], x: Dual) -> Dual:
    """Applies the linear map f to the value and to each derivative."""
    return x._mapped(np.asarray(f(x.value)),
                     lambda part: np.stack([_thin(f(p), 0) for p in _wide(part, x.shape)]))


def _same_count(*arrays: Any) -> list['Dual']:
    """Returns all arrays as dual numbers with the same number of variables."""
    k = next(len(a._d) for a in arrays if isinstance(a, Dual))
    return [a if isinstance(a, Dual) else Dual(np.asarray(a, dtype=float), np.zeros((k, *(1,) * np.ndim(a))), None)
            for a in arrays]


def _wide(part: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Returns derivatives for a value of this shape, with the axes of length 1 expanded."""
    return part if part.shape[1:] == shape else np.broadcast_to(_padded(part, len(shape)), (len(part), *shape))


def _thin(part: np.ndarray, first: int = 1) -> np.ndarray:
    """Returns the derivatives with length 1 along repeated axes, from axis `first` on."""
    repeats = [n > 1 and stride == 0 for n, stride in zip(part.shape[first:], part.strides[first:])]
    return part[(*(slice(None),) * first, *(slice(0, 1) if r else slice(None) for r in repeats))] if any(repeats) else part


def _padded(part: np.ndarray, ndim: int) -> np.ndarray:
    """Returns derivatives for a value that is broadcast to so many axes."""
    missing = ndim + 1 - part.ndim
    return part if not missing else part.reshape(len(part), *(1,) * missing, *part.shape[1:])


@functools.lru_cache(maxsize=None)
def _triangle(k: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns rows and columns of the entries of a lower triangle."""
    rows, columns = np.tril_indices(k)
    return rows, columns


def _outer(a: np.ndarray, b: np.ndarray | None = None, scaled: np.ndarray | None = None) -> np.ndarray:
    """Returns the lower triangle of a b^T + b a^T; without b, of scaled a^T (scaled: a multiple of a) or of a a^T."""
    left, right = (a if scaled is None else scaled, a) if b is None else (a, b)
    if left.size == right.size == len(a):       # one number per row: a single call is faster
        rows, columns = _triangle(len(a))
        out = left[rows] * right[columns]
        return out if b is None else out + left[columns] * right[rows]
    k, i, begin = len(a), 0, 0
    shape = left.shape[1:] if left.shape == right.shape else np.broadcast_shapes(left.shape[1:], right.shape[1:])
    out = _empty(k * (k + 1) // 2, shape, left if left.size >= right.size else right)
    for i in range(k):
        row = out[begin:begin + i + 1]
        np.multiply(left[i], right[:i + 1], out=row)
        if b is not None:
            row += right[i] * left[:i + 1]
        begin += i + 1
    return out


def _empty(count: int, shape: tuple[int, ...], model: np.ndarray) -> np.ndarray:
    """Returns an uninitialized array of so many rows of this shape. The axes have the same order in memory as those of
    model, so that points are contiguous."""
    if len(shape) < 2 or model.flags.c_contiguous:
        return np.empty((count, *shape))
    order = sorted(range(len(shape)), key=lambda a: -abs(model.strides[a + 1]))
    out = np.empty((count, *(shape[a] for a in order)))
    return out.transpose(0, *(order.index(a) + 1 for a in range(len(shape))))


def _like(f: np.ndarray, factor: Any) -> Any:
    """Returns a factor, which is broadcast to f along some axes, with its axes in the memory order of f."""
    if np.ndim(factor) != f.ndim or f.ndim < 2 or factor.shape == f.shape or factor.shape[0] != f.shape[0]:
        return factor
    out = np.empty_like(f)
    out[...] = factor
    return out


def lower_triangle(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Returns a_i b_j, j <= i, row by row: (k (k + 1) / 2, ...) of two (k, ...), one a multiple of the other."""
    return _outer(b, scaled=a)


def _sum(*summands: np.ndarray | None) -> np.ndarray | None:
    found = [s for s in summands if s is not None]
    out = found[0] if found else None
    for s in found[1:]:
        out = out + s
    return out


def _added(out: np.ndarray | None, factor: Any, part: np.ndarray | None) -> np.ndarray | None:
    """Returns out + factor part. out has no other owner and is changed in place if shapes allow. None is 0."""
    if part is None:
        return out
    if part.size == len(part) and isinstance(factor, np.ndarray) and factor.ndim == part.ndim - 1 and factor.size > 32:
        # Each row is one number, and many of them are 0.
        if out is None:
            out = np.zeros((len(part), *factor.shape))
        if out.shape[1:] == factor.shape:
            for row in part.ravel().nonzero()[0]:
                out[row] += factor * part[row]
            return out
    product = factor * part
    if out is None:
        return product
    if out.shape == product.shape or product.size == len(product):
        out += product
        return out
    return out + product


def _chain(x: Dual, f: np.ndarray, slope: Any, bend: Any = None) -> Dual:
    """Returns f(x). slope and bend: f' and f'' at the value of x; None: f'' = 0."""
    h = None
    slope = _like(f, slope)
    if bend is not None:
        bend = _like(f, bend)
        constant = x._d.size == len(x._d)
        h = _added(None, bend, _outer(x._d)) if constant else _outer(x._d, scaled=bend * x._d)
    d = _added(None, slope, x._d)
    assert d is not None
    return Dual(f, d, _added(h, slope, x._h))


def _chain2(a: Any, b: Any, f: np.ndarray, by_a: Any, by_b: Any, by_aa: Any, by_ab: Any, by_bb: Any) -> Dual:
    """Returns f(a, b) for duals or plain arrays. by_a to by_bb: the derivatives of f; None: 0 everywhere."""
    duals = [(_broadcast(x, f.ndim), 0.0 if slope is None else slope, bend)
             for x, slope, bend in ((a, by_a, by_aa), (b, by_b, by_bb)) if isinstance(x, Dual)]
    out = _chain(duals[0][0], f, *duals[0][1:])
    if len(duals) == 1:
        return out
    x, (y, slope, bend) = duals[0][0], duals[1]
    d = _added(out._d, slope, y._d)
    h = out._h
    if by_ab is not None:
        h = _added(_outer(x._d, y._d) * by_ab, 1.0, h)
    if bend is not None:
        h = _added(h, bend, _outer(y._d))
    assert d is not None
    return Dual(f, d, _added(h, slope, y._h))


def _broadcast(x: Dual, ndim: int) -> Dual:
    """Returns x broadcast to so many axes."""
    if x.ndim == ndim:
        return x
    return Dual(x.value, _padded(x._d, ndim), None if x._h is None else _padded(x._h, ndim))


def _values(*arrays: Any) -> list[np.ndarray]:
    return [a.value if isinstance(a, Dual) else np.asarray(a) for a in arrays]


def _add(a: Any, b: Any) -> Dual:
    x, y = _values(a, b)
    f = np.asarray(x + y)
    duals = [_broadcast(z, f.ndim) for z in (a, b) if isinstance(z, Dual)]
    d = _sum(*(z._d for z in duals))
    assert d is not None
    return Dual(f, d, _sum(*(z._h for z in duals)))


def _subtract(a: Any, b: Any) -> Dual:
    return _add(a, -b if isinstance(b, Dual) else -np.asarray(b))


def _multiply(a: Any, b: Any) -> Dual:
    x, y = _values(a, b)
    f = np.asarray(x * y)
    if a is b:
        return _chain(a, f, 2 * x, 2.0)
    if not isinstance(b, Dual):
        return _chain(_broadcast(a, f.ndim), f, y)
    if not isinstance(a, Dual):
        return _chain(_broadcast(b, f.ndim), f, x)
    a, b, x, y = _broadcast(a, f.ndim), _broadcast(b, f.ndim), _like(f, x), _like(f, y)
    d = _added(_added(None, y, a._d), x, b._d)
    assert d is not None
    return Dual(f, d, _added(_added(_outer(a._d, b._d), y, a._h), x, b._h))


def _divide(a: Any, b: Any) -> Dual:
    x, y = _values(a, b)
    f = np.asarray(x / y)
    inverse = 1 / y
    if not isinstance(b, Dual):
        return _chain(_broadcast(a, f.ndim), f, inverse)
    slope = -f * inverse
    if not isinstance(a, Dual):
        return _chain(_broadcast(b, f.ndim), f, slope, -2 * slope * inverse)
    # From b f = a: b f'' = a'' - f b'' - (b' f'^T + f' b'^T).
    a, b, inverse = _broadcast(a, f.ndim), _broadcast(b, f.ndim), _like(f, inverse)
    d = _added(_added(None, slope, b._d), inverse, a._d)
    assert d is not None
    h = _outer(d, b._d)
    h = np.multiply(h, -inverse, out=h) if h.shape[1:] == f.shape else h * -inverse
    return Dual(f, d, _added(_added(h, inverse, a._h), slope, b._h))


def _power(a: Any, b: Any) -> Dual:
    x, p = _values(a, b)
    f = np.asarray(_raised(x, p))
    if not isinstance(b, Dual):
        return _chain(_broadcast(a, f.ndim), f, *_slopes_of_power(x, p))
    log = np.log(x)
    by_x = _raised(x, p - 1)
    return _chain2(a, b, f, p * by_x, f * log, p * (p - 1) * by_x / x, by_x * (1 + p * log), f * log * log)


def _raised(x: np.ndarray, p: np.ndarray) -> Any:
    """Returns x^p, with products instead of a power function for common exponents."""
    if not p.ndim:
        if p == 2:
            return x * x
        if p in (0, 1):
            return x ** int(p)
        if p in (-1, -2):
            return 1 / x if p == -1 else 1 / (x * x)
        if p == 3:
            return x * x * x
    return np.power(x, p, dtype=float)


def _slopes_of_power(x: np.ndarray, p: np.ndarray) -> tuple[Any, ...]:
    """Returns p x^(p - 1) and, unless it is 0, p (p - 1) x^(p - 2)."""
    if not p.ndim and p == 2:
        return 2 * x, 2.0
    slope, bend = _multiple(p, x, p - 1), _multiple(p * (p - 1), x, p - 2)
    return (np.zeros(()) if slope is None else slope,) if bend is None else (slope, bend)


def _multiple(factor: np.ndarray, x: np.ndarray, p: np.ndarray) -> Any:
    """Returns factor x^p; None if all factors are 0. A factor of 0 gives 0 even if the power is infinite."""
    if not factor.any():
        return None
    if factor.ndim:
        return np.where(factor == 0, 0.0, factor * np.power(x, p, dtype=float))
    return factor if p == 0 else factor * _raised(x, p)


def _hypot(a: Any, b: Any) -> Dual:
    x, y = _values(a, b)
    f = np.asarray(np.hypot(x, y))
    r = np.where(f == 0, 1.0, f)
    c, s = x / r, y / r
    return _chain2(a, b, f, c, s, s * s / r, -c * s / r, c * c / r)


def _arctan2(a: Any, b: Any) -> Dual:
    y, x = _values(a, b)
    n = x * x + y * y
    by_yy = -2 * x * y / (n * n)
    return _chain2(a, b, np.asarray(np.arctan2(y, x)), x / n, -y / n, by_yy, (y * y - x * x) / (n * n), -by_yy)


def _extremum(ufunc: Any, first: Any) -> Callable[[Any, Any], Dual]:
    def rule(a: Any, b: Any) -> Dual:
        x, y = _values(a, b)
        chosen = _where(first(x, y), a, b)
        return Dual(np.asarray(ufunc(x, y)), chosen._d, chosen._h)
    return rule


def _where(condition: Any, a: Any, b: Any) -> Dual:
    a, b = _same_count(a, b)
    value = np.where(condition, a.value, b.value)
    a, b = _broadcast(a, value.ndim), _broadcast(b, value.ndim)
    if a._h is None and b._h is None:
        return Dual(value, np.where(condition, a._d, b._d), None)
    first, second = _seconds([a, b])
    return Dual(value, np.where(condition, a._d, b._d), np.where(condition, first, second))


def _seconds(duals: list[Dual]) -> list[np.ndarray]:
    """Returns the second derivatives of all duals, with zeros for None."""
    count = len(duals[0]._d) * (len(duals[0]._d) + 1) // 2
    return [np.zeros((count, *(1,) * (x._d.ndim - 1))) if x._h is None else x._h for x in duals]


def _joined(function: Any, arrays: Any, axis: int) -> Dual:
    duals = _same_count(*arrays)
    value = function([x.value for x in duals], axis=axis)
    axis = axis % value.ndim + 1

    def joined(parts: list[np.ndarray]) -> np.ndarray:
        """Broadcasts the parts to common axes, except for the axis along which they are joined, and joins them."""
        along = function is np.concatenate
        lengths = [part.shape[:axis] + (x.shape[axis - 1],) + part.shape[axis + 1:] if along else part.shape
                   for x, part in zip(duals, parts)]
        common = np.broadcast_shapes(*(n[:axis] + (1,) + n[axis + 1:] if along else n for n in lengths))
        shapes = [common[:axis] + n[axis:axis + 1] + common[axis + 1:] if along else common for n in lengths]
        return function([np.broadcast_to(part, shape) for part, shape in zip(parts, shapes)], axis=axis)

    h = None if all(x._h is None for x in duals) else joined(_seconds(duals))
    return Dual(value, joined([x._d for x in duals]), h)


def _column_stack(arrays: Any) -> Dual:
    return _joined(np.concatenate, [x[:, None] if np.ndim(x) == 1 else x for x in arrays], 1)


def _einsum(subscripts: Any, *arrays: Any) -> Dual:
    """Returns the einsum of duals by the product rule: one or two factors are differentiated."""
    if not isinstance(subscripts, str) or '->' not in subscripts:
        raise TypeError("einsum of dual numbers takes subscripts 'ij,jk->ik', with an arrow")
    words, result = subscripts.replace(' ', '').split('->')
    factors = words.split(',')
    values = _values(*arrays)
    spare = [c for c in 'zyxwvutsrqponmlkjihgfedcbaZYXWVUTSRQPONMLKJIHGFEDCBA' if c not in subscripts]
    first = spare.pop(0)
    if '...' in subscripts:
        counts = [v.ndim - len(t.replace('...', '')) if '...' in t else 0 for v, t in zip(values, factors)]
        letters = ''.join(spare[:max(counts)])
        factors = [t.replace('...', letters[len(letters) - n:]) for t, n in zip(factors, counts)]
        result = result.replace('...', letters)
    if len(factors) != len(values) or any(len(t) != v.ndim for t, v in zip(factors, values)):
        raise ValueError(f'einsum {subscripts!r} does not fit its operands')
    length = {c: n for t, v in zip(factors, values) for c, n in zip(t, v.shape) if n != 1}
    value = np.asarray(np.einsum(','.join(factors) + '->' + result, *values, optimize=len(values) > 2))

    def product(*changed: tuple[int, np.ndarray]) -> np.ndarray:
        """Returns the einsum with some factors replaced by derivatives. The subscripts of a derivative omit axes
        along which it is constant."""
        parts, texts = list(values), list(factors)
        for i, part in changed:
            one = [n == 1 for n in part.shape[1:]]
            keys: tuple[Any, ...] = tuple(0 if o else slice(None) for o in one)
            parts[i] = part[(slice(None), *keys)]
            texts[i] = first + ''.join(c for c, o in zip(factors[i], one) if not o)
        left = set(''.join(texts))
        terms = ','.join(texts) + '->' + first + ''.join(c for c in result if c in left)
        out = np.einsum(terms, *parts, optimize=len(parts) > 2)
        lost = math.prod(n for c, n in length.items() if c not in left and c not in result)
        out = out if lost == 1 else out * lost
        kept: tuple[Any, ...] = tuple(slice(None) if c in left else None for c in result)
        return out[(slice(None), *kept)]

    duals = [(i, x) for i, x in enumerate(arrays) if isinstance(x, Dual)]
    rows, columns = np.tril_indices(len(duals[0][1]._d))
    pairs = [(i, a._d, j, b._d) for n, (i, a) in enumerate(duals) for j, b in duals[:n]]
    h = _sum(*(product((i, x._h)) for i, x in duals if x._h is not None),
             *(product((i, a[rows]), (j, b[columns])) + product((i, a[columns]), (j, b[rows]))
               for i, a, j, b in pairs))
    d = _sum(*(product((i, x._d)) for i, x in duals))
    assert d is not None
    return Dual(value, d, h)


def _matmul(a: Any, b: Any) -> Dual:
    left, right = ('i' if np.ndim(a) == 1 else '...hi'), ('i' if np.ndim(b) == 1 else '...ij')
    return _einsum(f'{left},{right}->...{"" if left == "i" else "h"}{"" if right == "i" else "j"}', a, b)


def _cofactors(x: Dual) -> tuple[list[list[Any]], Dual]:
    """Returns the cofactors and the determinants of matrices, 2 by 2 or 3 by 3."""
    n = x.shape[-1]
    if x.shape[-2] != n or n not in (2, 3):
        raise TypeError('determinants and inverses of dual numbers are of matrices 2 by 2 and 3 by 3')
    e = [[x[..., i, j] for j in range(n)] for i in range(n)]
    if n == 2:
        cofactors = [[e[1][1], -e[1][0]], [-e[0][1], e[0][0]]]
    else:
        cofactors = [[e[(i + 1) % 3][(j + 1) % 3] * e[(i + 2) % 3][(j + 2) % 3]
                      - e[(i + 1) % 3][(j + 2) % 3] * e[(i + 2) % 3][(j + 1) % 3] for j in range(3)] for i in range(3)]
    determinant = e[0][0] * cofactors[0][0]
    for j in range(1, n):
        determinant = determinant + e[0][j] * cofactors[0][j]
    return cofactors, determinant


def _det(x: Dual) -> Dual:
    return _cofactors(x)[1]


def _inv(x: Dual) -> Dual:
    cofactors, determinant = _cofactors(x)
    columns = [_joined(np.stack, column, -1) for column in cofactors]     # of the transposed matrix
    return _joined(np.stack, columns, -1) / determinant[..., None, None]


def _norm(x: Dual, ord: Any = None, axis: Any = None, keepdims: bool = False) -> Dual:
    axes = _axes(axis, x.ndim)
    if not (ord is None or ord == 2 and len(axes) == 1 or ord == 'fro' and len(axes) == 2):
        raise TypeError('norms of dual numbers are Euclidean')
    return np.sqrt((x * x).sum(axes, keepdims))


def _tangent(x: np.ndarray) -> tuple[np.ndarray, ...]:
    t = np.tan(x)
    slope = 1 + t * t
    return t, slope, 2 * t * slope


def _hyperbolic_tangent(x: np.ndarray) -> tuple[np.ndarray, ...]:
    t = np.tanh(x)
    slope = 1 - t * t
    return t, slope, -2 * t * slope


def _arc(ufunc: Any, sign: int) -> Callable[[np.ndarray], tuple[np.ndarray, ...]]:
    def rule(x: np.ndarray) -> tuple[np.ndarray, ...]:
        slope = sign / np.sqrt(1 - x * x)
        return ufunc(x), slope, slope * x / (1 - x * x)
    return rule


def _exponential(ufunc: Any) -> Callable[[np.ndarray], tuple[np.ndarray, ...]]:
    def rule(x: np.ndarray) -> tuple[np.ndarray, ...]:
        slope = np.exp(x)
        return ufunc(x), slope, slope
    return rule


def _logarithm(ufunc: Any, factor: float, offset: int = 0) -> Callable[[np.ndarray], tuple[np.ndarray, ...]]:
    def rule(x: np.ndarray) -> tuple[np.ndarray, ...]:
        inverse = 1 / (x + offset)
        return ufunc(x), factor * inverse, -factor * inverse * inverse
    return rule


def _root(x: np.ndarray) -> tuple[np.ndarray, ...]:
    r = np.sqrt(x)
    return r, 0.5 / r, -0.25 / (r * x)


def _inverse(x: np.ndarray) -> tuple[np.ndarray, ...]:
    i = 1 / x
    return i, -i * i, 2 * i * i * i


# Functions that return f, f' and, unless it is 0, f''.
_CHAIN: dict[Any, Callable[[np.ndarray], tuple[np.ndarray, ...]]] = {
    np.positive: lambda x: (x, np.ones(())),
    np.negative: lambda x: (-x, -np.ones(())),
    np.absolute: lambda x: (np.abs(x), np.where(x < 0, -1.0, 1.0)),
    np.fabs: lambda x: (np.abs(x), np.where(x < 0, -1.0, 1.0)),
    np.square: lambda x: (x * x, 2 * x, np.full((), 2.0)),
    np.reciprocal: _inverse,
    np.sqrt: _root,
    np.cbrt: lambda x: (np.cbrt(x), np.cbrt(x) / (3 * x), -2 * np.cbrt(x) / (9 * x * x)),
    np.exp: _exponential(np.exp),
    np.expm1: _exponential(np.expm1),
    np.log: _logarithm(np.log, 1),
    np.log1p: _logarithm(np.log1p, 1, 1),
    np.log2: _logarithm(np.log2, 1 / math.log(2)),
    np.log10: _logarithm(np.log10, 1 / math.log(10)),
    np.sin: lambda x: (np.sin(x), np.cos(x), -np.sin(x)),
    np.cos: lambda x: (np.cos(x), -np.sin(x), -np.cos(x)),
    np.tan: _tangent,
    np.arcsin: _arc(np.arcsin, 1),
    np.arccos: _arc(np.arccos, -1),
    np.arctan: lambda x: (np.arctan(x), 1 / (1 + x * x), -2 * x / (1 + x * x) ** 2),
    np.sinh: lambda x: (np.sinh(x), np.cosh(x), np.sinh(x)),
    np.cosh: lambda x: (np.cosh(x), np.sinh(x), np.cosh(x)),
    np.tanh: _hyperbolic_tangent,
}

_RULES: dict[Any, Callable[..., Dual]] = {
    np.add: _add, np.subtract: _subtract, np.multiply: _multiply, np.true_divide: _divide, np.power: _power,
    np.float_power: _power, np.hypot: _hypot, np.arctan2: _arctan2, np.matmul: _matmul,
    np.maximum: _extremum(np.maximum, np.greater_equal), np.minimum: _extremum(np.minimum, np.less_equal),
}

# These functions return plain values.
_PLAIN = {np.greater, np.greater_equal, np.less, np.less_equal, np.equal, np.not_equal, np.isfinite, np.isnan,
          np.isinf, np.sign, np.signbit, np.floor, np.ceil, np.rint, np.trunc}

_FUNCTIONS: dict[Any, Callable[..., Any]] = {
    np.shape: lambda x: x.shape, np.ndim: lambda x: x.ndim, np.size: lambda x: x.size, np.copy: Dual.copy,
    np.zeros_like: lambda x: np.zeros(x.shape), np.ones_like: lambda x: np.ones(x.shape),
    np.full_like: lambda x, value: np.full(x.shape, float(value)),
    np.sum: Dual.sum, np.mean: Dual.mean, np.prod: Dual.prod, np.max: Dual.max, np.min: Dual.min,
    np.clip: Dual.clip, np.reshape: Dual.reshape,
    np.where: _where, np.einsum: _einsum, np.dot: _matmul,
    np.stack: lambda arrays, axis=0: _joined(np.stack, arrays, axis),
    np.concatenate: lambda arrays, axis=0: _joined(np.concatenate, arrays, axis),
    np.hstack: lambda arrays: _joined(np.concatenate, arrays, 0 if np.ndim(arrays[0]) == 1 else 1),
    np.vstack: lambda arrays: _joined(np.concatenate, [x if np.ndim(x) > 1 else x[None] for x in arrays], 0),
    np.column_stack: _column_stack,
    np.linalg.det: _det, np.linalg.inv: _inv, np.linalg.norm: _norm,
}

# Functions that are linear in their first argument.
_LINEAR = {np.transpose, np.swapaxes, np.moveaxis, np.squeeze, np.expand_dims, np.ravel, np.broadcast_to, np.trace,
           np.diagonal, np.flip, np.fliplr, np.flipud, np.diff, np.roll, np.take, np.cumsum, np.repeat, np.tile}
