// SPDX-License-Identifier: MIT
#include "visibility/ladder.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <span>
#include <utility>

#include "exact/pair.hpp"

namespace shaftcull::kernel {
namespace {

/// Calls visit(lane) for every bit that is set, ascending.
template <class Visit>
void for_each_lane(std::uint64_t lanes, const Visit& visit) {
  for (; lanes != 0; lanes &= lanes - 1) visit(static_cast<unsigned>(std::countr_zero(lanes)));
}

/// Calls visit(first, count) for every run of bits that are set, ascending.
template <class Visit>
void for_each_run(std::uint64_t lanes, const Visit& visit) {
  while (lanes != 0) {
    const auto first = static_cast<unsigned>(std::countr_zero(lanes));
    const auto count = static_cast<unsigned>(std::countr_one(lanes >> first));
    visit(first, count);
    if (first + count == 64) return;
    lanes &= ~std::uint64_t{0} << (first + count);
  }
}

std::uint64_t first_lanes(unsigned count) noexcept {
  return count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

/// Blockers with more points are looked up rather than tested again.
constexpr std::size_t few_points = 64;

std::uint64_t bit(unsigned lane) noexcept { return std::uint64_t{1} << lane; }

/// Lanes of some of these words.
std::uint64_t any_of(const std::uint64_t* words, std::size_t count) noexcept {
  std::uint64_t any = 0;
  for (std::size_t i = 0; i != count; ++i) any |= words[i];
  return any;
}

/// Copies the numbers of a list of `count` whose words have the bit of a lane.
void copy_of_lane(const std::uint32_t* list, const std::uint64_t* words, std::size_t count, unsigned lane,
                  std::vector<std::uint32_t>& to) {
  to.resize(count + 1);  // what is not copied is written, too
  std::size_t copied = 0;
  for (std::size_t i = 0; i != count; ++i) {  // without branches, which would be mispredicted
    to[copied] = list[i];
    copied += words[i] >> lane & 1U;
  }
  to.resize(copied);
}

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

std::uint64_t SightJob::pairs(std::uint32_t a_group, std::uint32_t b_group) const noexcept {
  const std::uint64_t in_a = a.tree.groups()[a_group].count;
  const std::uint64_t in_b = b.tree.groups()[b_group].count;
  return is_of_one_set && a_group == b_group ? in_a * (in_a - 1) / 2 : in_a * in_b;
}

void SightAnswers::clear() noexcept {
  counts = {};
  products.clear();
  undecided.clear();
  first_candidate.resize(1);
  candidates.clear();
  places.clear();
}

std::size_t SightAnswers::memory_bytes() const noexcept {
  return products.size() * sizeof(products[0]) + undecided.size() * sizeof(undecided[0]) +
         first_candidate.size() * sizeof(first_candidate[0]) + candidates.size() * sizeof(candidates[0]) +
         places.size() * sizeof(places[0]);
}

std::size_t SightAnswers::held_bytes() const noexcept {
  return products.capacity() * sizeof(products[0]) + undecided.capacity() * sizeof(undecided[0]) +
         first_candidate.capacity() * sizeof(first_candidate[0]) + candidates.capacity() * sizeof(candidates[0]) +
         places.capacity() * sizeof(places[0]);
}

std::size_t SightLists::held_bytes() const noexcept {
  return (candidates.capacity() + solids.capacity() + polygons.capacity()) * sizeof(candidates[0]);
}

/// Groups or patches side by side, at most 64: children of a group, or a group alone.
struct Ladder::Side {
  const SightSet& set;
  bool are_patches;
  unsigned count;
  std::uint32_t first;  ///< a group, or a position in the order of patches
  const float* box[6];
  PlaneStreams planes{};

  Side(const SightSet& of, std::uint32_t from, unsigned size, bool patches)
      : set(of), are_patches(patches), count(size), first(from) {
    const PatchStreams& streams = patches ? of.tree.patch_streams() : of.tree.group_streams();
    for (unsigned s = 0; s != 6; ++s) box[s] = streams.stream(s) + from;
    if (!streams.has_planes()) return;
    for (unsigned k = 0; k != 3; ++k) {
      planes.least_normal[k] = streams.stream(6 + k) + from;
      planes.largest_normal[k] = streams.stream(9 + k) + from;
    }
    planes.least_offset = streams.stream(12) + from;
    planes.error = (patches ? of.patch_error : of.group_error).data() + from;
  }
  static Side alone(const SightSet& set, std::uint32_t group) { return {set, group, 1, false}; }
  static Side children(const SightSet& set, std::uint32_t group) {
    const PatchGroup& parent = set.tree.groups()[group];
    return {set, parent.first_child, parent.children, parent.has_patches};
  }

  [[nodiscard]] bool has_planes() const noexcept { return planes.error != nullptr; }
  [[nodiscard]] PlaneRow plane(unsigned lane) const noexcept {
    PlaneRow row{};
    for (unsigned k = 0; k != 3; ++k) {
      row.least_normal[k] = planes.least_normal[k][lane];
      row.largest_normal[k] = planes.largest_normal[k][lane];
    }
    row.least_offset = planes.least_offset[lane];
    row.error = planes.error[lane];
    return row;
  }
  /// The box of a lane, six faces.
  void copy_box(unsigned lane, float (&to)[6]) const noexcept {
    for (unsigned s = 0; s != 6; ++s) to[s] = box[s][lane];
  }
  /// The patches of lanes side by side.
  [[nodiscard]] PatchRun run(unsigned lane, unsigned lanes) const noexcept {
    if (are_patches) return {first + lane, lanes};
    const std::vector<PatchGroup>& groups = set.tree.groups();
    const PatchGroup& last = groups[first + lane + lanes - 1];
    const std::uint32_t begin = groups[first + lane].first;
    return {begin, last.first + last.count - begin};
  }
  /// Lanes whose patches lie on or behind all planes of a lane of another side.
  [[nodiscard]] std::uint64_t behind_plane_of(const Side& other, unsigned lane, const SiblingKernels& kernels) const {
    if (!other.has_planes()) return 0;
    return (other.are_patches ? kernels.behind_plane : kernels.behind_group)(other.plane(lane), box, count);
  }
  /// Lanes on or behind all of whose planes a box lies. Those that are not asked may be anything.
  [[nodiscard]] std::uint64_t with_behind(const float* faces, std::uint64_t asked,
                                          const SiblingKernels& kernels) const {
    if (!has_planes()) return 0;
    return (are_patches ? kernels.behind_planes : kernels.behind_groups)(planes, count, faces, asked);
  }
};

/// Of a row of pairs: the blockers of a list that it may have to do with, with which of its lanes, and what is found.
/// Only the first `count` mean anything.
struct Ladder::Selection {
  std::size_t count = 0;
  std::vector<std::uint32_t> list;
  std::vector<std::uint64_t> may;
  std::vector<std::uint64_t> kept;
};

/// What is known of a product, and scratch.
struct Ladder::Level {
  SightLists lists;
  // Lanes of rows and columns whose shafts with all of the other side keep each of the lists.
  std::vector<std::uint64_t> row_candidates;
  std::vector<std::uint64_t> row_solids;
  std::vector<std::uint64_t> row_polygons;
  std::vector<std::uint64_t> column_candidates;
  std::vector<std::uint64_t> column_solids;
  std::vector<std::uint64_t> column_polygons;
  Selection candidates_of_row;
  Selection solids_of_row;
  Selection polygons_of_row;
};

Ladder::Ladder(const SightJob& job) : job_(job) {
  for (unsigned f = 0; f != 6; ++f) packed_box_[f] = packed_.face[f];
}
Ladder::~Ladder() = default;

Ladder::Level& Ladder::level(std::size_t depth) {
  while (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
  return *levels_[depth];
}

void Ladder::enter(const SightProductTask& task, const To& to) {
  to_ = &to;
  level(0).lists = task.lists;
  descend(task.a, task.b, 0);
}

void Ladder::answer(const SightProductTask& task, const To& to) {
  leave_ = nullptr;
  enter(task, to);
}

void Ladder::split(const SightProductTask& task, const std::uint64_t& most_pairs, const Leave& leave, const To& to) {
  leave_ = &leave;
  most_pairs_ = &most_pairs;
  enter(task, to);
}

/// Answers a product whose lists are those of a level, or leaves it.
void Ladder::descend(std::uint32_t a, std::uint32_t b, std::size_t depth) {
  if (leave_ != nullptr && job_.pairs(a, b) <= *most_pairs_) {
    return (*leave_)(SightProductTask{a, b, level(depth).lists});
  }
  walk(a, b, depth);
}

/// Whether patches may face away from each other. Then groups are not told to be clear: some pairs of them may face
/// away, and are to be told so. Nor are they where a solid may block some of their pairs: one that is several boxes
/// together blocks in their seams, where none of these reaches into a flat shaft.
bool Ladder::has_planes() const noexcept { return job_.a.tree.has_planes() || job_.b.tree.has_planes(); }

void Ladder::write(const PatchRun& a, const PatchRun& b, Sight sight) {
  const std::uint64_t pairs = std::uint64_t{a.count} * b.count;
  to_->answers.counts.of(sight) += pairs;
  if (!job_.wants_products) return;
  to_->answers.products.push_back({a, b, sight});
  tell_if_full();
}

void Ladder::tell_if_full() const {
  if (to_->answers.memory_bytes() >= to_->most_bytes) to_->full();
}

void Ladder::decide(const Side& rows, unsigned row, const Side& columns, std::uint64_t which, Sight sight) {
  if (which == 0) return;
  if (!job_.wants_products && rows.are_patches && columns.are_patches) {
    to_->answers.counts.of(sight) += static_cast<std::uint64_t>(std::popcount(which));
    return;
  }
  for_each_run(which,
               [&](unsigned first, unsigned count) { write(rows.run(row, 1), columns.run(first, count), sight); });
}

void Ladder::decide_rows(const Side& rows, std::uint64_t which, const Side& columns, unsigned column, Sight sight) {
  for_each_run(which,
               [&](unsigned first, unsigned count) { write(rows.run(first, count), columns.run(column, 1), sight); });
}

/// Forms shafts from a box of one side to all of another.
void Ladder::form(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked) {
  form(fixed, lane, lanes.box, lanes.count, asked);
  siblings_.are_groups = !fixed.are_patches || !lanes.are_patches;
}

/// Likewise to boxes of patches.
void Ladder::form(const Side& fixed, unsigned lane, const float* const* boxes, unsigned count, std::uint64_t asked) {
  fixed.copy_box(lane, fixed_);
  job_.kernels.form(fixed_, boxes, count, asked, siblings_);
  siblings_.contact = job_.contact;
  siblings_.are_groups = !fixed.are_patches;
  siblings_.solids_around_ends = job_.solids_around_ends;
}

/// Likewise, with lo and hi of groups exchanged, as may_block() wants them.
void Ladder::form_exchanged(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked) {
  const float* other[6];
  for (unsigned f = 0; f != 6; ++f) {
    exchanged_[f] = fixed.box[fixed.are_patches ? f : (f + 3) % 6][lane];
    other[f] = lanes.box[lanes.are_patches ? f : (f + 3) % 6];
  }
  job_.kernels.form(exchanged_, other, lanes.count, asked, siblings_);
}

/// Lanes of `asked` on or behind all of whose planes a blocker lies.
std::uint64_t Ladder::behind(const Side& lanes, std::uint32_t blocker, std::uint64_t asked) {
  if (!lanes.has_planes() || asked == 0) return 0;
  std::uint64_t behind = asked & lanes.with_behind(job_.blockers.boxes[blocker].face, asked, job_.kernels);
  const std::span<const Vec3> points = job_.blockers.points_of(blocker);
  if (!lanes.are_patches || points.empty() || behind == asked) return behind;
  // The box may stick out where the points do not.
  const auto points_behind = [&](std::uint64_t of) {
    return job_.kernels.points_behind_planes(lanes.planes, lanes.count, points.data(), points.size(), of);
  };
  if (points.size() <= few_points) return behind | points_behind(asked & ~behind);
  // Many points, and the same groups again and again: what was found is kept.
  constexpr std::size_t kept = std::size_t{1} << 16;
  if (points_behind_.empty()) points_behind_.resize(kept);
  PointsBehind& known = points_behind_[(lanes.first * 0x9e3779b1U ^ blocker * 0x85ebca6bU) >> 16U];
  if (known.tree != &lanes.set.tree || known.first != lanes.first || known.blocker != blocker) {
    const std::uint64_t all = first_lanes(lanes.count);
    const std::uint64_t of_box = lanes.with_behind(job_.blockers.boxes[blocker].face, all, job_.kernels);
    known = {&lanes.set.tree, lanes.first, blocker, of_box | points_behind(all & ~of_box)};
  }
  return asked & (behind | known.lanes);
}

/// Siblings of `asked` that a polygon of a list blocks; may_block[i], unless null, are those that polygon i may.
std::uint64_t Ladder::blocked_by_polygons(const std::uint32_t* polygons, std::size_t count,
                                          const std::uint64_t* may_block, std::uint64_t asked) const {
  std::uint64_t blocked = 0;
  for (std::size_t i = 0; i != count && (asked & ~blocked) != 0; ++i) {
    const std::uint64_t may = asked & ~blocked & (may_block == nullptr ? ~std::uint64_t{0} : may_block[i]);
    std::uint64_t met = 0;
    job_.kernels.keep(siblings_, job_.blockers.boxes.data(), &polygons[i], 1, nullptr, may, &met);
    for_each_lane(met, [&](unsigned lane) {
      float other[6];
      for (unsigned f = 0; f != 6; ++f) other[f] = siblings_.other[f][lane];
      if (polygon_blocks_between(fixed_, other, job_.blockers.points_of(polygons[i]))) blocked |= bit(lane);
    });
  }
  return blocked;
}

/// Where lists are of all blockers, leaves out those that no lane's shafts with a group come near.
void Ladder::leave_out_far(SightLists& lists, const Side& lanes, const Side& group) {
  const BoxClumps& clumps = job_.blocker_clumps;
  if (clumps.around.empty() || lists.candidates.size() != job_.blockers.size()) return;
  const std::uint64_t asked = first_lanes(lanes.count);
  form(group, 0, lanes, asked);
  siblings_.contact = Contact::closed;  // a bound may touch them in a face of its clump
  leave_out_far(lists.candidates, job_.blockers.size(), clumps, asked);
  std::erase_if(lists.polygons, [&](std::uint32_t i) { return (near_[i / 64] & bit(i % 64)) == 0; });
  leave_out_far(lists.solids, job_.solids.size(), job_.solid_clumps, asked);
}

/// Likewise of one list, by the shafts at hand. near_ says which are left.
void Ladder::leave_out_far(std::vector<std::uint32_t>& list, std::size_t all, const BoxClumps& clumps,
                           std::uint64_t asked) {
  if (clumps.around.empty() || list.size() != all) return;
  clump_lanes_.resize(clumps.around.size());
  job_.kernels.keep(siblings_, clumps.around.data(), clumps.numbers.data(), clumps.numbers.size(), nullptr, asked,
                    clump_lanes_.data());
  near_.assign(words_for(clumps.members.size()), 0);
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
  group.copy_box(0, fixed_);
  answer(lanes.with_behind(fixed_, left, kernels) | lanes.behind_plane_of(group, 0, kernels), Sight::facing_away);
  if (left == 0) return 0;
  const SightLists& lists = level.lists;
  const BlockerData& blockers = job_.blockers;
  std::vector<std::uint64_t>& may = lanes_are_rows ? level.row_solids : level.column_solids;
  may.resize(lists.solids.size());
  if (!lists.solids.empty()) {
    form_exchanged(group, 0, lanes, left);
    kernels.may_block(siblings_, job_.solids.data(), lists.solids.data(), lists.solids.size(), nullptr, left,
                      may.data());
  }
  form(group, 0, lanes, left);
  answer(kernels.block(siblings_, job_.solids.data(), lists.solids.data(), lists.solids.size(), may.data(), left),
         Sight::blocked);
  answer(blocked_by_polygons(lists.polygons.data(), lists.polygons.size(), nullptr, left), Sight::blocked);
  if (left == 0) return 0;

  const auto keep = [&](const std::vector<BoxRow>& boxes, const std::vector<std::uint32_t>& list,
                        std::vector<std::uint64_t>& kept) {
    kept.resize(list.size());
    return kernels.keep(siblings_, boxes.data(), list.data(), list.size(), nullptr, left, kept.data());
  };
  std::vector<std::uint64_t>& kept = lanes_are_rows ? level.row_candidates : level.column_candidates;
  std::uint64_t any = keep(blockers.boxes, lists.candidates, kept);
  if (lanes.has_planes()) any = drop_behind(level, lanes, kept);
  if (!has_planes()) answer(left & ~any & ~any_of(may.data(), may.size()), Sight::clear);
  if (left == 0) return 0;
  keep(blockers.boxes, lists.polygons, lanes_are_rows ? level.row_polygons : level.column_polygons);
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
  pass_on(job_.blockers.boxes, lists.candidates, below.candidates, false);
  pass_on(job_.blockers.boxes, lists.polygons, below.polygons, false);
  form_exchanged(rows, row, rows, bit(row));
  pass_on(job_.solids, lists.solids, below.solids, true);
  descend(rows.first + row, rows.first + row, depth + 1);
}

/// Answers one row of pairs.
void Ladder::answer_row(std::size_t depth, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes) {
  const SiblingKernels& kernels = job_.kernels;
  const BlockerData& blockers = job_.blockers;
  Level& here = level(depth);
  rows.copy_box(row, fixed_);
  const std::uint64_t away =
      lanes & (columns.with_behind(fixed_, lanes, kernels) | columns.behind_plane_of(rows, row, kernels));
  decide(rows, row, columns, away, Sight::facing_away);
  lanes &= ~away;
  if (lanes == 0) return;
  const bool are_patches = rows.are_patches && columns.are_patches;
  if (are_patches) return answer_patches(here, rows, row, columns, lanes);
  form(rows, row, columns, lanes);

  Selection& solids = here.solids_of_row;
  Selection& polygons = here.polygons_of_row;
  Selection& candidates = here.candidates_of_row;
  select(here.lists.solids, here.row_solids, here.column_solids, row, lanes, false, solids);
  select(here.lists.polygons, here.row_polygons, here.column_polygons, row, lanes, false, polygons);
  const std::uint64_t blocked = block(solids, polygons, lanes);
  decide(rows, row, columns, blocked, Sight::blocked);
  lanes &= ~blocked;
  if (lanes == 0) return;

  select(here.lists.candidates, here.row_candidates, here.column_candidates, row, lanes, false, candidates);
  const auto keep = [&](Selection& selection) {
    return kernels.keep(siblings_, blockers.boxes.data(), selection.list.data(), selection.count, selection.may.data(),
                        lanes, selection.kept.data());
  };
  const std::uint64_t undecided = keep(candidates);
  std::uint64_t clear = has_planes() ? 0 : lanes & ~undecided;
  const auto tell_clear = [&](std::uint64_t which) {
    decide(rows, row, columns, which, Sight::clear);
    lanes &= ~which;
  };
  if (solids.count == 0) tell_clear(std::exchange(clear, 0));
  if (lanes == 0) return;

  keep(polygons);
  if (solids.count != 0) {
    form_exchanged(rows, row, columns, lanes);
    kernels.may_block(siblings_, job_.solids.data(), solids.list.data(), solids.count, solids.may.data(), lanes,
                      solids.kept.data());
    if (clear != 0) tell_clear(clear & ~any_of(solids.kept.data(), solids.count));
  }
  for_each_lane(lanes, [&](unsigned lane) {
    SightLists& below = level(depth + 1).lists;
    const auto pass_on = [&](const Selection& selection, std::vector<std::uint32_t>& to) {
      copy_of_lane(selection.list.data(), selection.kept.data(), selection.count, lane, to);
    };
    pass_on(candidates, below.candidates);
    pass_on(solids, below.solids);
    pass_on(polygons, below.polygons);
    descend(rows.first + row, columns.first + lane, depth + 1);
  });
}

/// Siblings of `asked` that a solid or a polygon blocks.
std::uint64_t Ladder::block(const Selection& solids, const Selection& polygons, std::uint64_t asked) {
  const std::uint64_t blocked =
      job_.kernels.block(siblings_, job_.solids.data(), solids.list.data(), solids.count, solids.may.data(), asked);
  return blocked | blocked_by_polygons(polygons.list.data(), polygons.count, polygons.may.data(), asked & ~blocked);
}

/// Selects what one row and some column of `lanes` may have to do with.
void Ladder::select(const std::vector<std::uint32_t>& list, const std::vector<std::uint64_t>& of_rows,
                    const std::vector<std::uint64_t>& of_columns, unsigned row, std::uint64_t lanes, bool packed,
                    Selection& selection) const {
  if (selection.list.size() <= list.size()) {  // what is not selected is written, too
    selection.list.resize(list.size() + 1);
    selection.may.resize(list.size() + 1);
    selection.kept.resize(list.size() + 1);
  }
  selection.count = job_.kernels.select({list.data(), of_rows.data(), of_columns.data()}, list.size(), row, lanes,
                                        packed, selection.list.data(), selection.may.data());
}

/// Answers a patch with those of the other side that are in `lanes`: the innermost loop.
void Ladder::answer_patches(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes) {
  if (here.lists.candidates.empty() && here.lists.solids.empty() && here.lists.polygons.empty()) {
    return decide(rows, row, columns, lanes, Sight::clear);
  }
  const SiblingKernels& kernels = job_.kernels;
  const BlockerData& blockers = job_.blockers;
  // Side by side, fewer vectors hold those that are left.
  const auto count = static_cast<unsigned>(std::popcount(lanes));
  const bool packs = kernels.pack != nullptr && count + most_siblings / 4 <= columns.count;
  const auto spread = [&](std::uint64_t bits) { return packs ? kernels.spread(bits, lanes) : bits; };
  std::uint64_t left = packs ? first_lanes(count) : lanes;
  if (packs) {
    kernels.pack(columns.box, columns.count, lanes, packed_);
    form(rows, row, packed_box_, count, left);
  } else {
    form(rows, row, columns, lanes);
  }
  select(here.lists.solids, here.row_solids, here.column_solids, row, lanes, packs, here.solids_of_row);
  select(here.lists.polygons, here.row_polygons, here.column_polygons, row, lanes, packs, here.polygons_of_row);
  const std::uint64_t blocked = block(here.solids_of_row, here.polygons_of_row, left);
  decide(rows, row, columns, spread(blocked), Sight::blocked);
  left &= ~blocked;
  if (left == 0) return;

  Selection& candidates = here.candidates_of_row;
  select(here.lists.candidates, here.row_candidates, here.column_candidates, row, lanes, packs, candidates);
  std::uint64_t undecided = 0;
  if (job_.wants_candidates) {
    undecided = kernels.keep(siblings_, blockers.boxes.data(), candidates.list.data(), candidates.count,
                             candidates.may.data(), left, candidates.kept.data());
    for (std::size_t i = 0; packs && i != candidates.count; ++i) {
      candidates.kept[i] = kernels.spread(candidates.kept[i], lanes);
    }
  } else {
    undecided = kernels.keep_any(siblings_, blockers.boxes.data(), candidates.list.data(), candidates.count,
                                 candidates.may.data(), left);
  }
  decide(rows, row, columns, spread(left & ~undecided), Sight::clear);
  if (undecided != 0) write_undecided(here, rows, row, columns, spread(undecided));
}

/// Pairs of patches that are undecided, with what level `here` keeps.
void Ladder::write_undecided(const Level& here, const Side& rows, unsigned row, const Side& columns,
                             std::uint64_t lanes) {
  SightAnswers& answers = to_->answers;
  if (!job_.wants_undecided) {
    answers.counts.undecided += static_cast<std::uint64_t>(std::popcount(lanes));
    return;
  }
  const std::uint32_t a = rows.set.tree.order()[rows.first + row];
  for_each_lane(lanes, [&](unsigned lane) {
    ++answers.counts.undecided;
    if (job_.wants_places) answers.places.push_back(answers.products.size());
    answers.undecided.push_back({a, columns.set.tree.order()[columns.first + lane]});
    if (job_.wants_candidates) {
      const Selection& candidates = here.candidates_of_row;
      std::vector<std::uint32_t>& all = answers.candidates;
      std::size_t size = all.size();
      all.resize(size + candidates.count);                   // at most
      for (std::size_t i = 0; i != candidates.count; ++i) {  // without branches, which would be mispredicted
        all[size] = candidates.list[i];
        size += candidates.kept[i] >> lane & 1U;
      }
      all.resize(size);
      answers.first_candidate.push_back(size);
    }
    tell_if_full();
  });
}

}  // namespace shaftcull::kernel
