"""What the page says of the figures: which estimator is the most efficient, by how much, and whom not to trust."""

import math

from figures import COLORS, MARKERS

TRUSTED = ("converges", "exact")
COMBINED = ("balance", "power", "one-sample", "average")  # of the overview: in every problem, under these names
ALONE = ("best alone", "worst alone")
# Models beyond them, in the order of their columns, which are there if a problem has the model: where each is the choice. They
# are measured by the best of the others, which does not change with them.
BEYOND = {
    "optimal": "where one integral gets many estimates",
    "allocated": "where a pilot can be afforded",
    "sobol": "where you choose the random numbers and dimensions are few, as here",
    "resampled": "where candidates are cheap and the integrand is dear"}
LEVELS = (1.5, 5, 50, 1000)  # factors beyond which a cell has the next color
ENOUGH = 10  # problems, to say of an estimator that it is the choice where nothing is known


def find(results):
    """Add to each problem what the page says about it; return the rows of the overview, and the names of its columns but for
    the techniques alone."""
    styles = choose_styles(results["problems"])
    for problem in results["problems"]:
        for integrator in problem["integrators"]:
            integrator["style"] = styles.get(integrator["name"]) if integrator["headline"] else None
        problem["ranking"] = sorted(problem["integrators"], key=rank)
        trusted = [i for i in problem["ranking"] if is_trusted(i)]
        measured = [i for i in trusted if i["efficiency"] and i["model"] not in BEYOND]
        problem["baseline"] = next((i["name"] for i in sorted(problem["integrators"], key=lambda i: i["name"] != "power")
                                    if i["efficiency_relative_to_power"] == 1), None)
        problem["exact"] = [i["name"] for i in trusted if i["verdict"] == "exact"]
        problem["not_finite"] = [i["name"] for i in problem["ranking"] if i["verdict"] == "not finite"]
        problem["best"] = next((i for i in measured if combines_all(i, problem)), None)
        problem["other"] = next((i for i in measured if not combines_all(i, problem)), None)
        problem["ahead"] = [i | {"times": i["efficiency"] / problem["best"]["efficiency"]} for i in trusted
                            if i["model"] in BEYOND and problem["best"]
                            and (i["efficiency"] or 0) > problem["best"]["efficiency"]]
    beyond = tuple(model for model in BEYOND
                   if any(i["model"] == model for problem in results["problems"] for i in problem["integrators"]))
    return [overview_row(problem, beyond) for problem in results["problems"]], COMBINED + beyond


def choose_styles(problems):
    """One marker for each integrator of a plot, and a color that as few others of the same plot have as possible."""
    styles = {}
    companies = [[i["name"] for i in problem["integrators"] if i["headline"]] for problem in problems]
    for name in dict.fromkeys(sum(companies, [])):
        companions = {other for company in companies if name in company for other in company}
        near = [style["color"] for other, style in styles.items() if other in companions]
        used = [style["color"] for style in styles.values()]
        color = min(COLORS, key=lambda color: (near.count(color), used.count(color)))
        styles[name] = {"color": color, "marker": MARKERS[len(styles) % len(MARKERS)]}
    return styles


def is_trusted(integrator):
    return integrator["unbiased"] and integrator["verdict"] in TRUSTED


def combines_all(integrator, problem):
    """Whether it is made of the techniques that the problem compares, and not of another one."""
    return (integrator["model"] != "alone" or problem["kind"] == "render" or not problem["strategies"]
            or integrator["name"] in problem["strategies"])


def obstacle(integrator):
    """Why no time is enough for it to arrive; empty if one is."""
    if integrator["verdict"] in ("not finite", "no hits"):
        return integrator["verdict"]
    return "never" if not integrator["unbiased"] or integrator["verdict"] == "plateau" else ""


def rank(integrator):
    """By efficiency, which is endless for what is exact. Behind: what is not known, then what is wrong, and last what is
    not finite."""
    behind = ("", "no hits", "never", "not finite").index(obstacle(integrator))
    if integrator["verdict"] == "exact":
        return behind, -math.inf
    return behind, -(integrator["efficiency"] or 0)


