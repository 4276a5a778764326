"""Times of `povr live` in headless Chromium, as a table: from a file that is saved, or a mouse that moves, to the picture.

`tools/live_test --times` runs it, on the showcase and on twelve scenes that come with POV-Ray where those are installed.
"""

import argparse
import json
import pathlib
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
  const canvas = document.querySelector('canvas');
  new MutationObserver(() => shown.push([Date.now(), canvas.dataset.final === 'true']))
    .observe(canvas, { attributes: true, attributeFilter: ['data-pictures'] });
}"""
ORBIT = 3.0


def scenes(names):
    found = sorted((ROOT / "pov_scenes/showcase").glob("*.pov"))
    others = [EXAMPLES / f"{name}.pov" for name in NAMES]
    found += [path for path in others if path.is_file()]
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


def saved(page, scene, times):
    """Median times from a file that is saved to the first picture and to the final one."""
    first, last = [], []
    for number in range(times):
        page.evaluate("shown.length = 0")
        text = re.sub(r"\n// saved \d+\n$", "\n", scene.read_text(encoding="latin-1"))
        draft = scene.with_suffix(".draft")
        draft.write_text(f"{text.rstrip()}\n// saved {number}\n", encoding="latin-1")
        start = 1000 * time.time()
        draft.replace(scene)
        page.wait_for_function("() => shown.length && shown.at(-1)[1]", timeout=LIMIT)
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
    page.wait_for_function("rest => shown.some(([at, isFinal]) => isFinal && at > rest)", arg=rest, timeout=LIMIT)
    shown = page.evaluate("shown")
    return count / ORBIT, next(at for at, is_final in shown if is_final and at > rest) - rest


def measured(browser, povr, source, times):
    with tempfile.TemporaryDirectory() as folder:
        # All files beside the scene may belong to it.
        here = pathlib.Path(folder) / "scenes"
        shutil.copytree(source.parent, here)
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
            first, last = saved(page, scene, times)
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
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=wanted.chromium, args=["--no-sandbox"])
        for scene in scenes(wanted.names):
            results.append(measured(browser, povr, scene, wanted.saves))
            print(row(results[-1]), flush=True)
        browser.close()
    if wanted.json:
        wanted.json.write_text(json.dumps(results, indent=2))


main()
