// SPDX-License-Identifier: MIT
/// Calls every function of the C interface from plain C11, and provokes every kind of error. This program shows that C
/// can compile, link and use all of it, with few bounds; agreement.cpp has scenes.
#include <math.h>
#include <shaftcull.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

static void check(int holds, const char* what, int line) {
  if (holds) return;
  ++failures;
  fprintf(stderr, "line %d: %s does not hold; the last error is: %s\n", line, what, shaftcull_error_message());
}
#define CHECK(condition) check(condition, #condition, __LINE__)
#define OK(call) check((call) == SHAFTCULL_OK, #call " == SHAFTCULL_OK", __LINE__)

/* The call must fail with this status, and its message must have this part. */
static void check_failure(shaftcull_status given, shaftcull_status expected, const char* part, const char* call,
                          int line) {
  if (given == expected && strstr(shaftcull_error_message(), part) != NULL) return;
  ++failures;
  fprintf(stderr, "line %d: %s gave \"%s\" and says \"%s\"; \"%s\" and \"%s\" were expected\n", line, call,
          shaftcull_status_name(given), shaftcull_error_message(), shaftcull_status_name(expected), part);
}
#define REFUSED(call, part) check_failure((call), SHAFTCULL_INVALID_ARGUMENT, part, #call, __LINE__)
#define FAILS(call, status, part) check_failure((call), status, part, #call, __LINE__)

/* A light, a table, and two boxes: the first may stand between them, the second cannot. */
static const shaftcull_box lamp = {{0, 9, 0}, {1, 10, 1}};
static const shaftcull_box table = {{4, 0, 4}, {6, 1, 6}};
static const shaftcull_box scene[2] = {{{2, 4, 2}, {3, 5, 3}}, {{8, 0, 0}, {9, 3, 1}}};
static const shaftcull_sphere balls[2] = {{{2.5F, 4.5F, 2.5F}, 0.25F}, {{8.5F, 2, 0.5F}, 0.25F}};
static const shaftcull_triangle faces[2] = {{{{2, 4, 2}, {3, 5, 3}, {3, 4, 2}}}, {{{8, 0, 0}, {9, 3, 1}, {9, 0, 0}}}};
static const shaftcull_plane floor_plane = {{0, -1, 0}, 0}; /* y >= 0 */
static const float down[3] = {0, -1, 0};
static const float nan_vector[4] = {NAN, 0, 0, 0};
static const float light[4] = {1, 10, 1, 1};
static const float sun[4] = {0, -1, 0, 0};
static const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.02F, 3, 0, 0, -1, 4};
static const float corners[24] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 9, 9, 0, 0, 0, 9, 9, 0, 9, 0, 9, 9, 9, 9, 9};

/* Is never called: this build has exceptions, so functions return what went wrong. */
static void never_told(shaftcull_status status, const char* message, uint64_t position) {
  (void)status, (void)message, (void)position;
  abort();
}

static void versions_and_names(void) {
  CHECK(shaftcull_version() == SHAFTCULL_HEADER_VERSION);
  CHECK(strcmp(shaftcull_error_message(), "") == 0); /* no call has failed yet */
  CHECK(shaftcull_error_position() == SHAFTCULL_NONE);
  CHECK(shaftcull_set_error_handler(never_told) == NULL);
  static const char* const names[] = {"ok",      "invalid argument", "bad bound", "needs refit", "out of memory",
                                      "stopped", "internal error"};
  for (int status = 0; status != 7; ++status) CHECK(strcmp(shaftcull_status_name(status), names[status]) == 0);
  CHECK(strcmp(shaftcull_status_name(7), "unknown status") == 0);
  CHECK(strcmp(shaftcull_status_name(-1), "unknown status") == 0);
}

