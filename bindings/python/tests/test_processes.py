# SPDX-License-Identifier: MIT
"""Threads, memory, interrupts and processes."""

import os
import signal
import subprocess
import sys
import threading
import time
import tracemalloc

import numpy as np
import pytest
import shaftcull as sc


def run(program, *arguments, command=(), **options):
    """A program in an interpreter of its own."""
    return subprocess.run(
        [*command, sys.executable, "-c", program, *arguments], capture_output=True, text=True, timeout=240, **options
    )


def long_shafts(boxes, count=20_000):
    """Shafts that keep much, so that all of them together take long."""
    return sc.Shafts.between(np.repeat(boxes[:100], count // 100, axis=0), boxes[100])


def test_the_interpreter_lock_is_released(million):
    """While one thread waits for answers, another one counts."""
    tree, stream = sc.BoxTree(million), sc.BoxStream(million)
    shafts = long_shafts(million, 200)
    one = sc.Shafts.between(million[:, :].min(0), million.max(0))
    asking = {
        "building": lambda: sc.BoxTree(million),
        "updating": lambda: tree.update(million),
        "one shaft": lambda: stream.count(one),
        "bits": lambda: stream.cull(shafts[:100]),
        "lists": lambda: stream.list(shafts),
        "first_contact": lambda: stream.first_contact(shafts),
    }
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)  # nobody takes the lock from a thread that does not give it
    try:
        for what, ask in asking.items():
            counted, done = 0, threading.Event()
            start = threading.Event()

            def work():
                start.wait()
                for _ in range(300):  # on a busy machine, the other thread may miss some
                    ask()
                    if counted > 3:
                        break
                done.set()

            worker = threading.Thread(target=work)
            worker.start()
            start.set()
            while not done.is_set():
                counted += 1
                time.sleep(0.0001)  # gives the lock, and wants it back
            worker.join()
            # Calls that kept the lock would let this thread run before and after them only.
            assert counted > 3, what
    finally:
        sys.setswitchinterval(interval)


def test_threads_ask_at_once_and_get_the_same(million):
    tree = sc.BoxTree(million[:100_000])
    shafts = sc.Shafts.between(million[:500], million[500:1000])
    wanted = tree.count(shafts)
    found = [None] * 8

    def ask(i):
        found[i] = [tree.count(shafts) for _ in range(5)]

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for counts in found:
        np.testing.assert_array_equal(counts, [wanted] * 5)


def test_a_change_while_another_thread_asks_is_refused(million):
    tree = sc.BoxTree(million)
    shafts = long_shafts(million)
    stop = threading.Event()
    refused = []

    def ask():
        while not stop.is_set():
            try:
                tree.count(shafts[:200])
            except RuntimeError as error:  # while the tree is changed
                refused.append(str(error))

    asking = threading.Thread(target=ask)
    asking.start()
    try:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            time.sleep(0.001)  # the other thread's turn
            try:
                tree.update(million)
            except RuntimeError as error:
                assert "another thread uses this object" in str(error)
                break
        else:
            pytest.fail("no change met a question")
    finally:
        stop.set()
        asking.join()
    assert all("another thread is changing this object" in error for error in refused)
    tree.update(million)


def resident():
    with open("/proc/self/statm") as numbers:
        return int(numbers.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc to measure memory with")
def test_memory_is_not_copied_where_it_can_be_viewed(million):
    size = million.nbytes
    columns = np.asfortranarray(million)
    shaft = sc.Shafts.between(million[0], million[1])
    sc.BoxView(columns[:1000]).count(shaft)
    before = resident()
    view = sc.BoxView(columns)
    view.count(shaft)
    assert resident() - before < size / 10
    # Streams and trees copy once, whatever the layout: into memory of theirs, without another array on the way.
    tracemalloc.start()
    for given in (million, columns, million.reshape(-1, 2, 3), (columns[:, :3], columns[:, 3:]), tuple(columns.T)):
        stream = sc.BoxStream(given)
        assert stream.memory_bytes < 1.001 * size
        tree = sc.BoxTree(given)
        assert tree.memory_bytes < 1.3 * size
    largest = tracemalloc.get_traced_memory()[1]  # NumPy's arrays are traced, the library's memory is not
    tracemalloc.stop()
    assert largest < size / 10


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc to measure memory with")
def test_memory_is_given_back(million):
    tree = sc.BoxTree(million)
    everything = np.hstack([million[:, :3].min(0), million[:, 3:].max(0)])
    shafts = sc.Shafts.between(np.tile(everything, (20, 1)), everything)
    asking = {
        "lists": (lambda: tree.list(shafts), 80e6),
        "bits": (lambda: tree.cull(shafts), 20e6),
        "one list": (lambda: tree.list(shafts[0], times=True), 8e6),
        "shafts": (lambda: sc.Shafts.between(million[:50_000], everything), 40e6),
        "trees": (lambda: sc.BoxTree(million), 28e6),
        "streams": (lambda: sc.BoxStream(million), 24e6),
        "views": (lambda: sc.BoxView(np.asfortranarray(million)), 24e6),
    }
    for what, (ask, size) in asking.items():
        for _ in range(6):  # allocators keep some memory at first
            ask()
        before = resident()
        for _ in range(10):
            ask()
        assert resident() - before < 2.5 * size, what


INTERRUPTED = """
import os, signal, sys, threading, time
import numpy as np
import shaftcull as sc

random = np.random.default_rng(1)
lo = random.random((1_000_000, 3), dtype=np.float32) * 100
boxes = np.hstack([lo, lo + 1])
shafts = sc.Shafts.between(np.repeat(boxes[:1000], 100, axis=0), boxes[7])
tree, stream = sc.BoxTree(boxes), sc.BoxStream(boxes)
ask = {
    "count": lambda: stream.count(shafts),
    "list": lambda: [tree.list(shafts) for _ in range(1000)],
    "cull": lambda: [stream.cull(shafts[:1000], packed=True) for _ in range(1000)],
    "first_contact": lambda: [stream.first_contact(shafts)],
    "times": lambda: [tree.list(shafts, times=True) for _ in range(1000)],
}[sys.argv[1]]
sent = []
def interrupt():
    sent.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)
threading.Timer(1.0, interrupt).start()
try:
    ask()
except KeyboardInterrupt:
    late = time.monotonic() - sent[0]
    tree.update(boxes)  # nobody is noted as asking any more
    print("interrupted", late)
else:
    print("not interrupted")
"""


@pytest.mark.parametrize("question", ["count", "list", "cull", "first_contact", "times"])
def test_control_c_ends_a_long_call(question):
    done = run(INTERRUPTED, question)
    assert done.returncode == 0, done.stderr
    word, seconds = done.stdout.split()
    # Within a second on a machine that has nothing else to do; tests run beside others.
    assert word == "interrupted" and float(seconds) < 5, done.stdout


def test_handlers_of_signals_run_and_the_call_goes_on(million):
    heard = []
    before = signal.signal(signal.SIGALRM, lambda *_: heard.append(1))
    try:
        shafts = long_shafts(million)
        stream = sc.BoxStream(million[:200_000])
        signal.setitimer(signal.ITIMER_REAL, 0.05, 0.05)
        counts = stream.count(shafts)
        signal.setitimer(signal.ITIMER_REAL, 0)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert heard
    np.testing.assert_array_equal(counts[::1000], sc.BoxTree(million[:200_000]).count(shafts[::1000]))


FORKED = """
import os
import numpy as np
import shaftcull as sc

boxes = np.tile(np.float32([0, 0, 0, 1, 1, 1]), (1000, 1))
shafts = sc.Shafts.between(boxes, boxes[0])
stream = sc.BoxStream(boxes)
child = os.fork()
if child == 0:  # before the first parallel call
    os._exit(0 if stream.count(shafts)[0] == 1000 else 1)
assert os.waitpid(child, 0)[1] == 0
tree = sc.BoxTree(boxes)
stream.count(shafts)
child = os.fork()
if child == 0:  # after it
    for ask in (lambda: tree.count(shafts), lambda: sc.BoxTree(boxes), lambda: tree.update(boxes)):
        try:
            ask()
            os._exit(1)
        except RuntimeError as error:
            if "forked" not in str(error):
                os._exit(2)
    os._exit(0 if tree.count(shafts[0]) == 1000 and len(tree.list(shafts[0])) == 1000 else 3)
assert os.waitpid(child, 0)[1] == 0
print("fine")
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork()")
def test_a_forked_child_is_told_instead_of_hanging():
    done = run(FORKED)
    assert done.stdout == "fine\n", done.stderr


SCENE = """
import numpy as np
import shaftcull as sc

def scene():
    random = np.random.default_rng(2)
    lo = random.random((50_000, 3), dtype=np.float32) * 100
    return np.hstack([lo, lo + random.random((50_000, 3), dtype=np.float32)])

def pairs(count):
    return np.random.default_rng(3).integers(0, 50_000, (count, 2))

def answers(boxes, of):
    tree = sc.BoxTree(boxes)
    shafts = sc.Shafts.between(boxes, boxes, pairs=of)
    lists = tree.list(shafts, exclude_each=of)
    first, times = tree.first_contact(shafts, exclude_each=of)
    return np.diff(lists.offsets), lists.indices, first, times, tree.occluded(shafts)
"""


def test_processes_of_mpi_get_the_bits_of_one(tmp_path):
    pytest.importorskip("mpi4py", reason="no mpi4py (Debian: python3-mpi4py)")
    program = tmp_path / "shards.py"
    program.write_text(
        SCENE
        + """
from mpi4py import MPI

world = MPI.COMM_WORLD
assert world.size == 2
boxes = scene() if world.rank == 0 else np.empty((50_000, 6), dtype=np.float32)
world.Bcast(boxes)
mine = np.array_split(pairs(100_000), world.size)[world.rank]
parts = world.gather(answers(boxes, mine))
if world.rank == 0:
    joined = [np.concatenate(part) for part in zip(*parts)]
    alone = answers(boxes, pairs(100_000))
    assert all(x.dtype == y.dtype and x.tobytes() == y.tobytes() for x, y in zip(joined, alone))
    print("same bits of", len(joined[1]))
"""
    )
    mpirun = ["mpirun", "--oversubscribe", "-n", "2"]
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    try:
        done = subprocess.run(
            [*mpirun, sys.executable, program], capture_output=True, text=True, timeout=300, env=environment
        )
    except FileNotFoundError:
        pytest.skip("no mpirun (Debian: openmpi-bin)")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("same bits of ") and int(done.stdout.split()[-1]) > 100_000


DASK = (
    SCENE
    + """
import dask

if __name__ == "__main__":
    boxes, every = scene(), pairs(100_000)
    alone = answers(boxes, every)
    shards = [dask.delayed(answers)(boxes, part) for part in np.array_split(every, 2)]
    for scheduler in ("threads", "processes"):
        parts = dask.compute(*shards, scheduler=scheduler, num_workers=2)
        joined = [np.concatenate(part) for part in zip(*parts)]
        assert all(x.tobytes() == y.tobytes() for x, y in zip(joined, alone))
    import dask.array
    lazy = dask.array.from_array(boxes, chunks=(10_000, 6))
    assert sc.BoxTree(lazy).count(boxes[0], boxes[1]) == sc.BoxTree(boxes).count(boxes[0], boxes[1])
    print("same bits")
"""
)


def test_workers_of_dask_get_the_bits_of_one(tmp_path):
    pytest.importorskip("dask", reason="no dask (Debian: python3-dask)")
    program = tmp_path / "shards.py"
    program.write_text(DASK)
    done = subprocess.run([sys.executable, program], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "same bits\n"


def test_instruction_sets_give_the_same_bits(million):
    boxes = million[:20_000]
    shafts = sc.Shafts.between(million[:300], million[300:600])
    isas = sc.available_isas()
    assert sc.active_isa() in isas and "scalar" in isas and sc.concurrency() >= 1
    best, answers = sc.active_isa(), []
    try:
        for isa in isas:
            sc.select_isa(isa)
            assert sc.active_isa() == isa
            answers.append(sc.BoxStream(boxes).cull(shafts, packed=True).tobytes())
    finally:
        sc.select_isa(best)
    assert len(set(answers)) == 1
