"""Scenes of Python objects and of arrays."""

import inspect
import os
import pathlib
import re
import signal
import threading
import time

import numpy
import pytest

import povr
from povr import elements

ROOT = pathlib.Path(__file__).parents[2]
SIZE = {"width": 64, "height": 48}
RANDOM = numpy.random.default_rng(40)

CAMERA = povr.Camera("location", (0, 1, -4), "look_at", (0, 0, 0))
LIGHT = povr.LightSource((-5, 9, -9), "color rgb", (1, 1, 1))


def scene_of(*objects, **more):
    return povr.Scene(CAMERA, [LIGHT, *objects], **more)


def test_elements_are_blocks_of_the_language():
    words = set(re.findall(r'"(\w+)"', (ROOT / "grammar/words.pest").read_text()))
    stub = (ROOT / "src/app/python/povr/elements.pyi").read_text()
    for name in elements._BLOCKS + elements._MAPS:
        assert getattr(povr, name).word() in words
        assert f"class {name}(Element" in stub
    shapes = re.search(r"^shape = \{(.*?)\}", (ROOT / "grammar/words.pest").read_text(), re.M | re.S)
    known = {getattr(povr, name).word() for name in elements._BLOCKS}
    assert set(re.findall(r'"(\w+)"', shapes[1])) <= known


def test_elements_are_text_of_the_language():
    sphere = povr.Sphere((0, -1, 2.5), -1, povr.Pigment("color", "rgb", numpy.array([1, 0, 0.5])), "hollow", True)
    assert str(sphere).split() == "sphere { <0,-1,2.5> (-1) pigment { color rgb <1.0,0.0,0.5> } hollow on }".split()
    assert str(povr.ColorMap([0, "rgb", (0, 0, 0)], [1, "White"])).split() == (
        "color_map { [0 rgb <0,0,0>] [1 White] }".split()
    )
    assert str(povr.Macro("Wheel", 3, (1, 2, 3))) == "Wheel(3, <1,2,3>)"
    assert str(povr.Prism("linear_sweep", 0, 1, 3, [(0, 0), (1, 0), (0, 1)])).split() == (
        "prism { linear_sweep 0 1 3 <0,0>, <1,0>, <0,1> }".split()
    )
    texts = [povr.Pigment(one).__str__().split()[2] for one in (numpy.True_, numpy.float32(-0.5), numpy.array(7), False)]
    assert texts == ["on", "(-0.5)", "7", "off"]
    assert str(povr.Union(povr.Spheres([(0, 0, 0)], 1))).split()[:3] == ["union", "{", "sphere"]
    for wrong in (None, object(), 1j):
        with pytest.raises(TypeError, match="neither text"):
            str(povr.Sphere((0, 0, 0), wrong))
    assert sphere.add_args(["inverse"]).args[-1] == "inverse" and sphere.args[-1] is True


def test_a_scene_is_its_text():
    scene = scene_of(
        povr.Sphere((0, 0, 0), 1, povr.Pigment("Warm")),
        atmospheric=[povr.Background("rgb", (0.1, 0.2, 0.3))],
        defaults=[povr.Finish("ambient", 0.3)],
        global_settings=["max_trace_level 3"],
        declares=["Warm = color rgb <1, 0.5, 0>"],
    )
    assert (scene.render(**SIZE) == povr.render(str(scene), **SIZE)).all()
    assert scene._repr_png_().startswith(b"\x89PNG")
    assert (scene.add_objects([povr.Plane((0, 1, 0), -1)]).render(**SIZE) != scene.render(**SIZE)).any()
    with pytest.raises(povr.SceneError, match="Cold"):
        scene_of(povr.Sphere((0, 0, 0), 1, povr.Pigment("Cold"))).render(**SIZE)


