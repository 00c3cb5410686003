// SPDX-License-Identifier: MIT
/// Arrays that a job reads: .npy files and datasets of HDF5, whole, damaged and of other kinds.
#include "batch/array_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <cstring>
#include <functional>
#include <numeric>

#include "batch/npy.hpp"
#include "message_of.hpp"

namespace shaftcull::test {
namespace {

using batch::ArrayFile;
using batch::Number;
using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const std::string& name) {
  return message_of([&] { const ArrayFile array(name); });
}

template <class T>
std::vector<T> rows_of(const ArrayFile& array, std::uint64_t first, std::uint64_t count) {
  std::vector<std::byte> scratch;
  const std::span<const std::byte> bytes = array.read(first, count, scratch);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::vector<float> counted(std::size_t size) {
  std::vector<float> values(size);
  std::iota(values.begin(), values.end(), 0.5F);
  return values;
}

TEST(BatchArrayFile, NpyIsMappedAndReadByRows) {
  const BatchFolder folder;
  write_floats(folder.path("a.npy"), 4, counted(40));
  const ArrayFile array(folder.path("a.npy"));
  EXPECT_EQ(array.rows(), 10);
  EXPECT_EQ(array.columns(), 4);
  EXPECT_EQ(array.number(), Number::float32);
  ASSERT_NE(array.mapped(), nullptr);
  EXPECT_EQ(rows_of<float>(array, 2, 1), (std::vector<float>{8.5F, 9.5F, 10.5F, 11.5F}));
  EXPECT_EQ(rows_of<float>(array, 10, 0), std::vector<float>{});
}

TEST(BatchArrayFile, NpyOfOtherVersionsAndAtAnyAlignmentIsRead) {
  const BatchFolder folder;
  const std::string dictionary = "{'descr': '<u8', 'fortran_order': False, 'shape': (2, 2), }";
  std::string bytes("\x93NUMPY\x02\x00", 8);
  for (int i = 0; i != 4; ++i) bytes += static_cast<char>(dictionary.size() >> (8 * i) & 0xff);
  bytes += dictionary;
  const std::array<std::uint64_t, 4> values{1, 2, std::uint64_t{1} << 40, 4};
  bytes.append(reinterpret_cast<const char*>(values.data()), sizeof(values));
  write_file(folder.path("a.npy"), bytes);
  const ArrayFile array(folder.path("a.npy"));
  EXPECT_EQ(array.number(), Number::uint64);
  EXPECT_EQ(array.mapped(), nullptr) << "numbers at odd addresses are copied";
  EXPECT_EQ(rows_of<std::uint64_t>(array, 1, 1), (std::vector<std::uint64_t>{std::uint64_t{1} << 40, 4}));
}

TEST(BatchArrayFile, WhatIsNoArrayOfRowsIsRefusedByName) {
  const BatchFolder folder;
  const std::string path = folder.path("a.npy");
  const auto with = [&](const std::string& dictionary, std::size_t bytes = 64) {
    write_file(path, npy_header(dictionary) + std::string(bytes, '\0'));
    std::string why = refusal(path);
    EXPECT_THAT(why, testing::StartsWith(path + ": "));
    return why;
  };
  EXPECT_THAT(with("{'descr': '<f2', 'fortran_order': False, 'shape': (2, 4), }"),
              HasSubstr("type <f2; supported types are float32"));
  EXPECT_THAT(with("{'descr': '>f4', 'fortran_order': False, 'shape': (2, 4), }"), HasSubstr("type >f4"));
  EXPECT_THAT(with("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (2, 4), }"), HasSubstr("type a record"));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 4), }"), HasSubstr("ascontiguousarray"));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': False, 'shape': (8,), }"), HasSubstr("shape is (8)"));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 2), }"), HasSubstr("shape is (2, 2, 2)"));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 0), }"), HasSubstr("no file can hold"));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': False, 'shape': (9, 2), }"),
              AllOf(HasSubstr("cut short"), HasSubstr("72 bytes, but only 64 are there")));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': False, 'shape': (1152921504606846975, 2), }"),
              HasSubstr("no file can hold"));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999, 2), }"),
              HasSubstr("shape is not made of numbers"));
  EXPECT_THAT(with("{'descr': '<f4', 'shape': (2, 4), }"), HasSubstr("fortran_order"));
  EXPECT_THAT(with("{'descr': '<f4', 'fortran_order': False}"), HasSubstr("no shape"));
}

TEST(BatchArrayFile, WhatIsNoNpyFileIsRefusedByName) {
  const BatchFolder folder;
  EXPECT_THAT(refusal(folder.path("none.npy")), HasSubstr("none.npy: cannot be read: No such file"));
  EXPECT_THAT(refusal(folder.path("")), HasSubstr("not a regular file"));
  write_file(folder.path("empty.npy"), "");
  EXPECT_THAT(refusal(folder.path("empty.npy")), HasSubstr("is not a .npy file"));
  write_file(folder.path("text.npy"), "1 2 3\n");
  EXPECT_THAT(refusal(folder.path("text.npy")), HasSubstr("is not a .npy file"));
  write_file(folder.path("torn.npy"), "\x93NUMPY\x01");
  EXPECT_THAT(refusal(folder.path("torn.npy")), HasSubstr("ends within its header"));
  write_file(folder.path("long.npy"), std::string("\x93NUMPY\x01\x00\xff\xff{}      ", 18));
  EXPECT_THAT(refusal(folder.path("long.npy")), HasSubstr("ends within its header"));
  write_file(folder.path("new.npy"), std::string("\x93NUMPY\x09\x00\x02\x00{}      ", 18));
  EXPECT_THAT(refusal(folder.path("new.npy")), HasSubstr("version is 9"));
}

