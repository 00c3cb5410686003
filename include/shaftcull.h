// SPDX-License-Identifier: MIT
/// shaftcull in C: shafts between boxes and of moving boxes, convex hulls, and what bounds they keep.
///
/// docs/c.md has an example. What each answer means is said once, in the C++ headers beside this one: `cull.hpp`,
/// `many.hpp`, `query.hpp` and so on. Here it is said what a call reads, writes, allocates and refuses.
///
/// Objects. A *shaft* is an entry of an array, shaftcull_shafts, which aligns its memory itself. *Bounds*,
/// shaftcull_bounds, are boxes, spheres or triangles, in one of three holders: a view of the caller's own memory, a
/// stream that owns a checked and aligned copy, or a tree. Every question takes bounds of any holder, with the same
/// options, and gives the same answer. Each object is made by a function that says so, and freed by the one that has
/// its type's name and `_free`.
///
/// Positions in messages of calls for some shafts of an array count from the first of these.
///
/// Errors. A function that can fail returns a shaftcull_status: SHAFTCULL_OK, or why not. Then
/// shaftcull_error_message() says what is wrong, where, and what would be right. Nothing was written unless the
/// function says otherwise, and objects are as they were. Pointers must not be NULL unless the function says so; an
/// array of 0 elements may be. Every function with a status refuses a NULL with SHAFTCULL_INVALID_ARGUMENT. It checks
/// all sizes, indices and enumerators, and of floats what the function says. It cannot check that memory is as large as
/// said, nor that a handle was not freed.
/// Every such function can return SHAFTCULL_OUT_OF_MEMORY if it allocates, its message included.
///
/// Threads. Whatever takes an object as `const` may be called from many threads at once. Whatever takes it without may
/// not, while another thread uses that object. Different objects are independent. The functions named `…_many`, and
/// those that build and update trees, run in parallel on oneTBB if the library was built with it. They may be called
/// from tasks of the caller's own. No call takes more than 64 KiB of the stack.
///
/// Allocation. Questions of one shaft allocate nothing, unless they say so. Those of many shafts that write bits or
/// numbers allocate what oneTBB needs for tasks; if there is no memory for that, what they were to write holds
/// anything. shaftcull_query says what candidates take.
///
/// Results. Bits: bit i % 64 of word i / 64 is bound i, and shaftcull_bit_words(count) words hold them; the call wants
/// exactly so many. Bits past the last bound are zero. Rows of many shafts are one behind the other. Lists: a call
/// that lists into the caller's memory writes as many results as there is room for, and tells how many there are,
/// whether they fit or not. Room for 0 is legal, and then the array may be NULL. Room behind the last result may be
/// overwritten with anything.
///
/// Indices are 32 bits wide. A tree holds at most 2³² − 1 bounds; more are refused. A view or stream may have more:
/// it is asked for bits and counts, and calls that list its bounds or find first contact refuse it. Ask views of its
/// parts then, and add to their indices where each part begins.
///
/// Enumerators are fixed-width integers with the constants below. Structs are plain, and on machines of 64 bits every
/// byte of them belongs to a field. Fields named `reserved` must be 0.
///
/// Compatibility. Within a major version, functions, constants and uses of reserved fields are added, and nothing is
/// changed or taken away. While the major version is 0, a new minor version may change what there is.
#ifndef SHAFTCULL_H
#define SHAFTCULL_H

#include <stdint.h>

/* SHAFTCULL_SHARED comes with the CMake target, and with pkg-config's flags, where the library is a shared one. */
/* shaftcull_c_EXPORTS comes with the sources of a shared library that CMake builds. */
#if !defined(SHAFTCULL_SHARED)
/// Stands before each function: makes it visible in a shared library.
#define SHAFTCULL_API
#elif !defined(_WIN32)
#define SHAFTCULL_API __attribute__((visibility("default")))
#elif defined(shaftcull_c_EXPORTS)
#define SHAFTCULL_API __declspec(dllexport)
#else
#define SHAFTCULL_API __declspec(dllimport)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Version and errors ---- */

/// Why a call failed, or SHAFTCULL_OK.
typedef int32_t shaftcull_status;
enum {
  SHAFTCULL_OK = 0,               /* It did not. */
  SHAFTCULL_INVALID_ARGUMENT = 1, /* An argument breaks a rule of the function. */
  SHAFTCULL_BAD_BOUND = 2,        /* A bound or point in the caller's memory cannot be used: NaN, lo > hi, and so on;
                                     or a shaft of a batch cannot be formed. shaftcull_error_position() says which. */
  SHAFTCULL_NEEDS_REFIT = 3,      /* A tree was asked between an update by index and shaftcull_tree_refit(). */
  SHAFTCULL_OUT_OF_MEMORY = 4,    /* No memory was left. */
  SHAFTCULL_STOPPED = 5,          /* A callback returned something else than 0. */
  SHAFTCULL_INTERNAL_ERROR = 6    /* A fault of the library or of the system; the message says what is known. */
};

/// What shaftcull_error_position() and shaftcull_find_occluder() give where there is none.
#define SHAFTCULL_NONE UINT64_MAX

/// The version that this header belongs to, to compare with shaftcull_version(): major · 1,000,000 + minor · 1,000 +
/// patch.
#define SHAFTCULL_HEADER_VERSION 1000

/// The version of the library that runs, as SHAFTCULL_HEADER_VERSION. Never fails. O(1).
SHAFTCULL_API uint32_t shaftcull_version(void);

/// The same as text, "0.1.0". Valid for ever. Never fails. O(1).
SHAFTCULL_API const char* shaftcull_version_string(void);

/// What the last call of this thread that failed says: what is wrong, where, and what would be right. Empty if none
/// failed. UTF-8; valid until the next call of this thread that fails. Never NULL, never fails. O(1).
SHAFTCULL_API const char* shaftcull_error_message(void);

/// The position of the bad bound, if the last call of this thread that failed returned SHAFTCULL_BAD_BOUND: counted
/// from 0 in the array that it came from. Otherwise SHAFTCULL_NONE. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_error_position(void);

/// What a build without exceptions (SHAFTCULL_WITH_EXCEPTIONS=OFF) calls in place of returning why a call failed: the
/// status that it would return, and what shaftcull_error_message() and shaftcull_error_position() say. It ends the
/// program in its own way: the library cannot go on, and does not leave things as they were. Where it returns, the
/// program ends. A callback that ends a call is told of, too.
typedef void (*shaftcull_error_handler)(shaftcull_status status, const char* message, uint64_t position);

/// Sets the handler, and returns the one before. NULL, as at first: the message goes to standard error, and the program
/// ends. Builds with exceptions never call it. Never fails. O(1).
SHAFTCULL_API shaftcull_error_handler shaftcull_set_error_handler(shaftcull_error_handler handler);

/// The name of a status, "bad bound" say; "unknown status" for a number that is none. Valid for ever. Never fails.
/// O(1).
SHAFTCULL_API const char* shaftcull_status_name(shaftcull_status status);

/* ---- Values ---- */

/// An axis-aligned box: x, y, z of its low and of its high corner, lo ≤ hi. The empty box has lo = +∞ and hi = −∞.
typedef struct shaftcull_box {
  float lo[3]; /* the least coordinates */
  float hi[3]; /* the greatest coordinates */
} shaftcull_box;

/// A ball: all points that are at most the radius away from the centre. A radius of 0 is a point.
typedef struct shaftcull_sphere {
  float centre[3]; /* its middle */
  float radius;    /* 0 or more */
} shaftcull_sphere;

/// Three vertices. Which way round they are says nothing.
typedef struct shaftcull_triangle {
  float vertex[3][3]; /* in any order */
} shaftcull_triangle;

/// A half-space: normal·p ≤ offset is its inside. The normal need not have unit length.
typedef struct shaftcull_plane {
  float normal[3]; /* points out of the half-space */
  float offset;    /* what normal·p is on the plane */
} shaftcull_plane;

/// Two boxes, by their positions in arrays.
typedef struct shaftcull_index_pair {
  uint32_t a; /* in the array of boxes a */
  uint32_t b; /* in the array of boxes b */
} shaftcull_index_pair;

