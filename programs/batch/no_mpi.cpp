// SPDX-License-Identifier: MIT
/// Stands in for mpi_ranks.cpp where the program is built without MPI.
#include <fmt/format.h>

#include "batch/launcher.hpp"
#include "batch/ranks.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::batch {

bool has_mpi() noexcept { return false; }

std::unique_ptr<Ranks> launched_ranks() {
  const Launch started = launch();
  if (started.processes > 1) {
    if (started.process != 0) throw OtherRankFailed(2);
    throw InvalidArgument(
        fmt::format("{} processes were started, but this program was built without MPI and runs in a single process; "
                    "install MPI (Debian: libopenmpi-dev), then configure with SHAFTCULL_WITH_MPI=ON and build again",
                    started.processes));
  }
  return one_rank();
}

}  // namespace shaftcull::batch
