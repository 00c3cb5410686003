// SPDX-License-Identifier: MIT
/**
 * Shaft culling in WebAssembly: what can stand between two boxes, what a moving box hits, what lies in a shadow or in
 * view. Answers about boxes and triangles are those of real arithmetic for the floats given; docs/exactness.md tells
 * how spheres are answered. All are the same bits on every machine.
 *
 *     import {load} from 'shaftcull';
 *     const shaftcull = await load();
 *     const tree = shaftcull.boxTree(boxes);            // 6 floats for each box: lo x, y, z, hi x, y, z
 *     const shaft = shaftcull.between(lamp, table);
 *     for (const i of tree.list(shaft)) console.log(`box ${i} may stand between`);
 *
 * Numbers. All floats are float32. Arrays of numbers are taken if each is a float32 exactly; otherwise a call throws a
 * TypeError, since nothing is rounded silently: `origin().boxesAround()` makes float32 boxes that contain those of doubles.
 *
 * Errors. What the library refuses is a `ShaftcullError`, which says what is wrong, where, and what would be right.
 * Arguments of another type or number, and objects that were freed or are of another module, are a `TypeError`, and a
 * position that is none a `RangeError`. Objects are as they were.
 *
 * Memory. Objects hold memory of the module until `free()`, or until they are garbage. What a call returns is a copy.
 * The module keeps as much memory for results as the largest bits, counts or list for one shaft took, up to twice that.
 * A call that the library refuses keeps memory: some KB, and of large arguments up to three times as much as they take.
 * The module has 4 GB at most; after 'out of memory' make a new one. It has no threads: a worker makes one of its own.
 */

/** Float32 values: a Float32Array, or numbers that each are a float32 exactly. */
export type Floats = Float32Array | readonly number[];

/** What becomes of bounds that touch a shaft without reaching into it: kept, or outside. */
export type Contact = 'closed' | 'open';

/** Which depths in clip space are in view: `zero_to_one` as in WebGPU, `minus_one_to_one` as in WebGL. */
export type ClipDepth = 'zero_to_one' | 'minus_one_to_one';

/**
 * How hulls cull boxes. `exact`: boxes are outside iff they have no point in common with the hull. `conservative`: iff
 * they are beyond one face of it, as in the usual test of a view by its planes. That is quicker, and keeps some boxes
 * beside edges and corners.
 */
export type HullTest = 'exact' | 'conservative';

/** The answer of a shaft for one bound. */
export type Answer = 'outside' | 'overlap' | 'inside';

/** What is said of a pair of patches. */
export type Sight = 'undecided' | 'clear' | 'occluded' | 'facing_away';

/** Why a call failed. */
export class ShaftcullError extends Error {
  /** 'invalid argument', 'bad bound', 'needs refit', 'out of memory' or 'internal error'. */
  readonly status: string;
  /** Of a bad bound its position in the array that it came from, counted from 0. */
  readonly position: number | undefined;
}

/**
 * Instantiates the library: some 20 ms. Without an argument it takes `shaftcull.wasm` beside this script; with one that
 * file's bytes, a `WebAssembly.Module` of them, or their address: a `URL`, or a string, which is relative to the page
 * or, in Node.js, to the working directory.
 */
export function load(wasm?: string | object): Promise<Shaftcull>;

/**
 * A point of a world in doubles that coordinates are relative to. What is outside of the shaft between two boxes from
 * `boxesAround()` is so in the world, too. Calls refuse what is NaN when they get it, not here.
 */
export interface Origin {
  /** Where it is: x, y, z. */
  readonly at: Float64Array;
  /** The smallest boxes of floats that contain boxes of 6 doubles. */
  boxesAround(boxes: ArrayLike<number>): Float32Array;
  /** The largest boxes within: for solids, and for what is to contain others. The empty box where there is none. */
  boxesWithin(boxes: ArrayLike<number>): Float32Array;
  /** Spheres that contain spheres of 4 doubles: centres are rounded to nearest, and radii grow. */
  spheresAround(spheres: ArrayLike<number>): Float32Array;
  /** The nearest floats of points of 3 doubles: for vertices, and corners of patches. */
  nearest(points: ArrayLike<number>): Float32Array;
  /** Where points of 3 floats are in the world. */
  toWorld(points: Floats): Float64Array;
}

