#include "run.h"

#include <utility>

#include "majorant/framework/energy_term.h"
#include "module.h"

namespace majorant::python {
namespace {

// The interruption flag of the innermost run on the main thread.
std::atomic<std::atomic<bool>*> interrupted_run{nullptr};
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free);
struct sigaction handler_of_python;

extern "C" void on_interrupt(int number, siginfo_t* info, void* context) {
  if (std::atomic<bool>* flag = interrupted_run.load()) flag->store(true);
  if (handler_of_python.sa_flags & SA_SIGINFO)
    handler_of_python.sa_sigaction(number, info, context);
  else
    handler_of_python.sa_handler(number);
}

bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("get_ident")().equal(threading.attr("main_thread")().attr("ident"));
}

bool has_handler(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) ||
         (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN);
}

}  // namespace

bool Raised::guard(const std::function<void()>& call) {
  if (any()) return false;
  const py::gil_scoped_acquire lock;
  try {
    call();
    return true;
  } catch (...) {
    const std::lock_guard alone(alone_);
    if (!any()) {
      first_ = std::current_exception();
      any_.store(true);
    }
    return false;
  }
}

InterruptScope::InterruptScope(std::atomic<bool>& flag) {
  if (!is_main_thread()) return;
  sigaction(SIGINT, nullptr, &before_);
  if (!has_handler(before_)) return;  // the program has switched KeyboardInterrupt off
  outer_ = interrupted_run.exchange(&flag);
  if (!outer_) {
    handler_of_python = before_;
    struct sigaction action = before_;
    action.sa_sigaction = on_interrupt;
    action.sa_flags |= SA_SIGINFO;
    sigaction(SIGINT, &action, nullptr);
  }
  installed_ = true;
}

InterruptScope::~InterruptScope() {
  if (!installed_) return;
  if (!outer_) sigaction(SIGINT, &before_, nullptr);
  interrupted_run.store(outer_);
}

Run::Run(double time_limit, int max_iterations, py::object callback)
    : callback_(std::move(callback)),
      record_(time_limit, max_iterations, &interrupted_, callback_.is_none() ? nullptr : this) {}

Run::Run()
    : record_(std::numeric_limits<double>::infinity(), std::numeric_limits<int>::max(),
              &interrupted_) {}

Directive Run::after_step(const TraceEntry& row, const Vec&) {
  bool ends = false;
  if (!raised_.guard([&] { ends = static_cast<bool>(py::bool_(callback_(row))); }) || ends)
    interrupted_.store(true);
  return Directive::Continue;  // the record polls interrupted_ itself
}

void Run::raise() const {
  raised_.rethrow();
  if (interrupted_.load() && PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_steps(py::module_& module) {
  const auto of_record = [](auto member) {
    return [member](const TraceEntry& row) { return row.record.*member; };
  };
  using R = IterationRecord;
  py::class_<TraceEntry>(module, "Step",
                         R"(A step of a run, taken or not: what callbacks are called with.

    majorant.parametrize(V, F, callback=lambda step: print(step.iteration, step.energy))

iteration          from 1, through the whole run
degree, level      of the map at this step; of the mesh, 0 is the requested one, others are coarser
phase              what it minimizes: 'newton' is the requested energy; 'entry', 'soft-start',
                   'excluded' and 'barrier' are ways to get there
outcome            'moved', or why not: 'at-minimum', 'blocked', ...
energy             after the step, of the requested energy
relative_decrease  of what is minimized
step, step_bound   multiple of Newton's step that was taken, and the largest one that is certified
gradient_norm, newton_decrement   before the step
elapsed            seconds since the start of the run)")
      .def_readonly("degree", &TraceEntry::degree)
      .def_readonly("level", &TraceEntry::level)
      .def_readonly("energy", &TraceEntry::energy)
      .def_readonly("elapsed", &TraceEntry::elapsed)
      .def_property_readonly("phase", [](const TraceEntry& row) { return phase_name(row.phase); })
      .def_property_readonly("outcome",
                             [](const TraceEntry& row) { return outcome_name(row.outcome); })
      .def_property_readonly("iteration", of_record(&R::iteration))
      .def_property_readonly("relative_decrease", of_record(&R::relative_decrease))
      .def_property_readonly("step", of_record(&R::step))
      .def_property_readonly("step_bound", of_record(&R::step_bound))
      .def_property_readonly("gradient_norm", of_record(&R::gradient_norm))
      .def_property_readonly("newton_decrement", of_record(&R::newton_decrement))
      .def("__repr__", [](const TraceEntry& row) {
        return py::str("Step(iteration={}, degree={}, energy={}, relative_decrease={})")
            .format(row.record.iteration, row.degree, row.energy, row.record.relative_decrease);
      });
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
