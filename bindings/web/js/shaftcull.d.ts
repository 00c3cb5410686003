// SPDX-License-Identifier: MIT
/**
 * Shaft culling in WebAssembly: finds the objects that can stand between two boxes, that a moving box hits, and that
 * lie in a shadow or in view. Answers for boxes and triangles are those of real arithmetic for the floats given;
 * docs/exactness.md describes the answers for spheres. All answers have the same bits on every machine.
 *
 *     import {load} from 'shaftcull';
 *     const shaftcull = await load();
 *     const tree = shaftcull.boxTree(boxes);            // 6 floats for each box: lo x, y, z, hi x, y, z
 *     const shaft = shaftcull.between(lamp, table);
 *     for (const i of tree.list(shaft)) console.log(`box ${i} may stand between`);
 *
 * Numbers. All floats are float32. Arrays of numbers are accepted if each number is exactly a float32; otherwise a call
 * throws a TypeError, since nothing is rounded silently. `origin().boxesAround()` makes float32 boxes that contain
 * boxes of doubles.
 *
 * Errors. If the library refuses an argument, the call throws a `ShaftcullError`, which states what is wrong, where,
 * and what would be right. Arguments of another type or number, and objects that were freed or belong to another
 * module, cause a `TypeError`. A position that is out of range causes a `RangeError`. A call that throws leaves objects
 * as they were.
 *
 * Memory. Objects hold memory of the module until `free()`, or until they are garbage. Results of calls are copies. For
 * results, the module keeps as much memory as the largest bits, counts or list for one shaft took, up to twice that. A
 * call that the library refuses keeps memory: a few KB, and for large arguments up to three times their size. The
 * module has at most 4 GB; after 'out of memory', make a new module. A module has no threads: a worker makes a module
 * of its own.
 */

/** Float32 values: a Float32Array, or numbers that each are a float32 exactly. */
export type Floats = Float32Array | readonly number[];

/** Whether bounds that touch a shaft without reaching into it are kept ('closed') or outside ('open'). */
export type Contact = 'closed' | 'open';

/** The range of depths in clip space that is in view: `zero_to_one` as in WebGPU, `minus_one_to_one` as in WebGL. */
export type ClipDepth = 'zero_to_one' | 'minus_one_to_one';

/**
 * How hulls cull boxes. `exact`: boxes are outside iff they have no point in common with the hull. `conservative`:
 * boxes are outside iff they are beyond one face of the hull, as in the usual test of a view by its planes. This test
 * is faster, and keeps some boxes beside edges and corners.
 */
export type HullTest = 'exact' | 'conservative';

/** The answer of a shaft for one bound. */
export type Answer = 'outside' | 'overlap' | 'inside';

/** The answer for a pair of patches. */
export type Sight = 'undecided' | 'clear' | 'occluded' | 'facing_away';

/** The error of a call that failed. */
export class ShaftcullError extends Error {
  /** 'invalid argument', 'bad bound', 'needs refit', 'out of memory' or 'internal error'. */
  readonly status: string;
  /** For a bad bound, its position in the array that it came from, counted from 0. */
  readonly position: number | undefined;
}

/**
 * Instantiates the library, in about 20 ms. Without an argument, it loads `shaftcull.wasm` beside this script. The
 * argument may be the bytes of that file, a `WebAssembly.Module` of them, or their address: a `URL`, or a string, which
 * is relative to the page or, in Node.js, to the working directory.
 */
export function load(wasm?: string | object): Promise<Shaftcull>;

/**
 * A point of a world in doubles to which coordinates are relative. A bound that is outside the shaft between two boxes
 * from `boxesAround()` is outside in the world, too. Values that are NaN are not refused here, but by the calls that
 * receive them.
 */
export interface Origin {
  /** The point of the world where the origin is: x, y, z. */
  readonly at: Float64Array;
  /** The smallest boxes of floats that contain boxes of 6 doubles. */
  boxesAround(boxes: ArrayLike<number>): Float32Array;
  /**
   * The largest boxes of floats within boxes of 6 doubles: for solids, and for boxes that are to contain others. The
   * empty box if there is none.
   */
  boxesWithin(boxes: ArrayLike<number>): Float32Array;
  /** Spheres that contain spheres of 4 doubles: centres are rounded to nearest, and radii grow. */
  spheresAround(spheres: ArrayLike<number>): Float32Array;
  /**
   * Planes that keep all points of a box that planes of 4 doubles keep: normal·p ≤ offset. Normals are rounded to
   * nearest, and offsets grow. The box has 6 doubles, in the world. Throws for what is not finite or is beyond the
   * largest float.
   */
  planesAround(planes: ArrayLike<number>, box: ArrayLike<number>): Float32Array;
  /** The nearest floats to points of 3 doubles: for vertices, and for corners of patches. */
  nearest(points: ArrayLike<number>): Float32Array;
  /** The positions of points of 3 floats in the world. */
  toWorld(points: Floats): Float64Array;
}

