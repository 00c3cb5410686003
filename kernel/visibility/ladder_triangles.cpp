// SPDX-License-Identifier: MIT
/// Groups of triangles, looked at triangle by triangle: the box around a group that goes round corners, as all walls of
/// a room do, reaches into shafts that none of its triangles reach into.
#include <array>
#include <numeric>

#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

/// Numbers of the parts of a group, counted from its first one: a list of all.
constexpr auto all_parts = [] {
  std::array<std::uint32_t, OccluderData::most_parts> numbers{};
  std::iota(numbers.begin(), numbers.end(), std::uint32_t{0});
  return numbers;
}();

/// Those of `some`, where lanes of `all` are put side by side.
std::uint64_t pack(std::uint64_t some, std::uint64_t all) noexcept {
  std::uint64_t packed = 0;
  for (std::uint64_t at = 1; all != 0; all &= all - 1, at <<= 1U) {
    if ((some & all & (~all + 1)) != 0) packed |= at;
  }
  return packed;
}

}  // namespace

/// Of a row of pairs: lanes of `asked` whose shafts keep the box around a candidate that is not looked at by its
/// triangles. `candidates.kept` is scratch.
std::uint64_t Ladder::keep_any_whole(Selection& candidates, std::uint64_t asked) {
  const OccluderData& occluders = job_.occluders;
  for (std::size_t i = 0; i != candidates.count; ++i) {
    candidates.kept[i] = occluders.parts_of(candidates.list[i]) == 0 ? candidates.may[i] : 0;
  }
  return job_.kernels.keep_any(siblings_, occluders.boxes.data(), candidates.list.data(), candidates.count,
                               candidates.kept.data(), asked);
}

/// Of a row of pairs, in which the boxes around groups keep candidates: drops groups none of whose triangles reaches
/// in, by the box around it, in front of both patches. Returns the lanes in which candidates are left. If nobody wants
/// candidates, one of them is enough.
std::uint64_t Ladder::look_at_triangles(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                        Selection& candidates) {
  const SiblingKernels& kernels = job_.kernels;
  const OccluderData& occluders = job_.occluders;
  std::uint64_t with_parts = 0;
  for (std::size_t i = 0; i != candidates.count; ++i) {
    if (occluders.parts_of(candidates.list[i]) != 0) with_parts |= candidates.kept[i];
  }
  with_parts &= lanes;
  const auto count = static_cast<unsigned>(popcount_anywhere(with_parts));
  // Side by side, fewer vectors hold them.
  const bool packs = kernels.pack != nullptr && count + most_siblings / 4 <= columns.count;
  if (packs && with_parts != 0) {
    kernels.pack(columns.box, columns.count, with_parts, packed_);
    form(rows, row, packed_box_, packed_inward_, count, first_lanes(count));
  } else if (with_parts != 0) {
    form(rows, row, columns, with_parts);
  }
  const auto behind = [&](const Side& side, std::size_t part, std::uint64_t of) {
    return side.has_planes()
               ? kernels.points_behind_planes(side.planes, side.count, occluders.triangle_vertices[part].data(), 3, of)
               : 0;
  };
  std::uint64_t left = 0;
  for (std::size_t i = 0; i != candidates.count; ++i) {
    const std::size_t parts = occluders.parts_of(candidates.list[i]);
    std::uint64_t asked = candidates.kept[i] & lanes;
    if (!job_.wants_candidates) asked &= ~left;
    if (parts == 0 || asked == 0) {
      candidates.kept[i] = asked;
      left |= asked;
      continue;
    }
    const std::size_t first = occluders.first_triangle[candidates.list[i]];
    std::array<std::uint64_t, OccluderData::most_parts> kept;
    kernels.keep(siblings_, occluders.triangle_boxes.data() + first, all_parts.data(), parts, nullptr,
                 packs ? pack(asked, with_parts) : asked, kept.data());
    std::uint64_t reached = 0;
    for (std::size_t part = 0; part != parts; ++part) {
      std::uint64_t& of_part = kept[part];
      if (of_part == 0) continue;
      if (packs) of_part = kernels.spread(of_part, with_parts);
      of_part &= ~reached;
      if (of_part == 0) continue;
      of_part = behind(rows, first + part, bit(row)) != 0 ? 0 : of_part & ~behind(columns, first + part, of_part);
      of_part &= ~behind_faced(rows, row, columns, {static_cast<std::uint32_t>(first + part), true},
                               occluders.triangle_vertices[first + part], of_part);
      reached |= of_part;
    }
    candidates.kept[i] = reached;
    left |= reached;
  }
  return left;
}

/// Lanes of `asked` with a box that the box around a triangle reaches into, in front of both patches.
std::uint64_t Ladder::part_reaches(const Side& rows, unsigned row, const Side& columns, std::size_t part,
                                   std::uint64_t asked) {
  const SiblingKernels& kernels = job_.kernels;
  const auto number = static_cast<std::uint32_t>(part);
  std::uint64_t kept = 0;
  kernels.keep(siblings_, job_.occluders.triangle_boxes.data(), &number, 1, nullptr, asked, &kept);
  if (kept == 0) return 0;
  const std::array<Vec3, 3>& vertices = job_.occluders.triangle_vertices[part];
  const auto behind = [&](const Side& side, std::uint64_t of) {
    return side.has_planes() ? kernels.points_behind_planes(side.planes, side.count, vertices.data(), 3, of) : 0;
  };
  if (behind(rows, bit(row)) != 0) return 0;
  kept &= ~behind(columns, kept);
  return kept & ~behind_faced(rows, row, columns, {number, true}, vertices, kept);
}

/// Likewise of pairs whose corners are asked about later: writes the lanes of each triangle to part_lanes_.
std::uint64_t Ladder::look_at_all_triangles(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                            Selection& candidates) {
  const OccluderData& occluders = job_.occluders;
  std::uint64_t left = 0;
  part_lanes_.clear();
  for (std::size_t i = 0; i != candidates.count; ++i) {
    const std::uint64_t asked = candidates.kept[i] & lanes;
    const std::size_t first = occluders.first_triangle[candidates.list[i]];
    const std::size_t end = first + occluders.parts_of(candidates.list[i]);
    std::uint64_t reached = first == end ? asked : 0;
    for (std::size_t part = first; part != end; ++part) {
      const std::uint64_t kept = asked == 0 ? 0 : part_reaches(rows, row, columns, part, asked);
      reached |= kept;
      part_lanes_.push_back(kept);
    }
    candidates.kept[i] = reached;
    left |= reached;
  }
  return left;
}

}  // namespace shaftcull::kernel
