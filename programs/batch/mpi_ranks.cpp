// SPDX-License-Identifier: MIT
/// Ranks of MPI. The only place that knows it.
#include <mpi.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "batch/launcher.hpp"
#include "batch/ranks.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (provided < MPI_THREAD_FUNNELED && size_ > 1) {
      // All ranks have the same MPI, so all find it so; the first one says it.
      if (rank_ == 0) throw InvalidArgument("this MPI does not support threads in a process (MPI_THREAD_FUNNELED)");
      throw OtherRankFailed(2);
    }
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here_);
    MPI_Comm_set_errhandler(here_, MPI_ERRORS_RETURN);  // where memory cannot be shared, there is another way
    MPI_Comm_rank(here_, &rank_here_);
    MPI_Comm_size(here_, &size_here_);
  }

  ~MpiRanks() override {
    free_counters();
    free_shared();
    MPI_Comm_free(&here_);
    MPI_Finalize();
  }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  void sum(std::span<std::uint64_t> numbers) override {
    constexpr std::size_t most_at_once = std::size_t{1} << 24;
    while (!numbers.empty()) {
      const std::span<std::uint64_t> some = numbers.first(std::min(most_at_once, numbers.size()));
      MPI_Allreduce(MPI_IN_PLACE, some.data(), static_cast<int>(some.size()), MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
      numbers = numbers.subspan(some.size());
    }
  }

  void make_counters(std::size_t count) override {
    free_counters();
    const auto bytes = static_cast<MPI_Aint>(rank_ == 0 ? count * sizeof(std::uint64_t) : 0);
    std::uint64_t* memory = nullptr;
    MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &memory, &counters_);
    if (rank_ == 0) {
      MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, counters_);
      std::fill_n(memory, count, std::uint64_t{0});
      MPI_Win_unlock(0, counters_);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, counters_);
  }

  std::uint64_t add(std::size_t counter, std::uint64_t number) override {
    std::uint64_t before = 0;
    MPI_Fetch_and_op(&number, &before, MPI_UINT64_T, 0, static_cast<MPI_Aint>(counter), MPI_SUM, counters_);
    MPI_Win_flush(0, counters_);
    return before;
  }

  [[nodiscard]] int ranks_here() const override { return size_here_; }
  [[nodiscard]] bool is_first_here() const override { return rank_here_ == 0; }

  [[nodiscard]] std::span<std::byte> shared_memory(std::size_t bytes) override {
    free_shared();
    std::uint64_t size = is_first_here() && has_room(bytes) ? bytes : 0;
    MPI_Bcast(&size, 1, MPI_UINT64_T, 0, here_);
    if (size == 0) return {};
    std::byte* memory = nullptr;
    const std::uint64_t own = is_first_here() ? size + alignment : 0;
    const int failed = MPI_Win_allocate_shared(static_cast<MPI_Aint>(own), 1, MPI_INFO_NULL, here_, &memory, &shared_);
    std::uint64_t failures = failed == MPI_SUCCESS ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &failures, 1, MPI_UINT64_T, MPI_SUM, here_);
    if (failures != 0) {
      if (failed == MPI_SUCCESS) MPI_Win_free(&shared_);
      shared_ = MPI_WIN_NULL;
      return {};
    }
    MPI_Aint all = 0;
    int unit = 0;
    MPI_Win_shared_query(shared_, 0, &all, &unit, &memory);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, shared_);
    void* first = memory;
    std::size_t room = static_cast<std::size_t>(all);
    std::align(alignment, static_cast<std::size_t>(size), first, room);
    return {static_cast<std::byte*>(first), static_cast<std::size_t>(size)};
  }

  void meet_here() override {
    if (shared_ != MPI_WIN_NULL) MPI_Win_sync(shared_);
    MPI_Barrier(here_);
    if (shared_ != MPI_WIN_NULL) MPI_Win_sync(shared_);
  }

  void poll() override {
    int flag = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &flag, MPI_STATUS_IGNORE);
  }

  [[noreturn]] void abort(int code) override {
    MPI_Abort(MPI_COMM_WORLD, code);
    std::abort();
  }

 private:
  static constexpr std::size_t alignment = 64;

  /// Whether this machine has so much memory for sharing. MPI keeps it in /dev/shm where there is one; some only notice
  /// that it is full when the memory is written.
  [[nodiscard]] static bool has_room(std::size_t bytes) {
    struct statvfs status {};
    if (statvfs("/dev/shm", &status) != 0) return true;
    return static_cast<std::uint64_t>(status.f_bavail) * status.f_frsize > bytes + (std::uint64_t{64} << 20);
  }

  void free_shared() {
    if (shared_ == MPI_WIN_NULL) return;
    MPI_Win_unlock_all(shared_);
    MPI_Win_free(&shared_);
  }

  void free_counters() {
    if (counters_ == MPI_WIN_NULL) return;
    MPI_Win_unlock_all(counters_);
    MPI_Win_free(&counters_);
  }

  int rank_ = 0;
  int size_ = 1;
  MPI_Win counters_ = MPI_WIN_NULL;
  MPI_Comm here_ = MPI_COMM_NULL;  ///< ranks of this machine
  int rank_here_ = 0;
  int size_here_ = 1;
  MPI_Win shared_ = MPI_WIN_NULL;
};

}  // namespace

bool has_mpi() noexcept { return true; }

std::unique_ptr<Ranks> launched_ranks() {
  const Launch started = launch();
  if (started.mpi) return std::make_unique<MpiRanks>();
  if (started.processes > 1) {
    if (started.process != 0) throw OtherRankFailed(2);
    throw InvalidArgument(fmt::format(
        "srun started {} processes that do not know each other; start them with srun --mpi=pmix, or with mpirun",
        started.processes));
  }
  return one_rank();
}

}  // namespace shaftcull::batch
