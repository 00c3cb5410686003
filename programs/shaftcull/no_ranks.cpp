// SPDX-License-Identifier: MIT
/// Stands in for sees_ranks.cpp and facet_ranks.cpp where the program is built without HDF5 or xxHash.
#include "facet_ranks.hpp"
#include "sees_ranks.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

[[noreturn]] void refuse(const std::string& verb) {
  throw InvalidArgument(
      verb +
      ": this program was built without HDF5 or xxHash and cannot share work with other processes; install both "
      "(Debian: libhdf5-openmpi-dev and libxxhash-dev) and MPI (libopenmpi-dev), then build again");
}

}  // namespace

void run_on_launched_ranks(SeesJob& /*job*/) { refuse("sees"); }

void run_factors_in_parts(const FactorsOptions& /*options*/, std::optional<FactorsResult>&& /*scene*/) {
  refuse("factors");
}

void run_sun_in_parts(const SunOptions& /*options*/, std::optional<SunResult>&& /*scene*/) { refuse("sun"); }

bool can_keep_parts() noexcept { return false; }

}  // namespace shaftcull::cli
