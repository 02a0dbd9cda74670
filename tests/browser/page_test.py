# SPDX-License-Identifier: Apache-2.0
"""Opens the page that hcsp-solve writes for the shipped SLAM model and uses it as a person would.

It must make no network request, log nothing, and redraw map and plots for every pass of the slider.
"""
import argparse
import hashlib
import os
import subprocess
import sys
import tempfile

from chromium import Chromium

MAP = "document.querySelector('#map canvas').toDataURL()"
MARKS = "document.querySelector('#map svg').outerHTML"
PLOTS = "document.querySelector('#plots').innerHTML"
TIP = "document.getElementById('tip')"

failures = []


def check(holds, message):
    print(("ok   " if holds else "FAIL ") + message)
    if not holds:
        failures.append(message)


def digest(browser, expression):
    return hashlib.sha256(browser.evaluate(expression).encode()).hexdigest()


def check_content(browser):
    texts = browser.evaluate("['model', 'status', 'facts', 'contractors', 'domains', 'legend']"
                             ".map((id) => document.getElementById(id).textContent)")
    check(all(texts), f"every part of the page has its text: {[text[:24] for text in texts]}")
    check(browser.evaluate("document.title").startswith(texts[0]), "the title names the model")
    legend = texts[5]
    check(all(part in legend for part in ("D inside", "M unknown", "true x")), f"the legend shows sets and truth: {legend}")
    colours = browser.evaluate(
        "(() => { const c = document.querySelector('#map canvas'), d = c.getContext('2d').getImageData(0, 0, c.width,"
        "c.height).data; const seen = new Set(); for (let i = 0; i < d.length; i += 4) seen.add(d[i] << 16 | d[i + 1] << 8"
        "| d[i + 2]); return seen.size; })()")
    check(colours >= 4, f"the map has {colours} colours")
    check(browser.evaluate("document.querySelectorAll('#plots svg').length") == 3, "width and both components are plotted")
    check(browser.evaluate("document.querySelectorAll('#plots path.truth').length") == 2, "the truth is in the plots")


def check_slider(browser):
    last = int(browser.evaluate("document.getElementById('pass').max"))
    check(last >= 2, f"the slider has {last + 1} positions")
    browser.evaluate("document.getElementById('pass').focus()")
    browser.press("Home")
    maps, plots, labels = [], [], []
    for position in range(last + 1):
        check(browser.evaluate("document.getElementById('pass').value") == str(position), f"the keyboard reaches position {position}")
        maps.append(digest(browser, MAP))
        plots.append(digest(browser, PLOTS))
        labels.append(browser.evaluate("document.getElementById('pass-label').textContent"))
        browser.press("ArrowRight")
    print("     positions:", ", ".join(labels))
    check(len(set(labels)) == len(labels), "every position has its own label")
    check(len(set(maps[:3])) == 3, "the slider changes the map")
    check(len(set(plots[:3])) == 3, "the slider changes the plots")
    check(maps[0] != maps[-1] and plots[0] != plots[-1], "the first and the last pass differ")
    browser.press("Home")
    check(digest(browser, MAP) == maps[0] and digest(browser, PLOTS) == plots[0], "going back draws the same again")
    browser.click("#play")
    browser.wait(0.9 * last + 1.5)
    check(browser.evaluate("document.getElementById('pass').value") == str(last), "the button plays to the last pass")
    check(digest(browser, MAP) == maps[-1], "playing ends with the same map")


def check_mouse(browser):
    x, y = browser.middle("#map svg")
    before = digest(browser, MAP)
    browser.move_mouse(x, y)
    tip = browser.evaluate(TIP + ".hidden ? '' : " + TIP + ".innerText")
    check("D" in tip and any(state in tip for state in ("inside", "unknown", "outside")), f"hovering tells the cells: {tip!r}")
    browser.wheel(x, y, -240)
    zoomed = digest(browser, MAP)
    check(zoomed != before, "the wheel zooms the map")
    browser.drag((x, y), (x + 60, y + 40))
    check(digest(browser, MAP) != zoomed, "dragging pans the map")
    browser.click("#fit")
    browser.wait(0.6)
    check(digest(browser, MAP) == before, "Fit shows everything again")
    browser.evaluate("document.querySelector('#legend button').click()")
    check(digest(browser, MAP) != before, "the legend switches a layer off")
    browser.evaluate("document.querySelector('#legend button').click()")
    x, y = browser.middle("#plots svg:nth-of-type(2)")
    browser.move_mouse(x, y)
    tip = browser.evaluate(TIP + ".hidden ? '' : " + TIP + ".innerText")
    check("[" in tip and "true" in tip, f"hovering a plot tells bounds and truth: {tip!r}")
    check("class=\"here\"" in browser.evaluate(MARKS), "and the map shows where that is")
    whole = digest(browser, PLOTS)
    browser.drag((x - 60, y), (x + 40, y))
    check(digest(browser, PLOTS) != whole, "dragging zooms the plots")


def main():
    parser = argparse.ArgumentParser()
    for name in ("chromium", "solver", "models"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--page", help="a page that exists, in place of a new one")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        page = arguments.page or os.path.join(folder, "slam.html")
        if not arguments.page:
            subprocess.run([arguments.solver, os.path.join(arguments.models, "slam.hcsp"), "-o", page, "--truth",
                            os.path.join(arguments.models, "room_truth.csv"), "--quiet"], check=True, timeout=60)
        with Chromium(arguments.chromium) as browser:
            browser.open(page)
            check_content(browser)
            check_slider(browser)
            check_mouse(browser)
            for width, height in ((390, 844), (1280, 800)):
                browser.resize(width, height)
                browser.wait(0.3)
                check(browser.evaluate("document.documentElement.scrollWidth") <= width, f"nothing is cut at {width}x{height}")
            beyond = [url for url in browser.requests() if not url.startswith(("file://" + os.path.abspath(page), "data:"))]
            check(not beyond, f"the page makes no network request {beyond}")
            complaints = browser.complaints()
            check(not complaints, f"the page logs nothing {complaints}")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