static void values(void) {
  CHECK(shaftcull_bit_words(0) == 0 && shaftcull_bit_words(64) == 1 && shaftcull_bit_words(65) == 2);
  CHECK(shaftcull_bit_words(UINT64_MAX) == UINT64_MAX / 64 + 1);
  shaftcull_box box;
  OK(shaftcull_box_around(corners, 8, &box));
  CHECK(box.lo[0] == 0 && box.hi[2] == 9);
  OK(shaftcull_box_around(NULL, 0, &box));
  CHECK(box.lo[0] == INFINITY && box.hi[0] == -INFINITY);
  const float bad_points[6] = {1, 2, 3, 4, NAN, 6};
  FAILS(shaftcull_box_around(bad_points, 2, &box), SHAFTCULL_BAD_BOUND, "1");
  CHECK(shaftcull_error_position() == 1);
  REFUSED(shaftcull_box_around(NULL, 2, &box), "points is NULL");
  CHECK(shaftcull_error_position() == SHAFTCULL_NONE);
  REFUSED(shaftcull_box_around(corners, UINT64_MAX, &box), "points");
  REFUSED(shaftcull_box_around(corners, 8, NULL), "box is NULL");

  OK(shaftcull_translated(&lamp, down, 0, &box));
  CHECK(box.lo[1] == 8 && box.hi[1] == 9);
  OK(shaftcull_translated(&lamp, NULL, 1, &box));
  CHECK(box.lo[0] == -1 && box.hi[0] == 2);
  OK(shaftcull_translated(&lamp, down, 1, &box));
  CHECK(box.lo[1] == 7 && box.hi[1] == 10);
  REFUSED(shaftcull_translated(&lamp, nan_vector, 0, &box), "finite");
  REFUSED(shaftcull_translated(&lamp, down, -1, &box), "by = -1");
  REFUSED(shaftcull_translated(NULL, down, 0, &box), "box is NULL");
  REFUSED(shaftcull_translated(&lamp, down, 0, NULL), "moved is NULL");

  const double origin[3] = {4512345, 500000, 100};
  const double world_box[6] = {4512345.25, 500001, 100, 4512346.1, 500002, 101};
  const double world_sphere[4] = {4512346, 500000, 100, 0.1};
  float relative[6] = {0, 0, 0, 0, 0, 0};
  OK(shaftcull_relative(origin, SHAFTCULL_BOXES_AROUND, world_box, 1, relative));
  CHECK(relative[0] == 0.25F && relative[1] == 1 && relative[2] == 0 && relative[4] == 2 && relative[5] == 1);
  CHECK(relative[3] > 1.0999F && (double)relative[3] >= world_box[3] - origin[0]);
  OK(shaftcull_relative(origin, SHAFTCULL_BOXES_WITHIN, world_box, 1, relative));
  CHECK(relative[0] == 0.25F && relative[3] > 1.0999F && (double)relative[3] <= world_box[3] - origin[0]);
  OK(shaftcull_relative(origin, SHAFTCULL_SPHERES_AROUND, world_sphere, 1, relative));
  CHECK(relative[0] == 1 && relative[1] == 0 && (double)relative[3] >= 0.1 && relative[3] < 0.1000001F);
  OK(shaftcull_relative(origin, SHAFTCULL_NEAREST, world_box, 2, relative));
  CHECK(relative[0] == 0.25F && relative[3] == (float)(world_box[3] - origin[0]));
  OK(shaftcull_relative(origin, SHAFTCULL_NEAREST, NULL, 0, NULL));
  REFUSED(shaftcull_relative(NULL, SHAFTCULL_NEAREST, world_box, 2, relative), "origin is NULL");
  const double world_planes[14] = {4512345, 500000, 100, 4512347, 500002, 102, 1, 0, 0, 4512346.1, 0, -1, 0, -500001};
  float planes_there[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  OK(shaftcull_relative(origin, SHAFTCULL_PLANES_AROUND, world_planes, 2, planes_there));
  CHECK(planes_there[0] == 1 && planes_there[3] > 1.0999F && (double)planes_there[3] >= 4512346.1 - origin[0]);
  CHECK(planes_there[5] == -1 && planes_there[7] == -1);
  OK(shaftcull_relative(origin, SHAFTCULL_PLANES_AROUND, NULL, 0, NULL));
  REFUSED(shaftcull_relative(origin, SHAFTCULL_PLANES_AROUND, NULL, 2, planes_there), "from is NULL");
  const double steep[10] = {0, 0, 0, 1, 1, 1, 1e39, 0, 0, 0};
  REFUSED(shaftcull_relative(origin, SHAFTCULL_PLANES_AROUND, steep, 1, planes_there), "plane 0 has a normal beyond");
  CHECK(planes_there[0] == 1 && planes_there[5] == -1);
  REFUSED(shaftcull_relative(origin, 5, world_box, 1, relative), "rounding = 5");
  REFUSED(shaftcull_relative(origin, SHAFTCULL_BOXES_AROUND, NULL, 1, relative), "from is NULL");
  REFUSED(shaftcull_relative(origin, SHAFTCULL_BOXES_AROUND, world_box, 1, NULL), "to is NULL");
  REFUSED(shaftcull_relative(origin, SHAFTCULL_BOXES_AROUND, world_box, UINT64_MAX, relative), "from");
  const double nowhere[3] = {0, INFINITY, 0};
  REFUSED(shaftcull_relative(nowhere, SHAFTCULL_NEAREST, world_box, 2, relative), "finite");

  shaftcull_plane planes[6];
  uint64_t count = 0;
  OK(shaftcull_view_planes(matrix, SHAFTCULL_DEPTH_ZERO_TO_ONE, planes, &count));
  CHECK(count == 6);
  REFUSED(shaftcull_view_planes(matrix, 2, planes, &count), "depth = 2");
  REFUSED(shaftcull_view_planes(matrix, 256, planes, &count), "depth = 256"); /* not cut to a byte */
  REFUSED(shaftcull_view_planes(NULL, 0, planes, &count), "matrix is NULL");
  REFUSED(shaftcull_view_planes(matrix, 0, NULL, &count), "planes is NULL");
  REFUSED(shaftcull_view_planes(matrix, 0, planes, NULL), "count is NULL");

  static const shaftcull_box pieces[2] = {{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}};
  shaftcull_box merged[2];
  uint64_t merged_count = 0;
  OK(shaftcull_merged_boxes(pieces, 2, merged, 2, &merged_count));
  CHECK(merged_count == 1 && merged[0].lo[0] == 0 && merged[0].hi[0] == 2);
  OK(shaftcull_merged_boxes(pieces, 2, NULL, 0, &merged_count));
  CHECK(merged_count == 1);
  static const shaftcull_box reversed[2] = {{{0, 0, 0}, {0, 1, 1}}, {{1, 1, 1}, {0, 0, 0}}};
  FAILS(shaftcull_merged_boxes(reversed, 2, merged, 2, &merged_count), SHAFTCULL_BAD_BOUND, "1");
  REFUSED(shaftcull_merged_boxes(NULL, 2, merged, 2, &merged_count), "boxes is NULL");
  REFUSED(shaftcull_merged_boxes(pieces, 2, NULL, 2, &merged_count), "merged is NULL");
  REFUSED(shaftcull_merged_boxes(pieces, 2, merged, 2, NULL), "merged_count is NULL");
  OK(shaftcull_inscribed_box(corners, 8, &box));
  CHECK(box.lo[0] >= 0 && box.hi[0] <= 9 && box.hi[0] - box.lo[0] > 1);
  REFUSED(shaftcull_inscribed_box(corners, 3, &box), "4");
  REFUSED(shaftcull_inscribed_box(NULL, 8, &box), "corners is NULL");
  REFUSED(shaftcull_inscribed_box(corners, 8, NULL), "box is NULL");

  static const float floor_of_cube[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  static const float ceiling[12] = {0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0, 1};
  double factor = 0;
  OK(shaftcull_view_factor(floor_of_cube, 4, ceiling, 4, &factor));
  CHECK(factor > 0.19982 && factor < 0.19983);
  REFUSED(shaftcull_view_factor(floor_of_cube, 2, ceiling, 4, &factor), "2 corners");
  REFUSED(shaftcull_view_factor(NULL, 4, ceiling, 4, &factor), "from is NULL");
  REFUSED(shaftcull_view_factor(floor_of_cube, 4, NULL, 4, &factor), "to is NULL");
  REFUSED(shaftcull_view_factor(floor_of_cube, 4, ceiling, 4, NULL), "factor is NULL");
}

static void hulls(void) {
  shaftcull_hull* hull = NULL;
  OK(shaftcull_hull_create(corners, 8, 0, down, 1, SHAFTCULL_HULL_CONSERVATIVE, &hull));
  shaftcull_hull_info info;
  OK(shaftcull_hull_describe(hull, &info));
  CHECK(info.box.lo[1] == -INFINITY && info.box.hi[1] == 9 && info.point_count == 8 && info.direction_count == 1);
  CHECK(memcmp(info.points, corners, sizeof corners) == 0 && info.directions[1] == -1);
  REFUSED(shaftcull_hull_describe(NULL, &info), "hull is NULL");
  REFUSED(shaftcull_hull_describe(hull, NULL), "info is NULL");
  shaftcull_hull_free(hull);
  shaftcull_hull_free(NULL);
  shaftcull_hull* view = NULL;
  OK(shaftcull_hull_of_frustum(matrix, SHAFTCULL_DEPTH_ZERO_TO_ONE, SHAFTCULL_HULL_EXACT, &view));
  shaftcull_hull_free(view);
  OK(shaftcull_hull_of_frustum(matrix, SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE, SHAFTCULL_HULL_CONSERVATIVE, &view));
  OK(shaftcull_hull_of_casters(view, light, &hull));
  OK(shaftcull_hull_describe(hull, &info));
  CHECK(info.point_count == 9 && info.direction_count == 0 && info.directions == NULL);
  shaftcull_hull_free(hull);
  OK(shaftcull_hull_of_casters(view, sun, &hull));
  shaftcull_hull_free(hull);
  hull = NULL;
  REFUSED(shaftcull_hull_create(NULL, 0, 0, NULL, 0, 0, &hull), "point");
  REFUSED(shaftcull_hull_create(NULL, 8, 0, NULL, 0, 0, &hull), "points is NULL");
  REFUSED(shaftcull_hull_create(corners, 8, 0, NULL, 1, 0, &hull), "directions is NULL");
  REFUSED(shaftcull_hull_create(corners, 8, 0, nan_vector, 1, 0, &hull), "direction");
  REFUSED(shaftcull_hull_create(corners, 8, 0, NULL, 0, 0, NULL), "hull is NULL");
  REFUSED(shaftcull_hull_create(corners, 8, 0, NULL, 0, 2, &hull), "test = 2");
  REFUSED(shaftcull_hull_create(corners, 8, 8, NULL, 0, 0, &hull), "first_end = 8");
  REFUSED(shaftcull_hull_create(corners, 8, 4, down, 1, 0, &hull), "direction_count");
  REFUSED(shaftcull_hull_of_frustum(matrix, 2, 0, &hull), "depth = 2");
  REFUSED(shaftcull_hull_of_frustum(matrix, 0, 2, &hull), "test = 2");
  REFUSED(shaftcull_hull_of_frustum(NULL, 0, 0, &hull), "matrix is NULL");
  REFUSED(shaftcull_hull_of_frustum(matrix, 0, 0, NULL), "hull is NULL");
  REFUSED(shaftcull_hull_of_casters(NULL, light, &hull), "view is NULL");
  REFUSED(shaftcull_hull_of_casters(view, NULL, &hull), "light is NULL");
  REFUSED(shaftcull_hull_of_casters(view, nan_vector, &hull), "finite");
  REFUSED(shaftcull_hull_of_casters(view, light, NULL), "hull is NULL");
  const float half_a_light[4] = {1, 10, 1, 0.5F};
  REFUSED(shaftcull_hull_of_casters(view, half_a_light, &hull), "light[3] = 0.5");
  CHECK(hull == NULL);
  shaftcull_hull_free(view);
}

/* Sets one shaft of an array. */
static void set_between(shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_box* a, const shaftcull_box* b) {
  const shaftcull_source from = shaftcull_boxes(a, 1);
  const shaftcull_source to = shaftcull_boxes(b, 1);
  OK(shaftcull_shafts_set_between(shafts, shaft, 1, &from, &to, NULL, NULL, SHAFTCULL_CONTACT_CLOSED));
}

/* An array of three shafts: from lamp to table, below the lamp, and a hull. */
static shaftcull_shafts* three_shafts(void) {
  shaftcull_shafts* shafts = NULL;
  OK(shaftcull_shafts_create(3, &shafts));
  const shaftcull_source body = shaftcull_boxes(&lamp, 1);
  set_between(shafts, 0, &lamp, &table);
  OK(shaftcull_shafts_set_swept(shafts, 1, 1, &body, down, SHAFTCULL_SWEPT_INFINITE, &floor_plane, 1));
  shaftcull_hull* hull = NULL;
  OK(shaftcull_hull_create(corners, 8, 0, NULL, 0, SHAFTCULL_HULL_EXACT, &hull));
  OK(shaftcull_shafts_set_hull(shafts, 2, hull));
  shaftcull_hull_free(hull); /* the array keeps what it needs */
  return shafts;
}

static void arrays_of_shafts(void) {
  shaftcull_shafts* shafts = three_shafts();
  shaftcull_shafts_info info;
  OK(shaftcull_shafts_describe(shafts, 0, &info));
  CHECK(memcmp(&info.a, &lamp, sizeof lamp) == 0 && memcmp(&info.b, &table, sizeof table) == 0);
  CHECK(info.formed == 1 && info.has_planes == 0 && info.contact == SHAFTCULL_CONTACT_CLOSED && info.is_hull == 0);
  OK(shaftcull_shafts_complete(shafts, 0, 1));
  OK(shaftcull_shafts_set_contact(shafts, 0, 2, SHAFTCULL_CONTACT_OPEN));
  OK(shaftcull_shafts_describe(shafts, 0, &info));
  CHECK(info.has_planes == 1 && info.contact == SHAFTCULL_CONTACT_OPEN);
  OK(shaftcull_shafts_describe(shafts, 2, &info));
  CHECK(info.is_hull == 1 && info.a.lo[0] == 0 && info.a.hi[0] == 9);
  REFUSED(shaftcull_shafts_describe(shafts, 3, &info), "shaft = 3 is not below the number of shafts, 3");
  REFUSED(shaftcull_shafts_describe(NULL, 0, &info), "shafts is NULL");
  REFUSED(shaftcull_shafts_describe(shafts, 0, NULL), "info is NULL");
  REFUSED(shaftcull_shafts_complete(shafts, 2, 2), "3 shafts of the array");
  REFUSED(shaftcull_shafts_complete(shafts, 1, UINT64_MAX), "3 shafts of the array");
  REFUSED(shaftcull_shafts_complete(NULL, 0, 0), "shafts is NULL");
  OK(shaftcull_shafts_set_contact(shafts, 2, 1, SHAFTCULL_CONTACT_OPEN));
  OK(shaftcull_shafts_describe(shafts, 2, &info));
  CHECK(info.is_hull == 1 && info.contact == SHAFTCULL_CONTACT_OPEN);
  OK(shaftcull_shafts_set_contact(shafts, 2, 1, SHAFTCULL_CONTACT_CLOSED));
  REFUSED(shaftcull_shafts_set_contact(shafts, 0, 1, 2), "contact = 2");
  REFUSED(shaftcull_shafts_set_contact(NULL, 0, 1, 0), "shafts is NULL");

  /* Copies, of a hull too, which stays when both the hull and the first array are gone. */
  shaftcull_shafts* copies = NULL;
  OK(shaftcull_shafts_create(4, &copies));
  OK(shaftcull_shafts_describe(copies, 0, &info));
  CHECK(info.formed == 0 && info.a.lo[0] == INFINITY);
  OK(shaftcull_shafts_copy(copies, 1, shafts, 0, 3));
  REFUSED(shaftcull_shafts_copy(copies, 2, shafts, 0, 3), "4 shafts of the array");
  REFUSED(shaftcull_shafts_copy(copies, 0, shafts, 1, 3), "3 shafts of the array");
  REFUSED(shaftcull_shafts_copy(NULL, 0, shafts, 0, 1), "shafts is NULL");
  REFUSED(shaftcull_shafts_copy(copies, 0, NULL, 0, 1), "source is NULL");
  shaftcull_shafts_free(shafts);
  OK(shaftcull_shafts_describe(copies, 3, &info));
  CHECK(info.is_hull == 1);
  OK(shaftcull_shafts_copy(copies, 0, copies, 1, 3)); /* forwards, overlapping */
  OK(shaftcull_shafts_copy(copies, 1, copies, 0, 3)); /* and backwards */
  for (uint64_t s = 0; s != 4; ++s) {
    OK(shaftcull_shafts_describe(copies, s, &info));
    CHECK(info.is_hull == (s == 3) && info.contact == (s < 3 ? SHAFTCULL_CONTACT_OPEN : SHAFTCULL_CONTACT_CLOSED));
  }
  shaftcull_answer answer = 99;
  OK(shaftcull_classify_one(copies, 3, SHAFTCULL_BOXES, &scene[0], 0, &answer));
  CHECK(answer == SHAFTCULL_INSIDE);
  set_between(copies, 3, &lamp, &table); /* no hull any more */
  OK(shaftcull_shafts_describe(copies, 3, &info));
  CHECK(info.is_hull == 0);
  shaftcull_shafts_free(copies);
  shaftcull_shafts_free(NULL);

  OK(shaftcull_shafts_create(4, &shafts));
  const shaftcull_box bad = {{NAN, 0, 0}, {1, 1, 1}};
  const float reach = 2;
  const float half = 0.5F;
  const shaftcull_source a_lamp = shaftcull_boxes(&lamp, 1);
  const shaftcull_source a_table = shaftcull_boxes(&table, 1);
  const shaftcull_source a_bad = shaftcull_boxes(&bad, 1);
  const shaftcull_source nowhere = shaftcull_boxes(NULL, 1);
  const shaftcull_source none = shaftcull_boxes(NULL, 0);
  const shaftcull_batch_planes two_floors = {&floor_plane, 1, &floor_plane, 1};
  OK(shaftcull_shafts_set_swept(shafts, 0, 1, &a_lamp, down, SHAFTCULL_SWEPT, NULL, 0));
  OK(shaftcull_shafts_set_shadow(shafts, 1, 1, &a_lamp, &a_table, NULL, &reach, &two_floors));
  OK(shaftcull_shafts_set_shadow(shafts, 1, 1, &a_lamp, &a_table, NULL, NULL, NULL));
  OK(shaftcull_shafts_set_between(shafts, 4, 0, &none, &none, NULL, NULL, SHAFTCULL_CONTACT_CLOSED));
  FAILS(shaftcull_shafts_set_between(shafts, 0, 1, &a_bad, &a_table, NULL, NULL, 0), SHAFTCULL_BAD_BOUND,
        "box a: lo.x = nan");
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 1, &a_lamp, NULL, NULL, NULL, 0), "b is NULL");
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 1, &a_lamp, &nowhere, NULL, NULL, 0), "b.first is NULL");
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 1, &a_lamp, &a_table, NULL, NULL, 2), "contact = 2");
  REFUSED(shaftcull_shafts_set_between(shafts, 4, 1, &a_lamp, &a_table, NULL, NULL, 0), "4 shafts of the array");
  REFUSED(shaftcull_shafts_set_between(NULL, 0, 1, &a_lamp, &a_table, NULL, NULL, 0), "shafts is NULL");
  FAILS(shaftcull_shafts_set_swept(shafts, 0, 1, &a_lamp, nan_vector, SHAFTCULL_SWEPT, NULL, 0), SHAFTCULL_BAD_BOUND,
        "displacement");
  REFUSED(shaftcull_shafts_set_swept(shafts, 0, 1, &a_lamp, down, SHAFTCULL_SWEPT, NULL, 1), "planes is NULL");
  REFUSED(shaftcull_shafts_set_swept(shafts, 0, 1, &a_lamp, NULL, SHAFTCULL_SWEPT_INFINITE, NULL, 0),
          "displacements is NULL");
  FAILS(shaftcull_shafts_set_shadow(shafts, 0, 1, &a_lamp, &a_lamp, NULL, NULL, NULL), SHAFTCULL_BAD_BOUND, "occluder");
  REFUSED(shaftcull_shafts_set_shadow(shafts, 0, 1, &a_lamp, &a_table, NULL, &half, NULL), "reach");
  REFUSED(shaftcull_shafts_set_hull(shafts, 0, NULL), "hull is NULL");

  /* Several at once. */
  const shaftcull_box lamps[2] = {lamp, lamp};
  const shaftcull_box tables[2] = {table, table};
  const shaftcull_source from = shaftcull_boxes(lamps, 2);
  const shaftcull_source to = shaftcull_boxes(tables, 2);
  const shaftcull_plane planes[2] = {floor_plane, floor_plane};
  const shaftcull_batch_planes batch_planes = {planes, 2, NULL, 0};
  const shaftcull_index_pair pairs[3] = {{0, 1}, {1, 0}, {1, 1}};
  const float vectors[6] = {0, -1, 0, 0, -2, 0};
  OK(shaftcull_shafts_set_between(shafts, 2, 2, &from, &to, NULL, &batch_planes, SHAFTCULL_CONTACT_CLOSED));
  OK(shaftcull_shafts_set_between(shafts, 0, 3, &from, &to, pairs, NULL, SHAFTCULL_CONTACT_OPEN));
  OK(shaftcull_shafts_set_swept(shafts, 0, 2, &from, vectors, SHAFTCULL_SWEPT, planes, 2));
  OK(shaftcull_shafts_set_swept(shafts, 0, 2, &from, vectors, SHAFTCULL_SWEPT_INFINITE, NULL, 0));
  OK(shaftcull_shafts_set_shadow(shafts, 0, 2, &from, &to, NULL, NULL, NULL));
  OK(shaftcull_shafts_set_shadow(shafts, 0, 3, &from, &to, pairs, &reach, &batch_planes));
  const shaftcull_index_pair far_pair = {0, 2};
  const shaftcull_source of_spheres = shaftcull_spheres(balls, 2);
  const shaftcull_box one_bad[2] = {lamp, bad};
  const shaftcull_source bad_source = shaftcull_boxes(one_bad, 2);
  const float bad_vectors[6] = {0, -1, 0, 0, NAN, 0};
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 1, &from, &to, &far_pair, NULL, 0), "2");
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 1, &from, &to, NULL, NULL, 0), "1");
  REFUSED(shaftcull_shafts_set_between(shafts, 3, 2, &from, &to, NULL, NULL, 0), "4 shafts of the array");
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 2, &from, &of_spheres, NULL, NULL, 0),
          "b is a source of other bounds; this call takes boxes");
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 2, NULL, &to, NULL, NULL, 0), "a is NULL");
  FAILS(shaftcull_shafts_set_between(shafts, 0, 2, &bad_source, &to, NULL, NULL, 0), SHAFTCULL_BAD_BOUND,
        "shaft 1: box a: lo.x");
  CHECK(shaftcull_error_position() == 1);
  OK(shaftcull_shafts_set_between(shafts, 0, 1, &bad_source, &to, pairs, NULL, 0)); /* names no bad box */
  FAILS(shaftcull_shafts_set_swept(shafts, 0, 2, &from, bad_vectors, SHAFTCULL_SWEPT, NULL, 0), SHAFTCULL_BAD_BOUND,
        "1");
  CHECK(shaftcull_error_position() == 1);
  REFUSED(shaftcull_shafts_set_swept(shafts, 0, 1, &from, vectors, SHAFTCULL_SWEPT, NULL, 0), "2");
  REFUSED(shaftcull_shafts_set_swept(shafts, 0, 2, &from, NULL, SHAFTCULL_SWEPT, NULL, 0), "displacements is NULL");
  REFUSED(shaftcull_shafts_set_swept(shafts, 0, 2, &from, NULL, SHAFTCULL_SWEPT_INFINITE, NULL, 0),
          "displacements is NULL");
  REFUSED(shaftcull_shafts_set_shadow(shafts, 0, 2, &from, &to, NULL, &half, NULL), "reach");
  const float centres[6] = {0, 9, 0, 1, -1, 1};
  shaftcull_source extents = {SHAFTCULL_SOURCE_CENTRES, 0, 1, centres, centres + 3, 24, NULL, 0, NULL};
  FAILS(shaftcull_shafts_set_between(shafts, 0, 1, &extents, &a_table, NULL, NULL, 0), SHAFTCULL_BAD_BOUND, "box 0");
  extents.second = centres;
  REFUSED(shaftcull_shafts_set_between(shafts, 0, 2, &extents, &to, NULL, NULL, 0), "1");
  shaftcull_shafts_free(shafts);
  REFUSED(shaftcull_shafts_create(UINT64_MAX, &shafts), "memory");
