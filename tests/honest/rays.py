# SPDX-License-Identifier: MIT
"""Rays between patches against all triangles, in doubles.

A triangle stops a ray from both of its sides. Arithmetic is rounded and so are corners, so what happens within `margin` of an edge of a
triangle, or of the planes of the two patches, counts neither as stopped nor as free:

  stopped   a triangle meets the ray farther than `margin` from its own edges, and farther than that in front of both patches
  free      no triangle meets the ray, not even one that is larger by `margin`
  unclear   neither
"""
import numpy

STOPPED, UNCLEAR, FREE = 0, 1, 2
tests_at_once = 2_000_000


def unit_normals(triangles):
    normal = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = numpy.linalg.norm(normal, axis=1, keepdims=True)
    return normal / numpy.where(length > 0, length, 1)


class Triangles:
    """What stops rays: those with an area."""

    def __init__(self, corners, margin):
        normal = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = numpy.linalg.norm(normal, axis=1)
        corners = corners[area > 0]
        self.corners, self.margin = corners, margin
        self.normal = unit_normals(corners)
        self.offset = numpy.einsum("ij,ij->i", self.normal, corners[:, 0])
        along = numpy.roll(corners, -1, 1) - corners
        inwards = numpy.cross(self.normal[:, None], along)
        self.inwards = inwards / numpy.linalg.norm(inwards, axis=2, keepdims=True)  # of each edge, in the plane
        self.edge_offset = numpy.einsum("ijk,ijk->ij", self.inwards, corners)
        self.low, self.high = corners.min(1), corners.max(1)


def points_in(triangles, count, source):
    """Points within triangles, n × count × 3, not on their rims."""
    s, t = source.uniform(size=(2, len(triangles), count, 1))
    s, t = numpy.where(s + t > 1, 1 - s, s), numpy.where(s + t > 1, 1 - t, t)
    s, t = (0.001 + 0.997 * x for x in (s, t))
    a, b, c = (triangles[:, None, i] for i in range(3))
    return a + s * (b - a) + t * (c - a)


def spheres(corners):
    """Middles and radii of spheres around triangles."""
    middle = corners.mean(1)
    return middle, numpy.linalg.norm(corners - middle[:, None], axis=2).max(1)


