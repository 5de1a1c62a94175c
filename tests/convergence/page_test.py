"""Opens a report's page in Chromium, as wide as a desk's screen and as a phone's, and tries all that a reader would.

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

WIDTHS = {"desk": 1400, "phone": 390}
REPORT = made_up_results.BENCH / "report" / "report.py"

# Each of these yields a list of what is wrong.
CHECKS = {
    "everything is in the page": """
        return performance.getEntriesByType("resource").map(entry => entry.name).filter(name => !name.startsWith("data:"))
            .map(name => "it loads " + name)""",
    "every image and plot shows": """
        const wrong = [...document.images].filter(image => {
            const box = image.getBoundingClientRect();
            return !image.complete || image.naturalWidth < 8 || box.width < 40 || box.height < 15;
        }).map(image => "not shown: " + image.alt);
        if (!document.images.length) wrong.push("there is no image");
        return wrong.concat([...document.images].filter(image => !image.alt).map(() => "an image without words for it"))""",
    "no figure is missing": """
        return [...document.querySelectorAll("p, td:not(.prose), th, dd, li, figcaption")].map(e => e.innerText)
            .filter(text => /undefined|\\bNone\\b|\\bnan\\b|NaN/.test(text)).map(text => "the text has: " + text)""",
    "nothing is wider than the screen": """
        const width = document.documentElement.clientWidth;
        if (document.documentElement.scrollWidth > width) return ["the page scrolls sideways"];
        return [...document.querySelectorAll("p, h1, h2, h3, img, canvas, dd, li, .table, summary")]
            .filter(e => !e.closest(".table") || e.matches(".table"))
            .filter(e => e.getBoundingClientRect().right > width + 1 || e.scrollWidth > e.clientWidth + 1 && e.matches("p, h1, h2, h3, dd, summary"))
            .map(e => "too wide: " + e.outerHTML.slice(0, 80))""",
    "text can be read": """
        const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), small = [];
        while (walker.nextNode()) {
            const node = walker.currentNode, parent = node.parentElement;
            if (!node.data.trim() || parent.closest("script, style")) continue;
            if (parseFloat(getComputedStyle(parent).fontSize) < 11) small.push("too small: " + node.data.trim().slice(0, 60));
        }
        return small""",
    "tables sort by each column, both ways": """
        const wrong = [];
        for (const table of document.querySelectorAll("table")) {
            [...table.tHead.rows[0].cells].forEach((header, column) => {
                for (const again of [false, true]) {
                    header.querySelector("button").click();
                    const sign = header.getAttribute("aria-sort") === "descending" ? -1 : 1;
                    const values = [...table.tBodies[0].rows].map(row => row.cells[column].dataset.value);
                    const known = values.filter(value => value !== "");
                    const isText = header.classList.contains("name");
                    const inOrder = (a, b) => isText ? sign * a.localeCompare(b) <= 0 : sign * (a - b) <= 0;
                    if (!known.every((value, i) => i === 0 || inOrder(known[i - 1], value))
                        || values.slice(known.length).some(value => value !== ""))
                        wrong.push(header.innerText + " does not sort in " + table.parentNode.ariaLabel);
                    if (!isText && known.some(value => isNaN(Number(value)))) wrong.push(header.innerText + " is not of numbers");
                }
            });
        }
        if (!document.querySelector("table")) wrong.push("there is no table");
        return wrong""",
    "a closer look follows": """
        const wrong = [];
        for (const looker of document.querySelectorAll(".looker")) {
            const seen = () => [...looker.querySelectorAll("canvas")].map(canvas => canvas.toDataURL()).join();
            const views = [...looker.querySelectorAll("canvas")];
            if (views.length !== looker.querySelectorAll(".view").length || views.length < 3) wrong.push("a view is missing");
            const isBlank = canvas => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data
                .every(byte => byte === 0);
            if (views.some(isBlank)) wrong.push("a view is blank");
            const before = seen(), image = looker.querySelector(".view img"), box = image.getBoundingClientRect();
            image.dispatchEvent(new MouseEvent("click", {clientX: box.left + 1, clientY: box.top + 1}));
            if (seen() === before) wrong.push("a tap changes nothing");
            const far = seen(), range = looker.querySelector("input");
            range.value = range.max;
            range.dispatchEvent(new Event("input"));
            if (seen() === far) wrong.push("no closer");
            looker.querySelector("button").click();
            if (looker.querySelectorAll("button[aria-pressed=true]").length !== 1) wrong.push("no button is pressed");
        }
        return wrong""",
}


def browser(driver):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(driver), options=options)


def problems_of(page, chromium):
    wrong = []
    for name, width in WIDTHS.items():
        # Headless windows have a least width; a device's need not.
        chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                 {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": name == "phone"})
        chromium.get(page.resolve().as_uri())
        chromium.execute_script("document.querySelectorAll('details').forEach(details => details.open = true)")
        chromium.execute_async_script(
            "const done = arguments[0]; Promise.all([...document.images].map(image => image.decode().catch(() => {})))"
            ".then(() => requestAnimationFrame(() => done()))")
        for check, script in CHECKS.items():
            wrong += [f"{page}, {name}: {check}: {found}" for found in chromium.execute_script(script)]
        wrong += [f"{page}, {name}: {entry['level']}: {entry['message']}" for entry in chromium.get_log("browser")]
    return wrong


def misstatements(page, chromium):
    """What the page of made-up results says otherwise than they do."""
    chromium.get(page.resolve().as_uri())
    names, verdicts, factors, first = chromium.execute_script("""
        const rows = [...document.querySelector("#made-up .table tbody").rows];
        const overview = [...document.querySelector(".whole tbody").rows].find(row => row.innerText.includes("made-up"));
        return [rows.map(row => row.cells[0].dataset.value), rows.map(row => row.cells[8].dataset.value),
                [...overview.cells].map(cell => cell.innerText.split("\\n")[0]), rows[0].innerText]""")
    expected = {
        "ranking": (names, ["power", "balance", "one-sample", "bsdf", "average", "light"]),
        "verdicts": (verdicts, ["converges"] * 3 + ["heavy tails", "converges", "plateau"]),
        "overview": (factors[1:7], ["1.1", "1.0", "2.5", "150", "45!", "never"]),  # a time of 0.02 s is the fastest
        "first row": ([text in first for text in ("20\u00a0ms", "200\u00a0µs*", "✓ converges")], [True] * 3)}
    return [f"{page}: {what} is {found}, expected {wanted}" for what, (found, wanted) in expected.items() if found != wanted]


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


REFUSED = {  # how results are spoilt, and what has to be said about it
    "a missing time": (without_time, "problems[0].integrators[0].points[0].cpu_seconds is missing"),
    "a reference without an error": (with_unknown_reference, "problems[0].reference.relative_mse is null"),
    "a broken image": (with_broken_image, "power.png"),
    "an image elsewhere": (with_image_elsewhere, "'../example/index.html' is not in the folder"),
}


def made_up_pages(folder):
    """Pages, and what went wrong on the way to them."""
    wrong, pages = [], []
    for page, outcome in (draw(folder, "example", made_up_results.example()),
                          draw(folder, "whole", made_up_results.whole, made_up_results.stability())):
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
        finally:
            chromium.quit()
    print(*wrong or [f"{len(pages)} pages, {len(WIDTHS)} widths, {len(CHECKS)} checks: all is well"], sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
