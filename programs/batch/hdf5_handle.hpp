// SPDX-License-Identifier: MIT
/// What HDF5 hands out, closed when it goes; and what HDF5 says went wrong.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace shaftcull::batch {

/// Owns an identifier of HDF5.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() noexcept = default;
  Hdf5Handle(hid_t id, Close how) noexcept : id_(id), close_(how) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }

  /// Whether HDF5 gave one.
  explicit operator bool() const noexcept { return id_ >= 0; }
  operator hid_t() const noexcept { return id_; }  // NOLINT(google-explicit-constructor): goes where an id goes

  /// Closes it now. False if that failed, as it does where what was still to be written could not be.
  [[nodiscard]] bool close() noexcept { return id_ < 0 || close_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// While one exists, HDF5 prints nothing itself.
class QuietHdf5 {
 public:
  QuietHdf5() noexcept;
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5();

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// The innermost reason of what failed last.
[[nodiscard]] std::string hdf5_reason();

}  // namespace shaftcull::batch
