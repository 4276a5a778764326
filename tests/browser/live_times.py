"""Times of `povr live` in headless Chromium, as a table: from a file that is saved, or a mouse that moves, to the picture.

`tools/live_test --times` runs it, on the showcase and on twelve scenes that come with POV-Ray where those are installed. There a
comment changes. In a scene of 100,000 spheres that it writes, `pigment`, the pigment of one of them does.
"""

import argparse
import json
import pathlib
import random
import re
import shutil
import statistics
import subprocess
import tempfile
import threading
import time

from playwright.sync_api import sync_playwright

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLES = pathlib.Path("/usr/share/doc/povray/examples")
NAMES = [
    "advanced/biscuit", "advanced/chess2", "advanced/lamppost", "advanced/whiltile", "advanced/wineglass", "advanced/woodbox",
    "objects/blob", "objects/isosurfaces", "objects/lathe2", "objects/mesh2", "objects/sor1", "objects/superel1",
]  # fmt: skip
SIZE = ["+W640", "+H480"]
LIMIT = 300_000
#: Notes the time of each picture that the page shows, and if it is the final one.
WATCH = """() => {
  window.shown = [];
  let told = null;
  // Without polling, which would take time from the renderer.
  window.finalAfter = start => new Promise(done => { told = () => shown.some(([at, isFinal]) => isFinal && at > start) && done(); told(); });
  const canvas = document.querySelector('canvas');
  new MutationObserver(() => { shown.push([Date.now(), canvas.dataset.final === 'true']); told?.(); })
    .observe(canvas, { attributes: true, attributeFilter: ['data-pictures'] });
}"""
ORBIT = 3.0
#: Seconds between a picture and the next save.
REST = 0.5


#: The statements of the scene `pigment` before its spheres.
HEAD = """#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 30, -60> look_at 0 angle 50 }
light_source { <40, 80, -60>, 1 }
background { rgb <0.3, 0.4, 0.6> }
plane { y, -3 pigment { checker rgb 0.9, rgb 0.4 scale 4 } }
"""


def spheres(path):
    """Writes a scene of 100,000 spheres, each with a statement of its own."""
    numbers = random.Random(1)

    def sphere():
        x, y, z = numbers.uniform(-40, 40), numbers.uniform(-3, 6), numbers.uniform(-40, 40)
        red, green, blue = (numbers.random() for _ in range(3))
        look = f"pigment {{ color rgb <{red:.3f}, {green:.3f}, {blue:.3f}> }} finish {{ diffuse 0.8 phong 0.5 }}"
        return f"sphere {{ <{x:.4f}, {y:.4f}, {z:.4f}>, {numbers.uniform(0.05, 0.25):.4f} {look} }}\n"

    path.write_text(HEAD + "".join(sphere() for _ in range(100_000)))


def commented(text, number):
    """The text with a comment that tells the number."""
    return re.sub(r"\n// saved \d+\n$", "\n", text).rstrip() + f"\n// saved {number}\n"


