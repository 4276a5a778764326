"""Tachyon, a fast renderer of spheres, cylinders and triangles (Debian: tachyon-bin-nox)."""

import re
import shutil

from . import pictures
from .process import run
from .scene import SPHERE_NUMBERS, RIGHT, Unsaid, translated

# POV-Ray's default finish.
LOOK = "AMBIENT 0.1 DIFFUSE 0.6 SPECULAR 0 OPACITY 1"

# Tachyon truncates its linear bytes where povr rounds those of sRGB: up to two steps in light colours.
STEP = 3
# Fraction of pixels that may differ: at edges rounding may put a ray on either side. No scene has any so far.
UNLIKE = 0.002


def words(scene, size):
    """The lines of Tachyon's scene file."""
    width, height = size
    # The picture plane at distance 1. Tachyon's rays miss the middle of a pixel by half a pixel: the plane is shifted.
    right, top = RIGHT / 2 / scene.direction, 0.5 / scene.direction
    across, up = right / width, top / height
    plane = f"{-right - across:.12f} {right - across:.12f} {-top - up:.12f} {top - up:.12f}"
    yield (f"BEGIN_SCENE\nRESOLUTION {width} {height}\nCAMERA\nPROJECTION FRUSTUM\nZOOM 1\nASPECTRATIO 1\n"
           f"ANTIALIASING 0\nRAYDEPTH 5\nCENTER 0 0 {scene.camera}\nVIEWDIR 0 0 1\nUPDIR 0 1 0\n"
           f"FRUSTUM {plane}\nEND_CAMERA\n")
    for x, y, z, light in scene.lights:
        yield f"LIGHT CENTER {x} {y} {z} RAD 0.001 COLOR {light} {light} {light}\n"
    yield "BACKGROUND {} {} {}\n".format(*scene.background)
    if scene.is_mesh:
        points, faces, colour = scene.mesh()
        yield f"TEXDEF look {LOOK} COLOR {' '.join(colour)} TEXFUNC 0\n"
        corners = ["{:.9g} {:.9g} {:.9g}".format(*point) for point in points]
        for a, b, c in faces:
            yield f"TRI V0 {corners[a]} V1 {corners[b]} V2 {corners[c]} look\n"
    else:
        for numbers in scene.objects():
            *points, radius, red, green, blue = numbers
            if len(numbers) == SPHERE_NUMBERS:
                shape = f"SPHERE CENTER {' '.join(points)}"
            else:
                shape = f"FCYLINDER BASE {' '.join(points[:3])} APEX {' '.join(points[3:])}"
            yield f"{shape} RAD {radius} TEXTURE {LOOK} COLOR {red} {green} {blue} TEXFUNC 0\n"
    yield "END_SCENE\n"


class Tachyon:
    """The whole renderer, shading and shadows included."""

    name = "tachyon"
    columns = (("tachyon s", "trace", ".3f"), (" ratio", "trace_ratio", ".2f"),
               ("tachyon cpu s", "cpu", ".3f"), (" ratio", "cpu_ratio", ".2f"))

    def __init__(self, folder_of_scenes, size):
        self.folder_of_scenes, self.size = folder_of_scenes, size

    def missing(self):
        return None if shutil.which("tachyon") else "there is no `tachyon` (apt-get install tachyon-bin-nox)"

    def measure(self, path, threads, folder):
        """As `run`, and wall seconds of tracing as Tachyon reports them (`trace`). None for unsupported scenes."""
        try:
            scene = translated(path, self.folder_of_scenes, ".dat", lambda scene: words(scene, self.size))
        except Unsaid:
            return None
        measured = run(["tachyon", str(scene), "-fullshade", "-numthreads", str(threads), "-format", "PPM",
                        "-o", "tachyon.ppm"], folder)
        printed = re.search(r"Ray Tracing Time: +([\d.]+) seconds", measured["said"])
        return {**measured, "trace": float(printed.group(1))}

    def ratios(self, measured, ours):
        """The speed-up of povr: wall seconds of tracing, processor seconds of the whole process."""
        return {"trace_ratio": measured["trace"] / ours["trace_wall"], "cpu_ratio": measured["cpu"] / ours["cpu"]}

    def check(self, _path, folder, _measured, _ours):
        """Whether its picture agrees with povr's, and a remark."""
        unlike = pictures.unlike(folder / "povr.ppm", folder / "tachyon.ppm", STEP)
        return unlike <= UNLIKE, f"{100 * unlike:.2f} % of pixels off"