#ifndef SHAFTCULL_SANITIZED /* AddressSanitizer ends the program */
  FAILS(shaftcull_shafts_create(UINT64_MAX / 832 / 4, &shafts), SHAFTCULL_OUT_OF_MEMORY, "memory");
#endif
  REFUSED(shaftcull_shafts_create(1, NULL), "shafts is NULL");
}

static void views_and_streams(void) {
  const float x0[2] = {2, 8};
  const float y0[2] = {4, 0};
  const float z0[2] = {2, 0};
  const float x1[2] = {3, 9};
  const float y1[2] = {5, 3};
  const float z1[2] = {3, 1};
  const float* const streams[6] = {x0, y0, z0, x1, y1, z1};
  const float* const some_null[6] = {x0, y0, z0, x1, NULL, z1};
  shaftcull_bounds* view = NULL;
  OK(shaftcull_view_create(SHAFTCULL_SPHERES, NULL, 0, &view));
  shaftcull_bounds_free(view);
  OK(shaftcull_view_create(SHAFTCULL_TRIANGLES, NULL, 0, &view));
  shaftcull_bounds_free(view);
  OK(shaftcull_view_create(SHAFTCULL_BOXES, streams, 2, &view));
  shaftcull_bounds_info info;
  OK(shaftcull_bounds_describe(view, &info));
  CHECK(info.kind == SHAFTCULL_BOXES && info.holder == SHAFTCULL_VIEW && info.count == 2 && info.memory_bytes == 0);
  const float* const* found = info.streams;
  CHECK(found[0] == x0 && found[5] == z1 && found[6] == NULL && found[8] == NULL);
  CHECK(info.order == NULL && info.layers == NULL && info.box.lo[0] == INFINITY && info.box.hi[0] == -INFINITY);
  shaftcull_bounds* none = NULL;
  REFUSED(shaftcull_view_create(SHAFTCULL_BOXES, some_null, 2, &none), "streams[4] is NULL");
  REFUSED(shaftcull_view_create(SHAFTCULL_BOXES, NULL, 2, &none), "streams is NULL");
  CHECK(none == NULL);
  REFUSED(shaftcull_view_create(4, streams, 2, &view), "kind = 4");
  REFUSED(shaftcull_view_create(0, streams, 2, &view), "kind = 0");
  REFUSED(shaftcull_view_create(SHAFTCULL_BOXES, streams, 2, NULL), "bounds is NULL");
  REFUSED(shaftcull_bounds_describe(NULL, &info), "bounds is NULL");
  REFUSED(shaftcull_bounds_describe(view, NULL), "info is NULL");

  shaftcull_bounds* stream = NULL;
  shaftcull_source source = shaftcull_source_of(view);
  OK(shaftcull_stream_create(&source, &stream));
  OK(shaftcull_bounds_describe(stream, &info));
  CHECK(info.holder == SHAFTCULL_STREAM && info.count == 2 && info.memory_bytes == 64 * 24);
  shaftcull_bounds_free(stream);
  source = shaftcull_spheres(NULL, 2); /* empty spheres */
  OK(shaftcull_stream_create(&source, &stream));
  OK(shaftcull_bounds_describe(stream, &info));
  CHECK(info.kind == SHAFTCULL_SPHERES && info.count == 2 && info.streams[3][1] < 0);
  shaftcull_bounds_free(stream);
  source = shaftcull_triangles(NULL, 2);
  OK(shaftcull_stream_create(&source, &stream));
  const uint32_t indices[6] = {0, 1, 2, 3, 5, 4};
  source = shaftcull_mesh(&faces[0].vertex[0][0], 6, indices, 2);
  OK(shaftcull_bounds_update(stream, 0, &source));
  OK(shaftcull_bounds_describe(stream, &info));
  CHECK(found[3][1] == 9 && found[6][1] == 9 && found[7][1] == 3 && found[8] != NULL);
  const uint32_t far_indices[3] = {0, 1, 6};
  source = shaftcull_mesh(&faces[0].vertex[0][0], 6, far_indices, 1);
  REFUSED(shaftcull_bounds_update(stream, 0, &source), "6");
  shaftcull_bounds_free(stream);
  source = shaftcull_boxes(NULL, 2);
  OK(shaftcull_stream_create(&source, &stream));
  REFUSED(shaftcull_bounds_update(stream, 0, &source), "source.first is NULL");
  source = shaftcull_boxes(scene, 2);
  OK(shaftcull_bounds_update(stream, 0, &source));
  REFUSED(shaftcull_bounds_update(stream, 1, &source), "2");
  REFUSED(shaftcull_bounds_update(NULL, 0, &source), "bounds is NULL");
  REFUSED(shaftcull_bounds_update(stream, 0, NULL), "source is NULL");
  REFUSED(shaftcull_bounds_update(view, 0, &source), "a view of boxes");
  source = shaftcull_spheres(balls, 2);
  REFUSED(shaftcull_bounds_update(stream, 0, &source), "its own kind");
  /* Centres and half extents, and members of a larger record. */
  const float centres[12] = {2.5F, 4.5F, 2.5F, 0.5F, 0.5F, 0.5F, 8.5F, 1.5F, 0.5F, 0.5F, 1.5F, 0.5F};
  memset(&source, 0, sizeof source);
  source.kind = SHAFTCULL_SOURCE_CENTRES;
  source.count = 2;
  source.first = centres;
  source.second = centres + 3;
  source.stride = 6 * sizeof(float);
  OK(shaftcull_bounds_update(stream, 0, &source));
  shaftcull_bounds* copy = NULL;
  OK(shaftcull_bounds_copy(stream, &copy));
  shaftcull_bounds_free(stream);
  OK(shaftcull_bounds_describe(copy, &info));
  CHECK(found[0][0] == 2 && found[4][1] == 3);
  shaftcull_bounds_free(copy);
  shaftcull_bounds_free(NULL);
  REFUSED(shaftcull_bounds_copy(NULL, &copy), "bounds is NULL");
  REFUSED(shaftcull_bounds_copy(view, NULL), "copy is NULL");

  source.count = 1;
  source.vertex_count = 1;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.vertex_count");
  source.vertex_count = 0;
  source.kind = 7;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.kind = 7");
  source.kind = 0;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.kind = 0");
  source = shaftcull_boxes(scene, 2);
  source.second = NULL;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.second is NULL");
  source = shaftcull_spheres(balls, 2);
  source.first = NULL;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.first is NULL");
  source = shaftcull_mesh(NULL, 6, indices, 2);
  REFUSED(shaftcull_stream_create(&source, &stream), "source.first is NULL");
  source = shaftcull_boxes(NULL, 2);
  source.indices = indices;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.indices");
  source = shaftcull_triangles(faces, 2);
  source.reserved = 1;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.reserved");
  source = shaftcull_source_of(NULL);
  REFUSED(shaftcull_stream_create(&source, &stream), "bounds is NULL");
  source = shaftcull_source_of(view);
  source.count = 1;
  REFUSED(shaftcull_stream_create(&source, &stream), "source.count");
  const shaftcull_sphere negative[3] = {balls[0], balls[1], {{0, 0, 0}, -1}};
  source = shaftcull_spheres(negative, 3);
  FAILS(shaftcull_stream_create(&source, &stream), SHAFTCULL_BAD_BOUND, "2");
  CHECK(shaftcull_error_position() == 2);
  REFUSED(shaftcull_stream_create(&source, NULL), "bounds is NULL");
  REFUSED(shaftcull_stream_create(NULL, &stream), "source is NULL");
  source = shaftcull_boxes(NULL, UINT64_MAX);
  REFUSED(shaftcull_stream_create(&source, &stream), "memory");
#ifndef SHAFTCULL_SANITIZED /* AddressSanitizer ends the program */
  source = shaftcull_boxes(NULL, (uint64_t)1 << 56);
  FAILS(shaftcull_stream_create(&source, &stream), SHAFTCULL_OUT_OF_MEMORY, "memory");
#endif
  shaftcull_bounds_free(view);
}

static void trees(void) {
  shaftcull_source source = shaftcull_boxes(scene, 2);
  shaftcull_bounds* tree = NULL;
  shaftcull_bounds* spheres = NULL;
  shaftcull_bounds* mesh = NULL;
  OK(shaftcull_tree_create(&source, &tree));
  shaftcull_source of_spheres = shaftcull_spheres(balls, 2);
  OK(shaftcull_tree_create(&of_spheres, &spheres));
  shaftcull_source of_triangles = shaftcull_triangles(faces, 2);
  OK(shaftcull_tree_create(&of_triangles, &mesh));
  REFUSED(shaftcull_tree_create(NULL, &tree), "source is NULL");
  REFUSED(shaftcull_tree_create(&source, NULL), "tree is NULL");
  shaftcull_bounds_info info;
  OK(shaftcull_bounds_describe(spheres, &info));
  CHECK(info.kind == SHAFTCULL_SPHERES && info.holder == SHAFTCULL_TREE && info.count == 2 && info.memory_bytes > 0);
  OK(shaftcull_bounds_describe(mesh, &info));
  CHECK(info.kind == SHAFTCULL_TRIANGLES && info.holder == SHAFTCULL_TREE && info.needs_refit == 0);
  CHECK(info.order[0] + info.order[1] == 1 && info.box.lo[0] == 2 && info.streams[8] != NULL);
  OK(shaftcull_bounds_describe(tree, &info));
  CHECK(info.order[0] + info.order[1] == 1 && info.box.lo[0] == 2 && info.box.hi[0] == 9);
  shaftcull_bounds* stream = NULL;
  OK(shaftcull_stream_create(&source, &stream));
  REFUSED(shaftcull_tree_refit(stream), "a stream of boxes; this call takes a tree that is not dynamic");
  shaftcull_bounds_free(stream);
  const shaftcull_source nothing = shaftcull_boxes(NULL, 0);
  OK(shaftcull_tree_create(&nothing, &stream));
  OK(shaftcull_bounds_describe(stream, &info));
  CHECK(info.count == 0 && info.order == NULL && info.box.lo[0] == INFINITY);
  shaftcull_bounds_free(stream);

  OK(shaftcull_bounds_update(tree, 0, &source));
  OK(shaftcull_bounds_update(spheres, 0, &of_spheres));
  const uint32_t index = 1;
  const uint32_t far_index = 2;
  const shaftcull_source one = shaftcull_boxes(scene, 1);
  const shaftcull_source one_ball = shaftcull_spheres(balls, 1);
  OK(shaftcull_tree_update_some(tree, &index, 1, &one));
  OK(shaftcull_tree_update_some(spheres, &index, 1, &one_ball));
  shaftcull_tree_info about;
  FAILS(shaftcull_tree_describe(tree, &about), SHAFTCULL_NEEDS_REFIT, "refit");
  OK(shaftcull_bounds_describe(spheres, &info));
  CHECK(info.needs_refit == 1 && info.box.lo[0] == INFINITY); /* its box is not known */
  OK(shaftcull_tree_refit(tree));
  OK(shaftcull_tree_refit(spheres));
  OK(shaftcull_tree_describe(tree, &about));
  OK(shaftcull_bounds_describe(tree, &info));
  CHECK(about.sah_ratio > 0 && about.bound_count == 2 && about.blocks == 0 && info.needs_refit == 0 &&
        info.box.hi[0] == 3);
  OK(shaftcull_tree_rebuild(tree));
  OK(shaftcull_tree_reorder(tree));
  OK(shaftcull_bounds_describe(tree, &info));
  CHECK(info.order[0] == 0 && info.order[1] == 1);
  REFUSED(shaftcull_bounds_update(tree, 0, &one), "2");
  REFUSED(shaftcull_bounds_update(tree, 1, &one), "first = 1; all bounds of a tree are updated");
  REFUSED(shaftcull_bounds_update(tree, 0, &of_triangles), "kind");
  REFUSED(shaftcull_bounds_update(tree, 0, &of_spheres), "kind");
  OK(shaftcull_bounds_update(mesh, 0, &of_triangles));
  REFUSED(shaftcull_bounds_update(mesh, 0, &of_spheres), "a tree of triangles");
  REFUSED(shaftcull_bounds_update(tree, 0, NULL), "source is NULL");
  const shaftcull_source itself = shaftcull_source_of(tree);
  REFUSED(shaftcull_bounds_update(tree, 0, &itself), "own");
  REFUSED(shaftcull_tree_update_some(tree, &far_index, 1, &one), "2");
  REFUSED(shaftcull_tree_update_some(tree, NULL, 1, &one), "indices is NULL");
  const shaftcull_source one_face = shaftcull_triangles(faces, 1);
  OK(shaftcull_tree_update_some(mesh, &index, 1, &one_face));
  OK(shaftcull_bounds_describe(mesh, &info));
  CHECK(info.needs_refit == 1);
  REFUSED(shaftcull_tree_update_some(mesh, &index, 1, &one), "kind");
  REFUSED(shaftcull_tree_update_some(mesh, &far_index, 1, &one_face), "2");
  REFUSED(shaftcull_tree_refit(NULL), "tree is NULL");
  OK(shaftcull_tree_refit(mesh));
  OK(shaftcull_bounds_describe(mesh, &info));
  CHECK(info.needs_refit == 0 && info.box.hi[0] == 3); /* both are the first one now */
  OK(shaftcull_tree_rebuild(mesh));
  OK(shaftcull_tree_reorder(mesh));
  OK(shaftcull_tree_describe(mesh, &about));
  CHECK(about.sah_ratio == 1 && about.bound_count == 2);
  REFUSED(shaftcull_tree_describe(tree, NULL), "info is NULL");

  shaftcull_bounds_free(tree);
  shaftcull_bounds_free(spheres);
  shaftcull_bounds_free(mesh);
}

