// SPDX-License-Identifier: MIT
#include "visibility/run.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/many.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/threads.hpp"
#include "visibility/arguments.hpp"
#include "visibility/ladder.hpp"
#include "visibility/sight_set.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::uint64_t least_product = 4096;  ///< pairs of two groups of patches

/// Calls callbacks in the modes of the caller, wherever they are called from.
class CallersModes {
 public:
  template <class Callback>
  decltype(auto) operator()(const Callback& callback) const {
    const Restore standard;
    modes_.set();
    return callback();
  }

 private:
  struct Restore {
    FloatState state = FloatState::now();
    Restore() = default;
    Restore(const Restore&) = delete;
    Restore& operator=(const Restore&) = delete;
    ~Restore() { state.set(); }
  };

  FloatState modes_ = FloatState::now();
};

/// What is told of progress, some times a second.
class ProgressTeller {
 public:
  ProgressTeller(const VisibilityOptions& options, const CallersModes& modes, std::uint64_t total)
      : options_(options), modes_(modes), total_(total) {}

  /// Throws Cancelled if the user does not want to go on.
  void tell(std::uint64_t done, bool at_once = false) {
    if (!options_.progress) return;
    const auto now = std::chrono::steady_clock::now();
    if (!at_once && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    if (!modes_([&] { return options_.progress({done, total_}); })) {
      kernel::fail(Cancelled("the call was cancelled by its progress callback after " + std::to_string(done) + " of " +
                             std::to_string(total_) + " pairs"));
    }
  }

 private:
  const VisibilityOptions& options_;
  const CallersModes& modes_;
  std::uint64_t total_;
  std::chrono::steady_clock::time_point last_{};
};

SightCounts& operator+=(SightCounts& to, const SightCounts& more) noexcept {
  to.undecided += more.undecided;
  to.clear += more.clear;
  to.occluded += more.occluded;
  to.facing_away += more.facing_away;
  return to;
}

/// One call.
class Run {
 public:
  using Deliver = FunctionRef<void(const SightBatch&)>;

  Run(const PatchTree& a, const PatchTree& b, bool is_of_one_set, const OccluderData& occluders,
      const VisibilityOptions& options, const Deliver* deliver)
      : options_(options),
        deliver_(deliver),
        solids_(solid_rows_of(occluders)),
        clumps_(clumps_of(occluders)),
        job_{sight_set(a, largest_coordinate(a, b, occluders)),
             sight_set(b, largest_coordinate(a, b, occluders)),
             is_of_one_set,
             occluders,
             std::span(solids_->rows).first(options.solids_around_ends ? solids_->largest : solids_->rows.size()),
             *clumps_,
             solids_->clumps,
             active_kernels().siblings,
             options.contact,
             options.solids_around_ends,
             deliver != nullptr,
             deliver != nullptr || static_cast<bool>(options.resolve),
             options.candidates && (deliver != nullptr || static_cast<bool>(options.resolve)),
             deliver != nullptr && static_cast<bool>(options.resolve)},
        teller_(options, modes_, total_pairs()),
        slot_count_(2 * static_cast<std::size_t>(std::max(concurrency(), 1))),
        room_(options.memory / 8 * 5 / slots()),
        most_answers_(room_ / (options.resolve ? 10 : 6)),
        most_pairs_(largest_product()),
        most_items_(writes() ? slots() : most_items()) {
    if (!options.resolve) return;
    a_place_ = places(a);
    b_place_ = is_of_one_set ? a_place_ : places(b);
  }

  SightCounts run() {
    if (job_.a.tree.groups().empty() || job_.b.tree.groups().empty()) return {};
    teller_.tell(0, true);
    PairBlockTask all{0, 0, {}};
    const auto number = [](std::vector<std::uint32_t>& list, std::size_t count) {
      list.resize(count);
      for (std::size_t i = 0; i != count; ++i) list[i] = static_cast<std::uint32_t>(i);
    };
    number(all.lists.candidates, job_.occluders.size());
    number(all.lists.solids, job_.solids.size());
    for (const PolygonOccluder& polygon : job_.occluders.polygons) all.lists.polygons.push_back(polygon.occluder);

    const auto leave = [&](PairBlockTask&& task) { add(std::move(task)); };
    const auto is_full = [&] {
      flush();
      hand_over(before_);
      before_.clear();
    };
    const Ladder::Full full = is_full;
    in_float_environment([&] { Ladder(job_).split(all, most_pairs_, leave, {before_, options_.memory / 32, full}); });
    flush();
    hand_over(before_);
    teller_.tell(counts_.total(), true);
    return counts_;
  }

 private:
  /// A product that is to be answered, with what was answered before it.
  struct Item {
    SightAnswers before;
    PairBlockTask task;
  };

  /// Where in the order of a tree each patch is.
  static std::vector<std::uint32_t> places(const PatchTree& tree) {
    std::vector<std::uint32_t> place(tree.order().size());
    for (std::size_t p = 0; p != place.size(); ++p) place[tree.order()[p]] = static_cast<std::uint32_t>(p);
    return place;
  }

