"""Programs that start POV-Ray, run with povr's `povray` and with Debian's, and compared."""

import importlib
import os
import pathlib
import shutil
import subprocess
import sys

import numpy
import pytest

import povr

POVRAY = shutil.which("povray")
INI = pathlib.Path("/etc/povray/3.7/povray.ini")
needs_povray = pytest.mark.skipif(POVRAY is None or not INI.exists(), reason="Debian's POV-Ray is not installed")
# The source package of vapory, unpacked: `pip download --no-binary :all: --no-deps vapory`.
VAPORY = pathlib.Path(os.environ.get("POVR_VAPORY_SOURCE", "none"))
EXAMPLES = sorted(VAPORY.glob("examples/[a-z]*.py"))

ASE = """
from ase.build import bulk
from ase.io import write
atoms = bulk("Cu", cubic=True).repeat((3, 3, 2))
write("atoms.pov", atoms, rotation="10x,20y", povray_settings={"canvas_width": 120}).render()
"""

PLATO = """
import numpy
numpy.asscalar = getattr(numpy, "asscalar", lambda value: value.item())
import plato.draw.povray as draw
points = numpy.random.default_rng(1).uniform(-4, 4, (40, 3))
spheres = draw.Spheres(positions=points, radii=numpy.full(40, 0.7), colors=numpy.tile((0.8, 0.5, 0.2, 1), (40, 1)))
draw.Scene([spheres], size=(12, 9), pixel_scale=10, zoom=1).save("plato.png")
"""

FDRAY = """
from fdray import *
from fdray.core.renderer import Renderer
import numpy
scene = Scene(Background(Color("gray")), Camera(30, 30), LightSource((0, 5, -9), Color("white")),
              Sphere((0, 0, 0), 1, Color("red")))
numpy.save("fdray.npy", Renderer(width=160, height=120).render(scene))
"""

VAPORY_ARRAY = """
from vapory import *
import numpy
scene = Scene(Camera("location", [0, 2, -3], "look_at", [0, 1, 2]),
              [LightSource([2, 4, -3], "color", [1, 1, 1]), Sphere([0, 1, 2], 2, Pigment("color", [1, 0, 1]))])
numpy.save("array.npy", scene.render(width=120, height=90, antialiasing=0.1))
"""


def run(code, folder, path):
    folder.mkdir()
    # Random numbers of POV-Ray are the same in each run with one thread alone.
    ini = folder / "one_thread.ini"
    ini.write_text(INI.read_text() + "\nWork_Threads=1\n")
    environment = {**os.environ, "PATH": f"{path}:{os.environ['PATH']}", "DISPLAY": "", "POVINI": str(ini)}
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="session")
def own_povray(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bin")
    program = pathlib.Path(sys.executable).with_name("povr")
    subprocess.run([program, "install-as-povray", folder], check=True)
    return folder


def picture(file):
    return numpy.load(file) if file.suffix == ".npy" else file


@needs_povray
@pytest.mark.parametrize(
    "module, code, file, limit",
    [
        ("ase", ASE, "atoms.png", 0.999),
        # Its jittered lights take one random number more or less where a shadow differs in the last digit.
        ("plato", PLATO, "plato.png", 0.9),
        ("fdray", FDRAY, "fdray.npy", 0.999),
        ("vapory", VAPORY_ARRAY, "array.npy", 0.999),
    ],
)
def test_a_client_draws_the_same_picture(tmp_path, own_povray, module, code, file, limit):
    pytest.importorskip(module)
    run(code, tmp_path / "own", own_povray)
    run(code, tmp_path / "povray", pathlib.Path(POVRAY).parent)
    compared = povr.compare(picture(tmp_path / "povray" / file), picture(tmp_path / "own" / file))
    assert compared.equal + compared.off_by_one >= limit * compared.pixels, compared


def test_every_name_of_vapory_is_there():
    vapory = pytest.importorskip("vapory.vapory")
    own = importlib.import_module("povr.vapory")
    classes = [name for name, value in vars(vapory).items() if isinstance(value, type)]
    assert len(classes) > 80 and [name for name in classes if name not in own.__all__] == []


@needs_povray
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_of_vapory_runs_unchanged(tmp_path, own_povray, example):
    """By vapory through both programs, and by the module alone."""
    pytest.importorskip("vapory")
    code = example.read_text()
    assert "from vapory import" in code
    own = code.replace("from vapory import", "from povr.vapory import")
    run(code, tmp_path / "povray", pathlib.Path(POVRAY).parent)
    run(code, tmp_path / "program", own_povray)
    run(own, tmp_path / "module", own_povray)
    for file in (tmp_path / "povray").glob("*.png"):
        expected = [tmp_path / folder / file.name for folder in ("povray", "program", "module")]
        assert povr.compare(expected[1], expected[2]).same
        compared = povr.compare(expected[0], expected[1])
        assert compared.equal + compared.off_by_one >= 0.999 * compared.pixels, compared
