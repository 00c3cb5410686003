// SPDX-License-Identifier: MIT
#include "batch/job.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "batch/block_store.hpp"
#include "batch/bounds_source.hpp"
#include "batch/input_hash.hpp"
#include "batch/job_folder.hpp"
#include "batch/job_trees.hpp"
#include "batch/planned_shares.hpp"
#include "batch/result_file.hpp"
#include "batch/shaft_source.hpp"
#include "batch/share.hpp"
#include "batch/work_log.hpp"
#include "batch/written_file.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/first_contact.hpp"

namespace shaftcull::batch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t numbers_a_block = 65'536;  ///< shafts whose answers are a number each
constexpr std::uint64_t lists_a_block = 16'384;    ///< … or lists

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// Has large memory that is freed go back to the system at once. The C library of Linux would keep pieces of up to 32
/// MiB, with gaps among them.
void keep_no_freed_memory() {
#if defined(__GLIBC__)
  constexpr int large = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, large);
#endif
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// What is read, the same on all ranks.
struct Input {
  BoundsSource bounds;
  ShaftSource shafts;

  explicit Input(const Job& job)
      : bounds(job.bounds, job.origin, job.question.answer == Answer::occluded),
        shafts(job.shafts, job.boxes, job.question.kind, job.origin) {
    const Answer answer = job.question.answer;
    const BoundKind kind = bounds.kind();
    if (kind == BoundKind::triangle && answer != Answer::count && answer != Answer::list) {
      throw InvalidArgument(fmt::format("--answer {}: {} holds triangles, which support only count and list",
                                        name_of(answer), job.bounds));
    }
    if (answer != Answer::occluded) return;
    if (kind != BoundKind::box || job.question.kind != ShaftKind::between) {
      throw InvalidArgument(
          fmt::format("--answer occluded: only boxes can block, and only shafts between two boxes can be blocked; "
                      "these are bounds of kind {} and shafts of kind {}",
                      name_of(kind), name_of(job.question.kind)));
    }
  }
};

class Run {
 public:
  Run(const Job& job, Ranks& ranks, const Surroundings& surroundings)
      : job_(job),
        ranks_(ranks),
        surroundings_(surroundings),
        folder_(job.out + ".parts"),
        progress_(stderr, ranks.rank() == 0 ? job.progress : ProgressForm::none) {}

  JobReport run() {
    agree_on_job();
    if (job_.memory != 0) keep_no_freed_memory();
    on_all(ranks_, [&] {
      input_ = std::make_unique<Input>(job_);
      log_ = std::make_unique<WorkLog>(job_.log, ranks_.rank());
    });
    agree_on_input_sizes();
    on_first(ranks_, [&] {
      std::error_code ignored;
      if (std::filesystem::is_directory(job_.out, ignored)) {
        throw InvalidArgument(fmt::format("{}: cannot be written: it is a directory", job_.out));
      }
      folder_.lock();
    });
    plan_ = plan_shares(input_->bounds, job_.memory, ranks_, surroundings_);
    describe();
    on_first(ranks_, [&] { folder_.begin(description_); });
    fingerprint_ = fingerprint(bytes_of(text_of(description_)));
    store_ = std::make_unique<BlockStore>(folder_.path(), fingerprint_, ranks_.rank());
    on_first(ranks_, [&] { store_->make_folders(plan_.count()); });
    find_finished();
    find_left();
    prepare_trees();
    compute();
    trees_.reset();
    write_result();
    report_.seconds = seconds_since(begin_);
    return report_;
  }

 private:
  void agree_on_job() {
    agree_on_version(ranks_, surroundings_.version);
    const std::string command =
        fmt::format("{}\n{}\n{}\n{}\n{} {} {} {} {} {}", job_.bounds, job_.shafts, job_.boxes, job_.out,
                    name_of(job_.question.kind), name_of(job_.question.answer), static_cast<int>(job_.question.contact),
                    job_.block, job_.memory, fmt::join(job_.origin.at(), ","));
    agree_on(ranks_, checksum(bytes_of(command)), "was started with other options than rank 0");
  }

  void agree_on_input_sizes() {
    agree_on(ranks_, input_->bounds.size(), fmt::format("{} has another number of bounds than on rank 0", job_.bounds));
    agree_on(ranks_, input_->shafts.size(), fmt::format("{} has another number of shafts than on rank 0", job_.shafts));
  }