/* How many bounds of a dynamic tree or snapshot are in the hull of all. */
static uint64_t count_of(const shaftcull_bounds* bounds) {
  shaftcull_shafts* shafts = three_shafts();
  uint64_t count = 0;
  OK(shaftcull_count(shafts, 2, 1, bounds, NULL, &count));
  shaftcull_shafts_free(shafts);
  return count;
}

static void dynamic_trees(void) {
  const shaftcull_source boxes = shaftcull_boxes(scene, 2);
  const shaftcull_source one_box = shaftcull_boxes(&scene[1], 1);
  const shaftcull_source spheres = shaftcull_spheres(balls, 2);
  const shaftcull_source triangles = shaftcull_triangles(faces, 2);
  const shaftcull_box bad_box = {{1, 0, 0}, {0, 1, 1}};
  const shaftcull_source bad = shaftcull_boxes(&bad_box, 1);
  shaftcull_bounds* tree = NULL;
  shaftcull_bounds* balls_tree = NULL;
  REFUSED(shaftcull_dynamic_tree_create(SHAFTCULL_TRIANGLES, 2, &tree), "kind = 3");
  REFUSED(shaftcull_dynamic_tree_create(SHAFTCULL_BOXES, -1, &tree), "-1");
  REFUSED(shaftcull_dynamic_tree_create(SHAFTCULL_BOXES, 2, NULL), "tree is NULL");
  CHECK(tree == NULL);
  OK(shaftcull_dynamic_tree_create(SHAFTCULL_BOXES, 2, &tree));
  OK(shaftcull_dynamic_tree_create(SHAFTCULL_SPHERES, 0, &balls_tree));

  shaftcull_bound_id ids[2];
  shaftcull_bound_id ball_ids[2];
  const uint32_t layers[2] = {1, 2};
  OK(shaftcull_dynamic_tree_insert(tree, &boxes, layers, ids));
  OK(shaftcull_dynamic_tree_insert(balls_tree, &spheres, NULL, ball_ids));
  CHECK(ids[0].index == 0 && ids[1].index == 1 && ids[0].generation == ids[1].generation);
  CHECK(count_of(tree) == 0); /* before the commit */
  OK(shaftcull_dynamic_tree_commit(tree));
  OK(shaftcull_dynamic_tree_commit(balls_tree));
  CHECK(count_of(tree) == 2 && count_of(balls_tree) == 2);
  shaftcull_bounds_info info;
  OK(shaftcull_bounds_describe(tree, &info));
  CHECK(info.holder == SHAFTCULL_DYNAMIC_TREE && info.kind == SHAFTCULL_BOXES && info.count == 2);
  CHECK(info.memory_bytes > 0 && info.streams[0] == NULL && info.order == NULL && info.box.hi[0] == 9);
  shaftcull_bounds* snapshot = NULL;
  shaftcull_bounds* same = NULL;
  OK(shaftcull_bounds_copy(tree, &snapshot));
  OK(shaftcull_bounds_copy(snapshot, &same));
  OK(shaftcull_bounds_describe(balls_tree, &info));
  CHECK(info.holder == SHAFTCULL_DYNAMIC_TREE && info.kind == SHAFTCULL_SPHERES && info.count == 2);

  /* Layers, of which queries see the change after the next commit. */
  shaftcull_shafts* shafts = three_shafts();
  const uint32_t mask = 4;
  shaftcull_query query;
  memset(&query, 0, sizeof query);
  query.layer_masks = &mask;
  query.layer_mask_count = 1;
  uint64_t count = 9;
  OK(shaftcull_bounds_set_layers(tree, &ids[1].index, &mask, 1));
  OK(shaftcull_count(shafts, 2, 1, tree, &query, &count));
  CHECK(count == 0);
  OK(shaftcull_dynamic_tree_commit(tree));
  OK(shaftcull_count(shafts, 2, 1, tree, &query, &count));
  CHECK(count == 1);
  const uint32_t no_index = 7;
  REFUSED(shaftcull_bounds_set_layers(tree, &no_index, &mask, 1), "indices[0] = 7 has no bound");
  REFUSED(shaftcull_bounds_set_layers(tree, NULL, layers, 2), "indices is NULL");
  REFUSED(shaftcull_bounds_set_layers(snapshot, &no_index, &mask, 1), "a snapshot of boxes, which never changes");

  /* Values, which are seen at once. */
  shaftcull_box values[2];
  shaftcull_sphere sphere;
  OK(shaftcull_dynamic_tree_move(tree, ids, 1, NULL, down));
  OK(shaftcull_dynamic_tree_read(tree, ids, 2, values));
  CHECK(values[0].lo[1] == 3 && values[1].hi[0] == 9);
  OK(shaftcull_dynamic_tree_move(tree, ids, 1, &one_box, NULL));
  OK(shaftcull_dynamic_tree_read(tree, ids, 1, values));
  CHECK(values[0].hi[0] == 9);
  OK(shaftcull_dynamic_tree_read(balls_tree, &ball_ids[1], 1, &sphere));
  CHECK(sphere.radius == 0.25F && sphere.centre[0] == 8.5F);
  OK(shaftcull_dynamic_tree_read(tree, NULL, 0, NULL));

  /* An erased bound has no id any more, and its index another generation. */
  OK(shaftcull_dynamic_tree_erase(tree, &ids[1], 1));
  shaftcull_bound_id again;
  OK(shaftcull_dynamic_tree_insert(tree, &one_box, NULL, &again));
  CHECK(again.index == 1 && again.generation != ids[1].generation);
  REFUSED(shaftcull_dynamic_tree_read(tree, &ids[1], 1, values), "ids[0], index 1 of generation 0, has no bound");
  REFUSED(shaftcull_dynamic_tree_erase(tree, &ids[1], 1), "was erased");
  REFUSED(shaftcull_dynamic_tree_move(tree, &ids[1], 1, &one_box, NULL), "was erased");
  OK(shaftcull_dynamic_tree_erase(tree, &again, 1));
  OK(shaftcull_dynamic_tree_erase(tree, NULL, 0));
  OK(shaftcull_tree_rebuild(tree)); /* commits */
  CHECK(count_of(tree) == 1 && count_of(snapshot) == 2 && count_of(same) == 2);
  shaftcull_tree_info about;
  OK(shaftcull_tree_describe(tree, &about));
  CHECK(about.bound_count == 1 && about.blocks == 1 && about.sah_ratio == 1 && about.sorted_last == 1);
  REFUSED(shaftcull_tree_describe(snapshot, &about), "a snapshot of boxes");

  REFUSED(shaftcull_dynamic_tree_insert(tree, &spheres, NULL, ids), "the tree's kind");
  REFUSED(shaftcull_dynamic_tree_insert(tree, &triangles, NULL, ids), "the tree's kind");
  REFUSED(shaftcull_dynamic_tree_insert(tree, NULL, NULL, ids), "source is NULL");
  REFUSED(shaftcull_dynamic_tree_insert(tree, &boxes, NULL, NULL), "ids is NULL");
  REFUSED(shaftcull_dynamic_tree_insert(NULL, &boxes, NULL, ids), "tree is NULL");
  FAILS(shaftcull_dynamic_tree_insert(tree, &bad, NULL, ids), SHAFTCULL_BAD_BOUND, "lo.x");
  CHECK(shaftcull_error_position() == 0);
  const shaftcull_source itself = shaftcull_source_of(tree);
  REFUSED(shaftcull_dynamic_tree_insert(tree, &itself, NULL, ids), "a dynamic tree of boxes, which is no source");
  REFUSED(shaftcull_dynamic_tree_move(tree, ids, 1, NULL, NULL), "both NULL");
  REFUSED(shaftcull_dynamic_tree_move(tree, ids, 1, &one_box, down), "both given");
  REFUSED(shaftcull_dynamic_tree_move(tree, ids, 1, &boxes, NULL), "2");
  REFUSED(shaftcull_dynamic_tree_move(tree, NULL, 1, &one_box, NULL), "ids is NULL");
  REFUSED(shaftcull_dynamic_tree_read(tree, ids, 1, NULL), "bounds is NULL");
  REFUSED(shaftcull_dynamic_tree_commit(NULL), "tree is NULL");
  REFUSED(shaftcull_dynamic_tree_commit(snapshot), "a snapshot of boxes; this call takes a dynamic tree");
  REFUSED(shaftcull_tree_refit(tree), "a dynamic tree of boxes; this call takes a tree that is not dynamic");
  REFUSED(shaftcull_bounds_update(tree, 0, &boxes), "a dynamic tree of boxes");
  CHECK(count_of(tree) == 1); /* nothing was changed */

  /* Snapshots outlive the tree. */
  shaftcull_bounds_free(tree);
  CHECK(count_of(snapshot) == 2);
  shaftcull_bounds_free(snapshot);
  CHECK(count_of(same) == 2);
  shaftcull_bounds_free(same);
  shaftcull_bounds_free(balls_tree);
  shaftcull_shafts_free(shafts);
}

/* Layers of the boxes, spheres or triangles above, which a query with a mask takes into account. */
static void layers_of(shaftcull_bounds* bounds) {
  const uint32_t layers[2] = {1, 2};
  const uint32_t others[2] = {4, 8};
  const uint32_t twice[2] = {1, 1};
  const uint32_t index = 1;
  const uint32_t far_index = 2;
  shaftcull_bounds_info info;
  OK(shaftcull_bounds_describe(bounds, &info));
  CHECK(info.layers == NULL);
  const uint64_t bytes = info.memory_bytes;
  REFUSED(shaftcull_bounds_set_layers(bounds, &index, layers, 1), "layers");
  REFUSED(shaftcull_bounds_set_layers(bounds, NULL, layers, 1), "2");
  REFUSED(shaftcull_bounds_set_layers(bounds, NULL, NULL, 0), "2");
  OK(shaftcull_bounds_set_layers(bounds, NULL, layers, 2));
  OK(shaftcull_bounds_set_layers(bounds, &index, layers, 1));
  OK(shaftcull_bounds_set_layers(bounds, &index, NULL, 0)); /* of no bound */
  OK(shaftcull_bounds_describe(bounds, &info));
  CHECK(info.layers[0] == 1 && info.layers[1] == 1 && info.memory_bytes >= bytes + 8);
  OK(shaftcull_bounds_set_layers(bounds, twice, others, 2)); /* the last counts */
  OK(shaftcull_bounds_describe(bounds, &info));
  CHECK(info.layers[0] + info.layers[1] == 9);
  REFUSED(shaftcull_bounds_set_layers(bounds, &far_index, layers, 1), "2");
  REFUSED(shaftcull_bounds_set_layers(bounds, &index, NULL, 1), "layers is NULL");

  shaftcull_shafts* shafts = three_shafts();
  shaftcull_query query;
  memset(&query, 0, sizeof query);
  const uint32_t mask = 8 | 2;
  query.layer_masks = &mask;
  query.layer_mask_count = 1;
  query.triangle_test = info.kind == SHAFTCULL_TRIANGLES ? SHAFTCULL_TRIANGLES_BY_VERTICES : SHAFTCULL_TRIANGLES_EXACT;
  uint64_t kept = 0;
  shaftcull_bounds* copy = NULL;
  OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
  CHECK(kept == 2);
  OK(shaftcull_bounds_copy(bounds, &copy));               /* with its layers */
  OK(shaftcull_bounds_set_layers(bounds, NULL, NULL, 2)); /* and no more here */
  OK(shaftcull_bounds_describe(bounds, &info));
  CHECK(info.layers == NULL && (info.holder == SHAFTCULL_TREE || info.memory_bytes == bytes));
  REFUSED(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1), "layer");
  kept = 0;
  OK(shaftcull_cull(shafts, 2, 1, copy, &query, &kept, 1));
  CHECK(kept == 2);
  OK(shaftcull_bounds_set_layers(copy, NULL, layers, 2));
  OK(shaftcull_cull(shafts, 2, 1, copy, &query, &kept, 1));
  CHECK(kept == 2);
  if (info.holder != SHAFTCULL_TREE) { /* whose layers are in its order */
    OK(shaftcull_bounds_describe(copy, &info));
    OK(shaftcull_bounds_set_layers(copy, NULL, info.layers, 2)); /* its own */
    OK(shaftcull_bounds_describe(copy, &info));
    CHECK(info.layers[0] == 1 && info.layers[1] == 2);
  }
  shaftcull_bounds_free(copy);
  shaftcull_shafts_free(shafts);
}

static void layers(void) {
  const shaftcull_source sources[3] = {shaftcull_boxes(scene, 2), shaftcull_spheres(balls, 2),
                                       shaftcull_triangles(faces, 2)};
  shaftcull_bounds* view = NULL;
  shaftcull_bounds* stream = NULL;
  shaftcull_bounds* tree = NULL;
  shaftcull_bounds_info info;
  for (uint32_t kind = SHAFTCULL_BOXES; kind <= SHAFTCULL_TRIANGLES; ++kind) {
    OK(shaftcull_stream_create(&sources[kind - 1], &stream));
    OK(shaftcull_bounds_describe(stream, &info));
    OK(shaftcull_view_create(kind, info.streams, 2, &view));
    OK(shaftcull_tree_create(&sources[kind - 1], &tree));
    layers_of(view);
    layers_of(stream);
    if (kind == SHAFTCULL_TRIANGLES) break; /* a tree of them has no layers */
    layers_of(tree);
    shaftcull_bounds_free(view);
    shaftcull_bounds_free(stream);
    shaftcull_bounds_free(tree);
  }
  const uint32_t some[2] = {1, 2};
  const uint32_t index = 1;
  REFUSED(shaftcull_bounds_set_layers(tree, NULL, some, 2), "a tree of triangles");
  REFUSED(shaftcull_bounds_set_layers(tree, &index, some, 1), "a tree of triangles");
  REFUSED(shaftcull_bounds_set_layers(tree, NULL, NULL, 2), "a tree of triangles");
  REFUSED(shaftcull_bounds_set_layers(NULL, NULL, some, 2), "bounds is NULL");

  shaftcull_bounds_free(view);
  shaftcull_bounds_free(stream);
  shaftcull_bounds_free(tree);
}

