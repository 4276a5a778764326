"""Renders, their options, errors and interruptions."""

import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings

import numpy
import pytest

import povr

SCENE = """
#version 3.7;
camera { location <0, 1, -4> look_at 0 }
light_source { <-5, 9, -9>, rgb 1 }
sphere { 0, 1 pigment { rgb <1, 0.4, 0.1> } finish { phong 1 } }
"""
# Some seconds at 1600x1200.
SLOW = SCENE + "global_settings { radiosity { count 50 error_bound 0.3 } } plane { y, -1 pigment { rgb 1 } }"
SIZE = {"width": 64, "height": 48}


def program(*arguments, **how):
    return subprocess.run([sys.executable, "-m", "povr", *arguments], capture_output=True, text=True, **how)


@pytest.mark.parametrize(
    "options, switches",
    [
        ({}, []),
        ({"antialias": 0.1}, ["+A0.1"]),
        ({"antialias": povr.Antialias(0.2, 2, 2, 0)}, ["+A0.2", "+AM2", "+R2", "-J"]),
        ({"alpha": True}, ["+UA"]),
        ({"depth": 16}, ["+FN16"]),
        ({"error": 2}, ["--error", "2"]),
        ({"options": "+Q3 +SC0.5"}, ["+Q3", "+SC0.5"]),
        (
            {"declare": {"Far": 1e-3}, "clock": 0.5, "version": 3.6, "threads": 1},
            ["Declare=Far=0.001", "+K0.5", "+MV3.6"],
        ),
    ],
)
def test_pixels_are_those_of_the_program(tmp_path, options, switches):
    scene = tmp_path / "scene.pov"
    scene.write_text(SCENE.replace("#version 3.7;", "") if "version" in options else SCENE)
    drawn = program(str(scene), "-o", str(tmp_path / "scene.png"), "+W64", "+H48", *switches)
    assert drawn.returncode == 0, drawn.stderr
    for given in (scene, str(scene), scene.read_text(), scene.read_bytes()):
        picture = povr.render(given, **SIZE, **options)
        assert picture.shape == (48, 64, 4 if options.get("alpha") else 3)
        assert povr.compare(tmp_path / "scene.png", picture).same
    (tmp_path / "again.png").write_bytes(povr.png(scene, **SIZE, **options))
    assert (tmp_path / "again.png").read_bytes() == (tmp_path / "scene.png").read_bytes()


def test_floating_point_is_the_light_of_an_exr_file(tmp_path):
    scene = tmp_path / "scene.pov"
    scene.write_text(SCENE)
    assert program(str(scene), "-o", str(tmp_path / "scene.exr"), "+W64", "+H48").returncode == 0
    picture = povr.render(scene, **SIZE, depth=32)
    assert picture.dtype == numpy.float32
    assert povr.compare(tmp_path / "scene.exr", picture).off_by_more == 0


def test_arrays_have_the_promised_types():
    for depth, dtype in ((8, numpy.uint8), (16, numpy.uint16), (32, numpy.float32)):
        picture = povr.render(SCENE, **SIZE, depth=depth, alpha=True)
        assert picture.dtype == dtype and picture.dtype.isnative and picture.flags.writeable
        assert picture[0, 0, 3] == 0 and picture[24, 32, 3] == (1 if depth == 32 else numpy.iinfo(dtype).max)


def test_errors_have_all_places_and_remedies(tmp_path):
    text = "sphere { 0 1 }\nlight_sorce { 0, 1 }\nbox { 0, 1 pigmnt { rgb 1 } }\n"
    with pytest.raises(povr.SceneError) as raised:
        povr.render(text, **SIZE)
    error = raised.value
    assert (error.file, error.line, error.column) == ("scene", 2, 1)
    assert "light_sorce" in error.message and "light_source" in error.help and "^^^" in str(error)
    assert [one.line for one in error.errors] == [2, 3]
    assert pickle.loads(pickle.dumps(error)).errors == error.errors
    assert povr.check(text) == error.errors
    assert povr.check(SCENE) == []
    path = tmp_path / "x.pov"
    path.write_text(text)
    assert {one.file for one in povr.check(path)} == {str(path)}
    with pytest.raises(FileNotFoundError):
        povr.render(tmp_path / "none.pov")


