// SPDX-License-Identifier: MIT
#include "batch/parallel.hpp"

#include <algorithm>

#ifdef SHAFTCULL_BATCH_WITH_TBB
#include <tbb/parallel_for.h>
#endif

namespace shaftcull::batch {

void for_chunks(std::size_t count, std::size_t chunk, const std::function<void(std::size_t, std::size_t)>& work) {
  const auto one = [&](std::size_t i) { work(i * chunk, std::min(chunk, count - i * chunk)); };
  const std::size_t chunks = count / chunk + (count % chunk != 0 ? 1 : 0);
#ifdef SHAFTCULL_BATCH_WITH_TBB
  tbb::parallel_for(std::size_t{0}, chunks, one);
#else
  for (std::size_t i = 0; i != chunks; ++i) one(i);
#endif
}

}  // namespace shaftcull::batch
