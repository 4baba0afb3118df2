// A refusal with a remedy, which a program can express in its own words: a command names its
// options, a dialogue its buttons.
//
//   try {
//     parametrize(mesh, {});
//   } catch (const Refusal& refusal) {
//     if (refusal.hint() == Hint::CutOpen) unwrap(mesh, {}, record);
//   }
//
// Programs without words of their own use what(), the whole message in the words of the library, as
// for any Error.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"

namespace majorant {

// The remedies, in the words of the library.
enum class Hint {
  Repair,              // repair()
  CutOpen,             // unwrap() cuts it open
  MapWithHoles,        // parametrize() maps it with its holes
  Unwrap,              // use unwrap()
  OtherStart,          // use another start
  OtherStartOrUnwrap,  // leave out MapOptions::initial, or use unwrap()
  AllowOverlaps,       // use MapInjectivity::Local, or unwrap()
  AllowOrOtherStart,   // use MapInjectivity::Local or another start, or unwrap()
  CutTexture,          // use texture_cuts(), or another start
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
// Returns the words of a hint above.
std::string_view words_of(Hint hint);

class Refusal : public Error {
 public:
  // The message is begin + words_of(hint) + end. begin: the defect, and behind the last "; " the
  // transition to the remedy. file: of the mesh, or empty.
  Refusal(ErrorKind kind, const std::string& file, const std::string& begin, Hint hint,
          const std::string& end = {});
  Hint hint() const { return hint_; }
  const std::string& file() const { return file_; }
  // Returns the message with other words for the remedy.
  std::string message(std::string_view words) const;
  // Returns the message without the remedy.
  std::string problem() const { return begin_.substr(0, begin_.rfind("; ")); }

 private:
  std::string file_, begin_, end_;
  Hint hint_;
};

// Returns the message of any error, with other words for the remedy if it is a Refusal.
std::string message_of(const Error& error, const std::function<std::string(const Refusal&)>& words);
// Returns the message of any error, without the remedy if it is a Refusal: for programs that judge
// the output of others.
std::string problem_of(const Error& error);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