  void describe() {
    const Question& question = job_.question;
    const bool lists = lists_of(question.answer) != 0;
    block_ = job_.block != 0 ? job_.block : lists ? lists_a_block : numbers_a_block;
    blocks_ = input_->shafts.size() / block_ + (input_->shafts.size() % block_ != 0 ? 1 : 0);
    const auto hash = [&](const ArrayFile& array) {
      return fmt::format("{} {}", array.shape(), hexadecimal(hash_of(array, ranks_, surroundings_.on_threads)));
    };
    description_ = {{"version", surroundings_.version},
                    {"answer", name_of(question.answer)},
                    {"kind", name_of(question.kind)},
                    {"contact", question.contact == Contact::open ? "open" : "closed"},
                    {"bounds", hash(input_->bounds.array())}};
    const std::vector<const ArrayFile*> arrays = input_->shafts.arrays();
    description_.emplace_back("shafts", hash(*arrays[0]));
    if (arrays.size() > 1) description_.emplace_back("boxes", hash(*arrays[1]));
    if (job_.origin != Origin()) {
      description_.emplace_back("origin", fmt::format("{}", fmt::join(job_.origin.at(), ",")));
    }
    description_.emplace_back("block", fmt::format("{}", block_));
    description_.emplace_back("shares", fmt::format("{}", plan_.count()));
    report_.shafts = input_->shafts.size();
    report_.bounds = input_->bounds.size();
    report_.bound_kind = input_->bounds.kind();
    report_.blocks = blocks_;
    report_.shares = plan_.count();
  }

  /// Which blocks earlier runs have stored: each rank reads its part of them, and all learn of all.
  void find_finished() {
    finished_.assign(static_cast<std::size_t>(plan_.count() * blocks_), 0);
    std::vector<std::uint64_t> resumed{folder_.resumed() ? std::uint64_t{1} : std::uint64_t{0}};
    ranks_.sum(resumed);
    if (resumed[0] != 0) {
      on_all(ranks_, [&] {
        for (auto i = static_cast<std::size_t>(ranks_.rank()); i < finished_.size();
             i += static_cast<std::size_t>(ranks_.size())) {
          finished_[i] = store_->read<BlockAnswer>(i / blocks_, i % blocks_) ? 1 : 0;
        }
      });
      ranks_.sum(finished_);
    }
    report_.blocks_before = static_cast<std::uint64_t>(std::ranges::count(finished_, 1U));
  }

  [[nodiscard]] std::uint64_t size_of_block(std::uint64_t block) const {
    return std::min(block_, input_->shafts.size() - block * block_);
  }

  /// Deals pieces of a pile, and tells now and then how far the job is.
  void deal(Dealing& dealing, std::size_t pile, std::uint64_t pieces,
            const std::function<Dealing::Rest(std::uint64_t)>& work, const ProgressState& state,
            const std::function<void(std::uint64_t)>& prepare = {}) {
    const auto meanwhile = [&] {
      if (progress_.due()) tell(dealing, state);
    };
    dealing.each(pile, pieces, work, meanwhile, prepare);
  }

  void tell(Dealing& dealing, ProgressState state) {
    state.blocks_done += dealing.finished();
    state.seconds = seconds_since(phase_begin_);
    progress_.write(state);
  }

  [[nodiscard]] std::string stopped_text() const {
    return fmt::format("batch: interrupted; finished results are in {}; run the same command again to resume",
                       folder_.path());
  }

  /// What is left of each share: all ranks have the same lists, and deal positions in them.
  void find_left() {
    left_.resize(plan_.count());
    for (std::size_t i = 0; i != finished_.size(); ++i) {
      if (finished_[i] == 0) left_[i / blocks_].push_back(i % blocks_);
    }
  }

  /// Makes trees that several ranks use, or that a later run may.
  void prepare_trees() {
    trees_.emplace(JobTrees::Given{input_->bounds, plan_, folder_.path(), fingerprint_, ranks_, surroundings_, *log_});
    std::vector<std::uint64_t> wanted;
    for (std::size_t share = 0; share != plan_.count(); ++share) {
      if (!left_[share].empty()) wanted.push_back(share);
    }
    if (wanted.empty()) return;
    if (plan_.count() == 1) return trees_->share_in_memory();
    const std::vector<std::uint64_t> missing = trees_->missing(wanted);
    if (missing.empty()) return;
    make_of_bounds("deal", trees_->stretches_to_deal(), plan_.bounds_a_stretch,
                   [&](std::uint64_t stretch) { trees_->deal(stretch); });
    make_of_bounds("sort", missing, report_.bounds / plan_.count(), [&](std::uint64_t share) { trees_->store(share); });
    trees_->have_dealt();
  }

