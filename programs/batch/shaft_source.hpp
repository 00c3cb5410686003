// SPDX-License-Identifier: MIT
/// The shafts of a job, formed where they are needed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "batch/array_file.hpp"
#include "batch/float_rows.hpp"
#include "batch/question.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::batch {

/// Rows of an array that say which shafts: two boxes in 12 floats (lo x, lo y, lo z, hi x, hi y, hi z, twice); a box
/// and a vector in 9; or two positions in an array of boxes. Boxes may be of doubles: they become boxes of floats that
/// contain them, relative to an origin.
class ShaftSource {
 public:
  /// `boxes` is empty unless rows are pairs of positions. Throws InvalidArgument, which names the file and says what it
  /// should hold, if the arrays do not fit each other or `kind`.
  ShaftSource(const std::string& shafts, const std::string& boxes, ShaftKind kind, const Origin& origin = {});

  [[nodiscard]] std::uint64_t size() const noexcept { return rows_->rows(); }
  /// The arrays that are read: one, or two.
  [[nodiscard]] std::vector<const ArrayFile*> arrays() const;

  /// Has the system read these rows while this thread goes on.
  void read_ahead(std::uint64_t first, std::uint64_t count) const noexcept { rows_->read_ahead(first, count); }

  /// Forms the shafts of rows [first, first + out.size()), with closed contact, in parallel; `complete` has them know
  /// their joining planes. Throws InvalidArgument, which names the file and the row, for the first row of which no
  /// shaft can be formed.
  void form(std::uint64_t first, std::span<CompiledShaft> out, bool complete) const;

 private:
  [[nodiscard]] Box indexed_box(std::uint64_t row, std::uint64_t position) const;
  /// The rows of shafts as they are read: floats, or positions.
  [[nodiscard]] const std::byte* read(std::uint64_t first, std::uint64_t count, std::vector<std::byte>& scratch) const;
  void form_chunk(std::uint64_t first, const std::byte* rows, std::span<CompiledShaft> out) const;
  void form_one(std::uint64_t row, const std::byte* bytes, CompiledShaft& out) const;

  ShaftKind kind_;
  Origin origin_;
  std::unique_ptr<ArrayFile> rows_;
  std::size_t row_bytes_ = 0;  ///< of what read() reads
  std::unique_ptr<ArrayFile> boxes_;
  std::vector<std::byte> boxes_in_memory_;
  const std::byte* box_bytes_ = nullptr;  ///< 6 floats each
};

}  // namespace shaftcull::batch