def repainted(text, number):
    """The text with another colour for the sphere in its middle."""
    middle = text.index("color rgb", len(text) // 2)
    return text[:middle] + re.sub(r"<[^>]*>", f"<0.9, {number % 10 / 10}, 0.1>", text[middle:], count=1)


def scenes(names, folder):
    found = sorted((ROOT / "pov_scenes/showcase").glob("*.pov"))
    others = [EXAMPLES / f"{name}.pov" for name in NAMES]
    found += [path for path in others if path.is_file()]
    if not names or "pigment" in names:
        found.append(folder / "pigment.pov")
        spheres(found[-1])
    return [path for path in found if not names or path.stem in names]


def alone(povr, scene):
    """The least time of three runs of the command."""
    times = []
    for _ in range(3):
        start = time.monotonic()
        subprocess.run([povr, scene.name, *SIZE, "-o", "alone.png"], cwd=scene.parent, stderr=subprocess.DEVNULL, check=True)
        times.append(time.monotonic() - start)
    (scene.parent / "alone.png").unlink()
    return min(times)


def final(page):
    page.wait_for_selector("canvas[data-final=true]", timeout=LIMIT)


def saved(page, scene, times, change):
    """Median times from a file that is saved to the first picture and to the final one."""
    first, last = [], []
    for number in range(times):
        # The work that follows a picture is done.
        time.sleep(REST)
        page.evaluate("shown.length = 0")
        text = scene.read_text(encoding="latin-1")
        draft = scene.with_suffix(".draft")
        draft.write_text(change(text, number), encoding="latin-1")
        start = 1000 * time.time()
        draft.replace(scene)
        page.evaluate("start => finalAfter(start)", start)
        shown = page.evaluate("shown")
        first.append(shown[0][0] - start)
        last.append(next(at for at, is_final in shown if is_final) - start)
    return statistics.median(first), statistics.median(last)


def orbited(page):
    """Coarse pictures a second while the mouse drags, and the time from its rest to the final picture."""
    box = page.locator("canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.evaluate("shown.length = 0")
    page.mouse.move(x, y)
    page.mouse.down()
    begin = time.monotonic()
    step = 0
    while time.monotonic() - begin < ORBIT:
        step += 1
        page.mouse.move(x + 60 * (step % 40 - 20) / 20, y + step % 7)
    rest = 1000 * time.time()
    page.mouse.up()
    count = page.evaluate("shown.length")
    page.evaluate("rest => finalAfter(rest)", rest)
    shown = page.evaluate("shown")
    return count / ORBIT, next(at for at, is_final in shown if is_final and at > rest) - rest


def measured(browser, povr, source, times):
    with tempfile.TemporaryDirectory() as folder:
        # All files beside the scene may belong to it, and those of a folder of includes beside its own.
        here = pathlib.Path(folder) / source.parent.name
        shutil.copytree(source.parent, here)
        includes = source.parent.parent / "include"
        if includes.is_dir():
            shutil.copytree(includes, here.parent / "include")
        scene = here / source.name
        by_command = alone(povr, scene)
        process = subprocess.Popen([povr, "live", scene.name, *SIZE], cwd=here, stderr=subprocess.PIPE, text=True)
        try:
            address = next(found[0] for line in process.stderr if (found := re.search(r"http://\S+", line)))
            threading.Thread(target=process.stderr.read, daemon=True).start()
            page = browser.new_page(viewport={"width": 1200, "height": 800})
            page.goto(address)
            final(page)
            page.evaluate(WATCH)
            first, last = saved(page, scene, times, repainted if scene.stem == "pigment" else commented)
            rate, rested = orbited(page) if page.locator("#copy").is_enabled() else (None, None)
            page.close()
        finally:
            process.kill()
            process.wait()
    return {"scene": source.stem, "alone_ms": 1000 * by_command, "first_ms": first, "final_ms": last, "per_second": rate, "rest_ms": rested}


def row(result):
    def shown(value, digits=0):
        return "–" if value is None else f"{value:.{digits}f}"

    ratio = result["final_ms"] / result["alone_ms"]
    parts = [shown(result[key]) for key in ["first_ms", "final_ms", "alone_ms"]]
    return f"| {result['scene']} | {' | '.join(parts)} | {ratio:.2f} | {shown(result['per_second'])} | {shown(result['rest_ms'])} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--povr", required=True)
    parser.add_argument("--chromium", required=True)
    parser.add_argument("--saves", type=int, default=5, help="files saved for each scene")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    parser.add_argument("names", nargs="*")
    wanted = parser.parse_args()
    povr = str(pathlib.Path(wanted.povr).resolve())
    results = []
    print("| scene | first picture, ms | final, ms | `povr` alone, ms | ratio | pictures a second | final after rest, ms |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=wanted.chromium, args=["--no-sandbox"])
        for scene in scenes(wanted.names, pathlib.Path(folder)):
            results.append(measured(browser, povr, scene, wanted.saves))
            print(row(results[-1]), flush=True)
        browser.close()
    if wanted.json:
        wanted.json.write_text(json.dumps(results, indent=2))


main()