/** One instance of the library. */
export interface Shaftcull {
  /** The version of the C++ library, for example '1.0.0'. */
  readonly version: string;
  /** The names of all instruction sets, slowest first: 'scalar' and 'portable128'. */
  readonly instructionSets: readonly string[];
  /**
   * The instruction set that calls use, at first the fastest. Answers do not depend on it. Throws for an unknown name.
   */
  instructionSet: string;

  /**
   * Makes an origin at a point of the world, by default [0, 0, 0]. Take a point near the middle of the world, whose
   * coordinates are multiples of a power of two of about 1/64 of the world's size: then round coordinates stay exact.
   * Throws for a point that is not finite.
   */
  origin(at?: ArrayLike<number>): Origin;
  /** The smallest box around points of 3 floats; the empty box, lo = +∞ and hi = −∞, if there are none. */
  boxAround(points: Floats): Float32Array;
  /** The box moved by a vector of 3 floats, rounded outwards. */
  translated(box: Floats, by: Floats): Float32Array;
  /** The box with every face moved out by a distance of 0 or more, rounded outwards. */
  inflated(box: Floats, by: number): Float32Array;
  /** A large box inside the convex hull of 4 to 32 points. No coordinate is rounded outwards. */
  inscribedBox(corners: Floats): Float32Array;
  /**
   * The view factor from one flat convex polygon to another with nothing between them, from 0 to 1. Each polygon has
   * 3 to 8 corners of 3 floats, counterclockwise as seen from the front. The part of a polygon that is behind the plane
   * of the other does not count.
   */
  viewFactor(from: Floats, to: Floats): number;
  /**
   * Joins solid boxes into larger ones that cover the same space: pieces of a wall that share a face become one box.
   * Boxes of the result may overlap.
   */
  mergedBoxes(solids: Floats): Float32Array;
  /**
   * The planes of a view-projection matrix, up to 6 of 4 floats each, with normals outwards, for cutting shafts to the
   * view: `between(a, b, {planes: viewPlanes(matrix, depth)})`. The matrix is as for `frustum()`.
   */
  viewPlanes(matrix: Floats, depth: ClipDepth): Float32Array;

  /**
   * Makes a checked copy of boxes; queries test them one after another. 6 floats each: lo x, y, z, hi x, y, z; lo ≤ hi.
   */
  boxStream(boxes: Floats): BoxStream;
  /** Makes a tree of boxes, whose queries take time that grows with the number of results. O(n log n). */
  boxTree(boxes: Floats): BoxTree;
  /** Makes a stream of spheres. 4 floats each: centre x, y, z, radius ≥ 0. */
  sphereStream(spheres: Floats): SphereStream;
  /** Makes a tree of spheres. */
  sphereTree(spheres: Floats): SphereTree;
  /** Makes a stream of triangles: 9 floats each, or vertices of 3 floats and 3 indices per triangle. */
  triangleStream(triangles: Floats, indices?: ArrayLike<number>): TriangleStream;
  /** Makes a tree of triangles. */
  triangleTree(triangles: Floats, indices?: ArrayLike<number>): TriangleTree;

  /**
   * Makes an empty tree of boxes that are inserted, erased and moved. A commit re-sorts up to `sortedPerChange` boxes
   * per change, 2 by default, so that queries stay fast.
   */
  dynamicBoxTree(options?: {sortedPerChange?: number}): DynamicBoxTree;
  /** The same for spheres. */
  dynamicSphereTree(options?: {sortedPerChange?: number}): DynamicSphereTree;

