// Baking with shafts: from a mesh to form factors, and what to ask again when things move.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <shaftcull/shaftcull.hpp>
#include <utility>
#include <vector>

namespace sc = shaftcull;
using Point = std::array<double, 3>;
using Clock = std::chrono::steady_clock;

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point point(const sc::Vec3& v) { return {v[0], v[1], v[2]}; }
// u of the way from vertex 0 to vertex 1 and v of that to vertex 2.
Point mix(const sc::Triangle& t, double u, double v) {
  const Point a = point(t.vertex[0]);
  const Point to_b = point(t.vertex[1]) - a;
  const Point to_c = point(t.vertex[2]) - a;
  return {a[0] + u * to_b[0] + v * to_c[0], a[1] + u * to_b[1] + v * to_c[1],
          a[2] + u * to_b[2] + v * to_c[2]};
}
Point normal_of(const sc::Triangle& t) {
  return cross(mix(t, 1, 0) - mix(t, 0, 0), mix(t, 0, 1) - mix(t, 0, 0));
}
double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// [[mesh]]
bool holds(const sc::Box& box, const sc::Vec3& p) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (p[k] < box.lo[k] || p[k] > box.hi[k]) return false;
  }
  return true;
}

// The sides of a box in triangles with legs of `size` or less. Those of a room face inwards;
// what lies in an opening is left out.
void add_box(std::vector<sc::Triangle>& mesh, const sc::Box& box, float size, bool inwards,
             std::span<const sc::Box> openings = {}) {
  for (std::size_t side = 0; side != 6; ++side) {
    const std::size_t k = side % 3;
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const auto cells = [&](std::size_t axis) {
      return static_cast<int>(std::ceil((box.hi[axis] - box.lo[axis]) / size));
    };
    const auto at = [&](std::size_t axis, int cell) {
      return std::min(box.hi[axis], box.lo[axis] + static_cast<float>(cell) * size);
    };
    for (int p = 0; p != cells(i); ++p) {
      for (int q = 0; q != cells(j); ++q) {
        sc::Vec3 corner[4];
        for (int c = 0; c != 4; ++c) {
          corner[c][k] = side < 3 ? box.lo[k] : box.hi[k];
          corner[c][i] = at(i, p + (c == 1 || c == 2 ? 1 : 0));
          corner[c][j] = at(j, q + (c >= 2 ? 1 : 0));
        }
        if (std::any_of(openings.begin(), openings.end(), [&](const sc::Box& opening) {
              return holds(opening, corner[0]) && holds(opening, corner[2]);
            }))
          continue;
        if ((side < 3) != inwards) std::swap(corner[1], corner[3]);
        mesh.push_back({{{corner[0], corner[1], corner[2]}}});
        mesh.push_back({{{corner[0], corner[2], corner[3]}}});
      }
    }
  }
}
// [[end]]

