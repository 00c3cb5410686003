// SPDX-License-Identifier: MIT
/// Bad input to owning streams: the error names the first bad record and what is wrong; the stream stays as it was.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "caught.hpp"
#include "message_of.hpp"
#include "shaftcull/streams.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Records in which all but one are legal, packed into a stream of 300 bounds.
template <class Stream, class Bound>
class Packing {
 public:
  explicit Packing(const Bound& legal) : legal_(legal), stream_(std::vector<Bound>(300, legal)) {}

  /// Expects that `bad` at each of some positions, with another behind it, is refused with messages that have `what`.
  template <class Matcher>
  void expect_refused(const Bound& bad, const std::string& noun, const Matcher& what) {
    for (const std::size_t index : {0U, 17U, 255U, 256U, 298U}) {
      std::vector<Bound> bounds(300, other_);
      bounds[index] = bad;
      bounds[299] = bad;
      const auto expect = [&](const auto& call) {
        const auto error = caught<BadBound>(call);
        ASSERT_TRUE(error) << "accepted at " << index;
        EXPECT_EQ(error->index(), index);
        EXPECT_THAT(error->what(), AllOf(HasSubstr(noun + " " + std::to_string(index) + ": "), what));
      };
      expect([&] { stream_.update(0, bounds); });
      expect([&] { Stream{bounds}; });
      for (std::size_t i = 0; i != stream_.size(); ++i) ASSERT_EQ(stream_[i], legal_) << "changed at " << i;
    }
  }

  void set_other(const Bound& other) { other_ = other; }

 private:
  Bound legal_;
  Bound other_ = legal_;
  Stream stream_;
};

class BoxErrors : public testing::Test {
 protected:
  BoxErrors() { packing.set_other({{5, 5, 5}, {6, 6, 6}}); }
  Packing<BoxStream, Box> packing{Box{{0, 0, 0}, {1, 1, 1}}};
};

TEST_F(BoxErrors, NameTheAxisOfANan) {
  packing.expect_refused({{0, 0, NAN}, {1, 1, 1}}, "box", HasSubstr("lo.z is not a number"));
  packing.expect_refused({{0, 0, 0}, {NAN, 1, 1}}, "box", HasSubstr("hi.x is not a number"));
}

TEST_F(BoxErrors, NameTheValuesOfLoAboveHi) {
  packing.expect_refused({{0, 3, 0}, {1, 2, 1}}, "box", HasSubstr("lo.y = 3 is above hi.y = 2"));
}

TEST_F(BoxErrors, AreThrownForBoxesEmptyOnSomeAxesOnly) {
  packing.expect_refused({{infinity, infinity, 0}, {-infinity, -infinity, 1}}, "box",
                         HasSubstr("lo.x = inf is above hi.x = -inf"));
}

TEST_F(BoxErrors, AreThrownBehindEmptyBoxesToo) {
  packing.set_other({{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}});
  packing.expect_refused({{0, 0, 1}, {1, 1, 0.5F}}, "box", HasSubstr("lo.z = 1 is above hi.z = 0.5"));
}

class SphereErrors : public testing::Test {
 protected:
  SphereErrors() { packing.set_other({{5, 5, 5}, 6}); }
  Packing<SphereStream, Sphere> packing{Sphere{{0, 0, 0}, 1}};
};

TEST_F(SphereErrors, NameWhatIsNotANumber) {
  packing.expect_refused({{0, NAN, 0}, 1}, "sphere", HasSubstr("centre.y is not a number"));
  packing.expect_refused({{0, 0, 0}, NAN}, "sphere", HasSubstr("radius is not a number"));
}

TEST_F(SphereErrors, NameANegativeRadius) {
  packing.expect_refused({{0, 0, 0}, -1}, "sphere", HasSubstr("radius = -1 is negative"));
}

TEST_F(SphereErrors, NameAnInfiniteCentre) {
  packing.expect_refused({{0, 0, -infinity}, 1}, "sphere", HasSubstr("centre.z = -inf is not finite"));
}

using Record = std::array<float, 6>;

