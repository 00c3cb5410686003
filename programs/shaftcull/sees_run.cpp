// SPDX-License-Identifier: MIT
#include "sees_run.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "part_count.hpp"
#include "patch_rays.hpp"

namespace shaftcull::cli {

/// How many rays of undecided pairs arrive, found where resolve() is called, by many threads, and taken where answers
/// are delivered. Pairs stay undecided for the library: rays are no proof.
class PartQuestion::RayAnswers {
 public:
  RayAnswers(const SeesScene& scene, const SeesWork& work)
      : rays_(scene, work.content.rays, work.seed), stops_(work.stops) {}

  void find(const UndecidedPairs& undecided) {
    if (undecided.pairs.empty()) return;
    std::vector<std::uint32_t> seen = seen_of(undecided);
    const std::scoped_lock lock(mutex_);
    found_.insert_or_assign(key_of(undecided), std::move(seen));
  }

  std::vector<std::uint32_t> take(const UndecidedPairs& undecided) {
    if (undecided.pairs.empty()) return {};
    {
      const std::scoped_lock lock(mutex_);
      const auto found = found_.find(key_of(undecided));
      if (found != found_.end() && found->second.size() == undecided.pairs.size()) {
        std::vector<std::uint32_t> seen = std::move(found->second);
        found_.erase(found);
        return seen;
      }
    }
    return seen_of(undecided);
  }

 private:
  /// No pair is in two batches, so its first one tells a batch from others.
  static std::uint64_t key_of(const UndecidedPairs& undecided) {
    return std::uint64_t{undecided.pairs.front().a} << 32 | undecided.pairs.front().b;
  }

  [[nodiscard]] std::vector<std::uint32_t> seen_of(const UndecidedPairs& undecided) const {
    constexpr std::size_t at_once = 64;  // between two looks at the clock
    std::vector<std::uint32_t> seen(undecided.pairs.size());
    for (std::size_t i = 0; i < seen.size(); i += at_once) {
      if (stops_ && stops_()) throw Cancelled("rays were cancelled");
      const std::size_t count = std::min(at_once, seen.size() - i);
      rays_.count_seen(
          {undecided.pairs.subspan(i, count), undecided.first_candidate.subspan(i, count + 1), undecided.candidates},
          std::span(seen).subspan(i, count));
    }
    return seen;
  }

  PatchRays rays_;
  const std::function<bool()>& stops_;
  std::mutex mutex_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> found_;
};

namespace {

/// Keeps what a part answers.
class PartKeeper final : public SightSink {
 public:
  explicit PartKeeper(PartAnswer& answer) : answer_(answer) {}

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override {
    for (const PairBlock& block : batch.blocks) {
      for (const std::uint32_t n :
           {block.a.first, block.a.count, block.b.first, block.b.count, static_cast<std::uint32_t>(block.sight)}) {
        answer_.blocks.push_back(n);
      }
    }
    const UndecidedPairs& undecided = batch.undecided;
    const std::uint64_t before = answer_.candidates.size();
    answer_.undecided.insert(answer_.undecided.end(), undecided.pairs.begin(), undecided.pairs.end());
    for (const std::size_t end : ends_of(undecided)) answer_.ends.push_back(before + end);
    answer_.candidates.insert(answer_.candidates.end(), undecided.candidates.begin(), undecided.candidates.end());
    answer_.seen.insert(answer_.seen.end(), seen.begin(), seen.end());
  }
  void finish() override {}

