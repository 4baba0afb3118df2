#include "majorant/mesh/refusal.h"

#include <cstddef>

namespace majorant {

std::string_view words_of(Hint hint) {
  constexpr std::string_view kWords[] = {
      "repair()",
      "unwrap() cuts it open",
      "parametrize() maps it with its holes",
      "use unwrap()",
      "take another start",
      "leave out MapOptions::initial, or use unwrap()",
      "ask for MapInjectivity::Local, or use unwrap()",
      "ask for MapInjectivity::Local or for another start, or use unwrap()",
      "use texture_cuts(), or take another start",
      "make_seamless()",
      "SeamlessMethod::ScaledField",
      "choose other cones",
      "CutMethod::Automatic",
      "leave out its target, start from a map that meets the pins",
      "BoundaryCondition::Fixed",
      "the limits of the RunRecord",
      "map it by itself",
      "write it as MshContent::Surface, or compare it with nothing",
      "take Islands::Mapped",
      "leave the legends out"};
  return kWords[static_cast<std::size_t>(hint)];
}

Refusal::Refusal(ErrorKind kind, const std::string& file, const std::string& begin, Hint hint,
                 const std::string& end)
    : Error(kind, begin + std::string(words_of(hint)) + end),
      file_(file),
      begin_(begin),
      end_(end),
      hint_(hint) {}

std::string Refusal::message(std::string_view words) const {
  return begin_ + std::string(words) + end_;
}

std::string message_of(const Error& error,
                       const std::function<std::string(const Refusal&)>& words) {
  const auto* const refusal = dynamic_cast<const Refusal*>(&error);
  return refusal ? refusal->message(words(*refusal)) : error.what();
}

std::string problem_of(const Error& error) {
  const auto* const refusal = dynamic_cast<const Refusal*>(&error);
  return refusal ? refusal->problem() : error.what();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