def test_warnings_point_at_the_caller():
    with pytest.warns(povr.SceneWarning, match="degenerate") as caught:
        povr.render(SCENE + "triangle { 0, 0, 0 }", **SIZE)
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    "options",
    [
        {"width": 0},
        {"depth": 12},
        {"antialias": "much"},
        {"error": -1},
        {"options": "--help"},
        {"options": "--sandbox"},
        {"options": ["--timeout=3s"]},
        {"options": "+C"},
    ],
)
def test_wrong_options_are_refused(options):
    with pytest.raises((ValueError, TypeError)):
        povr.render(SCENE, **{**SIZE, **options})


@pytest.mark.parametrize(
    "options",
    ["+FN16", "+FE", "+FNg", "+FJ", "+FH", "Bits_Per_Color=16", "Grayscale_Output=on", "Output_File_Type=T"],
)
def test_other_types_of_pictures_are_refused(options):
    for draw in (povr.render, povr.png, lambda *a, **o: next(povr.render_frames(*a, 2, **o)), povr.check, povr.plan):
        with pytest.raises(ValueError, match="`depth`"):
            draw(SCENE, **SIZE, options=options)
    assert povr.render(SCENE, **SIZE, options="+FN +UA").shape == (48, 64, 4)
    assert povr.render(SCENE, **SIZE, depth=16, options="+FN16").dtype == numpy.uint16


def test_only_scenes_are_drawn():
    for scene in (5, None, [SCENE], numpy.zeros(3)):
        with pytest.raises(TypeError, match="scene of type"):
            povr.render(scene, **SIZE)


def test_a_scene_writes_only_where_it_may(tmp_path):
    file = tmp_path / "written.txt"
    text = SCENE + f'#fopen F "{file}" write #write(F, "x") #fclose F'
    with pytest.raises(povr.SceneError):
        povr.render(text, **SIZE)
    assert not file.exists()
    for given in ({"allow_write": tmp_path}, {"options": ["--allow-write", str(tmp_path)]}):
        povr.render(text, **SIZE, **given)
        assert file.read_text() == "x"
        file.unlink()


def test_frames_are_drawn_one_after_the_other_where_they_share_files_or_time(tmp_path):
    def is_sequential(**options):
        return povr.rendering._session(SCENE, povr.rendering.render_options(**options)).is_sequential

    assert not is_sequential() and not is_sequential(error=2)
    assert is_sequential(time=1) and is_sequential(options="--time=1s")
    assert is_sequential(allow_write=tmp_path) and is_sequential(options=f"--allow-write={tmp_path}")


