// SPDX-License-Identifier: MIT
/// shaftcull in C: shafts between boxes and of moving boxes, convex hulls, and the bounds that they keep.
///
/// docs/c.md has an example. The C++ headers beside this header define each answer: `cull.hpp`, `many.hpp`, `query.hpp`
/// and so on. This header defines what a call reads, writes, allocates and refuses.
///
/// Objects. A *shaft* is an entry of an array, shaftcull_shafts, which aligns its memory itself. *Bounds*,
/// shaftcull_bounds, are boxes, spheres or triangles in a holder: a view of the caller's own memory, a stream that owns
/// a checked and aligned copy, a tree, a dynamic tree, or a snapshot of a dynamic tree. Every query takes bounds in any
/// holder, with the same options, and gives the same answer. The function that frees an object has the name of its
/// type, followed by `_free`.
///
/// One shaft or many. Most functions take a range of an array: `count` shafts from `first` on. They write one row or
/// one element per shaft, in the order of the range. Positions in messages are counted from `first` on. A query about
/// one shaft runs on the calling thread, unless it fills a shaftcull_lists; a query about more shafts runs in parallel,
/// on oneTBB if the library was built with it. Results do not depend on the number of threads.
///
/// Errors. A function that can fail returns a shaftcull_status: SHAFTCULL_OK, or the kind of the error. After an error,
/// shaftcull_error_message() states what is wrong, where, and what would be right. A function that fails writes nothing
/// and leaves objects as they were, unless its comment states otherwise. Pointers must not be NULL unless the comment
/// allows it; an array of 0 elements may be NULL. Every function with a status refuses a NULL pointer with
/// SHAFTCULL_INVALID_ARGUMENT. It checks all sizes, indices and enumerators, and floats as its comment states. It
/// cannot check that memory is as large as stated, nor that a handle was not freed. Every function that allocates can
/// return SHAFTCULL_OUT_OF_MEMORY.
///
/// Threads. Functions that take an object as `const` may be called from many threads at once. Functions that take it
/// without `const` may not be called while another thread uses that object. Different objects are independent. Queries
/// about several shafts, and functions that build and update trees, may be called from the caller's own oneTBB tasks.
/// No call takes more than 64 KiB of the stack.
///
/// Allocation. Queries about one shaft allocate nothing, unless a comment states otherwise. Queries about several
/// shafts allocate task memory of oneTBB, and their results if these go into a shaftcull_lists. If memory runs out,
/// bits and numbers are unspecified. The comment of shaftcull_query states the cost of candidates.
///
/// Results. Bits: bit i % 64 of word i / 64 stands for bound i, and a row has shaftcull_bit_words(number of bounds)
/// words, no more and no fewer. Bits past the last bound are 0. Rows follow one another without gaps. Lists: a call
/// that lists into the caller's memory writes as many results as there is room for, and reports their full number,
/// whether they fit or not. The room may be 0, and then the array may be NULL. Room after the last result may be
/// overwritten.
///
/// Indices are 32 bits wide. A tree holds at most 2³² − 1 bounds. A view or stream may have more: queries for bits and
/// counts accept it, but queries that list its bounds or find first contact refuse it. For these, make views of its
/// parts, and add the position at which a part begins to the indices of that part.
///
/// Enumerators are fixed-width integers with the constants below. Structs are plain, and on 64-bit machines every byte
/// of a struct belongs to a field. Fields named `reserved…` must be 0.
///
/// Compatibility. Within a major version, functions, constants and uses of reserved fields may be added; nothing is
/// changed or removed.
#ifndef SHAFTCULL_H
#define SHAFTCULL_H

#include <stdint.h>

/* The CMake target and pkg-config's flags define SHAFTCULL_SHARED if the library is shared. */
/* CMake defines shaftcull_c_EXPORTS for the sources of a shared library. */
#if !defined(SHAFTCULL_SHARED)
/// Precedes each function of the library, and makes it visible if the library is shared.
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
  SHAFTCULL_OK = 0,               /* The call did not fail. */
  SHAFTCULL_INVALID_ARGUMENT = 1, /* An argument breaks a rule of the function. */
  SHAFTCULL_BAD_BOUND = 2,        /* A bound or point in the caller's memory cannot be used (NaN, lo > hi and so on), or
                                     one of several shafts cannot be formed: the one at shaftcull_error_position(). */
  SHAFTCULL_NEEDS_REFIT = 3,      /* A query came between an update by index and shaftcull_tree_refit(). */
  SHAFTCULL_OUT_OF_MEMORY = 4,    /* No memory was left. */
  SHAFTCULL_STOPPED = 5,          /* A callback returned a value other than 0. */
  SHAFTCULL_INTERNAL_ERROR = 6    /* A fault of the library or of the system; the message has the details. */
};

/// The result of shaftcull_error_position(), shaftcull_find_occluder() and shaftcull_first_contact() if there is no
/// position, occluder or contact.
#define SHAFTCULL_NONE UINT64_MAX

/// The version of this header, to compare with shaftcull_version(): major · 1,000,000 + minor · 1,000 + patch.
#define SHAFTCULL_HEADER_VERSION 1000000

/// The version of the running library, in the form of SHAFTCULL_HEADER_VERSION. Never fails. O(1).
SHAFTCULL_API uint32_t shaftcull_version(void);

/// The message of this thread's last call that failed: what is wrong, where, and what would be right. Empty if no call
/// failed. UTF-8; valid until this thread's next call that fails. Never NULL, never fails. O(1).
SHAFTCULL_API const char* shaftcull_error_message(void);

/// The position of the bad bound or shaft, counted from 0 in its array, if this thread's last call that failed returned
/// SHAFTCULL_BAD_BOUND. Otherwise SHAFTCULL_NONE. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_error_position(void);

/// A build without exceptions (SHAFTCULL_WITH_EXCEPTIONS=OFF) calls a handler instead of returning a status. The
/// handler gets that status, and the values of shaftcull_error_message() and shaftcull_error_position(). The handler
/// must end the program in its own way, since objects are not left as they were. If it returns, the library ends the
/// program. The handler is also called if a callback ends a call.
typedef void (*shaftcull_error_handler)(shaftcull_status status, const char* message, uint64_t position);

/// Sets the handler, and returns the previous handler. With NULL, which is the default, the message goes to standard
/// error, and the program ends. Builds with exceptions never call the handler. Never fails. O(1).
SHAFTCULL_API shaftcull_error_handler shaftcull_set_error_handler(shaftcull_error_handler handler);

/// The name of a status, for example "bad bound"; "unknown status" for any other number. The string is valid for ever.
/// Never fails.
static inline const char* shaftcull_status_name(shaftcull_status status) {
  switch (status) {
    case SHAFTCULL_OK:
      return "ok";
    case SHAFTCULL_INVALID_ARGUMENT:
      return "invalid argument";
    case SHAFTCULL_BAD_BOUND:
      return "bad bound";
    case SHAFTCULL_NEEDS_REFIT:
      return "needs refit";
    case SHAFTCULL_OUT_OF_MEMORY:
      return "out of memory";
    case SHAFTCULL_STOPPED:
      return "stopped";
    case SHAFTCULL_INTERNAL_ERROR:
      return "internal error";
    default:
      return "unknown status";
  }
}

/* ---- Values ---- */

/// An axis-aligned box: x, y, z of its low and of its high corner, lo ≤ hi. The empty box has lo = +∞ and hi = −∞.
typedef struct shaftcull_box {
  float lo[3]; /* the least coordinates */
  float hi[3]; /* the greatest coordinates */
} shaftcull_box;

/// A ball: all points that are at most the radius away from the centre. A radius of 0 is a point.
typedef struct shaftcull_sphere {
  float centre[3]; /* its centre point */
  float radius;    /* 0 or more */
} shaftcull_sphere;

/// A triangle. The order of its vertices has no meaning.
typedef struct shaftcull_triangle {
  float vertex[3][3]; /* x, y, z of each vertex */
} shaftcull_triangle;

/// A half-space: all p with normal·p ≤ offset. The normal need not have unit length.
typedef struct shaftcull_plane {
  float normal[3]; /* points out of the half-space */
  float offset;    /* the value of normal·p on the plane */
} shaftcull_plane;

/// Two boxes, by their positions in arrays.
typedef struct shaftcull_index_pair {
  uint32_t a; /* in the array of boxes a */
  uint32_t b; /* in the array of boxes b */
} shaftcull_index_pair;

/// How many bounds overlap a shaft, and how many are inside. The shaft keeps both.
typedef struct shaftcull_kept_counts {
  uint64_t overlap; /* neither outside nor inside */
  uint64_t inside;  /* inside entirely */
} shaftcull_kept_counts;

/// The bound that a moving box reaches first, and the time, rounded down. Without a contact, the fields are
/// SHAFTCULL_NONE, +∞ and 0. The normal has unit length, and points from the bound towards the moving box: ±x, ±y or ±z
/// if the bound is a box. It is zero without a contact, and if the two overlap at the start, or touch at the start
/// without the box moving into the bound.
typedef struct shaftcull_contact_found {
  uint64_t index;    /* of the bound */
  float time;        /* of first contact */
  uint32_t found;    /* 1 if there is a contact, otherwise 0 */
  float normal[3];   /* of contact */
  uint32_t reserved; /* 0 */
} shaftcull_contact_found;

