#include "majorant/io/internal/dropped_parts.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

const char* consequence(DroppedPart part) {
  switch (part) {
    case DroppedPart::FaceTexcoords:
    case DroppedPart::PartialTexcoords:
      return "the face is read without texture coordinates";
    case DroppedPart::FaceNormals:
    case DroppedPart::PartialNormals:
      return "the face is read without normals";
    case DroppedPart::Slash:
      return "read without it";
    case DroppedPart::Faces:
      return "the file ends there and is read without the others";
    case DroppedPart::Texcoord:
    case DroppedPart::Normal:
    case DroppedPart::Color:
    case DroppedPart::Element:
    case DroppedPart::Line:
      break;
  }
  return "left out";
}

// Corners without coordinates do not damage those that have some.
bool must_stay(DroppedPart part, Strictness strictness) {
  if (strictness != Strictness::Texcoords) return strictness == Strictness::Everything;
  return part == DroppedPart::Texcoord || part == DroppedPart::FaceTexcoords;
}

}  // namespace

void DroppedParts::begin(DroppedPart part, Entry& entry, std::string problem) const {
  if (must_stay(part, strictness_))
    throw Error(ErrorKind::Unreadable, problem + "; correct the file");
  entry.problem = std::move(problem);
}

void DroppedParts::conclude(PolygonMesh& mesh) const {
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const auto& [count, problem] = entries_[k];
    if (count == 0) continue;
    mesh.warnings.push_back(fmt::format(
        "{}: {}{}", problem, consequence(static_cast<DroppedPart>(k)),
        count == 1 ? "" : fmt::format(", as {} {} more", count == 2 ? "is" : "are", count - 1)));
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
