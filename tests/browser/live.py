"""The page of `povr live` as people use it, in headless Chromium. `tools/live_test` runs it."""

import argparse
import contextlib
import itertools
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import traceback

from playwright.sync_api import expect, sync_playwright

SCENE = """#version 3.7; global_settings { assumed_gamma 1 }
#declare Height = 1; // live: 0..3
camera { location <0, 2, -6> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
sphere { Height*y, 1 pigment { rgb <1, 0.2, 0.1> } }
plane { y, -1 pigment { checker rgb 1 rgb 0.3 } }
"""
LIMIT = 240_000
TESTS = []


def test(function):
    TESTS.append(function)
    return function


class Live:
    """A running `povr live`, and pages of it."""

    def __init__(self, povr, browser, folder):
        self.povr, self.browser, self.folder = povr, browser, pathlib.Path(folder)
        self.scene = self.folder / "s.pov"
        self.scene.write_text(SCENE)
        self.faults = []
        self.process = None

    def start(self, *arguments, scene="s.pov"):
        scene = [scene] if scene else []
        command = [self.povr, "live", *scene, "+W320", "+H240", *arguments]
        self.process = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            if found := re.search(r"http://\S+", line):
                self.address = found[0]
                break
        threading.Thread(target=self.process.stderr.read, daemon=True).start()

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process.stderr.close()

    def page(self, **options):
        page = self.browser.new_page(**{"viewport": {"width": 1200, "height": 800}, **options})
        page.set_default_timeout(LIMIT)
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        # A stopped server breaks its connections.
        page.on("console", lambda line: line.type == "error" and "net::ERR" not in line.text and self.faults.append(line.text))
        page.on("response", lambda reply: reply.status >= 400 and self.faults.append(f"{reply.status} {reply.url}"))
        page.goto(self.address)
        whole(page)
        return page


def whole(page):
    """Waits for a whole picture, with the errors gone."""
    expect(page.locator("#state")).to_contain_text("drawn in", timeout=LIMIT)
    page.wait_for_selector("canvas[data-final=true]")


def picture(page):
    return page.evaluate("document.querySelector('canvas').toDataURL()")


def after(page, act):
    """The whole picture after an act that changes it."""
    before = picture(page)
    act()
    page.wait_for_function("before => document.querySelector('canvas').toDataURL() !== before", arg=before)
    page.wait_for_timeout(200)
    whole(page)
    assert picture(page) != before
    return picture(page)


def centre(page):
    box = page.locator("canvas").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page, across, down):
    x, y = centre(page)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + across, y + down, steps=8)
    page.mouse.up()


def location(page):
    text = page.locator("#camera").inner_text()
    return [float(number) for number in re.search(r"location <(.*)>", text)[1].split(",")]


@test
def dragging_orbits_and_reset_returns(live):
    live.start()
    page = live.page()
    first = picture(page)
    after(page, lambda: drag(page, 60, 0))
    x, y, z = location(page)
    assert x < -1 and abs(y - 2) < 0.1, (x, y, z)
    page.get_by_role("button", name="Reset").nth(1).click()
    expect(page.locator("#write-camera")).to_be_disabled()
    page.wait_for_function("first => document.querySelector('canvas').toDataURL() === first", arg=first)


@test
def wheel_and_keys_move_the_camera(live):
    live.start()
    page = live.page()
    page.mouse.move(*centre(page))
    after(page, lambda: page.mouse.wheel(0, -300))
    assert abs(location(page)[2]) < 5.5
    page.locator("canvas").focus()
    for key in ["ArrowLeft", "Shift+ArrowUp", "+", "w", "q"]:
        after(page, lambda: page.keyboard.press(key))


@test
def a_slider_changes_a_number_and_the_file_on_request(live):
    live.start()
    page = live.page()
    after(page, lambda: page.get_by_label("Height").fill("2.5"))
    assert live.scene.read_text() == SCENE
    page.locator("#write-values").click()
    expect(page.locator("#message")).to_have_text("Written to the file.")
    assert live.scene.read_text() == SCENE.replace("Height = 1;", "Height = 2.5;")


