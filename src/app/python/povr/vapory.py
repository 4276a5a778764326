"""The interface of vapory: ``from povr.vapory import *`` in place of ``from vapory import *``.

``Scene.render`` takes vapory's arguments and draws without a program or a temporary file.
"""

import copy as _copy

from . import elements as _elements
from .elements import *
from .elements import Element as POVRayElement
from .elements import ElementMap as POVRayMap
from .errors import SceneError as _SceneError
from .rendering import png as _png
from .rendering import render as _render

__all__ = [*_elements.__all__, "POVRayElement", "POVRayMap", "render_povstring"]


class Scene(_elements.Scene):
    """A scene of vapory: its text names no language version, and ``defaults`` are left out, as in vapory 0.1.2."""

    def __init__(self, *args, **more):
        super().__init__(*args, version=None, **more)

    def _defaults(self):
        return ()

    def render(
        self,
        outfile=None,
        height=None,
        width=None,
        quality=None,
        antialiasing=None,
        remove_temp=True,
        auto_camera_angle=True,
        show_window=False,
        tempfile=None,
        includedirs=None,
        output_alpha=False,
    ):
        """Renders the scene: see ``render_povstring``.

        With ``auto_camera_angle`` the camera is as wide as ``width`` and ``height`` ask for.
        """
        scene = self
        if auto_camera_angle and width is not None and height is not None:
            scene = _copy.copy(self)
            scene.camera = self.camera.add_args(["right", [width / height, 0, 0]])
        return render_povstring(
            scene,
            outfile,
            height,
            width,
            quality,
            antialiasing,
            remove_temp,
            show_window,
            tempfile,
            includedirs,
            output_alpha,
        )


def render_povstring(
    string,
    outfile=None,
    height=None,
    width=None,
    quality=None,
    antialiasing=None,
    remove_temp=True,
    show_window=False,
    tempfile=None,
    includedirs=None,
    output_alpha=False,
):
    """Renders the text of a scene.

    :param outfile: a PNG file; ``None`` returns an array of the shape (height, width, 3), ``"ipython"`` an image of
        IPython.
    :param quality: POV-Ray's quality, 0 to 11.
    :param float antialiasing: the threshold of POV-Ray's antialiasing.
    :param includedirs: folders for included files.
    :param bool output_alpha: stores the opacity of the background in a file.
    :param remove_temp: ignored, as ``show_window`` and ``tempfile``: there is neither a file nor a window.
    :raises OSError: the scene cannot be drawn.
    """
    options = {"antialias": antialiasing, "include_path": includedirs or ()}
    options["options"] = [] if quality is None else [f"+Q{int(quality)}"]
    options.update((key, int(value)) for key, value in (("width", width), ("height", height)) if value is not None)
    try:
        if outfile is None:
            return _render(string, **options)
        data = _png(string, alpha=output_alpha, **options)
    except _SceneError as error:
        raise OSError(f"POVRay rendering failed with the following error: {error}") from error
    if outfile == "ipython":
        from IPython.display import Image

        return Image(data=data)
    name = str(outfile)
    # POV-Ray appends the ending of the type.
    with open(name if name.endswith(".png") else f"{name}.png", "wb") as file:
        file.write(data)
    return None
