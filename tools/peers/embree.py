"""Embree's ray casting at spheres, by one thread, in packets of 16, without shading (libembree-dev)."""

import pathlib
import re
import shutil
import subprocess

from . import pictures
from .process import run
from .scene import SPHERE_NUMBERS, RIGHT, Scene, Unsaid, translated

SOURCE = pathlib.Path(__file__).with_name("embree_spheres.cpp")

# Tolerance of the number of rays, relative to povr's: single precision and edges make a difference.
UNLIKE = 0.005


def words(scene):
    """The lines of the input file of the program."""
    yield f"camera {scene.camera} {scene.direction:.9f} {RIGHT}\n"
    for x, y, z, _ in scene.lights:
        yield f"light {x} {y} {z}\n"
    for numbers in scene.objects():
        if len(numbers) != SPHERE_NUMBERS:
            raise Unsaid(f"{scene.path.stem} has more than balls")
        yield f"ball {' '.join(numbers[:4])}\n"


class Embree:
    """Our program around the library, compiled in each run of the bench, for its processor."""

    name = "embree"
    columns = (("embree s", "trace", ".3f"), ("povr/embree", "povr_over", ".2f"))

    def __init__(self, folder_of_scenes, size):
        self.folder_of_scenes, self.size = folder_of_scenes, size
        self.program = folder_of_scenes / "embree_spheres"

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

        None if the scene has other shapes than spheres."""
        try:
            spheres = translated(path, self.folder_of_scenes, ".balls", words)
        except Unsaid:
            return None
        measured = run([str(self.program), str(spheres), *map(str, self.size)], folder)
        printed = dict(re.findall(r"^(\w+) ([\d.]+)$", measured["said"], re.M))
        build, trace = float(printed.pop("build")), float(printed.pop("cast"))
        return {**measured, "trace": trace, "build": build, "rays": {kind: int(count) for kind, count in printed.items()}}

    def ratios(self, measured, ours):
        """The time of povr's shaded picture over that of Embree's rays, in processor seconds."""
        return {"povr_over": ours["trace"] / measured["trace"]}

    def check(self, path, folder, measured, ours):
        """Whether its rays hit spheres as often as povr's, with as many shadow rays; and a remark."""
        covered = pictures.covered(folder / "povr.ppm", Scene(path).background)
        hits = measured["rays"]["hits"] / max(covered, 1) - 1
        shadow = measured["rays"]["shadow"] / max(ours["rays"]["shadow"], 1) - 1
        word = f"{1000 * hits:+.2f} per mille hits, {1000 * shadow:+.2f} shadow rays"
        return max(abs(hits), abs(shadow)) <= UNLIKE, word