  /**
   * Makes shafts. Shaft i is between box i of `a` and box i of `b`; one of the two may be a single box for all shafts.
   * With `pairs`, shaft i is between box pairs[2 i] of `a` and box pairs[2 i + 1] of `b`.
   */
  between(a: Floats, b: Floats, options?: FormOptions & {
    pairs?: ArrayLike<number>, planesA?: Floats, planesB?: Floats,
  }): Shafts;
  /**
   * Makes the volumes that bodies sweep, each by its displacement of 3 floats. A single body, or a single displacement,
   * may be for all.
   */
  swept(bodies: Floats, displacements: Floats, options?: FormOptions & {planesBodies?: Floats}): Shafts;
  /** The same for bodies that move without end, in directions of 3 floats. */
  sweptInfinite(bodies: Floats, directions: Floats, options?: FormOptions & {planesBodies?: Floats}): Shafts;
  /**
   * Makes shadows: shaft i holds all points that occluder i can shadow from light i; the two must be apart. A shadow
   * ends at `reach` times the distance of the occluder, where `reach` is 1 or more; without `reach`, it has no end.
   * Pairs are as for `between()`.
   */
  shadow(lights: Floats, occluders: Floats, options?: FormOptions & {
    pairs?: ArrayLike<number>, reach?: number, planesLights?: Floats, planesOccluders?: Floats,
  }): Shafts;
  /** Copies all shafts of these parts into one array, in order, so that one query covers all of them. */
  concatenate(parts: readonly Volume[]): Shafts;
  /**
   * Makes the convex hull of points, extended without end along directions; at most 32 of both together, 3 floats each.
   */
  hull(points: Floats, directions?: Floats, options?: {test?: HullTest}): Hull;
  /**
   * Makes the convex hull of two ends, such as polygons or turned boxes. Each end is the convex hull of its corners, 3
   * floats each. Queries about occluders accept this hull: they find solids that hide one end from the other.
   */
  betweenPolygons(p: Floats, q: Floats, options?: {test?: HullTest}): Hull;
  /**
   * Makes the hull of the volume that a view-projection matrix shows. The matrix has 16 floats in the order of WebGL
   * and three.js, column after column. Without a far plane, the hull has no end.
   */
  frustum(matrix: Floats, depth: ClipDepth, options?: {test?: HullTest}): Hull;
  /** Makes the hull of all points that can cast a shadow into the view from a light at a point of 3 floats. */
  casters(view: Hull, light: Floats): Hull;
  /** The same for a sun in a direction of 3 floats. */
  castersTowards(view: Hull, sun: Floats): Hull;

  /**
   * Determines which pairs of patches see each other, and collects all answers. Time grows with the number of undecided
   * pairs.
   */
  visibility(scene: VisibilityScene): Visibility;
  /**
   * The lit fraction of each patch for each light, from 0 to 1: the share of the patch that no occluder hides from the
   * light. Element i · (lights.length / 3) + j is for patch i and light j. If half of a patch is in the sun, 64 rays
   * find this fraction to within 0.02.
   */
  litFractions(scene: LitScene): Float32Array;
  /** The number of pairs with each answer. Takes no memory per pair. */
  countVisibility(scene: Omit<VisibilityScene, 'candidates' | keyof RayOptions>): Record<Sight, number>;
  /**
   * The view factors of every two patches, which radiate from their front: a sparse matrix in rows. Patches are flat:
   * polygons given by `corners`, or flat boxes with planes. Clear pairs have `viewFactor()`. Undecided pairs have
   * `viewFactor()` times the visible part, which rays estimate.
   */
  viewFactors(scene: ViewFactorScene): ViewFactors;

  /** The families of answers that have a hash on record: docs/hashes.md. */
  readonly hashFamilies: readonly HashFamily[];
  /**
   * Answers a million cases of a family in one way, or with `quick` the first 10,000 or more of them. Returns the hash
   * of the answers and the hash on record, 16 hexadecimal digits each. Takes seconds, or with `quick` about 10 ms.
   */
  hash(family: string, way: string, options?: {quick?: boolean}): {hash: string, record: string};
}

/**
 * Options of calls that form shafts. A plane is a half-space that bounds must also meet to be kept, 4 floats: normal x,
 * y, z, which points out, and offset; the inside is x nx + y ny + z nz ≤ offset. `planes` cut all shafts. `planesA` and
 * similar options belong to boxes, and cut the shafts of these boxes: the same number of planes for each box, those of
 * box 0 first. A shaft has at most 16 planes.
 */
export interface FormOptions {
  planes?: Floats;
  /** 'closed' by default. */
  contact?: Contact;
}

/** Queries of one kind about generated cases. */
export interface HashFamily {
  readonly name: string;
  /** The query. */
  readonly what: string;
  /** The ways to answer it, all of which give the same hash: 'slab form', 'plane form', 'many shafts'. */
  readonly ways: readonly string[];
}

/** An object that holds memory of the module. */
export interface Held {
  /** Frees the memory. The object cannot be used afterwards. */
  free(): void;
}

