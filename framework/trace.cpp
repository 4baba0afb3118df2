#include "majorant/framework/trace.h"

namespace majorant {

std::string_view phase_name(Phase phase) {
  switch (phase) {
    case Phase::Newton:
      return "newton";
    case Phase::Entry:
      return "entry";
    case Phase::SoftStart:
      return "soft-start";
    case Phase::Excluded:
      return "excluded";
    case Phase::Barrier:
      return "barrier";
  }
  return "newton";
}

std::string_view remedy_name(Remedy remedy) {
  switch (remedy) {
    case Remedy::Deepen:
      return "deepen";
    case Remedy::Refine:
      return "refine";
    case Remedy::Exclude:
      return "exclude";
    case Remedy::FollowBarrier:
      return "follow-barrier";
  }
  return "deepen";
}

}  // namespace majorant
