"""Photograph the images of a scene on a report's page, as docs/report.jpg shows them: python3 screenshot.py PAGE OUT.jpg

Needs chromium-driver and python3-selenium.
"""

import argparse
import base64
import io
import os
from pathlib import Path

from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.service import Service


def photograph(chromium, page, problem, place, width):
    """The images of a problem and their closer look where an estimator errs most."""
    chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                             {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    chromium.get(page.resolve().as_uri())
    box = chromium.execute_async_script("""
        const [problem, place, done] = arguments, looker = document.querySelector(`#${CSS.escape(problem)} .looker`);
        Promise.all([...looker.querySelectorAll("img")].map(image => image.decode())).then(() => {
            [...looker.querySelectorAll("button")].find(button => button.innerText.includes(` ${place} `)).click();
            const box = looker.querySelector(".images").getBoundingClientRect();
            done({x: box.x + scrollX, y: box.y + scrollY, width: box.width, height: box.height, scale: 1});
        })""", problem, place)
    png = chromium.execute_cdp_cmd("Page.captureScreenshot", {"clip": box, "captureBeyondViewport": True})["data"]
    return Image.open(io.BytesIO(base64.b64decode(png))).convert("RGB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--problem", default="veach")
    parser.add_argument("--place", default="bsdf", help="the estimator that errs most where the closer look is")
    parser.add_argument("--width", type=int, default=1400, help="of the page, in pixels")
    parser.add_argument("--driver", default="/usr/bin/chromedriver")
    arguments = parser.parse_args()
    options = webdriver.ChromeOptions()
    sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []
    for argument in ("--headless=new", "--disable-gpu", "--hide-scrollbars", *sandbox):
        options.add_argument(argument)
    chromium = webdriver.Chrome(service=Service(arguments.driver), options=options)
    try:
        photograph(chromium, arguments.page, arguments.problem, arguments.place, arguments.width).save(
            arguments.output, quality=88)
    finally:
        chromium.quit()


if __name__ == "__main__":
    main()
