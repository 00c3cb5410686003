// SPDX-License-Identifier: MIT
#include "fuzz/packing.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "fuzz/check.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::fuzz {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr Box empty{{inf, inf, inf}, {-inf, -inf, -inf}};

/// Copies of records one byte off any alignment, with a byte between each two.
template <class Bound>
class OddRecords {
 public:
  static constexpr std::size_t stride = sizeof(Bound) + 1;

  explicit OddRecords(const std::vector<Bound>& bounds) : bytes_(1 + bounds.size() * stride) {
    for (std::size_t i = 0; i != bounds.size(); ++i) std::memcpy(&bytes_[1 + i * stride], &bounds[i], sizeof(Bound));
  }
  [[nodiscard]] const void* at(std::size_t offset) const { return bytes_.data() + 1 + offset; }

 private:
  std::vector<unsigned char> bytes_;
};

/// Fails unless `stream` takes the records, or refuses them for the first for which `is_good` does not hold and stays
/// as it was. Returns whether it took them.
template <class Stream, class Records, class Bound, class IsGood>
bool packs(Stream& stream, const Records& records, const std::vector<Bound>& bounds, const IsGood& is_good) {
  const auto first_bad = std::find_if_not(bounds.begin(), bounds.end(), is_good);
  const auto expected = static_cast<std::size_t>(first_bad - bounds.begin());
  try {
    stream.update(0, records);
  } catch (const BadBound& error) {
    if (first_bad == bounds.end()) throw Fault(std::string("good bounds were refused: ") + error.what());
    if (error.index() != expected) {
      throw Fault("bound " + std::to_string(error.index()) + " was blamed, not " + std::to_string(expected) + ": " +
                  source_text(*first_bad));
    }
    return false;
  }
  if (first_bad != bounds.end()) throw Fault("a bad bound was packed: " + source_text(*first_bad));
  return true;
}

template <class Bound>
void require_equal(const Bound& packed, const Bound& expected) {
  if (packed != expected) throw Fault(source_text(expected) + " was packed as " + source_text(packed));
}

bool has_corners(const Box& centre_extent) {
  for (std::size_t k = 0; k != 3; ++k) {
    const float centre = centre_extent.lo[k];
    const float half = centre_extent.hi[k];
    if (std::isnan(centre) || !(half >= 0) || (std::isinf(centre) && std::isinf(half))) return false;
  }
  return true;
}

/// Whether `packed` is the smallest box of floats around centre ± half extent, by arithmetic that is exact for most
/// inputs and never wrong by more than lets a hole pass unseen.
bool holds_tightly(const Box& packed, const Box& centre_extent) {
  for (std::size_t k = 0; k != 3; ++k) {
    const double centre = centre_extent.lo[k];
    const double half = centre_extent.hi[k];
    const double lo = packed.lo[k];
    const double hi = packed.hi[k];
    // Sums of two doubles that hold floats are rounded monotonically: a corner cannot be beyond its rounded self.
    if (!(lo <= centre - half && hi >= centre + half)) return false;
    const double above_lo = std::nextafter(packed.lo[k], inf);
    const double below_hi = std::nextafter(packed.hi[k], -inf);
    if (above_lo < centre - half || below_hi > centre + half) return false;
  }
  return true;
}

}  // namespace

bool is_legal(const Box& box) {
  if (box == empty) return true;
  for (std::size_t k = 0; k != 3; ++k) {
    if (!(box.lo[k] <= box.hi[k])) return false;
  }
  return true;
}

bool is_legal(const Sphere& sphere) {
  return std::all_of(sphere.centre.begin(), sphere.centre.end(), [](float x) { return std::isfinite(x); }) &&
         sphere.radius >= 0;
}

void check_packing(const Case& it) {
  const auto legal_box = [](const Box& box) { return is_legal(box); };
  const auto legal_sphere = [](const Sphere& sphere) { return is_legal(sphere); };
  const OddRecords<Box> boxes(it.boxes);
  const OddRecords<Sphere> spheres(it.spheres);
  const std::size_t count = it.boxes.size();
  const StridedBoxes min_max{boxes.at(offsetof(Box, lo)), boxes.at(offsetof(Box, hi)), boxes.stride, count};
  const StridedCentreExtents extents{boxes.at(offsetof(Box, lo)), boxes.at(offsetof(Box, hi)), boxes.stride, count};
  const StridedSpheres centres{spheres.at(offsetof(Sphere, centre)), spheres.at(offsetof(Sphere, radius)),
                               spheres.stride, it.spheres.size()};

  BoxStream from_min_max(count);
  const bool min_max_packed = packs(from_min_max, min_max, it.boxes, legal_box);
  BoxStream from_extents(count);
  const bool extents_packed = packs(from_extents, extents, it.boxes, has_corners);
  for (std::size_t i = 0; i != count; ++i) {
    require_equal(from_min_max[i], min_max_packed ? it.boxes[i] : empty);
    if (!extents_packed) {
      require_equal(from_extents[i], empty);
    } else if (!holds_tightly(from_extents[i], it.boxes[i])) {
      throw Fault("centre and half extent " + source_text(it.boxes[i]) + " were packed as " +
                  source_text(from_extents[i]));
    }
  }
  SphereStream from_centres(it.spheres.size());
  const bool centres_packed = packs(from_centres, centres, it.spheres, legal_sphere);
  for (std::size_t i = 0; i != it.spheres.size(); ++i) {
    require_equal(from_centres[i], centres_packed ? it.spheres[i] : Sphere{{0, 0, 0}, -1});
  }
}

}  // namespace shaftcull::fuzz
