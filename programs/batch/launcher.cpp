// SPDX-License-Identifier: MIT
#include "batch/launcher.hpp"

#include <array>
#include <cstdlib>
#include <initializer_list>

namespace shaftcull::batch {
namespace {

/// The first of these variables that is set to a number; `otherwise` if none is.
int number_of(std::initializer_list<const char*> variables, int otherwise) noexcept {
  for (const char* const variable : variables) {
    const char* const text = std::getenv(variable);
    if (text == nullptr || *text < '0' || *text > '9') continue;
    return std::atoi(text);
  }
  return otherwise;
}

}  // namespace

Launch launch() noexcept {
  // Of Open MPI, PMIx and PMI (MPICH, Intel, Cray); what Slurm sets of a step says nothing about MPI.
  constexpr std::array from_mpi{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "MPI_LOCALNRANKS"};
  bool mpi = false;
  for (const char* const variable : from_mpi) mpi = mpi || std::getenv(variable) != nullptr;
  return {mpi, number_of({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}, 1),
          number_of({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"}, 0)};
}

bool is_launched() noexcept {
  const Launch found = launch();
  return found.mpi || found.processes > 1;
}

}  // namespace shaftcull::batch
