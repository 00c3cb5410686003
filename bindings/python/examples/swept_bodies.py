"""Bodies that fall among fixed boxes and on each other, and stop where they first touch something."""

import numpy as np
import shaftcull


def world(bodies=1000, seed=1):
    """A floor with pillars, and bodies above that do not overlap."""
    random = np.random.default_rng(seed)
    foot = random.integers(0, 60, (100, 2))
    pillars = np.column_stack([foot, np.zeros(100), foot + 3, random.integers(1, 9, 100)])
    floor = [-100, -100, -1, 200, 200, 0]
    cells = random.permutation(30 * 30 * 20)[:bodies]
    corners = np.column_stack([cells % 30, cells // 30 % 30, 5 + cells // 900]) * 2.0
    corners += random.integers(0, 2, (bodies, 3)) / 4
    return np.float32(np.vstack([floor, pillars])), np.float32(np.hstack([corners, corners + 1]))


def fall(fixed, bodies, by=-3, most_steps=200):
    """Moves all bodies down in steps, each up to its first contact, until none moves. Returns them, and the steps."""
    own = len(fixed) + np.arange(len(bodies))
    tree = shaftcull.BoxTree(np.vstack([fixed, bodies]))
    for step in range(most_steps):
        # With open contact a body slides along what is beside it.
        hit, when = tree.first_contact(shaftcull.Shafts.swept(bodies, [0, 0, by], contact="open"), exclude_each=own)
        # In a step the others stand still; times are rounded down, so a body stops just above what it hits or on it.
        down = np.where(hit < 0, 1, when) * np.float32(by)
        tops = np.where(hit < 0, -np.inf, np.vstack([fixed, bodies])[hit, 5])
        bottom = np.maximum(bodies[:, 2] + down, tops).astype(np.float32)
        if (bottom == bodies[:, 2]).all():
            return bodies, step
        bodies = bodies.copy()
        bodies[:, 2], bodies[:, 5] = bottom, bottom + np.float32(1)
        tree.update(np.vstack([fixed, bodies]))
    return bodies, most_steps


if __name__ == "__main__":
    fallen, steps = fall(*world())
    print(f"after {steps} steps nothing moves; the highest body stands at {fallen[:, 2].max()}")
