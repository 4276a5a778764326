"""The Python of the documentation runs."""

import os
import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).parents[2]


def blocks(file, language):
    return re.findall(rf"^```{language}\n(.*?)^```", (ROOT / file).read_text(), re.M | re.S)


def test_the_lines_of_the_readme_give_a_picture(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    os.symlink(ROOT / "pov_scenes", "pov_scenes")
    (lines,) = blocks("README.md", "python")
    assert len(lines.splitlines()) == 3
    exec(lines, {})
    assert pathlib.Path("gears.png").read_bytes().startswith(b"\x89PNG")


def test_the_guide_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    shutil.copy(ROOT / "pov_scenes/showcase/gears.pov", "gears.pov")
    text = "".join(blocks("docs/guide.md", "sh"))
    pathlib.Path("turn.pov").write_text(re.search(r"cat > turn.pov <<'END'\n(.*?)^END", text, re.M | re.S)[1])
    (lines,) = blocks("docs/guide.md", "python")
    exec(lines, {})
    assert capsys.readouterr().out.startswith("2 Did you mean `light_source`? [Finding(")
