#include <algorithm>

#include "majorant/elements/bernstein_space.h"

namespace majorant {
namespace {

// A direction of derivatives of the table: the signed sum of formal derivatives by these
// homogeneous coordinates.
struct Direction {
  struct Term {
    int coordinate;
    double sign;
  };
  std::vector<Term> terms;
  Eigen::RowVectorXd gamma;  // by reference coordinates
};

std::vector<Direction> directions(const BernsteinElement& element) {
  std::vector<Direction> out;
  const int dim = element.dim();
  if (element.factors.size() == 1) {  // barycentric: every recombination is a single term
    for (int c = 0; c <= dim; ++c) out.push_back({{{c, 1.0}}, Eigen::RowVectorXd::Zero(dim)});
    for (int d = 0; d < dim; ++d) {
      const auto [plus, minus] = element.derivatives[d];
      out[plus].gamma[d] += 1;
      out[minus].gamma[d] -= 1;
    }
    return out;
  }
  for (int d = 0; d < dim; ++d) {
    const auto [plus, minus] = element.derivatives[d];
    out.push_back({{{plus, 1.0}, {minus, -1.0}}, Eigen::RowVectorXd::Unit(dim, d)});
  }
  return out;
}

// Returns the basis of all spaces in `spaces`, each once, one after the other.
BernsteinBasis union_of(const BernsteinElement& element, std::vector<Degrees> spaces) {
  std::vector<Exponents> functions;
  for (std::size_t k = 0; k < spaces.size(); ++k) {
    if (std::find(spaces.begin(), spaces.begin() + static_cast<long>(k), spaces[k]) !=
        spaces.begin() + static_cast<long>(k))
      continue;
    const std::vector<Exponents> more = element.functions(spaces[k]);
    functions.insert(functions.end(), more.begin(), more.end());
  }
  return {element.factors, functions};
}

Exponents sum_of(Exponents a, const Exponents& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

RowMatrix values_at(const BernsteinBasis& basis, const Quadrature& rule) {
  RowMatrix out(rule.size(), basis.count());
  for (Index l = 0; l < rule.size(); ++l) out.row(l) = basis.values(rule.points.row(l));
  return out;
}

// Entries of table.gradient by [node][direction], which fill_gradient() fills.
using Lowered = std::vector<std::vector<std::vector<GradientEntry>>>;
Lowered fill_gradient(const BernsteinBasis& nodes, const BernsteinBasis& first,
                      const std::vector<Direction>& dirs, ContractionTable& table) {
  Lowered out(to_size(nodes.count()));
  for (int i = 0; i < nodes.count(); ++i)
    for (int a = 0; a < static_cast<int>(dirs.size()); ++a) {
      auto& entries = out[i].emplace_back();
      for (const auto& [coordinate, sign] : dirs[a].terms) {
        Exponents e = nodes.exponents(i);
        const int exponent = e[coordinate]--;
        if (exponent == 0) continue;
        const int k = first.find(e);
        entries.push_back({i, a, k, sign * nodes.weight(i) * exponent / first.weight(k)});
        table.gradient.push_back(entries.back());
      }
    }
  return out;
}

void fill_hessian(const BernsteinBasis& first, const BernsteinBasis& gradient_product,
                  const Lowered& lowered, ContractionTable& table) {
  table.pair_starts.push_back(0);
  for (std::size_t i = 0; i < lowered.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const auto add = [&](const GradientEntry& g, const GradientEntry& h) {
        const int m = gradient_product.find(
            sum_of(first.exponents(g.shape_gradient), first.exponents(h.shape_gradient)));
        const double value = g.coefficient * h.coefficient * first.weight(g.shape_gradient) *
                             first.weight(h.shape_gradient) / gradient_product.weight(m);
        const auto begin = table.hessian.begin() + table.pair_starts.back();
        const auto same = std::find_if(begin, table.hessian.end(), [&](const HessianEntry& q) {
          return q.direction_i == g.direction && q.direction_j == h.direction &&
                 q.gradient_product == m;
        });
        if (same != table.hessian.end())
          same->coefficient += value;
        else
          table.hessian.push_back({g.direction, h.direction, m, value});
      };
      for (const auto& of_i : lowered[i])
        for (const auto& of_j : lowered[j])
          for (const GradientEntry& g : of_i)
            for (const GradientEntry& h : of_j) add(g, h);
      table.pair_starts.push_back(static_cast<int>(table.hessian.size()));
    }
}

}  // namespace

ContractionTable contraction_table(const BernsteinElement& element, const Quadrature& rule) {
  require_cell(rule, element.factors, element.name);
  const std::vector<Direction> dirs = directions(element);
  std::vector<Degrees> lowered, products;
  for (int f = 0; f < static_cast<int>(element.factors.size()); ++f)
    lowered.push_back(element.lowered(f));
  for (std::size_t f = 0; f < lowered.size(); ++f)
    for (std::size_t g = f; g < lowered.size(); ++g) {
      products.push_back(lowered[f]);
      for (std::size_t k = 0; k < lowered[g].size(); ++k) products.back()[k] += lowered[g][k];
    }
  const BernsteinBasis nodes = element.basis(element.degrees()), first = union_of(element, lowered),
                       gradient_product = union_of(element, products);
  ContractionTable table;
  table.nodes = nodes.count();
  table.directions.resize(static_cast<Index>(dirs.size()), element.dim());
  for (std::size_t a = 0; a < dirs.size(); ++a)
    table.directions.row(static_cast<Index>(a)) = dirs[a].gamma;
  table.weights = rule.weights;
  table.shape_gradient = values_at(first, rule);
  table.gradient_product = values_at(gradient_product, rule);
  fill_hessian(first, gradient_product, fill_gradient(nodes, first, dirs, table), table);
  return table;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