@test
def a_number_of_the_source_is_dragged(live):
    live.start()
    page = live.page()
    page.locator("#source-box summary").click()
    number = page.locator(".number[data-written='40']")
    number.scroll_into_view_if_needed()
    box = number.bounding_box()

    def pull():
        page.mouse.move(box["x"] + 4, box["y"] + 4)
        page.mouse.down()
        page.mouse.move(box["x"] + 44, box["y"] + 4, steps=4)
        page.mouse.up()

    after(page, pull)
    assert float(number.inner_text()) > 45
    after(page, lambda: page.locator("#reset-values").click())


@test
def an_error_is_shown_beside_the_last_picture_and_goes(live):
    live.start()
    page = live.page()
    before = picture(page)
    live.scene.write_text(SCENE.replace("plane", "plone"))
    expect(page.locator("#errors")).to_contain_text("plone")
    expect(page.locator("#errors")).to_contain_text("s.pov:6:1")
    assert picture(page) == before
    live.scene.write_text(SCENE.replace("0.3", "0.1"))
    expect(page.locator("#errors")).to_have_text("")
    page.wait_for_function("before => document.querySelector('canvas').toDataURL() !== before", arg=before)


@test
def warnings_are_shown_with_the_picture(live):
    live.start()
    page = live.page()
    picture(page)
    live.scene.write_text(SCENE + '#warning "a doubt"\n')
    expect(page.locator("#warnings")).to_contain_text("a doubt")
    # They stay with a scene that stays compiled.
    after(page, lambda: drag(page, 60, 0))
    expect(page.locator("#warnings")).to_contain_text("a doubt")
    expect(page.locator("#errors")).to_have_text("")
    live.scene.write_text(SCENE)
    expect(page.locator("#warnings")).to_have_text("")


@test
def the_picture_fills_the_window_or_has_its_size(live):
    live.start()
    page = live.page()
    picture(page)
    width = "document.querySelector('canvas').getBoundingClientRect().width"
    fitted, own = page.evaluate(width), page.evaluate("document.querySelector('canvas').width")
    assert fitted > 2 * own
    page.locator("#actual").click()
    assert page.evaluate(width) == own
    page.locator("#actual").click()
    assert page.evaluate(width) == fitted


@test
def a_click_names_the_object(live):
    live.start()
    page = live.page()
    x, y = centre(page)
    page.mouse.click(x, y - 30)
    expect(page.locator("#pixel")).to_contain_text("s.pov, line 5, column 1")
    page.mouse.click(x, y + 100)
    expect(page.locator("#pixel")).to_contain_text("s.pov, line 6, column 1")
    expect(page.locator("#pixel")).to_contain_text("rays")


@test
def earlier_pictures_return(live):
    live.start()
    page = live.page()
    first = picture(page)
    after(page, lambda: drag(page, 80, 10))
    earlier = page.locator("#history button")
    # A drag that is slow has whole pictures on its way.
    expect(earlier.nth(1)).to_be_visible()
    earlier.first.click()
    page.wait_for_function("first => document.querySelector('canvas').toDataURL() === first", arg=first)
    expect(earlier.first).to_have_attribute("aria-pressed", "true")


@test
def the_clock_is_scrubbed(live):
    live.scene.write_text(SCENE.replace("Height*y", "(Height - clock)*y"))
    live.start()
    page = live.page()
    after(page, lambda: page.get_by_role("slider", name="clock").fill("0.5"))
    seen = int(page.locator("canvas").get_attribute("data-pictures"))
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("seen => document.querySelector('canvas').dataset.pictures > seen + 5", arg=seen)
    page.get_by_role("button", name="Stop").click()
    assert page.locator("#clock-value").inner_text() != "0.50"