/** A volume: an array of shafts, or a convex hull. */
export interface Volume extends Held {
  /**
   * The answer for one bound: 6 floats of a box, 4 of a sphere or 9 of a triangle. The bound is not checked; a bound
   * with a NaN is never inside. For arrays of shafts, `at` is the position of the shaft, by default the first.
   */
  classify(bound: Floats, options?: {at?: number, triangleTest?: TriangleTest}): Answer;
  /** Whether the volume keeps one bound: whether the bound is not outside. */
  keeps(bound: Floats, options?: {at?: number, triangleTest?: TriangleTest}): boolean;
}

/** A convex hull. It can be used wherever one shaft can. */
export interface Hull extends Volume {
  /** 3 floats each, as they were given. */
  readonly points: Float32Array;
  readonly directions: Float32Array;
}

/** An array of shafts. Queries about one shaft use the first shaft, or the shaft whose position is the option `at`. */
export interface Shafts extends Volume {
  readonly length: number;
  /** Describes one shaft. */
  describe(options?: {at?: number}): ShaftInfo;
  /**
   * The planes that join the boxes of a shaft, in the order in which they are tested: 4 floats each, the normal, which
   * points out, and the offset. For shafts between two boxes.
   */
  joiningPlanes(options?: {at?: number}): Float32Array;
  /**
   * Chooses for all shafts whether bounds that only touch them are kept. For a hull, choose the contact of
   * `concatenate([hull])`.
   */
  setContact(contact: Contact): void;
  /**
   * Computes the joining planes of all shafts, which some queries would otherwise compute each time. This pays off for
   * shafts of several queries about bounds that are inside, or about spheres.
   */
  complete(): void;
  /** Whether one solid box hides one end of a shaft from the other. For shafts between two boxes or polygons. */
  occludedByBox(solid: Floats, options?: {at?: number}): boolean;
  /**
   * Whether a convex polygon, such as a wall at any angle, hides one end of a shaft from the other. 3 floats per
   * corner; three corners or more, in order, either way round.
   */
  occludedByPolygon(corners: Floats, options?: {at?: number}): boolean;
}

/** The state of one shaft of an array. */
export interface ShaftInfo {
  /**
   * The boxes where the shaft begins and ends, 6 floats each, as given; the end of a moving box is rounded to nearest.
   */
  readonly a: Float32Array;
  readonly b: Float32Array;
  readonly contact: Contact;
  /** Whether the joining planes are computed. */
  readonly hasPlanes: boolean;
  /**
   * Whether it is a convex hull, which `concatenate()` put into the array; a and b are then the box around the hull.
   */
  readonly isHull: boolean;
}

/** How triangles are tested: exactly, or by the box around their vertices. */
export type TriangleTest = 'exact' | 'vertices';

/**
 * The options of a query. They are the same for all bounds, in streams and in trees. The library refuses an option that
 * does not apply to the query or the bounds. The message has its name in C++: 'query.layer_mask' for `layerMask`.
 */
export interface QueryOptions {
  /** Leaves these bounds out, by index: for example, a moving body itself. */
  exclude?: ArrayLike<number>;
  /** Leaves bound i out if bit i % 32 of word i / 32 is set: bits as `cull()` returns them. */
  excludeMask?: ArrayLike<number>;
  /**
   * Leaves out every bound that is in none of these layers. A mask has 32 bits, as an integer of 0 or more:
   * `(1 << 31) >>> 0` for the last layer. One mask for all shafts, or an array with one mask per shaft. The bounds must
   * have layers: `setLayers()`.
   */
  layerMask?: number | ArrayLike<number>;
  /**
   * Stops after this many results per shaft, the first ones; 1 or more. For `count`, `list`, `listOccluders`, and their
   * forms for many shafts.
   */
  limit?: number;
  /** Tests only these bounds, by index; lists keep their order. Not for queries about solids. */
  only?: ArrayLike<number>;
  /**
   * Leaves out bounds that the moving box overlaps at the start, for `firstContact` and `firstContactMany`. With closed
   * contact, these are all bounds that touch the box; with open contact, those that reach into it, so a wall beside the
   * box still stops it.
   */
  skipOverlapping?: boolean;
  /** 'exact' by default. Not for boxes and spheres. */
  triangleTest?: TriangleTest;
}

/** Options of queries about one shaft. */
export interface AskOptions extends QueryOptions {
  /** The position of the shaft in an array; the first by default. */
  at?: number;
}

