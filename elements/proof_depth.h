// How often a triangle is bisected before a proof of det J > 0 is given up (ElementSpace::certify).
//
// One rule of three values: what is checked often is checked quickly, what is certified once is
// certified as well as possible. A deeper proof never contradicts a shallower one.
#pragma once

namespace majorant {

struct ProofDepth {
  // While optimizing. Origin: bench/tune.py depth.
  static constexpr int kStart = 5;
  // Where kStart holds a run back. Origin: bench/tune.py deepest_bisection.
  static constexpr int kDeepest = 13;
  // Of results, once a file. Origin: a little deeper than what was optimized, so that what went
  // through there is proven again although it has been scaled and rounded.
  static constexpr int kFinal = 16;
};

}  // namespace majorant
