// SPDX-License-Identifier: MIT
#include "visibility/run.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/many.hpp"
#include "support/float_environment.hpp"
#include "visibility/answer_budget.hpp"
#include "visibility/callers_modes.hpp"
#include "visibility/ladder.hpp"
#include "visibility/ladder_pool.hpp"
#include "visibility/pair_parts.hpp"
#include "visibility/progress_reports.hpp"
#include "visibility/sight_set.hpp"
#include "visibility/verdicts.hpp"

namespace shaftcull::kernel {
namespace {

/// One call.
class Run {
 public:
  using Deliver = FunctionRef<void(const SightBatch&)>;

  Run(const PatchTree& a, const PatchTree& b, bool is_of_one_set, const OccluderData& occluders,
      const VisibilityOptions& options, const Deliver* deliver)
      : deliver_(deliver),
        solids_(solid_rows_of(occluders, options.solids_around_ends)),
        clumps_(clumps_of(occluders)),
        polygon_clumps_(polygon_clumps_of(occluders)),
        turned_occluders_(turned_boxes(a, b, occluders)),
        job_{sight_set(a, options.tolerance, largest_coordinate(a, b, occluders)),
             sight_set(b, options.tolerance, largest_coordinate(a, b, occluders)),
             is_of_one_set,
             occluders,
             solids_->rows,
             *clumps_,
             *polygon_clumps_,
             solids_->clumps,
             turned_occluders_,
             active_kernels().siblings,
             options.contact,
             options.solids_around_ends,
             deliver != nullptr,
             deliver != nullptr || static_cast<bool>(options.resolve),
             options.candidates && (deliver != nullptr || static_cast<bool>(options.resolve)),
             deliver != nullptr && static_cast<bool>(options.resolve)},
        groups_(groups_of_part(job_, options.part, options.parts)),
        verdicts_(options, job_, modes_),
        reports_(options, modes_, total_pairs()),
        ladders_(job_),
        budget_(options.memory, static_cast<std::size_t>(std::max(concurrency(), 1)), job_.wants_undecided,
                static_cast<bool>(options.resolve)) {}

  SightCounts run() {
    if (groups_.empty()) return {};
    reports_.report(0, true);
    PairBlockTask all{};
    const auto number = [](std::vector<std::uint32_t>& list, std::size_t count) {
      list.resize(count);
      for (std::size_t i = 0; i != count; ++i) list[i] = static_cast<std::uint32_t>(i);
    };
    number(all.lists.candidates, job_.occluders.size());
    number(all.lists.solids, job_.solids.size());
    number(all.lists.polygons, job_.occluders.polygons.size());

    const auto leave = [&](PairBlockTask&& task) { add(std::move(task)); };
    const auto is_full = [&] {
      flush();
      hand_over(before_);
      before_.clear();
    };
    const Ladder::Full full = is_full;
    in_float_environment([&] {
      const LadderPool::Borrowed ladder(ladders_);
      for (const GroupPair& groups : groups_) {
        all.a = groups.a;
        all.b = groups.b;
        ladder->split(all, budget_.most_pairs(), leave, {before_, budget_.bytes_before(), full});
      }
    });
    flush();
    hand_over(before_);
    reports_.report(counts_.total(), true);
    return counts_;
  }

 private:
  /// A product that is to be answered, with what was answered before it.
  struct Item {
    SightAnswers before;
    PairBlockTask task;
  };

  /// Answers to one of the products that are under way.
  struct Slot {
    SightAnswers answers;
    bool has_all = false;  ///< else they were more than it has room for
  };

  /// Ends the walk through a product to which there are too many answers.
  struct TooMany {};

  static float largest_coordinate(const PatchTree& a, const PatchTree& b, const OccluderData& occluders) noexcept {
    return std::max({a.largest_coordinate(), b.largest_coordinate(), occluders.largest_coordinate});
  }

  /// Boxes around the points of occluders: what boxes of patches leave open asks for them.
  static std::vector<TurnedBox> turned_boxes(const PatchTree& a, const PatchTree& b, const OccluderData& occluders) {
    std::vector<TurnedBox> boxes;
    if (!a.has_corners() && !b.has_corners()) return boxes;
    in_float_environment([&] {
      boxes.reserve(occluders.size());
      for (std::size_t i = 0; i != occluders.size(); ++i) {
        const std::span<const Vec3> points = occluders.points_of(i);
        boxes.push_back(points.empty() ? TurnedBox{} : turned_box(points));
      }
    });
    return boxes;
  }