  /// A phase in which ranks make things of bounds, each of so many.
  void make_of_bounds(const char* phase, const std::vector<std::uint64_t>& things, std::uint64_t bounds,
                      const std::function<void(std::uint64_t thing)>& make) {
    if (things.empty()) return;
    Dealing dealing(ranks_, surroundings_, 1);
    phase_begin_ = Clock::now();
    const ProgressState state{phase, 0, things.size(), 0, static_cast<double>(bounds), 0, "bounds"};
    const auto make_piece = [&](std::uint64_t piece) -> Dealing::Rest {
      make(things[static_cast<std::size_t>(piece)]);
      return {};
    };
    dealing.on_all_until_stopped([&] { deal(dealing, 0, things.size(), make_piece, state); }, stopped_text());
    if (ranks_.rank() == 0) tell(dealing, state);
  }

  void compute() {
    const std::size_t shares = plan_.count();
    Dealing dealing(ranks_, surroundings_, shares);
    phase_begin_ = Clock::now();
    const std::uint64_t units = shares * blocks_;
    const ProgressState state{"compute",
                              report_.blocks_before,
                              units,
                              report_.blocks_before,
                              blocks_ == 0 ? 0 : static_cast<double>(report_.shafts) / static_cast<double>(units),
                              0};
    const auto work = [&] {
      const std::size_t begin =
          static_cast<std::size_t>(ranks_.rank()) * shares / static_cast<std::size_t>(ranks_.size());
      for (std::size_t i = 0; i != shares; ++i) {
        const std::size_t which = (begin + i) % shares;
        // Whoever has no tree yet looks first whether it is worth one.
        if (dealing.taken(which) >= left_[which].size()) continue;
        const auto answer_block = [&](std::uint64_t piece) -> Dealing::Rest {
          const std::uint64_t block = left_[which][static_cast<std::size_t>(piece)];
          const ShareTree& share = trees_->of(which);
          const auto found = std::make_shared<BlockAnswer>();
          log_->time("answer", which, block, [&] {
            *found = answer(share, input_->shafts, block * block_, size_of_block(block), job_.question);
          });
          return [this, found, which, block] {
            log_->time("store", which, block, [&] { store_->write(which, block, *found); });
          };
        };
        const auto read_ahead = [&](std::uint64_t piece) {
          const std::uint64_t block = left_[which][static_cast<std::size_t>(piece)];
          input_->shafts.read_ahead(block * block_, size_of_block(block));
        };
        deal(dealing, which, left_[which].size(), answer_block, state, read_ahead);
        if (dealing.must_stop()) return;
      }
    };
    dealing.on_all_until_stopped(work, stopped_text());
    if (ranks_.rank() == 0) tell(dealing, state);
  }

  /// What was read of a block, all of which were whole on disk a moment ago. Throws if this one no longer is.
  template <class Read>
  [[nodiscard]] Read whole(std::optional<Read> read, std::uint64_t share, std::uint64_t block) const {
    if (read) return *std::move(read);
    throw std::runtime_error(
        fmt::format("{}: is damaged; run the same command again to recompute it", store_->path(share, block)));
  }

  [[nodiscard]] BlockAnswer merged(std::uint64_t block) const {
    std::vector<BlockAnswer> shares;
    for (std::size_t share = 0; share != plan_.count(); ++share) {
      shares.push_back(whole(store_->read<BlockAnswer>(share, block), share, block));
    }
    return merge(std::move(shares), job_.question.answer,
                 [&](std::uint32_t row, std::uint64_t one, std::uint64_t other) {
                   return reached_before(block * block_ + row, one, other);
                 });
  }

  /// Compares exact times of first contact: those that are stored are rounded down.
  [[nodiscard]] bool reached_before(std::uint64_t row, std::uint64_t one, std::uint64_t other) const {
    CompiledShaft shaft;
    input_->shafts.form(row, std::span(&shaft, 1), true);
    if (job_.question.contact == Contact::open) set_contact(shaft, Contact::open);
    const std::array both{std::min(one, other), std::max(one, other)};
    const auto first_of = [&]<class View>(View view) {
      constexpr std::size_t columns = std::tuple_size_v<decltype(view.stream)>;
      std::array<std::array<float, 2>, columns> column{};
      std::vector<std::byte> scratch;
      for (std::size_t i = 0; i != 2; ++i) {
        const std::span<const float> floats = input_->bounds.read(both[i], 1, scratch);
        for (std::size_t c = 0; c != columns; ++c) column[c][i] = floats[c];
      }
      for (std::size_t c = 0; c != columns; ++c) view.stream[c] = column[c].data();
      view.count = 2;
      return first_contact(shaft, view);
    };
    const auto contact = input_->bounds.kind() == BoundKind::box ? first_of(BoxView()) : first_of(SphereView());
    return contact && both[contact.index] == one;
  }

