#include <fmt/format.h>

#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/map_file.h"
#include "majorant/io/map_proof.h"

namespace majorant {

FileVerification certification(std::string path, ProofRequest wanted) {
  return [path = std::move(path), wanted](const std::string& temporary) {
    const auto refuse = [&](const std::string& reason) {
      throw Error(ErrorKind::Invalid,
                  fmt::format("{} is not written, since what it says would not be valid: {}", path,
                              reason));
    };
    try {
      const MapFile file = read_map(temporary);
      const MapProof proof(file, path, wanted);
      if (proof.verdict() != Answer::Proven) refuse(proof.first_defect());
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::Unreadable && e.kind() != ErrorKind::Unsupported) throw;
      refuse(e.what());
    }
  };
}

}  // namespace majorant