/// How many bounds overlap a shaft and how many are inside. Kept are both together.
typedef struct shaftcull_kept_counts {
  uint64_t overlap; /* not outside, and not inside either */
  uint64_t inside;  /* inside entirely */
} shaftcull_kept_counts;

/// What a moving box reaches first, and when; the time is rounded down. Nothing: SHAFTCULL_NONE, +∞ and 0.
typedef struct shaftcull_contact_found {
  uint64_t index; /* of the bound */
  float time;     /* of first contact */
  uint32_t found; /* 1, or 0 for nothing */
} shaftcull_contact_found;

/// What becomes of a bound that touches a shaft without reaching into it.
typedef uint32_t shaftcull_contact;
enum {
  SHAFTCULL_CONTACT_CLOSED = 0, /* It is kept. */
  SHAFTCULL_CONTACT_OPEN = 1    /* It is outside, unless relative interiors meet. */
};

/// What a shaft says of one bound.
typedef uint32_t shaftcull_answer;
enum {
  SHAFTCULL_OUTSIDE = 0, /* Nothing of it is in the shaft. */
  SHAFTCULL_OVERLAP = 1, /* A part of it is, or it touches. */
  SHAFTCULL_INSIDE = 2   /* All of it is. */
};

/// Which form of a shaft decides outside, of boxes and spheres. Answers are the same; speed is not.
typedef uint32_t shaftcull_form;
enum {
  SHAFTCULL_FORM_SLAB = 0,  /* the shaft as a moving box: always faster */
  SHAFTCULL_FORM_PLANES = 1 /* the paper's planes with near corners */
};

/// How triangles are tested (triangles.hpp). Convex hulls take the test by vertices only.
typedef uint32_t shaftcull_triangle_test;
enum {
  SHAFTCULL_TRIANGLES_EXACT = 0,      /* the triangle itself */
  SHAFTCULL_TRIANGLES_BY_VERTICES = 1 /* the box around the vertices, and added planes */
};

/// Which depths in clip space are in view.
typedef uint32_t shaftcull_clip_depth;
enum {
  SHAFTCULL_DEPTH_ZERO_TO_ONE = 0,     /* 0 ≤ z ≤ w: Direct3D, Vulkan, Metal, and reversed depth */
  SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE = 1 /* −w ≤ z ≤ w: OpenGL */
};

/// How the edges that need a joining plane are found. All give the same shaft.
typedef uint32_t shaftcull_formation;
enum {
  SHAFTCULL_FORMATION_SEARCH = 0,  /* all pairs of faces are compared */
  SHAFTCULL_FORMATION_TABLE64 = 1, /* two colours a face are looked up */
  SHAFTCULL_FORMATION_TABLE729 = 2 /* three colours a face are looked up */
};

/// The order in which joining planes are tested. It changes speed, never answers.
typedef uint32_t shaftcull_plane_order;
enum {
  SHAFTCULL_ORDER_UNSORTED = 0,       /* as they are formed */
  SHAFTCULL_ORDER_BY_VOLUME = 1,      /* first the plane that cuts most off */
  SHAFTCULL_ORDER_BY_ADDED_VOLUME = 2 /* first the one that cuts most off what is left */
};

/// The number of 64-bit words that hold one bit for each of `bounds` bounds. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_bit_words(uint64_t bounds);

/* ---- Helpers for boxes and planes. None allocates more than it says. ---- */

/// The smallest box around `count` points, 3 floats each; the empty box if there are none. SHAFTCULL_BAD_BOUND for the
/// first point with a NaN. O(count); allocates a copy of the points.
SHAFTCULL_API shaftcull_status shaftcull_box_around(const float* points, uint64_t count, shaftcull_box* box);

/// The smallest box around both. The empty box adds nothing. No coordinate may be NaN. O(1).
SHAFTCULL_API shaftcull_status shaftcull_joined(const shaftcull_box* a, const shaftcull_box* b, shaftcull_box* box);

/// The box moved by a vector of 3 floats, rounded outwards. Refuses a vector that is not finite. O(1).
SHAFTCULL_API shaftcull_status shaftcull_translated(const shaftcull_box* box, const float by[3], shaftcull_box* moved);

/// The box with every face moved out by a distance, rounded outwards. Refuses a negative or infinite one. O(1).
SHAFTCULL_API shaftcull_status shaftcull_inflated(const shaftcull_box* box, float by, shaftcull_box* inflated);

/// The planes of a view-projection matrix, normals outwards: up to six of them into `planes`, and how many into
/// `count`. The matrix has 4 rows of 4 floats, row after row, and maps column vectors; matrices of other conventions
/// have to be transposed. Refuses a matrix that is not finite or leaves nothing in view. O(1).
SHAFTCULL_API shaftcull_status shaftcull_view_planes(const float matrix[16], shaftcull_clip_depth depth,
                                                     shaftcull_plane planes[6], uint64_t* count);

/* ---- One formed shaft, with its planes ---- */

/// What a shaft is formed for; leaving an answer out makes forming cheaper, and asking for it is then refused.
typedef struct shaftcull_shaft_options {
  shaftcull_formation formation; /* how it is formed */
  shaftcull_plane_order order;   /* how its planes are sorted */
  uint32_t outside;              /* 1: what is kept may be asked */
  uint32_t inside;               /* 1: what is inside may be asked */
  uint32_t spheres;              /* 1: spheres may be asked about */
  shaftcull_contact contact;     /* what becomes of what only touches */
  shaftcull_form form;           /* what decides outside */
  uint32_t reserved[1];          /* 0 */
} shaftcull_shaft_options;

/// A joining plane: it cuts the edge between two neighbouring faces off the shaft's box. Faces 0, 1, 2 are lo x, y, z;
/// 3, 4, 5 are hi x, y, z.
typedef struct shaftcull_joining_plane {
  shaftcull_plane plane; /* the normal points out of the shaft */
  uint32_t red;          /* the face that only the first box touches */
  uint32_t blue;         /* the face that only the second box touches */
} shaftcull_joining_plane;

/// What a formed shaft is made of.
typedef struct shaftcull_shaft_info {
  shaftcull_box a;                 /* as given */
  shaftcull_box b;                 /* as given */
  shaftcull_box box;               /* the smallest box around both */
  shaftcull_shaft_options options; /* what it was formed for */
  uint64_t joining_planes;         /* how many; at most 8 */
  uint64_t added_planes;           /* how many; at most 16 */
} shaftcull_shaft_info;

/// A shaft between two boxes, formed with its planes. It answers nothing itself: put it into an array by
/// shaftcull_shafts_set_formed().
typedef struct shaftcull_shaft shaftcull_shaft;

/// All answers, the quickest formation, closed contact. Never fails.
SHAFTCULL_API shaftcull_shaft_options shaftcull_default_shaft_options(void);

/// Forms the shaft between boxes `a` and `b`. `options` may be NULL: the default ones. Refuses boxes that are not
/// finite or have lo > hi, and options that ask for no answer. Freed by shaftcull_shaft_free(). O(1).
SHAFTCULL_API shaftcull_status shaftcull_shaft_create(const shaftcull_box* a, const shaftcull_box* b,
                                                      const shaftcull_shaft_options* options, shaftcull_shaft** shaft);

/// Frees a shaft; does nothing for NULL. Arrays that it was put into keep their copy.
SHAFTCULL_API void shaftcull_shaft_free(shaftcull_shaft* shaft);

/// Adds a half-space that bounds must also meet: a bound fully outside of it is outside. At most 16. Refuses a plane
/// that is not finite or has no normal. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_shaft_add_plane(shaftcull_shaft* shaft, const shaftcull_plane* plane);

/// Boxes, options and numbers of planes. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_shaft_describe(const shaftcull_shaft* shaft, shaftcull_shaft_info* info);

/// The joining planes, in the order in which they are tested: up to 8 into `planes`, and how many into `count`. O(1).
SHAFTCULL_API shaftcull_status shaftcull_shaft_joining_planes(const shaftcull_shaft* shaft,
                                                              shaftcull_joining_plane planes[8], uint64_t* count);

