// SPDX-License-Identifier: MIT
// A client in TypeScript, which is compiled and not run: all types are there, and what is wrong is refused.
import {load, ShaftcullError} from 'shaftcull';
import type {
  Answer, AskManyOptions, AskOptions, BoxTree, Bounds, DynamicBoxTree, FirstContact, Floats, Hull, Lists, Origin, ShaftInfo, Shafts,
  Shaftcull, Sight, ViewFactors, Visibility, Volume,
} from 'shaftcull';

const shaftcull: Shaftcull = await load(new Uint8Array());
const world: Origin = shaftcull.origin([4512345, 500000, 100]);
const boxes: Floats = world.boxesAround([0, 0, 0, 1, 1, 1]);
export const corners: Float64Array = world.toWorld(world.nearest(world.at));
const tree: BoxTree = shaftcull.boxTree(boxes);
const shafts: Shafts = shaftcull.between(boxes, [2, 2, 2, 3, 3, 3], {contact: 'open', pairs: [0, 0]});
shaftcull.shadow(boxes, boxes, {planes: [], planesLights: [], planesOccluders: [], contact: 'open', reach: 2});
const view: Hull = shaftcull.frustum(new Float32Array(16), 'zero_to_one', {test: 'conservative'});
const every: readonly Bounds[] = [tree, shaftcull.sphereStream([]), shaftcull.triangleTree([], [])];
export const numbers: number[] = every.map((bounds) => bounds.count(view) + bounds.list(shafts, {at: 1}).length);
export const first: number | undefined = tree.firstContact(shafts)?.time;
export const occluded: number | undefined = tree.findOccluder(shafts, {exclude: [0]});
tree.update(boxes);
tree.updateSome([0], boxes);
tree.refit();
tree.reorder();
export const fits: boolean = !tree.needsRefit && tree.copy().order.length === tree.box.length;
shaftcull.triangleStream([]).update([], {first: 0, indices: [0, 0, 0]});
shafts.complete();
const all: Shafts = shaftcull.concatenate([shafts, view]);
const info: ShaftInfo = all.describe({at: 1});
export const planes: Float32Array[] = [all.joiningPlanes({at: 0}), shaftcull.viewPlanes(info.a, 'zero_to_one')];
export const made: Float32Array = shaftcull.inflated(shaftcull.translated(shaftcull.boxAround([]), [0, 0, 0]), 1);
const bodies: DynamicBoxTree = shaftcull.dynamicBoxTree({sortedPerChange: 2});
const ids: BigUint64Array = bodies.insert(boxes, [1]);
bodies.moveBy(ids, [1, 0, 0]);
bodies.commit();
export const moved: number[] = [bodies.snapshot().count(view), bodies.list(view)[0]!, bodies.upkeep.blocks];
tree.setLayers(Uint32Array.of(1));
tree.setLayersOf([0], [2]);
const asked: AskOptions = {exclude: [0], excludeMask: tree.cull(view), layerMask: 1, limit: 9, only: [0], at: 0,
                           skipOverlapping: false};
const askedMany: AskManyOptions = {excludeEach: Uint32Array.of(0), layerMask: [1, 2], triangleTest: 'vertices'};
export const lists: Uint32Array[] = [tree.list(shafts, asked), tree.listMany(shafts, askedMany).indices];
const named: Lists = tree.listClassifiedMany(shafts, {excludeEach: [0]}).inside;
export const rows: Uint32Array[] = [...tree.cullMany(shafts), ...tree.classifyMany(shafts).kept, named.indices];
export const bits: Uint32Array[] = [tree.anyMany(shafts), tree.occludedMany(shafts, {exclude: [0]})];
export const each: Float64Array[] = [tree.countClassifiedMany(shafts).inside, tree.listOccludersMany(shafts).offsets];
export const contacts: (FirstContact | undefined)[] = tree.firstContactMany(shafts, {only: [0]});
const volumes: readonly Volume[] = [shafts, view];
export const answers: Answer[] = volumes.map((volume) => volume.classify(boxes, {at: 0, triangleTest: 'vertices'}));
export const is: boolean[] = [view.keeps(boxes), shafts.occludedByBox(boxes), shafts.occludedByPolygon([], {at: 1})];
export const inside: Uint32Array[] = every.map((bounds) => bounds.listClassified(view, {exclude: [0]}).inside);

const seen: Visibility = shaftcull.visibility({patches: boxes, solids: boxes, polygons: [], candidates: false});
export const visible: number = shaftcull.countVisibility({patches: boxes, hulls: []}).clear + seen.bits('clear').length;
const sights: Sight[] = ['clear', 'facing_away'];
export const pairs: Uint32Array[] = sights.map((sight) => seen.pairs(sight));
export const position = (error: unknown): number | undefined => (error instanceof ShaftcullError ? error.position : 0);
export const right: boolean = shaftcull.hashFamilies.every(({name, ways}) => {
  const {hash, record} = shaftcull.hash(name, ways[0]!, {quick: true});
  return hash === record;
});

const factors: ViewFactors = shaftcull.viewFactors({corners: [boxes], solids: boxes, least: 0.1, closeRows: false, rays: 64});
export const factor: number = factors.at(0, 0) + factors.factor.length + factors.counts.clear;
export const fractions: Float32Array | undefined = shaftcull.visibility({corners: [boxes], rays: 16, seed: 2}).fractions;
// @ts-expect-error: view factors are those of one set
shaftcull.viewFactors({corners: [boxes], cornersB: [boxes]});
// @ts-expect-error: there is no such contact
shaftcull.between(boxes, boxes, {contact: 'ajar'});
// @ts-expect-error: spheres block nothing
shaftcull.sphereTree([]).findOccluder(shafts);
// @ts-expect-error: hulls do not move
tree.firstContact(view);
// @ts-expect-error: one shaft has no rows of its own
tree.list(shafts, {excludeEach: [0]});
// @ts-expect-error: bits have no limit
tree.cull(shafts, {limit: 1});
// @ts-expect-error: rows of bits have no limit
tree.cullMany(shafts, {limit: 1});
// @ts-expect-error: a hull is not many shafts
tree.countMany(view);
// @ts-expect-error: spheres hide nothing
shaftcull.sphereTree([]).occludedMany(shafts);
// @ts-expect-error: solids are not asked about candidates
tree.findOccluder(shafts, {only: [0]});
// @ts-expect-error: a moving body is one box
shaftcull.swept(boxes, [1, 0, 0], {planesB: []});
// @ts-expect-error: streams have no order
shaftcull.boxStream([]).order;
shaftcull.triangleTree([]).update([], {indices: []});
// @ts-expect-error: dynamic trees have layers by index alone
bodies.setLayers([1]);
// @ts-expect-error: the shaft is an option
shafts.joiningPlanes(0);
// @ts-expect-error: nothing is kept of a pair that is counted
shaftcull.countVisibility({patches: boxes, candidates: true});
// @ts-expect-error: there is no such test
tree.list(shafts, {triangleTest: 'boxes'});