/** Options of queries about all shafts of an array. */
export interface AskManyOptions extends QueryOptions {
  /**
   * Bounds to leave out for each shaft, for example the two objects at its ends: the same number of indices for each
   * shaft, row after row.
   */
  excludeEach?: ArrayLike<number>;
}

/** Lists of indices, one per shaft: list s is indices[offsets[s]] to before indices[offsets[s + 1]]. */
export interface Lists {
  /** One number more than there are shafts. */
  readonly offsets: Float64Array;
  readonly indices: Uint32Array;
}

/** The bound that a moving box reaches first. */
export interface FirstContact {
  readonly index: number;
  /** From 0 at the start of the movement to 1 at its end, rounded down. */
  readonly time: number;
  /**
   * The normal of contact: x, y and z of unit length, from the bound towards the moving box. If the bound is a box, one
   * of ±x, ±y and ±z. Zeros if the two overlap at the start, or touch at the start without the box moving into the
   * bound.
   */
  readonly normal: readonly [number, number, number];
}

/**
 * Bounds of all kinds: their queries and their layers. Lists ascend; lists of trees have the order of the tree.
 *
 * Queries whose names end in `Many` are about all shafts of an array. Element s, row s or list s of the result is the
 * answer for shaft s: the same answer as that of the query about one shaft with `at: s`.
 */
export interface Bounds extends Held {
  readonly length: number;
  readonly kind: 'boxes' | 'spheres' | 'triangles';
  /** The memory of the module that it holds, in bytes. */
  readonly memoryBytes: number;
  /** A copy, layers included. */
  copy(): this;
  /** Bit i % 32 of word i / 32 is set if the shaft keeps bound i: if the bound is not outside. */
  cull(shaft: Volume, options?: Omit<AskOptions, 'limit'>): Uint32Array;
  /** One row of bits per shaft, as `cull()` returns it. */
  cullMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): Uint32Array[];
  /** Bits of the bounds that the shaft keeps, and of those that are inside entirely. */
  classify(shaft: Volume, options?: Omit<AskOptions, 'limit'>): {kept: Uint32Array, inside: Uint32Array};
  /** One row of bits per shaft, for both. */
  classifyMany(shafts: Shafts,
               options?: Omit<AskManyOptions, 'limit'>): {kept: Uint32Array[], inside: Uint32Array[]};
  /** How many bounds the shaft keeps; with `limit`, at most that many, and the query stops early. */
  count(shaft: Volume, options?: AskOptions): number;
  countMany(shafts: Shafts, options?: AskManyOptions): Float64Array;
  /** How many bounds overlap the shaft, and how many are inside entirely. */
  countClassified(shaft: Volume, options?: Omit<AskOptions, 'limit'>): {overlap: number, inside: number};
  countClassifiedMany(shafts: Shafts,
                      options?: Omit<AskManyOptions, 'limit'>): {overlap: Float64Array, inside: Float64Array};
  /** The indices of the bounds that the shaft keeps; with `limit`, the first of them. */
  list(shaft: Volume, options?: AskOptions): Uint32Array;
  listMany(shafts: Shafts, options?: AskManyOptions): Lists;
  /** Indices of the bounds that overlap the shaft, and of those that are inside entirely. */
  listClassified(shaft: Volume, options?: Omit<AskOptions, 'limit'>): {overlap: Uint32Array, inside: Uint32Array};
  listClassifiedMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): {overlap: Lists, inside: Lists};
  /** Whether the shaft keeps any bound. */
  any(shaft: Volume, options?: Omit<AskOptions, 'limit'>): boolean;
  /** Bit s % 32 of word s / 32 is the answer for shaft s. */
  anyMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): Uint32Array;
  /**
   * Puts all bounds into layers, for the option `layerMask`: bit l of layers[i] is set if bound i is in layer l. One
   * integer of 32 bits, 0 or more, per bound. Replaces all earlier layers. O(n). A tree of triangles has no layers, and
   * refuses this call.
   */
  setLayers(layers: ArrayLike<number>): void;
  /**
   * Puts bound indices[i] into layers[i]. The bounds must have layers. If an index occurs twice, the last entry counts.
   */
  setLayersOf(indices: ArrayLike<number>, layers: ArrayLike<number>): void;
  /** Removes all layers. */
  clearLayers(): void;
}

/** Triangles. A triangle is inside if its three vertices are. */
export interface TriangleBounds extends Bounds {}

