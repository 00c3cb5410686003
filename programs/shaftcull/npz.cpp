// SPDX-License-Identifier: MIT
#include "npz.hpp"

#include <string_view>

namespace shaftcull::cli {

NpyArray& NpzFile::add(NpyFormat format) {
  arrays_.push_back(std::make_unique<NpyArray>(file_, std::move(format)));
  return *arrays_.back();
}

void NpzFile::finish() {
  NpzLayout layout;
  std::vector<std::uint32_t> crcs;
  for (const std::unique_ptr<NpyArray>& array : arrays_) {
    layout.add(array->format(), array->spool().size() / array->format().row_bytes());
    crcs.push_back(array->crc());
  }
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    file_.write(layout.head(i, crcs[i]));
    arrays_[i]->spool().read_all([&](std::string_view bytes) { file_.write(bytes); });
  }
  file_.write(layout.directory(crcs));
  file_.finish();
}

}  // namespace shaftcull::cli
