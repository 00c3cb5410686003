// SPDX-License-Identifier: MIT
#include "batch/result_file.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "batch/hdf5_handle.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::uint64_t bytes_a_chunk = std::uint64_t{1} << 20;

struct Dataset {
  const char* name;
  hid_t type;
  std::uint64_t size;
};

std::vector<Dataset> datasets(Answer answer, std::uint64_t shafts, const std::array<std::uint64_t, 2>& totals) {
  switch (answer) {
    case Answer::count:
      return {{"counts", H5T_STD_U64LE, shafts}};
    case Answer::list:
      return {{"offsets", H5T_STD_U64LE, shafts + 1}, {"indices", H5T_STD_U64LE, totals[0]}};
    case Answer::classify:
      return {{"overlap/offsets", H5T_STD_U64LE, shafts + 1},
              {"overlap/indices", H5T_STD_U64LE, totals[0]},
              {"inside/offsets", H5T_STD_U64LE, shafts + 1},
              {"inside/indices", H5T_STD_U64LE, totals[1]}};
    case Answer::first:
      return {{"index", H5T_STD_I64LE, shafts}, {"time", H5T_IEEE_F32LE, shafts}};
    case Answer::occluded:
      break;
  }
  return {{"occluded", H5T_STD_U8LE, shafts}};
}

/// Gives what HDF5 returned, or throws if that is a failure.
template <class Result>
Result checked(Result result, const std::string& path) {
  if (result < 0) throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, hdf5_reason()));
  return result;
}

void add_attribute(hid_t file, const std::string& path, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle space(checked(H5Screate(H5S_SCALAR), path), H5Sclose);
  const Hdf5Handle attribute(checked(H5Acreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), path),
                             H5Aclose);
  checked(H5Awrite(attribute, type, value), path);
}

/// Makes a dataset, and returns where its numbers begin.
std::uint64_t make_dataset(hid_t file, const std::string& path, const Dataset& dataset) {
  const hsize_t size = dataset.size;
  const hsize_t chunk = std::min<hsize_t>(bytes_a_chunk / H5Tget_size(dataset.type), size);
  const Hdf5Handle space(checked(H5Screate_simple(1, &size, nullptr), path), H5Sclose);
  const Hdf5Handle properties(checked(H5Pcreate(H5P_DATASET_CREATE), path), H5Pclose);
  checked(H5Pset_obj_track_times(properties, false), path);
  checked(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY), path);
  checked(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), path);
  if (size != 0) checked(H5Pset_chunk(properties, 1, &chunk), path);
  const Hdf5Handle links(checked(H5Pcreate(H5P_LINK_CREATE), path), H5Pclose);
  const Hdf5Handle made(
      checked(H5Dcreate2(file, dataset.name, dataset.type, space, links, properties, H5P_DEFAULT), path), H5Dclose);
  if (size == 0) return 0;
  const auto place_of = [&](hsize_t element) {
    unsigned filters = 0;
    haddr_t address = HADDR_UNDEF;
    hsize_t bytes = 0;
    checked(H5Dget_chunk_info_by_coord(made, &element, &filters, &address, &bytes), path);
    return address;
  };
  const haddr_t begin = place_of(0);
  const hsize_t last = (size - 1) / chunk;
  if (begin == HADDR_UNDEF || place_of(last * chunk) != begin + last * chunk * H5Tget_size(dataset.type)) {
    throw std::runtime_error(
        fmt::format("{}: this HDF5 does not store the chunks of {} one after another", path, dataset.name));
  }
  return begin;
}

template <class T>
void write_numbers(WrittenFile& file, std::uint64_t begin, std::uint64_t first, const std::vector<T>& numbers) {
  file.write_at(begin + first * sizeof(T), std::as_bytes(std::span(numbers)));
}

}  // namespace

std::size_t datasets_of(Answer answer) noexcept {
  switch (answer) {
    case Answer::count:
    case Answer::occluded:
      return 1;
    case Answer::list:
    case Answer::first:
      return 2;
    case Answer::classify:
      break;
  }
  return 4;
}

