// What a certificate says of one element: whether det J is positive on all of it.
#pragma once

namespace majorant {

enum class Positivity { Certified, Violated, Undecided };

struct PositivityProof {
  Positivity result = Positivity::Undecided;
  double lower_bound = 0;  // of the minimum on the element; certified whatever the result
  int depth = 0;           // of bisection that was needed
};

}  // namespace majorant
