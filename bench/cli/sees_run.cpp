// SPDX-License-Identifier: MIT
#include "sees_run.hpp"

#include <map>
#include <mutex>
#include <utility>

#include "sight_rays.hpp"

namespace shaftcull::cli {
namespace {

/// How many rays of undecided pairs arrive, found where resolve() is called, by many threads, and taken where answers
/// are delivered. Pairs stay undecided for the library: rays are no proof.
class RayAnswers {
 public:
  RayAnswers(const SeesScene& scene, const SeesWork& work)
      : scene_(scene), rays_(work.rays, work.seed, scene.planes.empty()), stops_(work.stops) {
    for (const std::vector<std::uint32_t>& triangles : scene.blocker_triangles) {
      rays_.add_blocker(scene.mesh.triangles, triangles);
    }
  }

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
    std::vector<std::uint32_t> seen(undecided.pairs.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (stops_ && stops_()) throw Cancelled("rays were cancelled");
      const std::size_t first = undecided.first_candidate[i];
      seen[i] = rays_.seen(scene_.patches, undecided.pairs[i].a, undecided.pairs[i].b,
                           undecided.candidates.subspan(first, undecided.first_candidate[i + 1] - first));
    }
    return seen;
  }

  const SeesScene& scene_;
  SightRays rays_;
  const std::function<bool()>& stops_;
  std::mutex mutex_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> found_;
};

}  // namespace

SeesCounts find_what_sees(const SeesScene& scene, const PatchSet& patches, const SeesWork& work,
                          std::span<SightSink* const> sinks) {
  VisibilityOptions options;
  options.memory = work.memory;
  options.progress = work.progress;
  // Proofs and rays are of one scene: a ray that starts inside a solid does not meet its front.
  options.solids_around_ends = work.rays == 0;
  SeesCounts counts;
  if (work.rays == 0 && sinks.empty()) {
    counts.sights = count_visibility(patches, scene.blockers, options);
    return counts;
  }
  RayAnswers rays(scene, work);
  if (work.rays != 0) {
    options.resolve = [&](const UndecidedPairs& undecided, std::span<Sight>) { rays.find(undecided); };
  }
  const auto deliver = [&](const SightBatch& batch) {
    const std::vector<std::uint32_t> seen = work.rays == 0 ? std::vector<std::uint32_t>() : rays.take(batch.undecided);
    for (const std::uint32_t n : seen) ++(n == 0 ? counts.hidden : n == work.rays ? counts.visible : counts.partial);
    for (SightSink* const sink : sinks) sink->take(batch, seen);
  };
  counts.sights = visibility(patches, scene.blockers, deliver, options);
  for (SightSink* const sink : sinks) sink->finish();
  return counts;
}

SeenShares::SeenShares(const PatchSet& patches, std::uint32_t rays)
    : patches_(patches), rays_(rays), shares_(patches.size()) {}

void SeenShares::take(const SightBatch& batch, std::span<const std::uint32_t> seen) {
  const auto order = patches_.order();
  for (const SightProduct& product : batch.products) {
    if (product.sight != Sight::clear) continue;
    for (std::uint32_t i = 0; i < product.a.count; ++i) {
      const std::uint32_t a = order[product.a.first + i];
      for (const std::uint32_t b : order.subspan(product.b.first, product.b.count)) {
        ++shares_[a];
        ++shares_[b];
      }
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double share = static_cast<double>(seen[i]) / rays_;
    shares_[batch.undecided.pairs[i].a] += share;
    shares_[batch.undecided.pairs[i].b] += share;
  }
}

void SeenShares::finish() {
  if (shares_.size() < 2) return;
  for (double& share : shares_) share /= static_cast<double>(shares_.size() - 1);
}

}  // namespace shaftcull::cli
