// Baking with shafts: from a mesh to form factors, and what to ask again when things move.
#include "baking_scene.hpp"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// [[bake]]
// What each patch sends to all others: the sum of its row of form factors, which are of the
// middle of a patch. Sums are integers, so it does not matter in what order threads add to
// them.
class Bake {
 public:
  explicit Bake(const Scene& scene) : scene_(scene), sum_(scene.mesh.size()) {}

  // Shares are those of what goes from i to j, and from j to i. A solver keeps the form
  // factors.
  void add(std::size_t i, std::size_t j, double from_i, double from_j) {
    add_one_way(i, j, from_i);
    add_one_way(j, i, from_j);
  }
  // All pairs of a block.
  void add(const sc::PairBlock& block) {
    const auto order = scene_.patches.order();
    for (std::size_t p = 0; p != block.a.count; ++p) {
      for (std::size_t q = 0; q != block.b.count; ++q)
        add(order[block.a.first + p], order[block.b.first + q], 1, 1);
    }
  }
  std::vector<double> rows() const {
    std::vector<double> rows;
    for (const auto& sum : sum_) rows.push_back(static_cast<double>(sum.load()) / unit);
    return rows;
  }

 private:
  static constexpr double unit = 1e12;

  void add_one_way(std::size_t from, std::size_t to, double share) {
    const Point middle = mix(scene_.mesh[from], 1 / 3.0, 1 / 3.0);
    Point normal = normal_of(scene_.mesh[from]);
    const double length = std::sqrt(dot(normal, normal));
    for (double& x : normal) x /= length;
    // A patch across the plane of another one may have its middle behind it.
    if (dot(middle - point(scene_.mesh[to].vertex[0]), normal_of(scene_.mesh[to])) <= 0) return;
    const double factor = form_factor(middle, normal, scene_.mesh[to]);
    sum_[from] += std::llround(share * factor * unit);
  }

  const Scene& scene_;
  std::vector<std::atomic<long long>> sum_;
};

std::vector<double> bake(const Scene& scene, const sc::Visibility& sees) {
  Bake bake(scene);
  for (const sc::PairBlock& block : sees.blocks) {
    if (block.sight == sc::Sight::clear) bake.add(block);  // without a ray
  }
  for (std::size_t p = 0; p != sees.undecided.size(); ++p) {  // the others by rays
    const auto [i, j] = sees.undecided[p];
    const auto candidates = std::span(sees.candidates)
                                .subspan(sees.first_candidate[p],
                                         sees.first_candidate[p + 1] - sees.first_candidate[p]);
    bake.add(i, j, share(scene, i, j, candidates), share(scene, j, i, candidates));
  }
  return bake.rows();
}
// [[end]]

// [[deliver]]
// The same without storing answers. Many threads call resolve() at once. It counts pairs that
// are seen or hidden as a whole, and adds the visible part of the others itself.
std::vector<double> bake_in_passing(const Scene& scene, sc::SightCounts& counts) {
  Bake bake(scene);
  sc::VisibilityOptions options;
  options.resolve = [&](const sc::UndecidedPairs& undecided, std::span<sc::Sight> verdict) {
    for (std::size_t p = 0; p != undecided.pairs.size(); ++p) {
      const auto [i, j] = undecided.pairs[p];
      const auto candidates = undecided.candidates.subspan(
          undecided.first_candidate[p],
          undecided.first_candidate[p + 1] - undecided.first_candidate[p]);
      const double from_i = share(scene, i, j, candidates);
      const double from_j = share(scene, j, i, candidates);
      if (from_i == 1 && from_j == 1) {
        verdict[p] = sc::Sight::clear;  // comes in a block
      } else if (from_i == 0 && from_j == 0) {
        verdict[p] = sc::Sight::occluded;
      } else {
        bake.add(i, j, from_i, from_j);  // stays undecided
      }
    }
  };
  counts = sc::visibility(
      scene.patches, scene.occluders,
      [&](const sc::SightBatch& batch) {
        for (const sc::PairBlock& block : batch.blocks) {
          if (block.sight == sc::Sight::clear) bake.add(block);
        }
      },
      options);
  return bake.rows();
}
// [[end]]

