#include <fmt/format.h>

#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/internal/input_file.h"
#include "majorant/io/map_file.h"
#include "majorant/io/map_proof.h"

namespace majorant {

FileVerification certification(std::string path, ProofRequest wanted, const MapFile* written) {
  return [path = std::move(path), wanted, written](const std::string& temporary) {
    const auto refuse = [&](const std::string& reason) {
      throw Error(ErrorKind::Invalid,
                  fmt::format("{} is not written, since what it says would not be valid: {}", path,
                              reason));
    };
    try {
      MapFile file = read_map(temporary);
      if (format_of(path) == ".msh" && written != nullptr) {
        if (file.degree != written->degree || file.cells.rows() != written->cells.rows() ||
            file.cells != written->cells)
          refuse("its cells are not those of the map");
        file.points = written->points;
        file.input_vertex = written->input_vertex;
        file.input_face = written->input_face;
      }
      const MapProof proof(file, path, wanted);
      if (proof.verdict() != Answer::Proven) refuse(proof.first_defect());
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::Unreadable && e.kind() != ErrorKind::Unsupported) throw;
      refuse(e.what());
    }
  };
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
