// SPDX-License-Identifier: MIT
/// What started this process.
#pragma once

namespace shaftcull::batch {

/// What launchers of MPI and Slurm put into the environment.
struct Launch {
  bool mpi;       ///< a launcher of MPI started it: mpirun, or srun with --mpi
  int processes;  ///< how many were started along with it, 1 if nothing says so
  int process;    ///< its number among them
};

[[nodiscard]] Launch launch() noexcept;

/// Whether a launcher of MPI, or srun, started this process.
[[nodiscard]] bool is_launched() noexcept;

}  // namespace shaftcull::batch
