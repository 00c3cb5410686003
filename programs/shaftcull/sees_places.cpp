// SPDX-License-Identifier: MIT
#include "sees_places.hpp"

#include <array>
#include <utility>

#include "crc32.hpp"
#include "npz_layout.hpp"
#include "part_count.hpp"
#include "sees_arrays.hpp"
#include "sees_csv.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t most_bytes_waiting = std::size_t{1} << 20;

/// Each of the numbers becomes the sum of those before it. Gives the sum of all.
std::uint64_t sum_before(std::span<std::uint64_t> numbers) {
  std::uint64_t sum = 0;
  for (std::uint64_t& number : numbers) sum += std::exchange(number, sum);
  return sum;
}

/// Arrays of answers get rows from each part; those of the scene are other pieces.
class NpzPlaces final : public SightPlaces {
 public:
  NpzPlaces(const SeesScene& scene, const PatchSet& patches, const SightContent& content)
      : parts_(part_count(patches.size(), parts_of_sees)),
        answers_(answer_arrays(content)),
        scene_(scene_arrays(scene, patches.order(), content)),
        rows_(answers_.size() * parts_),
        crcs_(answers_.size() * parts_ + scene_.size()) {}

  void measure(std::size_t part, const PartAnswer& answer) override {
    for (std::size_t array = 0; array != answers_.size(); ++array) {
      rows_[array * parts_ + part] = rows_of(answer, array).size() / answers_[array].format.row_bytes();
    }
  }

  std::span<std::uint64_t> lengths() override { return rows_; }

  void arrange() override {
    for (std::size_t array = 0; array != answers_.size(); ++array) {
      const std::uint64_t rows = sum_before(std::span(rows_).subspan(array * parts_, parts_));
      layout_.add(answers_[array].format, rows + first_row_of(array));
      all_rows_.push_back(rows);
    }
    for (const SceneArray& array : scene_) layout_.add(array.format, array.rows);
  }

  [[nodiscard]] std::size_t other_pieces() const override { return scene_.size(); }

  void write_other(std::size_t piece, batch::WrittenFile& file) override {
    std::uint32_t crc = 0;
    PlacedBytes numbers(file, layout_.place_of_numbers(answers_.size() + piece));
    scene_[piece].pour([&](std::span<const std::byte> bytes) {
      crc = crc32_of(bytes, crc);
      numbers.append(bytes);
    });
    numbers.finish();
    crcs_[answers_.size() * parts_ + piece] = crc;
  }

  void write_part(std::size_t part, const PartAnswer& answer, batch::WrittenFile& file) override {
    for (std::size_t array = 0; array != answers_.size(); ++array) {
      std::span<const std::byte> rows = rows_of(answer, array);
      std::vector<std::uint64_t> ends;
      if (answers_[array].kind == AnswerKind::first_candidate) {
        ends = answer.ends;
        for (std::uint64_t& end : ends) end += rows_[(array + 1) * parts_ + part];  // candidates come next
        rows = std::as_bytes(std::span(ends));
      }
      crcs_[array * parts_ + part] = crc32_of(rows);
      file.write_at(place_of(array, part), rows);
    }
  }

  std::span<std::uint64_t> sums() override { return crcs_; }

  void complete(batch::WrittenFile& file) const override {
    std::vector<std::uint32_t> crcs;
    for (std::size_t array = 0; array != answers_.size(); ++array) {
      if (first_row_of(array) == 1) {
        file.write_at(layout_.place_of_numbers(array), std::as_bytes(std::span(&no_candidate_before, 1)));
      }
      crcs.push_back(crc_of_answers(array));
    }
    for (const std::uint64_t crc : std::span(crcs_).subspan(answers_.size() * parts_)) {
      crcs.push_back(static_cast<std::uint32_t>(crc));
    }
    const auto write = [&](std::uint64_t place, const std::string& text) {
      file.write_at(place, std::as_bytes(std::span(text)));
    };
    for (std::size_t array = 0; array != layout_.size(); ++array) {
      write(layout_.place_of_head(array), layout_.head(array, crcs[array]));
    }
    write(layout_.place_of_directory(), layout_.directory(crcs));
  }

 private:
  /// What a part puts into an array of answers, `first_candidate` without candidates of parts before.
  [[nodiscard]] std::span<const std::byte> rows_of(const PartAnswer& answer, std::size_t array) const {
    switch (answers_[array].kind) {
      case AnswerKind::blocks:
        return std::as_bytes(std::span(answer.blocks));
      case AnswerKind::undecided:
        return std::as_bytes(std::span(answer.undecided));
      case AnswerKind::seen:
        return std::as_bytes(std::span(answer.seen));
      case AnswerKind::first_candidate:
        return std::as_bytes(std::span(answer.ends));
      case AnswerKind::candidates:
        break;
    }
    return std::as_bytes(std::span(answer.candidates));
  }

