/* The snippets of docs/ten-minutes.md, in one program. */
#include <shaftcull.h>
#include <stdio.h>
#include <stdlib.h>

/* [[status]] */
static void must(shaftcull_status status) {
  if (status != SHAFTCULL_OK) {
    fprintf(stderr, "%s\n", shaftcull_error_message());
    exit(1);
  }
}
/* [[end]] */

int main(void) {
  /* [[first cull]] */
  const shaftcull_box lamp = {{0, 9, 0}, {1, 10, 1}};
  const shaftcull_box table = {{4, 0, 4}, {6, 1, 6}};
  shaftcull_box scene[3] = {
      {{2, 4, 2}, {3, 5, 3}}, {{8, 0, 0}, {9, 3, 1}}, {{4, -1, 4}, {6, 0, 6}}};

  const shaftcull_source source = shaftcull_boxes(scene, 3);
  shaftcull_bounds* boxes = NULL;
  must(shaftcull_stream_create(&source, &boxes)); /* checked, aligned, in separate streams */
  shaftcull_shafts* shaft = NULL;                 /* an array of one shaft */
  must(shaftcull_shafts_create(1, &shaft));
  const shaftcull_source from = shaftcull_boxes(&lamp, 1);
  const shaftcull_source to = shaftcull_boxes(&table, 1);
  must(shaftcull_shafts_set_between(shaft, 0, 1, &from, &to, NULL, NULL,
                                    SHAFTCULL_CONTACT_CLOSED));
  uint64_t kept = 0;
  must(shaftcull_cull(shaft, 0, 1, boxes, NULL, &kept, 1)); /* bit i: box i may be between */
  for (int i = 0; i != 3; ++i) printf("box %d %s\n", i, kept >> i & 1 ? "may" : "cannot");
  /* [[end]] */

  /* [[many shafts]] */
  const shaftcull_box ends[3] = {lamp, table, {{9, 9, 9}, {9, 9, 9}}};
  const shaftcull_index_pair pairs[3] = {{0, 1}, {0, 2}, {1, 2}};
  const shaftcull_source end_boxes = shaftcull_boxes(ends, 3);
  shaftcull_shafts* shafts = NULL;
  must(shaftcull_shafts_create(3, &shafts));
  must(shaftcull_shafts_set_between(shafts, 0, 3, &end_boxes, &end_boxes, pairs, NULL,
                                    SHAFTCULL_CONTACT_CLOSED));

  shaftcull_lists* lists = NULL;
  must(shaftcull_lists_create(&lists));
  must(shaftcull_list_many(shafts, 0, 3, boxes, NULL, lists)); /* in parallel */
  shaftcull_lists_info info;
  must(shaftcull_lists_describe(lists, &info));
  for (int s = 0; s != 3; ++s) {
    printf("shaft %d keeps %u\n", s, (unsigned)(info.offsets[s + 1] - info.offsets[s]));
  }
  /* [[end]] */

  /* [[tree]] */
  shaftcull_bounds* tree = NULL;
  must(shaftcull_tree_create(&source, &tree)); /* sorted once; takes the same queries */
  const uint32_t floor_box = 2;                /* is left out */
  const shaftcull_query without = {.exclude = &floor_box, .exclude_count = 1};
  must(shaftcull_list_many(shafts, 0, 3, tree, &without, lists));
  must(shaftcull_lists_describe(lists, &info));
  uint64_t any = 0;
  must(shaftcull_any(shafts, 0, 1, tree, NULL, &any));
  printf("%u without box 2, %s\n", (unsigned)info.offsets[1],
         any ? "some with it" : "none with it");
  /* [[end]] */

  /* [[frames]] */
  const float step[3] = {0.5F, 0, 0};
  uint64_t count = 0;
  for (int frame = 0; frame != 3; ++frame) {
    for (int i = 0; i != 3; ++i) must(shaftcull_translated(&scene[i], step, 0, &scene[i]));
    must(shaftcull_bounds_update(tree, 0, &source)); /* takes no memory, sorts nothing */
    /* Form shafts again: nanoseconds. */
    must(shaftcull_shafts_set_between(shaft, 0, 1, &from, &to, NULL, NULL,
                                      SHAFTCULL_CONTACT_CLOSED));
    must(shaftcull_count(shaft, 0, 1, tree, NULL, &count));
    printf("frame %d: %u\n", frame, (unsigned)count);
  }
  shaftcull_tree_info about;
  must(shaftcull_tree_describe(tree, &about));
  if (about.sah_ratio > 2) must(shaftcull_tree_rebuild(tree)); /* when much has moved far */
  /* [[end]] */

  /* [[kinds]] */
  shaftcull_shafts* kinds = NULL;
  must(shaftcull_shafts_create(4, &kinds));
  const shaftcull_box crate = {{3, 8, 2}, {4, 9, 3}};
  const float travel[3] = {0, -6, 0};
  const float towards_sun[3] = {-1, 2, -1};
  const float corners[12] = {0, 0, 0, 4, 0, 0, 0, 9, 0, 5, 5, 5};
  const shaftcull_source body = shaftcull_boxes(&crate, 1);
  const shaftcull_source first = shaftcull_boxes(&scene[0], 1);
  must(shaftcull_shafts_set_swept(kinds, 0, 1, &body, travel, SHAFTCULL_SWEPT, NULL, 0));
  must(shaftcull_shafts_set_swept(kinds, 1, 1, &to, towards_sun, SHAFTCULL_SWEPT_INFINITE, NULL,
                                  0));
  must(shaftcull_shafts_set_shadow(kinds, 2, 1, &from, &first, NULL, NULL, NULL));
  shaftcull_hull* hull = NULL;
  must(shaftcull_hull_create(corners, 4, 0, NULL, 0, SHAFTCULL_HULL_EXACT, &hull));
  must(shaftcull_shafts_set_hull(kinds, 3, hull));
  shaftcull_hull_free(hull); /* the array keeps what it needs */
  uint64_t counts[4] = {0};
  must(shaftcull_count(kinds, 0, 4, tree, NULL, counts));
  printf("%u %u %u %u\n", (unsigned)counts[0], (unsigned)counts[1], (unsigned)counts[2],
         (unsigned)counts[3]);

  shaftcull_contact_found contact = {0};
  must(shaftcull_first_contact(kinds, 0, 1, tree, NULL, &contact));
  const unsigned index = (unsigned)contact.index;
  if (contact.found)
    printf("first box %u, after %.2f of the way\n", index, (double)contact.time);
  /* [[end]] */

  /* [[contact]] */
  const shaftcull_box floor = {{-9, -1, -9}, {9, 0, 9}}; /* the table stands on it */
  shaftcull_answer closed = SHAFTCULL_OUTSIDE;
  shaftcull_answer open = SHAFTCULL_OUTSIDE;
  must(shaftcull_classify_one(shaft, 0, SHAFTCULL_BOXES, &floor, 0, &closed));
  must(shaftcull_shafts_set_contact(shaft, 0, 1, SHAFTCULL_CONTACT_OPEN));
  must(shaftcull_classify_one(shaft, 0, SHAFTCULL_BOXES, &floor, 0, &open));
  printf("closed: %d, open: %d\n", closed != SHAFTCULL_OUTSIDE, open != SHAFTCULL_OUTSIDE);
  /* [[end]] */

  /* [[occluded]] */
  const shaftcull_box wall = {{-9, 5, -9}, {9, 6, 9}}; /* solid: it fills its box */
  uint32_t occluded = 0;
  must(shaftcull_occluded_by(shaft, 0, (const float*)&wall, 2, &occluded));
  printf("%s\n", occluded ? "the lamp does not light the table" : "it may");
  /* [[end]] */

  /* [[errors]] */
  scene[1].lo[0] = 99; /* beyond hi */
  if (shaftcull_bounds_update(boxes, 0, &source) == SHAFTCULL_BAD_BOUND) {
    printf("%s\n", shaftcull_error_message());
  }
  /* [[end]] */

  /* [[free]] */
  shaftcull_lists_free(lists);
  shaftcull_shafts_free(kinds);
  shaftcull_shafts_free(shafts);
  shaftcull_shafts_free(shaft);
  shaftcull_bounds_free(tree);
  shaftcull_bounds_free(boxes);
  /* [[end]] */
  return 0;
}