/// The added planes, in the order in which they were added: up to 16 into `planes`, and how many into `count`. O(1).
SHAFTCULL_API shaftcull_status shaftcull_shaft_added_planes(const shaftcull_shaft* shaft, shaftcull_plane planes[16],
                                                            uint64_t* count);

/// The volume that a joining plane cuts off a box, in the coordinates' unit cubed. Refuses faces that are no
/// neighbours. O(1).
SHAFTCULL_API shaftcull_status shaftcull_culled_volume(const shaftcull_box* box, const shaftcull_joining_plane* plane,
                                                       double* volume);

/* ---- Convex hulls ---- */

/// The convex hull of up to 32 points and directions: view frusta, what casts shadows into view, volumes between
/// polygons or turned boxes. It answers nothing itself: put it into an array by shaftcull_shafts_set_hull().
typedef struct shaftcull_hull shaftcull_hull;

/// The hull of `point_count` points, 3 floats each, and of what lies from them along `direction_count` directions. With
/// no direction `directions` may be NULL. For a frustum, pass its eight corners; for two polygons or turned boxes, the
/// corners of both. Refuses no points, more than 32 in all, what is not finite, and a direction of 0. O(n³): some 3 µs
/// for 8 points, 150 µs for 32. Allocates some 8 KB. Freed by shaftcull_hull_free().
SHAFTCULL_API shaftcull_status shaftcull_hull_create(const float* points, uint64_t point_count, const float* directions,
                                                     uint64_t direction_count, shaftcull_hull** hull);

/// What a view-projection matrix shows; the matrix is as for shaftcull_view_planes(). Without a far plane the hull has
/// no end. Refuses a matrix that is not finite or not invertible, or of a corner that is not in front of the eye. Some
/// 3 µs; allocates some 8 KB. Freed by shaftcull_hull_free().
SHAFTCULL_API shaftcull_status shaftcull_hull_of_frustum(const float matrix[16], shaftcull_clip_depth depth,
                                                         shaftcull_hull** hull);

/// What can cast a shadow into `view` by a light at a point of 3 floats. Refuses a light that is not finite, and a view
/// of 32 points and directions. Time and allocation of shaftcull_hull_create(). Freed by shaftcull_hull_free().
SHAFTCULL_API shaftcull_status shaftcull_hull_of_casters(const shaftcull_hull* view, const float light[3],
                                                         shaftcull_hull** hull);

/// What can cast a shadow into `view` by a sun in a direction of 3 floats, which is not 0. As
/// shaftcull_hull_of_casters().
SHAFTCULL_API shaftcull_status shaftcull_hull_of_casters_towards(const shaftcull_hull* view, const float towards_sun[3],
                                                                 shaftcull_hull** hull);

/// Frees a hull; does nothing for NULL. Arrays that it was put into keep what they need of it.
SHAFTCULL_API void shaftcull_hull_free(shaftcull_hull* hull);

/// The box around the hull, infinite where directions lead. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_hull_box(const shaftcull_hull* hull, shaftcull_box* box);

/// Points, then directions, as they were given: 3 floats each into `floats`, which has room for 96, and how many of
/// each into the two counts. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_hull_points(const shaftcull_hull* hull, float floats[96],
                                                     uint64_t* point_count, uint64_t* direction_count);

/* ---- Bounds: views, streams and trees of boxes, spheres or triangles ---- */

/// What bounds are.
typedef uint32_t shaftcull_bound_kind;
enum {
  SHAFTCULL_BOXES = 1,    /* shaftcull_box */
  SHAFTCULL_SPHERES = 2,  /* shaftcull_sphere */
  SHAFTCULL_TRIANGLES = 3 /* shaftcull_triangle */
};

/// What holds bounds.
typedef uint32_t shaftcull_holder;
enum {
  SHAFTCULL_VIEW = 1,   /* the caller's own memory */
  SHAFTCULL_STREAM = 2, /* a checked, aligned copy */
  SHAFTCULL_TREE = 3    /* a sorted copy, under a tree */
};

/// Bounds of one kind in one holder.
typedef struct shaftcull_bounds shaftcull_bounds;

/// How the bounds lie in memory that a source names.
typedef uint32_t shaftcull_source_kind;
enum {
  SHAFTCULL_SOURCE_BOXES = 1,     /* lo at `first`, hi at `second`, 3 floats each */
  SHAFTCULL_SOURCE_CENTRES = 2,   /* boxes: centre at `first`, half extent at `second`, 3 floats each */
  SHAFTCULL_SOURCE_SPHERES = 3,   /* centre at `first`, 3 floats, and radius at `second` */
  SHAFTCULL_SOURCE_TRIANGLES = 4, /* 9 floats at `first` */
  SHAFTCULL_SOURCE_MESH = 5,      /* vertices of 3 floats at `first`; triangle i has those that indices 3 i to 3 i + 2
                                     name */
  SHAFTCULL_SOURCE_BOUNDS = 6     /* `bounds`: all of a view or stream, or the leaves of a tree, in its order */
};

/// Bounds in the caller's memory, for a call to read. Record i is at byte `first + i * stride`, and at
/// `second + i * stride`: any stride, any alignment. So members of the caller's own structs can be named. Nothing is
/// kept: memory need not outlive the call. Fields that the kind does not name must be 0.
typedef struct shaftcull_source {
  shaftcull_source_kind kind;     /* which of the following fields are read */
  uint32_t reserved;              /* 0 */
  uint64_t count;                 /* of bounds; of SHAFTCULL_SOURCE_BOUNDS it must be 0, since these know it */
  const void* first;              /* of record 0, as the kind says */
  const void* second;             /* of record 0, as the kind says */
  uint64_t stride;                /* bytes from one record to the next */
  const uint32_t* indices;        /* of a mesh: three a triangle */
  uint64_t vertex_count;          /* of a mesh */
  const shaftcull_bounds* bounds; /* of SHAFTCULL_SOURCE_BOUNDS */
} shaftcull_source;

/// The source of an array of boxes. Never fails; reads nothing yet.
SHAFTCULL_API shaftcull_source shaftcull_boxes(const shaftcull_box* boxes, uint64_t count);

/// The source of an array of spheres. Never fails; reads nothing yet.
SHAFTCULL_API shaftcull_source shaftcull_spheres(const shaftcull_sphere* spheres, uint64_t count);

/// The source of an array of triangles. Never fails; reads nothing yet.
SHAFTCULL_API shaftcull_source shaftcull_triangles(const shaftcull_triangle* triangles, uint64_t count);

/// The source of an indexed mesh of `count` triangles: 3 floats a vertex, 3 indices a triangle. Never fails; reads
/// nothing yet.
SHAFTCULL_API shaftcull_source shaftcull_mesh(const float* vertices, uint64_t vertex_count, const uint32_t* indices,
                                              uint64_t count);

/// The source of bounds that there are. Never fails; reads nothing yet.
SHAFTCULL_API shaftcull_source shaftcull_source_of(const shaftcull_bounds* bounds);

/// A view of `count` bounds in the caller's memory, as separate streams of `count` floats each. Boxes have 6: lo x, y,
/// z, hi x, y, z. Spheres have 4: centre x, y, z, radius. Triangles have 9: x, y, z of vertex 0, then 1, then 2. The
/// memory must outlive the view's use; each question reads the values as they are then, and never checks them. With a
/// count of 0 streams may be NULL. Freed by shaftcull_bounds_free(). O(1).
SHAFTCULL_API shaftcull_status shaftcull_view_create(shaftcull_bound_kind kind, const float* const* streams,
                                                     uint64_t count, shaftcull_bounds** bounds);

/// Points a view at other memory, of the same kind of bounds. Layers stay those that they are: set them again, or clear
/// them, if the count is another one. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_view_set(shaftcull_bounds* view, const float* const* streams, uint64_t count);

/// A stream of the bounds of a source. SHAFTCULL_BAD_BOUND for the first that has a NaN, lo > hi, a negative radius or
/// half extent, or is not finite where it must be. O(count); allocates 24 bytes a box, 16 a sphere, 36 a triangle, and
/// 36 more on the way for SHAFTCULL_SOURCE_TRIANGLES. Freed by shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_stream_create(const shaftcull_source* source, shaftcull_bounds** bounds);

