# SPDX-License-Identifier: MIT
"""Meshes in the manner of CAD, building models and scans, from a seed.

A part is an array of triangles, n × 3 × 3; faces look outwards, of rooms inwards. A mesh is a list of (name, part), and is written
as its maker's program would: one object or many, vertices shared or repeated, nodes that mirror.
"""
import base64
import json

import numpy


# -- parts -----------------------------------------------------------------------------------------------------------------------


def quads(corners):
    """Of quadrilaterals, n × 4 × 3."""
    corners = numpy.asarray(corners, float)
    return numpy.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])


def grid(origin, u, v, columns, rows):
    """A parallelogram in columns × rows; its front is where u × v points."""
    origin, u, v = (numpy.asarray(x, float) for x in (origin, u, v))
    s, t = numpy.meshgrid(numpy.arange(columns), numpy.arange(rows), indexing="ij")
    s, t = s.reshape(-1, 1), t.reshape(-1, 1)
    steps = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = [origin + (s + i) / columns * u + (t + j) / rows * v for i, j in steps]
    return quads(numpy.stack(corners, 1))


def prism(outline, low, high):
    """An outline that runs counterclockwise as seen from above, and all of which its first corner sees."""
    ring = numpy.asarray(outline, float)
    after = numpy.roll(ring, -1, 0)
    at = lambda points, z: numpy.column_stack([points, numpy.full(len(points), z)])
    sides = quads(numpy.stack([at(ring, low), at(after, low), at(after, high), at(ring, high)], 1))
    fan = [[0, i, i + 1] for i in range(1, len(ring) - 1)]
    return numpy.concatenate([sides, at(ring, high)[fan], at(ring, low)[fan][:, ::-1]])


def box(low, high):
    (x, y, z), (u, v, w) = low, high
    return prism([(x, y), (u, y), (u, v), (x, v)], z, w)


def l_block(x, y, size, low, high):
    half = size / 2
    outline = [(half, half), (half, size), (0, size), (0, 0), (size, 0), (size, half)]
    return prism([(x + i, y + j) for i, j in outline], low, high)


def column(x, y, radius, low, high, sides=24):
    angle = numpy.arange(sides) * 2 * numpy.pi / sides
    return prism(numpy.column_stack([x + radius * numpy.cos(angle), y + radius * numpy.sin(angle)]), low, high)


def split_box(low, high, source):
    """Each face in a raster of its own: edges of neighbours do not meet at corners."""
    low, high = numpy.asarray(low, float), numpy.asarray(high, float)
    faces = []
    for axis in range(3):
        u, v = numpy.zeros(3), numpy.zeros(3)
        u[(axis + 1) % 3], v[(axis + 2) % 3] = (high - low)[[(axis + 1) % 3, (axis + 2) % 3]]
        top = low.copy()
        top[axis] = high[axis]
        faces.append(grid(top, u, v, *source.integers(1, 4, 2)))
        faces.append(grid(low, v, u, *source.integers(1, 4, 2)))
    return numpy.concatenate(faces)


def stair(x, y, width, steps, depth, height):
    """Steps on one block that rise with x, as one closed surface."""
    foot = [(i * depth, 0.0) for i in range(steps + 1)]
    top = [(x, z * height) for i in reversed(range(steps)) for x, z in (((i + 1) * depth, i + 1), (i * depth, i + 1))]
    ring = numpy.array(foot + top)  # in x and z
    at = lambda points, away: numpy.column_stack([x + points[:, 0], numpy.full(len(points), y + away), points[:, 1]])
    cheeks, edges = [], list(zip(ring, numpy.roll(ring, -1, 0)))
    for i in range(steps):
        low, high, left, right = i * height, (i + 1) * height, i * depth, (i + 1) * depth
        corners = numpy.array([(right, 0), (right, high), (left, high), (left, low), (left, 0)])
        for j, k in ((1, 2), (2, 3), (3, 4)) if i else ((1, 2), (2, 3)):
            cheeks += [at(corners[[0, j, k]], 0)[None], at(corners[[0, k, j]], width)[None]]
    sides = [quads(numpy.stack([at(a[None], 0), at(a[None], width), at(b[None], width), at(b[None], 0)], 1)) for a, b in edges]
    return numpy.concatenate(sides + cheeks)


