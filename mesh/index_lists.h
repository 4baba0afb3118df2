// Lists of indices of different lengths, one after the other in one array (compressed rows), such
// as the corners of polygons. They take 4 bytes a list and 4 an index.
//
//   IndexLists corners = {{0, 1, 2, 3}, {2, 1, 4}};
//   corners.push_back({4, 5, 2});
//   for (const auto list : corners)          // std::span<Index>
//     for (Index& vertex : list) vertex += 10;
//   std::cout << corners[1][2] << ' ' << corners.size() << '\n';
//
// Not for lists that grow or shrink in place: use std::vector<std::vector<Index>>, which converts
// to IndexLists.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <span>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

class IndexLists {
 public:
  // I: Index, or const Index.
  template <class I>
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;  // there are no lists to refer to
    using value_type = std::span<I>;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = std::span<I>;

    Iterator(I* indices, const Index* end) : indices_(indices), end_(end) {}

    std::span<I> operator*() const {
      return {indices_ + first_, to_size(*end_) - static_cast<std::size_t>(first_)};
    }
    Iterator& operator++() {
      first_ = *end_++;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return end_ == other.end_; }

   private:
    I* indices_;
    Index first_ = 0;  // of the present list
    const Index* end_;
  };

  IndexLists() = default;
  IndexLists(std::initializer_list<std::initializer_list<Index>> lists);
  IndexLists(const std::vector<std::vector<Index>>& lists);

  std::size_t size() const { return ends_.size(); }
  bool empty() const { return ends_.empty(); }

  // Valid until lists are added or removed. const, so that `lists[k] = other` does not compile:
  // assigning to a span would not change the list.
  const std::span<Index> operator[](std::size_t k) {
    return {indices_.data() + first(k), to_size(ends_[k]) - first(k)};
  }
  const std::span<const Index> operator[](std::size_t k) const {
    return {indices_.data() + first(k), to_size(ends_[k]) - first(k)};
  }
  const std::span<Index> back() { return (*this)[size() - 1]; }
  const std::span<const Index> back() const { return (*this)[size() - 1]; }
  Iterator<Index> begin() { return {indices_.data(), ends_.data()}; }
  Iterator<Index> end() { return {indices_.data(), ends_.data() + size()}; }
  Iterator<const Index> begin() const { return {indices_.data(), ends_.data()}; }
  Iterator<const Index> end() const { return {indices_.data(), ends_.data() + size()}; }

  // Returns the indices of all lists.
  std::span<Index> indices() { return indices_; }
  std::span<const Index> indices() const { return indices_; }

  // The functions that add lists throw Error(Unsupported) if there are more than 2^31 - 1 indices,
  // and then change nothing.
  void push_back(std::span<const Index> list);  // may be a list of this object
  void push_back(std::initializer_list<Index> list);
  void append(const IndexLists& lists);
  void reserve(std::size_t lists, std::size_t indices);
  void resize(std::size_t lists);  // new ones are empty
  void clear();

  friend bool operator==(const IndexLists&, const IndexLists&) = default;

 private:
  std::size_t first(std::size_t k) const { return k == 0 ? 0 : to_size(ends_[k - 1]); }

  std::vector<Index> indices_;
  std::vector<Index> ends_;  // of each list, in indices_
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