/* What all questions are asked about. */
typedef struct asked {
  shaftcull_shafts* shafts;
  shaftcull_bounds* stream;
  shaftcull_bounds* tree;
  shaftcull_bounds* triangles;
} asked;

static asked make_asked(void) {
  asked all;
  memset(&all, 0, sizeof all);
  all.shafts = three_shafts();
  const shaftcull_source boxes = shaftcull_boxes(scene, 2);
  const shaftcull_source triangles = shaftcull_triangles(faces, 2);
  OK(shaftcull_stream_create(&boxes, &all.stream));
  OK(shaftcull_tree_create(&boxes, &all.tree));
  OK(shaftcull_stream_create(&triangles, &all.triangles));
  return all;
}

static void free_asked(asked* all) {
  shaftcull_shafts_free(all->shafts);
  shaftcull_bounds_free(all->stream);
  shaftcull_bounds_free(all->tree);
  shaftcull_bounds_free(all->triangles);
}

/* The lists that a call has filled. */
static shaftcull_lists_info described(const shaftcull_lists* lists) {
  shaftcull_lists_info info;
  OK(shaftcull_lists_describe(lists, &info));
  return info;
}

static void one_shaft(void) {
  asked all = make_asked();
  const shaftcull_shafts* const shafts = all.shafts;
  const shaftcull_bounds* const holders[2] = {all.stream, all.tree};
  uint64_t kept = 0;
  uint64_t inside = 0;
  uint64_t number = 99;
  uint32_t yes = 99;
  uint32_t indices[2] = {99, 99};
  uint32_t more[2] = {99, 99};
  shaftcull_kept_counts counts;
  shaftcull_contact_found contact;
  const uint32_t candidates[2] = {1, 0};
  float time = 0;
  shaftcull_lists* lists = NULL;
  OK(shaftcull_lists_create(&lists));
  for (int h = 0; h != 2; ++h) {
    const shaftcull_bounds* const bounds = holders[h];
    OK(shaftcull_cull(shafts, 0, 1, bounds, NULL, &kept, 1));
    CHECK(kept == 1);
    OK(shaftcull_classify(shafts, 2, 1, bounds, NULL, &kept, &inside, 1));
    CHECK(kept == 3 && inside == 3);
    OK(shaftcull_classify(shafts, 0, 1, bounds, NULL, NULL, &inside, 1));
    CHECK(inside == 0);
    OK(shaftcull_count(shafts, 0, 1, bounds, NULL, &number));
    CHECK(number == 1);
    OK(shaftcull_count_classified(shafts, 0, 1, bounds, NULL, &counts));
    CHECK(counts.overlap == 1 && counts.inside == 0);
    OK(shaftcull_any(shafts, 1, 1, bounds, NULL, &number));
    CHECK(number == 0);
    OK(shaftcull_any(shafts, 0, 1, bounds, NULL, &number));
    CHECK(number == 1);
    OK(shaftcull_first_contact(shafts, 0, 1, bounds, NULL, &contact));
    CHECK(contact.found == 1 && contact.index == 0 && contact.time > 0 && contact.time < 1);
    CHECK(hypotf(hypotf(contact.normal[0], contact.normal[1]), contact.normal[2]) > 0.99F);
    OK(shaftcull_first_contact(shafts, 1, 1, bounds, NULL, &contact));
    CHECK(contact.found == 0 && contact.index == SHAFTCULL_NONE && contact.time == INFINITY);
    CHECK(contact.normal[0] == 0 && contact.normal[1] == 0 && contact.normal[2] == 0 && contact.reserved == 0);
    OK(shaftcull_occluded(shafts, 0, 1, bounds, NULL, &number));
    CHECK(number == 0);
    OK(shaftcull_find_occluder(shafts, 0, bounds, NULL, &number));
    CHECK(number == SHAFTCULL_NONE);
    OK(shaftcull_list(shafts, 0, bounds, NULL, indices, 2, &number));
    CHECK(number == 1 && indices[0] == 0);
    OK(shaftcull_list(shafts, 2, bounds, NULL, NULL, 0, &number)); /* only counts */
    CHECK(number == 2);
    OK(shaftcull_list_classified(shafts, 0, bounds, NULL, indices, 2, more, 2, &counts));
    CHECK(counts.overlap == 1 && counts.inside == 0 && indices[0] == 0);
    OK(shaftcull_entry_times(shafts, 0, bounds, candidates, &time, 1));
    CHECK(time == INFINITY);
    OK(shaftcull_list_occluders(shafts, 0, 1, bounds, NULL, lists));
    CHECK(described(lists).count == 1 && described(lists).offsets[1] == 0);
  }

  /* Queries for times and occluders refuse triangles. */
  OK(shaftcull_cull(shafts, 0, 1, all.triangles, NULL, &kept, 1));
  CHECK(kept == 1);
  OK(shaftcull_list(shafts, 0, all.triangles, NULL, indices, 2, &number));
  CHECK(number == 1);
  OK(shaftcull_classify(shafts, 0, 1, all.triangles, NULL, &kept, &inside, 1));
  CHECK(kept == 1 && (inside & ~kept) == 0);
  OK(shaftcull_count_classified(shafts, 0, 1, all.triangles, NULL, &counts));
  CHECK(counts.overlap + counts.inside == 1 && counts.inside == inside);
  OK(shaftcull_list_classified(shafts, 0, all.triangles, NULL, indices, 2, more, 2, &counts));
  CHECK(counts.overlap + counts.inside == 1 && (inside == 1 ? more[0] : indices[0]) == 0);
  REFUSED(shaftcull_first_contact(shafts, 0, 1, all.triangles, NULL, &contact), "triangles");
  REFUSED(shaftcull_occluded(shafts, 0, 1, all.triangles, NULL, &number), "triangles");
  REFUSED(shaftcull_find_occluder(shafts, 0, all.triangles, NULL, &number), "triangles");
  REFUSED(shaftcull_entry_times(shafts, 0, all.triangles, candidates, &time, 1), "triangles");
  REFUSED(shaftcull_list_occluders(shafts, 0, 1, all.triangles, NULL, lists), "triangles");

  /* One bound. */
  shaftcull_answer answer = 99;
  OK(shaftcull_classify_one(shafts, 0, SHAFTCULL_BOXES, &scene[1], 0, &answer));
  CHECK(answer == SHAFTCULL_OUTSIDE);
  OK(shaftcull_classify_one(shafts, 0, SHAFTCULL_BOXES, &scene[0], 0, &answer));
  CHECK(answer == SHAFTCULL_OVERLAP);
  OK(shaftcull_classify_one(shafts, 0, SHAFTCULL_SPHERES, &balls[0], 0, &answer));
  CHECK(answer == SHAFTCULL_INSIDE);
  OK(shaftcull_classify_one(shafts, 0, SHAFTCULL_TRIANGLES, &faces[0], SHAFTCULL_TRIANGLES_EXACT, &answer));
  CHECK(answer != SHAFTCULL_OUTSIDE);
  OK(shaftcull_classify_one(shafts, 0, SHAFTCULL_TRIANGLES, &faces[1], SHAFTCULL_TRIANGLES_EXACT, &answer));
  CHECK(answer == SHAFTCULL_OUTSIDE);
  OK(shaftcull_classify_one(shafts, 2, SHAFTCULL_TRIANGLES, &faces[1], SHAFTCULL_TRIANGLES_BY_VERTICES, &answer));
  CHECK(answer == SHAFTCULL_INSIDE);
  const shaftcull_box wall = {{-9, 4, -9}, {19, 5, 19}};
  const float sheet[12] = {-9, 4, -9, 19, 4, -9, 19, 4, 19, -9, 4, 19};
  OK(shaftcull_occluded_by(shafts, 0, (const float*)&wall, 2, &yes));
  CHECK(yes == 1);
  OK(shaftcull_occluded_by(shafts, 0, sheet, 4, &yes));
  CHECK(yes == 1);
  REFUSED(shaftcull_classify_one(shafts, 0, SHAFTCULL_BOXES, NULL, 0, &answer), "bound is NULL");
  REFUSED(shaftcull_classify_one(shafts, 0, SHAFTCULL_BOXES, &wall, 1, &answer), "test = 1 is for triangles");
  REFUSED(shaftcull_classify_one(shafts, 0, SHAFTCULL_BOXES, &wall, 0, NULL), "answer is NULL");
  REFUSED(shaftcull_classify_one(shafts, 0, SHAFTCULL_TRIANGLES, &faces[0], 2, &answer), "test = 2");
  REFUSED(shaftcull_classify_one(shafts, 0, 0, &wall, 0, &answer), "kind = 0");
  REFUSED(shaftcull_classify_one(shafts, 3, SHAFTCULL_BOXES, &wall, 0, &answer), "shaft = 3");
  REFUSED(shaftcull_occluded_by(shafts, 1, (const float*)&wall, 2, &yes), "between two boxes");
  REFUSED(shaftcull_occluded_by(shafts, 2, (const float*)&wall, 2, &yes), "between_polygons");
  {
    const float ends[] = {0, 0, 0, 0, 1, 0, 0, 1, 1, 9, 0, 0, 9, 1, 0, 9, 1, 1};
    const shaftcull_box across = {{4, -9, -9}, {5, 9, 9}};
    const float leaning[] = {4, -9, -9, 5, 9, -9, 5, 9, 9, 4, -9, 9};
    shaftcull_shafts* one = NULL;
    shaftcull_hull* between = NULL;
    OK(shaftcull_shafts_create(1, &one));
    OK(shaftcull_hull_create(ends, 6, 3, NULL, 0, SHAFTCULL_HULL_EXACT, &between));
    OK(shaftcull_shafts_set_hull(one, 0, between));
    shaftcull_hull_free(between);
    OK(shaftcull_occluded_by(one, 0, (const float*)&across, 2, &yes));
    CHECK(yes == 1);
    OK(shaftcull_occluded_by(one, 0, leaning, 4, &yes));
    CHECK(yes == 1);
    shaftcull_shafts_free(one);
  }
  REFUSED(shaftcull_occluded_by(shafts, 0, NULL, 2, &yes), "corners is NULL");
  REFUSED(shaftcull_occluded_by(shafts, 0, sheet, 1, &yes), "1");
  REFUSED(shaftcull_occluded_by(shafts, 0, NULL, 4, &yes), "corners is NULL");

  /* Wrong sizes, indices and holders; NULL. */
  REFUSED(shaftcull_cull(shafts, 0, 1, all.stream, NULL, &kept, 2), "kept has 2 words");
  REFUSED(shaftcull_cull(shafts, 0, 1, all.stream, NULL, NULL, 1), "kept is NULL");
  REFUSED(shaftcull_cull(shafts, 3, 1, all.stream, NULL, &kept, 1), "3 shafts of the array");
  REFUSED(shaftcull_list(shafts, 3, all.stream, NULL, indices, 2, &number), "shaft = 3");
  REFUSED(shaftcull_cull(NULL, 0, 1, all.stream, NULL, &kept, 1), "shafts is NULL");
  REFUSED(shaftcull_cull(shafts, 0, 1, NULL, NULL, &kept, 1), "bounds is NULL");
  REFUSED(shaftcull_classify(shafts, 0, 1, all.tree, NULL, &kept, &kept, 1), "share");
  REFUSED(shaftcull_count(shafts, 0, 1, all.tree, NULL, NULL), "kept_counts is NULL");
  REFUSED(shaftcull_any(shafts, 0, 1, all.tree, NULL, NULL), "any is NULL");
  REFUSED(shaftcull_list(shafts, 0, all.tree, NULL, indices, 2, NULL), "kept_count is NULL");
  REFUSED(shaftcull_classify(shafts, 0, 1, all.tree, NULL, &kept, NULL, 1), "inside is NULL");
  REFUSED(shaftcull_classify(shafts, 0, 1, all.tree, NULL, NULL, &inside, 2), "2");
  REFUSED(shaftcull_first_contact(shafts, 2, 1, all.stream, NULL, &contact), "hull");
  REFUSED(shaftcull_first_contact(shafts, 0, 1, all.stream, NULL, NULL), "contacts is NULL");
  REFUSED(shaftcull_entry_times(shafts, 0, all.stream, candidates, NULL, 1), "times is NULL");
  REFUSED(shaftcull_find_occluder(shafts, 1, all.stream, NULL, &number), "between two boxes");
  REFUSED(shaftcull_occluded(shafts, 0, 1, NULL, NULL, &number), "solids is NULL");

  /* More bounds than indices can number. They are refused before any is read. */
  const float nothing = 0;
  const float* const streams[6] = {&nothing, &nothing, &nothing, &nothing, &nothing, &nothing};
  shaftcull_bounds* large = NULL;
  OK(shaftcull_view_create(SHAFTCULL_BOXES, streams, UINT64_C(1) << 32, &large));
  REFUSED(shaftcull_list(shafts, 0, large, NULL, indices, 2, &number), "ask slices of the view");
  REFUSED(shaftcull_list_classified(shafts, 0, large, NULL, indices, 2, more, 2, &counts), "ask slices of the view");
  REFUSED(shaftcull_list_occluders(shafts, 0, 1, large, NULL, lists), "ask slices of the view");
  REFUSED(shaftcull_list_many(shafts, 0, 1, large, NULL, lists), "ask slices of the view");
  REFUSED(shaftcull_first_contact(shafts, 0, 1, large, NULL, &contact), "ask slices of the view");
  shaftcull_lists_free(lists);
  shaftcull_bounds_free(large);

  /* A tree between update and refit, and a shaft that was never formed. */
  const shaftcull_source one = shaftcull_boxes(scene, 1);
  OK(shaftcull_tree_update_some(all.tree, candidates, 1, &one));
  FAILS(shaftcull_cull(shafts, 0, 1, all.tree, NULL, &kept, 1), SHAFTCULL_NEEDS_REFIT, "refit");
  shaftcull_shafts* others = NULL;
  OK(shaftcull_shafts_create(1, &others));
  REFUSED(shaftcull_cull(others, 0, 1, all.stream, NULL, &kept, 1), "formed");
  shaftcull_shafts_free(others);
  free_asked(&all);
}

