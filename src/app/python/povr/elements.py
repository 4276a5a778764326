"""Scenes of Python objects.

An element is a class with the name of a word of the language, and its arguments are what the block of that word holds,
in order: other elements, words and other text as ``str``, numbers, and vectors as tuples, lists or arrays.

>>> scene = Scene(
...     Camera("location", (0, 2, -5), "look_at", (0, 1, 0)),
...     [LightSource((-5, 9, -9), "color", "rgb 1"), Sphere((0, 1, 0), 1, Pigment("color", "rgb", (1, 0, 0)))],
... )
>>> scene.render(width=160, height=120).shape
(120, 160, 3)
"""

import copy
import re
from numbers import Real

_BLOCKS = """
    Background BicubicPatch Blob BlackHole Bokeh BoundedBy Box BumpMap Camera ClippedBy Collect Component Composite
    Cone ContainedBy Cubic Cylinder Default Density Difference Disc FaceIndices Facets Finish Fog Function
    GlobalSettings HeightField ImageMap ImagePattern Interior InteriorTexture Intersection Irid Isosurface
    JuliaFractal Lathe LightGroup LightSource LooksLike Material MaterialMap Media Merge Mesh Mesh2 Normal
    NormalIndices NormalVectors Object Ovus Parametric Pattern Photons Pigment PigmentPattern Plane Poly Polygon
    Polynomial Prism ProjectedThrough Quadric Quartic Radiosity Rainbow Reflection Scattering Sky SkySphere Slope
    SmoothTriangle Sor Sphere SphereSweep Spline Subsurface Superellipsoid Text Texture TextureList Torus Transform
    Triangle Union UvIndices UvVectors VertexVectors Warp
""".split()

_MAPS = "ColorMap ColourMap DensityMap NormalMap PigmentMap SlopeMap TextureMap".split()

__all__ = [
    "Cylinders",
    "Element",
    "ElementMap",
    "Macro",
    "Scene",
    "Spheres",
    "Triangles",
    *_BLOCKS,
    *_MAPS,
]


def _is_bool(value):
    """True for a truth value of Python or numpy."""
    return isinstance(value, bool) or getattr(value, "dtype", None) == bool


def _component(value):
    return ("on" if value else "off") if _is_bool(value) else str(value)


def _vector(values):
    return f"<{','.join(map(_component, values))}>"


def _text(argument):
    """An argument as text of the language."""
    if isinstance(argument, (str, Element, _Rows)):
        return str(argument)
    if getattr(argument, "ndim", None) == 0:
        # A scalar of numpy, or an array that holds one.
        argument = argument[()]
    if isinstance(argument, Real) and not _is_bool(argument):
        # No sign before the parentheses can change the number.
        return f"({argument})" if argument < 0 else str(argument)
    if not hasattr(argument, "__iter__"):
        if not _is_bool(argument) and type(argument).__str__ is object.__str__:
            raise TypeError(f"{argument!r} is neither text, a number, a vector nor an element")
        return _component(argument)
    values = list(argument)
    if values and hasattr(values[0], "__iter__") and not isinstance(values[0], str):
        return ", ".join(_vector(value) for value in values)
    return _vector(values)


class Element:
    """A block of the language: its word, and what is between its braces."""

    def __init__(self, *args):
        self.args = list(args)

    @classmethod
    def word(cls):
        """The word of the block: ``light_source`` for ``LightSource``."""
        return re.sub(r"(?!^)([A-Z])", r"_\1", cls.__name__).lower()

    def copy(self):
        """A copy of the element and of all that it holds."""
        return copy.deepcopy(self)

    def add_args(self, new_args):
        """A copy with further arguments after the others."""
        new = self.copy()
        new.args += list(new_args)
        return new

    def __str__(self):
        return "%s {\n%s\n}" % (self.word(), "\n".join(_text(one) for one in self.args))

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(map(repr, self.args))})"