  void write_result() {
    const Answer answer = job_.question.answer;
    // How many indices the lists of each block have; then where those of each begin.
    std::vector<std::uint64_t> totals(static_cast<std::size_t>(2 * blocks_));
    on_all(ranks_, [&] {
      if (lists_of(answer) == 0) return;
      for (auto block = static_cast<std::uint64_t>(ranks_.rank()); block < blocks_;
           block += static_cast<std::uint64_t>(ranks_.size())) {
        for (std::size_t share = 0; share != plan_.count(); ++share) {
          const BlockStore::Sizes here = whole(store_->sizes(share, block), share, block);
          for (std::size_t l = 0; l != 2; ++l) {
            totals[static_cast<std::size_t>(2 * block) + l] += here[4 + 2 * l] / sizeof(std::uint64_t);
          }
        }
      }
    });
    ranks_.sum(totals);
    std::array<std::uint64_t, 2> all{0, 0};
    for (std::size_t i = 0; i != totals.size(); ++i) all[i % 2] += std::exchange(totals[i], all[i % 2]);

    const std::string unfinished = folder_.path() + "/result.h5";
    ResultPlaces places(datasets_of(answer));
    on_first(ranks_, [&] { places = make_result_file(unfinished, answer, report_.shafts, all, result_description()); });
    if (ranks_.rank() != 0) std::ranges::fill(places, 0);
    ranks_.sum(places);
    Dealing dealing(ranks_, surroundings_, 1);
    phase_begin_ = Clock::now();
    const ProgressState state{
        "write", 0, blocks_, 0, blocks_ == 0 ? 0 : static_cast<double>(report_.shafts) / static_cast<double>(blocks_),
        0};
    const auto work = [&] {
      WrittenFile file(unfinished, false);
      const auto read_block = [&](std::uint64_t block) -> Dealing::Rest {
        const auto answers = std::make_shared<BlockAnswer>();
        log_->time("read", 0, block, [&] { *answers = merged(block); });
        return [&, answers, block] {
          const auto at = static_cast<std::size_t>(2 * block);
          log_->time("write", 0, block, [&] {
            write_block(file, places, answer, report_.shafts, block * block_, size_of_block(block),
                        {totals[at], totals[at + 1]}, *answers);
          });
        };
      };
      deal(dealing, 0, blocks_, read_block, state);
      file.sync();
      file.close();
    };
    dealing.on_all_until_stopped(work, stopped_text());
    if (ranks_.rank() == 0) tell(dealing, state);
    on_first(ranks_, [&] {
      rename_file(unfinished, job_.out);
      folder_.remove();
    });
  }

  [[nodiscard]] ResultDescription result_description() const {
    ResultDescription result;
    for (const auto& [name, value] : description_) {
      // How the work was cut says nothing of the answers.
      if (name != "block" && name != "shares") result.texts.emplace_back(name, value);
    }
    result.texts.emplace_back("bound_kind", name_of(report_.bound_kind));
    result.numbers = {{"number_of_bounds", report_.bounds}, {"number_of_shafts", report_.shafts}};
    return result;
  }

  const Job& job_;
  Ranks& ranks_;
  const Surroundings& surroundings_;
  JobFolder folder_;
  ProgressLines progress_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point phase_begin_ = begin_;
  std::unique_ptr<Input> input_;
  std::unique_ptr<WorkLog> log_;
  std::unique_ptr<BlockStore> store_;
  PlannedShares plan_;
  JobDescription description_;
  std::uint64_t block_ = 0;
  std::uint64_t blocks_ = 0;
  Fingerprint fingerprint_{};
  std::optional<JobTrees> trees_;
  std::vector<std::vector<std::uint64_t>> left_;  ///< blocks of each share that are to do
  std::vector<std::uint64_t> finished_;           ///< 1 for each block of each share that an earlier run has stored
  JobReport report_;
};

}  // namespace

JobReport run_job(const Job& job, Ranks& ranks, const Surroundings& surroundings) {
  return Run(job, ranks, surroundings).run();
}

}  // namespace shaftcull::batch