def view(page, kind):
    """The note on a view beside the picture, once it is there."""
    page.get_by_label("Beside it").select_option(kind)
    page.wait_for_selector(f"canvas[data-view={kind}]")
    return page.locator("#legend-text").inner_text()


@test
def maps_of_cost_and_error_stand_beside_the_picture(live):
    live.start()
    page = live.page()
    alone = picture(page)
    assert "rays a pixel" in view(page, "rays")
    rays = picture(page)
    assert rays != alone
    page.get_by_label("divider").fill("100")
    page.wait_for_timeout(100)
    assert picture(page) != rays
    assert "µs a pixel" in view(page, "time")
    assert "steps of 1/255" in view(page, "error")
    # It is made again for another camera.
    page.get_by_label("divider").fill("0")
    page.wait_for_timeout(100)
    error = picture(page)
    drag(page, 60, 0)
    page.wait_for_selector("canvas[data-view='']")
    page.wait_for_selector("canvas[data-view=error]")
    assert picture(page) != error
    page.get_by_label("Beside it").select_option("")
    page.wait_for_selector("canvas[data-view='']")
    whole(page)


@test
def the_picture_of_povray_stands_beside_it(live):
    if not shutil.which("povray"):
        return
    live.start()
    page = live.page()
    assert "equal in every pixel" in view(page, "povray")
    after(page, lambda: drag(page, 60, 0))
    page.wait_for_selector("canvas[data-view=povray]")
    assert "equal in every pixel" in page.locator("#legend-text").inner_text()


@test
def the_plan_names_what_is_left_out(live):
    live.start()
    page = live.page()
    page.locator("#plan-box summary").click()
    expect(page.locator("#plan")).to_contain_text("1 plane")
    expect(page.locator("#plan")).to_contain_text("left out")


@test
def the_picture_comes_in_tiles(live):
    ring = "torus { 1 + I/9, 0.04 rotate 9*I*x pigment { rgb 0.8 } finish { reflection 0.6 } }"
    live.start("+A0.3")
    page = live.page()
    # As many as take this machine a while.
    for count in [4, 16, 64, 256]:
        live.scene.write_text(f"{SCENE}#for (I, 0, {count}) {ring} #end\n")
        expect(page.locator("#state")).not_to_contain_text("drawn in", timeout=LIMIT)
        whole(page)
        if float(re.search(r"([\d.]+) s$", page.locator("#state").inner_text())[1]) > 1.5:
            break
    page.evaluate(
        """() => { window.seen = new Set(); setInterval(() => { if (document.querySelector('canvas').dataset.final === 'false')
        seen.add(document.querySelector('canvas').dataset.pictures); }, 20); }"""
    )
    after(page, lambda: drag(page, 40, 0))
    assert page.evaluate("seen.size") >= 4, page.evaluate("[...seen]")


@test
def scenes_of_the_folder_are_listed_and_opened(live):
    (live.folder / "other.pov").write_text(SCENE.replace("<1, 0.2, 0.1>", "<0.1, 0.2, 1>").replace("Height = 1", "Height = 0.5"))
    live.start()
    page = live.page()
    scenes = page.get_by_role("navigation", name="Scenes").get_by_role("button")
    expect(scenes).to_have_count(2)
    expect(page.locator("nav img")).to_have_count(2, timeout=LIMIT)
    first = picture(page)
    after(page, lambda: scenes.filter(has_text="other.pov").click())
    expect(page.locator("#title")).to_have_text("other.pov")
    expect(scenes.filter(has_text="other.pov")).to_have_attribute("aria-current", "true")
    expect(page.locator("#history button")).to_have_count(1)
    page.locator("#source-box summary").click()
    expect(page.locator("#source")).to_contain_text("Height = 0.5")
    after(page, lambda: page.get_by_label("Height").fill("2"))
    page.locator("#write-values").click()
    expect(page.locator("#message")).to_have_text("Written to the file.")
    assert "Height = 2;" in (live.folder / "other.pov").read_text()
    assert live.scene.read_text() == SCENE
    scenes.filter(has_text="s.pov").click()
    page.wait_for_function("first => document.querySelector('canvas').toDataURL() === first", arg=first)