class ElementMap(Element):
    """A map, as ``color_map``: its arguments are the entries, each a list of a value and what belongs to it."""

    def __str__(self):
        entries = (" ".join(_text(one) for one in entry) for entry in self.args)
        return "%s {\n%s\n}" % (self.word(), "\n".join(f"[{entry}]" for entry in entries))


class Macro(Element):
    """A call of a macro: its name, and its arguments."""

    def __str__(self):
        return "%s(%s)" % (self.args[0], ", ".join(_text(one) for one in self.args[1:]))


for _base, _names in ((Element, _BLOCKS), (ElementMap, _MAPS)):
    for _name in _names:
        globals()[_name] = type(_name, (_base,), {"__module__": __name__})
        globals()[_name].__doc__ = f"``{globals()[_name].word()} {{ ... }}``"
del _base, _name, _names


def _rows(values, columns, name, dtype="f8"):
    """An array of ``columns`` numbers in a row, all finite."""
    import numpy

    array = numpy.ascontiguousarray(values, dtype)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} have the shape {array.shape}; it is (n, {columns})")
    if array.dtype.kind == "f" and not numpy.isfinite(array).all():
        raise ValueError(f"{name} are not all finite")
    return array


def _joined(radius, **points):
    """An array with the columns of arrays of points, and a radius as the last column."""
    import numpy

    points = {name: numpy.asarray(values) for name, values in points.items()}
    for name, values in points.items():
        if values.ndim != 2 or values.shape[1] != 3:
            raise ValueError(f"{name} have the shape {values.shape}; it is (n, 3)")
    count = len(next(iter(points.values())))
    numbers = numpy.empty((count, 3 * len(points) + 1))
    for at, (name, values) in enumerate(points.items()):
        if len(values) != count:
            raise ValueError(f"there are {len(values)} {name} for {count} others")
        numbers[:, 3 * at : 3 * at + 3] = values
    numbers[:, -1] = radius
    return _rows(numbers, numbers.shape[1], f"radii and {' and '.join(points)}")


def _colors(colors, count):
    """Colours as red, green, blue, filter and transmit."""
    import numpy

    colors = numpy.asarray(colors)
    if colors.ndim == 1:
        colors = numpy.broadcast_to(colors, (count, colors.size))
    if colors.ndim != 2 or not 3 <= colors.shape[1] <= 5 or len(colors) != count:
        raise ValueError(f"colors have the shape {colors.shape}; it is ({count}, 3), with filter and transmit 4 or 5")
    padded = numpy.zeros((count, 5), "f4")
    padded[:, : colors.shape[1]] = colors
    return _rows(padded, 5, "colors", "f4")


class _Rows:
    """Objects made of the rows of arrays. Other arguments are the attributes of each of them."""

    _kind = ""
    _model = "sphere { 0, 1"
    _numbers = None

    def __init__(self, attributes, colors, count):
        self.args = list(attributes)
        self.colors = None if colors is None else _colors(colors, count)

    def _attributes(self, color=(0, 0, 0, 0, 0)):
        """The attributes as text; a colour takes the place of the pigment of the top layer."""
        texts = [_text(one) for one in self.args]
        if self.colors is not None:
            texts.append(f"pigment {{ color rgbft {_vector(color)} }}")
        return "\n".join(texts)

    def rows(self):
        """The arrays for the compiled module."""
        return {
            "kind": self._kind,
            "numbers": self._numbers.tobytes(),
            "colors": None if self.colors is None else self.colors.tobytes(),
            "faces": None,
            "normals": None,
        }

    def model(self):
        """The text of an object with the attributes, from which the compiled module takes them."""
        return "%s\n%s\n}" % (self._model, self._attributes())

    def __len__(self):
        return len(self._numbers)

    def __str__(self):
        colors = [(0, 0, 0, 0, 0)] * len(self) if self.colors is None else self.colors.tolist()
        items = zip(self._numbers.tolist(), colors)
        return "\n".join(f"{self._item(row)}\n{self._attributes(color)}\n}}" for row, color in items)