/** One instance of the library. */
export interface Shaftcull {
  /** As of the C++ library, '0.1.0' say. */
  readonly version: string;
  /** The names of all sets of instructions, slowest first: 'scalar' and 'portable128'. */
  readonly instructionSets: readonly string[];
  /** The one that calls use, the fastest at first. Answers do not depend on it. Throws for a name that is none. */
  instructionSet: string;

  /** A point of the world that coordinates are relative to: [0, 0, 0] unless given. Throws for one that is not finite. */
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
   * The view factor from one flat convex polygon to another with nothing between them, from 0 to 1. Each has 3 to 8 corners
   * of 3 floats, counterclockwise as seen from the front; what is behind the other's plane does not count.
   */
  viewFactor(from: Floats, to: Floats): number;
  /**
   * Solid boxes joined to larger ones, which cover the same space: pieces of a wall that share a face become one box.
   * Boxes of the result may overlap.
   */
  mergedBoxes(solids: Floats): Float32Array;
  /**
   * The planes of a view-projection matrix, up to 6 of 4 floats, normals outwards, to cut shafts to the view:
   * `between(a, b, {planes: viewPlanes(matrix, depth)})`. Matrices are those of `frustum()`.
   */
  viewPlanes(matrix: Floats, depth: ClipDepth): Float32Array;

  /** Boxes that are asked one after the other: a checked copy. 6 floats each: lo x, y, z, hi x, y, z; lo ≤ hi. */
  boxStream(boxes: Floats): BoxStream;
  /** Boxes under a tree, whose questions take what they find. O(n log n). */
  boxTree(boxes: Floats): BoxTree;
  /** Spheres that are asked one after the other. 4 floats each: centre x, y, z, radius ≥ 0. */
  sphereStream(spheres: Floats): SphereStream;
  /** Spheres under a tree. */
  sphereTree(spheres: Floats): SphereTree;
  /** Triangles that are asked one after the other: 9 floats each, or vertices of 3 floats and 3 indices each. */
  triangleStream(triangles: Floats, indices?: ArrayLike<number>): TriangleStream;
  /** Triangles under a tree. */
  triangleTree(triangles: Floats, indices?: ArrayLike<number>): TriangleTree;

  /**
   * A tree of boxes that are inserted, erased and moved, empty at first. A commit sorts up to `sortedPerChange` boxes
   * again for each change, 2 by default, so that queries stay fast.
   */
  dynamicBoxTree(options?: {sortedPerChange?: number}): DynamicBoxTree;
  /** The same of spheres. */
  dynamicSphereTree(options?: {sortedPerChange?: number}): DynamicSphereTree;

  /**
   * Shafts between box i of `a` and box i of `b`, one of which may be a single box for all; or, with `pairs`, between
   * box pairs[2 i] of `a` and box pairs[2 i + 1] of `b`.
   */
  between(a: Floats, b: Floats, options?: FormOptions & {
    pairs?: ArrayLike<number>, planesA?: Floats, planesB?: Floats,
  }): Shafts;
  /** The volumes that bodies sweep over, each by its displacement of 3 floats; one of either may be for all. */
  swept(bodies: Floats, displacements: Floats, options?: FormOptions & {planesBodies?: Floats}): Shafts;
  /** The same without end, in directions of 3 floats. */
  sweptInfinite(bodies: Floats, directions: Floats, options?: FormOptions & {planesBodies?: Floats}): Shafts;
  /**
   * All that occluder i can shadow from light i, which is apart from it: up to `reach` times its distance, 1 or more,
   * or without end. Pairs are as for `between()`.
   */
  shadow(lights: Floats, occluders: Floats, options?: FormOptions & {
    pairs?: ArrayLike<number>, reach?: number, planesLights?: Floats, planesOccluders?: Floats,
  }): Shafts;
  /**
   * Copies of all shafts of these parts, one behind the other, so that one query asks them all.
   */
  concatenate(parts: readonly Volume[]): Shafts;
  /** The convex hull of points, and of what lies from them along directions; at most 32 of both, 3 floats each. */
  hull(points: Floats, directions?: Floats, options?: {test?: HullTest}): Hull;
  /**
   * The convex hull of two ends: polygons, turned boxes or others, each the convex hull of its corners, 3 floats each.
   * Questions about occluders take it: what hides one end from the other.
   */
  betweenPolygons(p: Floats, q: Floats, options?: {test?: HullTest}): Hull;
  /**
   * What a view-projection matrix shows: 16 floats in the order of WebGL and three.js, column after column. Without a
   * far plane it has no end.
   */
  frustum(matrix: Floats, depth: ClipDepth, options?: {test?: HullTest}): Hull;
  /** What can cast a shadow into view by a light at a point of 3 floats. */
  casters(view: Hull, light: Floats): Hull;
  /** The same by a sun in a direction of 3 floats. */
  castersTowards(view: Hull, sun: Floats): Hull;

