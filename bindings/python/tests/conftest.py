# SPDX-License-Identifier: MIT
import signal

import numpy as np
import pytest

# Ctrl-C is tested. In what a shell runs in the background, and in children of that, it would be ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)


def some_boxes(seed, count, side=8):
    """Boxes on a grid, so that many touch, some of which are flat."""
    random = np.random.default_rng(seed)
    lo = random.integers(-side, side, (count, 3))
    size = random.integers(0, 4, (count, 3))
    return (np.hstack([lo, lo + size]) / 2).astype(np.float32)


@pytest.fixture
def boxes():
    return some_boxes(1, 150)


@pytest.fixture
def a():
    return some_boxes(2, 40)


@pytest.fixture
def b():
    return some_boxes(3, 40)


@pytest.fixture
def million():
    """Boxes for calls that take a while."""
    random = np.random.default_rng(4)
    lo = random.random((1_000_000, 3), dtype=np.float32) * 100
    return np.hstack([lo, lo + random.random((1_000_000, 3), dtype=np.float32)])
