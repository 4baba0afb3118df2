#include "majorant/mesh/index_lists.h"

#include <algorithm>
#include <utility>

#include "majorant/framework/argument_check.h"

namespace majorant {
namespace {

Index end_of_indices(std::size_t before, std::size_t more) {
  return counted("indices in lists", before + more);
}

}  // namespace

IndexLists::IndexLists(std::initializer_list<std::initializer_list<Index>> lists) {
  for (const auto& list : lists) push_back(list);
}

IndexLists::IndexLists(const std::vector<std::vector<Index>>& lists) {
  std::size_t indices = 0;
  for (const auto& list : lists) indices += list.size();
  reserve(lists.size(), indices);
  for (const auto& list : lists) push_back(list);
}

void IndexLists::push_back(std::span<const Index> list) {
  const Index end = end_of_indices(indices_.size(), list.size());
  if (indices_.capacity() < to_size(end)) {  // the list may be in the memory that moves
    std::vector<Index> moved;
    moved.reserve(std::max(to_size(end), 2 * indices_.size()));
    moved.insert(moved.end(), indices_.begin(), indices_.end());
    moved.insert(moved.end(), list.begin(), list.end());
    indices_ = std::move(moved);
  } else {
    indices_.insert(indices_.end(), list.begin(), list.end());
  }
  ends_.push_back(end);
}

void IndexLists::push_back(std::initializer_list<Index> list) {
  push_back(std::span(list.begin(), list.size()));
}

void IndexLists::append(const IndexLists& lists) {  // may be this object
  const std::size_t before = indices_.size(), more = lists.indices_.size(), count = lists.size();
  indices_.resize(to_size(end_of_indices(before, more)));
  std::copy_n(lists.indices_.begin(), more, indices_.begin() + static_cast<std::ptrdiff_t>(before));
  for (std::size_t k = 0; k < count; ++k)
    ends_.push_back(static_cast<Index>(before) + lists.ends_[k]);
}

void IndexLists::reserve(std::size_t lists, std::size_t indices) {
  ends_.reserve(lists);
  indices_.reserve(indices);
}

void IndexLists::resize(std::size_t lists) {
  if (lists < size()) indices_.resize(first(lists));
  ends_.resize(lists, static_cast<Index>(indices_.size()));
}

void IndexLists::clear() { resize(0); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
