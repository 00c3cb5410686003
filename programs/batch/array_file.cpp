// SPDX-License-Identifier: MIT
#include "batch/array_file.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "batch/hdf5_handle.hpp"
#include "batch/mapped_file.hpp"
#include "batch/npy_header.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes are read as they are in files");

struct NumberType {
  Number number;
  const char* name;
  const char* numpy;  ///< NumPy's name of the type in files
  std::size_t bytes;
};
/// In the order of the enumeration.
constexpr std::array number_types{
    NumberType{Number::float32, "float32", "<f4", 4}, NumberType{Number::float64, "float64", "<f8", 8},
    NumberType{Number::int32, "int32", "<i4", 4},     NumberType{Number::uint32, "uint32", "<u4", 4},
    NumberType{Number::int64, "int64", "<i8", 8},     NumberType{Number::uint64, "uint64", "<u8", 8},
};
constexpr std::string_view known = "float32, float64, int32, uint32, int64 and uint64, little-endian";

const NumberType& type_of(Number number) noexcept { return number_types[static_cast<std::size_t>(number)]; }

hid_t hdf5_type(Number number) {
  switch (number) {
    case Number::float32:
      return H5T_IEEE_F32LE;
    case Number::float64:
      return H5T_IEEE_F64LE;
    case Number::int32:
      return H5T_STD_I32LE;
    case Number::uint32:
      return H5T_STD_U32LE;
    case Number::int64:
      return H5T_STD_I64LE;
    case Number::uint64:
      break;
  }
  return H5T_STD_U64LE;
}

/// Where the name of a dataset begins: behind the colon of "FILE:/dataset".
std::optional<std::size_t> dataset_at(const std::string& name) {
  const std::size_t colon = name.rfind(":/");
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  return colon + 1;
}

}  // namespace

std::size_t bytes_of(Number number) noexcept { return type_of(number).bytes; }

const char* name_of(Number number) noexcept { return type_of(number).name; }

struct ArrayFile::Source {
  std::unique_ptr<MappedFile> file;
  const std::byte* bytes = nullptr;  // of all rows, at any alignment, or null
  Hdf5Handle hdf5;
  Hdf5Handle dataset;
  std::mutex mutex;  // HDF5 of Debian takes calls of one thread at a time
};

