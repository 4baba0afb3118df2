// Functions of few unknowns, written in Python for many elements at once: terms, inequalities,
// equalities.
//
// A function has
//     evaluate(z, e, *data) -> (q,)
//     linearize(z, e, exact, *data) -> values (q,), gradients (k, q), lower triangles of Hessians
//                                      (k (k + 1) / 2, q), row by row
// with the unknowns z (q, k) of elements e (q,) that have equally many nodes. A term with data
// passes them as a last argument: a vector (m,), or the rows of the elements, (q, m). `exact` is
// 1 - projection_weight (framework/curvature.h), and 0 if the model is not a Hessian. A function of
// least squares also has
//     residuals(z, e, *data) -> (q, r);  jacobian(z, e, *data) -> (q, r, k)
//     loss(s) -> rho, rho' and rho'' at the number s
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

// nodes: #E by the largest number of nodes. counts: the number of nodes of each element; empty if
// all elements have as many as nodes has columns.
ElementDofs elements_of(const Integers& nodes, const Integers& counts, int block);

// The data of a term, used while TermState::parameters is empty.
struct TermData {
  Vec numbers = {};       // row by row; empty: the function takes no data
  Index per_element = 0;  // numbers per element; 0: one vector for all elements
};

// Returns the term sum over elements of f(the element's unknowns). If the curvatures contain
// Reweighted, f computes definite models itself; otherwise its Hessians are exact and are clamped
// here. A function of least squares becomes a ResidualTerm.
std::shared_ptr<const EnergyTerm> python_term(std::string name, ElementDofs element_dofs,
                                              pybind11::object function,
                                              std::vector<Curvature> curvatures,
                                              TermData data = {});

// Returns the checker of g > 0 at every element. evaluate(z, e) is g, barrier(slack) is the
// function -log(g + slack), violation(margin) is the function max(0, margin - g)^2.
std::shared_ptr<const BarrierChecker> python_inequality(std::string name, ElementDofs element_dofs,
                                                        pybind11::object function);

// Returns the term of g = 0 at every element (majorant/framework/equality_term.h): evaluate(z, e,
// data) is l g + r g^2 / 2 with a row (l, r) of data for each element.
std::shared_ptr<const EnergyTerm> python_equality(std::string name, ElementDofs element_dofs,
                                                  pybind11::object function);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
