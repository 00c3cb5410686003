// SPDX-License-Identifier: MIT
/// Jobs from inputs to the file: answers are those of the library's flat scans, whatever the ranks and the memory.
#include "batch/job.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <numeric>

#include "batch/hdf5_handle.hpp"
#include "batch/job_fixture.hpp"
#include "batch/npy.hpp"
#include "batch/thread_ranks.hpp"
#include "message_of.hpp"
#include "shaftcull/shaftcull.hpp"
#include "shaftcull/version.hpp"

namespace shaftcull::test {
namespace {

using batch::Answer;
using batch::BoundKind;
using batch::Job;
using batch::ShaftKind;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Box box_at(const std::vector<float>& floats, std::size_t at) {
  return {{floats[at], floats[at + 1], floats[at + 2]}, {floats[at + 3], floats[at + 4], floats[at + 5]}};
}

std::vector<CompiledShaft> form_shafts(ShaftKind kind, Contact contact, const std::vector<float>& floats) {
  const std::size_t columns = floats.size() / shafts;
  std::vector<CompiledShaft> formed;
  for (std::size_t at = 0; at != floats.size(); at += columns) {
    const Box box = box_at(floats, at);
    const Vec3 vector{floats[at + 6], floats[at + 7], floats[at + 8]};
    switch (kind) {
      case ShaftKind::between:
        formed.push_back(compile(box, box_at(floats, at + 6)));
        break;
      case ShaftKind::shadow:
        formed.push_back(shadow(box, box_at(floats, at + 6)));
        break;
      case ShaftKind::swept:
        formed.push_back(swept(box, vector));
        break;
      case ShaftKind::sun:
        formed.push_back(swept_infinite(box, vector));
        break;
    }
  }
  set_contact(std::span(formed), contact);
  return formed;
}

template <class T>
std::vector<T> dataset(const std::string& path, const std::string& name, hid_t type) {
  const batch::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const batch::Hdf5Handle data(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  const batch::Hdf5Handle space(H5Dget_space(data), H5Sclose);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  return values;
}
std::vector<std::uint64_t> numbers_in(const std::string& path, const std::string& name) {
  return dataset<std::uint64_t>(path, name, H5T_NATIVE_UINT64);
}

/// Expects the datasets of lists in a group to be these.
void expect_lists(const std::string& path, const std::string& group, const IndexLists& lists) {
  EXPECT_EQ(numbers_in(path, group + "offsets"), lists.offsets);
  EXPECT_EQ(numbers_in(path, group + "indices"),
            std::vector<std::uint64_t>(lists.indices.begin(), lists.indices.end()));
}

/// Expects the file to hold what flat scans of `view` answer.
template <class View>
void expect_answers(const std::string& path, Answer answer, const std::vector<CompiledShaft>& asked, const View& view) {
  constexpr bool triangles = std::is_same_v<View, TriangleView>;
  IndexLists lists;
  if (answer == Answer::count) {
    std::vector<std::uint64_t> counts(asked.size());
    count_many(std::span(asked), view, std::span(counts));
    EXPECT_EQ(numbers_in(path, "counts"), counts);
    EXPECT_GT(std::ranges::max(counts), 0);
  } else if (answer == Answer::list) {
    list_many(std::span(asked), view, lists);
    expect_lists(path, "", lists);
    EXPECT_FALSE(lists.indices.empty());
  }
  if constexpr (!triangles) {
    if (answer == Answer::classify) {
      IndexLists inside;
      list_classified_many(std::span(asked), view, lists, inside);
      expect_lists(path, "overlap/", lists);
      expect_lists(path, "inside/", inside);
      EXPECT_FALSE(inside.indices.empty());
    } else if (answer == Answer::first) {
      std::vector<FirstContact> contacts(asked.size());
      first_contact_many(std::span(asked), view, std::span(contacts));
      const auto indices = dataset<std::int64_t>(path, "index", H5T_NATIVE_INT64);
      const auto times = dataset<float>(path, "time", H5T_NATIVE_FLOAT);
      ASSERT_EQ(indices.size(), asked.size());
      for (std::size_t s = 0; s != asked.size(); ++s) {
        EXPECT_EQ(indices[s], contacts[s] ? static_cast<std::int64_t>(contacts[s].index) : -1) << "shaft " << s;
        EXPECT_EQ(times[s], contacts[s].time) << "shaft " << s;
      }
    }
  }
  if constexpr (std::is_same_v<View, BoxView>) {
    if (answer == Answer::occluded) {
      std::vector<std::uint64_t> bits(bit_words(asked.size()));
      occluded_many(std::span(asked), view, std::span(bits));
      std::size_t found = 0;
      const auto occluded = dataset<std::uint8_t>(path, "occluded", H5T_NATIVE_UINT8);
      ASSERT_EQ(occluded.size(), asked.size());
      for (std::size_t s = 0; s != asked.size(); ++s) {
        EXPECT_EQ(occluded[s], bits[s / 64] >> (s % 64) & 1) << "shaft " << s;
        found += occluded[s];
      }
      EXPECT_GT(found, 0);
    }
  }
}

void expect_answers_of(const std::string& path, Answer answer, const std::vector<CompiledShaft>& asked, BoundKind kind,
                       const std::vector<float>& floats) {
  if (kind == BoundKind::box) {
    const BoxStream stream(StridedBoxes{floats.data(), floats.data() + 3, 24, bounds});
    expect_answers(path, answer, asked, stream.view());
  } else if (kind == BoundKind::sphere) {
    const SphereStream stream(StridedSpheres{floats.data(), floats.data() + 3, 16, bounds});
    expect_answers(path, answer, asked, stream.view());
  } else {
    std::vector<Triangle> triangles(bounds);
    std::memcpy(triangles.data(), floats.data(), floats.size() * sizeof(float));
    const TriangleStream stream{std::span<const Triangle>(triangles)};
    expect_answers(path, answer, asked, stream.view());
  }
}

TEST_F(BatchJob, AnswersAreThoseOfFlatScans) {
  constexpr std::array kinds{ShaftKind::between, ShaftKind::shadow, ShaftKind::swept, ShaftKind::sun};
  constexpr std::array answers{Answer::count, Answer::list, Answer::classify, Answer::first, Answer::occluded};
  job.block = 120;
  for (const BoundKind bound : {BoundKind::box, BoundKind::sphere, BoundKind::triangle}) {
    const std::vector<float> bound_floats = random_bounds(bound);
    write_floats(job.bounds, bound_floats.size() / bounds, bound_floats);
    for (const ShaftKind kind : kinds) {
      const std::vector<float> shaft_floats = random_shafts(kind);
      write_floats(job.shafts, shaft_floats.size() / shafts, shaft_floats);
      for (const Contact contact : {Contact::closed, Contact::open}) {
        const std::vector<CompiledShaft> asked = form_shafts(kind, contact, shaft_floats);
        for (const Answer answer : answers) {
          if (bound == BoundKind::triangle && answer != Answer::count && answer != Answer::list) continue;
          if (answer == Answer::occluded && (bound != BoundKind::box || kind != ShaftKind::between)) continue;
          SCOPED_TRACE(std::string(name_of(bound)) + ", " + name_of(kind) + ", " + name_of(answer) +
                       (contact == Contact::open ? ", open" : ", closed"));
          job.question = {kind, answer, contact};
          job.memory = 0;
          EXPECT_EQ(run(job).shares, 1);
          expect_answers_of(job.out, answer, asked, bound, bound_floats);
          const std::string whole = bytes_of_file(job.out);
          job.memory = 45'000;
          EXPECT_GT(run(job).shares, 3);
          EXPECT_TRUE(bytes_of_file(job.out) == whole) << "in shares";
          EXPECT_FALSE(std::filesystem::exists(job.out + ".parts"));
        }
      }
    }
  }
}

TEST_F(BatchJob, PairsOfPositionsAreTheShaftsOfTheirBoxes) {
  const std::vector<float> boxes = random_shafts(ShaftKind::between);  // twice as many boxes as shafts
  job.question.answer = Answer::list;
  run(job);
  const auto indices = numbers_in(job.out, "indices");
  const auto offsets = numbers_in(job.out, "offsets");
  write_floats(folder.path("boxes.npy"), 6, boxes);
  job.boxes = folder.path("boxes.npy");
  const auto expect_same = [&]<class T>(const std::string& type, T /*number*/) {
    std::vector<T> pairs(2 * shafts);
    std::iota(pairs.begin(), pairs.end(), T{0});
    write_npy<T>(job.shafts, type, 2, pairs);
    run(job);
    EXPECT_EQ(numbers_in(job.out, "indices"), indices) << type;
    EXPECT_EQ(numbers_in(job.out, "offsets"), offsets) << type;
  };
  expect_same("<i4", std::int32_t{});
  expect_same("<u4", std::uint32_t{});
  expect_same("<i8", std::int64_t{});
  expect_same("<u8", std::uint64_t{});
}

TEST_F(BatchJob, AnyNumberOfRanksWritesTheSameFile) {
  for (const Answer answer : {Answer::classify, Answer::first}) {
    job.question.answer = answer;
    job.memory = 0;
    run(job);
    const std::string whole = bytes_of_file(job.out);
    for (const std::uint64_t memory : {0U, 60'000U}) {
      job.memory = memory;
      for (const int size : {2, 3, 8}) {
        std::filesystem::remove(job.out);
        RankThreads(size).run([&](batch::Ranks& ranks) { batch::run_job(job, ranks, undisturbed); });
        EXPECT_TRUE(bytes_of_file(job.out) == whole) << size << " ranks, " << memory << " bytes";
      }
    }
  }
}

TEST_F(BatchJob, OneRankThatFailsTellsWhyAndAllEnd) {
  std::vector<float> floats = random_shafts(ShaftKind::between);
  floats[12 * 200 + 4] = -1;  // hi y below lo y
  write_floats(job.shafts, 12, floats);
  job.block = 10;
  std::mutex mutex;
  std::vector<std::string> told;
  int silent = 0;
  RankThreads(3).run([&](batch::Ranks& ranks) {
    try {
      batch::run_job(job, ranks, undisturbed);
    } catch (const batch::OtherRankFailed& other) {
      const std::lock_guard lock(mutex);
      EXPECT_EQ(other.code(), 2);
      ++silent;
    } catch (const InvalidArgument& error) {
      const std::lock_guard lock(mutex);
      told.emplace_back(error.what());
    }
    EXPECT_TRUE(ranks.have_failed());
  });
  EXPECT_EQ(silent, 2);
  ASSERT_THAT(told, testing::SizeIs(1));
  EXPECT_THAT(told[0], AllOf(HasSubstr("shafts.npy: row 200: "), HasSubstr("lo")));
}

/// What three ranks say of a job, of which rank 1 has one of its own.
std::vector<std::string> told_where_one_differs(const Job& job, const Job& of_one, const batch::Surroundings& around) {
  std::mutex mutex;
  std::vector<std::string> told;
  RankThreads(3).run([&](batch::Ranks& ranks) {
    const bool is_one = ranks.rank() == 1;
    try {
      batch::run_job(is_one ? of_one : job, ranks, is_one ? around : undisturbed);
    } catch (const batch::OtherRankFailed&) {
    } catch (const InvalidArgument& error) {
      const std::lock_guard lock(mutex);
      told.emplace_back(error.what());
    }
  });
  return told;
}

TEST_F(BatchJob, RanksWithOtherOptionsAreRefused) {
  Job other = job;
  other.block = 7;
  EXPECT_THAT(told_where_one_differs(job, other, undisturbed),
              ElementsAre(HasSubstr("rank 1: was started with other options than rank 0")));
}

TEST_F(BatchJob, RanksOfOtherVersionsAreRefused) {
  batch::Surroundings other = undisturbed;
  other.version = "0.0.1";
  EXPECT_THAT(told_where_one_differs(job, job, other),
              ElementsAre(HasSubstr(
                  "rank 1: runs another version of this program than rank 0, which is " SHAFTCULL_VERSION_STRING)));
  EXPECT_FALSE(std::filesystem::exists(job.out));
}

TEST_F(BatchJob, ArraysThatDoNotFitAreRefused) {
  const auto refusal = [&] { return message_of([&] { run(job); }); };
  write_floats(job.bounds, 5, std::vector<float>(10));
  EXPECT_THAT(refusal(), HasSubstr("bounds.npy: is (2, 5) of float32; bounds are rows of floats: boxes of 6"));
  write_floats(job.bounds, 6, random_bounds(BoundKind::box));
  job.question.kind = ShaftKind::swept;
  EXPECT_THAT(refusal(), HasSubstr("shafts.npy: is (230, 12) of float32; shafts of kind swept are rows of 9 floats"));
  job.question.kind = ShaftKind::between;
  job.boxes = job.bounds;
  EXPECT_THAT(refusal(), HasSubstr("holds boxes itself"));
  job.boxes = "";
  write_npy<std::int32_t>(job.shafts, "<i4", 2, std::vector<std::int32_t>{0, 1, 2, 1500, 5, -1});
  EXPECT_THAT(refusal(), HasSubstr("add --boxes"));
  job.boxes = job.bounds;
  EXPECT_THAT(refusal(), HasSubstr("shafts.npy: row 1: position 1500 is out of range for the 1500 boxes of"));
  std::filesystem::remove_all(job.out + ".parts");
  write_npy<std::int32_t>(job.shafts, "<i4", 2, std::vector<std::int32_t>{0, 1, 2, 1499, 5, -1});
  EXPECT_THAT(refusal(), HasSubstr("shafts.npy: row 2: a position of a box is below 0"));
  std::filesystem::remove_all(job.out + ".parts");
  job.boxes = job.shafts;
  EXPECT_THAT(refusal(), HasSubstr("boxes are rows of 6 floats"));
}

TEST_F(BatchJob, QuestionsThatBoundsCannotAnswerAreRefused) {
  const auto refusal = [&] { return message_of([&] { run(job); }); };
  write_floats(job.bounds, 9, random_bounds(BoundKind::triangle));
  job.question.answer = Answer::first;
  EXPECT_THAT(refusal(), HasSubstr("--answer first: "));
  write_floats(job.bounds, 4, random_bounds(BoundKind::sphere));
  job.question.answer = Answer::occluded;
  EXPECT_THAT(refusal(), HasSubstr("--answer occluded: only boxes can block"));
}

TEST_F(BatchJob, TheFirstBadRowIsNamedByItsPlaceInTheFile) {
  const auto refusal = [&] { return message_of([&] { run(job); }); };
  std::vector<float> floats = random_shafts(ShaftKind::between);
  floats[12 * 35 + 11] = -9;
  floats[12 * 33 + 6] = std::numeric_limits<float>::quiet_NaN();
  write_floats(job.shafts, 12, floats);
  EXPECT_THAT(refusal(), HasSubstr("shafts.npy: row 33: "));
  std::filesystem::remove_all(job.out + ".parts");
  write_floats(job.shafts, 12, random_shafts(ShaftKind::between));
  floats = random_bounds(BoundKind::box);
  floats[6 * 777] = 1000;
  write_floats(job.bounds, 6, floats);
  EXPECT_THAT(refusal(), HasSubstr("bounds.npy: row 777: "));
  std::filesystem::remove_all(job.out + ".parts");
  job.memory = 60'000;
  EXPECT_THAT(refusal(), HasSubstr("bounds.npy: row 777: "));
}

TEST_F(BatchJob, NothingToAskAndNothingToAskAboutHaveEmptyAnswers) {
  for (const Answer answer : {Answer::count, Answer::list, Answer::classify, Answer::first, Answer::occluded}) {
    job.question.answer = answer;
    write_floats(job.bounds, 6, {});
    write_floats(job.shafts, 12, random_shafts(ShaftKind::between));
    EXPECT_EQ(run(job).bounds, 0);
    if (answer == Answer::list) {
      EXPECT_EQ(numbers_in(job.out, "offsets"), std::vector<std::uint64_t>(shafts + 1));
    }
    if (answer == Answer::first) {
      EXPECT_EQ(dataset<std::int64_t>(job.out, "index", H5T_NATIVE_INT64), std::vector<std::int64_t>(shafts, -1));
    }
    write_floats(job.bounds, 6, random_bounds(BoundKind::box));
    write_floats(job.shafts, 12, {});
    EXPECT_EQ(run(job).shafts, 0);
    if (answer == Answer::list) {
      EXPECT_EQ(numbers_in(job.out, "offsets"), std::vector<std::uint64_t>(1));
    }
    if (answer == Answer::count) {
      EXPECT_EQ(numbers_in(job.out, "counts"), std::vector<std::uint64_t>{});
    }
  }
}

TEST_F(BatchJob, LittleMemoryForVeryManySharesIsRefused) {
  job.memory = 1;
  constexpr std::size_t few = 150;  // for each share looks into the files of all others
  std::vector<float> floats = random_bounds(BoundKind::box);
  floats.resize(6 * few);
  write_floats(job.bounds, 6, floats);
  EXPECT_EQ(run(job).shares, few) << "a bound each is as small as shares get";
  write_floats(job.bounds, 6, std::vector<float>(6 * 20'000));
  EXPECT_THAT(message_of([&] { run(job); }), HasSubstr("--memory: 20000 bounds would be divided into 20000 shares"));
}

}  // namespace
}  // namespace shaftcull::test
