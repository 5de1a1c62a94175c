"""Opens a report's page in Chromium, on a desk, a tablet and a phone, in light and dark, and tries all that a reader would.

    page_test.py --folder F         makes pages of made-up results in F, and tests them
    page_test.py PAGE...            tests these pages
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

import made_up_results
from page_checks import AT_FIRST, CHECKS, ON_PAPER

SCREENS = {"desk": (1400, "light"), "tablet": (768, "dark"), "phone": (390, "light"),
           "desk by night": (1400, "dark")}
PAPER = 718  # pixels across an A4 sheet within its margins
REPORT = made_up_results.BENCH / "report" / "report.py"

def browser(driver):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    chromium = webdriver.Chrome(service=Service(driver), options=options)
    chromium.set_script_timeout(120)  # seconds: a busy machine draws no frame for a while
    return chromium


def emulate(chromium, width, scheme, medium=""):
    # Headless windows have a least width; a device's need not.
    chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                             {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600})
    chromium.execute_cdp_cmd("Emulation.setEmulatedMedia",
                             {"media": medium, "features": [{"name": "prefers-color-scheme", "value": scheme}]})


def open_page(page, chromium):
    chromium.get(page.resolve().as_uri())
    chromium.execute_async_script(
        "const done = arguments[0]; Promise.all([...document.images].map(image => image.decode().catch(() => {})))"
        ".then(() => requestAnimationFrame(() => done()))")


def problems_of(page, chromium):
    wrong = []

    def run(checks, where):
        nonlocal wrong
        for check, script in checks.items():
            wrong += [f"{page}, {where}: {check}: {found}" for found in chromium.execute_script(script)]

    for name, (width, scheme) in SCREENS.items():
        emulate(chromium, width, scheme)
        open_page(page, chromium)
        run(AT_FIRST, name)
        # Two frames: observers of sizes are told after the first.
        chromium.execute_async_script(
            "document.querySelectorAll('details').forEach(details => details.open = true);"
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()))")
        run(CHECKS, name)
        wrong += [f"{page}, {name}: {entry['level']}: {entry['message']}" for entry in chromium.get_log("browser")]
    emulate(chromium, PAPER, "light", "print")
    open_page(page, chromium)
    run(dict(reversed(ON_PAPER.items())), "paper")
    emulate(chromium, SCREENS["desk"][0], "light")
    return wrong


def misstatements(page, chromium):
    """What the page of made-up results says otherwise than they do."""
    open_page(page, chromium)
    scene, spoilt, close, overview, first, spoilt_text, totals, spreads = chromium.execute_script("""
        const table = id => [...document.querySelector(`#${id} .table tbody`).rows];
        const column = (id, i) => table(id).map(row => row.cells[i].dataset.value);
        const row = title => [...document.querySelector(".whole tbody").rows].find(row => row.innerText.includes(title));
        const cells = title => [...row(title).cells].map(cell => cell.innerText.split("\\n")[0]);
        document.querySelectorAll("details").forEach(details => details.open = true);
        return [[column("made-up", 0), column("made-up", 1)], [column("spoilt", 0), column("spoilt", 1)],
                [column("close", 0), cells("Both are enough")], [cells("made-up"), cells("Spoilt"), cells("Two steps")],
                table("made-up")[0].innerText, document.querySelector("#spoilt").innerText,
                [...document.querySelector(".whole tfoot").rows].map(row => [...row.cells].map(cell => cell.innerText)),
                [...document.querySelectorAll("#two-steps .spread")].map(cell => [
                    cell.dataset.value, +cell.querySelector("rect").getAttribute("x")])]""")
    close_text = chromium.find_element("id", "close").text
    ahead = chromium.find_element("id", "two-steps").text
    expected = {
        "ranking": (scene[0], ["power", "balance", "one-sample", "bsdf", "average", "light"]),
        "verdicts": (scene[1], ["converges"] * 3 + ["heavy tails", "converges", "plateau"]),
        # A time of 0.02 s is the best. Nothing learns, and there are no other points.
        "overview": (overview[0][1:9], ["1.1", "1.0", "2.5", "150", "–", "–", "45!", "never"]),
        # 1 µs is the best: other points are not, and what is ahead of it is below 1.
        "what is beyond": (overview[2][1:8], ["1.0", "1,300", "–", "–", "4.0", "0.00010", "–"]),
        "what is ahead": ("Ahead of it: sobol, 10,000 times as efficient at 64 estimates." in ahead, True),
        # Half of the way to 1/4 is a quarter of the line; beyond 4 times there is no more of it.
        "spreads": (spreads, [["1.9", 29.7], ["2.83", 0]]),
        "first row": ([text in first for text in ("20\u00a0ms", "200\u00a0µs", "20 samples", "one sample", "✓ converges")], [True] * 5),
        "ranking of what is spoilt": (spoilt[0], ["sharp", "power", "blind", "bsdf", "balance"]),
        "its verdicts": (spoilt[1], ["exact", "converges", "no hits", "not finite", "not finite"]),
        "its row": (overview[1][1:10], ["not finite", "1.0", "–", "–", "–", "–", "exact", "not finite", "–"]),
        "its count": ("7 of 1,000 samples" in spoilt_text, True),
        # Already one sample is below 1 %: the time to it says nothing, and the efficiency all.
        "ranking by efficiency": (close[0], ["average", "light by solid angle", "light", "power", "balance"]),
        "its factors": ([close[1][i] for i in (1, 2, 4, 7, 9)], ["8.3", "3.9", "0.039!", "1.0", "0.24"]),
        "its words": ([text in close_text for text in ("one sample", "4.1 times as efficient")], [True] * 2),
        "what is left of the mean": (totals[0][1].startswith("2.1") and "never for 1" in totals[0][1], True)}
    header = chromium.find_element("css selector", "#made-up .table th button")
    header.send_keys("\ue007")  # Enter
    sorted_by = chromium.execute_script("return arguments[0].closest('th').getAttribute('aria-sort')", header)
    expected["sorting by the keyboard"] = sorted_by, "ascending"
    return [f"{page}: {what} is {found}, expected {wanted}" for what, (found, wanted) in expected.items() if found != wanted]


def wrong_advice(page, chromium):
    """What the page of many problems advises otherwise than its figures say: 2 µs of power against 1/16 to 32 µs."""
    open_page(page, chromium)
    found = chromium.execute_script("""
        return [...document.querySelectorAll("[aria-labelledby=overview] li")].map(item => item.innerText)
            .filter(text => text.includes("as efficient"))""")
    expected = [
        "optimal, where one integral gets many estimates: 2.0 times as efficient as power in the median of 10 problems, "
        "0.062 times at worst, for 64 estimates together; ahead in 5.",
        "allocated, where a pilot can be afforded: 1.3 times as efficient as power in the median of 10 problems, "
        "1.3 times at worst, for 64 estimates together; ahead in 10.",
        "sobol, where you choose the random numbers and dimensions are few, as here: 200,000 times as efficient as power "
        "in the median of 10 problems, 200,000 times at worst, for 64 estimates together; ahead in 10.",
        "resampled, where candidates are cheap and the integrand is dear: 4.0 times as efficient as the best technique alone."]
    return [f"{page}: advises {found}, expected {expected}"] if found != expected else []


def draw(folder, name, results, stability=None):
    """The page of these results."""
    folder.joinpath(name).mkdir(parents=True, exist_ok=True)
    if callable(results):
        results = results(folder / name)
    (folder / name / "results.json").write_text(json.dumps(results), encoding="utf-8")
    if stability:
        (folder / name / "stability.json").write_text(json.dumps(stability), encoding="utf-8")
    outcome = subprocess.run([sys.executable, REPORT, folder / name / "results.json"], text=True, capture_output=True)
    return folder / name / "index.html", outcome


def without_time(results, folder):
    del results["problems"][0]["integrators"][0]["points"][0]["cpu_seconds"]
    return results


def with_unknown_reference(results, folder):
    results["problems"][0]["reference"]["relative_mse"] = None
    return results


def with_broken_image(results, folder):
    (folder / "power.png").write_bytes(b"no image")
    return results


def with_image_elsewhere(results, folder):
    results["problems"][1]["integrators"][0]["image"] = "../example/index.html"
    return results


def with_half_a_spread(results, folder):
    results["problems"][0]["integrators"][0]["spread"] = [0.5, 1]
    return results


def with_unknown_verdict(results, folder):
    results["problems"][0]["integrators"][0]["verdict"] = "fine"
    return results


REFUSED = {  # how results are spoilt, and what has to be said about it
    "a missing time": (without_time, "problems[0].integrators[0].points[0].cpu_seconds is missing"),
    "a reference without an error": (with_unknown_reference, "problems[0].reference.relative_mse is null"),
    "an unknown verdict": (with_unknown_verdict, "the verdict 'fine' is none of exact"),
    "half a spread": (with_half_a_spread, "a spread is of five numbers"),
    "a broken image": (with_broken_image, "power.png"),
    "an image elsewhere": (with_image_elsewhere, "'../example/index.html' is not in the folder"),
}


def made_up_pages(folder):
    """Pages, and what went wrong on the way to them."""
    wrong, pages = [], []
    for page, outcome in (draw(folder, "example", made_up_results.example()),
                          draw(folder, "whole", made_up_results.whole, made_up_results.stability()),
                          draw(folder, "many", made_up_results.many()),
                          draw(folder, "nothing", made_up_results.nothing_finite())):
        pages.append(page)
        wrong += [f"{page}: {outcome.stderr}"] if outcome.returncode else []
    for name, (spoil, message) in REFUSED.items():
        outcome = draw(folder, "refused", lambda folder: spoil(made_up_results.whole(folder), folder))[1]
        if outcome.returncode == 0 or message not in outcome.stderr or "Traceback" in outcome.stderr:
            wrong.append(f"{name} is not refused by name: {outcome.stderr}")
    return pages, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", type=Path)
    parser.add_argument("--folder", type=Path, help="for pages of made-up results")
    parser.add_argument("--driver", default="chromedriver")
    arguments = parser.parse_args()
    pages, wrong = made_up_pages(arguments.folder) if arguments.folder else ([], [])
    pages += arguments.pages
    if not pages:
        parser.error("no page to test")
    if not wrong:
        chromium = browser(arguments.driver)
        try:
            for page in pages:
                wrong += problems_of(page, chromium)
            if arguments.folder:
                wrong += misstatements(arguments.folder / "whole" / "index.html", chromium)
                wrong += wrong_advice(arguments.folder / "many" / "index.html", chromium)
        finally:
            chromium.quit()
    print(*wrong or [f"{len(pages)} pages, {len(SCREENS)} screens, {len(CHECKS)} checks: all is well"], sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
