#include "majorant/pictures/internal/claimed_energy.h"

#include <nlohmann/json.hpp>

#include "majorant/energies/internal/energy_text.h"
#include "majorant/framework/error.h"
#include "majorant/io/internal/json_depth.h"

namespace majorant {

ClaimedEnergy claimed_energy(const MapFile& map) {
  try {
    require_shallow_json("claims", map.claims);
  } catch (const Error&) {
    return {};
  }
  const auto claims = nlohmann::json::parse(map.claims, nullptr, false);
  if (!claims.is_object() || !claims.contains("energy") || !claims["energy"].is_string()) return {};
  const auto name = claims["energy"].get<std::string>();
  const std::optional<EnergySum> sum = find_energy_sum(name);
  return sum ? ClaimedEnergy{name, *sum} : ClaimedEnergy{};
}

}  // namespace majorant