ResultPlaces make_result_file(const std::string& path, Answer answer, std::uint64_t shafts,
                              const std::array<std::uint64_t, 2>& list_totals, const ResultDescription& description) {
  const QuietHdf5 quiet;
  const Hdf5Handle creation(checked(H5Pcreate(H5P_FILE_CREATE), path), H5Pclose);
  checked(H5Pset_obj_track_times(creation, false), path);
  const Hdf5Handle access(checked(H5Pcreate(H5P_FILE_ACCESS), path), H5Pclose);
  // Chunks that are allocated early are then in one piece, without an index.
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), path);
  Hdf5Handle file(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), path), H5Fclose);
  for (const auto& [name, text] : description.texts) {
    const Hdf5Handle type(checked(H5Tcopy(H5T_C_S1), path), H5Tclose);
    checked(H5Tset_size(type, text.size() + 1), path);
    add_attribute(file, path, name, type, text.c_str());
  }
  for (const auto& [name, number] : description.numbers) add_attribute(file, path, name, H5T_STD_U64LE, &number);
  if (answer == Answer::classify) {
    const Hdf5Handle properties(checked(H5Pcreate(H5P_GROUP_CREATE), path), H5Pclose);
    checked(H5Pset_obj_track_times(properties, false), path);
    for (const char* const name : {"overlap", "inside"}) {
      const Hdf5Handle group(checked(H5Gcreate2(file, name, H5P_DEFAULT, properties, H5P_DEFAULT), path), H5Gclose);
    }
  }
  ResultPlaces places;
  for (const Dataset& dataset : datasets(answer, shafts, list_totals)) {
    places.push_back(make_dataset(file, path, dataset));
  }
  if (!file.close()) throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, hdf5_reason()));
  return places;
}

void write_block(WrittenFile& file, const ResultPlaces& places, Answer answer, std::uint64_t shafts,
                 std::uint64_t first, std::uint64_t count, const std::array<std::uint64_t, 2>& list_begins,
                 const BlockAnswer& block) {
  const auto size = static_cast<std::size_t>(count);
  switch (answer) {
    case Answer::count: {
      std::vector<std::uint64_t> counts(size);
      for (std::size_t i = 0; i != block.rows.size(); ++i) counts[block.rows[i]] = block.numbers[i];
      write_numbers(file, places[0], first, counts);
      break;
    }
    case Answer::first: {
      std::vector<std::int64_t> indices(size, -1);
      std::vector<float> times(size, std::numeric_limits<float>::infinity());
      for (std::size_t i = 0; i != block.rows.size(); ++i) {
        indices[block.rows[i]] = static_cast<std::int64_t>(block.numbers[i]);
        times[block.rows[i]] = block.times[i];
      }
      write_numbers(file, places[0], first, indices);
      write_numbers(file, places[1], first, times);
      break;
    }
    case Answer::occluded: {
      std::vector<std::uint8_t> occluded(size);
      for (const std::uint32_t row : block.rows) occluded[row] = 1;
      write_numbers(file, places[0], first, occluded);
      break;
    }
    case Answer::list:
    case Answer::classify:
      for (std::size_t l = 0; l != lists_of(answer); ++l) {
        const BlockLists& lists = block.lists[l];
        std::vector<std::uint64_t> offsets(size);
        for (std::size_t i = 0; i != block.rows.size(); ++i) offsets[block.rows[i]] = lists.sizes[i];
        std::uint64_t at = list_begins[l];
        for (std::uint64_t& offset : offsets) at += std::exchange(offset, at);
        if (first + count == shafts) offsets.push_back(at);
        write_numbers(file, places[2 * l], first, offsets);
        write_numbers(file, places[2 * l + 1], list_begins[l], lists.indices);
      }
      break;
  }
}

}  // namespace shaftcull::batch
