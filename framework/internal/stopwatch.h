// Wall-clock time of pieces of work.
//
//     Stopwatch watch;
//     assemble();   record.seconds.assemble = watch.restart();
//     factorize();  record.seconds.factorize = watch.restart();
#pragma once

#include <chrono>
#include <utility>

namespace majorant {

class Stopwatch {
 public:
  // Seconds since the last call, or since construction.
  double restart() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(started_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point started_ = Clock::now();
};

}  // namespace majorant