  /// How many rows an array has before those of parts: `first_candidate` one, of no candidate.
  [[nodiscard]] std::uint64_t first_row_of(std::size_t array) const {
    return answers_[array].kind == AnswerKind::first_candidate ? 1 : 0;
  }

  [[nodiscard]] std::uint64_t place_of(std::size_t array, std::size_t part) const {
    const std::uint64_t before = rows_[array * parts_ + part] + first_row_of(array);
    return layout_.place_of_numbers(array) + before * answers_[array].format.row_bytes();
  }

  [[nodiscard]] std::uint32_t crc_of_answers(std::size_t array) const {
    std::uint32_t crc = 0;
    if (first_row_of(array) == 1) crc = crc32_of(std::as_bytes(std::span(&no_candidate_before, 1)));
    const auto of_parts = [&](const std::vector<std::uint64_t>& numbers) {
      return std::span(numbers).subspan(array * parts_, parts_);
    };
    const std::span<const std::uint64_t> begins = of_parts(rows_);
    const std::span<const std::uint64_t> crcs = of_parts(crcs_);
    for (std::size_t part = 0; part != parts_; ++part) {
      const std::uint64_t end = part + 1 != parts_ ? begins[part + 1] : all_rows_[array];
      crc = joined_crc32(crc, static_cast<std::uint32_t>(crcs[part]),
                         (end - begins[part]) * answers_[array].format.row_bytes());
    }
    return crc;
  }

  std::size_t parts_;
  std::vector<AnswerArray> answers_;
  std::vector<SceneArray> scene_;
  std::vector<std::uint64_t> rows_;  ///< of each array that of each part; when places are found, of parts before it
  std::vector<std::uint64_t> crcs_;  ///< of numbers, likewise of each part; then those of each array of the scene
  std::vector<std::uint64_t> all_rows_;
  NpzLayout layout_;
};

/// Lines of certain pairs of all parts, then those of undecided pairs; the heading is the other piece.
class CsvPlaces final : public SightPlaces {
 public:
  CsvPlaces(const PatchSet& patches, std::uint32_t rays)
      : order_(patches.order()), rays_(rays), parts_(part_count(patches.size(), parts_of_sees)), bytes_(2 * parts_) {}

  void measure(std::size_t part, const PartAnswer& answer) override {
    CsvLength length(order_, rays_);
    SightSink* const sinks[] = {&length};
    hand_over(answer, sinks);
    bytes_[part] = length.certain();
    bytes_[parts_ + part] = length.undecided();
  }

  std::span<std::uint64_t> lengths() override { return bytes_; }

  void arrange() override {
    sum_before(bytes_);
    for (std::uint64_t& place : bytes_) place += csv_heading(rays_).size();
  }

  [[nodiscard]] std::size_t other_pieces() const override { return 1; }

  void write_other(std::size_t /*piece*/, batch::WrittenFile& file) override {
    file.write_at(0, std::as_bytes(std::span(csv_heading(rays_))));
  }

  void write_part(std::size_t part, const PartAnswer& answer, batch::WrittenFile& file) override {
    PlacedBytes certain(file, bytes_[part]);
    PlacedBytes undecided(file, bytes_[parts_ + part]);
    const auto into = [](PlacedBytes& bytes) {
      return [&bytes](std::string_view text) { bytes.append(std::as_bytes(std::span(text))); };
    };
    CsvLines lines(order_, rays_, into(certain), into(undecided));
    SightSink* const sinks[] = {&lines};
    hand_over(answer, sinks);
    certain.finish();
    undecided.finish();
  }

  std::span<std::uint64_t> sums() override { return {}; }
  void complete(batch::WrittenFile& /*file*/) const override {}

 private:
  std::span<const std::uint32_t> order_;
  std::uint32_t rays_;
  std::size_t parts_;
  /// Of each part those of lines of certain pairs, then likewise of undecided ones; when places are found, where they
  /// begin.
  std::vector<std::uint64_t> bytes_;
};

}  // namespace

void PlacedBytes::append(std::span<const std::byte> bytes) {
  if (bytes.size() >= most_bytes_waiting) {
    finish();
    file_.write_at(place_, bytes);
    place_ += bytes.size();
    return;
  }
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  if (waiting_.size() >= most_bytes_waiting) finish();
}

void PlacedBytes::finish() {
  file_.write_at(place_, waiting_);
  place_ += waiting_.size();
  waiting_.clear();
}

std::unique_ptr<SightPlaces> sight_places(const std::string& path, const SeesScene& scene, const PatchSet& patches,
                                          const SightContent& content) {
  if (sight_form(path, patches.size()) == SightForm::npz) return std::make_unique<NpzPlaces>(scene, patches, content);
  require_no_candidates(path, content);
  return std::make_unique<CsvPlaces>(patches, content.rays);
}

}  // namespace shaftcull::cli
