// SPDX-License-Identifier: MIT
// Draws all bounds of a scene with one call. Their floats, and a byte for the answer of each, are textures that the
// vertex shader reads; a frame uploads only those rows of answers that changed.
import {BufferGeometry, DataTexture, DoubleSide, FloatType, Mesh, RGBAFormat, ShaderMaterial} from 'three';
import {ANSWERS, colour} from './palette.js';

const FLOATS_WIDTH = 4096;  // of the texture of floats, in texels of 4
const ANSWERS_WIDTH = 256;  // of the texture of answers, likewise
const ROW = 4 * ANSWERS_WIDTH;

/** Three faces that meet in (1, 1, 1): of a box the eye sees three at most, so these are mirrored to its side. */
const FACES = [
  [1, 1, 1], [1, -1, 1], [1, -1, -1], [1, 1, 1], [1, -1, -1], [1, 1, -1],
  [1, 1, 1], [1, 1, -1], [-1, 1, -1], [1, 1, 1], [-1, 1, -1], [-1, 1, 1],
  [1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, 1, 1], [-1, -1, 1], [1, -1, 1],
];
const SQUARE = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, -1, 0], [1, 1, 0], [-1, 1, 0]];
const TRIANGLE = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/** How each shape is drawn: the vertices of a bound, its floats and texels, and code that sets `place` and `light`. */
const SHAPES = {
  boxes: {
    vertices: FACES,
    floats: 6,
    texels: 2,
    place: `
      vec4 p = texel(2 * bound);
      vec4 q = texel(2 * bound + 1);
      vec3 lo = p.xyz;
      vec3 hi = vec3(p.w, q.xy);
      vec3 middle = (lo + hi) * 0.5;
      vec3 side = vec3(cameraPosition.x < middle.x ? -1.0 : 1.0, cameraPosition.y < middle.y ? -1.0 : 1.0,
                       cameraPosition.z < middle.z ? -1.0 : 1.0);
      vec4 place = viewMatrix * vec4(middle + (hi - lo) * 0.5 * side * vertex, 1.0);
      float light = corner < 6 ? 0.78 : corner < 12 ? 1.0 : 0.6;`,
  },
  // Squares that face the eye; the fragment shader cuts discs out of them and shades these as spheres.
  spheres: {
    vertices: SQUARE,
    floats: 4,
    texels: 1,
    round: true,
    place: `
      vec4 sphere = texel(bound);
      vec4 place = viewMatrix * vec4(sphere.xyz, 1.0);
      place.xy += vertex.xy * sphere.w;
      disc = vertex.xy;
      float light = 1.0;`,
  },
  triangles: {
    vertices: TRIANGLE,
    floats: 9,
    texels: 3,
    place: `
      vec4 s = texel(3 * bound);
      vec4 t = texel(3 * bound + 1);
      vec3 p = s.xyz;
      vec3 q = vec3(s.w, t.xy);
      vec3 r = vec3(t.zw, texel(3 * bound + 2).x);
      vec4 place = viewMatrix * vec4(vertex.x * p + vertex.y * q + vertex.z * r, 1.0);
      vec3 across = cross(q - p, r - p);
      float light = 0.6 + 0.4 * abs(dot(across, vec3(0.36, 0.8, 0.48))) / max(length(across), 1e-30);`,
  },
};

function vertexShader({vertices, place}) {
  const count = vertices.length;
  return `
    uniform sampler2D floats;
    uniform sampler2D answers;
    uniform vec3 colours[${ANSWERS.length}];
    uniform float shown[${ANSWERS.length}];
    varying vec3 tint;
    varying vec2 disc;
    const vec3 vertices[${count}] = vec3[](${vertices.map((vertex) => `vec3(${vertex})`)});

    vec4 texel(int i) {
      return texelFetch(floats, ivec2(i % ${FLOATS_WIDTH}, i / ${FLOATS_WIDTH}), 0);
    }

    int answerOf(int bound) {
      vec4 four = texelFetch(answers, ivec2(bound % ${ROW} / 4, bound / ${ROW}), 0);
      return int(four[bound % 4] * 255.0 + 0.5);
    }

    void main() {
      int bound = gl_VertexID / ${count};
      int corner = gl_VertexID % ${count};
      vec3 vertex = vertices[corner];
      ${place}
      int answer = answerOf(bound);
      tint = colours[answer] * light;
      gl_Position = shown[answer] > 0.5 ? projectionMatrix * place : vec4(2.0, 2.0, 2.0, 1.0);
    }`;
}