/// The message that packing `record` behind two legal ones into a stream gets, which must stay as it was.
std::string centre_extent_fault(const Record& record) {
  const Record legal = {0, 0, 0, 1, 1, 1};
  const std::array<Record, 3> records = {legal, legal, record};
  BoxStream stream(3);
  const Box before = stream[0];
  const StridedCentreExtents given{records[0].data(), records[0].data() + 3, sizeof(Record), 3};
  if (const auto error = caught<BadBound>([&] { stream.update(0, given); })) {
    EXPECT_EQ(error->index(), 2U);
    EXPECT_EQ(stream[0], before);
    EXPECT_EQ(message_of([&] { const BoxStream packed(given); }), error->what());
    return error->what();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(CentreExtentErrors, SayWhatIsWrongWithTheRecord) {
  EXPECT_THAT(centre_extent_fault({NAN, 0, 0, 1, 1, 1}), HasSubstr("box 2: centre.x is not a number"));
  EXPECT_THAT(centre_extent_fault({0, 0, 0, 1, NAN, 1}), HasSubstr("box 2: half_extent.y is not a number"));
  EXPECT_THAT(centre_extent_fault({0, 0, 0, 1, 1, -2.5F}), HasSubstr("box 2: half_extent.z = -2.5 is negative"));
  EXPECT_THAT(centre_extent_fault({0, 0, 0, 1, -infinity, 1}), HasSubstr("box 2: half_extent.y = -inf is negative"));
  EXPECT_THAT(centre_extent_fault({0, infinity, 0, 1, infinity, 1}),
              HasSubstr("box 2: centre.y = inf and half_extent.y = inf"));
}

TEST(UpdateErrors, NameTheRangeAndTheSize) {
  BoxStream boxes(100);
  const std::vector<Box> news(20, Box{{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(message_of([&] { boxes.update(90, news); }),
            "update of 20 boxes from position 90 on does not fit a stream of 100");
  EXPECT_EQ(message_of([&] { boxes.update(101, std::vector<Box>()); }),
            "update of 0 boxes from position 101 on does not fit a stream of 100");
  EXPECT_THROW(boxes.update(SIZE_MAX, news), InvalidArgument);
  SphereStream spheres(10);
  EXPECT_EQ(message_of([&] {
              spheres.update(10, std::vector<Sphere>(1, Sphere{{0, 0, 0}, 1}));
            }),
            "update of 1 sphere from position 10 on does not fit a stream of 10");
}

TEST(UpdateErrors, NameANullPointer) {
  BoxStream boxes(4);
  const float one = 1;
  EXPECT_THAT(message_of([&] {
                boxes.update(0, StridedBoxes{&one, nullptr, 24, 1});
              }),
              HasSubstr("StridedBoxes::hi is null"));
  EXPECT_NO_THROW(boxes.update(0, StridedBoxes{}));
  EXPECT_NO_THROW(boxes.update(4, StridedCentreExtents{}));
  EXPECT_NO_THROW(SphereStream().update(0, StridedSpheres{}));
}

TEST(UpdateErrors, ABadBoundOfAViewIsNamed) {
  const float zero[3] = {0, 0, 0};
  const float one[3] = {1, 1, -1};
  const BoxView boxes{{zero, zero, zero, one, one, one}, 3};
  EXPECT_THAT(message_of([&] { BoxStream{boxes}; }), HasSubstr("box 2: lo.x = 0 is above hi.x = -1"));
  const SphereView spheres{{zero, zero, zero, one}, 3};
  EXPECT_THAT(message_of([&] { SphereStream{spheres}; }), HasSubstr("sphere 2: radius = -1 is negative"));
  const BoxView null{{zero, zero, nullptr, one, one, one}, 2};
  EXPECT_THAT(message_of([&] { BoxStream{null}; }), HasSubstr("boxes.stream[2] is null"));
  BoxStream stream(2);
  EXPECT_THAT(message_of([&] { stream.update(1, boxes.slice(0, 2)); }), HasSubstr("update of 2 boxes from position 1"));
}

TEST(UpdateErrors, AStreamsOwnMemoryIsNoUpdateOfIt) {
  BoxStream boxes(std::vector<Box>(100, Box{{0, 0, 0}, {1, 1, 1}}));
  SphereStream spheres(std::vector<Sphere>(100, Sphere{{0, 0, 0}, 1}));
  const float* const box_row = boxes.view().stream[5];
  const float* const sphere_row = spheres.view().stream[0];
  const float others[6] = {};
  const auto refusal = HasSubstr("update: what is packed and the stream share memory");
  EXPECT_THAT(message_of([&] { boxes.update(0, StridedBoxes{others, box_row, 24, 1}); }), refusal);
  EXPECT_THAT(message_of([&] { boxes.update(0, StridedCentreExtents{box_row, others, 24, 1}); }), refusal);
  EXPECT_THAT(message_of([&] { spheres.update(0, StridedSpheres{others, sphere_row + 99, 24, 1}); }), refusal);
  EXPECT_THAT(message_of([&] { boxes.update(10, boxes.view().slice(0, 1)); }), refusal);
  EXPECT_NO_THROW(spheres.update(0, StridedSpheres{boxes.view().stream[0], box_row, 24, 1}));
  for (std::size_t i = 0; i != 100; ++i) EXPECT_EQ(boxes[i], (Box{{0, 0, 0}, {1, 1, 1}}));
}

}  // namespace
}  // namespace shaftcull
