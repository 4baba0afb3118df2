// Functions of few unknowns, written in Python for many elements at once: terms, inequalities,
// equalities.
//
// A function has
//     evaluate(z, e, *data) -> (q,)
//     linearize(z, e, exact, *data) -> values (q,), gradients (k, q), lower triangles of Hessians
//                                      (k (k + 1) / 2, q), row by row
// with the unknowns z (q, k) of elements e (q,) that have equally many nodes, and of a term with
// data these, a vector (m,) or the rows of the elements, (q, m). `exact` is 1 - projection_weight
// (framework/curvature.h), 0 where the model is no Hessian. One of least squares also has
//     residuals(z, e, *data) -> (q, r);  jacobian(z, e, *data) -> (q, r, k)
//     loss(s) -> rho, its slope and its bend at the number s
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "arrays.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/feasibility.h"

namespace majorant::python {

Curvature curvature_named(const std::string& name);

// Elements as Python has them: nodes #E by the most of an element, and how many each has; no
// counts: all have as many.
ElementDofs elements_of(const Integers& nodes, const Integers& counts, int block);

// The data of a term: TermState::parameters where these are empty.
struct TermData {
  Vec numbers = {};       // of a matrix row by row; empty: the function takes none
  Index per_element = 0;  // columns; 0: a vector
};

// sum over elements of f(the element's unknowns). Where the curvatures have Reweighted f makes its
// models itself and they are definite; else they are exact, and clamped here. A function of least
// squares makes a ResidualTerm.
std::shared_ptr<const EnergyTerm> python_term(std::string name, ElementDofs element_dofs,
                                              pybind11::object function,
                                              std::vector<Curvature> curvatures,
                                              TermData data = {});

// g > 0 at every element: evaluate(z, e) is g, barrier(slack) the function -log(g + slack),
// violation(margin) the function max(0, margin - g)^2.
std::shared_ptr<const BarrierChecker> python_inequality(std::string name, ElementDofs element_dofs,
                                                        pybind11::object function);

// g = 0 at every element, as a term (majorant/framework/equality_term.h): evaluate(z, e, data) is
// l g + r g^2 / 2 with a row (l, r) of data for each element.
std::shared_ptr<const EnergyTerm> python_equality(std::string name, ElementDofs element_dofs,
                                                  pybind11::object function);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
