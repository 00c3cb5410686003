// SPDX-License-Identifier: MIT
#include "visibility/ladder.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

/// Removes what concerns none of the lanes that are left on a side. `of_side` and `of_other`, unless that is null, say
/// which lanes each of the list concerns.
void drop_unused(std::vector<std::uint32_t>& list, std::vector<std::uint64_t>& of_side, std::uint64_t left,
                 std::vector<std::uint64_t>* of_other = nullptr) {
  std::size_t count = 0;
  for (std::size_t i = 0; i != list.size(); ++i) {
    list[count] = list[i];
    of_side[count] = of_side[i];
    if (of_other != nullptr) (*of_other)[count] = (*of_other)[i];
    count += (of_side[i] & left) != 0 ? 1 : 0;
  }
  list.resize(count);
  of_side.resize(count);
  if (of_other != nullptr) of_other->resize(count);
}

}  // namespace

Ladder::Ladder(const SightJob& job) : job_(job), cones_(job) {
  for (unsigned f = 0; f != 6; ++f) {
    packed_box_[f] = packed_.face[f];
    packed_inward_[f] = packed_.face[(f + 3) % 6];
  }
}
Ladder::~Ladder() = default;

Ladder::Level& Ladder::level(std::size_t depth) {
  while (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
  return *levels_[depth];
}

void Ladder::enter(const PairBlockTask& task, const To& to) {
  to_ = &to;
  level(0).lists = task.lists;
  descend(task.a, task.b, 0);
}

void Ladder::answer(const PairBlockTask& task, const To& to) {
  leave_ = nullptr;
  enter(task, to);
}

void Ladder::split(const PairBlockTask& task, const std::uint64_t& most_pairs, const Leave& leave, const To& to) {
  leave_ = &leave;
  most_pairs_ = &most_pairs;
  enter(task, to);
}

/// Answers a product whose lists are those of a level, or leaves it.
void Ladder::descend(std::uint32_t a, std::uint32_t b, std::size_t depth) {
  if (leave_ != nullptr && job_.pairs(a, b) <= *most_pairs_) {
    return (*leave_)(PairBlockTask{a, b, level(depth).lists});
  }
  walk(a, b, depth);
}

/// Where lists are of all occluders, leaves out those that no lane's shafts with a group come near.
void Ladder::leave_out_far(SightLists& lists, const Side& lanes, const Side& group) {
  const OccluderData& occluders = job_.occluders;
  const auto are_all = [](const std::vector<std::uint32_t>& list, std::size_t all, const BoxClumps& clumps) {
    return !clumps.around.empty() && list.size() == all;
  };
  if (!are_all(lists.candidates, occluders.size(), job_.occluder_clumps) &&
      !are_all(lists.polygons, occluders.polygons.size(), job_.polygon_clumps)) {
    return;
  }
  const std::uint64_t asked = first_lanes(lanes.count);
  form(group, 0, lanes, asked);
  siblings_.contact = Contact::closed;  // a bound may touch them in a face of its clump
  leave_out_far(lists.candidates, occluders.size(), job_.occluder_clumps, asked);
  leave_out_far(lists.polygons, occluders.polygons.size(), job_.polygon_clumps, asked);
  leave_out_far(lists.solids, job_.solids.size(), job_.solid_clumps, asked);
}

/// Likewise of one list, by the shafts at hand. near_ says which are left.
void Ladder::leave_out_far(std::vector<std::uint32_t>& list, std::size_t all, const BoxClumps& clumps,
                           std::uint64_t asked) {
  if (clumps.around.empty() || list.size() != all) return;
  clump_lanes_.resize(clumps.around.size());
  job_.kernels.keep(siblings_, clumps.around.data(), clumps.numbers.data(), clumps.numbers.size(), nullptr, asked,
                    clump_lanes_.data());
  near_.assign(bit_words(clumps.members.size()), 0);
  for (std::size_t c = 0; c != clump_lanes_.size(); ++c) {
    if (clump_lanes_[c] == 0) continue;
    const std::size_t end = std::min(clumps.members.size(), BoxClumps::size * (c + 1));
    for (std::size_t i = BoxClumps::size * c; i != end; ++i) {
      near_[clumps.members[i] / 64] |= bit(clumps.members[i] % 64);
    }
  }
  list.clear();
  for (std::size_t word = 0; word != near_.size(); ++word) {
    for_each_lane(near_[word], [&](unsigned i) {
      const std::size_t number = 64 * word + i;
      if (number < all) list.push_back(static_cast<std::uint32_t>(number));
    });
  }
}

/// Compares lanes of one side with a whole group of the other set. Answers those that can be, and returns the others.
std::uint64_t Ladder::compare_with_group(Level& level, const Side& lanes, const Side& group, bool lanes_are_rows,
                                         std::uint64_t rows) {
  const SiblingKernels& kernels = job_.kernels;
  std::uint64_t left = first_lanes(lanes.count);
  const auto answer = [&](std::uint64_t which, Sight sight) {
    left &= ~which;
    for_each_lane(which, [&](unsigned lane) {
      if (lanes_are_rows) {
        write(lanes.run(lane, 1), group.run(0, 1), sight);
      } else {
        decide_rows(*rows_, rows, lanes, lane, sight);
      }
    });
  };
  answer(facing_away(lanes, group, 0, left), Sight::facing_away);
  if (left == 0) return 0;
  const SightLists& lists = level.lists;
  const OccluderData& occluders = job_.occluders;
  std::vector<std::uint64_t>& may = lanes_are_rows ? level.row_solids : level.column_solids;
  may.resize(lists.solids.size());
  if (!lists.solids.empty()) {
    form_exchanged(group, 0, lanes, left);
    kernels.may_block(siblings_, job_.solids.data(), lists.solids.data(), lists.solids.size(), nullptr, left,
                      may.data());
  }
  form(group, 0, lanes, left);
  answer(occluded_by_solids(lists.solids.data(), lists.solids.size(), may.data(), left), Sight::occluded);
  answer(occluded_by_polygons(lists.polygons.data(), lists.polygons.size(), nullptr, left, false), Sight::occluded);
  if (left == 0) return 0;

  const auto keep = [&](const std::vector<BoxRow>& boxes, const std::vector<std::uint32_t>& list,
                        std::vector<std::uint64_t>& kept) {
    kept.resize(list.size());
    return kernels.keep(siblings_, boxes.data(), list.data(), list.size(), nullptr, left, kept.data());
  };
  std::vector<std::uint64_t>& kept = lanes_are_rows ? level.row_candidates : level.column_candidates;
  std::uint64_t any = keep(occluders.boxes, lists.candidates, kept);
  if (lanes.has_planes()) any = drop_behind(level, lanes, kept);
  if (lanes.has_both_sides()) any = drop_behind_faced(level, lanes, group, kept);
  if (!may_face_away()) answer(left & ~any & ~any_of(may.data(), may.size()), Sight::clear);
  if (left == 0) return 0;
  keep(occluders.polygons, lists.polygons, lanes_are_rows ? level.row_polygons : level.column_polygons);
  return left;
}

/// Clears the lanes on or behind whose planes candidates lie. Returns those in which some are left.
std::uint64_t Ladder::drop_behind(const Level& level, const Side& lanes, std::vector<std::uint64_t>& kept) {
  std::uint64_t any = 0;
  for (std::size_t i = 0; i != kept.size(); ++i) {
    kept[i] &= ~behind(lanes, level.lists.candidates[i], kept[i]);
    any |= kept[i];
  }
  return any;
}

/// Answers all pairs of two groups, whose lists are those of a level.
void Ladder::walk(std::uint32_t a, std::uint32_t b, std::size_t depth) {
  Level& here = level(depth);
  const PatchGroup& a_group = job_.a.tree.groups()[a];
  const PatchGroup& b_group = job_.b.tree.groups()[b];
  const bool is_itself = job_.is_of_one_set && a == b;
  // Patches are compared with patches, and groups with groups.
  const Side rows = a_group.has_patches && !b_group.has_patches ? Side::alone(job_.a, a) : Side::children(job_.a, a);
  const Side columns = b_group.has_patches && !a_group.has_patches ? Side::alone(job_.b, b) : Side::children(job_.b, b);
  std::uint64_t rows_left = first_lanes(rows.count);
  std::uint64_t columns_left = first_lanes(columns.count);
  const auto keep_all = [&](std::vector<std::uint64_t>& candidates, std::vector<std::uint64_t>& solids,
                            std::vector<std::uint64_t>& polygons) {
    candidates.assign(here.lists.candidates.size(), ~std::uint64_t{0});
    solids.assign(here.lists.solids.size(), ~std::uint64_t{0});
    polygons.assign(here.lists.polygons.size(), ~std::uint64_t{0});
  };
  rows_ = &rows;
  if (!is_itself) {
    if (rows.count == 1) {
      leave_out_far(here.lists, columns, Side::alone(job_.a, a));
    } else {
      leave_out_far(here.lists, rows.are_patches ? Side::alone(job_.a, a) : rows, Side::alone(job_.b, b));
    }
  }
  if (is_itself || rows.count == 1) {
    keep_all(here.row_candidates, here.row_solids, here.row_polygons);
    if (rows.are_patches) drop_behind(here, rows, here.row_candidates);
  } else {
    rows_left = compare_with_group(here, rows, Side::alone(job_.b, b), true, 0);
    if (rows_left == 0) return;
    drop_unused(here.lists.candidates, here.row_candidates, rows_left);
    drop_unused(here.lists.solids, here.row_solids, rows_left);
    drop_unused(here.lists.polygons, here.row_polygons, rows_left);
  }
  if (is_itself || columns.count == 1) {
    keep_all(here.column_candidates, here.column_solids, here.column_polygons);
    if (columns.are_patches) drop_behind(here, columns, here.column_candidates);
  } else {
    columns_left = compare_with_group(here, columns, Side::alone(job_.a, a), false, rows_left);
    if (columns_left == 0) return;
  }
  drop_unused(here.lists.candidates, here.column_candidates, columns_left, &here.row_candidates);
  drop_unused(here.lists.solids, here.column_solids, columns_left, &here.row_solids);
  drop_unused(here.lists.polygons, here.column_polygons, columns_left, &here.row_polygons);
  for_each_lane(rows_left, [&](unsigned row) {
    std::uint64_t lanes = columns_left;
    if (is_itself) {
      lanes &= row == 63 ? 0 : ~std::uint64_t{0} << (row + 1);
      if (!rows.are_patches) go_into_itself(depth, rows, row);
    }
    if (lanes != 0) answer_row(depth, rows, row, columns, lanes);
  });
}

/// Answers the pairs of a child group with itself: only what meets its box stands between some of its patches.
void Ladder::go_into_itself(std::size_t depth, const Side& rows, unsigned row) {
  const SiblingKernels& kernels = job_.kernels;
  const SightLists& lists = level(depth).lists;
  SightLists& below = level(depth + 1).lists;
  const auto pass_on = [&](std::span<const BoxRow> boxes, const std::vector<std::uint32_t>& list,
                           std::vector<std::uint32_t>& to, bool may_block) {
    std::vector<std::uint64_t> kept(list.size());
    if (may_block) {
      kernels.may_block(siblings_, boxes.data(), list.data(), list.size(), nullptr, bit(row), kept.data());
    } else {
      kernels.keep(siblings_, boxes.data(), list.data(), list.size(), nullptr, bit(row), kept.data());
    }
    copy_of_lane(list.data(), kept.data(), list.size(), row, to);
  };
  form(rows, row, rows, bit(row));
  pass_on(job_.occluders.boxes, lists.candidates, below.candidates, false);
  pass_on(job_.occluders.polygons, lists.polygons, below.polygons, false);
  form_exchanged(rows, row, rows, bit(row));
  pass_on(job_.solids, lists.solids, below.solids, true);
  descend(rows.first + row, rows.first + row, depth + 1);
}

}  // namespace shaftcull::kernel
