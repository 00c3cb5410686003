// SPDX-License-Identifier: MIT
/// Options that a query refuses, of every verb and every container: the message names the option, and nothing is
/// written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "message_of.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Whether a message names an option of a query: `exclude` is not named where `exclude_mask` is.
MATCHER_P(Names, option, std::string("names query.") + option) {
  const std::string named = std::string("query.") + option;
  for (std::size_t at = arg.find(named); at != std::string::npos; at = arg.find(named, at + 1)) {
    const char next = at + named.size() < arg.size() ? arg[at + named.size()] : ' ';
    if (next != '_' && (next < 'a' || next > 'z')) return true;
  }
  return false;
}

constexpr std::size_t bound_count = 100;
constexpr std::size_t shaft_count = 3;
constexpr std::size_t words = bit_words(bound_count);

/// Room for all that a verb writes.
struct Outputs {
  std::vector<std::uint64_t> kept = std::vector<std::uint64_t>(words * shaft_count, 7);
  std::vector<std::uint64_t> inside = kept;
  std::vector<std::uint64_t> numbers = std::vector<std::uint64_t>(shaft_count, 7);
  std::vector<KeptCounts> classified = std::vector<KeptCounts>(shaft_count, KeptCounts{7, 7});
  std::vector<std::uint32_t> list = std::vector<std::uint32_t>(bound_count, 7);
  std::vector<std::uint32_t> other_list = list;
  IndexLists lists{{0, 1}, {5}};
  IndexLists other_lists{{0, 1}, {6}};
  std::vector<FirstContact> contacts = std::vector<FirstContact>(shaft_count, FirstContact{7, 7});

  [[nodiscard]] bool are_untouched() const {
    const Outputs fresh;
    return kept == fresh.kept && inside == fresh.inside && numbers == fresh.numbers && classified == fresh.classified &&
           list == fresh.list && other_list == fresh.other_list && lists.offsets == fresh.lists.offsets &&
           lists.indices == fresh.lists.indices && other_lists.offsets == fresh.other_lists.offsets &&
           other_lists.indices == fresh.other_lists.indices && contacts == fresh.contacts;
  }
};

using Shafts = std::span<const CompiledShaft>;

/// A verb, asked with outputs of the right size. One of one shaft asks the first.
struct Verb {
  enum Kinds : std::uint8_t { all, boxes_and_spheres, boxes };

  std::string_view name;
  bool is_of_many;
  bool takes_limit;
  Kinds kinds;
  void (*ask)(Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query);

  /// Those of occluded.hpp do not.
  [[nodiscard]] bool takes_only() const { return kinds != boxes; }
  /// Those of first_contact.hpp alone do.
  [[nodiscard]] bool takes_skip() const { return kinds == boxes_and_spheres; }
};

