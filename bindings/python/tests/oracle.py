# SPDX-License-Identifier: MIT
"""Answers from the definition, in fractions: a shaft is a box that moves, lo(t) = p + q t, hi(t) = r + s t."""

from fractions import Fraction as F

import numpy as np


def exact(numbers):
    return [F(float(x)) for x in numbers]


def between(a, b):
    """Faces as (start, slope) for lo and hi, and the last time: all (1 - t) a + t b."""
    a, b = exact(a), exact(b)
    return [(a[i], b[i] - a[i]) for i in range(6)], F(1)


def swept(body, by, end=F(1)):
    body, by = exact(body), exact(by)
    return [(body[i], by[i % 3]) for i in range(6)], end


def shadow(light, occluder, reach=None):
    """All l + s (o - l), s from 1 to reach, with time s - 1: the farthest points of both bound it."""
    light, occluder = exact(light), exact(occluder)
    faces = [(occluder[i], occluder[i] - light[(i + 3) % 6]) for i in range(6)]
    return faces, None if reach is None else F(float(reach)) - 1


def times(shaft, box):
    """(first, last) time at which the moving box touches a box, or None; last is None without end."""
    faces, end = shaft
    box = exact(box)
    first, last = F(0), end
    # lo(t) <= box.hi, and box.lo <= hi(t): each as c + d t <= 0
    for i in range(3):
        for c, d in ((faces[i][0] - box[i + 3], faces[i][1]), (box[i] - faces[i + 3][0], -faces[i + 3][1])):
            if d == 0:
                if c > 0:
                    return None
            elif d > 0:
                last = -c / d if last is None else min(last, -c / d)
            else:
                first = max(first, -c / d)
    return None if last is not None and first > last else (first, last)


def kept(shaft, box):
    return times(shaft, box) is not None


def inside(shaft, box):
    """All corners are points of the shaft, which is convex."""
    corners = [[box[i + 3 * (c >> i & 1)] for i in range(3)] for c in range(8)]
    return all(kept(shaft, corner + corner) for corner in corners)


def entry_time(shaft, box):
    """Rounded down to a float32."""
    touching = times(shaft, box)
    if touching is None:
        return np.float32(np.inf)
    time = np.float32(float(touching[0]))
    while F(float(time)) > touching[0]:
        time = np.nextafter(time, np.float32(-np.inf))
    return time


def first(shaft, boxes, without=()):
    """(index, time) of what is reached first; of several at the same time the lowest index."""
    reached = [(times(shaft, box)[0], i) for i, box in enumerate(boxes) if i not in without and kept(shaft, box)]
    if not reached:
        return -1, np.float32(np.inf)
    return min(reached)[1], entry_time(shaft, boxes[min(reached)[1]])


def distance(shaft, point):
    """From a point to the shaft in doubles, by halving: the distance to a moving box is convex in time."""
    faces, end = shaft
    point = [float(x) for x in point]
    starts = [(float(c), float(d)) for c, d in faces]

    def at(t):
        total = 0.0
        for i in range(3):
            lo = starts[i][0] + starts[i][1] * t
            hi = starts[i + 3][0] + starts[i + 3][1] * t
            total += max(lo - point[i], 0.0, point[i] - hi) ** 2
        return total**0.5

    left, right = 0.0, float(end)
    for _ in range(200):
        third = (right - left) / 3
        if at(left + third) <= at(right - third):
            right -= third
        else:
            left += third
    return at((left + right) / 2)


def bits(shafts, boxes, question):
    return np.array([[question(shaft, box) for box in boxes] for shaft in shafts], dtype=bool)