 private:
  PartAnswer& answer_;
};

}  // namespace

SeesCounts& SeesCounts::operator+=(const SeesCounts& more) noexcept {
  sights += more.sights;
  visible += more.visible;
  partial += more.partial;
  hidden += more.hidden;
  return *this;
}

SeesCounts::Numbers SeesCounts::numbers() const noexcept {
  return {sights.undecided, sights.clear, sights.occluded, sights.facing_away, visible, partial, hidden};
}

SeesCounts SeesCounts::of(std::span<const std::uint64_t, 7> numbers) noexcept {
  return {{numbers[0], numbers[1], numbers[2], numbers[3]}, numbers[4], numbers[5], numbers[6]};
}

PartQuestion::PartQuestion(const SeesScene& scene, const PatchSet& patches, const SeesWork& work)
    : scene_(scene), patches_(patches), content_(work.content) {
  options_.memory = work.memory;
  options_.tolerance = scene.tolerance;
  options_.candidates = content_.candidates || content_.rays != 0;
  if (content_.rays == 0) return;
  ray_answers_ = std::make_unique<RayAnswers>(scene, work);
  options_.resolve = [this](const UndecidedPairs& undecided, std::span<Sight>) { ray_answers_->find(undecided); };
}

PartQuestion::~PartQuestion() = default;

SeesCounts PartQuestion::deliver(std::size_t part, std::span<SightSink* const> sinks,
                                 const std::function<bool(const VisibilityProgress&)>& progress) {
  SeesCounts counts;
  VisibilityOptions options = options_;
  options.progress = progress;
  options.part = static_cast<std::uint32_t>(part);
  options.parts = part_count(patches_.size(), parts_of_sees);
  if (content_.rays == 0 && sinks.empty()) {
    counts.sights = count_visibility(patches_, scene_.occluders, options);
    return counts;
  }
  const auto take = [&](const SightBatch& batch) {
    const std::vector<std::uint32_t> seen =
        content_.rays == 0 ? std::vector<std::uint32_t>() : ray_answers_->take(batch.undecided);
    for (const std::uint32_t n : seen) {
      ++(n == 0 ? counts.hidden : n == content_.rays ? counts.visible : counts.partial);
    }
    SightBatch wanted = batch;
    if (!content_.candidates) wanted.undecided = {batch.undecided.pairs, {}, {}};  // they were for rays
    for (SightSink* const sink : sinks) sink->take(wanted, seen);
  };
  counts.sights = visibility(patches_, scene_.occluders, take, options);
  return counts;
}

SeesCounts find_what_sees(const SeesScene& scene, const PatchSet& patches, const SeesWork& work,
                          std::span<SightSink* const> sinks) {
  PartQuestion question(scene, patches, work);
  SeesCounts counts;
  const std::uint64_t total = pair_count(patches.size());
  std::uint64_t before = 0;
  std::function<bool(const VisibilityProgress&)> progress;
  if (work.progress) {
    progress = [&](const VisibilityProgress& now) { return work.progress({before + now.done, total}); };
  }
  for (std::size_t part = 0; part != part_count(patches.size(), parts_of_sees); ++part) {
    const SeesCounts some = question.deliver(part, sinks, progress);
    counts += some;
    before += some.sights.total();
  }
  for (SightSink* const sink : sinks) sink->finish();
  return counts;
}

PartAnswer answer_of(PartQuestion& question, std::size_t part) {
  PartAnswer answer;
  PartKeeper keeper(answer);
  SightSink* const sinks[] = {&keeper};
  const SeesCounts counts = question.deliver(part, sinks, {});
  const SeesCounts::Numbers numbers = counts.numbers();
  answer.counts.assign(numbers.begin(), numbers.end());
  return answer;
}

SeesCounts hand_over(const PartAnswer& answer, std::span<SightSink* const> sinks) {
  const SeesCounts counts = SeesCounts::of(std::span(answer.counts).first<7>());
  if (sinks.empty()) return counts;
  std::vector<PairBlock> blocks;
  for (std::size_t i = 0; i < answer.blocks.size(); i += 5) {
    const std::uint32_t* const row = &answer.blocks[i];
    blocks.push_back({{row[0], row[1]}, {row[2], row[3]}, static_cast<Sight>(row[4])});
  }
  std::vector<std::size_t> first_candidate;
  if (!answer.ends.empty()) {
    first_candidate.push_back(0);
    first_candidate.insert(first_candidate.end(), answer.ends.begin(), answer.ends.end());
  }
  const SightBatch batch{blocks, {answer.undecided, first_candidate, answer.candidates}};
  for (SightSink* const sink : sinks) sink->take(batch, answer.seen);
  return counts;
}

SeenShares::SeenShares(std::span<const std::uint32_t> order, std::uint32_t rays)
    : order_(order), most_(rays == 0 ? 1 : rays), sums_(2 * order.size()) {}

void SeenShares::take(const SightBatch& batch, std::span<const std::uint32_t> seen) {
  const auto add = [&](const PatchRun& run, std::uint32_t others) {
    for (const std::uint32_t patch : order_.subspan(run.first, run.count)) sums_[patch] += most_ * others;
  };
  for (const PairBlock& block : batch.blocks) {
    if (block.sight != Sight::clear) continue;
    add(block.a, block.b.count);
    add(block.b, block.a.count);
  }
  for (std::size_t i = 0; i < batch.undecided.pairs.size(); ++i) {
    const auto [a, b] = batch.undecided.pairs[i];
    const std::size_t first = seen.empty() ? order_.size() : 0;
    const std::uint64_t more = seen.empty() ? 1 : seen[i];
    sums_[first + a] += more;
    sums_[first + b] += more;
  }
}

void SeenShares::finish() {
  const double all = static_cast<double>(most_) * static_cast<double>(std::max<std::size_t>(order_.size(), 2) - 1);
  for (const std::uint64_t sum : sums_) shares_.push_back(static_cast<double>(sum) / all);
}

}  // namespace shaftcull::cli
