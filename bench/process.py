"""Runs programs and measures them."""
import multiprocessing
import os
import subprocess
import sys
import tempfile
import threading
import time
from typing import NamedTuple

# Takes memory from the system, writes to every page of it and ends.
TOUCH = """
import mmap, sys
size = int(sys.argv[1])
block = mmap.mmap(-1, size, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
block.madvise(mmap.MADV_HUGEPAGE)
block[::4096] = bytes(-(-size // 4096))
"""


def ready_memory(size):
    """Makes the machine have `size` bytes of memory at hand. Virtual machines give memory that is free back to their host,
    from which it comes again at a few hundred MB/s: whoever took it first would pay for that with most of its time. In a process
    of its own, because a child's peak memory, as the system counts it, is not below its parent's."""
    subprocess.run([sys.executable, "-I", "-S", "-c", TOUCH, str(size)], check=True)


# Memory that a large program has given back keeps the host of a virtual machine busy for some seconds, which no count inside
# tells of: a program on two threads took a fifth longer right after one.
LARGE, REST = 512 << 20, 4.0  # bytes, seconds

# Bytes: a peak below it may be this process's own, see `apart`.
MEASURABLE = 64 << 20


class Run(NamedTuple):
    """What became of a process. `code` is None after a timeout; `cpu` is user and system time."""
    code: int | None
    output: str
    wall: float
    cpu: float
    peak: int  # bytes


def run(command, timeout=600, directory=None, memory=0):
    """Runs a process that finds `memory` bytes ready. After a large one there is a rest."""
    if memory:
        ready_memory(memory)
    with tempfile.TemporaryFile() as output:
        started = time.monotonic()
        process = subprocess.Popen([str(word) for word in command], stdout=output, stderr=subprocess.STDOUT, cwd=directory)
        # Waiting must take no time of the processor: a program on two threads has none to spare.
        late = threading.Event()

        def kill():
            late.set()
            process.kill()

        timer = threading.Timer(timeout, kill)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - started
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read().decode(errors="replace")
    if usage.ru_maxrss * 1024 > LARGE:
        time.sleep(REST)
    return Run(None if late.is_set() else process.returncode, text, wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def take_turns(programs, turns):
    """name -> its results, the programs taking turns, so that none has the machine's better minutes to itself. `programs` maps
    names to functions that give a result or, where they fail, None: such a program gets no further turn, and None for its results.
    `turns` is how many, or a function of the first results that tells it."""
    results = {name: [program()] for name, program in programs.items()}
    if callable(turns):
        turns = turns([first for (first,) in results.values() if first is not None])
    for _ in range(turns - 1):
        for name, program in programs.items():
            if results[name][-1] is not None:
                results[name].append(program())
    return {name: None if told[-1] is None else told for name, told in results.items()}


def apart(work, *arguments):
    """Calls a function in a process of its own: a child's peak memory, as the system counts it, is not below its parent's, so that
    this one must stay small."""
    worker = multiprocessing.Process(target=work, args=arguments)
    worker.start()
    worker.join()
    if worker.exitcode != 0:
        sys.exit(f"{work.__name__} failed")