// [[kept]]
// The answers that are kept: a bit for each pair that is clear, and the undecided pairs with
// their candidates. All other pairs are dark.
struct Answers {
  std::vector<std::uint64_t> clear;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> open;
  bool operator==(const Answers&) const = default;
};

// The bit of a pair, whichever is named first.
struct Bit {
  Bit(const Scene& scene, Answers& answers, std::uint32_t i, std::uint32_t j)
      : word(answers.clear[std::min(i, j) * sc::bit_words(scene.patches.size()) +
                           std::max(i, j) / 64]),
        mask(std::uint64_t{1} << std::max(i, j) % 64) {}
  std::uint64_t& word;
  std::uint64_t mask;
};

template <class Visit>
void for_each_pair(const Scene& scene, const sc::PairBlock& block, const Visit& visit) {
  const auto order = scene.patches.order();
  for (std::size_t p = 0; p != block.a.count; ++p) {
    for (std::size_t q = 0; q != block.b.count; ++q)
      visit(order[block.a.first + p], order[block.b.first + q]);
  }
}

Answers all_answers(const Scene& scene, const sc::Occluders& occluders) {
  Answers answers;
  answers.clear.resize(scene.patches.size() * sc::bit_words(scene.patches.size()));
  sc::visibility(scene.patches, occluders, [&](const sc::SightBatch& batch) {
    for (const sc::PairBlock& block : batch.blocks) {
      if (block.sight != sc::Sight::clear) continue;
      for_each_pair(scene, block, [&](auto i, auto j) {
        const Bit bit(scene, answers, i, j);
        bit.word |= bit.mask;
      });
    }
    const sc::UndecidedPairs& undecided = batch.undecided;
    for (std::size_t p = 0; p != undecided.pairs.size(); ++p) {
      const auto some = undecided.candidates.subspan(
          undecided.first_candidate[p],
          undecided.first_candidate[p + 1] - undecided.first_candidate[p]);
      answers.open[{undecided.pairs[p].a, undecided.pairs[p].b}] = {some.begin(), some.end()};
    }
  });
  return answers;
}
// [[end]]

// [[comes]]
// An object comes. It is occluder `number` from now on, and alone in `thing`. Returns the pairs
// whose rays must be traced again.
std::vector<sc::PatchPair> comes(const Scene& scene, Answers& answers,
                                 const sc::Occluders& thing, std::uint32_t number) {
  std::vector<sc::PatchPair> changed;
  sc::VisibilityOptions options;
  options.candidates = false;  // it is the thing
  sc::visibility(
      scene.patches, thing,
      [&](const sc::SightBatch& batch) {
        for (const sc::PatchPair& pair : batch.undecided.pairs) {  // it reaches between these
          const Bit bit(scene, answers, pair.a, pair.b);
          const auto open = answers.open.find({pair.a, pair.b});
          if (open != answers.open.end()) {
            open->second.push_back(number);
          } else if (bit.word & bit.mask) {
            bit.word &= ~bit.mask;
            answers.open[{pair.a, pair.b}] = {number};
          } else {
            continue;  // a solid hides them, whatever else is between
          }
          changed.push_back(pair);
        }
        for (const sc::PairBlock& block : batch.blocks) {
          if (block.sight != sc::Sight::occluded) continue;  // it hides these, if it is solid
          for_each_pair(scene, block, [&](auto i, auto j) {
            const Bit bit(scene, answers, i, j);
            bit.word &= ~bit.mask;
            answers.open.erase({i, j});
          });
        }
      },
      options);
  return changed;
}
// [[end]]

// [[leaves]]
// A thing leaves that is not solid. Pairs that had no other candidate are clear.
void leaves(const Scene& scene, Answers& answers, std::span<const sc::PatchPair> changed,
            std::uint32_t number) {
  for (const sc::PatchPair& pair : changed) {  // what comes() returned
    const auto open = answers.open.find({pair.a, pair.b});
    std::erase(open->second, number);
    if (!open->second.empty()) continue;
    answers.open.erase(open);
    const Bit bit(scene, answers, pair.a, pair.b);
    bit.word |= bit.mask;
  }
}
// [[end]]

