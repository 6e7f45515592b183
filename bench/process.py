"""Runs a program and measures it."""
import os
import subprocess
import tempfile
import time


def run(command, timeout=600, directory=None):
    """(exit code or None after a timeout, output, wall seconds, peak bytes) of a process."""
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
