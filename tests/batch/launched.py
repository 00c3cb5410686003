# SPDX-License-Identifier: MIT
"""The program on ranks: how tests start it, and kill it. The words after run.py's CASE say which program, and how."""
import os
import signal
import subprocess
import sys
import time

program, mpirun = sys.argv[2:4]
# Open MPI starts more ranks than there are cores, and binds none to one, if it is told so; 4 and 5 by other names.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                  OMPI_MCA_hwloc_base_binding_policy="none", PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe")
# Of launchers that this test was itself started by.
for name in list(os.environ):
    if name.startswith(("OMPI_COMM_", "PMIX_", "PMI_", "SLURM_STEP_")):
        del os.environ[name]


def launch(ranks):
    """The words that start so many ranks; none for one process alone."""
    if ranks == 0:
        return []
    return [mpirun, "-n", str(ranks)] if mpirun else None


def can_launch():
    words = launch(5)
    return words is not None and subprocess.run([*words, "true"], capture_output=True, check=False).returncode == 0


def content(path):
    with open(path, "rb") as file:
        return file.read()


def take_files():
    """Contents of all files by name, which are removed."""
    files = {name: content(name) for name in os.listdir() if os.path.isfile(name)}
    for name in files:
        os.remove(name)
    return files


def own_lines(done):
    """What the program itself said, without progress."""
    return [line for line in done.stderr.splitlines() if line.startswith("shaftcull: ")]


def descendants(pid):
    found = []
    for task in os.listdir(f"/proc/{pid}/task"):
        try:
            with open(f"/proc/{pid}/task/{task}/children", encoding="ascii") as file:
                children = [int(child) for child in file.read().split()]
        except OSError:
            continue
        for child in children:
            found += [child]
            if os.path.exists(f"/proc/{child}"):
                found += descendants(child)
    return found


def is_rank(pid):
    try:
        return os.path.samefile(os.readlink(f"/proc/{pid}/exe"), program)
    except OSError:
        return False


def stored_blocks(folder):
    return sum(name.startswith("block-") for _, _, names in os.walk(folder) for name in names)


def interrupt_after(blocks, folder, command):
    """Sends Ctrl-C when so many blocks are stored in the folder. Returns standard error of the program."""
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as running:
        while stored_blocks(folder) < blocks and running.poll() is None:
            time.sleep(0.001)
        running.send_signal(signal.SIGINT)
        _, said = running.communicate(timeout=60)
    assert running.returncode == 128 + signal.SIGINT, (running.returncode, said)
    assert f"finished results are in {folder}; run the same command again to resume" in said, said
    return said


def kill_one(running, chance, is_time, how=signal.SIGKILL):
    """Sends a signal to a rank when it is time, and waits for the end. False if all ended before."""
    while running.poll() is None:
        if not is_time():
            continue
        try:
            ranks = [pid for pid in [running.pid, *descendants(running.pid)] if is_rank(pid)]
            os.kill(chance.choice(ranks), how)
            running.communicate(timeout=60)
            return True
        except (IndexError, OSError):
            continue  # not there yet, or there no more
    running.communicate()
    return False
