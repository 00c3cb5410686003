// SPDX-License-Identifier: MIT
#include "shaftcull/visibility.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "dispatch/active_kernels.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/many.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "visibility/ladder.hpp"

namespace shaftcull {
namespace {

using kernel::SightAnswers;
using kernel::SightJob;
using kernel::SightProductTask;

constexpr std::size_t least_memory = std::size_t{1} << 20;
constexpr std::uint64_t least_product = 4096;  ///< pairs of two groups of patches

/// Errors of computed normal·p − offset, for coordinates of at most `coordinate`: three products, three sums and a
/// difference round, each by 2⁻²⁴ of what is at most |n|·|p| + |offset| in sum; underflow adds less than 2⁻¹⁴⁰. NaN
/// where products may overflow. 0 where nothing is rounded but the difference, whose sign is right then: of a plane
/// across an axis with a normal of 1. Of a group, both bounds of the normal must be such: another patch's may be
/// shorter.
float distance_error(const float (&least)[3], const float (&largest)[3], float offset, float coordinate) noexcept {
  unsigned components = 0;
  double length = 0;
  bool is_unit = true;
  const auto is_unit_or_none = [](float n) { return n == 0 || std::fabs(n) == 1; };
  for (std::size_t k = 0; k != 3; ++k) {
    const float n = std::max(std::fabs(least[k]), std::fabs(largest[k]));
    components += n != 0;
    is_unit = is_unit && is_unit_or_none(least[k]) && is_unit_or_none(largest[k]);
    length += double{n};
  }
  if (components == 1 && is_unit) return 0;
  const double size = length * coordinate + std::fabs(double{offset});
  if (size > 0x1p120) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(8 * 0x1p-24 * size + 0x1p-120);
}

/// The errors of all planes of some streams.
std::vector<float> distance_errors(const kernel::PatchStreams& streams, float coordinate) {
  std::vector<float> error;
  if (!streams.has_planes()) return error;
  error.resize(streams.size() + kernel::most_siblings);
  for (std::size_t i = 0; i != streams.size(); ++i) {
    float least[3];
    float largest[3];
    for (std::size_t k = 0; k != 3; ++k) {
      least[k] = streams.stream(6 + k)[i];
      largest[k] = streams.stream(9 + k)[i];
    }
    error[i] = distance_error(least, largest, streams.stream(12)[i], coordinate);
  }
  return error;
}

kernel::SightSet sight_set(const kernel::PatchTree& tree, float coordinate) {
  return kernel::in_float_environment([&] {
    return kernel::SightSet{tree, distance_errors(tree.patch_streams(), coordinate),
                            distance_errors(tree.group_streams(), coordinate)};
  });
}

/// Checks patches before anything is made of them. `boxes` has `count` boxes: a view or a span.
template <class Boxes>
void require_patches(const Boxes& boxes, std::size_t count, std::span<const Plane> planes) {
  kernel::require_memory("planes", planes, "planes");
  if (!planes.empty() && planes.size() != count) {
    throw InvalidArgument(kernel::counted(planes.size(), "plane") + " for " + std::to_string(count) +
                          " patches; there must be one for each, or none");
  }
  if (count >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument(std::to_string(count) + " patches; there may be at most 2^32 - 2");
  }
  const auto refuse = [](std::size_t i, const char* why) { kernel::refuse_bound("patch", i, why); };
  for (std::size_t i = 0; i != count; ++i) {
    kernel::require_usable_box(boxes[i], "patch", i);
    if (planes.empty()) continue;
    bool is_zero = true;
    for (const float n : planes[i].normal) {
      if (!std::isfinite(n)) refuse(i, "has a plane that is not finite");
      is_zero = is_zero && n == 0;
    }
    if (!std::isfinite(planes[i].offset)) refuse(i, "has a plane that is not finite");
    if (is_zero) refuse(i, "has a plane whose normal is zero");
  }
}

// What is checked are comparisons, of denormals, too, which the caller's modes may take for 0.
std::shared_ptr<const kernel::PatchTree> patch_tree(const BoxView& boxes, std::span<const Plane> planes) {
  kernel::require_view(boxes);
  return kernel::in_float_environment([&] {
    require_patches(boxes, boxes.count, planes);
    return std::make_shared<const kernel::PatchTree>(boxes, planes);
  });
}

std::shared_ptr<const kernel::PatchTree> patch_tree(std::span<const Box> boxes, std::span<const Plane> planes) {
  kernel::require_memory("boxes", boxes, "boxes");
  return kernel::in_float_environment([&] {
    require_patches(boxes, boxes.size(), planes);  // before the stream, which also takes empty boxes
    return std::make_shared<const kernel::PatchTree>(BoxStream(boxes).view(), planes);
  });
}

/// `what` says where the value is, and `whose` of what pair.
[[noreturn]] void refuse_sight(const std::string& what, Sight sight, const std::string& whose = "") {
  throw InvalidArgument(what + " = " + std::to_string(static_cast<unsigned>(sight)) + whose +
                        " is none of Sight::undecided, Sight::clear, Sight::blocked and Sight::facing_away");
}

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
    kernel::FloatState state = kernel::FloatState::now();
    Restore() = default;
    Restore(const Restore&) = delete;
    Restore& operator=(const Restore&) = delete;
    ~Restore() { state.set(); }
  };