/* Each option alone, with one holder. The hull keeps both of the two bounds. */
static void options_about(const shaftcull_shafts* shafts, shaftcull_bounds* bounds, int are_boxes,
                          shaftcull_lists* lists) {
  const uint32_t indices[2] = {1, 0};
  const uint32_t rows[3] = {1, 1, 0};
  const uint32_t far_index = 2;
  const uint64_t mask = 1;
  const uint32_t layers[2] = {1, 2};
  const uint32_t masks[3] = {1, 2, 2};
  uint64_t kept = 0;
  uint64_t number = 99;
  uint32_t list[2] = {99, 99};
  uint64_t numbers[3];
  uint64_t rows_of_bits[3];
  shaftcull_kept_counts counts;
  shaftcull_contact_found contact;
  shaftcull_query query;
  shaftcull_query none;
  memset(&none, 0, sizeof none);
  if (!are_boxes) none.triangle_test = SHAFTCULL_TRIANGLES_BY_VERTICES; /* the one that hulls take */

  query = none;
  OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
  CHECK(kept == 3);
  query.exclude = indices;
  query.exclude_count = 1;
  OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
  CHECK(kept == 1);
  OK(shaftcull_count(shafts, 0, 3, bounds, &query, numbers)); /* for all shafts */
  CHECK(numbers[0] == 1 && numbers[1] == 0 && numbers[2] == 1);
  query.exclude_count = 2;
  OK(shaftcull_any(shafts, 2, 1, bounds, &query, &number));
  CHECK(number == 0);
  query.exclude = &far_index;
  query.exclude_count = 1;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "exclude[0] = 2");
  query.exclude = NULL;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.exclude is NULL");

  query = none;
  query.exclude_each = rows;
  query.exclude_each_count = 3;
  OK(shaftcull_cull(shafts, 0, 3, bounds, &query, rows_of_bits, 3));
  CHECK(rows_of_bits[0] == 1 && rows_of_bits[1] == 0 && rows_of_bits[2] == 2);
  OK(shaftcull_count(shafts, 2, 1, bounds, &query, &number)); /* all of it is the one shaft's row */
  CHECK(number == 0);
  query.exclude_each_count = 2;
  REFUSED(shaftcull_count(shafts, 0, 3, bounds, &query, numbers), "exclude_each");
  query.exclude_each = NULL;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.exclude_each is NULL");

  query = none;
  query.exclude_mask = &mask;
  query.exclude_mask_words = 1;
  OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
  CHECK(kept == 2);
  query.exclude_mask_words = 2;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "exclude_mask");
  query.exclude_mask = NULL;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.exclude_mask is NULL");

  query = none;
  query.layer_masks = masks;
  query.layer_mask_count = 1;
  shaftcull_bounds_info info;
  OK(shaftcull_bounds_describe(bounds, &info));
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "layer_mask");
  if (info.holder != SHAFTCULL_TREE || are_boxes) {
    OK(shaftcull_bounds_set_layers(bounds, NULL, layers, 2));
    OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
    CHECK(kept == 1);
    query.layer_mask_count = 3; /* one for each */
    OK(shaftcull_cull(shafts, 0, 3, bounds, &query, rows_of_bits, 3));
    CHECK(rows_of_bits[0] == 1 && rows_of_bits[1] == 0 && rows_of_bits[2] == 2);
    query.layer_mask_count = 2;
    REFUSED(shaftcull_count(shafts, 0, 3, bounds, &query, numbers), "layer_mask");
    query.layer_masks = NULL;
    REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.layer_masks is NULL");
    OK(shaftcull_bounds_set_layers(bounds, NULL, NULL, 2));
  }

  query = none;
  query.only = indices;
  query.only_count = 1;
  OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
  CHECK(kept == 2);
  query.only_count = 2;
  OK(shaftcull_list(shafts, 2, bounds, &query, list, 2, &number));
  CHECK(number == 2 && list[0] == 1 && list[1] == 0); /* in their order */
  query.only = list;
  OK(shaftcull_list(shafts, 0, bounds, &query, list, 2, &number)); /* over the candidates */
  CHECK(number == 1 && list[0] == 0);
  query.only_count = 0; /* no candidates */
  OK(shaftcull_count(shafts, 2, 1, bounds, &query, &number));
  CHECK(number == 0);
  query.only = NULL; /* all bounds */
  OK(shaftcull_count(shafts, 2, 1, bounds, &query, &number));
  CHECK(number == 2);
  query.only_count = 2;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.only is NULL");
  query.only = &far_index;
  query.only_count = 1;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "only[0] = 2");
  if (are_boxes) {
    query.only = indices;
    REFUSED(shaftcull_occluded(shafts, 0, 1, bounds, &query, &number), "only");
    REFUSED(shaftcull_find_occluder(shafts, 0, bounds, &query, &number), "only");
    REFUSED(shaftcull_list_occluders(shafts, 0, 1, bounds, &query, lists), "only");
  }

  query = none;
  query.limit = 1;
  OK(shaftcull_count(shafts, 2, 1, bounds, &query, &number));
  CHECK(number == 1);
  OK(shaftcull_list(shafts, 2, bounds, &query, list, 2, &number));
  CHECK(number == 1);
  OK(shaftcull_count(shafts, 0, 3, bounds, &query, numbers));
  CHECK(numbers[0] == 1 && numbers[1] == 0 && numbers[2] == 1);
  REFUSED(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1), "limit");
  REFUSED(shaftcull_any(shafts, 2, 1, bounds, &query, &number), "limit");
  REFUSED(shaftcull_count_classified(shafts, 2, 1, bounds, &query, &counts), "limit");
  if (are_boxes) {
    OK(shaftcull_list_occluders(shafts, 0, 1, bounds, &query, lists));
    CHECK(described(lists).offsets[1] == 0);
    REFUSED(shaftcull_first_contact(shafts, 0, 1, bounds, &query, &contact), "limit");
    REFUSED(shaftcull_find_occluder(shafts, 0, bounds, &query, &number), "limit");
  }
  query.limit = UINT64_MAX;
  OK(shaftcull_count(shafts, 2, 1, bounds, &query, &number));
  CHECK(number == 2);

  query = none;
  query.triangle_test = SHAFTCULL_TRIANGLES_BY_VERTICES;
  if (are_boxes) {
    REFUSED(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1), "triangle_test");
  } else {
    OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
    query.triangle_test = SHAFTCULL_TRIANGLES_EXACT;
    OK(shaftcull_cull(shafts, 2, 1, bounds, &query, &kept, 1));
  }
  query.triangle_test = 2;
  REFUSED(shaftcull_cull(shafts, 0, 1, bounds, &query, &kept, 1), "test = 2");
  query = none;
  query.reserved[3] = 1;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.reserved");
  query = none;
  query.skip_overlapping = 1;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.skip_overlapping means nothing to count()");
  query.skip_overlapping = 2;
  REFUSED(shaftcull_count(shafts, 2, 1, bounds, &query, &number), "query.skip_overlapping = 2");
}

static void queries(void) {
  asked all = make_asked();
  const shaftcull_source triangles = shaftcull_triangles(faces, 2);
  shaftcull_bounds* mesh = NULL;
  shaftcull_lists* lists = NULL;
  OK(shaftcull_tree_create(&triangles, &mesh));
  OK(shaftcull_lists_create(&lists));
  options_about(all.shafts, all.stream, 1, lists);
  options_about(all.shafts, all.tree, 1, lists);
  options_about(all.shafts, all.triangles, 0, lists);
  options_about(all.shafts, mesh, 0, lists);
  shaftcull_lists_free(lists);
  shaftcull_bounds_free(mesh);
  free_asked(&all);
}

static void many_shafts(void) {
  asked all = make_asked();
  const shaftcull_shafts* const shafts = all.shafts;
  const shaftcull_bounds* const holders[2] = {all.stream, all.tree};
  uint64_t kept[3];
  uint64_t inside[3];
  uint64_t numbers[3];
  uint64_t bits = 99;
  shaftcull_kept_counts counts[3];
  shaftcull_contact_found contacts[2];
  for (int h = 0; h != 2; ++h) {
    const shaftcull_bounds* const bounds = holders[h];
    OK(shaftcull_cull(shafts, 0, 3, bounds, NULL, kept, 3));
    CHECK(kept[0] == 1 && kept[1] == 0 && kept[2] == 3);
    OK(shaftcull_cull(shafts, 2, 1, bounds, NULL, kept, 1)); /* a part of the array */
    CHECK(kept[0] == 3);
    OK(shaftcull_classify(shafts, 0, 3, bounds, NULL, kept, inside, 3));
    CHECK(kept[0] == 1 && inside[0] == 0 && inside[2] == 3);
    OK(shaftcull_classify(shafts, 0, 3, bounds, NULL, NULL, inside, 3));
    CHECK(inside[1] == 0 && inside[2] == 3);
    OK(shaftcull_count(shafts, 0, 3, bounds, NULL, numbers));
    CHECK(numbers[0] == 1 && numbers[2] == 2);
    OK(shaftcull_count_classified(shafts, 0, 3, bounds, NULL, counts));
    CHECK(counts[2].overlap == 0 && counts[2].inside == 2);
    OK(shaftcull_any(shafts, 0, 3, bounds, NULL, &bits));
    CHECK(bits == 5);
    OK(shaftcull_first_contact(shafts, 0, 2, bounds, NULL, contacts));
    CHECK(contacts[0].found == 1 && contacts[0].index == 0 && contacts[1].found == 0);
    OK(shaftcull_occluded(shafts, 0, 1, bounds, NULL, &bits));
    CHECK(bits == 0);
  }

  shaftcull_lists* lists = NULL;
  shaftcull_lists* others = NULL;
  OK(shaftcull_lists_create(&lists));
  OK(shaftcull_lists_create(&others));
  shaftcull_lists_info info = described(lists);
  CHECK(info.count == 0 && info.offsets == NULL && info.indices == NULL);
  OK(shaftcull_list_many(shafts, 0, 3, all.tree, NULL, lists));
  info = described(lists);
  CHECK(info.count == 3 && info.indices[0] == 0);
  CHECK(info.offsets[0] == 0 && info.offsets[1] == 1 && info.offsets[2] == 1 && info.offsets[3] == 3);
  OK(shaftcull_list_many(shafts, 0, 3, all.triangles, NULL, lists));
  OK(shaftcull_list_many(shafts, 0, 2, all.triangles, NULL, lists));
  CHECK(described(lists).count == 2 && described(lists).offsets[2] == 1);
  const uint32_t candidates[2] = {1, 0};
  shaftcull_query query;
  memset(&query, 0, sizeof query);
  query.only = candidates;
  query.only_count = 2;
  for (int h = 0; h != 2; ++h) {
    OK(shaftcull_list_classified_many(shafts, 0, 3, holders[h], NULL, lists, others));
    CHECK(described(lists).offsets[3] == 1 && described(others).offsets[3] == 2);
    OK(shaftcull_list_many(shafts, 0, 3, holders[h], &query, lists));
    CHECK(described(lists).offsets[3] == 3 && described(lists).indices[1] == 1);
    OK(shaftcull_list_occluders(shafts, 0, 1, holders[h], NULL, lists));
    CHECK(described(lists).count == 1 && described(lists).offsets[1] == 0);
    CHECK(described(lists).indices == NULL);
  }
  query.limit = 1;
  OK(shaftcull_list_many(shafts, 0, 3, all.stream, &query, lists));
  CHECK(described(lists).offsets[3] == 2 && described(lists).indices[1] == 1);
  REFUSED(shaftcull_list_many(shafts, 0, 3, all.tree, NULL, NULL), "lists is NULL");
  REFUSED(shaftcull_list_classified_many(shafts, 0, 3, all.tree, NULL, lists, lists), "share memory");
  REFUSED(shaftcull_list_classified_many(shafts, 0, 3, all.tree, NULL, NULL, lists), "overlap is NULL");
  REFUSED(shaftcull_list_classified_many(shafts, 0, 3, all.tree, NULL, lists, NULL), "inside is NULL");
  REFUSED(shaftcull_list_occluders(shafts, 0, 1, all.tree, NULL, NULL), "lists is NULL");
  REFUSED(shaftcull_lists_create(NULL), "lists is NULL");
  REFUSED(shaftcull_lists_describe(NULL, &info), "lists is NULL");
  REFUSED(shaftcull_lists_describe(lists, NULL), "info is NULL");
  shaftcull_lists_free(lists);
  shaftcull_lists_free(others);
  shaftcull_lists_free(NULL);

  REFUSED(shaftcull_cull(shafts, 1, 3, all.stream, NULL, kept, 3), "3 shafts of the array");
  REFUSED(shaftcull_cull(shafts, 0, 3, all.stream, NULL, kept, 2), "kept_rows");
  REFUSED(shaftcull_cull(shafts, 0, 3, all.stream, NULL, NULL, 3), "kept is NULL");
  REFUSED(shaftcull_classify(shafts, 0, 3, all.stream, NULL, kept, NULL, 3), "inside is NULL");
  REFUSED(shaftcull_count(shafts, 0, 3, all.stream, NULL, NULL), "kept_counts is NULL");
  REFUSED(shaftcull_count_classified(shafts, 0, 3, all.stream, NULL, NULL), "counts is NULL");
  REFUSED(shaftcull_first_contact(shafts, 0, 3, all.stream, NULL, contacts), "hull");
  REFUSED(shaftcull_occluded(shafts, 0, 3, all.stream, NULL, &bits), "shaft 1");
  REFUSED(shaftcull_any(shafts, 0, 3, all.stream, NULL, NULL), "any is NULL");
  OK(shaftcull_any(shafts, 3, 0, all.stream, NULL, NULL)); /* about no shaft */
  REFUSED(shaftcull_any(NULL, 0, 3, all.stream, NULL, &bits), "shafts is NULL");
  free_asked(&all);
}

