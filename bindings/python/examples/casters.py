"""What can cast a shadow of an area light on a receiver: drawn from the side with Matplotlib."""

import sys

import matplotlib
import numpy as np
import shaftcull

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.patches import Polygon, Rectangle  # noqa: E402

LIGHT = np.float32([-2, -1, 10, 1, 1, 10])
RECEIVER = np.float32([3, -1, 0, 8, 1, 0.5])
PARTS = {"outside": "#c8c8c8", "overlap": "#f0a030", "inside": "#c03028"}


def scene(count=160, seed=3):
    """Boxes in a slice of space around light and receiver."""
    random = np.random.default_rng(seed)
    lo = random.random((count, 3)) * [18, 0.5, 9] + [-6, -0.25, 0.75]
    lo = lo.astype(np.float32)
    return np.hstack([lo, lo + random.random((count, 3), dtype=np.float32) * np.float32(0.8) + np.float32(0.1)])


def classified(boxes):
    kept, inside = shaftcull.BoxTree(boxes).classify(LIGHT, RECEIVER)
    return {"outside": ~kept, "overlap": kept & ~inside, "inside": inside}


def draw(boxes, path):
    figure, axes = pyplot.subplots(figsize=(8, 5), dpi=120, layout="constrained")
    # The shaft from the side: the hull of both rectangles.
    hull = [(-2, 10), (1, 10), (8, 0.5), (8, 0), (3, 0)]
    axes.add_patch(Polygon(hull, closed=True, facecolor="#fff3b0", edgecolor="#b09000"))
    for name, which in classified(boxes).items():
        for box in boxes[which]:
            axes.add_patch(Rectangle(box[[0, 2]], *(box[[3, 5]] - box[[0, 2]]), color=PARTS[name], alpha=0.85, lw=0))
        axes.plot([], [], "s", color=PARTS[name], label=f"{name}: {which.sum()}")
    axes.plot(LIGHT[[0, 3]], [10, 10], color="black", lw=4)
    axes.add_patch(Rectangle(RECEIVER[[0, 2]], 5, 0.5, color="black"))
    axes.set(xlim=(-6.5, 13), ylim=(-0.5, 11), aspect="equal", title="What can cast a shadow on the receiver")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    figure.savefig(path)


if __name__ == "__main__":
    boxes = scene()
    print(", ".join(f"{name}: {which.sum()}" for name, which in classified(boxes).items()))
    draw(boxes, sys.argv[1] if len(sys.argv) > 1 else "casters.png")
