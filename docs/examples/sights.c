/* How many pairs of windows need rays? */
#include <shaftcull.h>
#include <stdio.h>

/* [[all]] */
/* Adds up how many pairs need rays. Blocks are answers for whole runs of patches. */
static int32_t on_batch(const shaftcull_sight_batch* batch, void* user) {
  *(uint64_t*)user += batch->undecided.count; /* pairs, and their candidates, are there, too */
  return 0;                                   /* anything else ends the call */
}

static shaftcull_status count_rays(const shaftcull_box* patches, const shaftcull_plane* planes,
                                   uint64_t count, const shaftcull_box* walls,
                                   uint64_t wall_count, uint64_t* rays) {
  const shaftcull_source patch_boxes = shaftcull_boxes(patches, count);
  const shaftcull_source solids = shaftcull_boxes(walls, wall_count);
  shaftcull_patches* set = NULL;
  shaftcull_occluders* occluders = NULL;
  *rays = 0;
  shaftcull_status status = shaftcull_patches_create(&patch_boxes, planes, count, &set);
  if (status == SHAFTCULL_OK) status = shaftcull_occluders_create(&occluders);
  if (status == SHAFTCULL_OK) status = shaftcull_occluders_add_solids(occluders, &solids, NULL);
  if (status == SHAFTCULL_OK)
    status = shaftcull_visibility(set, NULL, occluders, NULL, on_batch, rays, NULL);
  shaftcull_occluders_free(occluders);
  shaftcull_patches_free(set);
  return status;
}
/* [[end]] */

int main(void) {
  /* Four windows on each side of a street, and a house between the first of them. */
  shaftcull_box windows[8];
  shaftcull_plane planes[8];
  for (int i = 0; i != 8; ++i) {
    const float x = (float)(i % 4 * 3);
    const float y = i < 4 ? 0.0F : 20.0F;
    const shaftcull_box window = {{x, y, 1}, {x + 1, y, 2}};
    const shaftcull_plane plane = {{0, i < 4 ? 1.0F : -1.0F, 0}, i < 4 ? y : -y};
    windows[i] = window;
    planes[i] = plane;
  }
  const shaftcull_box house = {{-9, 9, -1}, {4.5F, 11, 9}};
  uint64_t rays = 0;
  if (count_rays(windows, planes, 8, &house, 1, &rays) != SHAFTCULL_OK) {
    fprintf(stderr, "%s\n", shaftcull_error_message());
    return 1;
  }
  printf("%u of 28 pairs need rays\n", (unsigned)rays);
  return 0;
}
