// SPDX-License-Identifier: MIT
/// Stands in for batch_job.cpp where the program is built without HDF5 or xxHash.
#include "batch_job.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {

void run_batch_job(const batch::Job& /*job*/, int /*threads*/, const std::function<void()>& /*check*/) {
  throw InvalidArgument(
      "batch: this program was built without HDF5 or xxHash and cannot run batches; install both (Debian: libhdf5-dev "
      "or libhdf5-openmpi-dev, and libxxhash-dev), then configure with SHAFTCULL_WITH_HDF5=ON and build again");
}

}  // namespace shaftcull::cli
