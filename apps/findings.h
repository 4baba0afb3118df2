// What `check` finds wrong with a result, in words.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant::app {

inline constexpr double kClose = 1e-9;  // relative to the size of the map or surface

// Empty means the check passed.
class Findings {
 public:
  void require(bool holds, std::string what) {
    if (!holds) list_.push_back(std::move(what));
  }
  const std::vector<std::string>& list() const { return list_; }

 private:
  std::vector<std::string> list_;
};

// The larger side of the bounding box of points, one a row.
inline double extent(const Eigen::Ref<const Eigen::MatrixXd>& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

}  // namespace majorant::app