def between(a, b, triangles, low, high):
    """Which triangles reach into the boxes around the pairs and in front of both patches: pairs and triangles, as indices."""
    found = []
    step = max(1, tests_at_once // len(triangles.corners))
    normals = unit_normals(a), unit_normals(b)
    offsets = [numpy.einsum("ij,ij->i", n, t[:, 0]) for n, t in zip(normals, (a, b))]
    vertices = triangles.corners.reshape(-1, 3).T
    for first in range(0, len(a), step):
        part = slice(first, first + step)
        keep = numpy.ones((len(a[part]), len(triangles.corners)), bool)
        for axis in range(3):
            keep &= triangles.low[:, axis] <= high[part, axis, None] + triangles.margin
            keep &= triangles.high[:, axis] >= low[part, axis, None] - triangles.margin
        for normal, offset in zip(normals, offsets):
            front = (normal[part] @ vertices).reshape(len(keep), -1, 3).max(2)
            keep &= front > offset[part, None]
        pair, triangle = numpy.nonzero(keep)
        found.append((pair + first, triangle))
    pair, triangle = (numpy.concatenate(x) for x in zip(*found))
    # All rays of a pair pass within a cone around its middle one, and triangles lie in spheres.
    (from_middle, from_radius), (to_middle, to_radius) = spheres(a), spheres(b)
    middle, radius = spheres(triangles.corners)
    start, way = from_middle[pair], (to_middle - from_middle)[pair]
    share = numpy.einsum("ij,ij->i", middle[triangle] - start, way) / numpy.maximum(numpy.einsum("ij,ij->i", way, way), 1e-300)
    nearest = start + numpy.clip(share, 0, 1)[:, None] * way
    reach = numpy.maximum(from_radius, to_radius)[pair] + radius[triangle] + triangles.margin
    keep = numpy.linalg.norm(middle[triangle] - nearest, axis=1) <= reach
    return pair[keep], triangle[keep]


def meet(p, q, triangles, which, planes):
    """How far from its edges a triangle is met by each segment p–q, negative outside of it, −infinity where its plane is not reached
    or where the end of the segment lies on it; and whether that is farther than the margin in front of both patches."""
    normal, offset = triangles.normal[which], triangles.offset[which]
    from_plane = numpy.einsum("ij,ij->i", normal, p) - offset
    to_plane = numpy.einsum("ij,ij->i", normal, q) - offset
    crosses = (from_plane > 0) != (to_plane > 0)
    share = from_plane / numpy.where(crosses, from_plane - to_plane, 1)
    point = p + share[:, None] * (q - p)
    at_end = numpy.minimum(share, 1 - share) * numpy.linalg.norm(q - p, axis=1) < 4 * triangles.margin
    of_end = numpy.where((share < 0.5)[:, None], planes[0][:, :3], planes[1][:, :3])
    is_end = at_end & (numpy.abs(numpy.einsum("ij,ij->i", normal, of_end)) > 1 - 1e-6)  # the patch's own plane
    depth = (numpy.einsum("ijk,ik->ij", triangles.inwards[which], point) - triangles.edge_offset[which]).min(1)
    height = numpy.min([numpy.einsum("ij,ij->i", n[:, :3], point) - n[:, 3] for n in planes], axis=0)
    return numpy.where(crosses & ~is_end, depth, -numpy.inf), (height > triangles.margin) & ~at_end


def outcomes(a, b, p, q, triangles):
    """STOPPED, UNCLEAR or FREE of the rays p–q, pairs × rays × 3, from patches a to b."""
    pairs, rays, _ = p.shape
    result = numpy.full((pairs, rays), FREE, numpy.int8)
    planes = [numpy.column_stack([n, numpy.einsum("ij,ij->i", n, t[:, 0])]) for n, t in ((unit_normals(a), a), (unit_normals(b), b))]
    both = numpy.concatenate([a, b], 1)
    pair, which = between(a, b, triangles, both.min(1), both.max(1))
    # First those that the middle ray meets: they stop most rays, which then need no others.
    middle = [x.mean(1)[pair] for x in (p, q)]
    depth, is_between = meet(*middle, triangles, which, [n[pair] for n in planes])
    order = numpy.argsort(-numpy.where(is_between, depth, -numpy.inf), kind="stable")
    pair, which = pair[order], which[order]
    begin = 0
    while begin < len(pair):
        alive = (result != STOPPED).any(1)
        step = max(1, tests_at_once // rays)
        part = numpy.arange(begin, min(begin + step, len(pair)))
        begin += step
        part = part[alive[pair[part]]]
        of, ray = numpy.nonzero(result[pair[part]] != STOPPED)
        row, triangle = pair[part][of], which[part][of]
        depth, is_between = meet(p[row, ray], q[row, ray], triangles, triangle, [n[row] for n in planes])
        touched = depth > -triangles.margin
        stopped = is_between & (depth > triangles.margin)
        result[row[touched & ~stopped], ray[touched & ~stopped]] = numpy.minimum(
            result[row[touched & ~stopped], ray[touched & ~stopped]], UNCLEAR)
        result[row[stopped], ray[stopped]] = STOPPED
    return result


def in_front(patches, points, distance):
    """Whether points, n × rays × 3, are farther than that in front of the patches' planes."""
    normal = unit_normals(patches)
    offset = numpy.einsum("ij,ij->i", normal, patches[:, 0])
    return numpy.einsum("ijk,ik->ij", points, normal) - offset[:, None] > distance


def edges_of(corners):
    """Vertices of triangles by number, n × 3, and from each of them to the next one an edge, the same number both ways."""
    _, vertex = numpy.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    vertex = vertex.reshape(-1, 3).astype(numpy.int64)
    after = numpy.roll(vertex, -1, 1)
    _, edge = numpy.unique(numpy.minimum(vertex, after) * vertex.size + numpy.maximum(vertex, after), return_inverse=True)
    return vertex, edge.reshape(-1, 3), numpy.sign(after - vertex)


def bodies(corners):
    """The triangles of closed surfaces that look outwards and have none around them that looks inwards."""
    while len(corners):
        _, edge, way = edges_of(corners)
        is_closed = (numpy.bincount(edge.ravel(), way.ravel())[edge] == 0).all(1)
        if is_closed.all():
            break
        corners = corners[is_closed]  # what is left may have open edges now
    if not len(corners):
        return corners
    vertex, _, _ = edges_of(corners)
    part, before = numpy.arange(len(corners)), None
    while before is None or (part != before).any():
        before, least = part, numpy.full(vertex.max() + 1, len(corners))
        numpy.minimum.at(least, vertex, part[:, None])
        part = least[vertex].min(1)
    middle = corners - corners.mean((0, 1))
    volume = numpy.bincount(part, numpy.einsum("ij,ij->i", middle[:, 0], numpy.cross(middle[:, 1], middle[:, 2])), len(corners))
    boxes = {k: (corners[part == k].min((0, 1)), corners[part == k].max((0, 1))) for k in numpy.unique(part)}
    rooms = [box for k, box in boxes.items() if volume[k] < 0]
    holds = lambda outer, inner: (outer[0] < inner[0]).all() and (outer[1] > inner[1]).all()
    solid = [k for k, box in boxes.items() if volume[k] > 0 and not any(holds(box, room) for room in rooms)]
    return corners[numpy.isin(part, solid)]


def surrounded(points, triangles, source):
    """Whether points lie within bodies: lines to infinity leave more of them than they enter."""
    counts = numpy.zeros((len(points), 3), int)
    far = 10 * numpy.abs(triangles.corners).max(initial=1)
    for i, direction in enumerate(source.normal(size=(3, 3))):
        p, q = points, points + far * direction
        from_plane = p @ triangles.normal.T - triangles.offset
        to_plane = q @ triangles.normal.T - triangles.offset
        row, which = numpy.nonzero((from_plane > 0) != (to_plane > 0))
        share = from_plane[row, which] / (from_plane[row, which] - to_plane[row, which])
        point = p[row] + share[:, None] * (q[row] - p[row])
        within = (numpy.einsum("ijk,ik->ij", triangles.inwards[which], point) >= triangles.edge_offset[which]).all(1)
        sign = numpy.where(to_plane[row, which] > 0, 1, -1)
        numpy.add.at(counts[:, i], row[within], sign[within])
    return numpy.median(counts, 1) > 0
