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

ElementRows ElementRows::of(std::span<const Index> elements) const {
  RowMatrix part(elements.size(), rows_->cols());
  for (std::size_t k = 0; k < elements.size(); ++k)
    part.row(static_cast<Index>(k)) = rows_->row(elements[k]);
  return ElementRows(std::move(part));
}

template class ElementValues<double>;

namespace detail {

ElementValues<double> element_data(const std::string& name, const Vec& numbers) {
  require_finite(name, numbers);
  return ElementValues<double>({numbers.begin(), numbers.end()});
}

ElementRows element_data(const std::string& name, const RowMatrix& rows) {
  require_finite(name, rows);
  return ElementRows(rows);
}

}  // namespace detail
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