constexpr Verb verbs[] = {
    {"cull", false, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       cull(shafts[0], bounds, std::span(out.kept).first(words), query);
     }},
    {"classify", false, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       classify(shafts[0], bounds, std::span(out.kept).first(words), std::span(out.inside).first(words), query);
     }},
    {"classify without kept", false, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       classify(shafts[0], bounds, {}, std::span(out.inside).first(words), query);
     }},
    {"count", false, true, Verb::all,
     [](Outputs& /*out*/, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(count(shafts[0], bounds, query));
     }},
    {"count_classified", false, false, Verb::all,
     [](Outputs& /*out*/, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(count_classified(shafts[0], bounds, query));
     }},
    {"list", false, true, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(list(shafts[0], bounds, std::span(out.list), query));
     }},
    {"list into a vector", false, true, Verb::all,
     [](Outputs& /*out*/, Shafts shafts, const Bounds& bounds, const Query& query) {
       std::vector<std::uint32_t> kept;  // which may have any values then
       static_cast<void>(list(shafts[0], bounds, kept, query));
     }},
    {"list_classified", false, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(list_classified(shafts[0], bounds, out.list, out.other_list, query));
     }},
    {"any", false, false, Verb::all,
     [](Outputs& /*out*/, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(any(shafts[0], bounds, query));
     }},
    {"cull_many", true, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       cull_many(shafts, bounds, std::span(out.kept).first(words * shafts.size()), query);
     }},
    {"classify_many", true, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       classify_many(shafts, bounds, std::span(out.kept).first(words * shafts.size()),
                     std::span(out.inside).first(words * shafts.size()), query);
     }},
    {"classify_many without kept", true, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       classify_many(shafts, bounds, {}, std::span(out.inside).first(words * shafts.size()), query);
     }},
    {"count_many", true, true, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       count_many(shafts, bounds, std::span(out.numbers).first(shafts.size()), query);
     }},
    {"count_classified_many", true, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       count_classified_many(shafts, bounds, std::span(out.classified).first(shafts.size()), query);
     }},
    {"list_many", true, true, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       list_many(shafts, bounds, out.lists, query);
     }},
    {"list_classified_many", true, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       list_classified_many(shafts, bounds, out.lists, out.other_lists, query);
     }},
    {"any_many", true, false, Verb::all,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       any_many(shafts, bounds, std::span(out.numbers).first(1), query);
     }},
    {"first_contact", false, false, Verb::boxes_and_spheres,
     [](Outputs& /*out*/, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(first_contact(shafts[0], bounds, query));
     }},
    {"first_contact_many", true, false, Verb::boxes_and_spheres,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       first_contact_many(shafts, bounds, std::span(out.contacts).first(shafts.size()), query);
     }},
    {"occluded", false, false, Verb::boxes,
     [](Outputs& /*out*/, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(occluded(shafts[0], bounds, query));
     }},
    {"find_occluder", false, false, Verb::boxes,
     [](Outputs& /*out*/, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(find_occluder(shafts[0], bounds, query));
     }},
    {"list_occluders", false, true, Verb::boxes,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       static_cast<void>(list_occluders(shafts[0], bounds, out.list, query));
     }},
    {"occluded_many", true, false, Verb::boxes,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       occluded_many(shafts, bounds, std::span(out.numbers).first(1), query);
     }},
    {"list_occluders_many", true, true, Verb::boxes,
     [](Outputs& out, Shafts shafts, const Bounds& bounds, const Query& query) {
       list_occluders_many(shafts, bounds, out.lists, query);
     }},
};

/// A container of bounds that all are in all shafts.
struct Container {
  const char* name;
  Verb::Kinds kind;  ///< that of the bounds: boxes, or spheres (boxes_and_spheres), or triangles (all)
  bool has_layers;
  Bounds bounds;

  [[nodiscard]] bool is_taken_by(const Verb& verb) const { return verb.kinds <= kind; }
};

class OptionErrors : public testing::Test {
 protected:
  OptionErrors() {
    layered_box_tree_.set_layers(layers_);
    layered_sphere_tree_.set_layers(layers_);
  }

  /// Calls `use` with each verb and each container that it takes.
  template <class Use>
  void for_each(const Use& use) const {
    for (const Verb& verb : verbs) {
      for (const Container& container : containers_) {
        if (!container.is_taken_by(verb)) continue;
        SCOPED_TRACE(std::string(verb.name) + " of " + container.name);
        use(verb, container);
      }
    }
  }

  void expect_refused(const Verb& verb, const Container& container, const Query& query, const char* option) const {
    Outputs out;
    EXPECT_THAT(message_of([&] { verb.ask(out, shafts_, container.bounds, query); }), Names(option));
    EXPECT_TRUE(out.are_untouched()) << "something was written";
  }
  void expect_taken(const Verb& verb, const Container& container, const Query& query) const {
    Outputs out;
    EXPECT_NO_THROW(verb.ask(out, shafts_, container.bounds, query));
  }

  /// That many indices of memory that there is none of.
  static std::span<const std::uint32_t> null_numbers(std::size_t count) {
    return {static_cast<const std::uint32_t*>(nullptr), count};
  }

