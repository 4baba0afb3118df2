#include "apps/refusal_message.h"

#include <fmt/format.h>

#include "majorant/mesh/refusal.h"

namespace majorant::app {
namespace {

// {} stands for the file.
const char* command_words(Hint hint) {
  switch (hint) {
    case Hint::Repair:
      return "`majorant unwrap {} -o OUT.obj`";
    case Hint::CutOpen:
      return "`majorant unwrap {} -o OUT.obj` cuts it open, along --seams auto";
    case Hint::MapWithHoles:
      return "`majorant unwrap {} -o OUT.obj` maps it with its holes";
    case Hint::Unwrap:
      return "use `majorant unwrap`";
    case Hint::OtherStart:
      return "leave out --init input";
    case Hint::OtherStartOrUnwrap:
      return "leave out --init input, or use `majorant unwrap`";
    case Hint::AllowOverlaps:
      return "leave out --bijective, or use `majorant unwrap`";
    case Hint::AllowOrOtherStart:
      return "leave out --bijective or --init input, or use `majorant unwrap`";
    case Hint::CutTexture:
      return "use --seamless or `majorant unwrap --seams uv`, or leave out --init input";
    case Hint::MakeSeamless:
      return "`majorant seamless`";
    case Hint::ScaledField:
      return "--start scaled-field";
    case Hint::OtherCones:
      return "choose other cones with --cones";
    case Hint::AutomaticCuts:
      return "--seams auto";
    case Hint::LeavePin:
      return "hold it there with \"target\": \"initial\", start from a map that meets the pins "
             "with "
             "--init input";
    case Hint::FreeBoundary:
      return "--boundary fixed";
    case Hint::RaiseLimits:
      return "--max-iterations or --time-limit";
    case Hint::MapAlone:
      return "put it in a file of its own";
    case Hint::WriteSurface:
      return "write it with --msh surface, or leave --surface out";
    case Hint::MapIslands:
      return "leave out --keep-shape";
    case Hint::LeaveOutLegends:
      return "leave the legends out with --legend no";
  }
  return "";
}

}  // namespace

std::string command_message(const Error& error) {
  return message_of(error, [](const Refusal& refusal) {
    return fmt::format(fmt::runtime(command_words(refusal.hint())), refusal.file());
  });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
