// SPDX-License-Identifier: MIT
/// Finished blocks of a job, on disk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "batch/checksum.hpp"
#include "batch/mapped_file.hpp"
#include "batch/ranks.hpp"

namespace shaftcull::batch {

/// The arrays of a block, in its file. Ranks of one machine share its pages, which the system takes back when it needs
/// them.
class MappedBlock {
 public:
  static constexpr std::size_t most_arrays = 7;
  /// An array; the first begins at a multiple of 64 bytes, each other one where the one before it ends.
  [[nodiscard]] std::span<const std::byte> array(std::size_t i) const noexcept { return arrays_[i]; }

 private:
  friend class BlockStore;
  std::unique_ptr<MappedFile> file_;
  std::array<std::span<const std::byte>, most_arrays> arrays_;
};

/// A file for each block and share, in a folder: a header, then the answers, both with a checksum. It is written under
/// another name and renamed, so that a run that is killed leaves whole blocks, or none. Nobody waits for the disk: what
/// a machine that goes down has not written, checksums tell.
///
/// An Answer is some vectors, at most most_arrays, of what may be written as bytes: Answer::arrays(answer) is a tuple
/// of references to them.
class BlockStore {
 public:
  static constexpr std::size_t most_arrays = MappedBlock::most_arrays;
  /// Bytes of each array; 0 for those that an answer does not have.
  using Sizes = std::array<std::uint64_t, most_arrays>;

  /// `job` tells whose blocks these are: others count as damaged. `rank` keeps names of those that write apart.
  BlockStore(std::string folder, const Fingerprint& job, int rank);

  /// Makes the folders that blocks of so many shares go to. Throws std::runtime_error.
  void make_folders(std::size_t shares) const;

  /// Throws std::runtime_error if it cannot be written; then the block is not there.
  template <class Answer>
  void write(std::uint64_t share, std::uint64_t block, const Answer& answer) const {
    std::apply(
        [&](const auto&... arrays) {
          static_assert(sizeof...(arrays) <= most_arrays);
          const std::array<std::span<const std::byte>, sizeof...(arrays)> bytes{std::as_bytes(std::span(arrays))...};
          write_arrays(share, block, bytes);
        },
        Answer::arrays(answer));
  }

  /// The answers of a block, or nothing if it is not there, torn or damaged.
  template <class Answer>
  [[nodiscard]] std::optional<Answer> read(std::uint64_t share, std::uint64_t block) const {
    Answer answer;
    const bool is_whole = std::apply(
        [&](auto&... arrays) {
          std::array<MakeRoom, sizeof...(arrays)> rooms{room_in(arrays)...};
          return read_arrays(share, block, rooms);
        },
        Answer::arrays(answer));
    if (!is_whole) return std::nullopt;
    return answer;
  }

  enum class Check : std::uint8_t {
    all,     ///< arrays are compared with their checksum: O(bytes)
    header,  ///< how long they are, and that the file is
  };
  /// The arrays of a block where its file is mapped; likewise.
  [[nodiscard]] std::optional<MappedBlock> map(std::uint64_t share, std::uint64_t block, Check check) const;

  /// Removes a block that was whole when the job looked, and no longer is, so that the next run makes it again. Throws
  /// std::runtime_error, which says so.
  [[noreturn]] void give_up(std::uint64_t share, std::uint64_t block) const;

  /// How long the arrays of a block are, by its header alone. Nothing if that is not there or damaged.
  [[nodiscard]] std::optional<Sizes> sizes(std::uint64_t share, std::uint64_t block) const;

  [[nodiscard]] std::string path(std::uint64_t share, std::uint64_t block) const;

 private:
  /// Makes room for so many bytes, and returns where; null if the array cannot have so many.
  using MakeRoom = std::function<std::byte*(std::uint64_t bytes)>;

  template <class Array>
  static MakeRoom room_in(Array& array) {
    using Value = typename Array::value_type;
    static_assert(std::is_trivially_copyable_v<Value>);
    return [&array](std::uint64_t bytes) -> std::byte* {
      if (bytes % sizeof(Value) != 0) return nullptr;
      array.resize(static_cast<std::size_t>(bytes / sizeof(Value)));
      return std::as_writable_bytes(std::span(array)).data();
    };
  }

  void write_arrays(std::uint64_t share, std::uint64_t block, std::span<const std::span<const std::byte>> arrays) const;
  bool read_arrays(std::uint64_t share, std::uint64_t block, std::span<const MakeRoom> rooms) const;

  std::string folder_;
  Fingerprint job_;
  int rank_;
};

/// All: which blocks of share 0 of a store are not there by their headers, the same for all ranks. Makes the folder.
/// Throws as on_all() does.
[[nodiscard]] std::vector<std::uint64_t> missing_blocks(const BlockStore& store, std::span<const std::uint64_t> blocks,
                                                        Ranks& ranks);

}  // namespace shaftcull::batch
