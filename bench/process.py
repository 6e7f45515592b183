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
    """Makes `size` bytes of memory ready. Virtual machines return free memory to their host, which gives it back at a few
    hundred MB/s: the first program to use it would spend most of its time on that. This runs in a separate process,
    because a child's peak memory, as the system counts it, is not below its parent's."""
    subprocess.run([sys.executable, "-I", "-S", "-c", TOUCH, str(size)], check=True)


# Memory that a large program returned keeps the host of a virtual machine busy for some seconds, which is not visible
# inside: a program on two threads took a fifth longer right after one.
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
    """Runs a process with `memory` bytes ready. After a large one there is a pause."""
    if memory:
        ready_memory(memory)
    with tempfile.TemporaryFile() as output:
        started = time.monotonic()
        process = subprocess.Popen([str(word) for word in command], stdout=output, stderr=subprocess.STDOUT, cwd=directory)
        # Waiting must take no processor time: a program on two threads needs all of it.
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
    """name -> its results. The programs take turns, so that the machine's better minutes favour none. `programs` maps names
    to functions that return a result or, on failure, None: such a program gets no further turn, and None for its
    results. `turns` is their number, or a function of the first results that returns it."""
    results = {name: [program()] for name, program in programs.items()}
    if callable(turns):
        turns = turns([first for (first,) in results.values() if first is not None])
    for _ in range(turns - 1):
        for name, program in programs.items():
            if results[name][-1] is not None:
                results[name].append(program())
    return {name: None if told[-1] is None else told for name, told in results.items()}


def apart(work, *arguments):
    """Calls a function in a separate process: a child's peak memory, as the system counts it, is not below its parent's, so
    this one must stay small."""
    worker = multiprocessing.Process(target=work, args=arguments)
    worker.start()
    worker.join()
    if worker.exitcode != 0:
        sys.exit(f"{work.__name__} failed")