/// Whether a shaft keeps bounds that touch it without reaching into it.
typedef uint32_t shaftcull_contact;
enum {
  SHAFTCULL_CONTACT_CLOSED = 0, /* It keeps them. */
  SHAFTCULL_CONTACT_OPEN = 1    /* They are outside, unless relative interiors meet. */
};

/// The answer of a shaft for one bound.
typedef uint32_t shaftcull_answer;
enum {
  SHAFTCULL_OUTSIDE = 0, /* No part of the bound is in the shaft. */
  SHAFTCULL_OVERLAP = 1, /* A part of the bound is in the shaft, or the bound touches it. */
  SHAFTCULL_INSIDE = 2   /* All of the bound is in the shaft. */
};

/// How triangles are tested (triangles.hpp).
typedef uint32_t shaftcull_triangle_test;
enum {
  SHAFTCULL_TRIANGLES_EXACT = 0,      /* the triangle itself */
  SHAFTCULL_TRIANGLES_BY_VERTICES = 1 /* the box around the vertices, and added planes */
};

/// How hulls cull boxes (HullTest in hull.hpp).
typedef uint32_t shaftcull_hull_test;
enum {
  SHAFTCULL_HULL_EXACT = 0,       /* boxes are outside iff they have no point in common with the hull */
  SHAFTCULL_HULL_CONSERVATIVE = 1 /* boxes are outside iff they are beyond one face: faster, and keeps more */
};

/// The range of depths in clip space that is in view.
typedef uint32_t shaftcull_clip_depth;
enum {
  SHAFTCULL_DEPTH_ZERO_TO_ONE = 0,     /* 0 ≤ z ≤ w: Direct3D, Vulkan, Metal, and reversed depth */
  SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE = 1 /* −w ≤ z ≤ w: OpenGL */
};

/// The number of 64-bit words that hold one bit per bound. Never fails. O(1).
static inline uint64_t shaftcull_bit_words(uint64_t bounds) { return bounds / 64 + (bounds % 64 != 0); }

/* ---- Boxes and planes ---- */

/// The smallest box around `count` points, 3 floats each; the empty box if there are none. SHAFTCULL_BAD_BOUND for the
/// first point with a NaN. O(count); allocates a copy of the points.
SHAFTCULL_API shaftcull_status shaftcull_box_around(const float* points, uint64_t count, shaftcull_box* box);

/// The box moved by a vector of 3 floats, with every face then moved out by a distance; both steps round outwards. With
/// NULL for `by` the box is not moved, and with a distance of 0 its faces are not. Refuses a vector that is not finite,
/// and a negative or infinite distance. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_translated(const shaftcull_box* box, const float by[3], float inflated_by,
                                                    shaftcull_box* moved);

/// The floats that shaftcull_relative() makes of doubles (origin.hpp).
typedef uint32_t shaftcull_rounding;
enum {
  SHAFTCULL_BOXES_AROUND = 0,   /* of 6 doubles, lo and hi: the smallest boxes that contain the true ones */
  SHAFTCULL_BOXES_WITHIN = 1,   /* of 6 doubles: the largest boxes inside, for boxes that hide or contain others */
  SHAFTCULL_SPHERES_AROUND = 2, /* of 4 doubles, centre and radius: spheres that contain the true ones */
  SHAFTCULL_NEAREST = 3,        /* of 3 doubles: the nearest floats, for points, vertices and corners */
  SHAFTCULL_PLANES_AROUND = 4   /* `from` begins with lo and hi of one box. Then follow 4 doubles per plane, normal and
                                   offset. The planes keep all points of the box that the true ones keep */
};

/// Converts `count` boxes, spheres, points or planes of a world in doubles to floats relative to an origin of 3
/// doubles. If no box of floats is within a box, the result is the empty box. Values that streams refuse stay as they
/// are: NaN, lo > hi, and a radius below 0. Refuses an origin that is not finite, and a rounding that is not an
/// enumerator; of planes also a plane or a box that is not finite, or is beyond the largest float. `from` and `to` must
/// not overlap. Take an origin near the middle of the world, whose coordinates are multiples of a power of two of about
/// 1/64 of the world's size: then round coordinates stay exact. O(count); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_relative(const double origin[3], shaftcull_rounding rounding,
                                                  const double* from, uint64_t count, float* to);

/// Writes the planes of a view-projection matrix, with normals outwards: up to six planes to `planes`, and their number
/// to `count`. The matrix has 4 rows of 4 floats, row after row, and maps column vectors; transpose a matrix of another
/// convention. Refuses a matrix that is not finite or leaves nothing in view. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_view_planes(const float matrix[16], shaftcull_clip_depth depth,
                                                     shaftcull_plane planes[6], uint64_t* count);

/// Joins solid boxes into larger ones that cover the same space: pieces of a wall that share a face become one box
/// (solids.hpp). Writes as many of the larger boxes as there is room for to `merged`, and their full number to
/// `merged_count`. SHAFTCULL_BAD_BOUND for a box that is not finite or has lo > hi. About O(n log n); allocates a copy
/// and the result.
SHAFTCULL_API shaftcull_status shaftcull_merged_boxes(const shaftcull_box* boxes, uint64_t count, shaftcull_box* merged,
                                                      uint64_t room, uint64_t* merged_count);

/// A large box inside the convex hull of 4 to 32 points, 3 floats each. It lies in the hull exactly: no coordinate is
/// rounded outwards. Refuses another number of points, and a point that is not finite. O(n³): about 10 µs for 8 points,
/// 0.5 ms for 32; allocates.
SHAFTCULL_API shaftcull_status shaftcull_inscribed_box(const float* corners, uint64_t count, shaftcull_box* box);

/// The view factor from one flat convex polygon to another with nothing between them, from 0 to 1 (view_factors.hpp).
/// Each polygon has 3 to 8 corners of 3 floats, counterclockwise as seen from the front. The part of a polygon that is
/// behind the plane of the other polygon does not count. The error is below 1e-8 of the factor, or 1e-11. Refuses
/// another number of corners, a corner that is not finite, and a polygon `from` without area. About 6 µs, 15 µs if the
/// polygons share an edge; no allocation.
SHAFTCULL_API shaftcull_status shaftcull_view_factor(const float* from, uint64_t from_count, const float* to,
                                                     uint64_t to_count, double* factor);

/* ---- Convex hulls ---- */

/// The convex hull of up to 32 points and directions: view frusta, casters of shadows, volumes between polygons or
/// turned boxes. Queries accept it as a shaft: shaftcull_shafts_set_hull() puts it into an array.
typedef struct shaftcull_hull shaftcull_hull;

/// Makes the hull of `point_count` points, 3 floats each, extended without end along `direction_count` directions, 0 or
/// more. For a frustum, pass its eight corners. For two polygons or turned boxes, pass the corners of both, beginning
/// with those of the first, and pass their number as `first_end`. Queries about occluders then accept the hull, and
/// find solids that hide one of the two from the other. `first_end` is 0 for a hull of one set of points, and for a
/// hull with directions. Refuses a hull without points, an end without points, more than 32 points and directions,
/// values that are not finite, a direction of 0, and a test that is not an enumerator. O(n²): about 1.4 µs for 8
/// points, 10 µs for 32. Allocates about 17 KB. Freed by shaftcull_hull_free().
SHAFTCULL_API shaftcull_status shaftcull_hull_create(const float* points, uint64_t point_count, uint64_t first_end,
                                                     const float* directions, uint64_t direction_count,
                                                     shaftcull_hull_test test, shaftcull_hull** hull);

/// Makes the hull of the volume that a view-projection matrix shows. The matrix is as for shaftcull_view_planes().
/// Without a far plane, the hull has no end. Refuses a matrix that is not finite or not invertible, or whose view has a
/// corner that is not in front of the eye, and a depth or a test that is not an enumerator. About 1.4 µs; allocates
/// about 17 KB. Freed by shaftcull_hull_free().
SHAFTCULL_API shaftcull_status shaftcull_hull_of_frustum(const float matrix[16], shaftcull_clip_depth depth,
                                                         shaftcull_hull_test test, shaftcull_hull** hull);

/// Makes the hull of all points that can cast a shadow into `view`. The hull has the test of the view. The light is x,
/// y, z and 1 for a lamp at a point, or x, y, z and 0 for a sun in a direction, which is not 0. Refuses a light that is
/// not finite, a fourth number that is neither 1 nor 0, and a view of 32 points and directions. Allocates about 17 KB,
/// and takes half the time of a hull, or a sixth if the light is within the view. Freed by shaftcull_hull_free().
SHAFTCULL_API shaftcull_status shaftcull_hull_of_casters(const shaftcull_hull* view, const float light[4],
                                                         shaftcull_hull** hull);

/// Frees a hull; does nothing for NULL. Arrays of shafts keep the parts of it that they need.
SHAFTCULL_API void shaftcull_hull_free(shaftcull_hull* hull);

