"""Form factors between the faces of a unit cube, with and without a box in it.

A face is cut into patches. The share of light that reaches one from a point is a sum over its edges (Lambert 1760).
Shafts tell which pairs of patches the box can come between; only for these are segments tested."""

import itertools

import numpy as np
import shaftcull

GAUSS = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # where to look from within a patch, on each axis


def patches(face, n):
    """Boxes (n * n, 6) of the patches of a face, and where it faces. n is a power of 2, so nothing is rounded."""
    axis, side = face % 3, face // 3
    corners = np.array(list(itertools.product(range(n), repeat=2))) / n
    boxes = np.full((n * n, 6), side, dtype=np.float32)
    boxes[:, [(axis + 1) % 3, (axis + 2) % 3]] = corners
    boxes[:, [3 + (axis + 1) % 3, 3 + (axis + 2) % 3]] = corners + 1 / n
    return boxes, (1 - 2 * side) * np.eye(3)[axis]


def shares(points, normal, boxes, axis):
    """Of the light of points, what reaches flat boxes if nothing is between."""
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
    return enter.max(-1, initial=0) > leave.min(-1, initial=1)


def form_factor(from_face, to_face, n=8, box=None, all_pairs=False):
    """The form factor between two faces, and how many pairs of patches were tested."""
    (a, normal), (b, _) = patches(from_face, n), patches(to_face, n)
    a, b = np.repeat(a, n * n, axis=0), np.tile(b, (n * n, 1))
    tested = np.flatnonzero(shaftcull.BoxTree([box] if box else []).any(a, b) | all_pairs)
    total = 0.0
    for place in itertools.product(GAUSS, repeat=3):
        points = a[:, :3] + place * (a[:, 3:] - a[:, :3])
        light = shares(points, normal, b, to_face % 3)
        light[tested] *= misses(points[tested], b[tested].reshape(-1, 2, 3).mean(1), np.array(box or [0] * 6))
        total += light.sum() / len(GAUSS) ** 3 / n**2
    return total, len(tested)


if __name__ == "__main__":
    print("opposite %.5f, adjacent %.5f" % (form_factor(0, 3)[0], form_factor(0, 1)[0]))
    print("with a box between: %.5f, %d of 4096 pairs tested" % form_factor(0, 3, 8, [0.375] * 3 + [0.625] * 3))
