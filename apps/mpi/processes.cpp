#include "apps/mpi/processes.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <petscsys.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "apps/mpi/internal/petsc_call.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

constexpr int kTag = 17;  // the tag of all messages; each pair of ranks has one message at a time

int message_size(std::size_t size) {
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(ErrorKind::Unsupported,
                "a message between two ranks is too large for MPI; use more ranks");
  return static_cast<int>(size);
}

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
    MPI_Comm_size(PETSC_COMM_WORLD, &count_);
  }

  int rank() const override { return rank_; }
  int count() const override { return count_; }

  // MPI_Allreduce is not used, since its order of additions is unspecified.
  void sum(std::span<double> values) const override {
    if (count_ == 1) return;
    const int size = message_size(values.size());
    std::vector<double> all(values.size() * static_cast<std::size_t>(count_));
    MPI_Allgather(values.data(), size, MPI_DOUBLE, all.data(), size, MPI_DOUBLE, PETSC_COMM_WORLD);
    std::copy_n(all.begin(), values.size(), values.begin());
    for (std::size_t k = values.size(); k < all.size(); ++k) values[k % values.size()] += all[k];
  }

  void min(std::span<double> values) const override {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), message_size(values.size()), MPI_DOUBLE, MPI_MIN,
                  PETSC_COMM_WORLD);
  }

  void broadcast(std::span<std::byte> bytes) const override {
    MPI_Bcast(bytes.data(), message_size(bytes.size()), MPI_BYTE, 0, PETSC_COMM_WORLD);
  }

  void exchange(std::span<const Message> sent, std::span<const Message> received) const override {
    std::vector<MPI_Request> requests(sent.size() + received.size());
    auto request = requests.begin();
    for (const Message& p : received)
      MPI_Irecv(p.values.data(), message_size(p.values.size()), MPI_DOUBLE, p.rank, kTag,
                PETSC_COMM_WORLD, &*request++);
    for (const Message& p : sent)
      MPI_Isend(p.values.data(), message_size(p.values.size()), MPI_DOUBLE, p.rank, kTag,
                PETSC_COMM_WORLD, &*request++);
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }

 private:
  int rank_ = 0, count_ = 1;
};

// Gives each rank one thread: one for OpenMP loops of MUMPS and hypre, and ranks that wait yield
// the processor.
void be_one_thread() {
  if (void* set = ::dlsym(RTLD_DEFAULT, "omp_set_num_threads"))
    reinterpret_cast<void (*)(int)>(set)(1);
  ::setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

}  // namespace

// Signals, failures and obeyed options are set here. Given options come last and take precedence.
Processes::Processes(const std::vector<std::string>& petsc_options)
    : words_{"majorant-mpi", "-no_signal_handler", "-skip_petscrc",
             // The iterations of PETSc's defaults (Falgout, classical), in 0.8 of the time.
             "-majorant_hypre_pc_hypre_boomeramg_coarsen_type", "HMIS",
             "-majorant_hypre_pc_hypre_boomeramg_interp_type", "ext+i",
             "-majorant_hypre_pc_hypre_boomeramg_P_max", "4", "-majorant_icc_sub_pc_type", "icc",
             "-majorant_icc_sub_pc_factor_shift_type", "positive_definite",
             "-majorant_gamg_pc_gamg_reuse_interpolation", "false"} {
  own_ = words_.size();
  words_.insert(words_.end(), petsc_options.begin(), petsc_options.end());
  for (std::string& word : words_) pointers_.push_back(word.data());
  int count = static_cast<int>(pointers_.size());
  pointers_.push_back(nullptr);
  char** argv = pointers_.data();
  for (const char* variable : {"PETSC_OPTIONS", "PETSC_OPTIONS_YAML"}) ::unsetenv(variable);
  be_one_thread();
  keep_petsc_messages();
  try {
    require_petsc(PetscInitialize(&count, &argv, nullptr, nullptr));
  } catch (const Error& e) {
    if (petsc_options.empty()) throw;
    throw Error(ErrorKind::Usage, fmt::format("--petsc-options: {}", e.what()));
  }
  require_petsc(PetscOptionsSetValue(nullptr, "-options_left", "no"));
  ranks_ = std::make_shared<const MpiRanks>();
}

Processes::~Processes() { PetscFinalize(); }

std::vector<std::string> Processes::unused_options() const {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  require_petsc(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  std::vector<std::string> unused;
  for (PetscInt k = 0; k < count; ++k) {
    const std::string option = std::string("-") + names[k];
    const auto is_it = [&](const std::string& word) {
      return word == option || word == "-" + option;
    };
    if (std::any_of(words_.begin() + static_cast<std::ptrdiff_t>(own_), words_.end(), is_it))
      unused.push_back(option);
  }
  require_petsc(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
  return unused;
}

bool is_first_process() {
  int started = 0, rank = 0;
  MPI_Initialized(&started);
  if (started != 0) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank == 0;
}

// PETSc's headers count MPI calls of the sources that include them, which includes ours.
Traffic traffic() {
  return {petsc_isend_ct + petsc_send_ct, petsc_isend_len + petsc_send_len,
          petsc_allreduce_ct + petsc_gather_ct};
}

void Processes::abort(int code) const {
  MPI_Abort(PETSC_COMM_WORLD, code);
  std::abort();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