/// The parts of a hull. Pointers are valid until the hull is freed.
typedef struct shaftcull_hull_info {
  uint64_t point_count;     /* number of points */
  uint64_t direction_count; /* number of directions */
  const float* points;      /* 3 floats each, as they were given */
  const float* directions;  /* 3 floats each, as they were given; NULL if there are none */
  shaftcull_box box;        /* the box around the hull, infinite where directions lead */
} shaftcull_hull_info;

/// Points, directions and box of a hull. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_hull_describe(const shaftcull_hull* hull, shaftcull_hull_info* info);

/* ---- Bounds: views, streams and trees of boxes, spheres or triangles ---- */

/// The kind of bounds.
typedef uint32_t shaftcull_bound_kind;
enum {
  SHAFTCULL_BOXES = 1,    /* shaftcull_box */
  SHAFTCULL_SPHERES = 2,  /* shaftcull_sphere */
  SHAFTCULL_TRIANGLES = 3 /* shaftcull_triangle */
};

/// The holder of bounds.
typedef uint32_t shaftcull_holder;
enum {
  SHAFTCULL_VIEW = 1,         /* the caller's own memory */
  SHAFTCULL_STREAM = 2,       /* a checked, aligned copy */
  SHAFTCULL_TREE = 3,         /* a sorted copy, under a tree */
  SHAFTCULL_DYNAMIC_TREE = 4, /* boxes or spheres that come, go and move, under a tree */
  SHAFTCULL_SNAPSHOT = 5      /* a state of a dynamic tree, which never changes */
};

/// Bounds of one kind in one holder.
typedef struct shaftcull_bounds shaftcull_bounds;

/// The layout of the bounds of a source in memory.
typedef uint32_t shaftcull_source_kind;
enum {
  SHAFTCULL_SOURCE_BOXES = 1,     /* lo at `first`, hi at `second`, 3 floats each */
  SHAFTCULL_SOURCE_CENTRES = 2,   /* boxes: centre at `first`, half extent at `second`, 3 floats each */
  SHAFTCULL_SOURCE_SPHERES = 3,   /* centre at `first`, 3 floats, and radius at `second` */
  SHAFTCULL_SOURCE_TRIANGLES = 4, /* 9 floats at `first` */
  SHAFTCULL_SOURCE_MESH = 5,      /* vertices of 3 floats at `first`; indices 3 i to 3 i + 2 are for triangle i */
  SHAFTCULL_SOURCE_BOUNDS = 6     /* `bounds`: all bounds of a view or stream, or the leaves of a tree in tree order */
};

/// Bounds in the caller's memory, for a call to read. Record i is at byte `first + i * stride`, and at
/// `second + i * stride`, with any stride and any alignment, so a source can name members of the caller's own structs.
/// Calls keep no pointer to that memory. Fields that the kind does not use must be 0.
typedef struct shaftcull_source {
  shaftcull_source_kind kind;     /* which of the following fields are read */
  uint32_t reserved;              /* 0 */
  uint64_t count;                 /* number of bounds; 0 for SHAFTCULL_SOURCE_BOUNDS, which have their own */
  const void* first;              /* address in record 0, as the kind defines */
  const void* second;             /* address in record 0, as the kind defines */
  uint64_t stride;                /* bytes from one record to the next */
  const uint32_t* indices;        /* three per triangle of a mesh */
  uint64_t vertex_count;          /* number of vertices of a mesh */
  const shaftcull_bounds* bounds; /* for SHAFTCULL_SOURCE_BOUNDS */
} shaftcull_source;

/// The source of an array of boxes. Never fails; reads no box.
static inline shaftcull_source shaftcull_boxes(const shaftcull_box* boxes, uint64_t count) {
  const shaftcull_source source = {SHAFTCULL_SOURCE_BOXES, 0, count, boxes, boxes ? boxes->hi : 0,
                                   sizeof(shaftcull_box),  0, 0,     0};
  return source;
}

/// The source of an array of spheres. Never fails; reads no sphere.
static inline shaftcull_source shaftcull_spheres(const shaftcull_sphere* spheres, uint64_t count) {
  const shaftcull_source source = {SHAFTCULL_SOURCE_SPHERES, 0, count, spheres, spheres ? &spheres->radius : 0,
                                   sizeof(shaftcull_sphere), 0, 0,     0};
  return source;
}

/// The source of an array of triangles. Never fails; reads no triangle.
static inline shaftcull_source shaftcull_triangles(const shaftcull_triangle* triangles, uint64_t count) {
  const shaftcull_source source = {SHAFTCULL_SOURCE_TRIANGLES, 0, count, triangles, 0,
                                   sizeof(shaftcull_triangle), 0, 0,     0};
  return source;
}

/// The source of an indexed mesh of `count` triangles: 3 floats per vertex, 3 indices per triangle. Never fails; reads
/// no vertex.
static inline shaftcull_source shaftcull_mesh(const float* vertices, uint64_t vertex_count, const uint32_t* indices,
                                              uint64_t count) {
  const shaftcull_source source = {SHAFTCULL_SOURCE_MESH, 0,       count,        vertices, 0,
                                   3 * sizeof(float),     indices, vertex_count, 0};
  return source;
}

/// The source of existing bounds. Never fails; reads none of them.
static inline shaftcull_source shaftcull_source_of(const shaftcull_bounds* bounds) {
  const shaftcull_source source = {SHAFTCULL_SOURCE_BOUNDS, 0, 0, 0, 0, 0, 0, 0, bounds};
  return source;
}

/// Makes a view of `count` bounds in the caller's memory, as separate streams of `count` floats each. Boxes have 6: lo
/// x, y, z, hi x, y, z. Spheres have 4: centre x, y, z, radius. Triangles have 9: x, y, z of vertex 0, then 1, then 2.
/// The memory must outlive the view's use; each query reads the values of that moment, without checking them. With a
/// count of 0, `streams` may be NULL. Freed by shaftcull_bounds_free(). O(1).
SHAFTCULL_API shaftcull_status shaftcull_view_create(shaftcull_bound_kind kind, const float* const* streams,
                                                     uint64_t count, shaftcull_bounds** bounds);

/// Makes a stream of the bounds of a source. If a source of boxes, spheres or triangles has a count and no data (NULL
/// in `first` and `second`), the stream has empty bounds, which no shaft keeps, for shaftcull_bounds_update() to
/// replace. SHAFTCULL_BAD_BOUND for the first bound that has a NaN, lo > hi, a negative radius or half extent, or is
/// not finite where it must be. O(count); allocates 24 bytes per box, 16 per sphere and 36 per triangle; for
/// SHAFTCULL_SOURCE_TRIANGLES, also 36 per triangle during the call. Freed by shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_stream_create(const shaftcull_source* source, shaftcull_bounds** bounds);

/// Makes a tree of the bounds of a source. The order depends on the bounds and their positions alone.
/// SHAFTCULL_BAD_BOUND as for shaftcull_stream_create(). Refuses more than 2³² − 1 bounds. O(n log n), in parallel;
/// holds the bounds, an index per bound, and about 2 % more. Freed by shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_tree_create(const shaftcull_source* source, shaftcull_bounds** tree);

/// Makes a copy, layers included: a view of the same memory, or a deep copy of a stream or tree, O(count). The copy of
/// a dynamic tree is a snapshot of its last commit, O(1): it shares memory with the tree, never changes, and may be
/// queried and freed by other threads while the tree changes. So for a dynamic tree, this call is safe from any thread
/// at any time. Freed by shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_bounds_copy(const shaftcull_bounds* bounds, shaftcull_bounds** copy);

/// Frees bounds; does nothing for NULL. The memory of a view remains the caller's.
SHAFTCULL_API void shaftcull_bounds_free(shaftcull_bounds* bounds);

/// Replaces the bounds from `first` on with those of a source, which must be of the same kind and not lie in the same
/// memory. In a stream, the source may replace any range: O(count of the source); several threads may update disjoint
/// ranges at once. In a tree, the source must replace all bounds, with `first` = 0, and the call refits the tree: O(n),
/// in parallel. SHAFTCULL_BAD_BOUND as for shaftcull_stream_create(). Allocates nothing, except a copy of
/// SHAFTCULL_SOURCE_TRIANGLES and, for a tree of triangles, twice the memory of the triangles. If oneTBB cannot start
/// its tasks, the tree needs a refit, and each bound has its old or its new value.
SHAFTCULL_API shaftcull_status shaftcull_bounds_update(shaftcull_bounds* bounds, uint64_t first,
                                                       const shaftcull_source* source);

/// Puts bounds into layers, by which queries can select them (shaftcull_query): afterwards, bound indices[i] is in
/// layer l iff bit l of layers[i] is set. If an index occurs twice, the last entry counts. The bounds must have layers
/// already. With NULL for `indices`, the call sets the layers of all bounds: `count` is their number, layers[i] is for
/// bound i, and NULL for `layers` removes all layers. Layers belong to indices, stay when bounds are updated, and are
/// not part of a source. A dynamic tree supports only the call with indices, and queries see its new layers after the
/// next commit. Refuses a tree of triangles, and a snapshot. O(count); the first layers of all bounds allocate 4 bytes
/// per bound, and so may the first call with indices for a tree, which is O(n).
SHAFTCULL_API shaftcull_status shaftcull_bounds_set_layers(shaftcull_bounds* bounds, const uint32_t* indices,
                                                           const uint32_t* layers, uint64_t count);