  /** Of all pairs of patches, which see each other. Takes what is undecided, and collects all answers. */
  visibility(scene: VisibilityScene): Visibility;
  /**
   * For each patch and each light, which share of the patch no occluder hides from the light, from 0 to 1: element
   * i · (lights.length / 3) + j is of patch i and light j. Half of a patch in the sun is found within 0.02 by 64 rays.
   */
  litFractions(scene: LitScene): Float32Array;
  /** How many pairs there are of each kind. Takes no memory per pair. */
  countVisibility(scene: Omit<VisibilityScene, 'candidates' | keyof RayOptions>): Record<Sight, number>;
  /**
   * View factors of each two patches, which radiate from their front: a sparse matrix in rows. Patches are flat, by
   * their `corners` or as flat boxes with planes. Pairs that are clear have `viewFactor()`, and undecided ones that times
   * the visible part, by rays.
   */
  viewFactors(scene: ViewFactorScene): ViewFactors;

  /** The families of answers that have a hash on record: docs/hashes.md. */
  readonly hashFamilies: readonly HashFamily[];
  /**
   * Answers a million cases of a family, or with `quick` the first 10,000 or more of them, in one way, and says their
   * hash and the one on record, 16 hexadecimal digits each. Takes seconds, a quick look some 10 ms.
   */
  hash(family: string, way: string, options?: {quick?: boolean}): {hash: string, record: string};
}

/**
 * Options of calls that form shafts. A plane is a half-space that bounds must also meet to be kept, 4 floats: normal x,
 * y, z, which points out, and offset; the inside is x nx + y ny + z nz ≤ offset. `planes` cut all shafts. `planesA` and
 * the like belong to boxes, and cut the shafts of these: as many for each box, those of box 0 first. A shaft has 16 at
 * most.
 */
export interface FormOptions {
  planes?: Floats;
  /** 'closed' by default. */
  contact?: Contact;
}

/** Questions of one kind about made-up cases. */
export interface HashFamily {
  readonly name: string;
  /** What is asked. */
  readonly what: string;
  /** Ways in which it is asked, all of which give the same hash: 'slab form', 'plane form', 'many shafts'. */
  readonly ways: readonly string[];
}

/** Memory of the module. */
export interface Held {
  /** Gives the memory back; the object can do nothing more. */
  free(): void;
}

/** A volume: an array of shafts, or a convex hull. */
export interface Volume extends Held {
  /**
   * The answer for one bound: 6 floats of a box, 4 of a sphere or 9 of a triangle. The bound is not checked; one with a
   * NaN is never inside. For arrays of shafts `at` names the shaft, the first by default.
   */
  classify(bound: Floats, options?: {at?: number, triangleTest?: TriangleTest}): Answer;
  /** Whether the volume keeps this one bound: whether the bound is not outside. */
  keeps(bound: Floats, options?: {at?: number, triangleTest?: TriangleTest}): boolean;
}

/** A convex hull: it goes wherever one shaft goes. */
export interface Hull extends Volume {
  /** 3 floats each, as they were given. */
  readonly points: Float32Array;
  readonly directions: Float32Array;
}

/** An array of shafts. Questions of one shaft take the first of them, or the one that their option `at` names. */
export interface Shafts extends Volume {
  readonly length: number;
  /** What one shaft is. */
  describe(options?: {at?: number}): ShaftInfo;
  /**
   * The planes that join the boxes of a shaft, in the order in which they are tested: 4 floats each, the normal, which
   * points out, and the offset. For shafts between two boxes.
   */
  joiningPlanes(options?: {at?: number}): Float32Array;
  /**
   * Chooses for all shafts whether bounds that only touch them are kept. Of a hull, choose it for
   * `concatenate([hull])`.
   */
  setContact(contact: Contact): void;
  /**
   * Computes the joining planes of all shafts, which otherwise some queries compute each time. It pays for shafts of
   * several queries about bounds that are inside, or about spheres.
   */
  complete(): void;
  /** Whether this one solid box hides one end of a shaft from the other. For shafts between two boxes. */
  occludedByBox(solid: Floats, options?: {at?: number}): boolean;
  /**
   * Whether a convex polygon does, a wall at any angle for example. 3 floats for each corner; three corners or more, in
   * order, either way round.
   */
  occludedByPolygon(corners: Floats, options?: {at?: number}): boolean;
}