/// A stream of `count` empty bounds, which no shaft keeps, to be filled by shaftcull_stream_update(). O(count);
/// allocates as shaftcull_stream_create(). Freed by shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_stream_create_empty(shaftcull_bound_kind kind, uint64_t count,
                                                             shaftcull_bounds** bounds);

/// Replaces the bounds of a stream from `first` on by those of a source, which must be of its kind and not lie in its
/// own memory. The range must lie within the stream. Errors as shaftcull_stream_create(). O(count of the source); no
/// allocation, except for SHAFTCULL_SOURCE_TRIANGLES. Disjoint ranges may be updated by several threads at once.
SHAFTCULL_API shaftcull_status shaftcull_stream_update(shaftcull_bounds* stream, uint64_t first,
                                                       const shaftcull_source* source);

/// A copy, layers included: of a view another view of the same memory, of all else a deep one. O(count). Freed by
/// shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_bounds_copy(const shaftcull_bounds* bounds, shaftcull_bounds** copy);

/// Frees bounds; does nothing for NULL. The memory that a view looks at stays the caller's.
SHAFTCULL_API void shaftcull_bounds_free(shaftcull_bounds* bounds);

/// What bounds are and how much memory they hold.
typedef struct shaftcull_bounds_info {
  uint64_t count;            /* of bounds */
  uint64_t memory_bytes;     /* that the library holds, padding included: of a view those of layers alone */
  shaftcull_bound_kind kind; /* what they are */
  shaftcull_holder holder;   /* what holds them */
  uint32_t needs_refit;      /* 1 if a tree was updated by index since the last refit */
  uint32_t has_layers;       /* 1 if bounds were put into layers */
} shaftcull_bounds_info;

/// Kind, holder, count and state of bounds. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_bounds_describe(const shaftcull_bounds* bounds, shaftcull_bounds_info* info);

/// Where the floats of bounds are: as many streams as shaftcull_view_create() says for the kind, and NULL in the rest
/// of `streams`; those of a tree in its order. Valid until the bounds are freed, or a tree is rebuilt; updates show.
/// O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_bounds_streams(const shaftcull_bounds* bounds, const float* streams[9]);

/// Puts bounds into layers, by which queries can pick (shaftcull_query): bit l of layers[i] says that bound i is in
/// layer l. There must be one set for each bound. Replaces the layers that there were. Layers belong to indices, stay
/// when bounds are updated, and are no part of a source. Refuses a tree of triangles. O(n); allocates 4 bytes a bound.
SHAFTCULL_API shaftcull_status shaftcull_bounds_set_layers(shaftcull_bounds* bounds, const uint32_t* layers,
                                                           uint64_t count);

/// Puts bound indices[i] into layers[i], for `count` of them; the bounds must have layers. If an index comes twice, the
/// last counts. Refuses a tree of triangles. O(count), except for the first such call of a tree, which is O(n) and may
/// allocate an index a bound.
SHAFTCULL_API shaftcull_status shaftcull_bounds_set_layers_of(shaftcull_bounds* bounds, const uint32_t* indices,
                                                              const uint32_t* layers, uint64_t count);

/// Forgets all layers, and frees their memory. Refuses a tree of triangles. O(1).
SHAFTCULL_API shaftcull_status shaftcull_bounds_clear_layers(shaftcull_bounds* bounds);

/// The layers of bounds: (*layers)[i] are those of bound i, or of a tree those of leaf i. NULL if there are none. Valid
/// until layers are set or cleared, a tree is rebuilt, or the bounds are freed. Refuses a tree of triangles. O(1); no
/// allocation.
SHAFTCULL_API shaftcull_status shaftcull_bounds_layers(const shaftcull_bounds* bounds, const uint32_t** layers);

/* ---- Trees ---- */

/// A tree of the bounds of a source. The order depends on the bounds and their positions alone. SHAFTCULL_BAD_BOUND as
/// for shaftcull_stream_create(). Refuses more than 2³² − 1 bounds. O(n log n), in parallel; holds the bounds, an index
/// a bound, and about 2 % more. Freed by shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_tree_create(const shaftcull_source* source, shaftcull_bounds** tree);

/// The box around all bounds of a tree, the empty box if there are none. SHAFTCULL_NEEDS_REFIT if it does. O(1).
SHAFTCULL_API shaftcull_status shaftcull_tree_box(const shaftcull_bounds* tree, shaftcull_box* box);

/// The order of a tree: (*order)[p] is the caller's index of leaf p, for each bound. Valid until the tree is freed,
/// rebuilt or reordered. NULL if it is empty. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_tree_order(const shaftcull_bounds* tree, const uint32_t** order);

/// Gives every bound of a tree of boxes or spheres a new value, bound i that of the source at i, and refits: O(n), in
/// parallel. Refuses another number of bounds, and those of the tree itself. If oneTBB cannot start its tasks, the tree
/// needs a refit, and each bound has its old value or its new one.
SHAFTCULL_API shaftcull_status shaftcull_tree_update(shaftcull_bounds* tree, const shaftcull_source* source);

/// Gives bound indices[i] the value of the source at i, for `count` indices. If an index comes twice, the last counts.
/// Questions then return SHAFTCULL_NEEDS_REFIT until shaftcull_tree_refit(). The first call allocates an index a bound.
/// O(count), except for the first, which is O(n). Refuses triangles, and an index not below the number of bounds.
SHAFTCULL_API shaftcull_status shaftcull_tree_update_some(shaftcull_bounds* tree, const uint32_t* indices,
                                                          uint64_t count, const shaftcull_source* source);

/// Fits the nodes of a tree of boxes or spheres to bounds that were updated by index. O(updated), at most O(n).
SHAFTCULL_API shaftcull_status shaftcull_tree_refit(shaftcull_bounds* tree);

/// Sorts the bounds of a tree of boxes or spheres as they are now. Indices stay, the order changes. As building.
SHAFTCULL_API shaftcull_status shaftcull_tree_rebuild(shaftcull_bounds* tree);

/// Gives the bounds of a tree of boxes or spheres new indices, in its order: the index of leaf p becomes p. O(n).
SHAFTCULL_API shaftcull_status shaftcull_tree_renumber(shaftcull_bounds* tree);

/// How much larger the nodes of a tree of boxes or spheres have become since it was built, 1 at first; at 2 or 3 a
/// rebuild pays. SHAFTCULL_NEEDS_REFIT if it does. O(n / 64); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_tree_sah_ratio(const shaftcull_bounds* tree, double* sah_ratio);

/* ---- Arrays of shafts ---- */

/// An array of test-ready shafts of all kinds, hulls included. 832 bytes a shaft, aligned by the library.
typedef struct shaftcull_shafts shaftcull_shafts;

/// What is known of one shaft of an array.
typedef struct shaftcull_shafts_info {
  shaftcull_box a;           /* as given; of a moving box where it starts, of a hull the box around it */
  shaftcull_box b;           /* as given; of a moving box where it ends, rounded to nearest */
  uint32_t formed;           /* 1 if it was set */
  uint32_t has_planes;       /* 1 if its joining planes are there */
  shaftcull_contact contact; /* what becomes of what only touches */
  uint32_t is_hull;          /* 1 if it is a convex hull */
  shaftcull_form form;       /* what decides outside */
} shaftcull_shafts_info;

/// Planes for the shafts of a batch: those of a shaft's box a, then those of its box b. Each box has as many as all
/// others of its array, k = count / boxes, and box i has planes k · i to k · i + k − 1. All zero: none.
typedef struct shaftcull_batch_planes {
  const shaftcull_plane* a; /* of the boxes a */
  uint64_t a_count;         /* of all of them */
  const shaftcull_plane* b; /* of the boxes b */
  uint64_t b_count;         /* of all of them */
} shaftcull_batch_planes;

/// An array of `count` shafts that were never formed. Questions refuse such a shaft, by its position. Freed by
/// shaftcull_shafts_free(). O(count).
SHAFTCULL_API shaftcull_status shaftcull_shafts_create(uint64_t count, shaftcull_shafts** shafts);

/// Frees an array; does nothing for NULL.
SHAFTCULL_API void shaftcull_shafts_free(shaftcull_shafts* shafts);