// Queries all pairs again, and compares. Times go to the error output.
bool check(const Scene& scene, const Answers& answers, const sc::Occluders& occluders,
           const char* what, std::size_t changed, Clock::time_point begin) {
  const double took = milliseconds_since(begin);
  begin = Clock::now();
  const Answers again = all_answers(scene, occluders);
  std::fprintf(stderr, "%s: %.1f ms; all again: %.1f ms\n", what, took,
               milliseconds_since(begin));
  std::printf("%s: rays of %zu pairs are traced again, %zu are undecided now\n", what, changed,
              answers.open.size());
  return answers == again;
}

// A chair comes, moves and leaves; then a partition comes, which is solid.
bool move_things(const Scene& scene) {
  const sc::Box chair{{3, 2, 0}, {3.5F, 2.5F, 1}};
  const sc::Box elsewhere{{2.5F, 2, 0}, {3, 2.5F, 1}};
  const sc::Box partition{{5, 1.5F, 0.25F}, {5.25F, 3.5F, 2.5F}};
  const auto number = static_cast<std::uint32_t>(scene.occluders.size());
  const auto with = [&](const sc::Box& box, bool is_solid, sc::Occluders occluders) {
    is_solid ? occluders.add_solids(std::span(&box, 1))
             : occluders.add_boxes(std::span(&box, 1));
    return occluders;
  };
  const auto alone = [&](const sc::Box& box, bool is_solid) { return with(box, is_solid, {}); };
  Answers answers = all_answers(scene, scene.occluders);

  auto begin = Clock::now();
  auto changed = comes(scene, answers, alone(chair, false), number);
  if (!check(scene, answers, with(chair, false, scene.occluders), "a chair comes",
             changed.size(), begin))
    return false;

  begin = Clock::now();
  leaves(scene, answers, changed, number);
  changed = comes(scene, answers, alone(elsewhere, false), number);
  if (!check(scene, answers, with(elsewhere, false, scene.occluders), "it moves",
             changed.size(), begin))
    return false;

  begin = Clock::now();
  leaves(scene, answers, changed, number);
  if (!check(scene, answers, scene.occluders, "it leaves", changed.size(), begin)) return false;

  begin = Clock::now();
  changed = comes(scene, answers, alone(partition, true), number);
  return check(scene, answers, with(partition, true, scene.occluders), "a partition comes",
               changed.size(), begin);
}

double percent(std::uint64_t part, std::uint64_t all) {
  return 100 * static_cast<double>(part) / static_cast<double>(all);
}

// Another size of patches may be given, for measurements.
int main(int argc, char** argv) {
  const float size = argc > 1 ? std::strtof(argv[1], nullptr) : 0.5F;
  Scene scene;
  add_mesh(scene, size);
  add_patches(scene);
  add_occluders(scene);

  // [[call]]
  const sc::Visibility sees = sc::collect_visibility(scene.patches, scene.occluders);
  // [[end]]
  const sc::SightCounts& counts = sees.counts;
  const std::uint64_t facing = counts.total() - counts.facing_away;
  std::printf("%zu patches, %llu pairs, of which %llu face each other:\n", scene.mesh.size(),
              static_cast<unsigned long long>(counts.total()),
              static_cast<unsigned long long>(facing));
  std::printf("%.1f %% of these are clear, %.1f %% occluded, %.1f %% undecided\n",
              percent(counts.clear, facing), percent(counts.occluded, facing),
              percent(counts.undecided, facing));

  if (size >= 0.5F) {
    const std::vector<double> rows = bake(scene, sees);
    // In a closed room all light arrives somewhere.
    const auto [least, most] = std::minmax_element(rows.begin(), rows.end());
    double mean = 0;
    for (const double sum : rows) mean += sum / static_cast<double>(rows.size());
    std::printf("rows sum to %.2f at least, %.2f at most, %.3f on average\n", *least, *most,
                mean);
    if (*least < 0.97 || *most > 1.03) return 1;

    sc::SightCounts resolved;
    if (bake_in_passing(scene, resolved) != rows) return 1;
    std::printf("by rays %.1f %% of the undecided pairs are clear, %.1f %% hidden\n",
                percent(resolved.clear - counts.clear, counts.undecided),
                percent(resolved.occluded - counts.occluded, counts.undecided));
  }
  return move_things(scene) ? 0 : 1;
}