@test
def without_a_scene_the_showcase_is_the_first_page(live):
    live.start(scene=None)
    page = live.browser.new_page(viewport={"width": 1200, "height": 800})
    page.goto(live.address)
    expect(page.locator("#state")).to_have_text("choose a scene")
    expect(page.locator("nav button")).to_have_count(6)
    expect(page.locator("nav img").first).to_be_visible(timeout=LIMIT)
    page.get_by_role("button", name="molecule.pov").click()
    whole(page)
    expect(page.locator("#title")).to_have_text("molecule.pov")
    after(page, lambda: drag(page, 40, 0))
    page.locator("#write-camera").click()
    expect(page.locator("#message")).to_contain_text("copy its source")


def spheres(color):
    rows = [f"sphere {{ <{at % 40 / 4 - 5}, 0, {at // 40 / 4 - 6}>, 0.12 pigment {{ rgb <0, 1, 0> }} }}" for at in range(2000)]
    rows[930] = rows[930].replace("<0, 1, 0>", color)
    head = SCENE.split("sphere")[0]
    return head.replace("<0, 2, -6>", "<0, 8, -12>") + "\n".join(rows) + "\n"


@test
def a_little_edit_is_drawn_over_the_last_picture(live):
    live.scene.write_text(spheres("<0, 1, 0>"))
    live.start()
    page = live.page()
    page.wait_for_timeout(300)
    loads = []
    page.on("request", lambda request: "picture.png" in request.url and loads.append(request.url))
    colors = ["<1, 0, 0>", "<1, 0, 1>", "<1, 1, 0>", "<0, 0, 1>", "<1, 1, 1>"]
    for color in colors:
        shown = after(page, lambda color=color: live.scene.write_text(spheres(color)))
        other = live.page()
        assert picture(other) == shown
        other.close()
    # Where the whole picture is there before the page knows of its part, it is loaded.
    assert len(loads) < len(colors), loads


@test
def a_file_that_changes_all_the_time_is_seen_meanwhile(live):
    live.start()
    page = live.page()
    seen = set()
    end = time.monotonic() + 4
    for step in itertools.count():
        written = live.scene.with_suffix(".new")
        written.write_text(SCENE.replace("0.3", f"0.3 translate {step} * x * 0.01"))
        written.replace(live.scene)
        page.wait_for_timeout(30)
        if step % 5 == 0:
            seen.add(picture(page))
        if time.monotonic() > end:
            break
    assert len(seen) > 3, len(seen)


@test
def two_viewers_see_the_same(live):
    live.start()
    one, two = live.page(), live.page()
    after(two, lambda: drag(one, 60, 20))
    whole(one)
    two.wait_for_function("other => document.querySelector('canvas').toDataURL() === other", arg=picture(one))
    assert one.locator("#camera").inner_text() == two.locator("#camera").inner_text()


@test
def a_page_outlives_a_restart(live):
    again = ["--token", "0123456789abcdef"]
    live.start(*again)
    port = live.address.split(":")[2].split("/")[0]
    page = live.page()
    live.stop()
    expect(page.locator("#state")).to_contain_text("does not answer")
    live.scene.write_text(SCENE.replace("0.3", "0.1"))
    before = picture(page)
    live.start(*again, "--port", port)
    page.wait_for_function("before => document.querySelector('canvas').toDataURL() !== before", arg=before)
    whole(page)
    after(page, lambda: drag(page, 50, 0))