/// Makes an HDF5 file with the dataset /g/a, as `store` says.
void write_hdf5(
    const std::string& path, hid_t type, const std::vector<hsize_t>& shape, const void* values,
    const std::function<void(hid_t)>& store = [](hid_t) {}) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t group = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  store(properties);
  const hid_t dataset = H5Dcreate2(group, "a", type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0);
  H5Dclose(dataset);
  H5Pclose(properties);
  H5Sclose(space);
  H5Gclose(group);
  EXPECT_GE(H5Fclose(file), 0);
}

TEST(BatchArrayFile, DatasetsAreReadHoweverTheyAreStored) {
  const BatchFolder folder;
  const std::vector<float> values = counted(60);
  write_hdf5(folder.path("whole.h5"), H5T_IEEE_F32LE, {10, 6}, values.data());
  write_hdf5(folder.path("chunks.h5"), H5T_IEEE_F32LE, {10, 6}, values.data(), [](hid_t properties) {
    const std::array<hsize_t, 2> chunk{3, 4};
    H5Pset_chunk(properties, 2, chunk.data());
    H5Pset_shuffle(properties);
    H5Pset_fletcher32(properties);
  });
  const ArrayFile whole(folder.path("whole.h5") + ":/g/a");
  const ArrayFile chunks(folder.path("chunks.h5") + ":/g/a");
  EXPECT_NE(whole.mapped(), nullptr);
  EXPECT_EQ(chunks.mapped(), nullptr);
  for (const ArrayFile* const array : {&whole, &chunks}) {
    EXPECT_EQ(array->rows(), 10);
    EXPECT_EQ(array->columns(), 6);
    EXPECT_EQ(rows_of<float>(*array, 0, 10), values);
    EXPECT_EQ(rows_of<float>(*array, 7, 2), std::vector<float>(values.begin() + 42, values.begin() + 54));
  }
}

TEST(BatchArrayFile, WhatIsNoDatasetOfRowsIsRefusedByName) {
  const BatchFolder folder;
  const std::vector<std::int16_t> values(12);
  write_hdf5(folder.path("a.h5"), H5T_STD_I16LE, {2, 6}, values.data());
  EXPECT_THAT(refusal(folder.path("a.h5") + ":/g/a"), HasSubstr("a.h5:/g/a: holds numbers of an unsupported type"));
  EXPECT_THAT(refusal(folder.path("a.h5") + ":/g"), HasSubstr("no dataset of that name"));
  EXPECT_THAT(refusal(folder.path("a.h5") + ":/b"), HasSubstr("no dataset of that name"));
  EXPECT_THAT(refusal(folder.path("a.h5")), HasSubstr("name the dataset in it"));
  EXPECT_THAT(refusal(folder.path("none.h5") + ":/g/a"), HasSubstr("No such file"));
  write_hdf5(folder.path("one.h5"), H5T_IEEE_F32LE, {6}, values.data());
  EXPECT_THAT(refusal(folder.path("one.h5") + ":/g/a"), HasSubstr("shape is (6)"));
  write_hdf5(folder.path("big_endian.h5"), H5T_IEEE_F32BE, {1, 6}, values.data());
  EXPECT_THAT(refusal(folder.path("big_endian.h5") + ":/g/a"), HasSubstr("unsupported type"));
  write_file(folder.path("text.h5"), "no HDF5");
  EXPECT_THAT(refusal(folder.path("text.h5") + ":/g/a"), HasSubstr("cannot be read as HDF5"));
}

TEST(BatchArrayFile, RowsThatAreDamagedAreNotRead) {
  const BatchFolder folder;
  const std::vector<float> values = counted(600);
  write_hdf5(folder.path("a.h5"), H5T_IEEE_F32LE, {100, 6}, values.data(), [](hid_t properties) {
    const std::array<hsize_t, 2> chunk{100, 6};
    H5Pset_chunk(properties, 2, chunk.data());
    H5Pset_fletcher32(properties);
  });
  std::string bytes = bytes_of_file(folder.path("a.h5"));
  const std::string number(reinterpret_cast<const char*>(&values[300]), 4);
  const std::size_t at = bytes.find(number);
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  write_file(folder.path("a.h5"), bytes);
  const ArrayFile array(folder.path("a.h5") + ":/g/a");
  EXPECT_THROW(static_cast<void>(rows_of<float>(array, 0, 1)), std::runtime_error);
}

}  // namespace
}  // namespace shaftcull::test