class Spheres(_Rows):
    """Spheres from arrays, as many as there are centres.

    :param centers: array of the shape (n, 3).
    :param radius: one radius, or an array of the shape (n,).
    :param attributes: what all spheres have: ``Finish("phong", 1)``, ``"no_shadow"``, transforms, ...
    :param colors: a colour, or an array of the shape (n, 3), (n, 4) with filter, or (n, 5) with filter and transmit. It
        takes the place of the pigment.
    """

    _kind = "sphere"

    def __init__(self, centers, radius, *attributes, colors=None):
        self._numbers = _joined(radius, centers=centers)
        super().__init__(attributes, colors, len(self._numbers))

    @staticmethod
    def _item(row):
        return f"sphere {{ {_vector(row[:3])}, {row[3]}"


class Cylinders(_Rows):
    """Cylinders from arrays, as many as there are ends.

    :param starts: array of the shape (n, 3).
    :param ends: array of the shape (n, 3).
    :param radius: one radius, or an array of the shape (n,).
    :param attributes: as of ``Spheres``.
    :param colors: as of ``Spheres``.
    :param bool open: leaves out the caps.
    :raises ValueError: when drawn, if both ends of a cylinder coincide.
    """

    def __init__(self, starts, ends, radius, *attributes, colors=None, open=False):
        self._numbers = _joined(radius, starts=starts, ends=ends)
        super().__init__(attributes, colors, len(self._numbers))
        self._kind = "open cylinder" if open else "cylinder"

    def _item(self, row):
        caps = " open" if self._kind == "open cylinder" else ""
        return f"cylinder {{ {_vector(row[:3])}, {_vector(row[3:6])}, {row[6]}{caps}"