@test
def a_phone_shows_all_in_its_width_and_fingers_move_the_camera(live):
    live.start()
    page = live.page(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    session = page.context.new_cdp_session(page)
    x, y = centre(page)

    def touch(kind, *points):
        points = [{"x": across, "y": down, "id": index} for index, (across, down) in enumerate(points)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def pinch():
        touch("touchStart", (x - 30, y), (x + 30, y))
        for step in range(1, 6):
            touch("touchMove", (x - 30 - 8 * step, y), (x + 30 + 8 * step, y))
        touch("touchEnd")

    after(page, pinch)
    assert abs(location(page)[2]) < 4


@test
def colours_follow_the_scheme_of_the_system(live):
    live.start()
    page = live.page()
    colour = "getComputedStyle(document.body).backgroundColor"
    page.emulate_media(color_scheme="light")
    light = page.evaluate(colour)
    page.emulate_media(color_scheme="dark")
    assert page.evaluate(colour) != light


# The texts whose contrast (WCAG 2.1, 1.4.3) is below 4.5.
FAINT = """() => {
  const context = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const channels = color => {
    context.clearRect(0, 0, 1, 1);
    context.fillStyle = color;
    context.fillRect(0, 0, 1, 1);
    return [...context.getImageData(0, 0, 1, 1).data];
  };
  const luminance = ([r, g, b]) => {
    const linear = [r, g, b].map(c => c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const behind = element => {
    for (let at = element; at; at = at.parentElement) {
      const color = channels(getComputedStyle(at).backgroundColor);
      if (color[3] === 255) return color;
    }
    return channels(getComputedStyle(document.documentElement).colorScheme === 'dark' ? '#121212' : '#fff');
  };
  const contrast = element => {
    const [a, b] = [channels(getComputedStyle(element).color), behind(element)].map(luminance);
    return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  };
  const texts = [...document.querySelectorAll('body *')].filter(one => one.checkVisibility() && !one.disabled
    && !one.closest('script, style')
    && [...one.childNodes].some(node => node.nodeType === 3 && node.textContent.trim()));
  return { count: texts.length, faint: texts.filter(one => contrast(one) < 4.5)
    .map(one => `${one.tagName} ${one.textContent.slice(0, 20)} ${contrast(one).toFixed(2)}`) };
}"""


@test
def every_window_is_readable_and_scrolls_down_only(live):
    live.start()
    for width in (1400, 420):
        for scheme in ("light", "dark"):
            page = live.page(viewport={"width": width, "height": 900}, color_scheme=scheme)
            texts = page.evaluate(FAINT)
            assert texts["count"] > 3 and texts["faint"] == [], (width, scheme, texts)
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), (width, scheme)
            page.close()


@test
def all_that_answers_has_a_name(live):
    live.start()
    page = live.page()
    nameless = page.evaluate(
        """[...document.querySelectorAll('button, input, select, canvas')].filter(part => !(part.ariaLabel
        || part.textContent.trim() || part.labels?.length)).map(part => part.outerHTML)"""
    )
    assert nameless == [], nameless


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--povr", required=True)
    parser.add_argument("--chromium", required=True)
    parser.add_argument("--pictures", type=pathlib.Path, help="folder for a screenshot of each page at its end")
    parser.add_argument("names", nargs="*")
    wanted = parser.parse_args()
    failed = 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=wanted.chromium, args=["--no-sandbox"])
        for function in TESTS:
            name = function.__name__
            if wanted.names and name not in wanted.names:
                continue
            with tempfile.TemporaryDirectory() as folder, contextlib.closing(browser.new_context()) as _:
                live = Live(str(pathlib.Path(wanted.povr).resolve()), browser, folder)
                try:
                    function(live)
                    assert live.faults == [], live.faults
                    print(f"ok      {name}")
                except Exception:
                    failed += 1
                    print(f"FAILED  {name}")
                    traceback.print_exc()
                finally:
                    for context in browser.contexts:
                        for page in context.pages:
                            if wanted.pictures:
                                wanted.pictures.mkdir(parents=True, exist_ok=True)
                                page.screenshot(path=wanted.pictures / f"{name}.png")
                        context.close()
                    live.stop()
        browser.close()
    sys.exit(failed > 0)


main()