/// How many shafts an array has; 0 for NULL. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_shafts_count(const shaftcull_shafts* shafts);

/// Copies shafts from [source_first, source_first + count) of `source` to [first, first + count) of `shafts`. Both may
/// be the same array, and ranges may overlap. O(count); if `source` ever held a hull, O(all of `shafts`) the first
/// time, and allocates as shaftcull_shafts_set_hull().
SHAFTCULL_API shaftcull_status shaftcull_shafts_copy(shaftcull_shafts* shafts, uint64_t first,
                                                     const shaftcull_shafts* source, uint64_t source_first,
                                                     uint64_t count);

/// What is known of a shaft. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_describe(const shaftcull_shafts* shafts, uint64_t shaft,
                                                         shaftcull_shafts_info* info);

/// The shaft between boxes `a` and `b`, which are finite with lo ≤ hi. Some 12 ns; no allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_between(shaftcull_shafts* shafts, uint64_t shaft,
                                                            const shaftcull_box* a, const shaftcull_box* b,
                                                            shaftcull_contact contact);

/// A formed shaft, with its options, joining planes and added planes. No allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_formed(shaftcull_shafts* shafts, uint64_t shaft,
                                                           const shaftcull_shaft* formed);

/// What a body sweeps over that moves by a displacement of 3 floats, cut by `plane_count` planes, 16 at most. With none
/// `planes` may be NULL. Some 0.5 µs; allocates a copy of the planes.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_swept(shaftcull_shafts* shafts, uint64_t shaft,
                                                          const shaftcull_box* body, const float displacement[3],
                                                          const shaftcull_plane* planes, uint64_t plane_count);

/// What a body sweeps over that moves without end in a direction of 3 floats, which is not 0. As
/// shaftcull_shafts_set_swept().
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_swept_infinite(shaftcull_shafts* shafts, uint64_t shaft,
                                                                   const shaftcull_box* body, const float direction[3],
                                                                   const shaftcull_plane* planes, uint64_t plane_count);

/// All that an occluder can shadow from a light, which is apart from it; up to `*reach` times the distance of the
/// occluder, 1 or more, or without end if `reach` is NULL. As shaftcull_shafts_set_swept().
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_shadow(shaftcull_shafts* shafts, uint64_t shaft,
                                                           const shaftcull_box* light, const shaftcull_box* occluder,
                                                           const float* reach, const shaftcull_plane* planes,
                                                           uint64_t plane_count);

/// A convex hull. The array keeps what it needs of it, so the hull may be freed. The first hull of an array allocates
/// 16 bytes for each of its shafts.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_hull(shaftcull_shafts* shafts, uint64_t shaft,
                                                         const shaftcull_hull* hull);

/// The shafts between pairs of boxes, into as many entries from `first` on. Pair i is box pairs[i].a of `a` and box
/// pairs[i].b of `b`, for `pair_count` pairs; or, if `pairs` is NULL, box i of both, which have `pair_count` boxes, or
/// any number if that is 0: then there are no shafts.
/// Sources are of boxes; both may be the same. `planes` may be NULL: none. SHAFTCULL_BAD_BOUND for the first pair with
/// a box that is not finite, or first box that cannot be packed. Of SHAFTCULL_SOURCE_BOUNDS boxes are read where they
/// are, and those that no pair names may be anything. Other sources are packed first, which allocates 24 bytes a box.
/// 5 to 11 ns a shaft. Allocates copies of pairs and planes.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_between_batch(shaftcull_shafts* shafts, uint64_t first,
                                                                  const shaftcull_source* a, const shaftcull_source* b,
                                                                  const shaftcull_index_pair* pairs,
                                                                  uint64_t pair_count,
                                                                  const shaftcull_batch_planes* planes,
                                                                  shaftcull_contact contact);

/// What bodies sweep over, into as many entries from `first` on as there are bodies, each with its displacement of 3
/// floats. Each body has as many planes as the others, `plane_count` in all. SHAFTCULL_BAD_BOUND for the first shaft
/// that cannot be formed. Some 0.5 µs a shaft; allocates copies of displacements and planes, and packs bodies as
/// shaftcull_shafts_set_between_batch().
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_swept_batch(shaftcull_shafts* shafts, uint64_t first,
                                                                const shaftcull_source* bodies,
                                                                const float* displacements,
                                                                const shaftcull_plane* planes, uint64_t plane_count);

/// The same without end, in directions of 3 floats each.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_swept_infinite_batch(shaftcull_shafts* shafts, uint64_t first,
                                                                         const shaftcull_source* bodies,
                                                                         const float* directions,
                                                                         const shaftcull_plane* planes,
                                                                         uint64_t plane_count);

/// What occluders shadow from lights, for pairs of a light and an occluder; `reach` is one for all, or NULL for no end.
/// Pairs, planes, errors and allocation as shaftcull_shafts_set_between_batch(); some 0.5 µs a shaft.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_shadow_batch(
    shaftcull_shafts* shafts, uint64_t first, const shaftcull_source* lights, const shaftcull_source* occluders,
    const shaftcull_index_pair* pairs, uint64_t pair_count, const float* reach, const shaftcull_batch_planes* planes);

/// Computes pending joining planes of `count` shafts from `first` on, some 65 ns each: worth it for shafts that are
/// asked more than once about inside, in the form of planes, or about some spheres. No allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_complete(shaftcull_shafts* shafts, uint64_t first, uint64_t count);

/// Chooses what becomes of bounds that only touch, for `count` shafts from `first` on. Refuses hulls and shafts that
/// were never formed, by their position. Some 10 ns each; no allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_contact(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                            shaftcull_contact contact);

/// Chooses the form in which `count` shafts from `first` on are asked, and computes planes that are pending if it is
/// that of planes, which is for comparisons with the paper. Hulls have one form, and stay as they are. Refuses shafts
/// that were never formed, by their position. No allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_form(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                         shaftcull_form form);

/* ---- How to ask ---- */

/// The options of a question. All zero, or NULL in the place of a pointer to one: all bounds are asked about, in the
/// usual way. Each option works with bounds of every kind in every holder, except where it says otherwise. A question
/// to which one means nothing refuses it by name. What a call writes shares no memory with arrays of its query.
typedef struct shaftcull_query {
  /// Bounds to leave out for all shafts, by index: a moving body itself, say. `exclude_mask` is better for very many.
  const uint32_t* exclude;
  uint64_t exclude_count;
  /// Bounds to leave out for each shaft: a row of indices for each, one behind the other, all equally long. A shaft's
  /// own two objects, say. The count is that of all rows together.
  const uint32_t* exclude_each;
  uint64_t exclude_each_count;
  /// Bounds to leave out for all shafts: those whose bits are set. There are 0 words, or shaftcull_bit_words(count of
  /// bounds).
  const uint64_t* exclude_mask;
  uint64_t exclude_mask_words;
  /// Layers, one set of them for each shaft or one for all: bounds that are in none of them are left out. With a count
  /// of 0 bounds are asked about whatever their layers. The bounds must have layers (shaftcull_bounds_set_layers()).
  const uint32_t* layer_masks;
  uint64_t layer_mask_count;
  /// Candidates, by index: only these bounds are asked about, and lists keep their order. NULL and a count of 0: all
  /// bounds. Not NULL and a count of 0: none. Not for questions about blocking. O(candidates) a shaft. The first such
  /// question of a tree may be O(n) and allocate an index a bound. Those of many shafts allocate a copy of the
  /// candidates' bounds.
  const uint32_t* only;
  uint64_t only_count;
  /// So many results for each shaft at most, those that come first: the question then stops. 0: no limit. For questions
  /// that count or list what is kept, and for shaftcull_list_occluders() and its twin for many shafts.
  uint64_t limit;
  shaftcull_triangle_test triangle_test; /* of triangles; 0 for other bounds */
  uint32_t reserved_word;                /* 0 */
  uint64_t reserved[4];                  /* 0 */
} shaftcull_query;

/* Of all questions: `shafts` and `shaft` name one shaft, or `shafts`, `first` and `count` name some. `bounds` are of
   any kind that the function does not exclude, in any holder. `query` may be NULL. A shaft that was never formed, or
   was formed without the answer asked for, is refused, and a tree that needs a refit with SHAFTCULL_NEEDS_REFIT. A view
   or stream takes O(n) a shaft, a tree what it finds. */

