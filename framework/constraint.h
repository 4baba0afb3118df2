// Linear constraints A x = b that hold exactly: they are eliminated, never penalized. Points and
// single unknowns that are held are the simplest of them.
//
//   builder.add(FixedPoints({{12, {0.1, 0.2}}}));                 // node 12, of the plane
//   builder.add(FixedUnknowns({{3 * 12 + 2, 0.5}}));              // z of node 12, in space
//
// A constraint appends its rows; ProblemBuilder eliminates all rows together. Rank and consistency
// of rows with integer coefficients are decided exactly, those of other rows by a documented
// tolerance (docs/constraints.md). Right-hand sides are doubles. A constraint may need unknowns of
// its own that no energy sees, such as the translation between two sides of a seam. add_auxiliary()
// makes them; the solver treats them as unknowns unless rows determine them. A constraint of your
// own:
//
//   class PinnedPoint final : public Constraint {
//     void append_rows(ConstraintRows& rows) const override {
//       rows.begin_row("vertex 12, u"); rows.add(24, 1); rows.end_row(0.5);
//     }
//   };
//
// Not for inequalities (feasibility.h), nor for conditions that may be violated at a cost
// (framework/terms/quadratic_penalty.h).
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/types.h"

namespace majorant {

class ConstraintRows {
 public:
  struct Entry {
    Index unknown;  // negative: -1 - j is auxiliary unknown j
    double coefficient;
  };
  // The largest absolute value that counts as an integer: doubles represent all integers up to it.
  static constexpr double kLargestInteger = 9007199254740992.0;

  // Starts a row; `label` names it in messages about contradictions. begin_row(), add() and
  // end_row() throw InvalidArgument if called out of turn, end_row() also for a number that is not
  // finite.
  void begin_row(std::string label) {
    require_ended();
    labels_.push_back(std::move(label));
    starts_.push_back(entries_.size());
  }
  void add(Index unknown, double coefficient) {
    require_begun("add");
    entries_.push_back({unknown, coefficient});
  }
  void end_row(double right_hand_side) {
    require_begun("end_row");
    if (!std::isfinite(right_hand_side))
      throw InvalidArgument("constraint row '" + labels_.back() + "': its right-hand side is " +
                            std::to_string(right_hand_side) + ", finite is needed");
    rhs_.push_back(right_hand_side);
  }
  // Throws InvalidArgument if the last row was not ended.
  void require_ended() const {
    if (is_open())
      throw InvalidArgument("constraint row '" + labels_.back() +
                            "' was begun, but not ended with end_row()");
  }

  // States that the rows belong to nodes with this many unknowns each. ProblemBuilder::build()
  // throws InvalidArgument if the nodes of all its terms have another number of unknowns: "`what`
  // has ...; `remedy`". Terms whose nodes have one unknown list unknowns and are not compared.
  void expect_nodes(int unknowns_each, std::string what, std::string remedy) {
    expected_nodes_.push_back({unknowns_each, std::move(what), std::move(remedy)});
  }
  struct ExpectedNodes {
    int unknowns_each;
    std::string what, remedy;
  };
  const std::vector<ExpectedNodes>& expected_nodes() const { return expected_nodes_; }

  // Returns a new auxiliary unknown. A point x does not contain its value, which follows from the
  // first row in which no other auxiliary unknown is still open.
  Index add_auxiliary() { return -++auxiliary_count_; }

  Index auxiliary_count() const { return auxiliary_count_; }
  std::size_t size() const { return rhs_.size(); }
  const std::string& label(std::size_t row) const { return labels_[row]; }
  double rhs(std::size_t row) const { return rhs_[row]; }
  const Entry* begin(std::size_t row) const { return entries_.data() + starts_[row]; }
  const Entry* end(std::size_t row) const {
    return row + 1 < starts_.size() ? entries_.data() + starts_[row + 1]
                                    : entries_.data() + entries_.size();
  }

 private:
  bool is_open() const { return labels_.size() > rhs_.size(); }
  void require_begun(const char* function) const {
    if (!is_open())
      throw InvalidArgument(std::string("ConstraintRows::") + function +
                            ": no row was begun with begin_row()");
  }

  std::vector<std::string> labels_;
  std::vector<std::size_t> starts_;
  std::vector<Entry> entries_;
  std::vector<double> rhs_;
  std::vector<ExpectedNodes> expected_nodes_;
  Index auxiliary_count_ = 0;
};

class Constraint {
 public:
  virtual ~Constraint() = default;
  virtual void append_rows(ConstraintRows& rows) const = 0;
};

// Control points held at given positions by elimination.
//
//   builder.add(FixedPoints({{12, {0.1, 0.2}}}));                 // a pin in the plane
//   builder.add(FixedPoints::at({12, 13, 14}, x));                // held where x has them
//   builder.add(FixedPoints::in_space({{7, {0.1, 0.2, 0.3}}}));   // 3 unknowns a node
//
// A problem whose nodes have another dimension throws InvalidArgument.

struct FixedPoint {
  Index node;
  Vector2 position;
};
struct FixedPoint3 {
  Index node;
  Vector3 position;
};

class FixedPoints final : public Constraint {
 public:
  explicit FixedPoints(const std::vector<FixedPoint>& points);
  static FixedPoints in_space(std::vector<FixedPoint3> points);
  // Holds `nodes` at their positions in x, which has `dim` numbers per node. Throws InvalidArgument
  // for a node that x does not have, and unless dim is 2 or 3.
  static FixedPoints at(const std::vector<Index>& nodes, VecIn x, int dim = 2);

  void append_rows(ConstraintRows& rows) const override;

 private:
  FixedPoints(std::vector<FixedPoint3> points, int dim) : points_(std::move(points)), dim_(dim) {}
  std::vector<FixedPoint3> points_;  // in the plane, z is ignored
  int dim_;
};

// Hard constraints on single unknowns of any kind, such as coordinates of nodes of any dimension.
//
//   const std::vector<FixedUnknown> held{{3 * 12 + 2, 0.5}};                     // z of node 12
//   builder.add(FixedUnknowns(held));
//   builder.add(std::make_shared<QuadraticPenalty>(FixedUnknowns(held)), 1e3);   // the same, soft
//
// For points of the plane or of space FixedPoints is shorter.

struct FixedUnknown {
  Index unknown;  // of the full unknowns x
  double value;
};

class FixedUnknowns final : public Constraint {
 public:
  explicit FixedUnknowns(std::vector<FixedUnknown> unknowns) : unknowns_(std::move(unknowns)) {}
  void append_rows(ConstraintRows& rows) const override;

 private:
  std::vector<FixedUnknown> unknowns_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