/* Sums of the callbacks of visibility. */
typedef struct sights_told {
  uint64_t pairs;
  uint64_t undecided;
  int verdict; /* what resolve says */
  int32_t returns;
} sights_told;

static int32_t on_sights(const shaftcull_sight_batch* batch, void* user) {
  sights_told* const told = user;
  for (uint64_t i = 0; i != batch->block_count; ++i) {
    CHECK(batch->blocks[i].sight != SHAFTCULL_SIGHT_UNDECIDED);
    told->pairs += (uint64_t)batch->blocks[i].a.count * batch->blocks[i].b.count;
  }
  told->undecided += batch->undecided.count;
  return told->returns;
}

static int32_t on_undecided(const shaftcull_undecided_pairs* undecided, uint8_t* verdicts, void* user) {
  const sights_told* const told = user;
  CHECK(undecided->first_candidate[undecided->count] >= undecided->count);
  for (uint64_t i = 0; i != undecided->count; ++i) {
    CHECK(verdicts[i] == SHAFTCULL_SIGHT_UNDECIDED && undecided->pairs[i].a < 3 && undecided->pairs[i].b < 2);
    verdicts[i] = (uint8_t)told->verdict;
  }
  return told->returns;
}

static int32_t on_progress(uint64_t done, uint64_t total, void* user) {
  const sights_told* const told = user;
  CHECK(done <= total);
  return told->returns;
}

static void visibility(void) {
  /* Three patches on the left and two on the right. Between the lowest two is the box around two triangles, which do
     not reach in themselves. A ball's box stands between the highest two, and a wall between all others. */
  static const shaftcull_box left[3] = {{{0, 0, 0}, {0, 1, 1}}, {{0, 10, 0}, {0, 11, 1}}, {{0, 20, 0}, {0, 21, 1}}};
  static const shaftcull_box right[2] = {{{9, 10, 0}, {9, 11, 1}}, {{9, 20, 0}, {9, 21, 1}}};
  static const shaftcull_plane to_right[3] = {{{1, 0, 0}, 0}, {{1, 0, 0}, 0}, {{1, 0, 0}, 0}};
  static const shaftcull_plane upwards[2] = {{{0, 1, 0}, 11}, {{-1, 0, 0}, -9}};
  static const shaftcull_box ball = {{4, 20.4F, 0.4F}, {5, 20.6F, 0.6F}};
  static const shaftcull_box wall = {{4, 9, -1}, {5, 18, 2}};
  static const uint64_t first_corner[2] = {0, 8};
  static const float square[12] = {50, 0, 0, 50, 1, 0, 50, 1, 1, 50, 0, 1};
  static const uint64_t first_of_square[2] = {0, 4};
  static const uint64_t two_groups[3] = {0, 1, 2};
  const shaftcull_source lefts = shaftcull_boxes(left, 3);
  const shaftcull_source rights = shaftcull_boxes(right, 2);
  shaftcull_patches* a = NULL;
  shaftcull_patches* b = NULL;
  shaftcull_patches* facing = NULL;
  OK(shaftcull_patches_create(&lefts, to_right, 3, &a));
  OK(shaftcull_patches_create(&rights, NULL, 0, &b));
  OK(shaftcull_patches_create(&rights, upwards, 2, &facing));
  shaftcull_patches_info patches;
  OK(shaftcull_patches_describe(a, &patches));
  CHECK(patches.count == 3 && patches.order[0] + patches.order[1] + patches.order[2] == 3);
  REFUSED(shaftcull_patches_describe(NULL, &patches), "patches is NULL");
  REFUSED(shaftcull_patches_describe(a, NULL), "info is NULL");
  shaftcull_patches* none = NULL;
  REFUSED(shaftcull_patches_create(&lefts, to_right, 2, &none), "2 planes for 3 patches");
  REFUSED(shaftcull_patches_create(&lefts, NULL, 3, &none), "planes is NULL");
  REFUSED(shaftcull_patches_create(NULL, to_right, 3, &none), "boxes is NULL");
  REFUSED(shaftcull_patches_create(&lefts, to_right, 3, NULL), "patches is NULL");
  static const shaftcull_box reversed[2] = {{{0, 0, 0}, {0, 1, 1}}, {{1, 1, 1}, {0, 0, 0}}};
  const shaftcull_source bad = shaftcull_boxes(reversed, 2);
  FAILS(shaftcull_patches_create(&bad, NULL, 0, &none), SHAFTCULL_BAD_BOUND, "1");
  CHECK(shaftcull_error_position() == 1 && none == NULL);
  shaftcull_patches* leaning = NULL;
  OK(shaftcull_patches_create_polygons(square, 4, first_of_square, 1, SHAFTCULL_PATCH_FRONT, &leaning));
  OK(shaftcull_patches_describe(leaning, &patches));
  CHECK(patches.count == 1 && patches.order[0] == 0);
  shaftcull_patches_free(leaning);
  REFUSED(shaftcull_patches_create_polygons(square, 4, first_of_square, 1, 2, &none),
          "sides = 2 is none of SHAFTCULL_PATCH_FRONT and SHAFTCULL_PATCH_BOTH");
  REFUSED(shaftcull_patches_create_polygons(NULL, 4, first_of_square, 1, SHAFTCULL_PATCH_FRONT, &none),
          "corners is NULL");
  REFUSED(shaftcull_patches_create_polygons(square, 4, NULL, 1, SHAFTCULL_PATCH_FRONT, &none), "first_corner is NULL");
  REFUSED(shaftcull_patches_create_polygons(square, 4, NULL, 0, SHAFTCULL_PATCH_FRONT, &none), "first_corner is NULL");
  REFUSED(shaftcull_patches_create_polygons(square, 3, first_of_square, 1, SHAFTCULL_PATCH_FRONT, &none),
          "end with the number of corners, 3");
  REFUSED(shaftcull_patches_create_polygons(square, 4, first_of_square, 1, SHAFTCULL_PATCH_FRONT, NULL),
          "patches is NULL");
  const shaftcull_source ball_source = shaftcull_spheres(balls, 2);
  REFUSED(shaftcull_patches_create(&ball_source, NULL, 0, &none), "boxes is a source of other bounds");

  shaftcull_occluders* occluders = NULL;
  OK(shaftcull_occluders_create(&occluders));
  REFUSED(shaftcull_occluders_create(NULL), "occluders is NULL");
  CHECK(shaftcull_occluders_count(occluders) == 0 && shaftcull_occluders_count(NULL) == 0);
  const shaftcull_source one_ball = shaftcull_boxes(&ball, 1);
  const shaftcull_source one_wall = shaftcull_boxes(&wall, 1);
  const shaftcull_source two_faces = shaftcull_triangles(faces, 2);
  uint64_t first = 9;
  OK(shaftcull_occluders_add_boxes(occluders, &one_ball, &first));
  CHECK(first == 0);
  OK(shaftcull_occluders_add_solids(occluders, &one_wall, &first));
  CHECK(first == 1);
  float far_corners[24];
  for (int i = 0; i != 24; ++i) far_corners[i] = corners[i] + 100;
  OK(shaftcull_occluders_add_solid_hulls(occluders, far_corners, 8, first_corner, 1, &first));
  CHECK(first == 2);
  OK(shaftcull_occluders_add_polygons(occluders, square, 4, first_of_square, 1, &first));
  CHECK(first == 3);
  OK(shaftcull_occluders_add_polygons(occluders, NULL, 0, NULL, 0, &first));
  CHECK(first == 4);
  OK(shaftcull_occluders_add_triangles(occluders, &two_faces, two_groups, 2, NULL));
  OK(shaftcull_occluders_add_triangles(occluders, &two_faces, NULL, 0, &first));
  CHECK(first == 6 && shaftcull_occluders_count(occluders) == 7);
  shaftcull_found_solids found;
  shaftcull_occluders* meshes = NULL;
  OK(shaftcull_occluders_create(&meshes));
  OK(shaftcull_occluders_add_mesh(meshes, &two_faces, 0, 1, NULL, NULL, &found, &first));
  CHECK(found.hulls == 0 && found.polygons != 0 && found.inner_boxes == 0 && first == 0);
  const uint64_t of_mesh = shaftcull_occluders_count(meshes);
  OK(shaftcull_occluders_add_mesh(meshes, &two_faces, 1e30F, 0, a, b, NULL, &first));
  CHECK(first == of_mesh);
  OK(shaftcull_occluders_add_mesh(meshes, &two_faces, 0, 1, a, NULL, NULL, NULL));
  CHECK(of_mesh != 0 && shaftcull_occluders_count(meshes) == 3 * of_mesh);
  shaftcull_occluders_free(meshes);
  first = 6;
  shaftcull_occluder_info info;
  OK(shaftcull_occluders_describe(occluders, 1, &info));
  CHECK(memcmp(&info.box, &wall, sizeof wall) == 0 && info.triangle_count == 0 && info.triangles == NULL);
  OK(shaftcull_occluders_describe(occluders, 5, &info));
  CHECK(info.triangle_count == 1 && info.triangles[0] == 1);
  REFUSED(shaftcull_occluders_describe(occluders, 7, &info), "occluder = 7");
  REFUSED(shaftcull_occluders_describe(NULL, 0, &info), "occluders is NULL");
  REFUSED(shaftcull_occluders_describe(occluders, 0, NULL), "info is NULL");
  REFUSED(shaftcull_occluders_add_boxes(NULL, &one_ball, NULL), "occluders is NULL");
  REFUSED(shaftcull_occluders_add_boxes(occluders, NULL, NULL), "boxes is NULL");
  FAILS(shaftcull_occluders_add_solids(occluders, &bad, &first), SHAFTCULL_BAD_BOUND, "1");
  REFUSED(shaftcull_occluders_add_solid_hulls(occluders, corners, 8, NULL, 1, NULL), "first_corner is NULL");
  REFUSED(shaftcull_occluders_add_solid_hulls(occluders, corners, 8, NULL, 0, NULL), "first_corner is NULL");
  REFUSED(shaftcull_occluders_add_solid_hulls(occluders, corners, 8, first_corner, UINT64_MAX, NULL), "first_corner");
  REFUSED(shaftcull_occluders_add_polygons(occluders, NULL, 4, first_of_square, 1, NULL), "corners is NULL");
  REFUSED(shaftcull_occluders_add_triangles(occluders, &one_ball, NULL, 0, NULL), "takes triangles");
  REFUSED(shaftcull_occluders_add_triangles(occluders, &two_faces, NULL, 2, NULL), "first_triangle is NULL");
  REFUSED(shaftcull_occluders_add_mesh(NULL, &two_faces, 0, 1, NULL, NULL, &found, &first), "occluders is NULL");
  REFUSED(shaftcull_occluders_add_mesh(occluders, &one_ball, 0, 1, NULL, NULL, &found, &first), "takes triangles");
  REFUSED(shaftcull_occluders_add_mesh(occluders, &two_faces, 0, 2, NULL, NULL, &found, &first), "bodies = 2");
  REFUSED(shaftcull_occluders_add_mesh(occluders, &two_faces, -1, 1, NULL, NULL, &found, &first), "least_width");
  REFUSED(shaftcull_occluders_add_mesh(occluders, &two_faces, 0, 1, NULL, b, &found, &first), "a is NULL");
  CHECK(shaftcull_occluders_count(occluders) == 7 && first == 6); /* nothing was added */

  shaftcull_visibility_options options = shaftcull_default_visibility_options();
  CHECK(options.memory == UINT64_C(256) << 20 && options.contact == SHAFTCULL_CONTACT_OPEN);
  CHECK(options.solids_around_ends == 1 && options.candidates == 1 && options.resolve == NULL);
  shaftcull_sight_counts counts;
  OK(shaftcull_visibility(a, b, occluders, NULL, NULL, NULL, &counts));
  CHECK(counts.occluded == 4 && counts.undecided == 1 && counts.clear == 1 && counts.facing_away == 0);
  OK(shaftcull_visibility(a, NULL, occluders, NULL, NULL, NULL, &counts));
  CHECK(counts.facing_away == 3); /* all lie in one plane */
  OK(shaftcull_visibility(a, facing, occluders, NULL, NULL, NULL, &counts));
  CHECK(counts.facing_away >= 1 && counts.undecided == 1); /* some that face away are occluded, too */
  sights_told told = {0, 0, SHAFTCULL_SIGHT_CLEAR, 0};
  OK(shaftcull_visibility(a, b, occluders, NULL, on_sights, &told, &counts));
  CHECK(told.pairs == 5 && told.undecided == 1 && counts.undecided == 1);
  options.resolve = on_undecided;
  options.progress = on_progress;
  options.user = &told;
  told.pairs = told.undecided = 0;
  OK(shaftcull_visibility(a, b, occluders, &options, on_sights, &told, NULL));
  CHECK(told.pairs == 6 && told.undecided == 0);
  told.verdict = 4;
  REFUSED(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), "verdicts[0] = 4, of patches 2 and 1");
  told.verdict = SHAFTCULL_SIGHT_OCCLUDED;
  told.returns = -3;
  FAILS(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), SHAFTCULL_STOPPED, "returned -3");
  options.progress = NULL;
  FAILS(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), SHAFTCULL_STOPPED, "returned -3");
  options.resolve = NULL;
  FAILS(shaftcull_visibility(a, b, occluders, &options, on_sights, &told, &counts), SHAFTCULL_STOPPED, "returned -3");

  shaftcull_visibility_result* result = NULL;
  shaftcull_sight_batch all;
  OK(shaftcull_collect_visibility(a, b, occluders, &options, &result));
  OK(shaftcull_visibility_result_describe(result, &all, &counts));
  CHECK(counts.occluded == 4 && all.undecided.count == 1 && all.block_count != 0);
  CHECK(all.undecided.first_candidate[0] == 0 && all.undecided.candidates[0] < 7);
  REFUSED(shaftcull_visibility_result_describe(NULL, &all, &counts), "result is NULL");
  REFUSED(shaftcull_visibility_result_describe(result, NULL, &counts), "batch is NULL");
  shaftcull_visibility_result_free(result);
  shaftcull_visibility_result_free(NULL);
  options.candidates = 0;
  OK(shaftcull_collect_visibility(a, b, occluders, &options, &result));
  OK(shaftcull_visibility_result_describe(result, &all, NULL));
  CHECK(all.undecided.count == 1 && all.undecided.first_candidate == NULL && all.undecided.candidates == NULL);
  shaftcull_visibility_result_free(result);
  uint64_t bits[3] = {7, 7, 7};
  OK(shaftcull_visibility_bits(a, b, occluders, NULL, SHAFTCULL_SIGHT_OCCLUDED, bits, 3, &counts));
  CHECK(bits[0] == 2 && bits[1] == 3 && bits[2] == 1 && counts.occluded == 4);
  REFUSED(shaftcull_visibility_bits(a, b, occluders, NULL, SHAFTCULL_SIGHT_OCCLUDED, bits, 2, NULL), "bits");
  REFUSED(shaftcull_visibility_bits(a, b, occluders, NULL, SHAFTCULL_SIGHT_OCCLUDED, NULL, 3, NULL), "bits is NULL");
  REFUSED(shaftcull_visibility_bits(a, b, occluders, NULL, 258, bits, 3, NULL), "sight = 258"); /* not cut to a byte */

  REFUSED(shaftcull_visibility(NULL, b, occluders, NULL, NULL, NULL, &counts), "a is NULL");
  REFUSED(shaftcull_visibility(a, b, NULL, NULL, NULL, NULL, &counts), "occluders is NULL");
  REFUSED(shaftcull_visibility(a, b, occluders, NULL, NULL, NULL, NULL), "counts is NULL");
  REFUSED(shaftcull_collect_visibility(a, b, occluders, NULL, NULL), "result is NULL");
  options = shaftcull_default_visibility_options();
  options.memory = 1000;
  REFUSED(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), "1 MB");
  options = shaftcull_default_visibility_options();
  options.contact = 2;
  REFUSED(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), "contact = 2");
  options = shaftcull_default_visibility_options();
  options.solids_around_ends = 2;
  REFUSED(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), "options.solids_around_ends = 2");
  options = shaftcull_default_visibility_options();
  options.tolerance = -1;
  REFUSED(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), "tolerance is -1");
  options = shaftcull_default_visibility_options();
  options.part = 1;
  REFUSED(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), "part is 1; of 1 part, it is 0");
  options = shaftcull_default_visibility_options();
  options.reserved[3] = 1;
  REFUSED(shaftcull_visibility(a, b, occluders, &options, NULL, NULL, &counts), "options.reserved is not 0");
  CHECK(strcmp(shaftcull_sight_name(SHAFTCULL_SIGHT_CLEAR), "clear") == 0);
  CHECK(strcmp(shaftcull_sight_name(SHAFTCULL_SIGHT_FACING_AWAY), "facing_away") == 0);
  CHECK(strcmp(shaftcull_sight_name(4), "unknown") == 0);
  shaftcull_occluders_free(occluders);
  shaftcull_occluders_free(NULL);
  shaftcull_patches_free(a);
  shaftcull_patches_free(b);
  shaftcull_patches_free(facing);
  shaftcull_patches_free(NULL);
}

