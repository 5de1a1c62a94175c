"""Reads and checks the files that the page is made from; SCHEMA.md describes them."""

import json
import re
from pathlib import Path

# A tuple holds the types that a value may have, a dict the keys of an object, a list the shape of each of its items.
# A key that ends in ? may be absent or null, and then becomes None.
TEXT, TRUTH, COUNT, LIST, KNOWN, NUMBER = (str,), (bool,), (int,), (list,), (int, float), (int, float, type(None))
EFFORT = {"samples": NUMBER, "cpu_seconds": NUMBER, "extrapolated": TRUTH}
POINT = {"samples": COUNT} | dict.fromkeys((
    "cpu_seconds", "wall_seconds", "relative_rmse", "relative_rmse_low", "relative_rmse_high"), NUMBER)
VERDICTS = ("exact", "converges", "heavy tails", "unexplained", "plateau", "no hits", "not finite")
INTEGRATOR = {
    "name": TEXT, "model": TEXT, "unbiased": TRUTH, "headline": TRUTH, "verdict": TEXT, "points": [POINT],
    "to_1_percent?": EFFORT, "to_10_percent?": EFFORT, "image?": TEXT, "error_image?": TEXT, "image_spp?": NUMBER,
    "image_seconds?": NUMBER, "fireflies?": COUNT, "not_finite?": COUNT, "evaluated?": COUNT, "whole_runs?": TRUTH,
    "spread?": [KNOWN]} | dict.fromkeys((
        "slope", "slope_standard_error", "bias_z", "efficiency", "efficiency_relative_to_power",
        "efficiency_standard_error"), NUMBER)
AGREEMENT = {"integrators": LIST, "block": COUNT, "blocks": COUNT, "worst_z": NUMBER, "limit": NUMBER}
REFERENCE = {"source": TEXT, "value?": NUMBER, "value_error?": NUMBER, "relative_mse": KNOWN,
             "image?": TEXT, "agreement?": AGREEMENT}
VARIANT = dict.fromkeys((
    "cpu_seconds_per_sample", "cpu_seconds_per_sample_standard_error", "instructions_per_sample", "relative_mse",
    "relative_mse_standard_error"), NUMBER)
LEFT_OUT = {"strategies": LIST, "materials": LIST, "composed": VARIANT, "everything": VARIANT, "seconds": NUMBER,
            "instructions_by": TEXT, "time_ratio": NUMBER, "time_ratio_standard_error": NUMBER,
            "instructions_ratio?": NUMBER}
PROBLEM = {"name": TEXT, "group": TEXT, "title": TEXT, "kind": TEXT, "description": TEXT, "strategies": LIST,
           "width?": COUNT, "height?": COUNT, "runs": COUNT, "reference": REFERENCE, "integrators": [INTEGRATOR],
           "left_out?": LEFT_OUT}
STIFF = {"alphas": LIST, "solid_angles": LIST, "seconds": NUMBER, "runs": COUNT,
         "integrators": [{"name": TEXT, "relative_error": LIST, "not_finite?": LIST}]}
RESULTS = {"machine": {"cpu": TEXT, "threads": COUNT, "compiler": TEXT, "flags": TEXT, "date": TEXT, "system?": TEXT},
           "build?": {"version?": TEXT, "revision?": TEXT, "type?": TEXT, "assertions?": TRUTH}, "arguments?": TEXT,
           "settings": {"seeds": [COUNT]},
           "rules?": dict.fromkeys(("bias_z_limit", "tail_share_limit", "tail_share_limit_of_images",
                                    "slope_significance"), NUMBER),
           "error_scale?": {"low": KNOWN, "high": KNOWN},
           "problems": [PROBLEM], "stiff?": STIFF}
ROW = {"kernel": TEXT, "case": TEXT, "scalar": TEXT, "reference": TEXT, "evaluations": COUNT, "misbehaved": COUNT,
       "has_error": TRUTH, "has_usual": TRUTH, "has_z": TRUTH, "passed": TRUTH} | dict.fromkeys((
           "worst_error", "error_limit", "usual_error", "worst_z", "z_limit", "standard_error"), NUMBER)
STABILITY = {"quick": TRUTH, "rows": [ROW]}


def load(path):
    """The results in `path` with every key that the page needs, and the table of extreme cases, or a ValueError."""
    results = read(path, RESULTS)
    names = [problem["name"] for problem in results["problems"]]
    for problem in results["problems"]:
        name, kind = problem["name"], problem["kind"]
        if not re.fullmatch(r"[\w-]+", name) or names.count(name) > 1:
            raise ValueError(f"the problem name '{name}' is used twice or is not of letters, digits, _ and -")
        if kind != "integral" and (kind != "render" or not problem["width"] or not problem["height"]):
            raise ValueError(f"problem {name} is neither an 'integral' nor a 'render' of known width and height")
        for integrator in problem["integrators"]:
            if len(integrator["spread"] or range(5)) != 5:
                raise ValueError(f"problem {name}: a spread is of five numbers")
            if integrator["verdict"] not in VERDICTS:
                raise ValueError(f"problem {name}: the verdict '{integrator['verdict']}' is none of {', '.join(VERDICTS)}")
        images = [owner["image"] for owner in (problem["reference"], *problem["integrators"])]
        errors = [integrator["error_image"] for integrator in problem["integrators"]]
        if any(errors) and not results["error_scale"]:
            raise ValueError(f"problem {name} has error images, but there is no error_scale")
        for image in filter(None, images + errors):
            if Path(image).name != image or not (path.parent / image).is_file():
                raise ValueError(f"problem {name}: the image '{image}' is not in the folder of the results")
    stability = path.with_name("stability.json")
    results["stability"] = read(stability, STABILITY) if stability.is_file() else None
    return results


def read(path, shape):
    content = json.loads(path.read_text(encoding="utf-8"), parse_constant=lambda not_finite: None)
    if not isinstance(content, dict) or content.get("schema") != 1:
        raise ValueError(f"{path.name} is not of schema 1")
    complete(content, shape)
    return content


def complete(value, shape, where=""):
    """Check `value` against `shape`, and add what is absent but need not be there."""
    kinds = shape if isinstance(shape, tuple) else (type(shape),)
    if not isinstance(value, kinds) or isinstance(value, bool) and bool not in kinds:
        expected = " or ".join("null" if kind is type(None) else kind.__name__ for kind in kinds)
        raise ValueError(f"{where} is {json.dumps(value)[:40]}, expected {expected}")
    if value == [] and isinstance(shape, list):
        raise ValueError(f"{where} is empty")
    for index, item in enumerate(value if isinstance(shape, list) else ()):
        complete(item, shape[0], f"{where}[{index}]")
    for key, inner in shape.items() if isinstance(shape, dict) else ():
        name = key.rstrip("?")
        if name != key and value.get(name) is None:
            value[name] = None
        elif name not in value:
            raise ValueError(f"{where}.{name} is missing".lstrip("."))
        else:
            complete(value[name], inner, f"{where}.{name}".lstrip("."))
