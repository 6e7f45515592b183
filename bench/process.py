"""Runs a program and measures it."""
import os
import subprocess
import sys
import tempfile
import time

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


def run(command, timeout=600, directory=None, memory=0):
    """(exit code or None after a timeout, output, wall seconds, peak bytes) of a process that finds `memory` bytes ready."""
    if memory:
        ready_memory(memory)
    with tempfile.TemporaryFile() as output:
        started = time.monotonic()
        process = subprocess.Popen([str(word) for word in command], stdout=output, stderr=subprocess.STDOUT, cwd=directory)
        late = False
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if not late and time.monotonic() - started > timeout:
                process.kill()
                late = True
            time.sleep(0.0005)
        seconds = time.monotonic() - started
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read().decode(errors="replace")
    return None if late else process.returncode, text, seconds, usage.ru_maxrss * 1024