/** The state of one shaft of an array. */
export interface ShaftInfo {
  /** Where it begins and ends, 6 floats each: the boxes as given; for a moving box the end is rounded to nearest. */
  readonly a: Float32Array;
  readonly b: Float32Array;
  readonly contact: Contact;
  /** Whether its joining planes are computed. */
  readonly hasPlanes: boolean;
  /** Whether it is a convex hull, which `concatenate()` put there; a and b are then the box around it. */
  readonly isHull: boolean;
}

/** How triangles are tested: exactly, or by the box around their vertices. */
export type TriangleTest = 'exact' | 'vertices';

/**
 * The options of a question. They are the same for all bounds, in streams and in trees. The library refuses an option
 * that means nothing to a question or to bounds. It tells the name in C++: 'query.layer_mask' for `layerMask`.
 */
export interface QueryOptions {
  /** Leaves these bounds out, by index: a moving body itself, say. */
  exclude?: ArrayLike<number>;
  /** Leaves bound i out if bit i % 32 of word i / 32 is set: bits as `cull()` returns them. */
  excludeMask?: ArrayLike<number>;
  /**
   * Leaves out every bound that is in none of these layers, 32 bits as an integer from 0 on: `(1 << 31) >>> 0` for the
   * last one. One mask for all shafts, or an array with one for each. The bounds must have layers: `setLayers()`.
   */
  layerMask?: number | ArrayLike<number>;
  /**
   * Stops at so many results per shaft, those that come first; 1 or more. For `count`, `list`, `listOccluders`, and
   * their forms for many shafts.
   */
  limit?: number;
  /** Asks only about these bounds, by index; lists keep their order. Not for queries about solids. */
  only?: ArrayLike<number>;
  /**
   * Leaves out bounds that the moving box overlaps at the start, for `firstContact` and `firstContactMany`: with closed
   * contact all that touch it, with open contact those that reach into it, so that a wall beside it still stops it.
   */
  skipOverlapping?: boolean;
  /** 'exact' by default. Not for boxes and spheres. */
  triangleTest?: TriangleTest;
}

/** Options of questions about one shaft. */
export interface AskOptions extends QueryOptions {
  /** Which shaft of an array is asked; the first if it is not said. */
  at?: number;
}

/** Options of questions about all shafts of an array. */
export interface AskManyOptions extends QueryOptions {
  /**
   * Leaves bounds of its own out for each shaft, its own two objects, say: as many indices for each shaft, one row
   * behind the other.
   */
  excludeEach?: ArrayLike<number>;
}

/** Lists of indices, one per shaft: list s is indices[offsets[s]] to before indices[offsets[s + 1]]. */
export interface Lists {
  /** One more than there are shafts. */
  readonly offsets: Float64Array;
  readonly indices: Uint32Array;
}

/** The bound that a moving box reaches first. */
export interface FirstContact {
  readonly index: number;
  /** From 0 at the start of the movement to 1 at its end, rounded down. */
  readonly time: number;
  /**
   * Of contact: x, y and z of unit length, from the bound towards the moving box. For a box one of ±x, ±y and ±z. Zeros
   * if the two overlap at the start, or touch there without the box moving into the bound.
   */
  readonly normal: readonly [number, number, number];
}

/**
 * All bounds: what they can be asked, and their layers. Lists ascend; those of trees have the order of the tree.
 *
 * Queries whose names end in `Many` ask all shafts of an array. Element s, row s or list s of their result is the
 * answer for shaft s, the same as the query about one shaft has for `at: s`.
 */
