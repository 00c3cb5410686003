"""Form factors between the faces of a unit cube, with and without a box in it.

A face is cut into patches. From points of each, the share of light that reaches another patch is a sum over its edges
(Lambert 1760). Shafts tell which pairs of patches the box can come between; only for these are segments tested.
"""

import itertools

import numpy as np
import shaftcull

GAUSS = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # where to look from within a patch, along each axis


def patches(n):
    """Boxes (6, n * n, 6) of the patches of the faces, and where they face. n is a power of 2, so nothing is rounded."""
    u, v = (grid.ravel() / n for grid in np.meshgrid(np.arange(n), np.arange(n)))
    faces, normals = np.zeros((6, n * n, 6), dtype=np.float32), np.zeros((6, 3))
    for face, axis, side in zip(range(6), (0, 1, 2) * 2, (0, 0, 0, 1, 1, 1)):
        for corner, size in ((0, 0), (3, 1 / n)):
            faces[face, :, corner + axis] = side
            faces[face, :, corner + (axis + 1) % 3] = u + size
            faces[face, :, corner + (axis + 2) % 3] = v + size
        normals[face, axis] = 1 - 2 * side
    return faces, normals


def shares(points, normal, boxes, axis):
    """Of the light of points, what reaches flat boxes, without what is between."""
    corners = np.repeat(boxes[:, None].astype(float), 4, axis=1)
    corners[:, 1:3, (axis + 1) % 3] = boxes[:, None, 3 + (axis + 1) % 3]
    corners[:, 2:4, (axis + 2) % 3] = boxes[:, None, 3 + (axis + 2) % 3]
    ways = corners[..., :3] - points[:, None]
    across = np.cross(ways, np.roll(ways, -1, axis=1))
    sine = np.linalg.norm(across, axis=-1)
    angle = np.arctan2(sine, (ways * np.roll(ways, -1, axis=1)).sum(-1))
    return abs((angle * (across @ normal) / sine).sum(1)) / (2 * np.pi)


def misses(points, ends, box):
    """Whether segments pass by a box: their times within its three slabs have none in common."""
    ways = np.where(points == ends, 1e-30, ends - points)
    enter, leave = np.sort([(box[:3] - points) / ways, (box[3:] - points) / ways], axis=0)
    return np.maximum(enter.max(-1), 0) > np.minimum(leave.min(-1), 1)


def form_factor(from_face, to_face, n=8, box=None, all_pairs=False):
    """The form factor, and how many pairs of patches were tested."""
    faces, normals = patches(n)
    a, b = np.repeat(faces[from_face], n * n, axis=0), np.tile(faces[to_face], (n * n, 1))
    tested = np.arange(0 if box is None else len(a))
    if box is not None and not all_pairs:
        tested = np.flatnonzero(shaftcull.BoxTree([box]).any(a, b))
    total, middles = 0, (b[tested, :3] + b[tested, 3:]) / 2
    for place in itertools.product(GAUSS, repeat=3):
        points = a[:, :3] + np.array(place) * (a[:, 3:] - a[:, :3])
        light = shares(points, normals[from_face], b, to_face % 3)
        light[tested] *= misses(points[tested], middles, np.array(box or np.zeros(6)))
        total += light.sum() / 8 / n**2
    return total, len(tested)


if __name__ == "__main__":
    print("opposite %.5f, adjacent %.5f" % (form_factor(0, 3)[0], form_factor(0, 1)[0]))
    print("opposite, with a box between: %.5f; %d of 4096 pairs tested" % form_factor(0, 3, 8, [0.375] * 3 + [0.625] * 3))