function fragmentShader({round}) {
  const shade = round
    ? `float square = dot(disc, disc);
       if (square > 1.0) discard;
       gl_FragColor.rgb *= 0.55 + 0.45 * dot(vec3(disc, sqrt(1.0 - square)), vec3(-0.36, 0.48, 0.8));`
    : '';
  return `
    varying vec3 tint;
    varying vec2 disc;
    void main() {
      gl_FragColor = vec4(tint, 1.0);
      ${shade}
      #include <colorspace_fragment>
    }`;
}

/** The floats of a scene, each bound in texels of its own. */
function floatsTexture(shape, scene) {
  const height = Math.ceil((scene.length * shape.texels) / FLOATS_WIDTH);
  const texels = new Float32Array(4 * FLOATS_WIDTH * height);
  const texture = new DataTexture(texels, FLOATS_WIDTH, height, RGBAFormat, FloatType);
  fill(texture, shape, scene);
  return texture;
}

function fill(texture, {floats: perBound, texels}, {floats, length}) {
  const padded = texture.image.data;
  for (let i = 0; i < length; i++) {
    for (let k = 0; k < perBound; k++) padded[4 * texels * i + k] = floats[perBound * i + k];
  }
  texture.needsUpdate = true;
}

function answersTexture({length}) {
  const height = Math.ceil(length / ROW);
  const texture = new DataTexture(new Uint8Array(ROW * height), ANSWERS_WIDTH, height);
  texture.needsUpdate = true;
  return texture;
}

/** The bounds of a scene. */
export class BoundsMesh {
  #floats;
  #answers;      // as the graphics card has them
  #wanted;       // as they become
  #layers = [];  // what was painted last

  constructor(scene) {
    this.scene = scene;
    const shape = SHAPES[scene.shape];
    this.#floats = floatsTexture(shape, scene);
    this.#answers = answersTexture(scene);
    this.#wanted = new Uint8Array(scene.length);
    const geometry = new BufferGeometry();
    geometry.setDrawRange(0, scene.length * shape.vertices.length);
    const material = new ShaderMaterial({
      vertexShader: vertexShader(shape),
      fragmentShader: fragmentShader(shape),
      uniforms: {
        floats: {value: this.#floats}, answers: {value: this.#answers}, colours: {value: []}, shown: {value: []},
      },
      side: DoubleSide,
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.readColours();
  }

  /** Draws the bounds as the floats of the scene are now. Their number stays. */
  move() {
    fill(this.#floats, SHAPES[this.scene.shape], this.scene);
  }

  readColours() {
    const outside = this.scene.outsideColour ?? 'outside';
    const names = ANSWERS.map((name) => (name === 'outside' ? outside : name));
    this.mesh.material.uniforms.colours.value = names.map(colour);
  }

  /** Shows bounds with some answers alone: `shown` has a flag for each answer, by its name. */
  show(shown) {
    this.mesh.material.uniforms.shown.value = ANSWERS.map((name) => (shown[name] ? 1 : 0));
  }

  /** Paints bounds with answers, later layers over earlier ones, each {answer, indices}; all others are outside. */
  paint(layers) {
    const wanted = this.#wanted;
    const painted = this.#answers.image.data;
    for (const {indices} of this.#layers) for (const i of indices) wanted[i] = 0;
    for (const {answer, indices} of layers) {
      const value = ANSWERS.indexOf(answer);
      for (const i of indices) wanted[i] = value;
    }
    const changed = new Set();
    for (const {indices} of [...this.#layers, ...layers]) {
      for (const i of indices) {
        if (painted[i] === wanted[i]) continue;
        painted[i] = wanted[i];
        changed.add(Math.floor(i / ROW));
      }
    }
    this.#layers = layers;
    this.#upload(changed);
  }

  #upload(rows) {
    for (const row of rows) this.#answers.addUpdateRange(row * ROW, ROW);
    if (rows.size > 0) this.#answers.needsUpdate = true;
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.#floats.dispose();
    this.#answers.dispose();
  }
}