export interface Bounds extends Held {
  readonly length: number;
  readonly kind: 'boxes' | 'spheres' | 'triangles';
  /** Bytes of the module that it holds. */
  readonly memoryBytes: number;
  /** A copy, layers included. */
  copy(): this;
  /** Bit i % 32 of word i / 32 says whether the shaft keeps bound i: whether it is not outside. */
  cull(shaft: Volume, options?: Omit<AskOptions, 'limit'>): Uint32Array;
  /** One row of bits per shaft, as `cull()` returns it. */
  cullMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): Uint32Array[];
  /** Bits of the bounds that the shaft keeps, and of those that are inside entirely. */
  classify(shaft: Volume, options?: Omit<AskOptions, 'limit'>): {kept: Uint32Array, inside: Uint32Array};
  /** One row of bits per shaft, for both. */
  classifyMany(shafts: Shafts,
               options?: Omit<AskManyOptions, 'limit'>): {kept: Uint32Array[], inside: Uint32Array[]};
  /** How many bounds the shaft keeps; with `limit` that many at most, and then it stops early. */
  count(shaft: Volume, options?: AskOptions): number;
  countMany(shafts: Shafts, options?: AskManyOptions): Float64Array;
  /** How many bounds overlap the shaft, and how many are inside entirely. */
  countClassified(shaft: Volume, options?: Omit<AskOptions, 'limit'>): {overlap: number, inside: number};
  countClassifiedMany(shafts: Shafts,
                      options?: Omit<AskManyOptions, 'limit'>): {overlap: Float64Array, inside: Float64Array};
  /** Which bounds the shaft keeps; with `limit` the first of them. */
  list(shaft: Volume, options?: AskOptions): Uint32Array;
  listMany(shafts: Shafts, options?: AskManyOptions): Lists;
  /** Indices of the bounds that overlap the shaft, and of those that are inside entirely. */
  listClassified(shaft: Volume, options?: Omit<AskOptions, 'limit'>): {overlap: Uint32Array, inside: Uint32Array};
  listClassifiedMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): {overlap: Lists, inside: Lists};
  /** Whether the shaft keeps any bound. */
  any(shaft: Volume, options?: Omit<AskOptions, 'limit'>): boolean;
  /** Bit s % 32 of word s / 32 says it of shaft s. */
  anyMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): Uint32Array;
  /**
   * Puts all bounds into layers, for the option `layerMask`: bit l of layers[i] says that bound i is in layer l. One
   * integer of 32 bits from 0 on for each bound. Replaces the layers that there were. O(n). A tree of triangles has
   * none, and refuses this.
   */
  setLayers(layers: ArrayLike<number>): void;
  /** Puts bound indices[i] into layers[i]. There must be layers. The last one counts of an index that comes twice. */
  setLayersOf(indices: ArrayLike<number>, layers: ArrayLike<number>): void;
  /** Forgets the layers. */
  clearLayers(): void;
}

/** Triangles. One is inside if its three vertices are. */
export interface TriangleBounds extends Bounds {}

/** Spheres and boxes can be reached by bodies that move, too. */
export interface SphereBounds extends Bounds {
  /** The bound that the moving box of the shaft reaches first, and when. */
  firstContact(shaft: Shafts, options?: Omit<AskOptions, 'limit'>): FirstContact | undefined;
  firstContactMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit'>): (FirstContact | undefined)[];
  /** When that box reaches each of these bounds, +∞ if never. Times are rounded down. */
  entryTimes(shaft: Shafts, indices: ArrayLike<number>, options?: {at?: number}): Float32Array;
}

/** Boxes can be asked as solids, too. */
export interface BoxBounds extends SphereBounds {
  /** Whether one of the solids alone hides one end of the shaft from the other. For shafts between two boxes. */
  occluded(shaft: Volume, options?: Omit<AskOptions, 'limit' | 'only'>): boolean;
  /** Bit s % 32 of word s / 32 says it of shaft s. */
  occludedMany(shafts: Shafts, options?: Omit<AskManyOptions, 'limit' | 'only'>): Uint32Array;
  /** One such solid: in a stream the one of lowest index, in a tree the first in its order. */
  findOccluder(shaft: Volume, options?: Omit<AskOptions, 'limit' | 'only'>): number | undefined;
  /** All such solids; with `limit` the first of them. */
  listOccluders(shaft: Volume, options?: Omit<AskOptions, 'only'>): Uint32Array;
  listOccludersMany(shafts: Shafts, options?: Omit<AskManyOptions, 'only'>): Lists;
}

export interface BoxStream extends BoxBounds {
  /** Replaces bounds from `first` on, or from 0, as many as are given. O(bounds given). */
  update(boxes: Floats, options?: {first?: number}): void;
}

export interface SphereStream extends SphereBounds {
  /** As of a BoxStream. */
  update(spheres: Floats, options?: {first?: number}): void;
}