  kernel::FloatState modes_ = kernel::FloatState::now();
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
      throw Cancelled("the call was cancelled by its progress callback after " + std::to_string(done) + " of " +
                      std::to_string(total_) + " pairs");
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
  to.blocked += more.blocked;
  to.facing_away += more.facing_away;
  return to;
}

/// One call.
class Run {
 public:
  using Deliver = FunctionRef<void(const SightBatch&)>;

  Run(const kernel::PatchTree& a, const kernel::PatchTree& b, bool is_of_one_set, const kernel::BlockerData& blockers,
      const VisibilityOptions& options, const Deliver* deliver)
      : options_(options),
        deliver_(deliver),
        solids_(blockers.merged_solids.of(blockers.solids)),
        job_{sight_set(a, largest_coordinate(a, b, blockers)),
             sight_set(b, largest_coordinate(a, b, blockers)),
             is_of_one_set,
             blockers,
             std::span(solids_->rows).first(options.solids_around_ends ? solids_->largest : solids_->rows.size()),
             kernel::active_kernels().siblings,
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
    SightProductTask all{0, 0, {}};
    const auto number = [](std::vector<std::uint32_t>& list, std::size_t count) {
      list.resize(count);
      for (std::size_t i = 0; i != count; ++i) list[i] = static_cast<std::uint32_t>(i);
    };
    number(all.lists.candidates, job_.blockers.size());
    number(all.lists.solids, job_.solids.size());
    for (const kernel::PolygonBlocker& polygon : job_.blockers.polygons) all.lists.polygons.push_back(polygon.blocker);

    const auto leave = [&](SightProductTask&& task) { add(std::move(task)); };
    const auto is_full = [&] {
      flush();
      hand_over(before_);
      before_.clear();
    };
    const kernel::Ladder::Full full = is_full;
    kernel::in_float_environment([&] {
      kernel::Ladder(job_).split(all, most_pairs_, leave, {before_, options_.memory / 32, full});
    });
    flush();
    hand_over(before_);
    teller_.tell(counts_.total(), true);
    return counts_;
  }

 private:
  /// A product that is to be answered, with what was answered before it.
  struct Item {
    SightAnswers before;
    SightProductTask task;
  };

  /// Where in the order of a tree each patch is.
  static std::vector<std::uint32_t> places(const kernel::PatchTree& tree) {
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
      const std::lock_guard lock(run.ladders_mutex_);
      if (run.ladders_.empty()) {
        run.ladders_.reserve(++run.made_ladders_);  // so that giving back allocates nothing
        ladder_ = std::make_unique<kernel::Ladder>(run.job_);
      } else {
        ladder_ = std::move(run.ladders_.back());
        run.ladders_.pop_back();
      }
    }
    BorrowedLadder(const BorrowedLadder&) = delete;
    BorrowedLadder& operator=(const BorrowedLadder&) = delete;
    ~BorrowedLadder() {
      const std::lock_guard lock(run_.ladders_mutex_);
      run_.ladders_.push_back(std::move(ladder_));
    }
    kernel::Ladder* operator->() const noexcept { return ladder_.get(); }