def test_many_threads_draw_side_by_side():
    alone = povr.render(SCENE, **SIZE)
    pictures = [None] * 8

    def draw(at):
        pictures[at] = povr.render(SCENE, **SIZE, threads=1 + at % 3)

    threads = [threading.Thread(target=draw, args=(at,)) for at in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all((picture == alone).all() for picture in pictures)


def test_other_threads_run_and_progress_is_told():
    parts, ticks, done = [], 0, threading.Event()

    def count():
        nonlocal ticks
        while not done.wait(0.005):
            ticks += 1

    counter = threading.Thread(target=count)
    counter.start()
    povr.render(SLOW, width=160, height=120, progress=parts.append)
    done.set()
    counter.join()
    assert ticks >= 10
    assert parts == sorted(parts) and parts[-1] == 1 and 0 <= parts[0] <= 1


def test_a_token_and_an_exception_cancel():
    token = povr.CancelToken()
    threading.Timer(0.2, token.cancel).start()
    started = time.monotonic()
    with pytest.raises(povr.Cancelled):
        povr.render(SLOW, width=1600, height=1200, cancel=token)
    assert token.cancelled and time.monotonic() - started < 5

    def fail(part):
        raise KeyError(part)

    with pytest.raises(KeyError):
        povr.render(SLOW, width=1600, height=1200, progress=fail)


def test_ctrl_c_is_a_keyboard_interrupt():
    # A shell starts what it runs in the background with SIGINT ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        started = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            povr.render(SLOW, width=1600, height=1200)
        assert time.monotonic() - started < 5
    finally:
        signal.signal(signal.SIGINT, before)


def test_frames_are_those_of_the_program(tmp_path):
    text = SCENE + "box { -1, 1 scale 0.4 translate <2 * clock, 0, -1> pigment { rgb <0, frame_number / 5, 1> } }"
    (tmp_path / "scene.pov").write_text(text)
    drawn = program("scene.pov", "+W64", "+H48", "+KFF5", "+KF3", "+KC", cwd=tmp_path)
    assert drawn.returncode == 0, drawn.stderr
    parts = []
    frames = list(povr.render_frames(text, 5, clock=(0, 3), cyclic=True, progress=parts.append, **SIZE))
    assert len(frames) == 5 and parts == [0.2, 0.4, 0.6, 0.8, 1]
    for number, picture in enumerate(frames, 1):
        assert povr.compare(tmp_path / f"scene{number}.png", picture).same
    for picture in povr.render_frames(SLOW, 50, **SIZE):
        assert picture.shape == (48, 64, 3)
        break


def test_the_token_of_the_caller_stays_as_it_is():
    token = povr.CancelToken()
    for _ in povr.render_frames(SLOW, 50, cancel=token, **SIZE):
        break

    def fail(part):
        raise KeyError(part)

    for draw in (povr.render, lambda *a, **o: list(povr.render_frames(*a, 3, **o))):
        with pytest.raises(KeyError):
            draw(SLOW, **SIZE, cancel=token, progress=fail)
    assert not token.cancelled
    assert povr.render(SCENE, **SIZE, cancel=token).any()
    started = time.monotonic()
    threading.Timer(0.2, token.cancel).start()
    with pytest.raises(povr.Cancelled):
        list(povr.render_frames(SLOW, 50, width=320, height=240, cancel=token))
    assert time.monotonic() - started < 5
    with pytest.raises(povr.Cancelled):
        povr.render(SLOW, width=320, height=240, cancel=token)


def test_the_plan_counts_what_rays_meet():
    plan = povr.plan(SCENE + "union { box { 0, 1 } box { 2, 3 } }")
    assert plan["lights"] == 1 and plan["primitives"] == {"box": 2, "sphere": 1}


def test_pictures_are_compared():
    picture = povr.render(SCENE, **SIZE)
    assert povr.compare(picture, picture) == povr.Comparison(3072, 3072, 0, 0, 0.0, 0.0, 0.0, float("inf"), 0.0, None)
    other = picture.copy()
    other[3, 5, 1] += 9
    compared = povr.compare(picture, other)
    assert (compared.off_by_more, compared.max, compared.place) == (1, 9, (5, 3))
    with pytest.raises(ValueError, match="64x48"):
        povr.compare(picture, picture[:, 1:])
    with pytest.raises(OSError):
        povr.compare(picture, "none.png")
    swapped = picture.astype(">u2")
    assert povr.compare(swapped, picture.astype("u2")).same


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
def test_other_threads_run_while_files_are_compared(tmp_path):
    (tmp_path / "scene.png").write_bytes(povr.png(SCENE, **SIZE))
    os.mkfifo(tmp_path / "pipe.png")
    code = '''
import povr, threading
with open("scene.png", "rb") as file:
    data = file.read()
# Opening waits for the reader, and the reader for the writer.
def write():
    with open("pipe.png", "wb") as pipe:
        pipe.write(data)
threading.Timer(0.2, write).start()
assert povr.compare("pipe.png", "scene.png").same
'''
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True, timeout=60)


def test_a_curve_is_data(tmp_path):
    path = tmp_path / "scene.pov"
    path.write_text(SCENE)
    curve = povr.curve(path, ["-A", "--error 4"], runs=1, truth=1, options="+W32 +H24")
    first, second = curve["measured"]
    assert first["family"] == "centres" and first["errors"]["rmse"] > second["errors"]["rmse"] > 0
    assert [file.name for file in tmp_path.iterdir()] == ["scene.pov"]