/** Spheres and boxes, which also have queries about moving bodies. */
export interface SphereBounds extends Bounds {
  /** The bound that the moving box of the shaft reaches first, and the time. */
  firstContact(shaft: Shafts, options?: Omit<AskOptions, 'limit'>): FirstContact | undefined;
  firstContactMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): (FirstContact | undefined)[];
  /** The times at which that box reaches these bounds, rounded down; +∞ if it never does. */
  entryTimes(shaft: Shafts, indices: ArrayLike<number>, options?: {at?: number}): Float32Array;
}

/** Boxes, which also have queries about solids. */
export interface BoxBounds extends SphereBounds {
  /** Whether one of the solids alone hides one end of the shaft from the other. For shafts between two boxes or polygons. */
  occluded(shaft: Volume, options?: Omit<AskOptions, 'limit' | 'only'>): boolean;
  /** Bit s % 32 of word s / 32 is the answer for shaft s. */
  occludedMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit' | 'only'>): Uint32Array;
  /**
   * A solid that alone hides one end of the shaft from the other: in a stream the solid with the lowest index, in a
   * tree the first solid in the order of the tree.
   */
  findOccluder(shaft: Volume, options?: Omit<AskOptions, 'limit' | 'only'>): number | undefined;
  /** All solids that alone hide one end of the shaft from the other; with `limit`, the first of them. */
  listOccluders(shaft: Volume, options?: Omit<AskOptions, 'only'>): Uint32Array;
  listOccludersMany(shafts: Shafts, options?: Omit<AskManyOptions, 'only'>): Lists;
}

export interface BoxStream extends BoxBounds {
  /** Replaces the bounds from `first` on, by default 0, with the given bounds. O(number of given bounds). */
  update(boxes: Floats, options?: {first?: number}): void;
}

export interface SphereStream extends SphereBounds {
  /** As for a BoxStream. */
  update(spheres: Floats, options?: {first?: number}): void;
}

export interface TriangleStream extends TriangleBounds {
  /** As for a BoxStream. With `indices`, the triangles are given as for `triangleStream()`. */
  update(triangles: Floats, options?: {first?: number, indices?: ArrayLike<number>}): void;
}

/** Bounds that a tree sorts by space. */
export interface Tree {
  /** The indices of the bounds in the order of the tree, neighbours in space together. */
  readonly order: Uint32Array;
  /** The box around all bounds; the empty box, lo = +∞ and hi = −∞, if the tree needs `refit()`. */
  readonly box: Float32Array;
}

/** With `indices`, triangles are given as for `triangleTree()`. */
export interface TriangleTree extends TriangleBounds, Omit<MovingTree, 'update' | 'updateSome'> {
  update(triangles: Floats, options?: {indices?: ArrayLike<number>}): void;
  updateSome(indices: ArrayLike<number>, triangles: Floats, options?: {indices?: ArrayLike<number>}): void;
}

/** A tree whose bounds may move. */
export interface MovingTree extends Tree {
  /** Gives every bound a new value, and refits. O(n). */
  update(bounds: Floats): void;
  /**
   * Gives bound indices[i] the value at i of `bounds`. Queries then fail with 'needs refit' until `refit()`. If an
   * index occurs twice, the last value counts. O(number of given bounds), except for the first call, which is O(n).
   */
  updateSome(indices: ArrayLike<number>, bounds: Floats): void;
  /** Fits the nodes to bounds that were updated by index. O(updated), at most O(n). */
  refit(): void;
  readonly needsRefit: boolean;
  /** How much larger the nodes have become since the tree was built, 1 at first; at 2 or 3 `rebuild()` pays off. */
  readonly sahRatio: number;
  /** Sorts the bounds again as they are now. Indices stay, `order` changes. */
  rebuild(): void;
  /** Gives the bounds new indices, in the order of the tree: bound `order[p]` becomes bound p. O(n). */
  reorder(): void;
}

export interface SphereTree extends SphereBounds, MovingTree {}

export interface BoxTree extends BoxBounds, MovingTree {}

/** The state of a dynamic tree after one commit. It never changes, whatever happens to the tree. */
export interface Snapshot {
  /** The box around all bounds; the empty box if there are none. */
  readonly box: Float32Array;
}
export interface BoxTreeSnapshot extends BoxBounds, Snapshot {}
export interface SphereTreeSnapshot extends SphereBounds, Snapshot {}

/**
 * Bounds that are inserted, erased and moved. Changes wait for `commit()`, and queries see the last commit. An id stays
 * valid until its bound is erased, and never denotes another bound. Queries return indices: `Number(id & 0xffffffffn)`.
 * `length` is one more than the greatest index; no shaft keeps an index without a bound. Floats are as in streams.
 */