   private:
    Run& run_;
    std::unique_ptr<kernel::Ladder> ladder_;
  };

  static float largest_coordinate(const kernel::PatchTree& a, const kernel::PatchTree& b,
                                  const kernel::BlockerData& blockers) noexcept {
    return std::max({a.largest_coordinate(), b.largest_coordinate(), blockers.largest_coordinate});
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

  void add(SightProductTask&& task) {
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
    kernel::ordered_pipeline(
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
  void answer(const SightProductTask& task, Slot& slot) {
    SightAnswers& answers = slot.answers;
    answers.clear();
    // What is kept of earlier ones must leave room for these, which grow by doubling.
    if (answers.held_bytes() > room_ / 2) answers = {};
    const auto give_up = [] { throw TooMany(); };
    const kernel::Ladder::Full full = give_up;
    try {
      BorrowedLadder(*this)->answer(task, {answers, most_answers_, full});
      slot.has_all = true;
    } catch (const TooMany&) {
      slot.has_all = false;
      return;
    }
    resolve(answers);
  }

  /// Answers a product whatever there is to say, and hands all over but the last part.
  void answer_in_parts(const SightProductTask& task, SightAnswers& answers) {
    answers.clear();
    const auto hand_over_part = [&] {
      resolve(answers);
      hand_over(answers);
      answers.clear();
      teller_.tell(counts_.total());
    };
    const kernel::Ladder::Full full = hand_over_part;
    // Of many slots each has little room, and parts should not be too small.
    const std::size_t most_bytes = std::max(most_answers_, options_.memory / 128);
    kernel::in_float_environment([&] { BorrowedLadder(*this)->answer(task, {answers, most_bytes, full}); });
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
    std::vector<SightProduct> products;
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
  kernel::MergedSolids::Rows solids_;
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
  std::mutex ladders_mutex_;
  std::vector<std::unique_ptr<kernel::Ladder>> ladders_;
  std::size_t made_ladders_ = 0;
};

void require_options(const VisibilityOptions& options) {
  kernel::require_contact(options.contact);
  if (options.memory < least_memory) {
    throw InvalidArgument("memory is " + std::to_string(options.memory) + " bytes; it takes 1 MB (1048576) or more");
  }
}

/// `bits` has one row for each of `a` patches, of a bit for each of `b`.
void require_rows(std::span<const std::uint64_t> bits, std::size_t a, std::size_t b) {
  const std::size_t words = words_for(b);
  // No product of such numbers overflows where there are 64-bit sizes; elsewhere no span has so many words.
  const std::uint64_t needed = std::uint64_t{a} * words;
  if (bits.size() != needed) {
    throw InvalidArgument("bits has " + kernel::counted(bits.size(), "word") + "; " + kernel::counted(a, "row") +
                          ", one for each patch of a, of words_for(" + std::to_string(b) +
                          ") = " + kernel::counted(words, "word") + ", a bit for each patch of b, take " +
                          std::to_string(needed));
  }
  kernel::require_memory("bits", bits, "words");
}

void require_callback(const FunctionRef<void(const SightBatch&)>& deliver) {
  if (!deliver) throw InvalidArgument("deliver is empty; it is called with the answers");
}

/// Runs a call of two sets, or of one with itself.
SightCounts run(const PatchSet& a, const PatchSet& b, bool is_of_one_set, const Blockers& blockers,
                const VisibilityOptions& options, const FunctionRef<void(const SightBatch&)>* deliver) {
  require_options(options);
  return Run(a.tree(), b.tree(), is_of_one_set, blockers.data(), options, deliver).run();
}

Visibility collect(const PatchSet& a, const PatchSet& b, bool is_of_one_set, const Blockers& blockers,
                   const VisibilityOptions& options) {
  Visibility all;
  all.first_candidate.push_back(0);
  const auto append = [&](const SightBatch& batch) {
    const UndecidedPairs& undecided = batch.undecided;
    all.products.insert(all.products.end(), batch.products.begin(), batch.products.end());
    all.undecided.insert(all.undecided.end(), undecided.pairs.begin(), undecided.pairs.end());
    const std::size_t before = all.candidates.size();
    all.candidates.insert(all.candidates.end(), undecided.candidates.begin(), undecided.candidates.end());
    for (std::size_t i = 1; i < undecided.first_candidate.size(); ++i) {
      all.first_candidate.push_back(before + undecided.first_candidate[i]);
    }
  };
  const FunctionRef<void(const SightBatch&)> deliver = append;
  all.counts = run(a, b, is_of_one_set, blockers, options, &deliver);
  if (!options.candidates) all.first_candidate.clear();
  return all;
}

SightCounts write_bits(const PatchSet& a, const PatchSet& b, bool is_of_one_set, const Blockers& blockers, Sight sight,
                       std::span<std::uint64_t> bits, const VisibilityOptions& options) {
  if (sight > Sight::facing_away) refuse_sight("sight", sight);
  const std::size_t words = words_for(b.size());
  require_rows(bits, a.size(), b.size());
  std::fill(bits.begin(), bits.end(), 0);
  const auto set = [&](std::size_t i, std::size_t j) { bits[i * words + j / 64] |= std::uint64_t{1} << j % 64; };
  const auto set_pair = [&](std::size_t i, std::size_t j) {
    set(i, j);
    if (is_of_one_set) set(j, i);
  };
  const auto write = [&](const SightBatch& batch) {
    for (const SightProduct& product : batch.products) {
      if (product.sight != sight) continue;
      for (const std::uint32_t i : a.order().subspan(product.a.first, product.a.count)) {
        for (const std::uint32_t j : b.order().subspan(product.b.first, product.b.count)) set_pair(i, j);
      }
    }
    if (sight != Sight::undecided) return;
    for (const PatchPair& pair : batch.undecided.pairs) set_pair(pair.a, pair.b);
  };
  VisibilityOptions without_candidates = options;
  without_candidates.candidates = options.candidates && options.resolve;
  const FunctionRef<void(const SightBatch&)> deliver = write;
  return run(a, b, is_of_one_set, blockers, without_candidates, &deliver);
}

}  // namespace

const char* name(Sight sight) noexcept {
  switch (sight) {
    case Sight::undecided:
      return "undecided";
    case Sight::clear:
      return "clear";
    case Sight::blocked:
      return "blocked";
    case Sight::facing_away:
      return "facing_away";
  }
  return "unknown";
}

Cancelled::~Cancelled() = default;

PatchSet::PatchSet(const BoxView& boxes, std::span<const Plane> planes) : PatchSet(patch_tree(boxes, planes)) {}

PatchSet::PatchSet(std::span<const Box> boxes, std::span<const Plane> planes) : PatchSet(patch_tree(boxes, planes)) {}

const kernel::PatchTree& PatchSet::tree() const noexcept {
  static const kernel::PatchTree none;
  return tree_ ? *tree_ : none;
}
std::size_t PatchSet::size() const noexcept { return tree().order().size(); }
bool PatchSet::has_planes() const noexcept { return tree().has_planes(); }
std::span<const std::uint32_t> PatchSet::order() const noexcept { return tree().order(); }

SightCounts count_visibility(const PatchSet& a, const PatchSet& b, const Blockers& blockers,
                             const VisibilityOptions& options) {
  return run(a, b, false, blockers, options, nullptr);
}
SightCounts count_visibility(const PatchSet& patches, const Blockers& blockers, const VisibilityOptions& options) {
  return run(patches, patches, true, blockers, options, nullptr);
}

SightCounts visibility(const PatchSet& a, const PatchSet& b, const Blockers& blockers,
                       FunctionRef<void(const SightBatch&)> deliver, const VisibilityOptions& options) {
  require_callback(deliver);
  return run(a, b, false, blockers, options, &deliver);
}
SightCounts visibility(const PatchSet& patches, const Blockers& blockers, FunctionRef<void(const SightBatch&)> deliver,
                       const VisibilityOptions& options) {
  require_callback(deliver);
  return run(patches, patches, true, blockers, options, &deliver);
}

Visibility collect_visibility(const PatchSet& a, const PatchSet& b, const Blockers& blockers,
                              const VisibilityOptions& options) {
  return collect(a, b, false, blockers, options);
}
Visibility collect_visibility(const PatchSet& patches, const Blockers& blockers, const VisibilityOptions& options) {
  return collect(patches, patches, true, blockers, options);
}

SightCounts visibility_bits(const PatchSet& a, const PatchSet& b, const Blockers& blockers, Sight sight,
                            std::span<std::uint64_t> bits, const VisibilityOptions& options) {
  return write_bits(a, b, false, blockers, sight, bits, options);
}
SightCounts visibility_bits(const PatchSet& patches, const Blockers& blockers, Sight sight,
                            std::span<std::uint64_t> bits, const VisibilityOptions& options) {
  return write_bits(patches, patches, true, blockers, sight, bits, options);
}

}  // namespace shaftcull