class Triangles(_Rows):
    """A mesh from arrays.

    :param vertices: array of the shape (n, 3); in single precision, as POV-Ray stores it.
    :param faces: array of the shape (m, 3): for each triangle the indices of its vertices, from 0. Without it each
        three vertices in a row are a triangle.
    :param attributes: what the mesh has: textures, transforms, ...
    :param normals: array of the shape (n, 3): the normals of the vertices, for smooth shading.
    :param colors: as of ``Spheres``, one for each triangle.
    :raises ValueError: when drawn, if an index is out of range.
    """

    _kind = "mesh"
    _model = "mesh { triangle { 0, x, y }"

    def __init__(self, vertices, faces=None, *attributes, normals=None, colors=None):
        import numpy

        self._numbers = _rows(vertices, 3, "vertices")
        if faces is None:
            faces = numpy.arange(len(self._numbers) // 3 * 3).reshape(-1, 3)
        faces = numpy.asarray(faces)
        if faces.size and faces.dtype.kind not in "iu":
            raise ValueError(f"faces are of {faces.dtype}; indices are integers")
        if faces.size and (faces.min() < 0 or faces.max() >= len(self._numbers)):
            raise ValueError(f"faces have indices from {faces.min()} to {faces.max()} of {len(self._numbers)} vertices")
        self.faces = _rows(faces, 3, "faces", "u4")
        self.normals = None if normals is None else _rows(normals, 3, "normals")
        if normals is not None and len(self.normals) != len(self._numbers):
            raise ValueError(f"there are {len(self.normals)} normals for {len(self._numbers)} vertices")
        super().__init__(attributes, colors, len(self.faces))

    def rows(self):
        return {
            **super().rows(),
            "faces": self.faces.tobytes(),
            "normals": None if self.normals is None else self.normals.tobytes(),
        }

    def __len__(self):
        return len(self.faces)

    def _texture(self, color):
        """The texture of a triangle of its own colour: what the mesh has, and the pigment."""
        parts = []
        for one in self.args:
            if isinstance(one, Texture):
                parts += [_text(part) for part in one.args]
            elif isinstance(one, (Finish, Normal)):
                parts.append(_text(one))
        return "texture {\n%s\npigment { color rgbft %s }\n}" % ("\n".join(parts), _vector(color))

    def __str__(self):
        import numpy

        def listed(word, values):
            return f"{word} {{ {len(values)},\n{','.join(_vector(value) for value in values.tolist())}\n}}"

        parts = [listed("vertex_vectors", self._numbers)]
        if self.normals is not None:
            parts.append(listed("normal_vectors", self.normals))
        if self.colors is None:
            parts.append(listed("face_indices", self.faces))
        else:
            palette, of_faces = numpy.unique(self.colors, axis=0, return_inverse=True)
            textures = "\n".join(self._texture(color) for color in palette.tolist())
            parts.append(f"texture_list {{ {len(palette)},\n{textures}\n}}")
            faces = zip(self.faces.tolist(), of_faces.ravel().tolist())
            faces = ",".join(f"{_vector(face)},{texture}" for face, texture in faces)
            parts.append(f"face_indices {{ {len(self.faces)},\n{faces}\n}}")
        return "mesh2 {\n%s\n%s\n}" % ("\n".join(parts), self._attributes())


class Scene:
    """A scene: a camera, objects and lights, and what surrounds them.

    :param camera: a ``Camera``.
    :param objects: elements, text, and ``Spheres``, ``Cylinders`` and ``Triangles``.
    :param atmospheric: ``Background``, ``Fog``, ``Media``, ``Rainbow``, ``SkySphere``, ...
    :param included: names of files to include.
    :param defaults: contents of ``#default``.
    :param global_settings: contents of ``global_settings``: text and elements.
    :param declares: declarations as text: ``"Red = color rgb <1, 0, 0>"``.
    :param version: the language version of the scene.
    """

    #: Columns and rows of the picture that a notebook shows.
    notebook_size = (480, 360)

    def __init__(
        self,
        camera,
        objects=(),
        atmospheric=(),
        included=(),
        defaults=(),
        global_settings=(),
        declares=(),
        version=3.7,
    ):
        self.camera = camera
        self.objects = list(objects)
        self.atmospheric = list(atmospheric)
        self.included = list(included)
        self.defaults = list(defaults)
        self.global_settings = list(global_settings)
        self.declares = list(declares)
        self.version = version

    def _before(self):
        """The text before the objects, which they may refer to."""
        lines = [] if self.version is None else [f"#version {self.version};"]
        lines += [f'#include "{name}"' for name in self.included]
        lines += [f"#declare {text};" for text in self.declares]
        lines += ["#default {\n%s\n}" % _text(one) for one in self._defaults()]
        settings = "\n".join(_text(one) for one in self.global_settings)
        return lines + ["global_settings {\n%s\n}" % settings]

    def _defaults(self):
        return self.defaults

    def text(self):
        """The scene as text, without the objects of arrays."""
        objects = [one for one in self.objects if not isinstance(one, _Rows)]
        rest = [*objects, self.camera, *self.atmospheric]
        return "\n".join([*self._before(), *map(_text, rest)])

    def parts(self):
        """The text that ends with one model for each array, and the arrays, for the compiled module."""
        arrays = [one for one in self.objects if isinstance(one, _Rows) and len(one)]
        return "\n".join([self.text(), *(one.model() for one in arrays)]), [one.rows() for one in arrays]

    def __str__(self):
        arrays = [str(one) for one in self.objects if isinstance(one, _Rows)]
        return "\n".join([self.text(), *arrays])

    def copy(self):
        """A copy of the scene and of all that it holds."""
        return copy.deepcopy(self)

    def set_camera(self, new_camera):
        """A copy with another camera."""
        new = self.copy()
        new.camera = new_camera
        return new

    def add_objects(self, objs):
        """A copy with further objects."""
        new = self.copy()
        new.objects += list(objs)
        return new

    def render(self, **options):
        """Renders the scene to an array: ``povr.render`` with its options."""
        from .rendering import render

        return render(self, **options)

    def _repr_png_(self):
        from .rendering import png

        width, height = self.notebook_size
        return png(self, width=width, height=height, antialias=True)