/// The state of bounds. Pointers are valid until the bounds are freed, layers are set, or a tree is rebuilt or
/// reordered; their memory shows updates. For a dynamic tree and a snapshot, the state is that of the last commit, and
/// there are no pointers.
typedef struct shaftcull_bounds_info {
  uint64_t count;        /* number of bounds; for a dynamic tree or snapshot, all indices are below it */
  uint64_t memory_bytes; /* held by the library, padding included; for a view only those of layers, for a snapshot 0 */
  const float* streams[9];   /* the floats, as in shaftcull_view_create(), of a tree in tree order; the rest is NULL */
  const uint32_t* order;     /* for a tree: order[p] is the caller's index of leaf p; NULL if there are no leaves */
  const uint32_t* layers;    /* layers[i] are those of bound i, or of leaf i of a tree; NULL without layers */
  shaftcull_box box;         /* around a tree; the empty box for a view, a stream, and a tree that needs a refit */
  shaftcull_bound_kind kind; /* boxes, spheres or triangles */
  shaftcull_holder holder;   /* the holder of the bounds */
  uint32_t needs_refit;      /* 1 if a tree was updated by index since the last refit */
  uint32_t reserved;         /* 0 */
} shaftcull_bounds_info;

/// Describes bounds. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_bounds_describe(const shaftcull_bounds* bounds, shaftcull_bounds_info* info);

/// Gives bound indices[i] of a tree the value of the source at i, for `count` indices. If an index occurs twice, the
/// last value counts. Queries then return SHAFTCULL_NEEDS_REFIT until shaftcull_tree_refit(). O(count), except for the
/// first call, which is O(n) and allocates an index per bound. Refuses an index not below the number of bounds.
SHAFTCULL_API shaftcull_status shaftcull_tree_update_some(shaftcull_bounds* tree, const uint32_t* indices,
                                                          uint64_t count, const shaftcull_source* source);

/// Fits the nodes of a tree to bounds that were updated by index. O(updated), at most O(n).
SHAFTCULL_API shaftcull_status shaftcull_tree_refit(shaftcull_bounds* tree);

/// Sorts the bounds of a tree again, as they are now. Indices stay, the order changes. A dynamic tree commits its
/// changes, too. Time and allocation are as for shaftcull_tree_create().
SHAFTCULL_API shaftcull_status shaftcull_tree_rebuild(shaftcull_bounds* tree);

/// Gives the bounds of a tree new indices, in tree order: the index of leaf p becomes p. O(n).
SHAFTCULL_API shaftcull_status shaftcull_tree_reorder(shaftcull_bounds* tree);

/// The state of a tree and of its upkeep. Counters of upkeep are 0 for trees that are not dynamic.
typedef struct shaftcull_tree_info {
  double sah_ratio;     /* how much larger nodes have become since bounds were sorted; at 2 or 3 a rebuild pays off */
  uint64_t bound_count; /* number of bounds; for a dynamic tree with all changes, committed or not */
  uint64_t blocks;      /* in a dynamic tree: groups of up to 4,096 bounds, which are sorted together */
  uint64_t waiting;     /* bounds in blocks that have grown enough to be sorted again */
  uint64_t sorted_last; /* bounds that the last commit sorted */
} shaftcull_tree_info;

/// Describes a tree, dynamic or not. SHAFTCULL_NEEDS_REFIT for a tree that needs a refit. O(n / 64); for a dynamic
/// tree, O(n / 4096). No allocation.
SHAFTCULL_API shaftcull_status shaftcull_tree_describe(const shaftcull_bounds* tree, shaftcull_tree_info* info);

/* ---- Dynamic trees: bounds that come, go and move ---- */

/* Changes wait for shaftcull_dynamic_tree_commit(), and queries see the last commit (dynamic_tree.hpp). One thread at a
   time makes changes, commits, and queries the tree. Other threads make snapshots with shaftcull_bounds_copy(), and
   query these. Queries, exclusions and candidates name bounds by the `index` of their ids; no shaft keeps an index
   without a bound. A call that fails changes nothing. */

/// The id of a bound in a dynamic tree. The index of an erased bound is used again, with the next generation, so an id
/// never denotes another bound.
typedef struct shaftcull_bound_id {
  uint32_t index;      /* the index that queries return */
  uint32_t generation; /* how many bounds had the index before */
} shaftcull_bound_id;

/// Makes an empty dynamic tree of SHAFTCULL_BOXES or SHAFTCULL_SPHERES. A commit sorts up to `sorted_per_change` bounds
/// again for each change, to keep queries fast; 2 suits most programs, and with 0 it sorts only blocks that are too
/// full or too empty. Refuses a number that is negative or not finite. O(1). Freed by shaftcull_bounds_free().
SHAFTCULL_API shaftcull_status shaftcull_dynamic_tree_create(shaftcull_bound_kind kind, double sorted_per_change,
                                                             shaftcull_bounds** tree);

/// Inserts the bounds of a source, which must be of the tree's kind, and writes the id of bound i to ids[i]. `layers`
/// has one set of bits per bound; if it is NULL, the bounds are in all layers. SHAFTCULL_BAD_BOUND as for
/// shaftcull_stream_create(). Refuses sources of centres and of existing bounds, and more than 2²⁹ bounds. O(count);
/// allocates 32 bytes per bound until the commit, and a copy of the bounds during the call.
SHAFTCULL_API shaftcull_status shaftcull_dynamic_tree_insert(shaftcull_bounds* tree, const shaftcull_source* source,
                                                             const uint32_t* layers, shaftcull_bound_id* ids);

/// Erases bounds. Refuses an id that has no bound, or occurs twice. O(count); allocates as for insertions.
SHAFTCULL_API shaftcull_status shaftcull_dynamic_tree_erase(shaftcull_bounds* tree, const shaftcull_bound_id* ids,
                                                            uint64_t count);

/// Gives bound ids[i] the value of the source at i, or moves it by displacements[i], 3 floats each: one of `source` and
/// `displacements` is NULL. If an id occurs twice, the last value of a source counts; with displacements, such an id is
/// refused. Refuses an id that has no bound. Sources, errors and allocation are as for insertions.
SHAFTCULL_API shaftcull_status shaftcull_dynamic_tree_move(shaftcull_bounds* tree, const shaftcull_bound_id* ids,
                                                           uint64_t count, const shaftcull_source* source,
                                                           const float* displacements);

/// Makes all changes visible to queries. O(changes), plus the upkeep; in parallel.
SHAFTCULL_API shaftcull_status shaftcull_dynamic_tree_commit(shaftcull_bounds* tree);

/// Writes the values of bounds, with all changes, to `bounds`: for each id, a shaftcull_box or a shaftcull_sphere,
/// depending on the tree's kind. Refuses an id that has no bound. O(count); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_dynamic_tree_read(const shaftcull_bounds* tree, const shaftcull_bound_id* ids,
                                                           uint64_t count, void* bounds);

/* ---- Arrays of shafts ---- */

/// An array of shafts of all kinds, hulls included, ready for queries. 832 bytes per shaft, aligned by the library.
typedef struct shaftcull_shafts shaftcull_shafts;

/// Makes an array of `count` shafts that were never formed. Queries refuse such a shaft, with its position. O(count).
/// Freed by shaftcull_shafts_free().
SHAFTCULL_API shaftcull_status shaftcull_shafts_create(uint64_t count, shaftcull_shafts** shafts);

/// Frees an array; does nothing for NULL.
SHAFTCULL_API void shaftcull_shafts_free(shaftcull_shafts* shafts);

/// Copies shafts from [source_first, source_first + count) of `source` to [first, first + count) of `shafts`. Both may
/// be the same array, and ranges may overlap. O(count). If `source` ever held a hull, the first such copy takes O(all
/// of `shafts`), and allocates as shaftcull_shafts_set_hull().
SHAFTCULL_API shaftcull_status shaftcull_shafts_copy(shaftcull_shafts* shafts, uint64_t first,
                                                     const shaftcull_shafts* source, uint64_t source_first,
                                                     uint64_t count);

/// The state of one shaft of an array.
typedef struct shaftcull_shafts_info {
  shaftcull_box a;           /* box a as given; the start of a moving box; the box around a hull */
  shaftcull_box b;           /* box b as given; the end of a moving box, rounded to nearest; the box around a hull */
  uint32_t formed;           /* 1 if the shaft was set */
  uint32_t has_planes;       /* 1 if its joining planes are computed */
  shaftcull_contact contact; /* whether it keeps bounds that only touch it */
  uint32_t is_hull;          /* 1 if it is a convex hull */
} shaftcull_shafts_info;

/// Describes a shaft. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_describe(const shaftcull_shafts* shafts, uint64_t shaft,
                                                         shaftcull_shafts_info* info);

/// Planes that cut shafts: the planes of a shaft's box a, then the planes of its box b, at most 16 per shaft. All boxes
/// of a source have the same number of planes, k = count / boxes, and box i has planes k · i to k · i + k − 1. If all
/// fields are zero, there are no planes.
typedef struct shaftcull_batch_planes {
  const shaftcull_plane* a; /* planes of the boxes a */
  uint64_t a_count;         /* number of these planes */
  const shaftcull_plane* b; /* planes of the boxes b */
  uint64_t b_count;         /* number of these planes */
} shaftcull_batch_planes;

