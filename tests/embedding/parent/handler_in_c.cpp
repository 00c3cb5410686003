// SPDX-License-Identifier: MIT
// The same through the C interface: errors of the library, and those that the interface finds itself.
#include <shaftcull.h>

#include <cstdio>
#include <cstdlib>

namespace {

void end(shaftcull_status status, const char* message, uint64_t position) {
  const bool right = status == SHAFTCULL_BAD_BOUND && position == 1;
  std::printf("told: %s\n", right ? message : shaftcull_status_name(status));
  std::fflush(stdout);
  std::_Exit(7);
}

}  // namespace

int main(int arguments, char** /*argument*/) {
  if (arguments > 1) {
    if (shaftcull_set_error_handler(end) != nullptr || shaftcull_set_error_handler(end) != end) return 0;
  }
  const shaftcull_box boxes[2] = {{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {0, 1, 1}}};
  const shaftcull_source source = shaftcull_boxes(boxes, 2);
  shaftcull_bounds* bounds = nullptr;
  static_cast<void>(shaftcull_stream_create(&source, &bounds));
  return 0;
}
