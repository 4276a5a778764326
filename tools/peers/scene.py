"""A scene of the bench, parsed from its file, so that all renderers get the same numbers.

Supports only the statements that `tools/bench` writes for spheres, cylinders and its mesh.
"""

import math
import re

NUMBER = r"(-?[\d.]+)"
VECTOR = rf"<{NUMBER}, {NUMBER}, {NUMBER}>"
CAMERA = re.compile(rf"camera {{ location <0, 0, {NUMBER}> look_at 0 angle {NUMBER} }}\n")
LIGHT = re.compile(rf"light_source {{ {VECTOR}, rgb {NUMBER} }}\n")
BACKGROUND = re.compile(rf"background {{ rgb {VECTOR} }}\n")
SPHERE = re.compile(rf"sphere {{ {VECTOR}, {NUMBER} pigment {{ rgb {VECTOR} }} }}\n")
TUBE = re.compile(rf"cylinder {{ {VECTOR}, {VECTOR}, {NUMBER} open pigment {{ rgb {VECTOR} }} }}\n")
MESH = re.compile(
    r"mesh2 { vertex_vectors { \d+,(.*) } face_indices { \d+,(.*) }"
    rf" pigment {{ rgb {VECTOR} }} rotate {NUMBER}\*x }}\n", re.S)

# A centre, a radius, a colour.
SPHERE_NUMBERS = SPHERE.groups
# The lines before the first object.
HEAD_LINES = 6

# POV-Ray's camera has a picture plane of 1.33 by 1 whatever the shape of the picture.
RIGHT = 1.33


class Unsaid(Exception):
    """The scene has features that the other renderer lacks."""


class Scene:
    """A camera on the z axis that looks at the origin, lights, and either spheres and cylinders or a mesh.

    `camera` is its position on the axis, `direction` the distance of the picture plane, `lights` are points with a
    brightness each, `background` is linear."""

    def __init__(self, path):
        self.path = path
        with open(path, encoding="ascii") as file:
            self.head = "".join(next(file, "") for _ in range(HEAD_LINES))
            self.is_mesh = file.readline().startswith("mesh2")
        camera, background = CAMERA.search(self.head), BACKGROUND.search(self.head)
        if not camera or not background:
            raise Unsaid(f"{path.stem} has a camera of its own")
        self.camera, angle = map(float, camera.groups())
        self.direction = RIGHT / 2 / math.tan(math.radians(angle) / 2)
        self.lights = [tuple(map(float, light)) for light in LIGHT.findall(self.head)]
        self.background = tuple(map(float, background.groups()))

    def objects(self):
        """Each object's numbers as written: seven of a sphere (centre, radius, colour), ten of a cylinder."""
        with open(self.path, encoding="ascii") as file:
            file.seek(len(self.head))
            for line in file:
                known = SPHERE.fullmatch(line) or TUBE.fullmatch(line)
                if not known:
                    raise Unsaid(f"{self.path.stem} has more than balls and tubes")
                yield known.groups()

    def mesh(self):
        """The vertices of a mesh, its triangles as three indices each, and its colour."""
        with open(self.path, encoding="ascii") as file:
            file.seek(len(self.head))
            mesh = MESH.fullmatch(file.read())
        if not mesh:
            raise Unsaid(f"{self.path.stem} is no mesh")
        corners, faces, *colour, degrees = mesh.groups()
        cos, sin = math.cos(math.radians(float(degrees))), math.sin(math.radians(float(degrees)))
        points = [(float(x), float(y) * cos - float(z) * sin, float(y) * sin + float(z) * cos)
                  for x, y, z in re.findall(VECTOR, corners)]
        return points, [tuple(map(int, face)) for face in re.findall(VECTOR, faces)], colour


def translated(path, folder, suffix, words):
    """The scene in another renderer's format, in a file that is written if it is older than the scene.

    `words` yields the lines of the file from a `Scene`; raises `Unsaid` if there are none for it."""
    file = folder / f"{path.stem}{suffix}"
    if not file.exists() or file.stat().st_mtime < path.stat().st_mtime:
        unfinished = file.with_suffix(f"{suffix}.part")
        try:
            with open(unfinished, "w", encoding="ascii") as out:
                out.writelines(words(Scene(path)))
            unfinished.rename(file)
        finally:
            unfinished.unlink(missing_ok=True)
    return file