/* The functions below set shafts from sources of boxes. If there are two sources, they may be the same. Boxes of
   existing bounds are read in place. Other boxes are copied, which allocates 24 bytes per box unless there is only one.
   Pairs, vectors and planes are copied, too. */

/// Forms the shafts between pairs of boxes. Shaft first + i is between box pairs[i].a of `a` and box pairs[i].b of `b`;
/// if `pairs` is NULL, it is between box i of `a` and box i of `b`, which have `count` boxes each. If `planes` is NULL,
/// there are no planes. SHAFTCULL_BAD_BOUND for the first pair with a box that is not finite or has lo > hi, and for
/// the first centre and half extent that do not form a box. Boxes that no pair names may have any values. 5 to 11 ns
/// per shaft of many, about 0.1 µs for one; no allocation for a shaft of two single boxes.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_between(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                            const shaftcull_source* a, const shaftcull_source* b,
                                                            const shaftcull_index_pair* pairs,
                                                            const shaftcull_batch_planes* planes,
                                                            shaftcull_contact contact);

/// Where the movement of a body ends.
typedef uint32_t shaftcull_sweep;
enum {
  SHAFTCULL_SWEPT = 0,         /* after its displacement */
  SHAFTCULL_SWEPT_INFINITE = 1 /* never: the body moves on in its direction, which is not 0 */
};

/// Forms the shafts that `count` bodies sweep over, each with its displacement or direction of 3 floats. All bodies
/// have the same number of planes, `plane_count` in all and at most 16 per body. Contact is closed. SHAFTCULL_BAD_BOUND
/// for the first shaft that cannot be formed. About 20 ns per shaft.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_swept(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                          const shaftcull_source* bodies, const float* displacements,
                                                          shaftcull_sweep sweep, const shaftcull_plane* planes,
                                                          uint64_t plane_count);

/// Forms the shadows of occluders by lights, for pairs of a light and an occluder, which must be apart. A shadow
/// reaches up to `*reach` times the distance of its occluder; `*reach` is 1 or more. If `reach` is NULL, the shadow has
/// no end. Contact is closed. Pairs, planes and errors are as for shaftcull_shafts_set_between(); about 35 ns per
/// shaft, 90 with a reach.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_shadow(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                           const shaftcull_source* lights,
                                                           const shaftcull_source* occluders,
                                                           const shaftcull_index_pair* pairs, const float* reach,
                                                           const shaftcull_batch_planes* planes);

/// Makes one shaft a convex hull. The array keeps the parts of the hull that it needs, so the hull may be freed. The
/// first hull of an array allocates 16 bytes for each of its shafts.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_hull(shaftcull_shafts* shafts, uint64_t shaft,
                                                         const shaftcull_hull* hull);

/// Computes pending joining planes, about 65 ns per shaft. This pays off for shafts that answer more than one query
/// about inside, in the form of planes, or about some spheres. No allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_complete(shaftcull_shafts* shafts, uint64_t first, uint64_t count);

/// Chooses whether shafts keep bounds that only touch them. Refuses shafts that were never formed, with their position.
/// About 10 ns per shaft; no allocation.
SHAFTCULL_API shaftcull_status shaftcull_shafts_set_contact(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                            shaftcull_contact contact);

/* ---- Queries ---- */

/// The options of a query. If all are zero, or the pointer to them is NULL, the query is about all bounds. Each option
/// works with bounds of every kind in every holder, unless its comment states otherwise. A query refuses an option that
/// does not apply to it, and names the option. Arrays of options share no memory with outputs.
typedef struct shaftcull_query {
  /// Bounds to leave out for all shafts, by index: a moving body itself, for example. Use `exclude_mask` for very many
  /// indices.
  const uint32_t* exclude;
  uint64_t exclude_count;
  /// Bounds to leave out for each shaft: one row of indices per shaft, rows of equal length, row after row. For
  /// example, the two objects at the ends of a shaft. The count is that of all rows together.
  const uint32_t* exclude_each;
  uint64_t exclude_each_count;
  /// Bounds to leave out for all shafts, as bits: bounds whose bits are set. 0 words, or shaftcull_bit_words(number of
  /// bounds).
  const uint64_t* exclude_mask;
  uint64_t exclude_mask_words;
  /// Layers to search, one mask per shaft or one mask for all: bounds that are in none of these layers are left out.
  /// With a count of 0, layers are ignored. The bounds must have layers (shaftcull_bounds_set_layers()).
  const uint32_t* layer_masks;
  uint64_t layer_mask_count;
  /// Candidates, by index: the query tests only these bounds, and lists keep their order. If the pointer is NULL and
  /// the count 0, it tests all bounds. If the pointer is not NULL and the count 0, it tests none. Queries for occluders
  /// refuse candidates. O(candidates) per shaft. The first such query of a tree may take O(n) and allocate an index per
  /// bound. Queries about several shafts allocate a copy of the candidates' bounds.
  const uint32_t* only;
  uint64_t only_count;
  /// The largest number of results per shaft: the query returns the first ones, and stops after that many. With 0,
  /// there is no limit, unlike in C++, where 0 allows no results. For shaftcull_count(), shaftcull_list(),
  /// shaftcull_list_many() and shaftcull_list_occluders().
  uint64_t limit;
  shaftcull_triangle_test triangle_test; /* of triangles; 0 for other bounds */
  uint32_t skip_overlapping; /* whether first contact skips bounds that overlap the box at the start: 1 or 0 */
  uint64_t reserved[4];      /* 0 */
} shaftcull_query;

/* For all queries: `bounds` are of any kind that the function does not exclude, in any holder. `query` may be NULL.
   Queries refuse a shaft that was never formed, and return SHAFTCULL_NEEDS_REFIT for a tree that needs a refit. A query
   of a view or stream takes O(n) per shaft. The time of a query of a tree grows with the number of results. */

/// Writes a row of bits per shaft: the bits of the bounds that it keeps, which are not outside. `words` is the number
/// of words of all rows, count · shaftcull_bit_words(number of bounds).
SHAFTCULL_API shaftcull_status shaftcull_cull(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              uint64_t* kept, uint64_t words);

/// Writes two rows of bits per shaft: the bits of the bounds that it keeps, and the bits of those that are inside. Each
/// array has `words` words, as in shaftcull_cull(), in separate memory. `kept` may be NULL: then only `inside` is
/// written.
SHAFTCULL_API shaftcull_status shaftcull_classify(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                  const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                  uint64_t* kept, uint64_t* inside, uint64_t words);

/// Writes how many bounds each shaft keeps: `count` numbers.
SHAFTCULL_API shaftcull_status shaftcull_count(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                               const shaftcull_bounds* bounds, const shaftcull_query* query,
                                               uint64_t* kept_counts);

/// Writes how many bounds overlap each shaft, and how many are inside: `count` elements. Queries about several shafts
/// allocate 16 bytes per shaft.
SHAFTCULL_API shaftcull_status shaftcull_count_classified(const shaftcull_shafts* shafts, uint64_t first,
                                                          uint64_t count, const shaftcull_bounds* bounds,
                                                          const shaftcull_query* query, shaftcull_kept_counts* counts);

/// Writes a bit per shaft: whether it keeps any bound. `any` has shaftcull_bit_words(count) words; for one shaft, its
/// word becomes 1 or 0. For each shaft, the query stops soon after the first bound that it finds.
SHAFTCULL_API shaftcull_status shaftcull_any(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                             const shaftcull_bounds* bounds, const shaftcull_query* query,
                                             uint64_t* any);

/// Writes the bound that the moving box of each shaft reaches first, and the time: `count` elements. Not for hulls or
/// triangles. Queries about several shafts allocate 20 bytes per shaft. With skip_overlapping in the query, bounds that
/// the box overlaps at the start are left out. With closed contact these are all bounds that touch the box, whose time
/// is 0. With open contact they are the bounds whose relative interiors meet that of the box, so a wall that the box
/// only touches still stops it.
SHAFTCULL_API shaftcull_status shaftcull_first_contact(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                       const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                       shaftcull_contact_found* contacts);

/// Writes a bit per shaft: whether one of these solid boxes alone hides one end of the shaft from the other. `occluded`
/// has shaftcull_bit_words(count) words; for one shaft, its word becomes 1 or 0. For boxes, and shafts between two
/// boxes.
SHAFTCULL_API shaftcull_status shaftcull_occluded(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                  const shaftcull_bounds* solids, const shaftcull_query* query,
                                                  uint64_t* occluded);

/* ---- Lists ---- */

/// Lists the bounds that one shaft keeps: writes their indices to `kept`, which has room for `room` indices, and their
/// full number to `kept_count`. The indices ascend, or have the order of a tree or of candidates. `kept` may begin
/// where the candidates of the query begin; the results then overwrite the candidates.
SHAFTCULL_API shaftcull_status shaftcull_list(const shaftcull_shafts* shafts, uint64_t shaft,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              uint32_t* kept, uint64_t room, uint64_t* kept_count);