  [[nodiscard]] std::uint64_t total_pairs() const noexcept {
    std::uint64_t pairs = 0;
    for (const GroupPair& groups : groups_) pairs += job_.pairs(groups.a, groups.b);
    return pairs;
  }

  void add(PairBlockTask&& task) {
    waiting_bytes_ += sizeof(Item) + task.lists.held_bytes() + before_.held_bytes();
    SightAnswers before;
    std::swap(before, before_);
    items_.push_back({std::move(before), std::move(task)});
    if (budget_.is_full(items_.size(), waiting_bytes_)) flush();
  }

  /// Answers the products that wait side by side, and hands all over in order. A product to which there are more
  /// answers than there is room for is answered again when it is its turn, in parts.
  void flush() {
    if (items_.empty()) return;
    const std::size_t slots = std::min(budget_.slots(), items_.size());
    if (slots_.size() < slots) slots_.resize(slots);
    bool had_too_many = false;
    std::size_t most_bytes = 0;
    ordered_pipeline(
        items_.size(), budget_.slots(), [&](std::size_t i, std::size_t slot) { answer(items_[i].task, slots_[slot]); },
        [&](std::size_t i, std::size_t slot) {
          hand_over(items_[i].before);
          most_bytes = std::max(most_bytes, slots_[slot].answers.memory_bytes());
          if (!slots_[slot].has_all) {
            had_too_many = true;
            answer_in_parts(items_[i].task, slots_[slot].answers);
          }
          hand_over(slots_[slot].answers);
          reports_.report(counts_.total());
        });
    items_.clear();
    waiting_bytes_ = 0;
    budget_.fit(had_too_many, most_bytes);
  }

  /// Answers a product, or gives up when there are too many answers.
  void answer(const PairBlockTask& task, Slot& slot) {
    SightAnswers& answers = slot.answers;
    answers.clear();
    // What is kept of earlier ones must leave room for these, which grow by doubling.
    if (answers.held_bytes() > budget_.kept_bytes()) answers = {};
    slot.has_all = false;
#if defined(__cpp_exceptions)
    const auto give_up = [] { throw TooMany(); };
    const Ladder::Full full = give_up;
    try {
      LadderPool::Borrowed(ladders_)->answer(task, {answers, budget_.answer_bytes(), full});
      slot.has_all = true;
    } catch (const TooMany&) {
      return;
    }
    verdicts_.resolve(answers);
#else  // a ladder cannot be left half-way: every product is answered in parts
    static_cast<void>(task);
#endif
  }

  /// Answers a product whatever there is to say, and hands all over but the last part.
  void answer_in_parts(const PairBlockTask& task, SightAnswers& answers) {
    answers.clear();
    const auto hand_over_part = [&] {
      verdicts_.resolve(answers);
      hand_over(answers);
      answers.clear();
      reports_.report(counts_.total());
    };
    const Ladder::Full full = hand_over_part;
    in_float_environment([&] { LadderPool::Borrowed(ladders_)->answer(task, {answers, budget_.part_bytes(), full}); });
    verdicts_.resolve(answers);
  }

  /// Counts and delivers.
  void hand_over(const SightAnswers& answers) {
    counts_ += answers.counts;
    if (deliver_ == nullptr || (answers.blocks.empty() && answers.undecided.empty())) return;
    modes_([&] { (*deliver_)({answers.blocks, undecided_of(job_, answers)}); });
  }

  const Deliver* deliver_;
  CallersModes modes_;
  MadeOnce<SolidRows>::Shared solids_;
  MadeOnce<BoxClumps>::Shared clumps_;
  MadeOnce<BoxClumps>::Shared polygon_clumps_;
  std::vector<TurnedBox> turned_occluders_;
  SightJob job_;
  std::vector<GroupPair> groups_;
  Verdicts verdicts_;
  ProgressReports reports_;
  LadderPool ladders_;
  AnswerBudget budget_;
  SightCounts counts_;
  SightAnswers before_;
  std::vector<Item> items_;
  std::size_t waiting_bytes_ = 0;
  std::vector<Slot> slots_;
};

}  // namespace

SightCounts run_visibility(const PatchTree& a, const PatchTree& b, bool is_of_one_set, const OccluderData& occluders,
                           const VisibilityOptions& options, const FunctionRef<void(const SightBatch&)>* deliver) {
  return Run(a, b, is_of_one_set, occluders, options, deliver).run();
}

}  // namespace shaftcull::kernel
