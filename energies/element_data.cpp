#include <algorithm>

#include "majorant/energies/make_energy.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

void require_finite(const std::string& name, const RowMatrix& rows) {
  for (Index e = 0; e < rows.rows(); ++e)
    if (!rows.row(e).allFinite())
      throw InvalidArgument("density '" + name + "': the data of element " + std::to_string(e) +
                            " are not finite");
}

}  // namespace

ElementRows::ElementRows(RowMatrix rows)
    : size_(static_cast<Index>(rows.rows())), columns_(static_cast<Index>(rows.cols())) {
  const auto owner = std::make_shared<const RowMatrix>(std::move(rows));
  first_ = {owner, owner->data()};
}

ElementRows::ElementRows(const Vec& numbers, Index columns)
    : first_(std::shared_ptr<void>(), numbers.data()),
      size_(static_cast<Index>(numbers.size()) / std::max(columns, Index{1})),
      columns_(columns) {}

ElementRows ElementRows::of(std::span<const Index> elements) const {
  RowMatrix part(elements.size(), columns_);
  for (std::size_t k = 0; k < elements.size(); ++k)
    std::copy_n(first_.get() + elements[k] * columns_, columns_,
                part.row(static_cast<Index>(k)).data());
  return ElementRows(std::move(part));
}

namespace detail {

ElementScalars element_data(const std::string& name, const Vec& numbers) {
  require_finite(name, numbers);
  return ElementScalars(ElementRows(RowMatrix(numbers)));
}

ElementRows element_data(const std::string& name, const RowMatrix& rows) {
  require_finite(name, rows);
  return ElementRows(rows);
}

}  // namespace detail
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