export interface DynamicTree {
  /** The box around all bounds of the last commit. */
  readonly box: Float32Array;
  /** Inserts bounds, and returns their ids. Bound i is in layers[i]; without `layers`, it is in all layers. */
  insert(bounds: Floats, layers?: ArrayLike<number>): BigUint64Array;
  /** Erases bounds. An id that has no bound, or occurs twice, is an error. */
  erase(ids: Ids): void;
  /** Gives bound ids[i] the value at i of `bounds`. */
  move(ids: Ids, bounds: Floats): void;
  /** Moves bound ids[i] by the vector at i, 3 floats each. */
  moveBy(ids: Ids, displacements: Floats): void;
  /** Puts bounds into other layers, by index. Queries see them after the next commit. */
  setLayersOf(indices: ArrayLike<number>, layers: ArrayLike<number>): void;
  /** Makes all changes visible. O(changes), plus the upkeep. */
  commit(): void;
  /** Makes all changes visible, and sorts all bounds again. */
  rebuild(): void;
  /** The values of bounds, with all changes: 6 floats of a box, 4 of a sphere. */
  values(ids: Ids): Float32Array;
  /**
   * The number of bounds, with all changes, and the state of the upkeep: the number of blocks of up to 4,096 bounds,
   * the growth of nodes since bounds were sorted, the number of bounds that wait to be sorted again, and the number of
   * bounds that the last commit sorted.
   */
  readonly upkeep: {boundCount: number, blocks: number, sahRatio: number, waiting: number, sortedLast: number};
}

/** Ids of bounds, as `insert()` returns them. */
export type Ids = BigUint64Array | readonly bigint[];

export interface DynamicBoxTree extends Omit<BoxBounds, 'copy' | 'setLayers' | 'clearLayers'>, DynamicTree {
  /** The state of the last commit. O(1). */
  snapshot(): BoxTreeSnapshot;
}

export interface DynamicSphereTree extends Omit<SphereBounds, 'copy' | 'setLayers' | 'clearLayers'>, DynamicTree {
  /** The state of the last commit. O(1). */
  snapshot(): SphereTreeSnapshot;
}

/**
 * Patches, and the objects between them. Floats are as in streams. A plane has 4 floats: the normal, which points where
 * the patch faces, and the offset.
 */
export interface VisibilityScene extends RayOptions {
  /** Boxes around patches. */
  patches?: Floats;
  /** A plane per patch. A patch sees points in front of its plane, x nx + y ny + z nz > offset. */
  planes?: Floats;
  /**
   * Patches that are convex polygons, in place of `patches` and `planes`: an array of corners per patch, 3 to 8 corners
   * of 3 floats. A patch faces the side from which its corners run counter-clockwise.
   */
  corners?: readonly Floats[];
  /**
   * 'both' if patches of `corners` and `cornersB` are seen from both sides: then two patches in one plane face away.
   * 'front' by default.
   */
  sides?: 'front' | 'both';
  /** The other set. Without it, every two patches of the one set are one pair. */
  patchesB?: Floats;
  planesB?: Floats;
  cornersB?: readonly Floats[];
  /**
   * Boxes around things that may hide something: occluders 0 to n − 1. The occluders of the next options are numbered
   * after them.
   */
  boxes?: Floats;
  /** Boxes that are solid. */
  solids?: Floats;
  /** Solid convex hulls: an array of corners per hull, 4 or more corners of 3 floats. */
  hulls?: readonly Floats[];
  /** Flat convex polygons: an array of corners in order per polygon, 3 or more corners of 3 floats. */
  polygons?: readonly Floats[];
  /** Triangles of 9 floats, in groups of neighbours that the library makes. */
  triangles?: Floats;
  /** Whether occluders that only touch a shaft stand between patches; with 'open', the default, they do not. */
  contact?: Contact;
  /** How far in front of a plane a point may be and still count as behind it; 0 by default. */
  tolerance?: number;
  /**
   * Whether to find solids in the triangles: bodies, and flat polygons. Bodies may be open on or beyond one face of the
   * box around the patches, as buildings without a bottom are on level ground. Found solids are not occluders, except
   * for bodies that are upright boxes: these follow the groups of triangles, and their own triangles are in no group.
   */
  findSolids?: boolean;
  /** Whether a solid that a patch reaches into may make a pair occluded; true by default. */
  solidsAroundEnds?: boolean;
  /** Whether undecided pairs come with candidates; true by default. */
  candidates?: boolean;
  /** Limit in bytes for answers in progress, 1 MB or more; 256 MB by default. */
  memory?: number;
  /**
   * Divides all pairs into `parts` parts (1 by default), and answers part `part` (0 by default), 0 to parts - 1. Each
   * pair is in exactly one part.
   */
  part?: number;
  parts?: number;
}

