"""Runs a renderer and measures time and memory."""

import os
import shutil
import subprocess
import tempfile
import time


def run(command, folder):
    """Runs a command in a folder: wall seconds, processor seconds, peak memory in MB, its output.

    A process begins as a copy of the one that starts it, whose memory counts as its own: GNU time, where it is
    installed, is a small one.
    """
    timer = shutil.which("time")
    with tempfile.TemporaryFile() as said, tempfile.NamedTemporaryFile("r") as peak:
        if timer:
            command = [timer, "-q", "-f", "%M", "-o", peak.name, *command]
        start = time.perf_counter()
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=said, stderr=said)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read().decode(errors="replace")
        kibibytes = float(peak.read() or used.ru_maxrss)
    if process.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))} fails:\n{text[-2000:]}")
    return {"wall": wall, "cpu": used.ru_utime + used.ru_stime, "memory": kibibytes / 1024, "said": text}
