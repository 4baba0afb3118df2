// Checks of the description of an element, made when its space is constructed: once per space, not
// per cell. A wrong description is thus refused before a proof relies on it.
#pragma once

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/det_coefficients.h"

namespace majorant {

// Checks a description before tables are built: the degree, factors that span 2 or 3 dimensions,
// derivatives and cuts inside one factor, corners that come first. Throws InvalidArgument naming
// the error. BernsteinElement::basis() checks the rest, that node orders name every function once.
void check_description(const BernsteinElement& element);

// Checks the tables: the identity and an affine map must give their determinant in every
// coefficient, a curved map its own at a point inside. Throws InvalidArgument naming the wrong
// value.
void check_determinants(const BernsteinElement& element, const DetCoefficients& det);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
