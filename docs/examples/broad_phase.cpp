// A physics broad phase: thousands of bodies move at once, and each stops at the first body
// that it hits. By a tree that is refitted, and by a hand-written grid that is made for each
// frame.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <shaftcull/shaftcull.hpp>
#include <vector>

#include "by_hand.hpp"

namespace sc = shaftcull;

namespace {

struct Scene {
  std::vector<sc::Box> bodies;
  std::vector<sc::Vec3> travel;  // in this frame

  // Bodies of sizes from 0.5 to `largest`, most of them small.
  Scene(std::size_t count, float largest, float farthest) {
    by_hand::Random random;
    const float room = 2 * std::cbrt(static_cast<float>(count));
    while (bodies.size() != count) {
      const sc::Vec3 p{random(0, room), random(0, room), random(0, room)};
      const float r = random(0, 1);
      const float size = 0.5F + (largest - 0.5F) * r * r * r * r;
      bodies.push_back({p, {p[0] + size, p[1] + size, p[2] + size}});
      travel.push_back({random(-farthest, farthest), random(-farthest, farthest),
                        random(-farthest, farthest)});
    }
  }
};

// [[tree]]
// Bodies are updated in the tree. Queries follow the order of the tree, in which neighbours are
// next to each other.
void by_tree(const Scene& scene, sc::BoxTree& tree, std::vector<sc::FirstContact>& first) {
  tree.update(scene.bodies);
  for (const std::uint32_t i : tree.order()) {
    first[i] =
        first_contact(sc::swept(scene.bodies[i], scene.travel[i]), tree, {.exclude = {i}});
  }
}
// [[end]]

// The usual way: a grid of cells, each with the bodies whose lo corners are in it. A sweep
// looks at all cells that can hold the lo corner of a body that it may hit, and at the times of
// all bodies there, by a slab test.
class Grid {
 public:
  explicit Grid(float cell) : cell_(cell) {}

  void make(const std::vector<sc::Box>& bodies) {
    bodies_ = bodies;
    sc::Vec3 least = bodies[0].lo;
    sc::Vec3 most = bodies[0].lo;
    largest_ = 0;
    for (const sc::Box& body : bodies) {
      for (std::size_t k = 0; k != 3; ++k) {
        least[k] = std::min(least[k], body.lo[k]);
        most[k] = std::max(most[k], body.lo[k]);
        largest_ = std::max(largest_, body.hi[k] - body.lo[k]);
      }
    }
    origin_ = least;
    for (std::size_t k = 0; k != 3; ++k)
      cells_[k] = 1 + static_cast<int>((most[k] - least[k]) / cell_);
    std::size_t cells = 1;
    for (const int along : cells_) cells *= static_cast<std::size_t>(along);
    first_.assign(cells + 1, 0);
    std::vector<std::size_t> at(bodies.size());
    for (std::size_t i = 0; i != bodies.size(); ++i) {
      const sc::Vec3& p = bodies[i].lo;
      at[i] = place(cell(p[0], 0), cell(p[1], 1), cell(p[2], 2));
      ++first_[at[i] + 1];
    }
    for (std::size_t c = 1; c != first_.size(); ++c) first_[c] += first_[c - 1];
    next_.assign(first_.begin(), first_.end() - 1);
    index_.resize(bodies.size());
    for (auto& column : column_) column.resize(bodies.size() + by_hand::lanes);
    for (std::size_t i = 0; i != bodies.size(); ++i) {
      const std::uint32_t to = next_[at[i]]++;
      index_[to] = static_cast<std::uint32_t>(i);
      for (std::size_t k = 0; k != 3; ++k) {
        column_[k][to] = bodies[i].lo[k];
        column_[k + 3][to] = bodies[i].hi[k];
      }
    }
  }

