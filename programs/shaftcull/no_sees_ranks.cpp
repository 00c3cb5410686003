// SPDX-License-Identifier: MIT
/// Stands in for sees_ranks.cpp where the program is built without HDF5 or xxHash.
#include "batch/launcher.hpp"
#include "sees_ranks.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {

bool is_launched() noexcept {
  const batch::Launch launch = batch::launch();
  return launch.mpi || launch.processes > 1;
}

void run_on_launched_ranks(SeesJob& /*job*/) {
  throw InvalidArgument(
      "sees: this program was built without HDF5 or xxHash and cannot share work with other processes; install both "
      "(Debian: libhdf5-openmpi-dev and libxxhash-dev) and MPI (libopenmpi-dev), then build again");
}

}  // namespace shaftcull::cli
