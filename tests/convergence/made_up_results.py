"""Results of no run, for tests of the page: the example of SCHEMA.md, and a small scene with all that a page can show."""

import json
import math
import re
from pathlib import Path

import numpy as np
from PIL import Image

BENCH = Path(__file__).resolve().parents[2] / "bench" / "convergence"
WIDTH, HEIGHT = 60, 40


def example():
    """The example of SCHEMA.md, to the letter."""
    return json.loads(re.search(r"```json\n(.*?)```", (BENCH / "SCHEMA.md").read_text(encoding="utf-8"), re.DOTALL)[1])


def estimator(name, seconds, **changes):
    """One that takes so long to an error of 1 %."""
    points = []
    for i in range(4):
        time, error = 1e-3 * 4 ** i, 0.01 * math.sqrt(seconds / (1e-3 * 4 ** i))
        points.append({"samples": 4 ** i, "runs": 8, "cpu_seconds": time, "cpu_seconds_standard_error": 0.01 * time,
                       "wall_seconds": time / 2, "rmse": error, "rmse_standard_error": 0.1 * error,
                       "relative_mse": error ** 2, "relative_mse_standard_error": 0.1 * error ** 2,
                       "relative_rmse": error, "relative_rmse_low": 0.9 * error, "relative_rmse_high": 1.1 * error})
    return {"name": name, "model": "multi-sample", "heuristic": name, "counts": [1, 1], "probabilities": None,
            "headline": True, "unbiased": True, "verdict": "converges", "points": points, "mean": None,
            "mean_standard_error": None, "bias_z": 0.3, "tail_share": 0.01, "slope": -0.501, "slope_standard_error": 0.004,
            "efficiency": 1e4 / seconds, "efficiency_relative_to_power": 0.02 / seconds, "efficiency_standard_error": 0.001,
            "to_1_percent": {"samples": seconds * 1e3, "cpu_seconds": seconds, "extrapolated": seconds > 0.064},
            "to_10_percent": {"samples": 1, "cpu_seconds": seconds / 100, "extrapolated": True}} | changes


