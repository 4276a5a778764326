"""Embree's bare rays: those of a picture of balls by one thread, in packets of 16, with no shading (libembree-dev)."""

import pathlib
import re
import shutil
import subprocess

from . import pictures
from .process import run
from .scene import BALL_NUMBERS, RIGHT, Scene, Unsaid, translated

SOURCE = pathlib.Path(__file__).with_name("embree_spheres.cpp")

# The share by which the number of rays may differ from povr's: single precision, and edges.
UNLIKE = 0.005


def words(scene):
    """The lines of the list that the program reads."""
    yield f"camera {scene.camera} {scene.direction:.9f} {RIGHT}\n"
    for x, y, z, _ in scene.lights:
        yield f"light {x} {y} {z}\n"
    for numbers in scene.objects():
        if len(numbers) != BALL_NUMBERS:
            raise Unsaid(f"{scene.path.stem} has more than balls")
        yield f"ball {' '.join(numbers[:4])}\n"


class Embree:
    """A program of ours around the library, built anew for each run of the bench, for the processor it runs on."""

    name = "embree"
    columns = (("embree s", "trace", ".3f"), ("povr/embree", "povr_over", ".2f"))

    def __init__(self, kept, size):
        self.kept, self.size = kept, size
        self.program = kept / "embree_spheres"

    def missing(self):
        if not shutil.which("g++"):
            return "there is no `g++` to build its program"
        command = ["g++", "-O3", "-march=native", str(SOURCE), "-o", str(self.program), "-lembree3"]
        built = subprocess.run(command, capture_output=True, text=True)
        if built.returncode != 0:
            fault = next((line for line in built.stderr.splitlines() if "error" in line), "g++ fails")
            return f"its program cannot be built ({fault}); apt-get install libembree-dev"
        return None

    def measure(self, path, _threads, folder):
        """As `run`, with processor seconds of casting (`trace`) and of making the tree, and the rays by kind.

        None if the scene has more than balls."""
        try:
            balls = translated(path, self.kept, ".balls", words)
        except Unsaid:
            return None
        measured = run([str(self.program), str(balls), *map(str, self.size)], folder)
        told = dict(re.findall(r"^(\w+) ([\d.]+)$", measured["said"], re.M))
        build, trace = float(told.pop("build")), float(told.pop("cast"))
        return {**measured, "trace": trace, "build": build, "rays": {kind: int(count) for kind, count in told.items()}}

    def ratios(self, measured, ours):
        """What part of the time of the bare rays povr needs for the shaded picture: processor seconds of both."""
        return {"povr_over": ours["trace"] / measured["trace"]}

    def check(self, path, folder, measured, ours):
        """Whether its rays met balls as often as povr's did, and asked for lights as often; and a word about it."""
        covered = pictures.covered(folder / "povr.ppm", Scene(path).background)
        hits = measured["rays"]["hits"] / max(covered, 1) - 1
        shadow = measured["rays"]["shadow"] / max(ours["rays"]["shadow"], 1) - 1
        word = f"{1000 * hits:+.2f} per mille hits, {1000 * shadow:+.2f} shadow rays"
        return max(abs(hits), abs(shadow)) <= UNLIKE, word
