// SPDX-License-Identifier: MIT
#include "visibility/visibility_arguments.hpp"

#include <cmath>

#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::size_t least_memory = std::size_t{1} << 20;
constexpr std::uint32_t most_rays = 65536;

void require_tolerance(float tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    kernel::fail(InvalidArgument("tolerance is " + text(tolerance) + "; it is finite and not below 0"));
  }
}

}  // namespace

void refuse_sight(const std::string& what, Sight sight, const std::string& whose) {
  kernel::fail(InvalidArgument(what + " = " + std::to_string(static_cast<unsigned>(sight)) + whose +
                               " is none of Sight::undecided, Sight::clear, Sight::occluded and Sight::facing_away"));
}

void require_options(const VisibilityOptions& options) {
  require_contact(options.contact);
  if (options.memory < least_memory) {
    kernel::fail(
        InvalidArgument("memory is " + std::to_string(options.memory) + " bytes; it takes 1 MB (1048576) or more"));
  }
  require_part(options.part, options.parts);
  kernel::in_float_environment([&] { require_tolerance(options.tolerance); });
}

void require_part(std::uint32_t part, std::uint32_t parts) {
  if (parts == 0) kernel::fail(InvalidArgument("parts is 0; it is 1 or more"));
  if (part < parts) return;
  kernel::fail(InvalidArgument("part is " + std::to_string(part) + "; of " + counted(parts, "part") + ", it is 0" +
                               (parts == 1 ? "" : " to " + std::to_string(parts - 1))));
}

void require_rays(std::uint32_t rays, double error, float tolerance) {
  if (rays == 0 || rays > most_rays) {
    kernel::fail(
        InvalidArgument("rays is " + std::to_string(rays) + "; a pair gets 1 to " + std::to_string(most_rays)));
  }
  if (!(error >= 0)) kernel::fail(InvalidArgument("error is " + std::to_string(error) + "; it is 0 or more"));
  require_tolerance(tolerance);
}

void require_rows(std::span<const std::uint64_t> bits, std::size_t a, std::size_t b) {
  const std::size_t words = bit_words(b);
  // No product of such numbers overflows where there are 64-bit sizes; elsewhere no span has so many words.
  const std::uint64_t needed = std::uint64_t{a} * words;
  if (bits.size() != needed) {
    kernel::fail(InvalidArgument("bits has " + counted(bits.size(), "word") + "; " + counted(a, "row") +
                                 ", one for each patch of a, of bit_words(" + std::to_string(b) +
                                 ") = " + counted(words, "word") + ", a bit for each patch of b, take " +
                                 std::to_string(needed)));
  }
  require_memory("bits", bits, "words");
}

void require_callback(const FunctionRef<void(const SightBatch&)>& deliver) {
  if (!deliver) kernel::fail(InvalidArgument("deliver is empty; it is called with the answers"));
}

}  // namespace shaftcull::kernel
