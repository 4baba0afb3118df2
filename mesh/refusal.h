// A refusal that says what would help, so that a program can say it in words of its own: the
// command names its options, a dialogue its buttons.
//
//   try {
//     parametrize(mesh, {});
//   } catch (const Refusal& refusal) {
//     if (refusal.hint() == Hint::CutOpen) unwrap(mesh, {}, record);
//   }
//
// Not for programs without words of their own: what() is the whole message in those of the library,
// as of any Error.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"

namespace majorant {

// In the words of the library.
enum class Hint {
  Repair,              // repair()
  CutOpen,             // unwrap() cuts it open
  MapWithHoles,        // parametrize() maps it with its holes
  Unwrap,              // use unwrap()
  OtherStart,          // take another start
  OtherStartOrUnwrap,  // leave out MapOptions::initial, or use unwrap()
  AllowOverlaps,       // ask for MapInjectivity::Local, or use unwrap()
  AllowOrOtherStart,   // ask for MapInjectivity::Local or for another start, or use unwrap()
  CutTexture,          // use texture_cuts(), or take another start
  MakeSeamless,        // make_seamless()
  ScaledField,         // SeamlessMethod::ScaledField
  OtherCones,          // choose other cones
  AutomaticCuts,       // CutMethod::Automatic
  LeavePin,            // leave out its target, start from a map that meets the pins
  FreeBoundary,        // BoundaryCondition::Fixed
  RaiseLimits,         // the limits of the RunRecord
  MapAlone,            // map it by itself
  WriteSurface,        // write it as MshContent::Surface, or compare it with nothing
  MapIslands,          // Islands::Mapped
  LeaveOutLegends,     // leave the legends out
};
// The words behind each hint above.
std::string_view words_of(Hint hint);

class Refusal : public Error {
 public:
  // The message is begin + words_of(hint) + end; begin is what is wrong, behind the last "; " how
  // it leads to the remedy. file: of the mesh, or empty.
  Refusal(ErrorKind kind, const std::string& file, const std::string& begin, Hint hint,
          const std::string& end = {});
  Hint hint() const { return hint_; }
  const std::string& file() const { return file_; }
  // The message with other words for the remedy.
  std::string message(std::string_view words) const;
  // The message without the remedy.
  std::string problem() const { return begin_.substr(0, begin_.rfind("; ")); }

 private:
  std::string file_, begin_, end_;
  Hint hint_;
};

// The message of any error, with other words for the remedy where it is a Refusal.
std::string message_of(const Error& error, const std::function<std::string(const Refusal&)>& words);
// The message of any error without the remedy, where it is a Refusal; else all of it. For those who
// judge what others have made.
std::string problem_of(const Error& error);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
