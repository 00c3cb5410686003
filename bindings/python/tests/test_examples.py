# SPDX-License-Identifier: MIT
"""The examples do what they say."""

import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest
import shaftcull

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
sys.path.insert(0, str(EXAMPLES))


def test_examples_are_short():
    for example in EXAMPLES.glob("*.py"):
        assert len(example.read_text().splitlines()) < 60, example


def test_form_factors_are_those_of_the_books():
    import form_factors

    for to_face, analytic in ((3, 0.19982), (1, 0.20004)):
        factor, tested = form_factors.form_factor(0, to_face)
        assert abs(factor - analytic) < 5e-5 and tested == 0


def test_shafts_name_every_pair_that_a_box_comes_between():
    import form_factors

    box = [0.375, 0.375, 0.375, 0.625, 0.625, 0.625]
    for to_face in (3, 1):
        factor, tested = form_factors.form_factor(0, to_face, 8, box)
        wanted, pairs = form_factors.form_factor(0, to_face, 8, box, all_pairs=True)
        assert factor == wanted < form_factors.form_factor(0, to_face, 8)[0] - 0.001
        assert 0 < tested < pairs * (0.6 if to_face == 3 else 0.4), (tested, pairs)


def test_bodies_stop_at_what_they_touch_first():
    import swept_bodies

    fixed, bodies = swept_bodies.world()
    fallen, steps = swept_bodies.fall(fixed, bodies)
    assert 5 < steps < 200
    everything = np.vstack([fixed, fallen])
    own = len(fixed) + np.arange(len(fallen))
    tree = shaftcull.BoxTree(everything)
    # None overlaps another, and each stands on something: a hair lower it would.
    np.testing.assert_array_equal(fallen[:, [0, 1, 3, 4]], bodies[:, [0, 1, 3, 4]])
    assert not tree.any(shaftcull.Shafts.between(fallen, fallen, contact="open"), exclude_each=own).any()
    hit, when = tree.first_contact(shaftcull.Shafts.swept(fallen, [0, 0, -1], contact="open"), exclude_each=own)
    assert (hit >= 0).all() and (when < 1e-6).all()
    np.testing.assert_allclose(everything[hit, 5], fallen[:, 2], atol=1e-6)
    assert len(np.unique(fallen[:, 2])) > 5 and (hit >= len(fixed)).any() and (hit == 0).any()


def test_casters_are_drawn(tmp_path):
    pytest.importorskip("matplotlib", reason="no Matplotlib (Debian: python3-matplotlib)")
    picture = tmp_path / "casters.png"
    done = subprocess.run([sys.executable, EXAMPLES / "casters.py", picture], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    numbers = [int(word) for word in done.stdout.replace(",", "").split() if word.isdigit()]
    assert sum(numbers) == 160 and min(numbers) > 5
    import casters
    from matplotlib import pyplot

    pixels = pyplot.imread(picture)
    assert pixels.shape == (600, 960, 4)
    for colour in casters.PARTS.values():
        wanted = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
        near = (abs(pixels[..., :3] - wanted).max(-1) < 0.12).sum()
        assert near > 200, colour


@pytest.fixture
def batch(tmp_path):
    """Files of boxes and shafts, and what each shaft keeps, in the order of the boxes."""
    random = np.random.default_rng(19)

    def boxes(count, size):
        lo = random.random((count, 3))
        return np.hstack([lo, lo + size * random.random((count, 3))]).astype(np.float32)

    bounds, shafts = boxes(3_000, 0.02), np.hstack([boxes(1_000, 0.1), boxes(1_000, 0.1)])
    np.save(tmp_path / "bounds.npy", bounds)
    np.save(tmp_path / "shafts.npy", shafts)
    stream = shaftcull.BoxStream(bounds)
    kept = [np.flatnonzero(stream.cull(shaftcull.Shafts.between(row[:6], row[6:]))) for row in shafts]
    return [str(tmp_path / "bounds.npy"), str(tmp_path / "shafts.npy")], kept


def test_ranks_of_mpi_count_a_file_of_shafts(batch, tmp_path):
    pytest.importorskip("mpi4py", reason="no mpi4py (Debian: python3-mpi4py)")
    files, kept = batch
    out = tmp_path / "counts.npy"
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    code = f"import batch_mpi; batch_mpi.main(*{files!r}, {str(out)!r}, block=37)"
    try:
        done = subprocess.run(
            ["mpirun", "--oversubscribe", "-n", "3", sys.executable, "-c", code],
            capture_output=True, text=True, timeout=300, cwd=EXAMPLES, env=environment,
        )
    except FileNotFoundError:
        pytest.skip("no mpirun (Debian: openmpi-bin)")
    assert done.returncode == 0, done.stderr
    np.testing.assert_array_equal(np.load(out), [len(one) for one in kept])


def test_workers_of_dask_list_a_file_of_shafts(batch, tmp_path):
    pytest.importorskip("dask", reason="no dask (Debian: python3-dask)")
    import batch_dask

    files, kept = batch
    out = tmp_path / "lists.npz"
    batch_dask.main(*files, out, block=37)
    found = np.load(out)
    np.testing.assert_array_equal(found["offsets"], np.cumsum([0, *map(len, kept)]))
    np.testing.assert_array_equal(found["indices"], np.concatenate(kept))
