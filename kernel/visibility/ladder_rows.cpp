// SPDX-License-Identifier: MIT
/// One row of the ladder's pairs: a group or a patch, and those of the other side.
#include <utility>

#include "support/compiler.hpp"
#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {

/// Whether patches may face away from each other. Then groups are not told to be clear: some pairs of them may face
/// away, and are to be told so. Nor are they where a solid may block some of their pairs: one that is several boxes
/// together blocks in their seams, where none of these reaches into a flat shaft.
bool Ladder::may_face_away() const noexcept {
  const auto has_planes = [](const PatchTree& tree) { return tree.patch_streams().has_planes(); };
  return has_planes(job_.a.tree) || has_planes(job_.b.tree);
}

void Ladder::write(const PatchRun& a, const PatchRun& b, Sight sight) {
  const std::uint64_t pairs = std::uint64_t{a.count} * b.count;
  to_->answers.counts.of(sight) += pairs;
  if (!job_.wants_blocks) return;
  to_->answers.blocks.push_back({a, b, sight});
  tell_if_full();
}

void Ladder::tell_if_full() const {
  if (to_->answers.memory_bytes() >= to_->most_bytes) to_->full();
}

void Ladder::decide(const Side& rows, unsigned row, const Side& columns, std::uint64_t which, Sight sight) {
  if (which == 0) return;
  if (!job_.wants_blocks && rows.are_patches && columns.are_patches) {
    to_->answers.counts.of(sight) += static_cast<std::uint64_t>(popcount_anywhere(which));
    return;
  }
  for_each_run(which,
               [&](unsigned first, unsigned count) { write(rows.run(row, 1), columns.run(first, count), sight); });
}

void Ladder::decide_rows(const Side& rows, std::uint64_t which, const Side& columns, unsigned column, Sight sight) {
  for_each_run(which,
               [&](unsigned first, unsigned count) { write(rows.run(first, count), columns.run(column, 1), sight); });
}

