// SPDX-License-Identifier: MIT
/// Checksums of what is read and kept: XXH3.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace shaftcull::batch {

/// 64 bits, to notice damage.
[[nodiscard]] std::uint64_t checksum(std::span<const std::byte> bytes) noexcept;

/// 128 bits, to tell inputs apart.
using Fingerprint = std::array<std::uint64_t, 2>;
[[nodiscard]] Fingerprint fingerprint(std::span<const std::byte> bytes) noexcept;
[[nodiscard]] std::string hexadecimal(const Fingerprint& fingerprint);

/// A checksum of bytes that come in pieces: that of all of them one behind the other.
class RunningChecksum {
 public:
  RunningChecksum();
  RunningChecksum(const RunningChecksum&) = delete;
  RunningChecksum& operator=(const RunningChecksum&) = delete;
  ~RunningChecksum();

  void add(std::span<const std::byte> bytes) noexcept;
  [[nodiscard]] std::uint64_t value() const noexcept;

 private:
  void* state_;
};

}  // namespace shaftcull::batch