/// Lists bounds that overlap one shaft and bounds that are inside separately, in two arrays that share no memory.
/// Otherwise as shaftcull_list().
SHAFTCULL_API shaftcull_status shaftcull_list_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                                         const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                         uint32_t* overlap, uint64_t overlap_room, uint32_t* inside,
                                                         uint64_t inside_room, shaftcull_kept_counts* counts);

/// Lists of indices in the library's memory, one per shaft, one after another. Calls reuse that memory.
typedef struct shaftcull_lists shaftcull_lists;

/// Makes empty lists. O(1). Freed by shaftcull_lists_free().
SHAFTCULL_API shaftcull_status shaftcull_lists_create(shaftcull_lists** lists);

/// Frees lists; does nothing for NULL.
SHAFTCULL_API void shaftcull_lists_free(shaftcull_lists* lists);

/// All lists. Pointers are valid until the lists are filled again or freed.
typedef struct shaftcull_lists_info {
  uint64_t count;          /* number of lists, one per shaft; 0 at first */
  const uint64_t* offsets; /* list s is indices[offsets[s]] to before indices[offsets[s + 1]]; NULL at first */
  const uint32_t* indices; /* the indices of all lists; NULL if there are none */
} shaftcull_lists_info;

/// Describes lists. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_lists_describe(const shaftcull_lists* lists, shaftcull_lists_info* info);

/// Lists the bounds that each shaft keeps. If the call fails, the lists are as they were or empty. Allocates the lists.
SHAFTCULL_API shaftcull_status shaftcull_list_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                   const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                   shaftcull_lists* lists);

/// Lists bounds that overlap each shaft and bounds that are inside separately, in two different shaftcull_lists.
/// Otherwise as shaftcull_list_many().
SHAFTCULL_API shaftcull_status shaftcull_list_classified_many(const shaftcull_shafts* shafts, uint64_t first,
                                                              uint64_t count, const shaftcull_bounds* bounds,
                                                              const shaftcull_query* query, shaftcull_lists* overlap,
                                                              shaftcull_lists* inside);

/// Lists all solid boxes that alone hide one end of each shaft from the other. Boxes and shafts are as for
/// shaftcull_occluded(), lists as for shaftcull_list_many().
SHAFTCULL_API shaftcull_status shaftcull_list_occluders(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                        const shaftcull_bounds* solids, const shaftcull_query* query,
                                                        shaftcull_lists* lists);

/// Writes the index of a solid box that alone hides one end of one shaft from the other. If there are several, it is
/// the lowest index in a view or stream, and the first in tree order in a tree. SHAFTCULL_NONE if there is no such box.
/// Boxes and shafts are as for shaftcull_occluded().
SHAFTCULL_API shaftcull_status shaftcull_find_occluder(const shaftcull_shafts* shafts, uint64_t shaft,
                                                       const shaftcull_bounds* solids, const shaftcull_query* query,
                                                       uint64_t* index);

/// Writes the times at which the moving box of one shaft reaches `count` bounds: times[i] is that of bound indices[i],
/// rounded down, or +∞ if the shaft does not keep the bound. The two arrays share no memory. Not for hulls or
/// triangles. O(count), except for the first such call for a tree, which may take O(n) and allocate an index per bound.
SHAFTCULL_API shaftcull_status shaftcull_entry_times(const shaftcull_shafts* shafts, uint64_t shaft,
                                                     const shaftcull_bounds* bounds, const uint32_t* indices,
                                                     float* times, uint64_t count);

/* ---- One shaft, one bound ---- */

/// Writes the answer of one shaft for one bound. `bound` points to a shaftcull_box, shaftcull_sphere or
/// shaftcull_triangle, depending on `kind`. `test` is the test of a triangle; 0 for other bounds. A box takes about
/// 14 ns if it is outside and 50 ns otherwise, a triangle 100 ns and 0.5 µs. For a sphere within the box around a
/// shaft, the call uses the shaft's joining planes. While these are pending, each call computes them, in 80 ns;
/// shaftcull_shafts_complete() computes them once. No allocation.
SHAFTCULL_API shaftcull_status shaftcull_classify_one(const shaftcull_shafts* shafts, uint64_t shaft,
                                                      shaftcull_bound_kind kind, const void* bound,
                                                      shaftcull_triangle_test test, shaftcull_answer* answer);

/// Writes whether one solid hides one end of the shaft from the other, 1 or 0. `corners` has 3 floats for each of
/// `count` corners: 2 are lo and hi of a solid box; 3 or more are a convex polygon, a wall at any angle for example, in
/// order, either way round. For shafts between two boxes or polygons. O(count): a few microseconds for a polygon.
/// Allocates nothing for a box, and a copy of the corners for a polygon.
SHAFTCULL_API shaftcull_status shaftcull_occluded_by(const shaftcull_shafts* shafts, uint64_t shaft,
                                                     const float* corners, uint64_t count, uint32_t* occluded);

/* ---- Visibility: which pairs of patches see each other ---- */

/// The answer for a pair of patches (visibility.hpp).
typedef uint32_t shaftcull_sight;
enum {
  SHAFTCULL_SIGHT_UNDECIDED = 0,  /* Some occluders stand between the patches, and no solid hides one from the other. */
  SHAFTCULL_SIGHT_CLEAR = 1,      /* No occluder stands between the patches. */
  SHAFTCULL_SIGHT_OCCLUDED = 2,   /* One solid hides each patch from the other. */
  SHAFTCULL_SIGHT_FACING_AWAY = 3 /* One patch is on or behind the plane of the other. */
};

/// The name of an answer, for example "occluded"; "unknown" for any other number. The string is valid for ever. Never
/// fails. O(1).
static inline const char* shaftcull_sight_name(shaftcull_sight sight) {
  switch (sight) {
    case SHAFTCULL_SIGHT_UNDECIDED:
      return "undecided";
    case SHAFTCULL_SIGHT_CLEAR:
      return "clear";
    case SHAFTCULL_SIGHT_OCCLUDED:
      return "occluded";
    case SHAFTCULL_SIGHT_FACING_AWAY:
      return "facing_away";
    default:
      return "unknown";
  }
}

/// Patches, in a tree: convex polygons, or boxes, each with or without a plane. A patch faces where its normal points.
/// Patches never change.
typedef struct shaftcull_patches shaftcull_patches;

/// Makes patches of a source of boxes. `plane_count` is 0, or there is one plane per patch. A patch sees points in
/// front of its plane. SHAFTCULL_BAD_BOUND for the first box that is not finite or has lo > hi, and for the first plane
/// that is not finite or has no normal. O(n log n); holds about 100 bytes per patch. Freed by shaftcull_patches_free().
SHAFTCULL_API shaftcull_status shaftcull_patches_create(const shaftcull_source* boxes, const shaftcull_plane* planes,
                                                        uint64_t plane_count, shaftcull_patches** patches);

/// The sides from which a patch with corners is seen.
typedef uint32_t shaftcull_patch_sides;
enum {
  SHAFTCULL_PATCH_FRONT = 0, /* from the side from which its corners run counter-clockwise */
  SHAFTCULL_PATCH_BOTH = 1   /* from both sides; two patches in one plane are facing away */
};

/// Makes patches that are convex polygons: patch i has the corners from first_corner[i] to before first_corner[i + 1],
/// 3 to 8 of them in order. `corners` has 3 floats per corner, and `first_corner` has one number more than there are
/// patches. SHAFTCULL_BAD_BOUND for the first patch with a corner that is not finite. O(n log n); holds about 150 bytes
/// per patch of 4 corners. Freed by shaftcull_patches_free().
SHAFTCULL_API shaftcull_status shaftcull_patches_create_polygons(const float* corners, uint64_t corner_count,
                                                                 const uint64_t* first_corner, uint64_t patch_count,
                                                                 shaftcull_patch_sides sides,
                                                                 shaftcull_patches** patches);

/// Frees patches; does nothing for NULL.
SHAFTCULL_API void shaftcull_patches_free(shaftcull_patches* patches);

/// The state of patches. The pointer is valid until the patches are freed.
typedef struct shaftcull_patches_info {
  uint64_t count;        /* number of patches */
  const uint32_t* order; /* runs refer to it: order[p] is the caller's index of patch p; NULL if there are none */
} shaftcull_patches_info;

/// Describes patches. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_patches_describe(const shaftcull_patches* patches,
                                                          shaftcull_patches_info* info);

/// Occluders: objects that may stand between patches. They are numbered from 0 in the order in which they are added.
typedef struct shaftcull_occluders shaftcull_occluders;

/// Makes an empty set of occluders, to which occluders can be added. O(1). Freed by shaftcull_occluders_free().
SHAFTCULL_API shaftcull_status shaftcull_occluders_create(shaftcull_occluders** occluders);

/// Frees occluders; does nothing for NULL.
SHAFTCULL_API void shaftcull_occluders_free(shaftcull_occluders* occluders);

/// The number of occluders; 0 for NULL. Never fails. O(1).
SHAFTCULL_API uint64_t shaftcull_occluders_count(const shaftcull_occluders* occluders);

/* Functions that add occluders write the number of the first new occluder to `first`, which may be NULL. They return
   SHAFTCULL_BAD_BOUND for the first box that is not finite or has lo > hi, or the first corner or triangle that is not
   finite. They take O(count), and allocate the memory of the new occluders, and a copy during the call. */