def scene(folder):
    """With images of noise: the less of it, the better."""
    noise = np.random.default_rng(1)
    Image.fromarray(np.full((HEIGHT, WIDTH, 3), 128, np.uint8)).save(folder / "reference.png")
    integrators = []
    for name, seconds, spread, changes in (
            ("power", 0.02, 20, {}), ("balance", 0.021, 20, {}), ("one-sample", 0.05, 40, {"model": "one-sample"}),
            ("average", 3, 80, {}), ("bsdf", 0.9, 90, {"model": "alone", "verdict": "heavy tails", "bias_z": -2.5}),
            ("light", 1e-4, 60, {"model": "alone", "verdict": "plateau", "unbiased": False, "bias_z": 4e12,
                                 "to_10_percent": None})):
        integrator = estimator(name, seconds, **changes)
        image = np.clip(noise.normal(128, spread, (HEIGHT, WIDTH, 3)), 0, 255).astype(np.uint8)
        error = np.clip(noise.normal(spread, 30, (HEIGHT, WIDTH)), 0, 255).astype(np.uint8)
        Image.fromarray(image).save(folder / f"{name}.png")
        Image.fromarray(error).save(folder / f"{name}_error.png")
        integrators.append(integrator | {"image": f"{name}.png", "error_image": f"{name}_error.png", "image_spp": 16,
                                         "image_seconds": 0.4, "fireflies": spread // 10})
    variant = {"cpu_seconds_per_sample": 9e-7, "cpu_seconds_per_sample_standard_error": 1e-9,
               "instructions_per_sample": 10433.2, "relative_mse": 0.0178, "relative_mse_standard_error": 2e-4}
    return {"name": "made-up", "title": "A made-up scene <&>", "kind": "render", "group": "scenes",
            "description": "Grey, and noise.", "strategies": ["Diffuse: MultiSample<PowerHeuristic, A<B>, A<B>>"],
            "width": WIDTH, "height": HEIGHT, "runs": 8, "integrators": integrators,
            "reference": {"source": "mean of two", "value": None, "rmse": 0.02, "relative_mse": 2e-4,
                          "image": "reference.png", "agreement": {"integrators": ["power", "balance"], "block": 16,
                                                                  "blocks": 6, "worst_z": 2.8, "limit": 5.5}},
            "left_out": {"strategies": ["EnvironmentMap"], "materials": [], "composed": variant,
                         "everything": variant | {"instructions_per_sample": None}, "seconds": 0.1,
                         "instructions_by": "nobody", "time_ratio": 1.0, "time_ratio_standard_error": 0.004,
                         "instructions_ratio": None}}


def unknown(name, verdict, **changes):
    """One of which no error is known."""
    none = dict.fromkeys(("slope", "slope_standard_error", "bias_z", "tail_share", "efficiency",
                          "efficiency_relative_to_power", "efficiency_standard_error", "to_1_percent", "to_10_percent"))
    made = estimator(name, 1, verdict=verdict) | none | changes
    for point in made["points"]:
        point |= {key: None for key in point if key.startswith("r") and key != "runs"}
    return made


def spoilt():
    """Some of it is not finite, hits nothing, or is exact."""
    integrators = [
        unknown("bsdf", "not finite", model="alone", not_finite=7, evaluated=1000), estimator("power", 0.02),
        unknown("balance", "not finite", not_finite=999, evaluated=1000), unknown("blind", "no hits", headline=False),
        unknown("sharp", "exact", model="alone", to_1_percent={"samples": 1, "cpu_seconds": 1e-8, "extrapolated": True})]
    return example()["problems"][0] | {"name": "spoilt", "title": "Spoilt", "strategies": ["bsdf", "sharp"],
                                       "integrators": integrators}


def close():
    """One sample is enough for each: the fastest sample is not the best, and the one that seems best has heavy tails."""
    integrators = []
    for name, sample, efficiency, model in (("light", 25e-9, 3.9, "alone"), ("power", 96e-9, 1.0, "multi-sample"),
                                            ("balance", 105e-9, 0.47, "multi-sample"),
                                            ("light by solid angle", 58e-9, 16.0, "alone")):
        enough = {"samples": 1, "cpu_seconds": sample, "extrapolated": True}
        integrators.append(estimator(name, 1e-7 / efficiency, model=model, to_1_percent=enough, to_10_percent=enough,
                                     efficiency_relative_to_power=efficiency))
    integrators.append(estimator("average", 1e-9, efficiency_relative_to_power=100, verdict="heavy tails"))
    return example()["problems"][0] | {"name": "close", "title": "Both are enough", "strategies": ["bsdf", "light"],
                                       "integrators": integrators}


def many():
    """So many problems that the page says what to use, with every kind of estimator; two that resample in one of them."""
    problem = example()["problems"][0]
    problems = []
    for i in range(10):
        integrators = [
            estimator("balance", 3e-6), estimator("power", 2e-6), estimator("one-sample", 9e-6), estimator("average", 1e-3),
            estimator("uniform on [0, 1)", 1e-6, model="alone"),
            estimator("optimal", 1e-6 * 2 ** (i - 4), model="optimal", whole_runs=True),
            estimator("allocated", 1.5e-6, model="allocated", whole_runs=True),
            estimator("sobol", 1e-11, model="sobol", whole_runs=True)]
        problems.append(problem | {"name": f"problem-{i}", "title": f"Problem {i}, of which there are many",
                                         "integrators": integrators})
    problems.append(problem | {"name": "resampling", "title": "Resampling", "strategies": [], "integrators": [
        estimator("by power", 4e-6, model="alone"), estimator("resampled 1", 4e-6, model="resampled"),
        estimator("resampled 32", 1e-6, model="resampled")]})
    return example() | {"problems": problems}


def nothing_finite():
    results = example()
    results["problems"][0]["integrators"] = [unknown("power", "not finite", not_finite=5, evaluated=10)]
    return results


def whole(folder):
    results = example()
    steps = results["problems"][0]
    steps["integrators"] = [estimator(name, seconds) for name, seconds in (("balance", 1e-6), ("power", 1.3e-3))]
    steps["integrators"] += [estimator(f"balance 1:{i}", 0.01 * i, headline=False) for i in range(2, 30)]
    steps["integrators"] += [
        estimator("sobol", 1e-10, model="sobol", whole_runs=True, spread=[0.5, 0.7, 0.9, 1.1, 1.9], slope=-1.3),
        estimator("optimal", 4e-6, model="optimal", whole_runs=True, spread=[0.01, 0.02, 0.05, 0.1, 2.83])]
    results["problems"] += [scene(folder), spoilt(), close()]
    results["error_scale"] = {"low": 1e-3, "high": 10}
    results["build"] = {"version": "0", "type": "Release", "assertions": False}
    results["rules"] = {"bias_z_limit": 5, "tail_share_limit": 0.2, "tail_share_limit_of_images": 0.5,
                        "slope_significance": 1e-4}
    results["groups"] = "a key that nobody knows"
    errors = [[4.3e-8, 9.3e-7, 8.4e-5, 2.6e-3, 4.3e-3], [9.1e-7, 8.4e-5, 2.7e-3, 0.032, 0.048],
              [8.6e-5, 2.6e-3, 0.033, 0.22, 0.53], [2.6e-3, 0.033, 0.22, 1.6, 42]]
    spoilt_errors, spoilt_counts = [list(row) for row in errors], [[0] * 5 for _ in errors]
    spoilt_errors[1][2], spoilt_counts[1][2] = None, 3
    results["stiff"] = {"alphas": [0.1, 0.01, 0.001, 0.0001], "solid_angles": [1e-6, 1e-4, 1e-2, 1, 6.283185307179586],
                        "seconds": 2e-3, "runs": 16, "integrators": [
                            {"name": "bsdf", "relative_error": spoilt_errors, "not_finite": spoilt_counts},
                            {"name": "power", "relative_error": errors}]}
    return results


def stability():
    row = {"kernel": "SphericalRectangle, a sliver", "case": "ratios of edges from 1 to 1e6, seen from all sides, near and far",
           "scalar": "float", "reference": "quad",
           "evaluations": 1000, "misbehaved": 0, "has_error": True, "worst_error": 1e-7, "error_limit": 1e-6,
           "has_usual": True, "usual_error": None, "has_z": False, "worst_z": None, "z_limit": 5, "standard_error": None,
           "cpu_seconds": 0.1, "passed": True}
    return {"schema": 1, "quick": True, "rows": [row, row | {"worst_error": 1e-3, "passed": False}]}