  /// Answers to one of the products that are under way.
  struct Slot {
    SightAnswers answers;
    bool has_all = false;  ///< else they were more than it has room for
  };

  /// Ends the walk through a product to which there are too many answers.
  struct TooMany {};

  /// A ladder that is some thread's until it is given back.
  class BorrowedLadder {
   public:
    explicit BorrowedLadder(Run& run) : run_(run) {
      const Lock lock(run.ladders_mutex_);
      if (run.ladders_.empty()) {
        run.ladders_.reserve(++run.made_ladders_);  // so that giving back allocates nothing
        ladder_ = std::make_unique<Ladder>(run.job_);
      } else {
        ladder_ = std::move(run.ladders_.back());
        run.ladders_.pop_back();
      }
    }
    BorrowedLadder(const BorrowedLadder&) = delete;
    BorrowedLadder& operator=(const BorrowedLadder&) = delete;
    ~BorrowedLadder() {
      const Lock lock(run_.ladders_mutex_);
      run_.ladders_.push_back(std::move(ladder_));
    }
    Ladder* operator->() const noexcept { return ladder_.get(); }

   private:
    Run& run_;
    std::unique_ptr<Ladder> ladder_;
  };

  static float largest_coordinate(const PatchTree& a, const PatchTree& b, const OccluderData& occluders) noexcept {
    return std::max({a.largest_coordinate(), b.largest_coordinate(), occluders.largest_coordinate});
  }

  [[nodiscard]] std::uint64_t total_pairs() const noexcept {
    return job_.a.tree.groups().empty() || job_.b.tree.groups().empty() ? 0 : job_.pairs(0, 0);
  }

  [[nodiscard]] bool writes() const noexcept { return job_.wants_undecided; }
  [[nodiscard]] std::size_t slots() const noexcept { return slot_count_; }

  /// The most pairs of a product that one thread answers: enough that handing them out costs nothing, and so few that
  /// their answers have room, at 8 bytes a pair.
  [[nodiscard]] std::uint64_t largest_product() const noexcept {
    if (!writes()) return std::uint64_t{1} << 20;
    return std::clamp<std::uint64_t>(most_answers_ / 8, least_product, std::uint64_t{1} << 18);
  }
  /// The most products that wait: so few that progress is told.
  [[nodiscard]] std::size_t most_items() const noexcept { return 64 * slots(); }

  void add(PairBlockTask&& task) {
    waiting_bytes_ += sizeof(Item) + task.lists.held_bytes() + before_.held_bytes();
    SightAnswers before;
    std::swap(before, before_);
    items_.push_back({std::move(before), std::move(task)});
    if (items_.size() >= most_items_ || waiting_bytes_ > options_.memory / 8) flush();
  }

  /// Answers the products that wait side by side, and hands all over in order. A product to which there are more
  /// answers than there is room for is answered again when it is its turn, in parts.
  void flush() {
    if (items_.empty()) return;
    if (slots_.size() < std::min(slots(), items_.size())) slots_.resize(std::min(slots(), items_.size()));
    bool had_too_many = false;
    std::size_t most_bytes = 0;
    ordered_pipeline(
        items_.size(), slots(), [&](std::size_t i, std::size_t slot) { answer(items_[i].task, slots_[slot]); },
        [&](std::size_t i, std::size_t slot) {
          hand_over(items_[i].before);
          most_bytes = std::max(most_bytes, slots_[slot].answers.memory_bytes());
          if (!slots_[slot].has_all) {
            had_too_many = true;
            answer_in_parts(items_[i].task, slots_[slot].answers);
          }
          hand_over(slots_[slot].answers);
          teller_.tell(counts_.total());
        });
    items_.clear();
    waiting_bytes_ = 0;
    if (writes()) fit_products(had_too_many, most_bytes);
  }

  /// Products become smaller where answers to some of them had no room, and larger again where all had plenty.
  void fit_products(bool had_too_many, std::size_t most_bytes) noexcept {
    if (had_too_many) {
      most_pairs_ = std::max(least_product, most_pairs_ / 4);
      most_items_ = slots();
      return;
    }
    most_items_ = std::min(most_items(), 2 * most_items_);
    if (most_bytes < most_answers_ / 8) most_pairs_ = std::min(largest_product(), 2 * most_pairs_);
  }

  /// Answers a product, or gives up when there are too many answers.
  void answer(const PairBlockTask& task, Slot& slot) {
    SightAnswers& answers = slot.answers;
    answers.clear();
    // What is kept of earlier ones must leave room for these, which grow by doubling.
    if (answers.held_bytes() > room_ / 2) answers = {};
    slot.has_all = false;
#if defined(__cpp_exceptions)
    const auto give_up = [] { throw TooMany(); };
    const Ladder::Full full = give_up;
    try {
      BorrowedLadder(*this)->answer(task, {answers, most_answers_, full});
      slot.has_all = true;
    } catch (const TooMany&) {
      return;
    }
    resolve(answers);
#else  // a ladder cannot be left half-way: every product is answered in parts
    static_cast<void>(task);
#endif
  }

