// SPDX-License-Identifier: MIT
#include "batch/shaft_source.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "batch/parallel.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::size_t shafts_at_once = 256;
constexpr std::uint64_t no_row = std::numeric_limits<std::uint64_t>::max();

/// Two boxes, or a box and a vector, of a chunk of shafts: a stream a column.
struct Columns {
  std::array<std::array<float, shafts_at_once>, 12> column;

  void set(std::size_t i, std::size_t first, std::span<const float> values) {
    for (std::size_t c = 0; c != values.size(); ++c) column[first + c][i] = values[c];
  }
  [[nodiscard]] BoxView boxes(std::size_t first, std::size_t count) const {
    BoxView view;
    for (std::size_t c = 0; c != 6; ++c) view.stream[c] = column[first + c].data();
    view.count = count;
    return view;
  }
};

std::array<float, 12> floats_of(const std::byte* bytes, std::size_t columns) {
  std::array<float, 12> floats{};
  std::memcpy(floats.data(), bytes, columns * sizeof(float));
  return floats;
}

/// Position `column` of a pair; nothing below 0.
std::optional<std::uint64_t> position_at(const std::byte* bytes, std::size_t column, Number number) {
  const auto read = [&]<class T>(T value) -> std::optional<std::uint64_t> {
    std::memcpy(&value, bytes + column * sizeof(T), sizeof(T));
    if constexpr (std::is_signed_v<T>) {
      if (value < 0) return std::nullopt;
    }
    return static_cast<std::uint64_t>(value);
  };
  switch (number) {
    case Number::int32:
      return read(std::int32_t{});
    case Number::uint32:
      return read(std::uint32_t{});
    case Number::int64:
      return read(std::int64_t{});
    default:
      return read(std::uint64_t{});
  }
}

Box box_of(std::span<const float> six) { return {{six[0], six[1], six[2]}, {six[3], six[4], six[5]}}; }

}  // namespace

ShaftSource::ShaftSource(const std::string& shafts, const std::string& boxes, ShaftKind kind, const Origin& origin)
    : kind_(kind), origin_(origin), rows_(std::make_unique<ArrayFile>(shafts)), row_bytes_(rows_->row_bytes()) {
  const bool two_boxes = kind == ShaftKind::between || kind == ShaftKind::shadow;
  const std::size_t columns = two_boxes ? 12 : 9;
  if (is_of_floats(*rows_)) {
    if (rows_->columns() != columns) {
      throw InvalidArgument(fmt::format("{}: is {}; shafts of kind {} are rows of {} floats, {}", shafts,
                                        rows_->shape(), name_of(kind), columns,
                                        two_boxes ? "two boxes" : "a box and a vector"));
    }
    if (!boxes.empty()) {
      throw InvalidArgument(fmt::format("--boxes {}: {} holds boxes itself, not positions of them", boxes, shafts));
    }
    if (rows_->number() == Number::float64 && !two_boxes) {
      throw InvalidArgument(fmt::format("{}: is {}; only shafts of two boxes may be of float64, not those of kind {}",
                                        shafts, rows_->shape(), name_of(kind)));
    }
    row_bytes_ = columns * sizeof(float);
    return;
  }
  if (!two_boxes || rows_->columns() != 2) {
    throw InvalidArgument(fmt::format("{}: is {}; shafts of kind {} are rows of {} floats{}", shafts, rows_->shape(),
                                      name_of(kind), columns, two_boxes ? ", or of two positions of --boxes" : ""));
  }
  if (boxes.empty()) {
    throw InvalidArgument(fmt::format("{}: holds positions of boxes; add --boxes FILE", shafts));
  }
  boxes_ = std::make_unique<ArrayFile>(boxes);
  if (!is_of_floats(*boxes_) || boxes_->columns() != 6) {
    throw InvalidArgument(fmt::format("{}: is {}; boxes are rows of 6 floats", boxes, boxes_->shape()));
  }
  const FloatRows floats(*boxes_, origin_, RowRounding::boxes_around);
  box_bytes_ = std::as_bytes(floats.read(0, boxes_->rows(), boxes_in_memory_)).data();
}

std::vector<const ArrayFile*> ShaftSource::arrays() const {
  if (!boxes_) return {rows_.get()};
  return {rows_.get(), boxes_.get()};
}

