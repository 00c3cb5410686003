// A character slides along walls and floors: it moves up to the box that it hits, and goes on
// with the rest of its path, without the part that would lead into the box.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

namespace {

// The character stops this far short of a box, so that rounding cannot put it into the box:
// many units in the last place of a position.
constexpr float skin = 1.0F / 1024;
constexpr int most_hits = 4;  // in a frame: floor, two walls, and a rest

struct Character {
  sc::Vec3 at;  // its centre
  sc::Vec3 half;

  sc::Box box() const {
    return {{at[0] - half[0], at[1] - half[1], at[2] - half[2]},
            {at[0] + half[0], at[1] + half[1], at[2] + half[2]}};
  }
};

void slide(Character& character, sc::Vec3 travel, const sc::BoxTree& tree) {
  for (int hits = 0; hits != most_hits; ++hits) {
    // Open contact: it moves along boxes that it touches. A box that it is in already, such as
    // a lift that came up, does not hold it.
    sc::CompiledShaft way = sc::swept(character.box(), travel);
    sc::set_contact(way, sc::Contact::open);
    const auto contact = sc::first_contact(way, tree, {.skip_overlapping = true});

    float into = 0;  // how far the whole way would go against the normal
    for (std::size_t k = 0; k != 3; ++k) into -= travel[k] * contact.normal[k];
    const float time = contact ? std::max(0.0F, contact.time - skin / into) : 1;
    for (std::size_t k = 0; k != 3; ++k) {
      character.at[k] += time * travel[k];
      travel[k] = (1 - time) * (travel[k] + into * contact.normal[k]);
    }
    if (!contact) return;
  }
}

// Prints the cost of a frame for each of 64 characters among 10,000 boxes.
void time_frames() {
  std::uint32_t seed = 1;
  const auto random = [&] {
    seed = seed * 1664525 + 1013904223;
    return static_cast<float>(seed >> 8U) / 0x1p24F;
  };
  std::vector<sc::Box> boxes = {{{-999, -1, -999}, {999, 0, 999}}};
  while (boxes.size() != 10000) {
    const sc::Vec3 p{400 * random(), 0, 400 * random()};
    boxes.push_back({p, {p[0] + 2 * random(), 3 * random(), p[2] + 2 * random()}});
  }
  const sc::BoxTree tree(boxes);
  std::vector<Character> crowd;
  while (crowd.size() != 64) {
    crowd.push_back({{400 * random(), 5, 400 * random()}, {0.25F, 0.75F, 0.25F}});
  }
  constexpr int frames = 2000;
  const auto begin = std::chrono::steady_clock::now();
  for (int frame = 0; frame != frames; ++frame) {
    for (Character& character : crowd) {
      slide(character, {0.2F * random() - 0.1F, -0.1F, 0.2F * random() - 0.1F}, tree);
    }
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  int stuck = 0;
  for (const Character& character : crowd) {
    const sc::Box box = character.box();
    stuck += sc::any(sc::compile(box, box, sc::Contact::open), tree) ? 1 : 0;
  }
  std::printf("%.2f microseconds per character and frame, %d overlap a box\n",
              seconds.count() * 1e6 / frames / 64, stuck);
}

}  // namespace

int main(int argc, char** /*argv*/) {
  if (argc > 1) {  // as `sliding --time`
    time_frames();
    return 0;
  }
  const std::vector<sc::Box> scene = {{{-9, -1, -9}, {9, 0, 9}},     // 0: the floor
                                      {{3, 0, -9}, {4, 5, 9}},       // 1: a wall
                                      {{-9, 0, 4}, {4, 5, 5}},       // 2: another: a corner
                                      {{-1, 0, -1}, {1, 0.5F, 1}}};  // 3: a crate
  const sc::BoxTree tree(scene);
  Character character{{-3, 1, 0}, {0.5F, 0.75F, 0.5F}};
  for (int frame = 1; frame <= 60; ++frame) {
    slide(character, {0.2F, -0.1F, 0.1F}, tree);  // to the right, down, and forward
    if (frame % 10 == 0) {
      const sc::Vec3& p = character.at;
      std::printf("frame %d: %.3f %.3f %.3f\n", frame, p[0], p[1], p[2]);
    }
  }
}