  /// Answers a product whatever there is to say, and hands all over but the last part.
  void answer_in_parts(const PairBlockTask& task, SightAnswers& answers) {
    answers.clear();
    const auto hand_over_part = [&] {
      resolve(answers);
      hand_over(answers);
      answers.clear();
      teller_.tell(counts_.total());
    };
    const Ladder::Full full = hand_over_part;
    // Of many slots each has little room, and parts should not be too small.
    const std::size_t most_bytes = std::max(most_answers_, options_.memory / 128);
    in_float_environment([&] { BorrowedLadder(*this)->answer(task, {answers, most_bytes, full}); });
    resolve(answers);
  }

  /// Asks the user about what is undecided.
  void resolve(SightAnswers& answers) const {
    if (!options_.resolve || answers.undecided.empty()) return;
    std::vector<Sight> verdict(answers.undecided.size(), Sight::undecided);
    modes_([&] { options_.resolve(undecided_of(answers), verdict); });
    for (std::size_t i = 0; i != verdict.size(); ++i) {
      if (verdict[i] > Sight::facing_away) refuse_verdict(i, answers.undecided[i], verdict[i]);
    }
    apply(verdict, answers);
  }

  [[noreturn]] static void refuse_verdict(std::size_t i, const PatchPair& pair, Sight verdict) {
    refuse_sight("verdict[" + std::to_string(i) + "]", verdict,
                 ", of patches " + std::to_string(pair.a) + " and " + std::to_string(pair.b) + ",");
  }

  [[nodiscard]] UndecidedPairs undecided_of(const SightAnswers& answers) const noexcept {
    if (!job_.wants_candidates) return {answers.undecided, {}, {}};
    return {answers.undecided, answers.first_candidate, answers.candidates};
  }

  /// Makes products of pairs that have an answer now: where they were found, so that it does not matter where a part
  /// of the answers ends.
  void apply(std::span<const Sight> verdict, SightAnswers& answers) const {
    std::vector<PairBlock> products;
    if (job_.wants_products) products.reserve(answers.products.size() + verdict.size());
    std::size_t taken = 0;
    const auto take = [&](std::size_t end) {
      const auto at = [&](std::size_t i) { return answers.products.begin() + static_cast<std::ptrdiff_t>(i); };
      products.insert(products.end(), at(taken), at(end));
      taken = end;
    };
    std::size_t left = 0;
    std::size_t candidates = 0;
    for (std::size_t i = 0; i != verdict.size(); ++i) {
      const PatchPair pair = answers.undecided[i];
      if (verdict[i] == Sight::undecided) {
        answers.undecided[left++] = pair;
        if (!job_.wants_candidates) continue;
        for (std::size_t c = answers.first_candidate[i]; c != answers.first_candidate[i + 1]; ++c) {
          answers.candidates[candidates++] = answers.candidates[c];
        }
        answers.first_candidate[left] = candidates;  // at or before what is still to be read
        continue;
      }
      --answers.counts.undecided;
      ++answers.counts.of(verdict[i]);
      if (!job_.wants_products) continue;
      take(answers.places[i]);
      products.push_back({{a_place_[pair.a], 1}, {b_place_[pair.b], 1}, verdict[i]});
    }
    take(answers.products.size());
    answers.products = std::move(products);
    answers.undecided.resize(left);
    if (!job_.wants_candidates) return;
    answers.first_candidate.resize(left + 1);
    answers.candidates.resize(candidates);
  }

  /// Counts and delivers.
  void hand_over(const SightAnswers& answers) {
    counts_ += answers.counts;
    if (deliver_ == nullptr || (answers.products.empty() && answers.undecided.empty())) return;
    modes_([&] { (*deliver_)({answers.products, undecided_of(answers)}); });
  }

  const VisibilityOptions& options_;
  const Deliver* deliver_;
  CallersModes modes_;
  MadeOnce<SolidRows>::Shared solids_;
  MadeOnce<BoxClumps>::Shared clumps_;
  SightJob job_;
  ProgressTeller teller_;
  std::vector<std::uint32_t> a_place_;  // for resolve
  std::vector<std::uint32_t> b_place_;
  SightCounts counts_;
  SightAnswers before_;
  std::size_t slot_count_;    // products under way
  std::size_t room_;          // bytes of each slot
  std::size_t most_answers_;  // bytes of answers that fit there, while their memory grows, and what is kept of it
  std::uint64_t most_pairs_;  // of a product
  std::size_t most_items_;    // that wait
  std::vector<Item> items_;
  std::size_t waiting_bytes_ = 0;
  std::vector<Slot> slots_;
  Mutex ladders_mutex_;
  std::vector<std::unique_ptr<Ladder>> ladders_;
  std::size_t made_ladders_ = 0;
};

}  // namespace

SightCounts run_visibility(const PatchTree& a, const PatchTree& b, bool is_of_one_set, const OccluderData& occluders,
                           const VisibilityOptions& options, const FunctionRef<void(const SightBatch&)>* deliver) {
  return Run(a, b, is_of_one_set, occluders, options, deliver).run();
}

}  // namespace shaftcull::kernel
