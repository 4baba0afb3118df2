// The gradients of the terms of a problem at its minimum, as functions of weights and parameters.
#pragma once

#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/types.h"

namespace majorant {

class TermDerivatives {
 public:
  // problem, y, x: the minimum, its unknowns and the full ones. All must outlive this.
  TermDerivatives(const Problem& problem, const Vec& y, const Vec& x)
      : problem_(problem), y_(y), x_(x), terms_(problem.terms().size()) {}

  // Returns the gradient of a term without its weight, full unknowns.
  const Vec& gradient(TermId id) { return of(id).gradient; }
  // Returns the norm of the gradients of all elements: what cancels in gradient() is of that size.
  double gradients_norm(TermId id) { return of(id).gradients.norm(); }

  // Add the derivative of the gradient along a change: to `full` by full unknowns, to `reduced` by
  // those of the problem. Throw InvalidArgument for sizes that do not fit.
  void add_element_weights(TermId id, const Vec& change, Vec& full);
  void add_parameters(TermId id, const Vec& change, Vec& full, Vec& reduced);

  // Return -u . d(gradient)/d(datum) for all data of the kind: the derivative of a function with
  // the adjoint state u, ux in full unknowns.
  Vec by_element_weights(TermId id, const Vec& ux);
  Vec by_parameters(TermId id, const Vec& u, const Vec& ux);

 private:
  // The derivatives of a term, computed at first use.
  struct OfTerm {
    RowMatrix gradients;           // #E by local_size(), without weights
    Vec gradient;                  // their sum with the weights of the elements, full unknowns
    RowMatrix by_parameters;       // #E by local_size() K: of the gradients, by each element's K
    std::vector<Index> parameter;  // the shared parameter of each element; -1: none
    Eigen::MatrixXd by_shared;     // otherwise, size() by count: of the sum, by each shared
                                   // parameter
  };

  std::size_t place_of(TermId id) const;
  const OfTerm& of(TermId id);
  void add(TermId id, const RowMatrix& gradients, Index count, const Vec& numbers, Vec& full) const;
  Vec products(TermId id, const RowMatrix& gradients, Index count, const Vec& ux) const;
  [[noreturn]] void refuse_parameters(TermId id) const;
  Vec parameters_of(TermId id) const;
  Vec along_parameters(TermId id, const Vec& base, const Vec& change) const;
  void require_parameters(TermId id, const Vec& change) const;
  void differentiate_by_parameters(TermId id, OfTerm& parts);
  std::vector<Index> parameter_of_elements(TermId id, const Vec& base, const Vec& size) const;
  Vec displaced(TermId id, Vec& at) const;

  const Problem& problem_;
  const Vec& y_;
  const Vec& x_;
  std::vector<OfTerm> terms_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
