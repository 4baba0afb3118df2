// Solves in several threads of one process have the bits of sequential solves. Settings of the
// process and of other threads are unchanged.
#include <dlfcn.h>
#include <glog/logging.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "framework/barrier_chain.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/obj_file.h"
#include "parametrization/fields/closed_surfaces.h"
#include "parametrization/solve/parametrize_expectations.h"

extern "C" int openblas_get_num_threads(void);
extern "C" void openblas_set_num_threads(int);

namespace majorant {
namespace {

constexpr int kIterations = 3;
const double kNoLimit = std::numeric_limits<double>::infinity();

// More faces than evaluators and checkers process on one thread.
Vec bijective(int threads, RunObserver* observer = nullptr) {
  ParametrizationOptions options = degree(3);
  options.map.injectivity = MapInjectivity::Global;
  options.solve.elevation = Elevation::Direct;
  options.solve.threads = threads;
  RunRecord record(kNoLimit, kIterations, nullptr, observer);
  const ParametrizationResult result = parametrize(generated("creature"), options, record);
  EXPECT_EQ(record.trace().size(), to_size(kIterations));
  expect_valid(result, 3);
  return result.map->control_points();
}

Vec seamless(int threads, RunObserver* observer = nullptr) {
  SeamlessOptions start;
  start.threads = threads;
  RunRecord record(kNoLimit, kIterations, nullptr, observer);
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube(19));
  const Start made = make_seamless(mesh, start, record);
  ParametrizationOptions options = degree(3);
  options.solve.elevation = Elevation::Direct;
  options.solve.threads = threads;
  return parametrize(made.map, options, record).map->control_points();
}

TEST(ConcurrentSolves, GiveTheBitsOfOneAfterTheOther) {
  const Vec first = bijective(1), second = seamless(1);
  for (const auto& [a, b] : {std::pair(2, 3), std::pair(4, 1)}) {
    SCOPED_TRACE(testing::Message() << a << " and " << b << " threads");
    Vec x, y;
    std::thread one([&x, a = a] { x = bijective(a); });
    std::thread other([&y, b = b] { y = seamless(b); });
    one.join();
    other.join();
    EXPECT_EQ(x, first);
    EXPECT_EQ(y, second);
  }
}

// Runs the function by OpenMP, which CHOLMOD links.
template <class Function>
Function* openmp(const char* name) {
  void* function = ::dlsym(RTLD_DEFAULT, name);
  if (!function) throw std::runtime_error(std::string(name) + ": CHOLMOD without OpenMP");
  return reinterpret_cast<Function*>(function);
}
int openmp_threads() { return openmp<int()>("omp_get_max_threads")(); }
void set_openmp_threads(int count) { openmp<void(int)>("omp_set_num_threads")(count); }

// Settings that libraries have for the process, or OpenMP for the calling thread.
struct Settings {
  int openmp = openmp_threads();
  int blas_threads = openblas_get_num_threads();
  int glog_level = FLAGS_minloglevel;
  bool operator==(const Settings&) const = default;
  friend void PrintTo(const Settings& s, std::ostream* out) {
    *out << "OpenMP " << s.openmp << " threads, BLAS " << s.blas_threads << ", glog "
         << s.glog_level;
  }
};

Settings seen_by_another_thread() {
  Settings seen;
  std::thread([&] { seen = Settings(); }).join();
  return seen;
}

// Sets values other than the defaults, and restores the defaults at the end.
class UnusualSettings {
 public:
  UnusualSettings() {
    set_openmp_threads(5);
    FLAGS_minloglevel = google::GLOG_ERROR;
  }
  ~UnusualSettings() {
    set_openmp_threads(before_.openmp);
    FLAGS_minloglevel = before_.glog_level;
  }

 private:
  Settings before_;
};

TEST(ConcurrentSolves, LeaveTheSettingsOfTheProcessAlone) {
  const UnusualSettings unusual;
  const Settings before, elsewhere = seen_by_another_thread();
  int looked = 0;
  StepObserver look([&](const TraceEntry&, const Vec&) {
    ++looked;
    EXPECT_EQ(seen_by_another_thread(), elsewhere);
    return Directive::Continue;
  });
  for (const int threads : {0, 1, 2}) {
    SCOPED_TRACE(threads);
    bijective(threads, &look);
    EXPECT_EQ(Settings(), before);
    seamless(threads, &look);
    EXPECT_EQ(Settings(), before);
  }
  EXPECT_GE(looked, 3 * kIterations);  // the cube's start is already isometric
  const int looked_before_ceres = looked;
  const test::ChainProblem chain(10);
  CeresMinimizer().minimize(chain.problem, chain.start, &look);
  EXPECT_GT(looked, looked_before_ceres);
  EXPECT_EQ(Settings(), before);
}

// CHOLMOD computes with one BLAS thread, a setting of the process.
TEST(ConcurrentSolves, ByCholmodToo) {
  const int blas_threads = openblas_get_num_threads();
  openblas_set_num_threads(2);
  const UnusualSettings unusual;
  const Settings before;
  ASSERT_EQ(before.blas_threads, 2);
  const auto solve = [](Vec& x) {
    ParametrizationOptions options = degree(2);
    options.solve.linear_solver = cholmod_solver;
    RunRecord record(kNoLimit, kIterations);
    x = parametrize(generated("creature"), options, record).map->control_points();
  };
  Vec first, x, y;
  solve(first);
  EXPECT_EQ(Settings(), before);
  std::thread one([&] { solve(x); });
  std::thread other([&] { solve(y); });
  one.join();
  other.join();
  EXPECT_EQ(Settings(), before);
  EXPECT_EQ(x, first);
  EXPECT_EQ(y, first);
  openblas_set_num_threads(blas_threads);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
