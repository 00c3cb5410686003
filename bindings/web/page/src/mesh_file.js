// SPDX-License-Identifier: MIT
// Reads glTF, GLB and OBJ files that are dropped on the page, as triangles of float32.
import {LoadingManager, Matrix4, MeshBasicMaterial, Vector3} from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {OBJLoader} from 'three/addons/loaders/OBJLoader.js';
import {facesAlone} from './obj_file.js';

/** Extensions of glTF that say nothing about where triangles are, or that GLTFLoader reads by itself. */
const READ_EXTENSIONS =
  /^(KHR_(materials|texture|lights)_.*|EXT_texture_.*|KHR_mesh_quantization|EXT_mesh_gpu_instancing)$/;

/** Triangles of 9 floats, and the name of the file. Throws an Error that says what file is wrong, and how. */
export async function readMesh(files) {
  const meshes = files.filter(({name}) => /\.(gltf|glb|obj)$/i.test(name));
  if (meshes.length === 0) throw new Error(`${files[0].name} is no glTF, GLB or OBJ file.`);
  if (meshes.length > 1) {
    throw new Error(`${meshes[0].name} and ${meshes[1].name} were dropped together: one at a time.`);
  }
  const [file] = meshes;
  let triangles;
  try {
    const isObj = /\.obj$/i.test(file.name);
    triangles = trianglesOf(isObj ? new OBJLoader().parse(facesAlone(await file.text())) : await readGltf(file, files));
  } catch (error) {
    throw new Error(`${file.name} cannot be read: ${reason(error)}`);
  }
  if (triangles.length === 0) throw new Error(`${file.name} has no triangles.`);
  const bad = triangles.findIndex((value) => !Number.isFinite(value));
  if (bad >= 0) {
    const place = `triangle ${Math.floor(bad / 9)} has the coordinate ${triangles[bad]}`;
    throw new Error(`${file.name}: ${place}; all must be finite.`);
  }
  return {name: file.name, triangles};
}

/** What an error says to those who have the file. Loaders stumble over broken files with errors of JavaScript. */
function reason(error) {
  if (error instanceof DOMException) return 'the browser cannot open it. Folders are not read.';
  if (error instanceof SyntaxError) return `it is no JSON: ${error.message}`;
  if (error.constructor !== Error) return 'it is damaged or incomplete.';
  return error.message;
}

async function readGltf(file, files) {
  const manager = new LoadingManager();
  const urls = [];
  manager.setURLModifier((url) => {
    if (/^(data|blob):/.test(url)) return url;
    const name = decodeURIComponent(url).split('/').pop();
    const other = files.find((candidate) => candidate.name === name);
    if (!other) throw new Error(`it needs ${name}. Drop both files together.`);
    urls.push(URL.createObjectURL(other));
    return urls.at(-1);
  });
  const loader = new GLTFLoader(manager);
  loader.register(() => ({name: 'no materials', loadMaterial: async () => new MeshBasicMaterial()}));
  try {
    const {parser, scene} = await loader.parseAsync(await file.arrayBuffer(), '');
    const unread = (parser.json.extensionsRequired ?? []).find((extension) => !READ_EXTENSIONS.test(extension));
    if (unread) throw new Error(`it needs the extension ${unread}, which this page does not read.`);
    if (!scene) throw new Error('it has no scene.');
    return scene;
  } finally {
    urls.forEach((url) => URL.revokeObjectURL(url));
  }
}

/** All triangles below a node, where the nodes above put them. */
function trianglesOf(root) {
  root.updateMatrixWorld(true);
  const meshes = [];
  root.traverse((node) => {
    if (node.isMesh && node.geometry.attributes.position) meshes.push(node);
  });
  const placed = meshes.flatMap((mesh) => placesOf(mesh).map((place) => ({mesh, place})));
  const triangles = new Float32Array(3 * placed.reduce((sum, {mesh}) => sum + cornersIn(mesh.geometry), 0));
  let filled = 0;
  for (const {mesh, place} of placed) {
    putTriangles(triangles, filled, mesh, place.elements);
    filled += 3 * cornersIn(mesh.geometry);
  }
  return triangles;
}

/** Where a mesh is: once, or wherever its instances are. */
function placesOf(mesh) {
  if (!mesh.isInstancedMesh) return [mesh.matrixWorld];
  return Array.from({length: mesh.count}, (_, i) => {
    const place = new Matrix4();
    mesh.getMatrixAt(i, place);
    return place.premultiply(mesh.matrixWorld);
  });
}

/** Corners of whole triangles. */
function cornersIn({index, attributes}) {
  const count = (index ?? attributes.position).count;
  return count - (count % 3);
}

/** Corners as morph targets and skins leave them, at a place. */
function putTriangles(triangles, offset, mesh, m) {
  const {index} = mesh.geometry;
  const count = cornersIn(mesh.geometry);
  const at = new Vector3();
  for (let corner = 0; corner < count; corner++) {
    const {x, y, z} = mesh.getVertexPosition(index ? index.getX(corner) : corner, at);
    for (let k = 0; k < 3; k++) {
      triangles[offset + 3 * corner + k] = m[k] * x + m[k + 4] * y + m[k + 8] * z + m[k + 12];
    }
  }
}
