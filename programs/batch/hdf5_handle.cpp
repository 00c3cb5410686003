// SPDX-License-Identifier: MIT
#include "batch/hdf5_handle.hpp"

#include <string_view>

namespace shaftcull::batch {

QuietHdf5::QuietHdf5() noexcept {
  // A file that could not be written would be tried again when the program ends, and HDF5 1.10 crashes then.
  static const herr_t once = H5dont_atexit();
  static_cast<void>(once);
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

std::string hdf5_reason() {
  std::string reason;
  const auto take_first = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
    auto& first = *static_cast<std::string*>(text);
    if (first.empty() && error->desc != nullptr) first = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &reason);
  // Of what the system says, only that: "file write failed: time = …, error message = 'No space left on device', …".
  constexpr std::string_view system_says = "error message = '";
  if (const std::size_t at = reason.find(system_says); at != std::string::npos) {
    const std::size_t begin = at + system_says.size();
    reason = reason.substr(begin, reason.find('\'', begin) - begin);
  }
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

}  // namespace shaftcull::batch