/// Adds boxes around things that may hide something, one occluder per box.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_boxes(shaftcull_occluders* occluders,
                                                             const shaftcull_source* boxes, uint64_t* first);

/// Adds solid boxes, one occluder per box. They make pairs occluded, also if several form one larger box together.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_solids(shaftcull_occluders* occluders,
                                                              const shaftcull_source* boxes, uint64_t* first);

/// Adds solid convex hulls, one occluder per hull: hull i has the corners first_corner[i] to before first_corner[i + 1]
/// of all `corner_count` corners, 3 floats each, with 4 or more corners per hull. `first_corner` has hull_count + 1
/// numbers, or may be NULL if there are no hulls.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_solid_hulls(shaftcull_occluders* occluders, const float* corners,
                                                                   uint64_t corner_count, const uint64_t* first_corner,
                                                                   uint64_t hull_count, uint64_t* first);

/// Adds flat convex polygons by their corners in order, 3 or more each, one occluder per polygon. They make pairs
/// occluded. Corners are as in shaftcull_occluders_add_solid_hulls(). If the corners of a polygon are slightly out of
/// plane, the polygon is the triangles that its first corner forms with its other edges. Convexity is not checked.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_polygons(shaftcull_occluders* occluders, const float* corners,
                                                                uint64_t corner_count, const uint64_t* first_corner,
                                                                uint64_t polygon_count, uint64_t* first);

/// Adds triangles in groups, one occluder per group: group i has the triangles first_triangle[i] to before
/// first_triangle[i + 1]. `first_triangle` has group_count + 1 numbers. If it is NULL and `group_count` is 0, the
/// library forms groups of at most 32 triangles that are near each other and face alike.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_triangles(shaftcull_occluders* occluders,
                                                                 const shaftcull_source* triangles,
                                                                 const uint64_t* first_triangle, uint64_t group_count,
                                                                 uint64_t* first);

/// The numbers of solids that shaftcull_occluders_add_mesh() found.
typedef struct shaftcull_found_solids {
  uint64_t hulls;       /* convex bodies */
  uint64_t polygons;    /* flat convex polygons */
  uint64_t inner_boxes; /* boxes inside bodies that are not convex */
} shaftcull_found_solids;

/// Adds a mesh: its triangles, in groups that the library forms, and the solids that they form, bodies and flat
/// polygons, so that the caller need not mark which objects are solid (find_solids() in solids.hpp). The solids found
/// make pairs occluded, but only bodies that are upright boxes are occluders: they follow the groups, and their
/// triangles are in no group. Solids narrower than `least_width`, 0 or more, are left out. If `bodies` is 1, closed
/// surfaces that face outwards are bodies. If it is 0, only polygons are found; use this for triangles without a
/// reliable orientation. Pass patches as `a` and `b` if only these are compared: then bodies may be open on or beyond
/// one face of the box around them, as buildings without a bottom are on level ground. If both are NULL, bodies must be
/// closed. If only `b` is NULL, all patches are those of `a`; `b` without `a` is refused. Writes the numbers of solids
/// found to `found`, which may be NULL. O(n log n); allocates.
SHAFTCULL_API shaftcull_status shaftcull_occluders_add_mesh(shaftcull_occluders* occluders,
                                                            const shaftcull_source* triangles, float least_width,
                                                            uint32_t bodies, const shaftcull_patches* a,
                                                            const shaftcull_patches* b, shaftcull_found_solids* found,
                                                            uint64_t* first);

/// One occluder. The pointer is valid until occluders are added or freed.
typedef struct shaftcull_occluder_info {
  const uint32_t* triangles; /* by their positions in the source from which they were added; NULL if there are none */
  uint64_t triangle_count;   /* number of triangles; 0 for boxes, hulls and polygons */
  shaftcull_box box;         /* around the whole occluder */
} shaftcull_occluder_info;

/// Describes one occluder. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_occluders_describe(const shaftcull_occluders* occluders, uint64_t occluder,
                                                            shaftcull_occluder_info* info);

/// Consecutive patches in the order of shaftcull_patches_describe().
typedef struct shaftcull_patch_run {
  uint32_t first; /* position of the first patch in the order */
  uint32_t count; /* number of patches */
} shaftcull_patch_run;

/// One answer for all pairs of a patch of one run and a patch of another.
typedef struct shaftcull_pair_block {
  shaftcull_patch_run a; /* of set a */
  shaftcull_patch_run b; /* of set b */
  shaftcull_sight sight; /* never undecided */
} shaftcull_pair_block;

/// Undecided pairs, by the caller's indices. Candidates of pair i are candidates[first_candidate[i]] to before
/// candidates[first_candidate[i + 1]], in ascending order. Both pointers are NULL if the options request no candidates.
typedef struct shaftcull_undecided_pairs {
  const shaftcull_index_pair* pairs; /* for one set with itself, a is the patch that comes first in its order */
  uint64_t count;                    /* number of pairs */
  const uint64_t* first_candidate;   /* count + 1 numbers */
  const uint32_t* candidates;        /* numbers of occluders */
} shaftcull_undecided_pairs;

/// A part of the answers, or all of them.
typedef struct shaftcull_sight_batch {
  const shaftcull_pair_block* blocks;  /* decided pairs */
  uint64_t block_count;                /* number of blocks */
  shaftcull_undecided_pairs undecided; /* all other pairs */
} shaftcull_sight_batch;

/// The number of pairs with each answer.
typedef struct shaftcull_sight_counts {
  uint64_t undecided;   /* SHAFTCULL_SIGHT_UNDECIDED */
  uint64_t clear;       /* SHAFTCULL_SIGHT_CLEAR */
  uint64_t occluded;    /* SHAFTCULL_SIGHT_OCCLUDED */
  uint64_t facing_away; /* SHAFTCULL_SIGHT_FACING_AWAY */
} shaftcull_sight_counts;

/// Receives a batch, which is valid during the callback only, and `user` as it was passed. Returns 0 to continue; any
/// other number ends the call with SHAFTCULL_STOPPED. The callback may run on any thread, one call at a time. It must
/// return: no exception and no longjmp may leave it.
typedef int32_t (*shaftcull_sight_callback)(const shaftcull_sight_batch* batch, void* user);

/// May decide undecided pairs, by rays for example, before they are delivered. verdicts[i] is one byte for pair i: a
/// value of shaftcull_sight, at first SHAFTCULL_SIGHT_UNDECIDED. Many threads call this callback at once. Its return
/// value has the meaning of that of shaftcull_sight_callback.
typedef int32_t (*shaftcull_resolve_callback)(const shaftcull_undecided_pairs* undecided, uint8_t* verdicts,
                                              void* user);

/// Receives the number of pairs answered so far and the number of all pairs, several times per second. Its return value
/// has the meaning of that of shaftcull_sight_callback, so it can end the call.
typedef int32_t (*shaftcull_progress_callback)(uint64_t done, uint64_t total, void* user);

/// The options of visibility.
typedef struct shaftcull_visibility_options {
  uint64_t memory;                      /* bytes for answers in progress, 1 MB or more */
  shaftcull_contact contact;            /* whether occluders that only touch a shaft stand between patches */
  uint32_t solids_around_ends;          /* 0: a solid that an end reaches into does not make a pair occluded */
  uint32_t candidates;                  /* 1: undecided pairs come with candidates */
  float tolerance;                      /* how far in front of a plane counts as behind it (visibility.hpp) */
  uint32_t part;                        /* the part of all pairs to answer, 0 to parts - 1 (visibility.hpp) */
  uint32_t parts;                       /* number of parts, 1 or more; 1: all pairs */
  shaftcull_resolve_callback resolve;   /* or NULL */
  shaftcull_progress_callback progress; /* or NULL */
  void* user;                           /* passed to both callbacks */
  uint64_t reserved[4];                 /* 0 */
} shaftcull_visibility_options;

/// The default options: 256 MB, open contact, solids around ends, candidates, no tolerance, all pairs, no callbacks.
/// Never fails.
static inline shaftcull_visibility_options shaftcull_default_visibility_options(void) {
  const shaftcull_visibility_options options = {268435456,
                                                SHAFTCULL_CONTACT_OPEN,
                                                1,
                                                1,
                                                0,
                                                0,
                                                1,
                                                (shaftcull_resolve_callback)0,
                                                (shaftcull_progress_callback)0,
                                                (void*)0,
                                                {0, 0, 0, 0}};
  return options;
}

/* For the functions below: a pair is a patch of `a` and a patch of `b`; if `b` is NULL, it is two patches of `a`, each
   pair once. If `options` is NULL, the defaults apply. `counts` receives the number of pairs with each answer, and may
   be NULL unless there is no other result. The functions refuse less memory than 1 MB, and return SHAFTCULL_STOPPED if
   a callback ends the call. They run in parallel, and allocate as the options allow. */

/// Delivers each pair exactly once, in batches, to `callback`. With NULL for `callback`, the call only counts pairs.
/// The order of answers does not depend on the number of threads.
SHAFTCULL_API shaftcull_status shaftcull_visibility(const shaftcull_patches* a, const shaftcull_patches* b,
                                                    const shaftcull_occluders* occluders,
                                                    const shaftcull_visibility_options* options,
                                                    shaftcull_sight_callback callback, void* user,
                                                    shaftcull_sight_counts* counts);

