// Baking with shafts: from a mesh to form factors.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;
using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point point(const sc::Vec3& v) { return {v[0], v[1], v[2]}; }
// u of the way from a to b and v of that to c.
Point mix(const sc::Triangle& t, double u, double v) {
  const Point a = point(t.vertex[0]);
  const Point to_b = point(t.vertex[1]) - a;
  const Point to_c = point(t.vertex[2]) - a;
  return {a[0] + u * to_b[0] + v * to_c[0], a[1] + u * to_b[1] + v * to_c[1],
          a[2] + u * to_b[2] + v * to_c[2]};
}

// [[mesh]]
// A corner of a thing that is turned by 30 degrees around an axis.
sc::Vec3 turned(const sc::Vec3& p) {
  const float x = p[0] - 2;
  const float y = p[1] - 1;
  return {2 + 0.866F * x - 0.5F * y, 1 + 0.5F * x + 0.866F * y, p[2]};
}

// The six sides of a box, cut into triangles: outside in for a room.
void add_box(std::vector<sc::Triangle>& mesh, const sc::Box& box, float size, bool inwards,
             bool turns) {
  for (std::size_t side = 0; side != 6; ++side) {
    const std::size_t k = side % 3;
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const bool flip = (side < 3) != inwards;
    for (float p = box.lo[i]; p < box.hi[i]; p += size) {
      for (float q = box.lo[j]; q < box.hi[j]; q += size) {
        sc::Vec3 corner[4];
        for (int c = 0; c != 4; ++c) {
          corner[c][k] = side < 3 ? box.lo[k] : box.hi[k];
          corner[c][i] = p + (c == 1 || c == 2 ? size : 0);
          corner[c][j] = q + (c >= 2 ? size : 0);
          if (turns) corner[c] = turned(corner[c]);
        }
        if (flip) std::swap(corner[1], corner[3]);
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
// [[end]]

int main() {
  // [[scene]]
  // A room of 4 by 4 by 3 metres, a table top, and a cupboard that is turned and hangs in the
  // air.
  const sc::Box table{{1, 2.5F, 1}, {3, 3.5F, 1.5F}};
  const sc::Box cupboard{{1.5F, 0.5F, 0.5F}, {2.5F, 1.5F, 2.5F}};
  std::vector<sc::Triangle> mesh;
  add_box(mesh, {{0, 0, 0}, {4, 4, 3}}, 1, true, false);
  const std::size_t furniture = mesh.size();
  add_box(mesh, table, 0.5F, false, false);
  add_box(mesh, cupboard, 0.5F, false, true);

  // Patches: the box around each triangle, and the plane that it faces away from.
  std::vector<sc::Box> boxes;
  std::vector<sc::Plane> planes;
  for (const sc::Triangle& t : mesh) {
    const Point normal = cross(mix(t, 1, 0) - mix(t, 0, 0), mix(t, 0, 1) - mix(t, 0, 0));
    const sc::Vec3 n{static_cast<float>(normal[0]), static_cast<float>(normal[1]),
                     static_cast<float>(normal[2])};
    boxes.push_back(sc::box_around(t.vertex));
    planes.push_back({n, static_cast<float>(dot(point(n), point(t.vertex[0])))});
  }
  const sc::PatchSet patches(boxes, planes);

  // Blockers: what is known to be solid, for proofs, and triangles, for rays. The room itself
  // hides nothing within it.
  sc::Blockers blockers;
  blockers.add_solids(std::vector<sc::Box>{table});
  std::vector<sc::Vec3> corners;
  for (const float x : {cupboard.lo[0], cupboard.hi[0]}) {
    for (const float y : {cupboard.lo[1], cupboard.hi[1]}) {
      for (const float z : {cupboard.lo[2], cupboard.hi[2]})
        corners.push_back(turned({x, y, z}));
    }
  }
  blockers.add_solid_hulls(corners, std::vector<std::size_t>{0, 8});
  const std::vector<sc::Triangle> things(mesh.begin() + static_cast<std::ptrdiff_t>(furniture),
                                         mesh.end());
  const sc::TriangleStream stream{std::span<const sc::Triangle>(things)};
  blockers.add_triangles(stream.view());
  // [[end]]

  // [[call]]
  const sc::Visibility sees = sc::collect_visibility(patches, blockers);
  // [[end]]
  std::printf(
      "%zu patches: %llu pairs face away, %llu are clear, %llu blocked, %llu undecided\n",
      mesh.size(), static_cast<unsigned long long>(sees.counts.facing_away),
      static_cast<unsigned long long>(sees.counts.clear),
      static_cast<unsigned long long>(sees.counts.blocked),
      static_cast<unsigned long long>(sees.counts.undecided));

  // [[bake]]
  // What each patch sends to all others. Form factors are of the middle of a patch.
  std::vector<Point> middle;
  std::vector<Point> normal;
  for (const sc::Triangle& t : mesh) {
    middle.push_back(mix(t, 1 / 3.0, 1 / 3.0));
    Point n = cross(mix(t, 1, 0) - mix(t, 0, 0), mix(t, 0, 1) - mix(t, 0, 0));
    const double length = std::sqrt(dot(n, n));
    for (double& x : n) x /= length;
    normal.push_back(n);
  }
  std::vector<double> row_sum(mesh.size());
  const auto add = [&](std::size_t i, std::size_t j, double share_of_i, double share_of_j) {
    // A patch across the plane of another one may have its middle behind it.
    if (dot(middle[i] - middle[j], normal[j]) > 0) {
      row_sum[i] +=
          share_of_i * form_factor(middle[i], normal[i], mesh[j]);  // a solver keeps it
    }
    if (dot(middle[j] - middle[i], normal[i]) > 0) {
      row_sum[j] += share_of_j * form_factor(middle[j], normal[j], mesh[i]);
    }
  };
  for (const sc::SightProduct& product : sees.products) {  // all that is clear, without a ray
    if (product.sight != sc::Sight::clear) continue;
    for (const auto i : patches.order().subspan(product.a.first, product.a.count)) {
      for (const auto j : patches.order().subspan(product.b.first, product.b.count))
        add(i, j, 1, 1);
    }
  }
  for (std::size_t p = 0; p != sees.undecided.size();
       ++p) {  // the rest by rays, against candidates
    const auto [i, j] = sees.undecided[p];
    const auto share = [&](std::size_t from, std::size_t to) {
      constexpr int n = 6;  // rays to the middles of n * n equal parts
      double all = 0;
      double free = 0;
      for (int ray = 0; ray != n * n; ++ray) {
        const int row = ray / n;
        const int column = ray % n;
        const bool up = row + column < n;
        const Point end =
            up ? mix(mesh[to], (column + 1 / 3.0) / n, (row + 1 / 3.0) / n)
               : mix(mesh[to], (n - column - 1 / 3.0) / n, (n - row - 1 / 3.0) / n);
        const Point way = end - middle[from];
        const double light = std::max(0.0, dot(way, normal[from])) *
                             std::max(0.0, -dot(way, normal[to])) / std::pow(dot(way, way), 2);
        all += light;
        bool hit = false;
        for (std::size_t c = sees.first_candidate[p]; c != sees.first_candidate[p + 1] && !hit;
             ++c) {
          for (const std::uint32_t t : blockers.triangles(sees.candidates[c])) {
            hit = hit || meets(middle[from], end, things[t]);
          }
        }
        if (!hit) free += light;
      }
      return all > 0 ? free / all : 0;
    };
    add(i, j, share(i, j), share(j, i));
  }
  // In a closed room all light arrives somewhere.
  const auto [least, most] = std::minmax_element(row_sum.begin(), row_sum.end());
  double mean = 0;
  for (const double sum : row_sum) mean += sum / static_cast<double>(row_sum.size());
  // [[end]]
  std::printf("rows sum to %.2f at least, %.2f at most, %.3f on average\n", *least, *most,
              mean);
  if (*least < 0.97 || *most > 1.03) return 1;

  // [[moving]]
  // A chair comes in. Only pairs whose shaft it reaches into can have another answer; a product
  // is asked as a whole, by the boxes around its runs.
  const sc::Box chair{{0.5F, 1.5F, 0}, {1, 2, 1}};
  const auto around = [&](const sc::PatchRun& run) {
    sc::Box box = boxes[patches.order()[run.first]];
    for (const auto i : patches.order().subspan(run.first, run.count))
      box = sc::joined(box, boxes[i]);
    return box;
  };
  const auto is_met = [&](const sc::Box& a, const sc::Box& b) {
    return sc::cull(sc::compile(a, b, sc::Contact::open), chair);
  };
  std::uint64_t again = 0;
  std::vector<sc::SightProduct> kept;
  for (const sc::SightProduct& product : sees.products) {
    // What a solid hides stays hidden, and what faces away stays so.
    if (product.sight == sc::Sight::clear && is_met(around(product.a), around(product.b))) {
      again += std::uint64_t{product.a.count} * product.b.count;
    } else {
      kept.push_back(product);
    }
  }
  std::uint64_t more = 0;  // undecided pairs that get one more candidate
  for (const sc::PatchPair& pair : sees.undecided)
    more += is_met(boxes[pair.a], boxes[pair.b]) ? 1 : 0;
  // [[end]]
  std::printf(
      "with the chair %llu of %llu clear pairs are asked again, %llu of %llu undecided ones "
      "get a candidate\n",
      static_cast<unsigned long long>(again),
      static_cast<unsigned long long>(sees.counts.clear), static_cast<unsigned long long>(more),
      static_cast<unsigned long long>(sees.counts.undecided));

  // All others are decided still, if all are asked anew.
  blockers.add_boxes(std::vector<sc::Box>{chair});
  const std::size_t words = sc::words_for(patches.size());
  std::vector<std::uint64_t> undecided(patches.size() * words);
  sc::visibility_bits(patches, blockers, sc::Sight::undecided, undecided);
  for (const sc::SightProduct& product : kept) {
    for (const auto i : patches.order().subspan(product.a.first, product.a.count)) {
      for (const auto j : patches.order().subspan(product.b.first, product.b.count)) {
        if (undecided[i * words + j / 64] >> j % 64 & 1) return 1;
      }
    }
  }
  return 0;
}
