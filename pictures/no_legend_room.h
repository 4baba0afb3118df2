// A sheet of a picture on which its legends leave no room for the layout. Programs have words of
// their own for how to leave these out.
//
//   try {
//     write_svg("map.svg", file, {.size = SheetSize{120, 60}});
//   } catch (const NoLegendRoom& refused) {
//     say("{}: clear the box of legends\n", refused.what());
//   }
#pragma once

#include "majorant/framework/error.h"

namespace majorant {

class NoLegendRoom : public Error {
 public:
  explicit NoLegendRoom(const std::string& message) : Error(ErrorKind::Usage, message) {}
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
