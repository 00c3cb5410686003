// SPDX-License-Identifier: MIT
#include "support/arguments.hpp"

#include <string>

#include "shaftcull/error.hpp"
#include "support/fail.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {

void refuse_null(const char* what, std::size_t size, const char* noun) {
  kernel::fail(InvalidArgument(std::string(what) + " is null; it must point to the first of " + std::to_string(size) +
                               " " + noun));
}

void refuse_view(const char* noun, std::span<const float* const> streams, std::size_t count) {
  if (count > most_floats) {
    kernel::fail(InvalidArgument(std::string(noun) + ".count = " + std::to_string(count) +
                                 " is more than memory can hold, " + std::to_string(most_floats)));
  }
  std::size_t null = 0;
  while (streams[null] != nullptr) ++null;
  kernel::fail(InvalidArgument(std::string(noun) + ".stream[" + std::to_string(null) +
                               "] is null; it must point to the first of " + std::to_string(count) + " floats"));
}

void refuse_bound(const char* noun, std::size_t i, const std::string& why) {
  kernel::fail(BadBound(i, std::string(noun) + " " + std::to_string(i) + " " + why));
}

void refuse_order(const char* noun, std::size_t i, std::size_t axis, float lo, float hi) {
  const std::string name(1, "xyz"[axis]);
  refuse_bound(noun, i, "has lo > hi: lo." + name + " = " + text(lo) + " is above hi." + name + " = " + text(hi));
}

void refuse_form(Form form) {
  kernel::fail(InvalidArgument("form = " + std::to_string(static_cast<unsigned>(form)) +
                               " is neither Form::slab nor Form::planes"));
}

void refuse_contact(Contact contact) {
  kernel::fail(InvalidArgument("contact = " + std::to_string(static_cast<unsigned>(contact)) +
                               " is neither Contact::closed nor Contact::open"));
}

void refuse_triangle_test(const char* what, TriangleTest test) {
  kernel::fail(InvalidArgument(std::string(what) + " = " + std::to_string(static_cast<unsigned>(test)) +
                               " is neither TriangleTest::exact nor TriangleTest::vertices"));
}

void refuse_words(const char* what, std::size_t size, std::size_t bounds) {
  kernel::fail(InvalidArgument(std::string(what) + " has " + counted(size, "word") + "; the answers of " +
                               counted(bounds, "bound") + " take " + std::to_string(bit_words(bounds))));
}

void refuse_rows(const char* what, std::size_t size, std::size_t shafts, std::size_t row_words) {
  const bool overflows = row_words != 0 && shafts > std::numeric_limits<std::size_t>::max() / row_words;
  kernel::fail(InvalidArgument(std::string(what) + " has " + counted(size, "word") + "; " + counted(shafts, "shaft") +
                               " times bit_words(bounds.count) = " + counted(row_words, "word") + " need " +
                               (overflows ? "more than memory can hold" : std::to_string(shafts * row_words))));
}

void refuse_counts(const char* what, std::size_t size, std::size_t shafts) {
  kernel::fail(InvalidArgument(std::string(what) + " has room for " + std::to_string(size) + "; " +
                               counted(shafts, "shaft") + " need one each"));
}

void refuse_shaft_bits(const char* what, std::size_t size, std::size_t shafts) {
  kernel::fail(InvalidArgument(std::string(what) + " has " + counted(size, "word") + "; one bit for each of " +
                               counted(shafts, "shaft") + " takes " + std::to_string(bit_words(shafts))));
}

void refuse_index_width(const char* call, std::size_t bounds) {
  kernel::fail(InvalidArgument(std::string(call) + "() got " + std::to_string(bounds) +
                               " bounds, but 32-bit indices reach " +
                               std::to_string(std::numeric_limits<std::uint32_t>::max()) + "; ask slices of the view"));
}

void refuse_shared_memory(const char* call, const char* one, const char* other) {
  kernel::fail(InvalidArgument(std::string(call) + ": " + one + " and " + other +
                               " share memory; what is written needs memory of its own"));
}

void refuse_index(const char* what, std::size_t position, std::uint64_t index, std::size_t bounds) {
  kernel::fail(InvalidArgument(std::string(what) + "[" + std::to_string(position) + "] = " + std::to_string(index) +
                               " is not below the number of bounds, " + std::to_string(bounds)));
}

}  // namespace shaftcull::kernel