  const std::vector<CompiledShaft> shafts_ =
      std::vector<CompiledShaft>(shaft_count, compile({{-9, -9, -9}, {9, 9, -8}}, {{-9, -9, 8}, {9, 9, 9}}));
  const std::vector<Box> boxes_ = std::vector<Box>(bound_count, Box{{0, 0, 0}, {1, 1, 1}});
  const std::vector<Sphere> spheres_ = std::vector<Sphere>(bound_count, Sphere{{0, 0, 0}, 1});
  const std::vector<Triangle> triangles_ =
      std::vector<Triangle>(bound_count, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  const std::vector<std::uint32_t> layers_ = std::vector<std::uint32_t>(bound_count, 1);

  const BoxColumns box_view_{boxes_};
  const SphereColumns sphere_view_{spheres_};
  const TriangleColumns triangle_view_{triangles_};
  const BoxStream box_stream_{std::span<const Box>(boxes_)};
  const SphereStream sphere_stream_{std::span<const Sphere>(spheres_)};
  const TriangleStream triangle_stream_{std::span<const Triangle>(triangles_)};
  BoxTree box_tree_{std::span<const Box>(boxes_)};
  SphereTree sphere_tree_{std::span<const Sphere>(spheres_)};
  const TriangleTree triangle_tree_{std::span<const Triangle>(triangles_)};
  BoxTree layered_box_tree_{std::span<const Box>(boxes_)};
  SphereTree layered_sphere_tree_{std::span<const Sphere>(spheres_)};

  const std::vector<Container> containers_ = {
      {"a view of boxes", Verb::boxes, false, Bounds(box_view_.view())},
      {"a view of spheres", Verb::boxes_and_spheres, false, Bounds(sphere_view_.view())},
      {"a view of triangles", Verb::all, false, Bounds(triangle_view_.view())},
      {"a stream of boxes", Verb::boxes, false, Bounds(box_stream_)},
      {"a stream of spheres", Verb::boxes_and_spheres, false, Bounds(sphere_stream_)},
      {"a stream of triangles", Verb::all, false, Bounds(triangle_stream_)},
      {"a tree of boxes", Verb::boxes, false, Bounds(box_tree_)},
      {"a tree of spheres", Verb::boxes_and_spheres, false, Bounds(sphere_tree_)},
      {"a tree of triangles", Verb::all, false, Bounds(triangle_tree_)},
      {"a view of boxes in layers", Verb::boxes, true, Bounds(box_view_.view(), layers_)},
      {"a view of spheres in layers", Verb::boxes_and_spheres, true, Bounds(sphere_view_.view(), layers_)},
      {"a view of triangles in layers", Verb::all, true, Bounds(triangle_view_.view(), layers_)},
      {"a stream of boxes in layers", Verb::boxes, true, Bounds(box_stream_, layers_)},
      {"a stream of spheres in layers", Verb::boxes_and_spheres, true, Bounds(sphere_stream_, layers_)},
      {"a stream of triangles in layers", Verb::all, true, Bounds(triangle_stream_, layers_)},
      {"a tree of boxes in layers", Verb::boxes, true, Bounds(layered_box_tree_)},
      {"a tree of spheres in layers", Verb::boxes_and_spheres, true, Bounds(layered_sphere_tree_)},
  };
};

TEST_F(OptionErrors, EveryVerbTakesTheOptionsThatMeanSomethingToIt) {
  const std::vector<std::uint32_t> numbers = {1, 2, 3};
  const std::vector<std::uint64_t> mask(words, 0xf0);
  for_each([&](const Verb& verb, const Container& container) {
    expect_taken(verb, container, {});
    Query query{.exclude = {1, 99}, .exclude_each = numbers, .exclude_mask = mask};
    if (verb.takes_limit) query.limit = 5;
    if (verb.takes_only()) query.only = numbers;
    if (container.has_layers) query.layer_mask = 1U;
    expect_taken(verb, container, query);
    query.limit = Query::no_limit;  // as if it were not given
    expect_taken(verb, container, query);
  });
}

TEST_F(OptionErrors, ALimitIsRefusedWhereItMeansNothing) {
  for_each([&](const Verb& verb, const Container& container) {
    for (const std::size_t limit : {std::size_t{0}, std::size_t{3}, std::size_t{1000}}) {
      if (!verb.takes_limit) expect_refused(verb, container, {.limit = limit}, "limit");
    }
  });
}

TEST_F(OptionErrors, SkippingWhatOverlapsTheStartIsRefusedWhereNothingStarts) {
  for_each([&](const Verb& verb, const Container& container) {
    const Query query{.skip_overlapping = true};
    if (verb.takes_skip()) {
      expect_taken(verb, container, query);
    } else {
      expect_refused(verb, container, query, "skip_overlapping");
    }
  });
}

TEST_F(OptionErrors, CandidatesAreRefusedByCallsOfBlocking) {
  const std::vector<std::uint32_t> some = {1, 2};
  for_each([&](const Verb& verb, const Container& container) {
    if (verb.takes_only()) return;
    expect_refused(verb, container, {.only = some}, "only");
    expect_refused(verb, container, {.only = std::span<const std::uint32_t>()}, "only");
  });
}

TEST_F(OptionErrors, ATestOfTrianglesIsRefusedForOtherBoundsAndIfThereIsNoSuchTest) {
  for_each([&](const Verb& verb, const Container& container) {
    expect_refused(verb, container, {.triangle_test = static_cast<TriangleTest>(2)}, "triangle_test");
    const Query query{.triangle_test = TriangleTest::vertices};
    if (container.kind == Verb::all) {
      expect_taken(verb, container, query);
    } else {
      expect_refused(verb, container, query, "triangle_test");
    }
  });
}

TEST_F(OptionErrors, LayersAreRefusedIfTheBoundsHaveNone) {
  for_each([&](const Verb& verb, const Container& container) {
    if (!container.has_layers) expect_refused(verb, container, {.layer_mask = {1}}, "layer_mask");
  });
}

TEST_F(OptionErrors, LayersAreOneMaskOrOneForEachShaft) {
  const std::vector<std::uint32_t> masks(shaft_count + 1, 1);
  const std::span<const std::uint32_t> all(masks);
  for_each([&](const Verb& verb, const Container& container) {
    if (!container.has_layers) return;
    expect_taken(verb, container, {.layer_mask = all.first(1)});
    expect_refused(verb, container, {.layer_mask = {1, 1}}, "layer_mask");
    expect_refused(verb, container, {.layer_mask = all}, "layer_mask");
    if (verb.is_of_many) {
      expect_taken(verb, container, {.layer_mask = all.first(shaft_count)});
    } else {
      expect_refused(verb, container, {.layer_mask = all.first(shaft_count)}, "layer_mask");
    }
  });
}

TEST_F(OptionErrors, BoundsHaveAsManyLayersAsThereAreBounds) {
  const std::vector<std::uint32_t> layers(bound_count + 1, 1);
  for (const std::size_t wrong : {std::size_t{1}, bound_count - 1, bound_count + 1}) {
    const auto some = std::span<const std::uint32_t>(layers).first(wrong);
    const std::vector<Container> containers = {
        {"a view of boxes", Verb::boxes, true, Bounds(box_view_.view(), some)},
        {"a view of spheres", Verb::boxes_and_spheres, true, Bounds(sphere_view_.view(), some)},
        {"a view of triangles", Verb::all, true, Bounds(triangle_view_.view(), some)},
        {"a stream of boxes", Verb::boxes, true, Bounds(box_stream_, some)},
    };
    for (const Container& container : containers) {
      for (const Verb& verb : verbs) {
        if (!container.is_taken_by(verb)) continue;
        SCOPED_TRACE(std::string(verb.name) + " of " + container.name + " with " + std::to_string(wrong) + " layers");
        Outputs out;
        EXPECT_THAT(message_of([&] { verb.ask(out, shafts_, container.bounds, {.layer_mask = {1}}); }),
                    HasSubstr("layers"));
        EXPECT_TRUE(out.are_untouched());
      }
    }
  }
}

TEST_F(OptionErrors, IndicesAreBelowTheNumberOfBounds) {
  const std::vector<std::uint32_t> out_of_range[] = {
      {1, 2, bound_count}, {1, std::numeric_limits<std::uint32_t>::max(), 2}, {bound_count + 28, 2, 1}};
  for_each([&](const Verb& verb, const Container& container) {
    for (const std::vector<std::uint32_t>& indices : out_of_range) {
      expect_refused(verb, container, {.exclude = indices}, "exclude");
      expect_refused(verb, container, {.exclude = {indices[0], indices[1], indices[2]}}, "exclude");
      expect_refused(verb, container, {.exclude_each = indices}, "exclude_each");
      if (verb.takes_only()) expect_refused(verb, container, {.only = indices}, "only");
    }
    Outputs out;
    const std::string message =
        message_of([&] { verb.ask(out, shafts_, container.bounds, {.exclude = out_of_range[0]}); });
    EXPECT_THAT(message, AllOf(HasSubstr("[2]"), HasSubstr("100"))) << "the index and its place";
  });
}

TEST_F(OptionErrors, RowsAreEquallyLong) {
  const std::vector<std::uint32_t> numbers(2 * shaft_count, 1);
  const std::span<const std::uint32_t> all(numbers);
  for_each([&](const Verb& verb, const Container& container) {
    for (std::size_t size = 1; size <= all.size(); ++size) {
      if (!verb.is_of_many || size % shaft_count == 0) {
        expect_taken(verb, container, {.exclude_each = all.first(size)});
      } else {
        expect_refused(verb, container, {.exclude_each = all.first(size)}, "exclude_each");
      }
    }
  });
}

TEST_F(OptionErrors, AMaskHasABitForEveryBound) {
  const std::vector<std::uint64_t> bits(shaft_count * words, 0);
  for_each([&](const Verb& verb, const Container& container) {
    for (std::size_t size = 1; size <= bits.size(); ++size) {
      if (size == words) continue;
      expect_refused(verb, container, {.exclude_mask = std::span(bits).first(size)}, "exclude_mask");
    }
  });
}

TEST_F(OptionErrors, SpansThatAreNullMustBeEmpty) {
  const std::span<const std::uint64_t> null_words(static_cast<const std::uint64_t*>(nullptr), words);
  for_each([&](const Verb& verb, const Container& container) {
    expect_refused(verb, container, {.exclude = null_numbers(2)}, "exclude");
    expect_refused(verb, container, {.exclude_each = null_numbers(shaft_count)}, "exclude_each");
    expect_refused(verb, container, {.exclude_mask = null_words}, "exclude_mask");
    if (container.has_layers) expect_refused(verb, container, {.layer_mask = null_numbers(1)}, "layer_mask");
    if (verb.takes_only()) expect_refused(verb, container, {.only = null_numbers(3)}, "only");
    Query none{.exclude = null_numbers(0), .exclude_each = null_numbers(0), .layer_mask = null_numbers(0)};
    if (verb.takes_only()) none.only = null_numbers(0);
    expect_taken(verb, container, none);
  });
}

TEST_F(OptionErrors, LayersThatAreNullMustBeNone) {
  const Bounds bounds(box_view_.view(), null_numbers(bound_count));
  for (const Verb& verb : verbs) {
    SCOPED_TRACE(verb.name);
    Outputs out;
    EXPECT_THAT(message_of([&] { verb.ask(out, shafts_, bounds, {.layer_mask = {1}}); }), HasSubstr("layers"));
    EXPECT_TRUE(out.are_untouched());
  }
}

TEST_F(OptionErrors, OptionsAreCheckedWhereNoBoundIsLookedAt) {
  const std::vector<std::uint32_t> wrong = {bound_count};
  const std::vector<std::uint64_t> all_out(words, ~std::uint64_t{0});
  for_each([&](const Verb& verb, const Container& container) {
    expect_refused(verb, container, {.exclude = wrong, .exclude_mask = all_out}, "exclude");
    if (verb.takes_only()) {
      expect_refused(verb, container, {.exclude = wrong, .only = std::span<const std::uint32_t>()}, "exclude");
    }
    if (verb.takes_limit) expect_refused(verb, container, {.exclude = wrong, .limit = 0}, "exclude");
  });
  for (const Bounds& bounds : {Bounds(BoxView()), Bounds(SphereView()), Bounds(TriangleView())}) {
    EXPECT_THAT(message_of([&] { static_cast<void>(count(shafts_[0], bounds, {.exclude = 0U})); }), Names("exclude"));
    EXPECT_THAT(message_of([&] { static_cast<void>(any(shafts_[0], bounds, {.limit = 1})); }), Names("limit"));
  }
}

TEST_F(OptionErrors, BoundsOfOtherKindsAreRefused) {
  for (const Verb& verb : verbs) {
    for (const Container& container : containers_) {
      if (container.is_taken_by(verb)) continue;
      SCOPED_TRACE(std::string(verb.name) + " of " + container.name);
      Outputs out;
      EXPECT_NE(message_of([&] { verb.ask(out, shafts_, container.bounds, {}); }), "");
      EXPECT_TRUE(out.are_untouched());
    }
  }
  float time = 7;
  const std::uint32_t index = 0;
  EXPECT_NE(message_of([&] { entry_times(shafts_[0], triangle_tree_, {&index, 1}, {&time, 1}); }), "");
  EXPECT_EQ(time, 7.0F);
}

TEST_F(OptionErrors, TreesThatNeedARefitAreNotAsked) {
  const std::vector<std::uint32_t> index = {3};
  box_tree_.update(index, std::span<const Box>(boxes_).first(1));
  sphere_tree_.update(index, std::span<const Sphere>(spheres_).first(1));
  for (const Verb& verb : verbs) {
    SCOPED_TRACE(verb.name);
    Query query{.exclude = {1}};
    if (verb.takes_only()) query.only = index;
    if (verb.takes_limit) query.limit = 1;
    Outputs out;
    EXPECT_NE(message_of<NeedsRefit>([&] { verb.ask(out, shafts_, box_tree_, query); }), "");
    if (verb.kinds != Verb::boxes) {
      EXPECT_NE(message_of<NeedsRefit>([&] { verb.ask(out, shafts_, sphere_tree_, query); }), "");
    }
    EXPECT_TRUE(out.are_untouched());
  }
}

/// Outputs that are options of the same query.
class SharedOptions : public OptionErrors {
 protected:
  const CompiledShaft& shaft() const { return shafts_[0]; }

