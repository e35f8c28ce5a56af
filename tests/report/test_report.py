#!/usr/bin/env python3
"""Opens a run's report in a headless Chromium without network and uses it by mouse and keys as a person would.

    test_report.py DIVOT SCENE FOLDER

Leaves pictures of what it saw in FOLDER. Exit status 77: there is no Chromium here to test with.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import time

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.select import Select
except ImportError:
    sys.exit(77)


def browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--window-size=1280,1400", "--use-gl=angle",
                     "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
                     "--host-resolver-rules=MAP * ~NOTFOUND", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


class Page:
    def __init__(self, driver, folder):
        self.driver, self.folder = driver, folder

    def find(self, name):
        return self.driver.find_element(By.ID, name)

    def js(self, text):
        return self.driver.execute_script("return " + text)

    def time(self):
        return self.js("divotReport.player.time")

    def picture(self, name):
        path = self.folder / (name + ".png")
        path.write_bytes(self.find("view").screenshot_as_png)
        return path.read_bytes()

    def wait(self, what, condition, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, "waited in vain for " + what
            time.sleep(0.1)


def check_file(report):
    text = report.read_text()
    assert report.stat().st_size < 20e6, report.stat().st_size
    without_three = text.split("<script>")[0]
    assert not re.search(r"(src|href)\s*=|@import|url\(", without_three), "the page points out of itself"
    assert "{{" not in without_three


def play(page):
    play_button = page.find("play")
    assert abs(page.time() - page.js("divotReport.player.end")) < 1e-9, "it opens at the end"
    play_button.click()  # from the end: starts again
    page.wait("playing", lambda: 0.1 < page.time() < page.js("divotReport.player.end") - 0.1)
    assert play_button.text == "Pause"
    play_button.click()
    stopped = page.time()
    time.sleep(0.3)
    assert page.time() == stopped and play_button.text == "Play"
    assert page.find("clock").text == f"{stopped:.2f} s", page.find("clock").text
    page.find("name").click()
    page.driver.switch_to.active_element.send_keys(" ")
    page.wait("space to play", lambda: page.time() != stopped)
    page.driver.switch_to.active_element.send_keys(" ")


def scrub(page):
    bar = page.find("scrubber")
    width = bar.size["width"]
    ActionChains(page.driver).move_to_element_with_offset(bar, -width // 2 + 3, 0).click().perform()
    assert page.time() < 0.05 * page.js("divotReport.player.end"), page.time()
    first = page.picture("start")
    ActionChains(page.driver).move_to_element_with_offset(bar, -width // 2 + 3, 0).click_and_hold() \
        .move_by_offset(width - 6, 0).release().perform()
    assert page.time() > 0.95 * page.js("divotReport.player.end"), page.time()
    assert page.picture("end") != first, "the ground has changed"


def look(page):
    before = page.picture("end")
    page.find("wireframe").click()
    lines = page.picture("wireframe")
    assert lines != before
    page.find("wireframe").click()
    assert page.picture("end") == before, "lines go away again"
    for mode in ("ground", "height", "material"):
        Select(page.find("colors")).select_by_value(mode)
        assert page.picture(mode) != before
    Select(page.find("colors")).select_by_value("sinkage")
    assert page.find("legend-high").text.endswith("m sunk")
    if page.js("divotReport.facts.bodies.length"):
        page.find("paths").click()
        assert page.picture("no_paths") != before
        page.find("paths").click()
    ActionChains(page.driver).drag_and_drop_by_offset(page.find("view"), 150, -40).perform()
    assert page.picture("turned") != before
    page.find("home").click()
    assert page.picture("end") == before


def check_panels(page):
    titles = [h.text for h in page.driver.find_elements(By.CSS_SELECTOR, ".panel h2")]
    for title in ("Energy", "Soil", "Milliseconds per stage", "Scene"):
        assert title in titles, titles
    facts = page.js("divotReport.facts")
    assert sum(t.startswith("Crater") for t in titles) == len(facts["craters"])
    for svg in page.driver.find_elements(By.CSS_SELECTOR, ".panel svg"):
        assert "NaN" not in svg.get_attribute("innerHTML")
    assert facts["version"] in page.find("made").text and "[terrain]" in page.find("scene").text


def main(divot, scene, folder):
    folder = pathlib.Path(folder)
    if not shutil.which("chromedriver"):
        sys.exit(77)
    subprocess.run([divot, "run", scene, "--report", "--quiet", "--out", folder], check=True)
    check_file(folder / "report.html")
    driver = browser()
    try:
        driver.get((folder / "report.html").resolve().as_uri())
        page = Page(driver, folder)
        page.wait("the run", lambda: page.js("window.divotReport !== undefined || !document.getElementById('trouble').hidden"))
        assert page.find("trouble").text == "", page.find("trouble").text
        check_panels(page)
        play(page)
        scrub(page)
        look(page)
        (folder / "page.png").write_bytes(driver.get_screenshot_as_png())
        severe = [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not severe, severe
    finally:
        driver.quit()
    print("report: all clicks answered")


if __name__ == "__main__":
    main(*sys.argv[1:])
