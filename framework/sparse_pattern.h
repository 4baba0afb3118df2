// The fixed sparsity pattern of a reduced Hessian: lower triangle, compressed columns, row numbers
// sorted within a column, every diagonal entry present.
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct SparsePattern {
  Index size = 0;
  std::vector<Index> column_starts;  // size + 1
  std::vector<Index> rows;           // nonzeros
  std::vector<Index> block_of;       // size: unknowns with equal numbers are ordered together
  Index nonzeros() const { return static_cast<Index>(rows.size()); }
};

}  // namespace majorant