POINTS = RANDOM.uniform(-1.5, 1.5, (60, 3))
RADII = RANDOM.uniform(0.05, 0.3, 60)
FEW_COLORS = RANDOM.uniform(0, 1, (4, 3))[RANDOM.integers(0, 4, 60)]
FACES = RANDOM.integers(0, 60, (60, 3))
TETRAHEDRON = [(-1, -1, -1), (1, -1, -1), (0, -1, 1), (0, 1, 0)], [(0, 1, 2), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


@pytest.mark.parametrize(
    "rows",
    [
        povr.Spheres(POINTS, 0.2, povr.Pigment("rgb", (1, 0, 0))),
        povr.Spheres(POINTS, RADII, povr.Finish("phong", 1), colors=FEW_COLORS),
        povr.Spheres(POINTS, RADII, colors=RANDOM.uniform(0, 1, (60, 5))),
        povr.Spheres(POINTS, RADII, povr.Pigment("checker"), "no_shadow", "scale", 0.7, "rotate", (0, 40, 0)),
        povr.Spheres(POINTS, RADII, "no_shadow", "scale", 0.7, colors=FEW_COLORS),
        povr.Spheres(POINTS, RADII, povr.Texture(povr.Pigment("Warm"), povr.Finish("specular", 1)), colors=FEW_COLORS),
        povr.Cylinders(POINTS[1:], POINTS[:-1], 0.1, povr.Pigment("Warm")),
        povr.Cylinders(POINTS[1:], POINTS[:-1], RADII[1:], colors=(0, 1, 0), open=True),
        povr.Triangles(POINTS, FACES, povr.Pigment("Warm")),
        povr.Triangles(POINTS, FACES, povr.Finish("phong", 1), colors=FEW_COLORS),
        povr.Triangles(
            POINTS, FACES, povr.Pigment("Warm"), "translate", (0, 0.5, 0), normals=RANDOM.normal(size=(60, 3))
        ),
        povr.Triangles(POINTS, colors=FEW_COLORS[:20]),
        povr.Triangles(
            *TETRAHEDRON,
            "inside_vector",
            (0, 1, 0),
            povr.Pigment("rgbt", (1, 0.8, 0.8, 0.8)),
            povr.Interior("ior", 1.5, povr.Media("absorption", 1)),
            "hollow",
        ),
    ],
)
def test_arrays_draw_the_picture_of_their_text(rows):
    scene = scene_of(rows, povr.Plane((0, 1, 0), -2, povr.Pigment("Warm")), declares=["Warm = color rgb <1, 0.5, 0>"])
    expected = povr.render(str(scene), **SIZE)
    assert (expected != scene_of().render(**SIZE)).any()
    assert povr.compare(expected, scene.render(**SIZE)).same
    # Frames share the arrays.
    frames = list(povr.render_frames(scene, 2, **SIZE))
    assert len(frames) == 2 and all((frame == expected).all() for frame in frames)


def test_wrong_arrays_are_refused():
    for make in (
        lambda: povr.Spheres(POINTS[:, :2], 1),
        lambda: povr.Spheres(POINTS, RADII[:5]),
        lambda: povr.Spheres(POINTS * numpy.nan, 1),
        lambda: povr.Spheres(POINTS, 1, colors=FEW_COLORS[:7]),
        lambda: povr.Triangles(POINTS, [[0, 1, 60]]),
        lambda: povr.Triangles(POINTS, [[0, 1, -1]]),
        lambda: povr.Triangles(POINTS, [[0, 1, 2.7]]),
        lambda: povr.Triangles(POINTS, FACES, normals=POINTS[1:]),
        lambda: scene_of(povr.Cylinders(POINTS, POINTS, 1)).render(**SIZE),
    ):
        with pytest.raises(ValueError):
            make()
    with pytest.raises(povr.SceneError, match="Cold"):
        scene_of(povr.Spheres(POINTS, 1, povr.Pigment("Cold"))).render(**SIZE)
    with pytest.raises(povr.SceneError, match="braces"):
        scene_of(povr.Spheres(POINTS, 1, "} box { 0, 1")).render(**SIZE)
    assert (scene_of(povr.Spheres(numpy.empty((0, 3)), 1)).render(**SIZE) == scene_of().render(**SIZE)).all()


def test_short_lists_are_refused():
    """By the compiled module too."""
    mesh = povr.Triangles(*TETRAHEDRON, normals=TETRAHEDRON[0], colors=(1, 0, 0))
    for rows, key in (
        (povr.Spheres(POINTS, 1, colors=(1, 0, 0)), "colors"),
        (povr.Cylinders(POINTS[1:], POINTS[:-1], 1, colors=(1, 0, 0)), "colors"),
        (mesh, "colors"),
        (mesh, "normals"),
    ):
        short = rows.rows()
        short[key] = short[key][: len(short[key]) // 2]
        with pytest.raises(ValueError, match=f"{key} for"):
            povr._povr.Session(["+FN8"], ("scene", b""), [short], 8, None, False)


def test_attributes_are_read_with_the_scene(tmp_path):
    """Once, where their errors are found, under the clock of each frame, and until Ctrl-C."""
    arrays = [povr.Spheres(POINTS, 0.1, povr.Pigment("Now")) for _ in range(3)]
    log = tmp_path / "log.inc"
    log.write_text('#warning "read"\n')
    with pytest.warns(povr.SceneWarning) as caught:
        scene_of(*arrays, included=[str(log)], declares=["Now = rgb 1"]).render(**SIZE)
    assert len([one for one in caught if "read" in str(one.message)]) == 1
    wrong = scene_of(*arrays, declares=["Now = colr rgb 1"])
    with pytest.raises(povr.SceneError, match="colr") as raised:
        wrong.render(**SIZE)
    assert (raised.value.file, raised.value.line) == ("scene", 2)
    assert povr.check(wrong)[0] == raised.value.errors[0]
    moving = scene_of(*arrays[:1], povr.Triangles(*TETRAHEDRON, povr.Finish("ambient", "clock"), colors=(1, 0, 0)))
    moving.declares = ["Now = rgb <clock, 1, 0>"]
    frames = zip(povr.render_frames(moving, 3, **SIZE), povr.render_frames(str(moving), 3, **SIZE))
    assert all((one == other).all() for one, other in frames)
    endless = scene_of(*arrays, declares=["Now = rgb 1;\n#local I = 0; #while (I < 1e9) #local I = I + 1; #end"])
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        started = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            endless.render(**SIZE)
        assert time.monotonic() - started < 5
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_hundred_thousand_spheres_are_in_the_scene_at_once():
    points = RANDOM.uniform(-1, 1, (100_000, 3))
    scene = scene_of(povr.Spheres(points, 0.01, colors=RANDOM.uniform(0, 1, (100_000, 3))))
    started = time.monotonic()
    picture = scene.render(**SIZE)
    # As text the same takes several seconds.
    assert time.monotonic() - started < 5 and picture.any()


def test_everything_is_documented():
    for name in povr.__all__:
        assert inspect.getdoc(getattr(povr, name)), name


def test_a_notebook_shows_pictures_and_errors(capsys):
    pytest.importorskip("IPython")
    from IPython.testing.globalipapp import start_ipython

    shell = start_ipython()
    shell.run_line_magic("load_ext", "povr")
    image = shell.run_cell_magic("povray", "+W32 +H24", str(scene_of(povr.Sphere((0, 0, 0), 1))))
    assert image.data.startswith(b"\x89PNG")
    assert shell.run_cell_magic("povray", "", "sphere { Cold }") is None
    assert "Cold" in capsys.readouterr().out