// [[formfactor]]
// How much of the light that leaves a point of a patch reaches another one, if nothing is
// between: Lambert's sum over the edges of what is in front of the patch.
double form_factor(const Point& from, const Point& normal, const sc::Triangle& to) {
  std::vector<Point> seen;
  for (std::size_t c = 0; c != 3; ++c) {
    const Point a = point(to.vertex[c]) - from;
    const Point b = point(to.vertex[(c + 1) % 3]) - from;
    const double before = dot(a, normal);
    const double behind = dot(b, normal);
    if (before >= 0) seen.push_back(a);
    if ((before < 0) != (behind < 0)) {
      const double t = before / (before - behind);
      seen.push_back(
          {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
    }
  }
  double sum = 0;
  for (std::size_t c = 0; c != seen.size(); ++c) {
    const Point& a = seen[c];
    const Point& b = seen[(c + 1) % seen.size()];
    const Point across = cross(a, b);
    const double sine = std::sqrt(dot(across, across));
    if (sine > 0) sum += std::atan2(sine, dot(a, b)) * dot(across, normal) / sine;
  }
  return std::fabs(sum) / (2 * std::numbers::pi);
}
// [[end]]

struct Scene {
  std::vector<sc::Triangle> mesh;  // what exchanges light
  std::vector<sc::Box> boxes;      // around each triangle
  std::vector<sc::Plane> planes;   // of each triangle
  sc::PatchSet patches;
  sc::Occluders occluders;
  std::vector<std::vector<sc::Triangle>> shape;  // what rays meet of each occluder
};

// [[scene]]
// Two rooms of 4 by 5 by 3 metres, a wall of 25 cm with a door between them.
const std::array<sc::Box, 2> rooms{sc::Box{{0, 0, 0}, {4, 5, 3}},
                                   sc::Box{{4.25F, 0, 0}, {8.25F, 5, 3}}};
const sc::Box passage{{4, 2, 0}, {4.25F, 3, 2}};
const std::array<sc::Box, 2> door{sc::Box{{4, 2, 0}, {4, 3, 2}},
                                  sc::Box{{4.25F, 2, 0}, {4.25F, 3, 2}}};
const std::array<sc::Box, 3> wall{sc::Box{{4, 0, 0}, {4.25F, 2, 3}},
                                  sc::Box{{4, 3, 0}, {4.25F, 5, 3}},
                                  sc::Box{{4, 2, 2}, {4.25F, 3, 3}}};
// Furniture, on feet that are too thin to count.
const sc::Box sideboard{{1, 0.5F, 0.25F}, {2.5F, 1, 1.25F}};
const sc::Box cupboard{{5.75F, 0.75F, 0.25F}, {6.75F, 1.25F, 2.25F}};  // turned by 30 degrees
const std::array<sc::Box, 3> shelf{sc::Box{{1, 3.5F, 0.5F}, {3, 4, 0.5625F}},
                                   sc::Box{{1, 3.5F, 1}, {3, 4, 1.0625F}},
                                   sc::Box{{1, 3.5F, 1.5F}, {3, 4, 1.5625F}}};

void turn(sc::Vec3& p) {  // with the cupboard, around its middle
  const float x = p[0] - 6.25F;
  const float y = p[1] - 1;
  p = {6.25F + 0.866F * x - 0.5F * y, 1 + 0.5F * x + 0.866F * y, p[2]};
}

// The triangles of a thing, out of boxes, turned or not.
std::vector<sc::Triangle> triangles_of(std::span<const sc::Box> boxes, float size,
                                       bool turned = false) {
  std::vector<sc::Triangle> triangles;
  for (const sc::Box& box : boxes) add_box(triangles, box, size, false);
  for (sc::Triangle& t : triangles) {
    for (sc::Vec3& p : t.vertex) {
      if (turned) turn(p);
    }
  }
  return triangles;
}

void add_mesh(Scene& scene, float size) {
  for (const sc::Box& room : rooms) add_box(scene.mesh, room, size, true, door);
  add_box(scene.mesh, passage, size, true, door);
  for (const auto& thing :
       {triangles_of(std::span(&sideboard, 1), size),
        triangles_of(std::span(&cupboard, 1), size, true), triangles_of(shelf, size)})
    scene.mesh.insert(scene.mesh.end(), thing.begin(), thing.end());
}
// [[end]]

// [[patches]]
void add_patches(Scene& scene) {
  for (const sc::Triangle& t : scene.mesh) {
    const Point n = normal_of(t);
    scene.boxes.push_back(sc::box_around(t.vertex));
    scene.planes.push_back(
        {{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])},
         static_cast<float>(dot(n, point(t.vertex[0])))});
  }
  scene.patches = sc::PatchSet(scene.boxes, scene.planes);
}
// [[end]]