/** Rays from points of one patch to points of another. */
export interface RayOptions {
  /** The largest number of rays per undecided pair, 1 to 65536; a multiple of 16 is cast. */
  rays?: number;
  /**
   * A pair gets fewer rays if the estimated standard error is at most this. With 0, the default of `visibility`, it
   * gets all rays.
   */
  error?: number;
  /** The points where rays start and end depend only on the seed and the pair; 1 by default. */
  seed?: number;
}

/** Patches, the objects between them, and lights. */
export interface LitScene extends RayOptions,
    Pick<VisibilityScene, 'patches' | 'planes' | 'corners' | 'sides' | 'boxes' | 'solids' | 'hulls' | 'polygons' |
                          'triangles' | 'findSolids' | 'tolerance'> {
  /** Directions to lights that are infinitely far away, such as the sun: 3 floats each. */
  lights: Floats;
}

/**
 * Patches that radiate, the objects between them, and options: by default at most 4096 `rays`, and an `error` of 1e-5.
 */
export interface ViewFactorScene extends RayOptions,
    Pick<VisibilityScene, 'patches' | 'planes' | 'corners' | 'boxes' | 'solids' | 'hulls' | 'polygons' | 'triangles' |
                          'findSolids' | 'tolerance' | 'memory' | 'part' | 'parts'> {
  /** Pairs both of whose factors are below this are left out of the matrix; 0 by default. */
  least?: number;
  /** Whether rows are scaled to sum to 1, as those of an enclosure do; false by default. */
  closeRows?: boolean;
}

/**
 * View factors in rows (CSR): the factors from patch i are factor[k] to patch column[k], for k from first[i] to before
 * first[i + 1]. Columns ascend.
 */
export interface ViewFactors {
  readonly first: Float64Array;
  readonly column: Uint32Array;
  readonly factor: Float64Array;
  /** The area of each patch. */
  readonly area: Float64Array;
  /** The sum of each row, left-out factors included; 1 − sum is the share that meets no patch: the sky. */
  readonly sum: Float64Array;
  /** The estimated standard error of each sum. */
  readonly error: Float64Array;
  /** The part of each sum that is below `least`. */
  readonly leftOut: Float64Array;
  /** The number of pairs with each answer. */
  readonly counts: Readonly<Record<Sight, number>>;
  /** The factor from patch i to patch j; 0 if the matrix has none. */
  at(i: number, j: number): number;
}

/** The answers for all pairs of patches. */
export interface Visibility {
  /** The number of pairs with each answer. */
  readonly counts: Readonly<Record<Sight, number>>;
  /**
   * Decided pairs, in blocks: all pairs of a patch of one run and a patch of another have the same answer. 4 numbers
   * each: position and length of the run in `orderA`, position and length of the run in `orderB`.
   */
  readonly blocks: Uint32Array;
  /** The answer of each block. */
  readonly sights: readonly Sight[];
  readonly orderA: Uint32Array;
  readonly orderB: Uint32Array;
  /** Undecided pairs: two patches each. */
  readonly undecided: Uint32Array;
  /**
   * The occluders that reach between the patches of pair p are candidates[offsets[p]] to before
   * candidates[offsets[p + 1]]. There are none for any pair if the scene requests no candidates.
   */
  readonly offsets: Float64Array;
  readonly candidates: Uint32Array;
  /**
   * The visible fraction of each undecided pair, from 0 to 1, if the scene requests `rays`: the share of segments that
   * no candidate blocks, among those that leave and arrive in front.
   */
  readonly fractions?: Float32Array;
  /** The triangles of each occluder, by their positions among the triangles of the scene; empty for other occluders. */
  readonly triangles: readonly Uint32Array[];
  /** All pairs with one answer, two patches each; for one set with itself, each pair once. */
  pairs(sight: Sight): Uint32Array;
  /**
   * A row of bits per patch of the first set: bit j % 32 of word j / 32 of row i is set if this is the answer for
   * patches i and j. For one set with itself, both bits of a pair are set.
   */
  bits(sight: Sight): Uint32Array[];
}