/// Answers one row of pairs.
void Ladder::answer_row(std::size_t depth, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes) {
  const SiblingKernels& kernels = job_.kernels;
  const OccluderData& occluders = job_.occluders;
  Level& here = level(depth);
  const std::uint64_t away = facing_away(columns, rows, row, lanes);
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
  const std::uint64_t occluded = block(solids, polygons, lanes, false);
  decide(rows, row, columns, occluded, Sight::occluded);
  lanes &= ~occluded;
  if (lanes == 0) return;

  select(here.lists.candidates, here.row_candidates, here.column_candidates, row, lanes, false, candidates);
  const auto keep = [&](const std::vector<BoxRow>& boxes, Selection& selection) {
    return kernels.keep(siblings_, boxes.data(), selection.list.data(), selection.count, selection.may.data(), lanes,
                        selection.kept.data());
  };
  const std::uint64_t undecided = keep(occluders.boxes, candidates);
  std::uint64_t clear = may_face_away() ? 0 : lanes & ~undecided;
  const auto tell_clear = [&](std::uint64_t which) {
    decide(rows, row, columns, which, Sight::clear);
    lanes &= ~which;
  };
  if (solids.count == 0) tell_clear(std::exchange(clear, 0));
  if (lanes == 0) return;

  keep(occluders.polygons, polygons);
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
std::uint64_t Ladder::block(const Selection& solids, const Selection& polygons, std::uint64_t asked, bool are_boxes) {
  const std::uint64_t occluded = occluded_by_solids(solids.list.data(), solids.count, solids.may.data(), asked);
  return occluded |
         occluded_by_polygons(polygons.list.data(), polygons.count, polygons.may.data(), asked & ~occluded, are_boxes);
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

/// Answers a patch with those of the other side that are in `lanes`.
void Ladder::answer_patches(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes) {
  if (here.lists.candidates.empty() && here.lists.solids.empty() && here.lists.polygons.empty()) {
    return decide(rows, row, columns, lanes, Sight::clear);
  }
  const std::uint64_t others = rows.has_boxes_only(row) ? lanes & columns.not_boxes : lanes;
  if (others != lanes) answer_boxes(here, rows, row, columns, lanes & ~others);
  if (others != 0) answer_corners(here, rows, row, columns, others);
}

/// Likewise where all are the boxes around them: the innermost loop.
void Ladder::answer_boxes(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes) {
  const SiblingKernels& kernels = job_.kernels;
  const OccluderData& occluders = job_.occluders;
  // Side by side, fewer vectors hold those that are left.
  const auto count = static_cast<unsigned>(popcount_anywhere(lanes));
  const bool have_parts = occluders.have_parts;
  const bool has_both_sides = rows.has_both_sides() || columns.has_both_sides();  // lanes are where faced_ has them
  const bool packs = kernels.pack != nullptr && !has_both_sides && count + most_siblings / 4 <= columns.count;
  const auto spread = [&](std::uint64_t bits) { return packs ? kernels.spread(bits, lanes) : bits; };
  std::uint64_t left = packs ? first_lanes(count) : lanes;
  if (packs) {
    kernels.pack(columns.box, columns.count, lanes, packed_);
    form(rows, row, packed_box_, packed_inward_, count, left);
  } else {
    form(rows, row, columns, lanes);
  }
  select(here.lists.solids, here.row_solids, here.column_solids, row, lanes, packs, here.solids_of_row);
  select(here.lists.polygons, here.row_polygons, here.column_polygons, row, lanes, packs, here.polygons_of_row);
  const std::uint64_t occluded = block(here.solids_of_row, here.polygons_of_row, left, true);
  decide(rows, row, columns, spread(occluded), Sight::occluded);
  left &= ~occluded;
  if (left == 0) return;

  Selection& candidates = here.candidates_of_row;
  select(here.lists.candidates, here.row_candidates, here.column_candidates, row, lanes, packs, candidates);
  drop_behind_faced(rows, row, columns, candidates);
  const auto keep = [&](std::uint64_t asked) {
    return kernels.keep(siblings_, occluders.boxes.data(), candidates.list.data(), candidates.count,
                        candidates.may.data(), asked, candidates.kept.data());
  };
  const auto spread_kept = [&] {
    for (std::size_t i = 0; packs && i != candidates.count; ++i) candidates.kept[i] = spread(candidates.kept[i]);
  };
  std::uint64_t undecided = 0;
  if (job_.wants_candidates) {
    undecided = spread(keep(left));
    spread_kept();
    if (have_parts) undecided = look_at_triangles(rows, row, columns, undecided, candidates);
  } else if (!have_parts) {
    undecided = spread(kernels.keep_any(siblings_, occluders.boxes.data(), candidates.list.data(), candidates.count,
                                        candidates.may.data(), left));
  } else {
    undecided = keep_any_whole(candidates, left);
    const std::uint64_t open = keep(left & ~undecided);
    undecided = spread(undecided);
    if (open != 0) {
      spread_kept();
      undecided |= look_at_triangles(rows, row, columns, spread(open), candidates);
    }
  }
  decide(rows, row, columns, spread(left) & ~undecided, Sight::clear);
  if (undecided != 0) write_undecided(here, rows, row, columns, undecided);
}

/// Likewise where one of each two patches is not the box around it: what boxes leave open, corners may decide.
void Ladder::answer_corners(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes) {
  form(rows, row, columns, lanes);
  select(here.lists.solids, here.row_solids, here.column_solids, row, lanes, false, here.solids_of_row);
  select(here.lists.polygons, here.row_polygons, here.column_polygons, row, lanes, false, here.polygons_of_row);
  // What hides the boxes around two patches hides the patches. Of hulls and polygons, corners are asked at once.
  const Selection& solids = here.solids_of_row;
  const std::size_t hulls = hulls_in(solids.list.data(), solids.count);
  std::uint64_t occluded = job_.kernels.block(siblings_, job_.solids.data(), solids.list.data() + hulls,
                                              solids.count - hulls, solids.may.data() + hulls, lanes);
  occluded |= block_corners(rows, row, columns, here.solids_of_row, here.polygons_of_row, lanes & ~occluded);
  decide(rows, row, columns, occluded, Sight::occluded);
  const std::uint64_t left = lanes & ~occluded;
  if (left == 0) return;

  Selection& candidates = here.candidates_of_row;
  select(here.lists.candidates, here.row_candidates, here.column_candidates, row, lanes, false, candidates);
  drop_behind_faced(rows, row, columns, candidates);
  std::uint64_t undecided = job_.kernels.keep(siblings_, job_.occluders.boxes.data(), candidates.list.data(),
                                              candidates.count, candidates.may.data(), left, candidates.kept.data());
  if (undecided != 0) undecided = look_at_all_triangles(rows, row, columns, undecided, candidates);
  if (undecided != 0) undecided = drop_separate(rows, row, columns, undecided, candidates);
  decide(rows, row, columns, left & ~undecided, Sight::clear);
  if (undecided != 0) write_undecided(here, rows, row, columns, undecided);
}

/// Pairs of patches that are undecided, with what level `here` keeps.
void Ladder::write_undecided(const Level& here, const Side& rows, unsigned row, const Side& columns,
                             std::uint64_t lanes) {
  SightAnswers& answers = to_->answers;
  if (!job_.wants_undecided) {
    answers.counts.undecided += static_cast<std::uint64_t>(popcount_anywhere(lanes));
    return;
  }
  const std::uint32_t a = rows.set.tree.order()[rows.first + row];
  for_each_lane(lanes, [&](unsigned lane) {
    ++answers.counts.undecided;
    if (job_.wants_places) answers.places.push_back(answers.blocks.size());
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