// [[occluders]]
// Each thing is one occluder, or some; `shape` has what rays meet of each of them. Whatever is
// known to be solid is added as such, and not as triangles, too.
void add_occluders(Scene& scene) {
  constexpr float whole = 10;  // faces need not be cut for rays
  scene.occluders.add_solids(wall);
  for (const sc::Box& box : wall)
    scene.shape.push_back(triangles_of(std::span(&box, 1), whole));

  scene.occluders.add_solids(std::span(&sideboard, 1));
  scene.shape.push_back(triangles_of(std::span(&sideboard, 1), whole));

  // A hull has up to 32 corners. Those of the twelve triangles are the eight corners of the
  // cupboard.
  scene.shape.push_back(triangles_of(std::span(&cupboard, 1), whole, true));
  std::vector<sc::Vec3> corners;
  for (const sc::Triangle& t : scene.shape.back())
    corners.insert(corners.end(), t.vertex.begin(), t.vertex.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  scene.occluders.add_solid_hulls(corners, std::vector<std::size_t>{0, corners.size()});

  // A shelf is not solid, but three boards with air between them: one group of triangles.
  scene.shape.push_back(triangles_of(shelf, whole));
  const sc::TriangleStream stream{std::span<const sc::Triangle>(scene.shape.back())};
  scene.occluders.add_triangles(stream.view(), std::vector<std::size_t>{0, stream.size()});
}
// [[end]]

// [[rays]]
// Whether a segment passes through a triangle.
bool meets(const Point& from, const Point& to, const sc::Triangle& triangle) {
  const Point a = point(triangle.vertex[0]);
  const Point u = point(triangle.vertex[1]) - a;
  const Point v = point(triangle.vertex[2]) - a;
  const Point way = to - from;
  const Point p = cross(way, v);
  const double det = dot(u, p);
  if (std::fabs(det) < 1e-12) return false;
  const Point s = from - a;
  const double x = dot(s, p) / det;
  const Point q = cross(s, u);
  const double y = dot(way, q) / det;
  const double t = dot(v, q) / det;
  return x >= 0 && y >= 0 && x + y <= 1 && t > 1e-6 && t < 1 - 1e-6;
}

// How much arrives at a patch of the light that the middle of another one sends to it: by rays
// to the middles of n * n equal parts, against candidates alone.
double share(const Scene& scene, std::size_t from, std::size_t to,
             std::span<const std::uint32_t> candidates) {
  constexpr int n = 4;
  const sc::Triangle& target = scene.mesh[to];
  const Point start = mix(scene.mesh[from], 1 / 3.0, 1 / 3.0);
  const Point normal = normal_of(scene.mesh[from]);
  const Point opposite = normal_of(target);
  double all = 0;
  double free = 0;
  for (int ray = 0; ray != n * n; ++ray) {
    const int row = ray / n;
    const int column = ray % n;
    const Point end = row + column < n
                          ? mix(target, (column + 1 / 3.0) / n, (row + 1 / 3.0) / n)
                          : mix(target, (n - column - 1 / 3.0) / n, (n - row - 1 / 3.0) / n);
    const Point way = end - start;
    const double light = std::max(0.0, dot(way, normal)) * std::max(0.0, -dot(way, opposite)) /
                         std::pow(dot(way, way), 2);
    const auto is_in_the_way = [&](std::uint32_t occluder) {
      const auto is_met = [&](const sc::Triangle& t) { return meets(start, end, t); };
      return std::any_of(scene.shape[occluder].begin(), scene.shape[occluder].end(), is_met);
    };
    all += light;
    if (light > 0 && std::none_of(candidates.begin(), candidates.end(), is_in_the_way))
      free += light;
  }
  return all > 0 ? free / all : 0;
}
// [[end]]

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
// The same without keeping any answer. Many threads call resolve() at once; what it can tell of
// a pair it does, and what is seen in part it adds itself.
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
// What is kept of the answers: a bit for each pair that is clear, and the undecided ones with
// their candidates. All others are dark.
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
// A thing comes, which is occluder `number` from now on, and is alone in `thing`. Returns the
// pairs whose rays have to be traced anew.
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

// Asks all anew, and compares. Times go to the error output.
bool check(const Scene& scene, const Answers& answers, const sc::Occluders& occluders,
           const char* what, std::size_t changed, Clock::time_point begin) {
  const double took = milliseconds_since(begin);
  begin = Clock::now();
  const Answers anew = all_answers(scene, occluders);
  std::fprintf(stderr, "%s: %.1f ms; all anew: %.1f ms\n", what, took,
               milliseconds_since(begin));
  std::printf("%s: rays of %zu pairs are traced anew, %zu are undecided now\n", what, changed,
              answers.open.size());
  return answers == anew;
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
