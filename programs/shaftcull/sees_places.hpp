// SPDX-License-Identifier: MIT
/// Files of answers that many processes write at once: each piece has its place, which the lengths of all say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "batch/written_file.hpp"
#include "sees_run.hpp"

namespace shaftcull::cli {

/// Where in a file the answers of parts go, and what else there is in it. Each process has one of these. First all
/// parts are measured, then numbers are added up over the processes and places found, then pieces are written, by any
/// process and in any order; last, one process writes what depends on all. Then the file is, bit for bit, what
/// sight_file() makes.
class SightPlaces {
 public:
  SightPlaces() = default;
  SightPlaces(const SightPlaces&) = delete;
  SightPlaces& operator=(const SightPlaces&) = delete;
  virtual ~SightPlaces() = default;

  /// Notes how many rows or bytes of the file a part takes. Each part is measured by one process.
  virtual void measure(std::size_t part, const PartAnswer& answer) = 0;
  /// What was noted, 0 for what others have. To be added up over the processes.
  [[nodiscard]] virtual std::span<std::uint64_t> lengths() = 0;
  /// Finds all places, when lengths() are those of all parts.
  virtual void arrange() = 0;

  /// How many pieces there are besides those of parts.
  [[nodiscard]] virtual std::size_t other_pieces() const = 0;
  /// Both throw std::runtime_error if it cannot be written. Threads may write different pieces at the same time.
  virtual void write_other(std::size_t piece, batch::WrittenFile& file) = 0;
  virtual void write_part(std::size_t part, const PartAnswer& answer, batch::WrittenFile& file) = 0;

  /// What complete() has to know of pieces that were written, 0 of those that others wrote. To be added up.
  [[nodiscard]] virtual std::span<std::uint64_t> sums() = 0;
  /// Writes what is left, when sums() are those of all pieces. Throws std::runtime_error likewise.
  virtual void complete(batch::WrittenFile& file) const = 0;
};

/// For such a file as sight_file() makes, not a stream; of so many parts. Throws as that does, but makes no file.
/// Refers to the scene and the order.
[[nodiscard]] std::unique_ptr<SightPlaces> sight_places(const std::string& path, const SeesScene& scene,
                                                        const PatchSet& patches, const SightContent& content);

/// Writes bytes one behind the other from some place on, many at a time.
class PlacedBytes {
 public:
  PlacedBytes(batch::WrittenFile& file, std::uint64_t place) : file_(file), place_(place) {}

  void append(std::span<const std::byte> bytes);
  /// Writes what is not yet written. To be called at the end.
  void finish();

 private:
  batch::WrittenFile& file_;
  std::uint64_t place_;
  std::vector<std::byte> waiting_;
};

}  // namespace shaftcull::cli
