// SPDX-License-Identifier: MIT
#include <shaftcull.h>
#include <stdio.h>

int main(void) {
  const shaftcull_box a = {{0, 0, 0}, {1, 1, 1}};
  const shaftcull_box b = {{8, 8, 0}, {9, 9, 1}};
  const shaftcull_box boxes[2] = {{{4, 4, 0}, {5, 5, 1}}, {{8, 0, 0}, {9, 1, 1}}};
  const shaftcull_source from = shaftcull_boxes(&a, 1);
  const shaftcull_source to = shaftcull_boxes(&b, 1);
  const shaftcull_source source = shaftcull_boxes(boxes, 2);
  shaftcull_bounds* stream = NULL;
  shaftcull_shafts* shafts = NULL;
  uint64_t kept = 0;
  if (shaftcull_stream_create(&source, &stream) != SHAFTCULL_OK ||
      shaftcull_shafts_create(1, &shafts) != SHAFTCULL_OK ||
      shaftcull_shafts_set_between(shafts, 0, 1, &from, &to, NULL, NULL, SHAFTCULL_CONTACT_CLOSED) != SHAFTCULL_OK ||
      shaftcull_cull(shafts, 0, 1, stream, NULL, &kept, 1) != SHAFTCULL_OK) {
    printf("%s\n", shaftcull_error_message());
  }
  printf("kept %u\n", (unsigned)kept);
  shaftcull_shafts_free(shafts);
  shaftcull_bounds_free(stream);
  return 0;
}