def bumpy(centre, radius, source, halvings=3):
    """A sphere of 20 · 4^halvings triangles whose corners are moved in and out, as scanners see round things."""
    golden = (1 + 5**0.5) / 2
    corners = numpy.array([p for i in (-1, 1) for j in (-golden, golden) for p in ((0, i, j), (i, j, 0), (j, 0, i))], float)
    distance = numpy.linalg.norm(corners[:, None] - corners[None], axis=2)
    near = numpy.abs(distance - 2) < 1e-9
    faces = numpy.array([(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near[i, j] and near[j, k] and near[i, k]])
    part = corners[faces]
    for _ in range(halvings):
        a, b, c = part[:, 0], part[:, 1], part[:, 2]
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        part = numpy.concatenate([numpy.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    part /= numpy.linalg.norm(part, axis=2, keepdims=True)
    inwards = numpy.einsum("ij,ij->i", numpy.cross(part[:, 1] - part[:, 0], part[:, 2] - part[:, 0]), part.sum(1)) < 0
    part[inwards] = part[inwards][:, ::-1]
    waves = source.normal(0, 3, (6, 3))
    height = 1 + sum(0.03 * numpy.sin(part @ wave + i) for i, wave in enumerate(waves))
    return numpy.asarray(centre) + radius * height[..., None] * part


def turned_round(part):
    return part[:, ::-1]


def turned(part, axis, angle):
    """By Rodrigues' formula."""
    axis = numpy.asarray(axis, float) / numpy.linalg.norm(axis)
    cross = numpy.cross(numpy.eye(3), axis)
    matrix = numpy.eye(3) - numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross
    return part @ matrix.T


# -- meshes ----------------------------------------------------------------------------------------------------------------------


def walls_with_doors(source, rooms):
    """Rows of rooms: each wall is a closed box, flush with floor and ceiling, or three of them around a door."""
    width, height, thick = 4.0, 2.5, 0.25
    length = rooms * width
    parts = [box((0, 0, -thick), (length, width, 0)), box((0, 0, height), (length, width, height + thick))]
    parts += [box((0, -thick, 0), (length, 0, height)), box((0, width, 0), (length, width + thick, height))]
    for i in range(rooms + 1):
        x = i * width
        if i in (0, rooms):
            parts.append(box((x - thick / 2, 0, 0), (x + thick / 2, width, height)))
            continue
        door = source.uniform(0.5, 2.5)
        for low, high in (((0, 0), (door, height)), ((door + 0.9, 0), (width, height)), ((door, 2.1), (door + 0.9, height))):
            parts.append(box((x - thick / 2, low[0], low[1]), (x + thick / 2, high[0], high[1])))
    for _ in range(2 * rooms):
        x, y = source.uniform(0.4, length - 1.2), source.uniform(0.3, width - 1.2)
        parts.append(box((x, y, 0), (x + source.uniform(0.3, 0.8), y + source.uniform(0.3, 0.8), source.uniform(0.4, 2))))
    return parts


def turned_rooms(source):
    """Rooms with doors and furniture, all of it one object, turned about a skew axis."""
    return [("house", turned(numpy.concatenate(walls_with_doors(source, 3)), (1, 2, 3), 0.5))]


def l_rooms(source):
    """L-shaped rooms as shells that look inwards, with what stands in them, turned about the vertical."""
    mesh = []
    for i in range(2):
        x = 5.0 * i
        mesh.append((f"room {i}", turned_round(l_block(x, 0, 4, 0, 2.5))))
        mesh.append((f"cupboard {i}", box((x + 0.5, 2.2, 0), (x + 1.3, 2.6, source.uniform(1, 2.5)))))
        mesh.append((f"desk {i}", box((x + 2.1, 0.6, 0.7), (x + 3.6, 1.4, 0.75))))
    return [(name, turned(part, (0, 0, 1), numpy.pi / 6)) for name, part in mesh]


def t_junctions(source):
    """A hall of boxes whose faces are split each in its own way."""
    mesh = [("hall", turned_round(split_box((-1, -1, 0), (11, 9, 4), source)))]
    for i in range(8):
        low = numpy.array([source.uniform(0, 8), source.uniform(0, 6), 0])
        mesh.append((f"crate {i}", split_box(low, low + source.uniform(0.5, 2.5, 3), source)))
    return [(name, turned(part, (0, 0, 1), 0.3)) for name, part in mesh]


def sheets(source):
    """Baffles without thickness in a room: some with a face on each side, some with one only, some split unlike behind."""
    mesh = [("room", turned_round(box((0, 0, 0), (8, 6, 3))))]
    for i in range(8):
        at, along = source.uniform((0.5, 0.5), (6, 4)), source.uniform(0, numpy.pi)
        u = source.uniform(1, 2.5) * numpy.array([numpy.cos(along), numpy.sin(along), 0])
        v = numpy.array([0, 0, source.uniform(1, 3)])
        front = grid((*at, 0), u, v, 2, 1)
        behind = turned_round(front) if i % 2 else turned_round(grid((*at, 0), u, v, 1, 3))
        mesh.append((f"baffle {i}", front if i % 3 == 0 else numpy.concatenate([front, behind])))
    return mesh


def mirrored(source):
    """A wing of a building and its mirror image, which is a node that reflects."""
    parts = walls_with_doors(source, 2)
    return [("wing", numpy.concatenate(parts)), ("yard", grid((-12, -4, -0.3), (24, 0, 0), (0, 12, 0), 6, 4))]


def scan(source):
    """A cave and a boulder, as scanned: closed, bumpy, nothing in a plane."""
    cave = turned_round(bumpy((0, 0, 0), 10, source))
    return [("scan", numpy.concatenate([cave, bumpy((2, 1, 0), 3, source, 2), bumpy((-4, -2, 1), 2, source, 2)]))]


def hall(source):
    """Columns of 24 sides and a stair, in a hall."""
    mesh = [("hall", turned_round(box((0, 0, 0), (14, 10, 5)))), ("stair", stair(8, 3, 3, 8, 0.35, 0.2))]
    for i in range(3):
        for j in range(2):
            x, y = 2.5 + 3 * i + source.uniform(-0.3, 0.3), 2.2 + 5.5 * j
            mesh.append((f"column {i}{j}", column(x, y, source.uniform(0.3, 0.7), 0, 5)))
    return [(name, turned(part, (0, 0, 1), 0.2)) for name, part in mesh]


def facades(source):
    """Buildings whose facades and roofs are split in coplanar triangles, all of it one object without shared vertices."""
    parts = [grid((-5, -5, 0), (60, 0, 0), (0, 60, 0), 6, 6)]
    for i in range(3):
        for j in range(3):
            low = numpy.array([i * 18.0, j * 18.0, 0])
            high = low + (10 + source.uniform(0, 3), 10, source.uniform(6, 20))
            x, y, z = high - low
            for origin, u, v in (
                ((0, 0, 0), (x, 0, 0), (0, 0, z)),
                ((x, 0, 0), (0, y, 0), (0, 0, z)),
                ((x, y, 0), (-x, 0, 0), (0, 0, z)),
                ((0, y, 0), (0, -y, 0), (0, 0, z)),
                ((0, 0, z), (x, 0, 0), (0, y, 0)),
            ):
                parts.append(grid(low + origin, u, v, *source.integers(1, 4, 2)))
    return [("quarter", turned(numpy.concatenate(parts), (0, 0, 1), 0.25))]


def open_blocks(source):
    """Blocks without bottoms and the level ground between them, one object in which they share vertices; a table in a tent."""
    parts = []
    for i in range(9):
        for j in range(9):
            x, y = 10.0 * i, 10.0 * j
            if i % 2 == 0 or j % 2 == 0:
                parts.append(grid((x, y, 0), (10, 0, 0), (0, 10, 0), 2, 2))
                continue
            high = source.uniform(6, 25)
            for origin, u in (((x, y), (10, 0)), ((x + 10, y), (0, 10)), ((x + 10, y + 10), (-10, 0)), ((x, y + 10), (0, -10))):
                parts.append(grid((*origin, 0), (*u, 0), (0, 0, high), 2, 2))
            parts.append(grid((x, y, high), (10, 0, 0), (0, 10, 0), 2, 2))
    tent = prism([(2, 92), (12, 92), (12, 99), (2, 99)], 0, 4)[:-2]
    return [("town", numpy.concatenate(parts)), ("tent", tent), ("table", box((4, 94, 0), (6, 96, 1)))]


def city(source):
    """Blocks on a ground, an object each, turned by 30 degrees."""
    mesh = [("ground", grid((-6, -6, 0), (150, 0, 0), (0, 150, 0), 1, 1))]
    for i in range(5):
        for j in range(5):
            mesh.append((f"block {i}{j}", box((30 * i, 30 * j, 0), (30 * i + 18, 30 * j + 18, source.uniform(8, 35)))))
    return [(name, turned(part, (0, 0, 1), numpy.pi / 6)) for name, part in mesh]


def overlapping(source):
    """Bodies that reach into each other: beams through columns, walls through slabs, as building models have them."""
    mesh = [("slab", box((-1, -1, -0.3), (13, 9, 0))), ("roof", box((-1, -1, 3), (13, 9, 3.3)))]
    for i in range(3):
        mesh.append((f"wall {i}", box((1 + 5 * i, -0.5, -0.1), (1.3 + 5 * i, 8.5 - i, 3.1))))
        mesh.append((f"beam {i}", box((-0.5, 1 + 3 * i, 2.5), (12.5, 1.4 + 3 * i, 3.0))))
        mesh.append((f"column {i}", column(3.5 + 3 * i, 4.2, 0.5, -0.2, 3.2)))
    mesh.append(("crossing", box((6, 2, 0), (10, 2.4, 2.2))))
    return [(name, turned(part, (1, 0, 3), 0.7)) for name, part in mesh]


# How long edges of patches are, in units of the mesh.
sizes = {
    turned_rooms: 1.0,
    l_rooms: 0.7,
    t_junctions: 1.5,
    sheets: 1.0,
    mirrored: 1.6,
    scan: 9.0,
    hall: 1.6,
    facades: 5.0,
    open_blocks: 5.0,
    city: 14.0,
    overlapping: 1.3,
}
makers = {maker.__name__: maker for maker in sizes}
sizes = {maker.__name__: size for maker, size in sizes.items()}


# -- files -----------------------------------------------------------------------------------------------------------------------


def write_obj(path, mesh, shared):
    """With each vertex once, or three for each triangle."""
    with open(path, "w", encoding="utf-8") as out:
        first = 1
        for name, part in mesh:
            vertices, of = part.reshape(-1, 3), numpy.arange(3 * len(part))
            if shared:
                vertices, of = numpy.unique(vertices.round(12), axis=0, return_inverse=True)
            out.write(f"o {name.replace(' ', '_')}\n" + "".join("v %.9g %.9g %.9g\n" % tuple(v) for v in vertices))
            out.write("".join("f %d %d %d\n" % tuple(t) for t in of.reshape(-1, 3) + first))
            first += len(vertices)


def write_mirrored(path, mesh):
    """glTF: the last part as it is, the others twice, once by a node that reflects in x = 0."""
    views, data, meshes, nodes = [], b"", [], []
    for i, (name, part) in enumerate(mesh):
        positions = part.astype("<f4").reshape(-1, 3)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": positions.nbytes})
        data += positions.tobytes()
        meshes.append({"name": name, "primitives": [{"attributes": {"POSITION": i}}]})
        last = i + 1 == len(mesh)
        nodes.append({"name": name, "mesh": i, "translation": [0 if last else 0.6, 0, 0]})
        if not last:
            nodes.append({"name": name + " mirrored", "mesh": i, "translation": [-0.6, 0, 0], "scale": [-1, 1, 1]})
    accessors = []
    for i, (_, part) in enumerate(mesh):
        corners = part.astype("<f4").reshape(-1, 3)
        limits = {"min": corners.min(0).tolist(), "max": corners.max(0).tolist()}
        accessors.append({"bufferView": i, "componentType": 5126, "count": len(corners), "type": "VEC3", **limits})
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data), "uri": uri}],
    }
    with open(path, "w", encoding="utf-8") as out:
        json.dump(scene, out)


def write_stl(path, mesh):
    """Binary, without normals: the reader takes those of the corners."""
    part = numpy.concatenate([part for _, part in mesh])
    rows = numpy.zeros(len(part), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = part
    rows["normal"] = numpy.cross(part[:, 1] - part[:, 0], part[:, 2] - part[:, 0])
    with open(path, "wb") as out:
        out.write(bytes(80) + numpy.uint32(len(part)).tobytes() + rows.tobytes())


def write(folder, name, seed):
    """Writes a mesh and returns the path of its file."""
    source = numpy.random.default_rng([seed, *name.encode()])
    mesh = makers[name](source)
    if name == "mirrored":
        path = f"{folder}/{name}.gltf"
        write_mirrored(path, mesh)
    elif name in ("scan", "facades"):
        path = f"{folder}/{name}.stl"
        write_stl(path, mesh)
    else:
        path = f"{folder}/{name}.obj"
        write_obj(path, mesh, shared=name not in ("turned_rooms", "t_junctions"))
    return path