/* ---- One shaft, many bounds ---- */

/// Bits of what the shaft keeps: all that is not outside.
SHAFTCULL_API shaftcull_status shaftcull_cull(const shaftcull_shafts* shafts, uint64_t shaft,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              uint64_t* kept, uint64_t words);

/// Bits of what the shaft keeps, and of what is inside: `words` words each, in separate memory. `kept` may be NULL:
/// then only `inside` is written.
SHAFTCULL_API shaftcull_status shaftcull_classify(const shaftcull_shafts* shafts, uint64_t shaft,
                                                  const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                  uint64_t* kept, uint64_t* inside, uint64_t words);

/// How many bounds the shaft keeps.
SHAFTCULL_API shaftcull_status shaftcull_count(const shaftcull_shafts* shafts, uint64_t shaft,
                                               const shaftcull_bounds* bounds, const shaftcull_query* query,
                                               uint64_t* kept_count);

/// How many bounds overlap the shaft, and how many are inside.
SHAFTCULL_API shaftcull_status shaftcull_count_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                                          const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                          shaftcull_kept_counts* counts);

/// Whether the shaft keeps any bound, 1 or 0. Stops soon after the first that it finds.
SHAFTCULL_API shaftcull_status shaftcull_any(const shaftcull_shafts* shafts, uint64_t shaft,
                                             const shaftcull_bounds* bounds, const shaftcull_query* query,
                                             uint32_t* any);

/// Indices of what the shaft keeps into `kept`, which has room for `room`, and how many there are into `kept_count`:
/// ascending, or in the order of a tree, or in that of candidates. `kept` may begin where the candidates of the query
/// begin, which are then overwritten.
SHAFTCULL_API shaftcull_status shaftcull_list(const shaftcull_shafts* shafts, uint64_t shaft,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              uint32_t* kept, uint64_t room, uint64_t* kept_count);

/// As shaftcull_list(), but what overlaps and what is inside apart, in separate memory.
SHAFTCULL_API shaftcull_status shaftcull_list_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                                         const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                         uint32_t* overlap, uint64_t overlap_room, uint32_t* inside,
                                                         uint64_t inside_room, shaftcull_kept_counts* counts);

/// The bound that the moving box of the shaft reaches first, and when. Not for hulls, nor for triangles.
SHAFTCULL_API shaftcull_status shaftcull_first_contact(const shaftcull_shafts* shafts, uint64_t shaft,
                                                       const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                       shaftcull_contact_found* contact);

/// When the moving box of the shaft reaches each of `count` bounds: times[i] is that of bound indices[i], rounded down,
/// or +∞ if the shaft does not keep it. The two arrays share no memory. Not for hulls, nor for triangles. O(count),
/// except for the first such call of a tree, which may be O(n) and allocate an index a bound.
SHAFTCULL_API shaftcull_status shaftcull_entry_times(const shaftcull_shafts* shafts, uint64_t shaft,
                                                     const shaftcull_bounds* bounds, const uint32_t* indices,
                                                     float* times, uint64_t count);

/// Whether one of these solid boxes alone hides the one end of the shaft from the other, 1 or 0. For boxes, and shafts
/// between two boxes.
SHAFTCULL_API shaftcull_status shaftcull_occluded(const shaftcull_shafts* shafts, uint64_t shaft,
                                                  const shaftcull_bounds* solids, const shaftcull_query* query,
                                                  uint32_t* occluded);

/// The index of a box that does, or SHAFTCULL_NONE: in a view or stream the lowest one, in a tree the first in its
/// order. As shaftcull_occluded().
SHAFTCULL_API shaftcull_status shaftcull_find_occluder(const shaftcull_shafts* shafts, uint64_t shaft,
                                                       const shaftcull_bounds* solids, const shaftcull_query* query,
                                                       uint64_t* index);

/// Indices of all boxes that do, into `blocking`, which has room for `room`, and how many there are into
/// `blocking_count`. As shaftcull_occluded().
SHAFTCULL_API shaftcull_status shaftcull_list_occluders(const shaftcull_shafts* shafts, uint64_t shaft,
                                                        const shaftcull_bounds* solids, const shaftcull_query* query,
                                                        uint32_t* blocking, uint64_t room, uint64_t* blocking_count);

/* ---- One shaft, one bound ---- */

/// What the shaft says of one box. `inside` 0 asks only whether it is kept, and the answer is then outside or overlap:
/// some 20 ns. 1 asks for all three answers.
SHAFTCULL_API shaftcull_status shaftcull_ask_box(const shaftcull_shafts* shafts, uint64_t shaft,
                                                 const shaftcull_box* box, uint32_t inside, shaftcull_answer* answer);

/// What the shaft says of one sphere. As shaftcull_ask_box().
SHAFTCULL_API shaftcull_status shaftcull_ask_sphere(const shaftcull_shafts* shafts, uint64_t shaft,
                                                    const shaftcull_sphere* sphere, uint32_t inside,
                                                    shaftcull_answer* answer);

/// Whether the shaft keeps one triangle, 1 or 0. Some 100 ns.
SHAFTCULL_API shaftcull_status shaftcull_ask_triangle(const shaftcull_shafts* shafts, uint64_t shaft,
                                                      const shaftcull_triangle* triangle, shaftcull_triangle_test test,
                                                      uint32_t* kept);

/// Whether this one solid box hides the one end of the shaft from the other, 1 or 0. For shafts between two boxes.
SHAFTCULL_API shaftcull_status shaftcull_occluded_by_box(const shaftcull_shafts* shafts, uint64_t shaft,
                                                         const shaftcull_box* solid, uint32_t* occluded);

/// Whether a convex polygon does, a wall at any angle, say: `count` corners of 3 floats, three or more, in order,
/// either way round. O(count), some microseconds; allocates a copy of the corners.
SHAFTCULL_API shaftcull_status shaftcull_occluded_by_polygon(const shaftcull_shafts* shafts, uint64_t shaft,
                                                             const float* corners, uint64_t count, uint32_t* occluded);

/* ---- Many shafts, many bounds, in parallel. Results do not depend on the number of threads. ---- */

/// Lists of indices that the library allocates, one for each shaft, one behind the other. Calls use their memory again.
typedef struct shaftcull_lists shaftcull_lists;

/// Empty lists. Freed by shaftcull_lists_free(). O(1).
SHAFTCULL_API shaftcull_status shaftcull_lists_create(shaftcull_lists** lists);

/// Frees lists; does nothing for NULL.
SHAFTCULL_API void shaftcull_lists_free(shaftcull_lists* lists);

/// How many lists there are, which is how many shafts were asked; 0 at first and for NULL. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_lists_count(const shaftcull_lists* lists);

/// Where each list begins: what shaft s of those asked keeps are elements offsets[s] to offsets[s + 1] − 1. One more
/// than there are lists, or NULL if none were made yet. Valid until the lists are filled again or freed. Never fails.
/// O(1).
SHAFTCULL_API const uint64_t* shaftcull_lists_offsets(const shaftcull_lists* lists);

/// The elements of all lists, or NULL if there are none. Valid as offsets. Never fails. O(1).
SHAFTCULL_API const uint32_t* shaftcull_lists_indices(const shaftcull_lists* lists);

/// Row s of `kept_rows`, shaftcull_bit_words(count of bounds) words, gets what shaftcull_cull() gives of shaft
/// first + s. `words` are those of all rows.
SHAFTCULL_API shaftcull_status shaftcull_cull_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                   const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                   uint64_t* kept_rows, uint64_t words);

/// Rows of shaftcull_classify(): `words` words of each kind, in separate memory. `kept_rows` may be NULL: then only
/// `inside_rows` is written.
SHAFTCULL_API shaftcull_status shaftcull_classify_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                       const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                       uint64_t* kept_rows, uint64_t* inside_rows, uint64_t words);

/// kept_counts[s] becomes shaftcull_count() of shaft first + s, for `count` of them.
SHAFTCULL_API shaftcull_status shaftcull_count_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                    const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                    uint64_t* kept_counts);