def test_settings_of_the_user_do_not_count(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pathlib.Path("povray.ini").write_text("Quality=1\nAntialias=on\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        here = povr.render(SCENE, **SIZE)
    monkeypatch.chdir("/")
    assert (povr.render(SCENE, **SIZE) == here).all()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
@pytest.mark.parametrize(
    "work",
    [
        "povr.render(scene, width=9, height=9)",
        "povr.curve('scene.pov', ['-A'], runs=1, truth=9, options='+W32 +H24')",
        "povr.compare(numpy.zeros((90, 90, 3), 'u1'), numpy.zeros((90, 90, 3), 'u1'))",
        "povr.check(scene)",
    ],
)
def test_a_forked_child_is_refused_and_does_not_hang(tmp_path, work):
    (tmp_path / "scene.pov").write_text(SCENE)
    code = f'''
import numpy, os, povr, signal
with open("scene.pov") as file:
    scene = file.read()
def work():
    {work}
work()
for again in (work, lambda: povr.render(scene, width=9, height=9)):
    child = os.fork()
    if child == 0:
        signal.alarm(20)
        try:
            again()
        except RuntimeError as error:
            os._exit(7 if "spawn" in str(error) else 8)
        os._exit(9)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
'''
    subprocess.run([sys.executable, "-W", "ignore", "-c", code], cwd=tmp_path, check=True, timeout=120)


def test_the_command_line_is_povr(tmp_path):
    povr_program = pathlib.Path(sys.executable).with_name("povr")
    (tmp_path / "scene.pov").write_text(SCENE)
    drawn = subprocess.run([povr_program, "scene.pov", "+W32", "+H24"], cwd=tmp_path, capture_output=True)
    assert (drawn.returncode, drawn.stdout, drawn.stderr) == (0, b"", b"")
    piped = subprocess.run([povr_program, "scene.pov", "+W32", "+H24", "+O-", "+FP"], cwd=tmp_path, capture_output=True)
    assert piped.stdout.startswith(b"P6\n32 24\n255\n") and len(piped.stdout) == 13 + 32 * 24 * 3
    boxed = subprocess.run([povr_program, "--sandbox", "scene.pov", "+W32", "+H24"], cwd=tmp_path)
    assert boxed.returncode == 0
    assert subprocess.run([povr_program, "install-as-povray", "bin"], cwd=tmp_path).returncode == 0
    as_povray = subprocess.run(
        [tmp_path / "bin/povray", "scene.pov", "+W32", "+H24"], cwd=tmp_path, capture_output=True
    )
    assert as_povray.returncode == 0 and b"POV-Ray finished" in as_povray.stderr
    started = subprocess.Popen(
        [povr_program, "-", "+W1600", "+H1200", "+Oslow.png"], cwd=tmp_path, stdin=subprocess.PIPE
    )
    started.stdin.write(SLOW.encode())
    started.stdin.close()
    time.sleep(0.7)
    started.send_signal(signal.SIGINT)
    assert started.wait(10) == 2


def test_workers_run_the_program_of_the_module(tmp_path):
    """Batches and `watch` draw in processes of the same build."""
    povr_program = pathlib.Path(sys.executable).with_name("povr")
    for name in ("a", "b"):
        (tmp_path / f"{name}.pov").write_text(SCENE)
    for command in ([povr_program], [sys.executable, "-m", "povr"]):
        out = tmp_path / f"out{len(command)}"
        batch = [*command, "batch", ".", "-o", str(out), "--size", "32x24"]
        done = subprocess.run(batch, cwd=tmp_path, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        assert sorted(file.name for file in out.rglob("*.png")) == ["a.png", "b.png"]
        watch = [*command, "watch", "a.pov", "+W32", "+H24", "--times", "1"]
        done = subprocess.run(watch, cwd=tmp_path, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0 and (tmp_path / "a.png").exists(), done.stderr
        (tmp_path / "a.png").unlink()


def test_a_module_without_its_script_says_so(tmp_path):
    linked = program("install-as-povray", "bin", cwd=tmp_path)
    assert linked.returncode == 0, linked.stderr
    assert (tmp_path / "bin/povray").resolve() == pathlib.Path(sys.executable).with_name("povr").resolve()
    code = "import sysconfig; sysconfig.get_path = lambda *_: '/none'; from povr.__main__ import main; main()"
    (tmp_path / "__main__.py").write_text(code)
    alone = [sys.executable, "__main__.py"]
    drawn = subprocess.run([*alone, "-", "+W9", "+H9", "+O-"], cwd=tmp_path, input=SCENE.encode(), capture_output=True)
    assert drawn.returncode == 0 and drawn.stdout.startswith(b"\x89PNG")
    linked = subprocess.run([*alone, "install-as-povray", "bin2"], cwd=tmp_path, capture_output=True, text=True)
    assert linked.returncode != 0 and "pip install" in linked.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="no limit on threads")
def test_a_system_without_threads_is_an_error():
    code = f"""
import os, povr, resource
scene = {SCENE!r}
povr.check(scene)
if os.getuid() == 0:
    os.setuid(65534)
resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
for work in (povr.check, povr.render):
    try:
        work(scene, width=9, height=9)
    except RuntimeError as error:
        assert "thread" in str(error)
    else:
        assert False
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
