// A density in the form in which the kernels of the library call it: a function of a few points,
// through pointers.
//
// The formula is compiled in its user's file, for doubles. Contraction with element tables,
// projection and packing are compiled once, in the library, for every instruction set. So a file
// with a density compiles in little more time than one without. detail/pointwise.h makes these
// objects. This header has no inline functions, since kernels include it.
#pragma once

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/traits.h"

namespace majorant {

// A point on each of a few elements. Numbers of points are in rows of kMost, one number a point.
struct PointBatch {
  static constexpr int kMost = 8;
  int count;            // points
  const int* elements;  // of the term; null if a density is the same on all elements
  int element_count;    // points from here on belong to the last element
};

// A density f(J): J row by row in M * D rows; g and k as in PointModel, k the exact Hessian.
struct JacobianFunction {
  const void* formula;
  void (*values)(const void* formula, const PointBatch&, const double* J, double* f);
  void (*slopes)(const void* formula, const PointBatch&, const double* J, double* f, double* g);
  void (*models)(const void* formula, const PointBatch&, const double* J, double* f, double* g,
                 double* k);
};

// A density k(x, y) of planar maps, x = |alpha|^2, y = |beta|^2 (detail/isotropic.h).
struct InvariantFunction {
  const void* formula;
  Traits traits;
  void (*values)(const void* formula, const PointBatch&, const double* x, const double* y,
                 double* f);
  // Computes rows f, ga, gb, caa, cab, cbb of IsotropicJet.
  void (*jets)(const void* formula, const PointBatch&, const double* x, const double* y,
               double* jets);
  // Computes m(x, y) of a majorant; null: none is known.
  void (*majorants)(const void* formula, const PointBatch&, const double* x, const double* y,
                    double* m);
};

// A density W(J) + U(theta), where theta is the projection of det J (energies/solid.h).
struct SolidFunction {
  JacobianFunction shape;  // W
  const void* volume;      // U
  // Computes rows U, U', U''.
  void (*jets)(const void* volume, const PointBatch&, const double* theta, double* jets);
};

// Return their kernels for the widest instructions of this machine. rows and dims of the Jacobian:
// 1 to 3.
DensityKernels jacobian_kernels(int rows, int dims);
DensityKernels invariant_kernels();
DensityKernels solid_kernels(int dims);  // 2 or 3

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