/// counts[s] becomes shaftcull_count_classified() of shaft first + s, for `count` of them. Allocates 16 bytes a shaft.
SHAFTCULL_API shaftcull_status shaftcull_count_classified_many(const shaftcull_shafts* shafts, uint64_t first,
                                                               uint64_t count, const shaftcull_bounds* bounds,
                                                               const shaftcull_query* query,
                                                               shaftcull_kept_counts* counts);

/// Bit s of `any` is set if shaft first + s keeps any bound. `words` is shaftcull_bit_words(count).
SHAFTCULL_API shaftcull_status shaftcull_any_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                  const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                  uint64_t* any, uint64_t words);

/// Lists what each shaft keeps. If it fails, lists are as they were or empty. Allocates what it lists.
SHAFTCULL_API shaftcull_status shaftcull_list_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                   const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                   shaftcull_lists* lists);

/// As shaftcull_list_many(), but what overlaps and what is inside apart, in lists that are not the same ones.
SHAFTCULL_API shaftcull_status shaftcull_list_classified_many(const shaftcull_shafts* shafts, uint64_t first,
                                                              uint64_t count, const shaftcull_bounds* bounds,
                                                              const shaftcull_query* query, shaftcull_lists* overlap,
                                                              shaftcull_lists* inside);

/// contacts[s] becomes shaftcull_first_contact() of shaft first + s, for `count` of them. Allocates 8 bytes a shaft.
/// Not for hulls, nor for triangles.
SHAFTCULL_API shaftcull_status shaftcull_first_contact_many(const shaftcull_shafts* shafts, uint64_t first,
                                                            uint64_t count, const shaftcull_bounds* bounds,
                                                            const shaftcull_query* query,
                                                            shaftcull_contact_found* contacts);

/// Bit s of `occluded` is set if a solid box blocks shaft first + s. `words` is shaftcull_bit_words(count). As
/// shaftcull_occluded().
SHAFTCULL_API shaftcull_status shaftcull_occluded_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                       const shaftcull_bounds* solids, const shaftcull_query* query,
                                                       uint64_t* occluded, uint64_t words);

/// Lists what blocks each shaft. If it fails, lists are as they were or empty. As shaftcull_occluded().
SHAFTCULL_API shaftcull_status shaftcull_list_occluders_many(const shaftcull_shafts* shafts, uint64_t first,
                                                             uint64_t count, const shaftcull_bounds* solids,
                                                             const shaftcull_query* query, shaftcull_lists* lists);

/* ---- What sees what: of all pairs of patches ---- */

/// What is said of a pair of patches (visibility.hpp).
typedef uint32_t shaftcull_sight;
enum {
  SHAFTCULL_SIGHT_UNDECIDED = 0,  /* Some occluders stand between them, none of which hides all. */
  SHAFTCULL_SIGHT_CLEAR = 1,      /* Nothing stands between them. */
  SHAFTCULL_SIGHT_BLOCKED = 2,    /* One solid hides all. */
  SHAFTCULL_SIGHT_FACING_AWAY = 3 /* One is on or behind the plane of the other. */
};

/// Patches, in a tree: boxes, each perhaps with a plane; the patch faces where its normal points. It never changes.
typedef struct shaftcull_patches shaftcull_patches;

/// What stands between patches. Occluders are numbered in the order in which they are added, from 0 on.
typedef struct shaftcull_occluders shaftcull_occluders;

/// All answers of a call, in the library's memory.
typedef struct shaftcull_sights shaftcull_sights;

/// Some patches side by side in shaftcull_patches_order().
typedef struct shaftcull_patch_run {
  uint32_t first; /* position in the order */
  uint32_t count; /* how many */
} shaftcull_patch_run;

/// One answer for all pairs of a patch of one run and a patch of another.
typedef struct shaftcull_sight_product {
  shaftcull_patch_run a; /* of set a */
  shaftcull_patch_run b; /* of set b */
  shaftcull_sight sight; /* never undecided */
} shaftcull_sight_product;

/// Pairs that are undecided, by the caller's indices. Candidates of pair i are candidates[first_candidate[i]] to before
/// candidates[first_candidate[i + 1]], in ascending order. Both are NULL if they were not asked for.
typedef struct shaftcull_undecided_pairs {
  const shaftcull_index_pair* pairs; /* of one set with itself, the one that is first in its order is a */
  uint64_t count;                    /* of pairs */
  const uint64_t* first_candidate;   /* count + 1 of them */
  const uint32_t* candidates;        /* numbers of occluders */
} shaftcull_undecided_pairs;

/// Some answers. Valid during the callback only.
typedef struct shaftcull_sight_batch {
  const shaftcull_sight_product* products; /* what is decided */
  uint64_t product_count;                  /* of products */
  shaftcull_undecided_pairs undecided;     /* and what is not */
} shaftcull_sight_batch;

/// How many pairs there are of each kind.
typedef struct shaftcull_sight_counts {
  uint64_t undecided;   /* SHAFTCULL_SIGHT_UNDECIDED */
  uint64_t clear;       /* SHAFTCULL_SIGHT_CLEAR */
  uint64_t occluded;    /* SHAFTCULL_SIGHT_BLOCKED */
  uint64_t facing_away; /* SHAFTCULL_SIGHT_FACING_AWAY */
} shaftcull_sight_counts;

/// Gets `user` as it was passed. Returns 0 to go on; anything else ends the call with SHAFTCULL_STOPPED. It may run on
/// any thread, one call at a time. It must return: no exception and no longjmp may leave it.
typedef int32_t (*shaftcull_sight_callback)(const shaftcull_sight_batch* batch, void* user);

/// May give the final word on undecided pairs, by rays for instance. verdicts[i] is one byte for pair i: a value of
/// shaftcull_sight, SHAFTCULL_SIGHT_UNDECIDED to begin with. Many threads call it at once, each before its pairs are
/// delivered. It returns as shaftcull_sight_callback does.
typedef int32_t (*shaftcull_resolve_callback)(const shaftcull_undecided_pairs* undecided, uint8_t* verdicts,
                                              void* user);

/// Is told some times a second that `done` of `total` pairs were answered. It returns as shaftcull_sight_callback does,
/// so it can end the call.
typedef int32_t (*shaftcull_progress_callback)(uint64_t done, uint64_t total, void* user);

/// How it is done.
typedef struct shaftcull_visibility_options {
  uint64_t memory;                      /* bytes that answers under way may take, 1 MB or more */
  shaftcull_contact contact;            /* what becomes of occluders that only touch */
  uint32_t solids_around_ends;          /* 0: a solid that an end reaches into makes no pair occluded */
  uint32_t candidates;                  /* 1: undecided pairs come with candidates */
  uint32_t reserved;                    /* 0 */
  shaftcull_resolve_callback resolve;   /* or NULL */
  shaftcull_progress_callback progress; /* or NULL */
  void* user;                           /* for these two */
} shaftcull_visibility_options;

/// 256 MB, open contact, solids around ends, candidates, no callbacks. Never fails.
SHAFTCULL_API shaftcull_visibility_options shaftcull_default_visibility_options(void);

/// The name of what is said of a pair, "occluded" say; "unknown" for a number that is none. Valid for ever. Never
/// fails. O(1).
SHAFTCULL_API const char* shaftcull_sight_name(shaftcull_sight sight);

/// Patches of a source of boxes, with `plane_count` planes: 0, or one for each patch, which faces where the normal
/// points, and sees what is in front. SHAFTCULL_BAD_BOUND for the first box that is not finite with lo ≤ hi, or plane
/// that is not finite or has no normal. O(n log n); holds some 100 bytes a patch. Freed by shaftcull_patches_free().
SHAFTCULL_API shaftcull_status shaftcull_patches_create(const shaftcull_source* boxes, const shaftcull_plane* planes,
                                                        uint64_t plane_count, shaftcull_patches** patches);

/// Frees patches; does nothing for NULL.
SHAFTCULL_API void shaftcull_patches_free(shaftcull_patches* patches);

/// How many patches there are; 0 for NULL. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_patches_count(const shaftcull_patches* patches);

/// The order that runs refer to: (*order)[p] is the caller's index of the patch at position p. Valid until the patches
/// are freed. NULL if there are none. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_patches_order(const shaftcull_patches* patches, const uint32_t** order);

