// SPDX-License-Identifier: MIT
#include "holders.hpp"

#include <string>

namespace shaftcull::python {

namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + (count == 1 ? one : many);
}

}  // namespace

void FlatLayers::set(std::size_t bounds, std::span<const std::uint32_t> layers) {
  if (layers.size() != bounds) {
    throw InvalidArgument("set_layers() of " + counted(bounds, " bound", " bounds") + " got the layers of " +
                          std::to_string(layers.size()) + "; give those of each");
  }
  all_.assign(layers.begin(), layers.end());
}

void FlatLayers::set_some(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers) {
  if (indices.size() != layers.size()) {
    throw InvalidArgument("set_layers() got " + counted(indices.size(), " index", " indices") + " and the layers of " +
                          counted(layers.size(), " bound", " bounds") + "; every index needs those of one bound");
  }
  if (indices.empty()) return;
  if (all_.empty()) {
    throw InvalidArgument("set_layers() of some bounds, and there are no layers yet; give those of all bounds first");
  }
  for (std::size_t i = 0; i != indices.size(); ++i) all_[indices[i]] = layers[i];
}

}  // namespace shaftcull::python