/// Writes a bit per pair: rows of shaftcull_bit_words(patches of b) words, one for each patch of `a`. Bit j of row i is
/// set if `sight` is the answer for patches i and j. `words` is the number of words of all rows. For one set with
/// itself, both bits of a pair are written, and the diagonal is 0. If the call fails, bits are unspecified.
SHAFTCULL_API shaftcull_status shaftcull_visibility_bits(const shaftcull_patches* a, const shaftcull_patches* b,
                                                         const shaftcull_occluders* occluders,
                                                         const shaftcull_visibility_options* options,
                                                         shaftcull_sight sight, uint64_t* bits, uint64_t words,
                                                         shaftcull_sight_counts* counts);

/// All answers of a call, in the library's memory.
typedef struct shaftcull_visibility_result shaftcull_visibility_result;

/// Collects all answers, in memory that is not limited: 20 bytes per pair block, of which there are about a tenth to a
/// fifth as many as pairs, 16 per undecided pair and 4 per candidate. Freed by shaftcull_visibility_result_free().
SHAFTCULL_API shaftcull_status shaftcull_collect_visibility(const shaftcull_patches* a, const shaftcull_patches* b,
                                                            const shaftcull_occluders* occluders,
                                                            const shaftcull_visibility_options* options,
                                                            shaftcull_visibility_result** result);

/// Frees answers; does nothing for NULL.
SHAFTCULL_API void shaftcull_visibility_result_free(shaftcull_visibility_result* result);

/// Writes all answers as one batch, which is valid until the answers are freed, and the number of pairs with each
/// answer; `counts` may be NULL. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_visibility_result_describe(const shaftcull_visibility_result* result,
                                                                    shaftcull_sight_batch* batch,
                                                                    shaftcull_sight_counts* counts);

/* ---- Rays and view factors ---- */

/// The options of rays (RayOptions of rays.hpp).
typedef struct shaftcull_ray_options {
  uint64_t seed;        /* the points where rays start and end depend only on the seed and the pair */
  double error;         /* a pair gets fewer rays if its estimated standard error is at most this; 0: all rays */
  uint32_t rays;        /* per pair, 1 to 65536; a multiple of 16 is cast */
  float tolerance;      /* surfaces nearer than this to an end of a ray do not block it */
  uint64_t reserved[4]; /* 0 */
} shaftcull_ray_options;

/// The default options: 64 rays, seed 1, no error, no tolerance. Never fails.
static inline shaftcull_ray_options shaftcull_default_ray_options(void) {
  const shaftcull_ray_options options = {1, 0, 64, 0, {0, 0, 0, 0}};
  return options;
}

/// Writes the visible fraction of each pair, from 0 to 1, to `fractions`, pairs->count of them. It is the share of
/// segments that no candidate blocks, among the segments between points of both patches that leave and arrive in front.
/// Each pair is a patch of `a` and a patch of `b` (or of `a` if `b` is NULL), and has candidates. If `options` is NULL,
/// the defaults apply. May be called from a shaftcull_resolve_callback. Refuses pairs and candidates out of range,
/// pairs without candidates, options out of range, and patches that are boxes with an interior. Runs in parallel if
/// there are many pairs; the first call with a set of occluders prepares the set; allocates. The result has the same
/// bits on every machine.
SHAFTCULL_API shaftcull_status shaftcull_visible_fractions(const shaftcull_patches* a, const shaftcull_patches* b,
                                                           const shaftcull_occluders* occluders,
                                                           const shaftcull_undecided_pairs* pairs,
                                                           const shaftcull_ray_options* options, float* fractions);

/// Writes the lit fraction of each patch for each light, from 0 to 1: the share of the patch from which no occluder
/// hides the light (lit_fractions() in rays.hpp). `directions` has 3 floats for each of `direction_count` lights that
/// are infinitely far away, such as the sun; each direction points to its light. fractions[i * direction_count + j] is
/// for patch i and light j. If `options` is NULL, the defaults apply. Refuses a direction that is 0 or not finite,
/// options out of range, and patches that are boxes with an interior. Runs in parallel over patches; allocates. The
/// result has the same bits on every machine.
SHAFTCULL_API shaftcull_status shaftcull_lit_fractions(const shaftcull_patches* patches,
                                                       const shaftcull_occluders* occluders, const float* directions,
                                                       uint64_t direction_count, const shaftcull_ray_options* options,
                                                       float* fractions);

/// The options of view factors (ViewFactorOptions of view_factors.hpp).
typedef struct shaftcull_view_factor_options {
  uint64_t memory;                      /* bytes for answers in progress, 1 MB or more; not for the matrix */
  uint64_t seed;                        /* as for rays */
  double error;                         /* as for rays, for both factors of a pair; 0: all rays */
  double least;                         /* pairs both of whose factors are below this are left out of the matrix */
  uint32_t rays;                        /* largest number of rays per undecided pair, 1 to 65536 */
  uint32_t close_rows;                  /* 1: rows are scaled to sum to 1, as those of an enclosure do */
  float tolerance;                      /* as for visibility and for rays */
  uint32_t part;                        /* as for visibility: the matrix has the factors of this part */
  uint32_t parts;                       /* number of parts; add their matrices; 1 with close_rows */
  uint32_t reserved_padding;            /* 0 */
  shaftcull_progress_callback progress; /* or NULL */
  void* user;                           /* passed to the callback */
  uint64_t reserved[4];                 /* 0 */
} shaftcull_view_factor_options;

/// The default options: 256 MB, seed 1, error 1e-5, all pairs, 4096 rays, rows as they are, no tolerance, no
/// callback. Never fails.
static inline shaftcull_view_factor_options shaftcull_default_view_factor_options(void) {
  const shaftcull_view_factor_options options = {
      268435456, 1, 1e-5, 0, 4096, 0, 0, 0, 1, 0, (shaftcull_progress_callback)0, (void*)0, {0, 0, 0, 0}};
  return options;
}

/// View factors of every two patches of a set: a sparse matrix in rows (CSR).
typedef struct shaftcull_factor_matrix shaftcull_factor_matrix;

/// Makes the matrix of view factors of patches. Pairs that are clear have shaftcull_view_factor(), and pairs that are
/// occluded or facing away have 0. All other pairs have shaftcull_view_factor() times the visible part, which rays
/// estimate. If `options` is NULL, the defaults apply. SHAFTCULL_STOPPED if a callback ends the call. Refuses options
/// out of range, patches without planes, patches with two sides, patches that are boxes with an interior, and rows that
/// are to be closed and are off by more than 0.1. Runs in parallel; allocates 56 bytes per pair with a factor. The
/// result has the same bits on every machine. Freed by shaftcull_factor_matrix_free().
SHAFTCULL_API shaftcull_status shaftcull_view_factors(const shaftcull_patches* patches,
                                                      const shaftcull_occluders* occluders,
                                                      const shaftcull_view_factor_options* options,
                                                      shaftcull_factor_matrix** matrix);

/// Frees a matrix; does nothing for NULL.
SHAFTCULL_API void shaftcull_factor_matrix_free(shaftcull_factor_matrix* matrix);

/// The parts of a matrix. Row i has the factors from patch i: factor[k] is to patch column[k], for k from first[i] to
/// before first[i + 1]; columns ascend. Pointers are valid until the matrix is freed.
typedef struct shaftcull_factor_matrix_info {
  uint64_t size;                 /* number of patches, and of elements of each array below that is not per factor */
  uint64_t factors;              /* number of factors in the matrix */
  const uint64_t* first;         /* size + 1: where the factors of each row begin; then the end of the last */
  const uint32_t* column;        /* per factor, the patch that it is to */
  const double* factor;          /* per factor, its value */
  const double* area;            /* area of each patch */
  const double* sum;             /* of each row, left-out factors included; 1 - sum meets no patch: the sky */
  const double* error;           /* estimated standard error of each sum */
  const double* left_out;        /* part of each sum that is below shaftcull_view_factor_options.least */
  shaftcull_sight_counts counts; /* numbers of pairs with each answer */
} shaftcull_factor_matrix_info;

/// Describes a matrix. O(1); no allocation.
SHAFTCULL_API shaftcull_status shaftcull_factor_matrix_describe(const shaftcull_factor_matrix* matrix,
                                                                shaftcull_factor_matrix_info* info);

/* ---- Instruction sets ---- */

/// Writes the name of an instruction set for which this build has kernels and that this machine can run, for example
/// "avx2". These sets are numbered from 0 on, slowest first; for a position beyond the last set, the name is NULL.
/// SHAFTCULL_NONE for `position` gives the name of the set that calls use from now on, in every thread. The string is
/// valid for ever. O(1); allocates.
SHAFTCULL_API shaftcull_status shaftcull_isa_name(uint64_t position, const char** name);

/// Makes calls in every thread use an instruction set from now on, by its name in upper or lower case. Safe at any
/// time. Overrides the environment variable SHAFTCULL_ISA. Answers do not depend on the set. Refuses a name that is not
/// available, with a message that lists those that are.
SHAFTCULL_API shaftcull_status shaftcull_select_isa(const char* name);

#ifdef __cplusplus
}
#endif

#endif