export interface TriangleStream extends TriangleBounds {
  /** As of a BoxStream; with `indices` the triangles are given as for `triangleStream()`. */
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
   * Gives bound indices[i] the value at i of `bounds`. Queries then fail with 'needs refit' until `refit()`. The last
   * value counts of an index that comes twice. O(bounds given), except for the first call, which is O(n).
   */
  updateSome(indices: ArrayLike<number>, bounds: Floats): void;
  /** Fits the nodes to bounds that were updated by index. O(updated), at most O(n). */
  refit(): void;
  readonly needsRefit: boolean;
  /** How much larger its nodes have become since it was built, 1 at first; at 2 or 3 `rebuild()` pays. */
  readonly sahRatio: number;
  /** Sorts the bounds again as they are now. Indices stay, `order` changes. */
  rebuild(): void;
  /** Gives the bounds new indices, in the order of the tree: bound `order[p]` becomes bound p. O(n). */
  reorder(): void;
}

export interface SphereTree extends SphereBounds, MovingTree {}

export interface BoxTree extends BoxBounds, MovingTree {}

/** The state of a dynamic tree at one commit. It never changes, whatever becomes of the tree. */
export interface Snapshot {
  /** The box around all bounds; the empty box if there are none. */
  readonly box: Float32Array;
}
export interface BoxTreeSnapshot extends BoxBounds, Snapshot {}
export interface SphereTreeSnapshot extends SphereBounds, Snapshot {}

/**
 * Bounds that are inserted, erased and moved. Changes wait for `commit()`, and queries see the last commit. An id stays
 * valid until its bound is erased, and never means another bound. Queries return indices: `Number(id & 0xffffffffn)`.
 * `length` is one more than the greatest index; an index without a bound is in no shaft. Floats are as in streams.
 */