/// No occluders, to add some. Freed by shaftcull_occluders_free(). O(1).
SHAFTCULL_API shaftcull_status shaftcull_occluders_create(shaftcull_occluders** occluders);

/// Frees occluders; does nothing for NULL.
SHAFTCULL_API void shaftcull_occluders_free(shaftcull_occluders* occluders);

/// How many occluders there are; 0 for NULL. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_occluders_count(const shaftcull_occluders* occluders);

/// Adds boxes around things that may hide something, one occluder a box. `first` gets the number of the first of them,
/// here and in those that follow, or may be NULL. SHAFTCULL_BAD_BOUND for what is not finite with lo ≤ hi. O(count).
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_boxes(shaftcull_occluders* occluders,
                                                             const shaftcull_source* boxes, uint64_t* first);

/// Adds boxes that are solid, one occluder a box. They make pairs occluded, also where several are one larger box
/// together. Errors as shaftcull_occluders_add_boxes().
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_solids(shaftcull_occluders* occluders,
                                                              const shaftcull_source* boxes, uint64_t* first);

/// Adds convex hulls that are solid, one occluder a hull: hull i has the corners first_corner[i] to before
/// first_corner[i + 1] of all `corner_count`, 3 floats each. Those are hull_count + 1 numbers, or `first_corner` may be
/// NULL if there are no hulls; 4 to 32 corners a hull. SHAFTCULL_BAD_BOUND for a corner that is not finite.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_solid_hulls(shaftcull_occluders* occluders, const float* corners,
                                                                   uint64_t corner_count, const uint64_t* first_corner,
                                                                   uint64_t hull_count, uint64_t* first);

/// Adds flat convex polygons by their corners in order, one occluder a polygon. They make pairs occluded. As
/// shaftcull_occluders_add_solid_hulls(), with 3 corners or more a polygon. One whose corners are a little out of plane
/// is the triangles that its first corner makes with its other edges. That it is convex is not checked.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_polygons(shaftcull_occluders* occluders, const float* corners,
                                                                uint64_t corner_count, const uint64_t* first_corner,
                                                                uint64_t polygon_count, uint64_t* first);

/// Adds triangles in groups, one occluder a group: group i has the triangles first_triangle[i] to before
/// first_triangle[i + 1], which are group_count + 1 numbers. With NULL and 0 the library makes groups of at most 32
/// neighbours. SHAFTCULL_BAD_BOUND for a triangle that is not finite. Allocates a copy of 36 bytes a triangle on the
/// way.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_triangles(shaftcull_occluders* occluders,
                                                                 const shaftcull_source* triangles,
                                                                 const uint64_t* first_triangle, uint64_t group_count,
                                                                 uint64_t* first);

/// The box around one occluder. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_occluders_box(const shaftcull_occluders* occluders, uint64_t occluder,
                                                       shaftcull_box* box);

/// The triangles of one occluder, by their positions in the source that it was added from: `count` of them, which may
/// be 0. Valid until the occluders are added to or freed. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_occluders_triangles(const shaftcull_occluders* occluders, uint64_t occluder,
                                                             const uint32_t** triangles, uint64_t* count);

/// How many pairs of a patch of `a` and a patch of `b` there are of each kind; of `a` with itself, each two patches
/// once, if `b` is NULL, here and in those that follow. `options` may be NULL: the default ones. Refuses less memory
/// than 1 MB. SHAFTCULL_STOPPED if a callback says so.
SHAFTCULL_API shaftcull_status shaftcull_count_visibility(const shaftcull_patches* a, const shaftcull_patches* b,
                                                          const shaftcull_occluders* occluders,
                                                          const shaftcull_visibility_options* options,
                                                          shaftcull_sight_counts* counts);

/// Calls back until every pair was in one batch, once, and tells how many there were of each kind; `counts` may be
/// NULL. Batches come in an order that does not depend on the number of threads. Otherwise as
/// shaftcull_count_visibility().
SHAFTCULL_API shaftcull_status shaftcull_visibility(const shaftcull_patches* a, const shaftcull_patches* b,
                                                    const shaftcull_occluders* occluders,
                                                    const shaftcull_visibility_options* options,
                                                    shaftcull_sight_callback callback, void* user,
                                                    shaftcull_sight_counts* counts);

/// Collects all answers. It may take much memory: 20 bytes a product, and there are some 0.1 to 0.2 as many as pairs.
/// Otherwise as shaftcull_count_visibility(). Freed by shaftcull_sights_free().
SHAFTCULL_API shaftcull_status shaftcull_collect_visibility(const shaftcull_patches* a, const shaftcull_patches* b,
                                                            const shaftcull_occluders* occluders,
                                                            const shaftcull_visibility_options* options,
                                                            shaftcull_sights** sights);

/// Frees answers; does nothing for NULL.
SHAFTCULL_API void shaftcull_sights_free(shaftcull_sights* sights);

/// All answers as one batch, valid until they are freed, and how many there are of each kind; `counts` may be NULL.
/// O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_sights_all(const shaftcull_sights* sights, shaftcull_sight_batch* batch,
                                                    shaftcull_sight_counts* counts);

/// Writes a bit for every pair, rows of shaftcull_bit_words(patches of b) words, one for each patch of `a`: bit j of
/// row i says whether patches i and j are of the kind `sight`. `words` are those of all rows. Of one set with itself
/// both bits of a pair are written, and the diagonal is 0. `counts` may be NULL. If it fails, bits hold anything.
/// Otherwise as shaftcull_count_visibility().
SHAFTCULL_API shaftcull_status shaftcull_visibility_bits(const shaftcull_patches* a, const shaftcull_patches* b,
                                                         const shaftcull_occluders* occluders,
                                                         const shaftcull_visibility_options* options,
                                                         shaftcull_sight sight, uint64_t* bits, uint64_t words,
                                                         shaftcull_sight_counts* counts);

/// Larger solid boxes that cover nothing but what the given ones cover: pieces of a wall that share a face become one
/// (solids.hpp). Lists as many of them as there is room for, and `merged_count` says how many there are.
/// SHAFTCULL_BAD_BOUND for a box that is not finite with lo ≤ hi. Some O(n log n).
SHAFTCULL_API shaftcull_status shaftcull_merged_boxes(const shaftcull_box* boxes, uint64_t count, shaftcull_box* merged,
                                                      uint64_t room, uint64_t* merged_count);

/// A large box inside the convex hull of 4 to 32 points, 3 floats each: exactly, no coordinate is rounded outwards.
/// Refuses another number of points and what is not finite.
SHAFTCULL_API shaftcull_status shaftcull_inscribed_box(const float* corners, uint64_t count, shaftcull_box* box);

/* ---- Threads and instruction sets ---- */

/// How many threads a call for many shafts would use from here; 1 in a build without oneTBB. Never fails.
SHAFTCULL_API uint32_t shaftcull_concurrency(void);

/// How many instruction sets this build has kernels for and this machine can run: 1 or more. O(1).
SHAFTCULL_API shaftcull_status shaftcull_isa_count(uint64_t* count);

/// The name of one of these, slowest first, "avx2" say. Valid for ever. O(1).
SHAFTCULL_API shaftcull_status shaftcull_isa_name(uint64_t position, const char** name);

/// The name of the instruction set that calls use from now on, in every thread. Valid for ever. Never fails.
SHAFTCULL_API const char* shaftcull_active_isa(void);

/// Uses an instruction set from now on, in every thread, by its name in upper or lower case. Safe at any time. Wins
/// over the environment variable SHAFTCULL_ISA. Answers do not depend on it. Refuses what is not available, and says
/// what is.
SHAFTCULL_API shaftcull_status shaftcull_select_isa(const char* name);

/// What the environment variable SHAFTCULL_ISA asks for, empty if it is not set; and why that cannot be followed, empty
/// if it can; cut off after 255 and 511 bytes. Both are valid until this thread calls this again. No other thread may
/// change the environment meanwhile.
SHAFTCULL_API shaftcull_status shaftcull_isa_asked(const char** asked, const char** refusal);

#ifdef __cplusplus
}
#endif

#endif
