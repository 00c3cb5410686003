// SPDX-License-Identifier: MIT
// Reads glTF, GLB and OBJ files that are dropped on the page, as triangles of float32.
import {LoadingManager, Matrix4, MeshBasicMaterial} from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {OBJLoader} from 'three/addons/loaders/OBJLoader.js';

/** Triangles of 9 floats, and the name of the file. Throws an Error that says what file is wrong, and how. */
export async function readMesh(files) {
  const file = files.find(({name}) => /\.(gltf|glb|obj)$/i.test(name));
  if (!file) throw new Error(`${files[0].name} is no glTF, GLB or OBJ file.`);
  let triangles;
  try {
    const isObj = /\.obj$/i.test(file.name);
    triangles = trianglesOf(isObj ? new OBJLoader().parse(await file.text()) : await readGltf(file, files));
  } catch (error) {
    throw new Error(`${file.name} cannot be read: ${error.message}`);
  }
  if (triangles.length === 0) throw new Error(`${file.name} has no triangles.`);
  const bad = triangles.findIndex((value) => !Number.isFinite(value));
  if (bad >= 0) {
    const place = `triangle ${Math.floor(bad / 9)} has the coordinate ${triangles[bad]}`;
    throw new Error(`${file.name}: ${place}; all must be finite.`);
  }
  return {name: file.name, triangles};
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
    return (await loader.parseAsync(await file.arrayBuffer(), '')).scene;
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
  const placed = meshes.flatMap((mesh) => placesOf(mesh).map((place) => ({geometry: mesh.geometry, place})));
  const triangles = new Float32Array(3 * placed.reduce((sum, {geometry}) => sum + cornersIn(geometry), 0));
  let filled = 0;
  for (const {geometry, place} of placed) {
    putTriangles(triangles, filled, geometry, place.elements);
    filled += 3 * cornersIn(geometry);
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

function putTriangles(triangles, offset, geometry, m) {
  const {index, attributes: {position}} = geometry;
  const count = cornersIn(geometry);
  for (let corner = 0; corner < count; corner++) {
    const vertex = index ? index.getX(corner) : corner;
    const [x, y, z] = [position.getX(vertex), position.getY(vertex), position.getZ(vertex)];
    for (let k = 0; k < 3; k++) {
      triangles[offset + 3 * corner + k] = m[k] * x + m[k + 4] * y + m[k + 8] * z + m[k + 12];
    }
  }
}