void ShaftSource::form(std::uint64_t first, std::span<CompiledShaft> out, bool complete) const {
  std::vector<std::byte> scratch;
  const std::byte* const rows = read(first, out.size(), scratch);
  try {
    for_chunks(out.size(), shafts_at_once, [&](std::size_t begin, std::size_t size) {
      const std::span<CompiledShaft> chunk = out.subspan(begin, size);
      form_chunk(first + begin, rows + begin * row_bytes_, chunk);
      if (!complete) return;
      for (CompiledShaft& shaft : chunk) shaftcull::complete(shaft);
    });
  } catch (const InvalidArgument&) {
    // The first bad row throws again, with its number and the reason.
    for (std::size_t i = 0; i != out.size(); ++i) form_one(first + i, rows + i * row_bytes_, out[i]);
    throw;
  }
}

const std::byte* ShaftSource::read(std::uint64_t first, std::uint64_t count, std::vector<std::byte>& scratch) const {
  if (boxes_) return rows_->read(first, count, scratch).data();
  return std::as_bytes(FloatRows(*rows_, origin_, RowRounding::boxes_around).read(first, count, scratch)).data();
}

Box ShaftSource::indexed_box(std::uint64_t row, std::uint64_t position) const {
  if (position >= boxes_->rows()) {
    throw InvalidArgument(fmt::format("{}: row {}: position {} is out of range for the {} boxes of {}", rows_->name(),
                                      row, position, boxes_->rows(), boxes_->name()));
  }
  const std::array<float, 12> floats = floats_of(box_bytes_ + position * 6 * sizeof(float), 6);
  return box_of(std::span(floats).first(6));
}

void ShaftSource::form_chunk(std::uint64_t first, const std::byte* rows, std::span<CompiledShaft> out) const {
  Columns columns;  // written where it is read
  for (std::size_t i = 0; i != out.size(); ++i) {
    const std::byte* const row = rows + i * row_bytes_;
    if (!boxes_) {
      const std::array<float, 12> floats = floats_of(row, rows_->columns());
      columns.set(i, 0, std::span(floats).first(rows_->columns()));
      continue;
    }
    for (std::size_t end = 0; end != 2; ++end) {
      const std::optional<std::uint64_t> position = position_at(row, end, rows_->number());
      const Box box = indexed_box(first + i, position.value_or(no_row));
      columns.set(i, 6 * end, box.lo);
      columns.set(i, 6 * end + 3, box.hi);
    }
  }
  const BoxView a = columns.boxes(0, out.size());
  if (kind_ == ShaftKind::between) return compile_batch(a, columns.boxes(6, out.size()), out);
  if (kind_ == ShaftKind::shadow) return shadow_batch(a, columns.boxes(6, out.size()), out);
  std::array<Vec3, shafts_at_once> vectors;
  for (std::size_t i = 0; i != out.size(); ++i) {
    vectors[i] = {columns.column[6][i], columns.column[7][i], columns.column[8][i]};
  }
  const std::span<const Vec3> moves = std::span(vectors).first(out.size());
  if (kind_ == ShaftKind::swept) {
    swept_batch(a, moves, out);
  } else {
    swept_infinite_batch(a, moves, out);
  }
}

void ShaftSource::form_one(std::uint64_t row, const std::byte* bytes, CompiledShaft& out) const {
  std::string where = fmt::format("{}: row {}", rows_->name(), row);
  std::array<Box, 2> box{};
  Vec3 move{};
  if (boxes_) {
    std::array<std::uint64_t, 2> positions{};
    for (std::size_t end = 0; end != 2; ++end) {
      const std::optional<std::uint64_t> position = position_at(bytes, end, rows_->number());
      if (!position) throw InvalidArgument(fmt::format("{}: a position of a box is below 0", where));
      positions[end] = *position;
      box[end] = indexed_box(row, *position);
    }
    where += fmt::format(", boxes {} and {} of {}", positions[0], positions[1], boxes_->name());
  } else {
    const std::array<float, 12> floats = floats_of(bytes, rows_->columns());
    box[0] = box_of(std::span(floats).first(6));
    box[1] = box_of(std::span(floats).last(6));
    move = {floats[6], floats[7], floats[8]};
  }
  try {
    switch (kind_) {
      case ShaftKind::between:
        out = compile(box[0], box[1]);
        break;
      case ShaftKind::shadow:
        out = shadow(box[0], box[1]);
        break;
      case ShaftKind::swept:
        out = swept(box[0], move);
        break;
      case ShaftKind::sun:
        out = swept_infinite(box[0], move);
        break;
    }
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(fmt::format("{}: {}", where, error.what()));
  }
}

}  // namespace shaftcull::batch
