// Eight faces at once, one in each lane: what condensing their inner control points computes.
// Arrays of lanes: number k of face l at [8 k + l].
//
// `inner` unknowns of a face are eliminated, `outer` ones stay. Its panel has both, inner first:
// columns of the inner unknowns, (inner + outer) rows each, the upper triangle unused.
#pragma once

namespace majorant::condensation {

inline constexpr int kLanes = 8;

inline constexpr int packed(int n) { return n * (n + 1) / 2; }

// Panels in place, and what goes off the matrix of the outer unknowns: values[slots[8 k + l]],
// k over the lower triangle, column by column. False: a pivot of a face below `count` is not
// positive.
bool eliminate(int inner, int outer, int count, double* panel, const int* slots, double* values);
// x: inner unknowns in, their forward solution out; y: what goes off the outer ones.
void forward(int inner, int outer, const double* panel, double* x, double* y);
// y: the outer unknowns, known; x: the forward solution in, the inner unknowns out.
void backward(int inner, int outer, const double* panel, double* x, const double* y);

}  // namespace majorant::condensation

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