  sc::FirstContact first_contact(std::uint32_t me, const sc::Vec3& travel) const {
    using by_hand::all;
    using by_hand::Floats;
    const sc::Box& body = bodies_[me];
    int from[3];
    int to[3];
    Floats inverse[3];
    for (std::size_t k = 0; k != 3; ++k) {
      from[k] = cell(body.lo[k] + std::min(travel[k], 0.0F) - largest_, k);
      to[k] = cell(body.hi[k] + std::max(travel[k], 0.0F), k);
      inverse[k] = all(1 / (std::fabs(travel[k]) > 1e-20F ? travel[k] : 1e-20F));
    }
    sc::FirstContact contact;
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        const std::uint32_t end = first_[place(to[0], y, z) + 1];
        for (std::uint32_t i = first_[place(from[0], y, z)]; i < end; i += by_hand::lanes) {
          Floats enter = all(0);
          Floats leave = all(1);
          for (std::size_t k = 0; k != 3; ++k) {
            const Floats low = (load(k, i) - all(body.hi[k])) * inverse[k];
            const Floats high = (load(k + 3, i) - all(body.lo[k])) * inverse[k];
            enter = by_hand::larger(enter, by_hand::smaller(low, high));
            leave = by_hand::smaller(leave, by_hand::larger(low, high));
          }
          unsigned hits = by_hand::bits(enter <= leave);
          if (end - i < by_hand::lanes) hits &= (1U << (end - i)) - 1;
          for (; hits != 0; hits &= hits - 1) {
            const auto lane = static_cast<unsigned>(std::countr_zero(hits));
            const std::uint32_t index = index_[i + lane];
            if (index == me) continue;
            const float time = enter[lane];
            if (time < contact.time || (time == contact.time && index < contact.index)) {
              contact.index = index;
              contact.time = time;
            }
          }
        }
      }
    }
    return contact;
  }

  const std::vector<std::uint32_t>& order() const { return index_; }  // cell after cell

 private:
  by_hand::Floats load(std::size_t k, std::uint32_t i) const {
    by_hand::Floats loaded;
    std::memcpy(&loaded, column_[k].data() + i, sizeof loaded);
    return loaded;
  }
  int cell(float x, std::size_t k) const {
    return std::clamp(static_cast<int>((x - origin_[k]) / cell_), 0, cells_[k] - 1);
  }
  std::size_t place(int x, int y, int z) const {
    const int cell = (z * cells_[1] + y) * cells_[0] + x;
    return static_cast<std::size_t>(cell);
  }

  float cell_;
  float largest_ = 0;
  sc::Vec3 origin_{};
  std::array<int, 3> cells_{};
  std::vector<sc::Box> bodies_;
  std::vector<std::uint32_t> first_;  // of each cell; they stand side by side
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> index_;
  std::array<std::vector<float>, 6> column_;
};

void by_grid(const Scene& scene, Grid& grid, std::vector<sc::FirstContact>& first) {
  grid.make(scene.bodies);
  for (const std::uint32_t i : grid.order()) first[i] = grid.first_contact(i, scene.travel[i]);
}

void compare(const char* what, const Scene& scene, bool timed) {
  sc::BoxTree tree(scene.bodies);
  std::vector<sc::FirstContact> first(scene.bodies.size());
  std::vector<sc::FirstContact> by_hand(scene.bodies.size());
  by_tree(scene, tree, first);
  float best = 0;
  double least = 1e30;
  for (const float cell : {1.0F, 1.5F, 2.0F, 3.0F, 4.0F, 6.0F, 8.0F}) {
    Grid grid(cell);
    by_grid(scene, grid, by_hand);
    if (!timed) break;
    const double taken = by_hand::microseconds([&] { by_grid(scene, grid, by_hand); });
    if (taken < least) least = taken, best = cell;
  }
  std::size_t hits = 0;
  std::size_t alike = 0;
  for (std::size_t i = 0; i != first.size(); ++i) {
    hits += first[i] ? 1 : 0;
    alike += first[i].index == by_hand[i].index ? 1 : 0;
  }
  std::printf("%s: %zu of %zu bodies hit one, %zu the same by the grid\n", what, hits,
              first.size(), alike);
  if (!timed) return;
  const double taken = by_hand::microseconds([&] { by_tree(scene, tree, first); });
  std::printf("  grid of %.1f: %.2f us a body; tree: %.2f us, %.2f x\n",
              static_cast<double>(best), least / static_cast<double>(first.size()),
              taken / static_cast<double>(first.size()), taken / least);
}

}  // namespace

int main(int argc, char** /*argv*/) {
  const bool timed = argc > 1;  // as `broad_phase --time`
  compare("equal sizes, short paths", Scene(20000, 0.5F, 0.5F), timed);
  compare("equal sizes, long ways", Scene(20000, 0.5F, 8), timed);
  compare("sizes up to 16 times", Scene(20000, 8, 0.5F), timed);
  compare("sizes up to 16 times, long ways", Scene(20000, 8, 8), timed);
}