export interface DynamicTree {
  /** The box around all bounds of the last commit. */
  readonly box: Float32Array;
  /** Inserts bounds, and returns their ids. Bound i is in layers[i], or in all layers. */
  insert(bounds: Floats, layers?: ArrayLike<number>): BigUint64Array;
  /** Erases bounds. An id that has no bound, or occurs twice, is an error. */
  erase(ids: Ids): void;
  /** Gives bound ids[i] the value at i of `bounds`. */
  move(ids: Ids, bounds: Floats): void;
  /** Moves bound ids[i] by the vector at i, 3 floats each. */
  moveBy(ids: Ids, displacements: Floats): void;
  /** Puts bounds into other layers, by index. Queries see them after the next commit. */
  setLayersOf(indices: ArrayLike<number>, layers: ArrayLike<number>): void;
  /** Makes all changes visible. O(changes), and the upkeep. */
  commit(): void;
  /** The same, and sorts all bounds again. */
  rebuild(): void;
  /** The values of bounds, with all changes: 6 floats of a box, 4 of a sphere. */
  values(ids: Ids): Float32Array;
  /**
   * The number of bounds, with all changes, and what commits do to stay fast: blocks of up to 4,096 bounds, how much their
   * nodes have grown since they were sorted, bounds that wait to be sorted again, and how many the last commit sorted.
   */
  readonly upkeep: {boundCount: number, blocks: number, growth: number, waiting: number, sortedLast: number};
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
 * Patches, and what stands between them. Floats are as in streams; a plane is 4: the normal, where it faces, and
 * offset.
 */
export interface VisibilityScene extends RayOptions {
  /** Boxes around patches. */
  patches?: Floats;
  /** A plane for each of them: patches see what is outside of it, x nx + y ny + z nz > offset. */
  planes?: Floats;
  /**
   * Patches that are convex polygons, in the place of `patches` and `planes`: for each an array of its corners, 3 to 8 of
   * 3 floats. A patch faces the side from which its corners run counter-clockwise.
   */
  corners?: readonly Floats[];
  /** 'both' if patches of `corners` and `cornersB` are seen from both sides: two in one plane face away. Default 'front'. */
  sides?: 'front' | 'both';
  /** The other set; without it, each two patches of one set are a pair, once. */
  patchesB?: Floats;
  planesB?: Floats;
  cornersB?: readonly Floats[];
  /** Boxes around things that may hide something: occluders 0 to n − 1. Those that follow here are numbered on. */
  boxes?: Floats;
  /** Boxes that are solid. */
  solids?: Floats;
  /** Convex hulls that are solid: for each an array of its corners, 4 or more of 3 floats. */
  hulls?: readonly Floats[];
  /** Flat convex polygons: for each an array of its corners in order, 3 or more of 3 floats. */
  polygons?: readonly Floats[];
  /** Triangles of 9 floats, in groups of neighbours that the library makes. */
  triangles?: Floats;
  /** Whether occluders that only touch a shaft stand between: 'open', they do not, by default. */
  contact?: Contact;
  /** How far in front of a plane a point may be and still count as behind it; 0 by default. */
  tolerance?: number;
  /** Whether solids are looked for in the triangles: bodies, and flat polygons. They are no occluders. */
  findSolids?: boolean;
  /** Whether a solid that an end reaches into makes a pair occluded; true by default. */
  solidsAroundEnds?: boolean;
  /** Whether undecided pairs come with candidates; true by default. */
  candidates?: boolean;
  /** Bytes for answers under way, 1 MB or more; 256 MB by default. */
  memory?: number;
}

/** Rays from points of one patch to points of another. */
export interface RayOptions {
  /** Most rays per undecided pair, 1 to 65536; a multiple of 16 is cast. */
  rays?: number;
  /** A pair gets fewer rays if the estimated standard error is at most this; 0, the default of `visibility`: all rays. */
  error?: number;
  /** Where rays start and end depends on it and on the pair alone; 1 by default. */
  seed?: number;
}

/** Patches that radiate, what stands between them, and options: by default 4096 `rays` at most, and an `error` of 2e-5. */
export interface LitScene extends RayOptions,
    Pick<VisibilityScene, 'patches' | 'planes' | 'corners' | 'sides' | 'boxes' | 'solids' | 'hulls' | 'polygons' |
                          'triangles' | 'findSolids' | 'tolerance'> {
  /** Directions to lights that are infinitely far away, such as the sun: 3 floats each. */
  lights: Floats;
}

export interface ViewFactorScene extends RayOptions,
    Pick<VisibilityScene, 'patches' | 'planes' | 'corners' | 'boxes' | 'solids' | 'hulls' | 'polygons' | 'triangles' |
                          'findSolids' | 'tolerance' | 'memory'> {
  /** Pairs both of whose factors are below this are left out of the matrix; 0 by default. */
  least?: number;
  /** Whether rows are made to sum to 1, as those of an enclosure do; false by default. */
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
  /** The sum of each row, with what is left out; the rest to 1 meets no patch: the sky. */
  readonly sum: Float64Array;
  /** The estimated standard error of each sum. */
  readonly error: Float64Array;
  /** What of each sum is below `least`. */
  readonly leftOut: Float64Array;
  /** How many pairs there are of each kind. */
  readonly counts: Readonly<Record<Sight, number>>;
  /** The factor from patch i to patch j; 0 if there is none. */
  at(i: number, j: number): number;
}

/** What sees what. */
export interface Visibility {
  /** How many pairs there are of each kind. */
  readonly counts: Readonly<Record<Sight, number>>;
  /**
   * What is decided: runs of patches by runs of patches of which the same is said, 4 numbers each: position and length
   * of the run in `orderA`, position and length of the run in `orderB`.
   */
  readonly blocks: Uint32Array;
  /** What is said of each block. */
  readonly sights: readonly Sight[];
  readonly orderA: Uint32Array;
  readonly orderB: Uint32Array;
  /** Undecided pairs: two patches each. */
  readonly undecided: Uint32Array;
  /**
   * Occluders that reach between pair p are candidates[offsets[p]] to before candidates[offsets[p + 1]]: none for any
   * pair if the scene asks for no candidates.
   */
  readonly offsets: Float64Array;
  readonly candidates: Uint32Array;
  /**
   * The visible fraction of each undecided pair, from 0 to 1, if the scene asks for `rays`: of the segments that leave
   * and arrive in front, the share that no candidate blocks.
   */
  readonly fractions?: Float32Array;
  /** The triangles of each occluder, by their positions in the scene's; none of other occluders than triangles. */
  readonly triangles: readonly Uint32Array[];
  /** All pairs of one kind, two patches each; of one set with itself each pair once. */
  pairs(sight: Sight): Uint32Array;
  /**
   * A row of bits per patch of the first set: bit j % 32 of word j / 32 of row i says whether this is said of patches i
   * and j. For one set with itself both bits of a pair are set.
   */
  bits(sight: Sight): Uint32Array[];
}
