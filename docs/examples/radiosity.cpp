// The shafts of a radiosity solver: for each pair of patches that face each other, the
// candidates that its rays are tested against. With shafts and one tree, and with a
// hand-written slab loop.
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

#include "by_hand.hpp"

namespace sc = shaftcull;

namespace {

struct Scene {
  std::vector<sc::Box> patches;  // of the floor, the ceiling and two walls
  std::vector<sc::Box> objects;  // pieces of furniture, many on the floor
  std::vector<sc::IndexPair> pairs;

  explicit Scene(std::size_t count) {
    by_hand::Random random;
    for (int i = 0; i != 16 * 16; ++i) {
      const int row = i / 16;
      const auto x = static_cast<float>(row);
      const auto y = static_cast<float>(i % 16);
      patches.push_back({{x, y, 0}, {x + 1, y + 1, 0}});
      patches.push_back({{x, y, 4}, {x + 1, y + 1, 4}});
      if (y >= 4) continue;
      patches.push_back({{0, x, y}, {0, x + 1, y + 1}});
      patches.push_back({{16, x, y}, {16, x + 1, y + 1}});
    }
    while (objects.size() != count) {
      const sc::Vec3 p{random(0, 15), random(0, 15), random(0, 1) * random(0, 3)};
      const float size = random(0.02F, 0.3F);
      objects.push_back({p,
                         {p[0] + size * random(0.2F, 2), p[1] + size * random(0.2F, 2),
                          p[2] + size * random(0.2F, 2)}});
    }
    for (std::uint32_t a = 0; a != patches.size(); ++a) {
      for (std::uint32_t b = a + 1; b != patches.size(); ++b) {
        if (!in_one_plane(patches[a], patches[b])) pairs.push_back({a, b});
      }
    }
  }

  static bool in_one_plane(const sc::Box& a, const sc::Box& b) {
    for (std::size_t k = 0; k != 3; ++k) {
      if (a.lo[k] == a.hi[k] && b.lo[k] == a.lo[k] && b.hi[k] == a.lo[k]) return true;
    }
    return false;
  }
};

// [[shafts]]
// Lists of candidates of all pairs, one after the other. With open contact, objects that stand
// beside a patch, or lie on its wall, are not candidates. Shafts are formed by the hundred.
std::size_t with_shafts(const Scene& scene, const sc::BoxStream& patches,
                        const sc::Bounds& objects, std::span<std::uint32_t> kept) {
  std::vector<sc::CompiledShaft> shafts(128);
  std::size_t candidates = 0;
  for (std::size_t done = 0; done != scene.pairs.size();) {
    const auto now =
        std::span(shafts).first(std::min(shafts.size(), scene.pairs.size() - done));
    sc::compile_batch(patches, patches, std::span(scene.pairs).subspan(done, now.size()), now,
                      {}, sc::Contact::open);
    for (const sc::CompiledShaft& shaft : now) candidates += list(shaft, objects, kept);
    done += now.size();
  }
  return candidates;
}
// [[end]]

std::size_t by_slabs(const Scene& scene, const by_hand::Blocks& blocks,
                     std::span<std::uint32_t> kept) {
  std::size_t candidates = 0;
  for (const sc::IndexPair& pair : scene.pairs) {
    const by_hand::InShaft shaft(scene.patches[pair.a], scene.patches[pair.b]);
    candidates += blocks.list(shaft, kept.data());
  }
  return candidates;
}

}  // namespace

int main(int argc, char** /*argv*/) {
  for (const std::size_t count : {200U, 2000U, 20000U}) {
    Scene scene(count);
    scene.pairs.resize(scene.pairs.size() / 16);  // which is enough to measure
    const sc::BoxTree tree(scene.objects);
    const sc::BoxStream stream(scene.objects);
    const sc::BoxStream patches(scene.patches);
    const by_hand::Blocks blocks(scene.objects);
    std::vector<std::uint32_t> kept(count + 64);
    std::printf("%zu objects, %zu pairs: %zu candidates, %zu by the loop\n", count,
                scene.pairs.size(), with_shafts(scene, patches, tree, kept),
                by_slabs(scene, blocks, kept));
    if (argc == 1) continue;  // else, as `radiosity --time`
    const double shafts =
        by_hand::microseconds([&] { (void)with_shafts(scene, patches, tree, kept); });
    const double flat =
        by_hand::microseconds([&] { (void)with_shafts(scene, patches, stream, kept); });
    const double slabs = by_hand::microseconds([&] { (void)by_slabs(scene, blocks, kept); });
    const auto pairs = static_cast<double>(scene.pairs.size());
    std::printf(
        "  loop %.2f us per pair, shafts and a tree %.2f us: %.2f x, and a stream %.2f us: "
        "%.2f x\n",
        slabs / pairs, shafts / pairs, shafts / slabs, flat / pairs, flat / slabs);
  }
}