def overview_row(problem, beyond):
    """How many times as long as the best each takes to the same error; of each model beyond, its best; of the techniques
    alone, the best and the worst; and the best of those that the problem does not combine."""
    cells = {i["name"]: cell(i, problem["best"]) for i in problem["integrators"]}
    first_of = {i["model"]: i["name"] for i in reversed(problem["ranking"])}
    further = [cells.get(first_of.get(model)) for model in beyond]
    alone = [cells[i["name"]] | {"name": i["name"]} for i in problem["integrators"]
             if i["model"] == "alone" and combines_all(i, problem)]
    alone = sorted((one for one in alone if one["factor"] is not None), key=lambda one: one["factor"]) or [None]
    other = problem["other"] and cells[problem["other"]["name"]] | {"name": problem["other"]["name"]}
    return {"problem": problem,
            "cells": [cells.get(name) for name in COMBINED] + further + [alone[0], alone[-1], other]}


def cell(integrator, best):
    """The factor is 0 for what is exact, endless where there is an obstacle, and None if nothing is known."""
    found = {"trusted": is_trusted(integrator), "word": obstacle(integrator), "factor": None}
    if found["word"]:
        found["factor"] = math.inf
    elif integrator["verdict"] == "exact":
        found |= {"word": "exact", "factor": 0.0}
    elif best and integrator["efficiency"]:
        found["factor"] = best["efficiency"] / integrator["efficiency"]
    return found


def totals(overview, names):
    """For each column of the overview: the geometric mean of its factors, how many never arrive, and the largest. The
    name in the overview that is the choice where nothing is known, if there are problems enough to tell. And the median
    of what a factor's standard error is of it."""
    columns = [[cell["factor"] for cell in column if cell and cell["factor"]]
               for column in zip(*(row["cells"] for row in overview))]
    summaries = []
    for factors in columns:
        finite = [factor for factor in factors if math.isfinite(factor)]
        summaries.append({"typical": math.exp(sum(map(math.log, finite)) / len(finite)) if finite else None,
                          "never": len(factors) - len(finite), "worst": max(factors, default=None),
                          "worst_finite": max(finite, default=None)})
    combined = dict(zip(COMBINED, summaries))
    safest = min((name for name in combined if combined[name]["typical"] and not combined[name]["never"]),
                 key=lambda name: combined[name]["typical"], default=None)
    spreads = sorted(i["efficiency_standard_error"] / i["efficiency_relative_to_power"]
                     for row in overview for i in row["problem"]["integrators"]
                     if i["efficiency_standard_error"] and i["efficiency_relative_to_power"])
    return {"columns": summaries, "spread": spreads[len(spreads) // 2] if spreads else None,
            "alone": summaries[len(names) + 1] if summaries else None,
            "safest": safest and {"name": safest} | combined[safest] if len(overview) >= ENOUGH else None,
            "advice": [advice(overview, names, model, safest) for model in names[len(COMBINED):] if safest]}


def advice(overview, names, model, safest):
    """When a model beyond is the choice, and how many times as efficient as the safest it is, or as the best technique alone
    where no problem has both: in the median of the problems that have both, at worst, and in how many it is ahead."""
    column = names.index(model)
    for reference, name in ((names.index(safest), safest), (len(names), "the best technique alone")):
        pairs = [(row["cells"][reference], row["cells"][column]) for row in overview]
        times = sorted(one["factor"] / other["factor"] for one, other in pairs
                       if one and other and one["factor"] and other["factor"] and math.isfinite(one["factor"]))
        if times:
            break
    whole = [i["points"][-1]["samples"] for row in overview for i in row["problem"]["integrators"]
             if i["model"] == model and i["whole_runs"]]
    return {"name": model, "when": BEYOND[model], "of": len(times), "reference": name,
            "estimates": max(whole, default=None), "ahead": sum(one > 1 for one in times),
            "median": times[len(times) // 2] if times else None, "worst": min(times, default=None)}


def level(factor):
    """How bad a factor is, from 0 (none) to 4, for its color."""
    return sum(factor > limit for limit in LEVELS)