ArrayFile::ArrayFile(std::string name) : name_(std::move(name)), source_(std::make_unique<Source>()) {
  std::vector<std::uint64_t> shape;
  const auto refuse = [&](const std::string& why) { throw InvalidArgument(fmt::format("{}: {}", name_, why)); };
  const auto check_shape = [&] {
    if (shape.size() != 2) {
      refuse(fmt::format("its shape is ({}); an array of rows and columns is needed", fmt::join(shape, ", ")));
    }
    rows_ = shape[0];
    columns_ = static_cast<std::size_t>(shape[1]);
    constexpr std::uint64_t most_columns = 1'000'000;
    if (shape[1] == 0 || shape[1] > most_columns || shape[0] > (std::uint64_t{1} << 60) / row_bytes()) {
      refuse(fmt::format("its shape is ({}), which no file can hold", fmt::join(shape, ", ")));
    }
  };

  const std::optional<std::size_t> dataset = dataset_at(name_);
  if (!dataset) {
    source_->file = std::make_unique<MappedFile>(name_);
    const std::span<const std::byte> bytes(source_->file->data(), source_->file->size());
    if (!begins_as_npy(bytes)) {
      const bool hdf5 = bytes.size() >= 8 && std::memcmp(bytes.data(), "\x89HDF\r\n\x1a\n", 8) == 0;
      refuse(hdf5 ? "is an HDF5 file; name the dataset in it, as in FILE.h5:/dataset"
                  : "is not a .npy file of NumPy; a dataset of an HDF5 file is named FILE.h5:/dataset");
    }
    const NpyHeader header = read_npy_header(bytes, name_);
    bool found = false;
    for (const NumberType& type : number_types) {
      if (header.type != type.numpy) continue;
      number_ = type.number;
      found = true;
    }
    if (!found) refuse(fmt::format("holds numbers of NumPy's type {}; supported types are {}", header.type, known));
    shape = header.shape;
    check_shape();
    if (header.fortran_order && columns_ > 1) {
      refuse("it is stored column by column (fortran_order); save numpy.ascontiguousarray() of it");
    }
    const std::uint64_t bytes_needed = rows_ * row_bytes();
    if (bytes.size() - header.data_at < bytes_needed) {
      refuse(fmt::format("is cut short: its header states {}, {} bytes, but only {} are there", this->shape(),
                         bytes_needed, bytes.size() - header.data_at));
    }
    source_->bytes = bytes.data() + header.data_at;
    if (header.data_at % bytes_of(number_) == 0) mapped_ = source_->bytes;
    return;
  }

  const QuietHdf5 quiet;
  const std::string path = name_.substr(0, *dataset - 1);
  static_cast<void>(MappedFile(path));  // the plainer message of what is not there
  source_->hdf5 = {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
  if (!source_->hdf5) refuse(fmt::format("{} cannot be read as HDF5: {}", path, hdf5_reason()));
  source_->dataset = {H5Dopen2(source_->hdf5, name_.c_str() + *dataset, H5P_DEFAULT), H5Dclose};
  if (!source_->dataset) refuse(fmt::format("{} has no dataset of that name: {}", path, hdf5_reason()));
  const Hdf5Handle type(H5Dget_type(source_->dataset), H5Tclose);
  bool found = false;
  for (const NumberType& known_type : number_types) {
    if (H5Tequal(type, hdf5_type(known_type.number)) <= 0) continue;
    number_ = known_type.number;
    found = true;
  }
  if (!found) refuse(fmt::format("holds numbers of an unsupported type; supported types are {}", known));
  const Hdf5Handle space(H5Dget_space(source_->dataset), H5Sclose);
  const int axes = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extents(axes > 0 ? static_cast<std::size_t>(axes) : 0);
  if (axes > 0) H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  shape.assign(extents.begin(), extents.end());
  check_shape();

  const Hdf5Handle properties(H5Dget_create_plist(source_->dataset), H5Pclose);
  const haddr_t at = H5Dget_offset(source_->dataset);
  if (H5Pget_layout(properties) == H5D_CONTIGUOUS && H5Pget_external_count(properties) == 0 && at != HADDR_UNDEF) {
    auto file = std::make_unique<MappedFile>(path);
    if (at + rows_ * row_bytes() > file->size()) refuse(fmt::format("{} is cut short", path));
    source_->file = std::move(file);
    source_->bytes = source_->file->data() + at;
    if (at % bytes_of(number_) == 0) mapped_ = source_->bytes;
  }
}

ArrayFile::~ArrayFile() = default;

std::string ArrayFile::shape() const { return fmt::format("({}, {}) of {}", rows_, columns_, name_of(number_)); }

std::span<const std::byte> ArrayFile::read(std::uint64_t first, std::uint64_t count,
                                           std::vector<std::byte>& scratch) const {
  if (mapped_ != nullptr) return {mapped_ + first * row_bytes(), count * row_bytes()};
  scratch.resize(count * row_bytes());
  if (count == 0) return scratch;
  if (source_->bytes != nullptr) {
    std::memcpy(scratch.data(), source_->bytes + first * row_bytes(), scratch.size());
    return scratch;
  }
  const std::lock_guard lock(source_->mutex);
  const QuietHdf5 quiet;
  const std::array<hsize_t, 2> start{first, 0};
  const std::array<hsize_t, 2> size{count, columns_};
  const Hdf5Handle file_space(H5Dget_space(source_->dataset), H5Sclose);
  const Hdf5Handle memory_space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
  if (H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) < 0 ||
      H5Dread(source_->dataset, hdf5_type(number_), memory_space, file_space, H5P_DEFAULT, scratch.data()) < 0) {
    throw std::runtime_error(
        fmt::format("{}: rows {} to {} cannot be read: {}", name_, first, first + count - 1, hdf5_reason()));
  }
  return scratch;
}

void ArrayFile::read_ahead(std::uint64_t first, std::uint64_t count) const noexcept {
  if (source_->bytes == nullptr) return;
  const auto rows_at = static_cast<std::uint64_t>(source_->bytes - source_->file->data());
  source_->file->read_ahead(rows_at + first * row_bytes(), count * row_bytes());
}

}  // namespace shaftcull::batch