/* A room of six unit squares that face inwards, and a screen in the middle that hides half of the ceiling's view. */
static const float room[72] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0, 1,
                               0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0,
                               0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 1, 1, 0, 1, 1};
static const uint64_t first_of_walls[7] = {0, 4, 8, 12, 16, 20, 24};
static const float screen[12] = {0, 0, 0.5F, 0.5F, 0, 0.5F, 0.5F, 1, 0.5F, 0, 1, 0.5F};
static const uint64_t first_of_screen[2] = {0, 4};

static void rays_and_view_factors(void) {
  shaftcull_patches* walls = NULL;
  shaftcull_patches* from_both = NULL;
  shaftcull_occluders* occluders = NULL;
  OK(shaftcull_patches_create_polygons(room, 24, first_of_walls, 6, SHAFTCULL_PATCH_FRONT, &walls));
  OK(shaftcull_patches_create_polygons(room, 24, first_of_walls, 6, SHAFTCULL_PATCH_BOTH, &from_both));
  OK(shaftcull_occluders_create(&occluders));

  shaftcull_factor_matrix* matrix = NULL;
  shaftcull_factor_matrix_info info;
  OK(shaftcull_view_factors(walls, occluders, NULL, &matrix));
  OK(shaftcull_factor_matrix_describe(matrix, &info));
  CHECK(info.size == 6 && info.factors == 30 && info.first[0] == 0 && info.first[6] == 30);
  CHECK(info.column[0] == 1 && info.factor[0] > 0.19982 && info.factor[0] < 0.19983);
  CHECK(info.area[5] == 1 && fabs(info.sum[5] - 1) < 1e-7 && info.error[5] == 0 && info.left_out[5] == 0);
  CHECK(info.counts.clear == 15 && info.counts.undecided == 0);
  REFUSED(shaftcull_factor_matrix_describe(NULL, &info), "matrix is NULL");
  REFUSED(shaftcull_factor_matrix_describe(matrix, NULL), "info is NULL");
  shaftcull_factor_matrix_free(matrix);
  shaftcull_factor_matrix_free(NULL);
  REFUSED(shaftcull_view_factors(NULL, occluders, NULL, &matrix), "patches is NULL");
  REFUSED(shaftcull_view_factors(walls, NULL, NULL, &matrix), "occluders is NULL");
  REFUSED(shaftcull_view_factors(walls, occluders, NULL, NULL), "matrix is NULL");
  REFUSED(shaftcull_view_factors(from_both, occluders, NULL, &matrix), "both sides");

  OK(shaftcull_occluders_add_polygons(occluders, screen, 4, first_of_screen, 1, NULL));
  shaftcull_view_factor_options options = shaftcull_default_view_factor_options();
  CHECK(options.memory == UINT64_C(256) << 20 && options.seed == 1 && options.error == 1e-5 && options.least == 0);
  CHECK(options.rays == 4096 && options.close_rows == 0 && options.tolerance == 0 && options.progress == NULL);
  sights_told told = {0, 0, SHAFTCULL_SIGHT_CLEAR, 0};
  options.progress = on_progress;
  options.user = &told;
  options.error = 0;
  options.rays = 64;
  options.least = 0.19;
  OK(shaftcull_view_factors(walls, occluders, &options, &matrix));
  OK(shaftcull_factor_matrix_describe(matrix, &info));
  CHECK(info.counts.undecided != 0 && info.sum[0] > 0.4 && info.sum[0] < 0.8 && info.error[0] > 0);
  CHECK(info.factors < 30 && info.left_out[0] > 0 && info.left_out[0] < info.sum[0]);
  shaftcull_factor_matrix_free(matrix);
  told.returns = 5;
  FAILS(shaftcull_view_factors(walls, occluders, &options, &matrix), SHAFTCULL_STOPPED, "returned 5");
  options.progress = NULL;
  options.close_rows = 1;
  REFUSED(shaftcull_view_factors(walls, occluders, &options, &matrix), "row");
  options.close_rows = 2;
  REFUSED(shaftcull_view_factors(walls, occluders, &options, &matrix), "options.close_rows = 2");
  options.close_rows = 1;
  options.parts = 2;
  REFUSED(shaftcull_view_factors(walls, occluders, &options, &matrix), "close_rows takes all pairs, and parts is 2");
  options = shaftcull_default_view_factor_options();
  options.reserved_padding = 1;
  REFUSED(shaftcull_view_factors(walls, occluders, &options, &matrix), "options.reserved is not 0");
  options.reserved_padding = 0;
  options.reserved[0] = 1;
  REFUSED(shaftcull_view_factors(walls, occluders, &options, &matrix), "options.reserved is not 0");
  options = shaftcull_default_view_factor_options();
  options.rays = 0;
  REFUSED(shaftcull_view_factors(walls, occluders, &options, &matrix), "rays");
  options = shaftcull_default_view_factor_options();
  options.memory = 1000;
  REFUSED(shaftcull_view_factors(walls, occluders, &options, &matrix), "1 MB");

  static const shaftcull_index_pair floor_and_ceiling[1] = {{0, 1}};
  static const uint64_t first_candidate[2] = {0, 1};
  static const uint32_t candidates[2] = {0, 1};
  shaftcull_undecided_pairs pairs = {floor_and_ceiling, 1, first_candidate, candidates};
  float fraction = -1;
  OK(shaftcull_visible_fractions(walls, NULL, occluders, &pairs, NULL, &fraction));
  CHECK(fraction > 0.2F && fraction < 0.8F);
  float same = -1;
  OK(shaftcull_visible_fractions(walls, walls, occluders, &pairs, NULL, &same));
  CHECK(same == fraction);
  shaftcull_ray_options rays = shaftcull_default_ray_options();
  CHECK(rays.seed == 1 && rays.error == 0 && rays.rays == 64 && rays.tolerance == 0);
  rays.rays = 65537;
  REFUSED(shaftcull_visible_fractions(walls, NULL, occluders, &pairs, &rays, &fraction), "rays");
  REFUSED(shaftcull_visible_fractions(NULL, NULL, occluders, &pairs, NULL, &fraction), "a is NULL");
  REFUSED(shaftcull_visible_fractions(walls, NULL, NULL, &pairs, NULL, &fraction), "occluders is NULL");
  REFUSED(shaftcull_visible_fractions(walls, NULL, occluders, NULL, NULL, &fraction), "pairs is NULL");
  REFUSED(shaftcull_visible_fractions(walls, NULL, occluders, &pairs, NULL, NULL), "fractions is NULL");

  static const float lights[6] = {0, 0, 1, 0, 0, -1};
  float lit[12] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
  OK(shaftcull_lit_fractions(walls, occluders, lights, 2, NULL, lit));
  CHECK(lit[0] >= 0 && lit[0] <= 1 && lit[1] == 0);
  OK(shaftcull_lit_fractions(walls, occluders, NULL, 0, NULL, NULL));
  static const float no_light[3] = {0, 0, 0};
  REFUSED(shaftcull_lit_fractions(walls, occluders, no_light, 1, NULL, lit), "direction");
  REFUSED(shaftcull_lit_fractions(walls, occluders, lights, 2, &rays, lit), "rays");
  rays = shaftcull_default_ray_options();
  rays.reserved[1] = 1;
  REFUSED(shaftcull_lit_fractions(walls, occluders, lights, 2, &rays, lit), "options.reserved is not 0");
  REFUSED(shaftcull_lit_fractions(NULL, occluders, lights, 2, NULL, lit), "patches is NULL");
  REFUSED(shaftcull_lit_fractions(walls, NULL, lights, 2, NULL, lit), "occluders is NULL");
  REFUSED(shaftcull_lit_fractions(walls, occluders, NULL, 2, NULL, lit), "directions is NULL");
  REFUSED(shaftcull_lit_fractions(walls, occluders, lights, 2, NULL, NULL), "fractions is NULL");

  pairs.candidates = candidates + 1;
  REFUSED(shaftcull_visible_fractions(walls, NULL, occluders, &pairs, NULL, &fraction), "candidate 1");
  pairs.candidates = NULL;
  REFUSED(shaftcull_visible_fractions(walls, NULL, occluders, &pairs, NULL, &fraction), "pairs.candidates is NULL");
  pairs.first_candidate = NULL;
  REFUSED(shaftcull_visible_fractions(walls, NULL, occluders, &pairs, NULL, &fraction), "first_candidate");
  pairs.pairs = NULL;
  REFUSED(shaftcull_visible_fractions(walls, NULL, occluders, &pairs, NULL, &fraction), "pairs.pairs is NULL");

  shaftcull_occluders_free(occluders);
  shaftcull_patches_free(walls);
  shaftcull_patches_free(from_both);
}

static void instruction_sets(void) {
  const char* name = NULL;
  uint64_t count = 0;
  for (;; ++count) {
    OK(shaftcull_isa_name(count, &name));
    if (name == NULL) break;
    OK(shaftcull_select_isa(name));
    const char* active = NULL;
    OK(shaftcull_isa_name(SHAFTCULL_NONE, &active));
    CHECK(strcmp(active, name) == 0);
  }
  CHECK(count >= 1);
  OK(shaftcull_isa_name(UINT64_MAX - 1, &name));
  CHECK(name == NULL);
  REFUSED(shaftcull_isa_name(0, NULL), "name is NULL");
  REFUSED(shaftcull_select_isa("mmx"), "\"mmx\" is no instruction set; this machine has scalar");
  REFUSED(shaftcull_select_isa(NULL), "name is NULL");
}

int main(void) {
  versions_and_names();
  values();
  hulls();
  arrays_of_shafts();
  views_and_streams();
  trees();
  dynamic_trees();
  layers();
  one_shaft();
  queries();
  many_shafts();
  visibility();
  rays_and_view_factors();
  instruction_sets();
  if (failures != 0) {
    fprintf(stderr, "%d checks failed\n", failures);
    return 1;
  }
  printf("all checks passed\n");
  return 0;
}