  template <class Call>
  static void expect_shared(const Call& call, const char* option) {
    EXPECT_THAT(message_of(call), AllOf(Names(option), HasSubstr("share memory")));
  }
};

TEST_F(SharedOptions, BitsAndNumbersAreNotTheMask) {
  const std::vector<std::uint64_t> untouched(2 * shaft_count * words, 0xf0);
  for (const Container& container : containers_) {
    SCOPED_TRACE(container.name);
    const Bounds& bounds = container.bounds;
    std::vector<std::uint64_t> memory = untouched;
    const std::span<std::uint64_t> all(memory);
    const Query query{.exclude_mask = all.subspan(1, words)};
    const auto row = all.first(words);  // half of which is the mask's
    const auto apart = all.subspan(1 + words, words);
    const auto rows = all.first(shaft_count * words);
    expect_shared([&] { cull(shaft(), bounds, row, query); }, "exclude_mask");
    expect_shared([&] { cull(shaft(), bounds, all.subspan(1, words), query); }, "exclude_mask");
    expect_shared([&] { classify(shaft(), bounds, row, apart, query); }, "exclude_mask");
    expect_shared([&] { classify(shaft(), bounds, apart, row, query); }, "exclude_mask");
    expect_shared([&] { classify(shaft(), bounds, {}, row, query); }, "exclude_mask");
    expect_shared([&] { cull_many(shafts_, bounds, rows, query); }, "exclude_mask");
    expect_shared([&] { classify_many(shafts_, bounds, rows, all.last(shaft_count * words), query); }, "exclude_mask");
    expect_shared([&] { classify_many(shafts_, bounds, {}, rows, query); }, "exclude_mask");
    expect_shared([&] { count_many(shafts_, bounds, all.first(shaft_count), query); }, "exclude_mask");
    expect_shared([&] { any_many(shafts_, bounds, all.subspan(2, 1), query); }, "exclude_mask");
    if (container.kind == Verb::boxes) {
      expect_shared([&] { occluded_many(shafts_, bounds, all.subspan(2, 1), query); }, "exclude_mask");
    }
    EXPECT_THAT(message_of([&] { classify(shaft(), bounds, row, all.subspan(1, words)); }), HasSubstr("share memory"));
    EXPECT_EQ(memory, untouched);
    cull(shaft(), bounds, apart, query);  // memory that only touches is apart
    EXPECT_NE(memory, untouched);
  }
}

TEST_F(SharedOptions, ListsAreNotIndicesThatAreLeftOut) {
  const std::vector<std::uint32_t> untouched(3 * bound_count, 1);
  for (const Container& container : containers_) {
    SCOPED_TRACE(container.name);
    const Bounds& bounds = container.bounds;
    std::vector<std::uint32_t> memory = untouched;
    const std::span<std::uint32_t> all(memory);
    const auto kept = all.first(bound_count);
    const auto apart = all.last(bound_count);
    const auto last = all.subspan(bound_count - 1, 2);  // one of which is of kept
    const auto ask_all = [&](const Query& query, const char* option) {
      expect_shared([&] { static_cast<void>(list(shaft(), bounds, kept, query)); }, option);
      if (query.limit != Query::no_limit) return;
      expect_shared([&] { static_cast<void>(list_classified(shaft(), bounds, kept, apart, query)); }, option);
      expect_shared([&] { static_cast<void>(list_classified(shaft(), bounds, apart, kept, query)); }, option);
      if (container.kind == Verb::boxes && !query.only) {
        expect_shared([&] { static_cast<void>(list_occluders(shaft(), bounds, kept, query)); }, option);
      }
    };
    ask_all({.exclude = last}, "exclude");
    ask_all({.exclude = last, .limit = 1}, "exclude");
    ask_all({.exclude_each = last}, "exclude_each");
    ask_all({.only = last}, "only");
    if (container.has_layers) ask_all({.layer_mask = last.first(1)}, "layer_mask");
    expect_shared([&] { static_cast<void>(list_classified(shaft(), bounds, kept, apart, {.only = kept})); }, "only");
    EXPECT_THAT(message_of([&] { static_cast<void>(list_classified(shaft(), bounds, kept, all.subspan(99, 5))); }),
                HasSubstr("share memory"));
    EXPECT_EQ(memory, untouched);
    EXPECT_EQ(list(shaft(), bounds, kept, {.exclude = all.subspan(bound_count, 2)}), bound_count - 1);
  }
}

TEST_F(SharedOptions, ListsMayOverwriteTheirCandidatesFromTheirBeginningOnly) {
  constexpr std::size_t size = 50;
  std::vector<std::uint32_t> untouched;
  for (std::uint32_t i = 0; i != 3 * size; ++i) untouched.push_back(i * 7 % bound_count);
  for (const Container& container : containers_) {
    SCOPED_TRACE(container.name);
    std::vector<std::uint32_t> memory = untouched;
    const std::span<std::uint32_t> all(memory);
    const Query query{.only = all.subspan(size, size)};
    for (const std::size_t start : {std::size_t{1}, size - 1, size + 1, 2 * size - 1}) {
      expect_shared([&] { static_cast<void>(list(shaft(), container.bounds, all.subspan(start, size), query)); },
                    "only");
    }
    EXPECT_EQ(memory, untouched);
    EXPECT_EQ(list(shaft(), container.bounds, all.first(size), query), size);
    EXPECT_TRUE(std::equal(memory.begin(), memory.begin() + size, untouched.begin() + size)) << "apart";
    EXPECT_EQ(list(shaft(), container.bounds, all.subspan(size, size), query), size);
    EXPECT_TRUE(std::equal(memory.begin() + size, memory.end(), untouched.begin() + size)) << "in place";
  }
}

TEST_F(SharedOptions, IndexListsAreNotOptions) {
  const std::span<const CompiledShaft> one(&shaft(), 1);
  for (const Container& container : containers_) {
    SCOPED_TRACE(container.name);
    const Bounds& bounds = container.bounds;
    IndexLists lists{{0, 2}, {11, 12}};
    IndexLists others{{0, 2}, {13, 14}};
    const auto ask_all = [&](const Query& of_lists, const Query& of_others, const char* option) {
      expect_shared([&] { list_many(one, bounds, lists, of_lists); }, option);
      expect_shared([&] { list_classified_many(one, bounds, lists, others, of_lists); }, option);
      expect_shared([&] { list_classified_many(one, bounds, lists, others, of_others); }, option);
      if (container.kind == Verb::boxes && !of_lists.only) {
        expect_shared([&] { list_occluders_many(one, bounds, lists, of_lists); }, option);
      }
    };
    ask_all({.exclude = lists.indices}, {.exclude = others.indices}, "exclude");
    ask_all({.exclude_each = lists.indices}, {.exclude_each = others.indices}, "exclude_each");
    ask_all({.only = lists.indices}, {.only = others.indices}, "only");
    ask_all({.exclude_mask = lists.offsets}, {.exclude_mask = others.offsets}, "exclude_mask");
    if (container.has_layers) {
      ask_all({.layer_mask = std::span<const std::uint32_t>(lists.indices).last(1)},
              {.layer_mask = std::span<const std::uint32_t>(others.indices).last(1)}, "layer_mask");
    }
    EXPECT_THAT(message_of([&] { list_classified_many(one, bounds, lists, lists); }), HasSubstr("share memory"));
    EXPECT_EQ(lists.offsets, (std::vector<std::uint64_t>{0, 2}));
    EXPECT_EQ(lists.indices, (std::vector<std::uint32_t>{11, 12}));
    EXPECT_EQ(others.offsets, (std::vector<std::uint64_t>{0, 2}));
    EXPECT_EQ(others.indices, (std::vector<std::uint32_t>{13, 14}));
  }
}

TEST_F(SharedOptions, RecordsAreNotOptions) {
  for (const Container& container : containers_) {
    SCOPED_TRACE(container.name);
    std::vector<KeptCounts> counts(shaft_count, KeptCounts{1, 1});
    // Neither is looked at: the call is refused.
    const std::span<const std::uint64_t> mask(reinterpret_cast<const std::uint64_t*>(counts.data()), words);
    expect_shared([&] { count_classified_many(shafts_, container.bounds, counts, {.exclude_mask = mask}); },
                  "exclude_mask");
    EXPECT_EQ(counts, std::vector<KeptCounts>(shaft_count, KeptCounts{1, 1}));
    if (container.kind == Verb::all) continue;
    std::vector<FirstContact> contacts(shaft_count, FirstContact{7, 7});
    const Query query{.exclude = std::span<const std::uint32_t>(&contacts[1].index, 1)};
    expect_shared([&] { first_contact_many(shafts_, container.bounds, contacts, query); }, "exclude");
    EXPECT_EQ(contacts, std::vector<FirstContact>(shaft_count, FirstContact{7, 7}));
  }
}

}  // namespace
}  // namespace shaftcull
