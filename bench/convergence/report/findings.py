"""What the page says of the figures: who arrives first, by how much, and whom not to trust."""

import math

from figures import COLORS, MARKERS

TRUSTED = ("converges", "exact")
COMBINED = ("balance", "power", "one-sample", "average")  # of the overview: in every problem, under these names


def find(results):
    """Add to each problem what the page says about it; return the rows of the overview."""
    styles = choose_styles(results["problems"])
    for problem in results["problems"]:
        for integrator in problem["integrators"]:
            integrator["style"] = styles.get(integrator["name"]) if integrator["headline"] else None
        problem["ranking"] = sorted(problem["integrators"], key=rank)
        rivals = [i for i in problem["ranking"] if is_trusted(i) and combines_all(i, problem)]
        problem["fastest"] = next((i for i in rivals if seconds(i)), None)
        problem["other"] = next((i for i in problem["ranking"] if is_trusted(i) and not combines_all(i, problem)
                                 and seconds(i)), None)
    return [overview_row(problem) for problem in results["problems"] if problem["fastest"]]


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


def seconds(integrator, goal="to_1_percent"):
    """CPU seconds to an error, or None if it never gets there."""
    return integrator[goal] and integrator[goal]["cpu_seconds"]


def is_trusted(integrator):
    return integrator["unbiased"] and integrator["verdict"] in TRUSTED


def combines_all(integrator, problem):
    """Whether it is made of the techniques that the problem compares, and not of another one."""
    return integrator["model"] != "alone" or problem["kind"] == "render" or integrator["name"] in problem["strategies"]


def rank(integrator):
    """What is wrong comes last, and before it what never arrives."""
    return not integrator["unbiased"], seconds(integrator) is None, seconds(integrator) or 0


def overview_row(problem):
    """How many times as long as the fastest each takes to an error of 1 %; of the techniques alone, the best and the
    worst; and the best of those that the problem does not combine."""
    slowdown = {i["name"]: cell(i, problem["fastest"]) for i in problem["integrators"]}
    alone = [slowdown[i["name"]] | {"name": i["name"]} for i in problem["integrators"]
             if i["model"] == "alone" and combines_all(i, problem)]
    alone = sorted(alone, key=lambda one: one["factor"]) or [None]
    other = problem["other"] and slowdown[problem["other"]["name"]] | {"name": problem["other"]["name"]}
    return {"problem": problem, "cells": [slowdown.get(name) for name in COMBINED] + [alone[0], alone[-1], other]}


def cell(integrator, fastest):
    time = seconds(integrator) if integrator["unbiased"] else None
    return {"factor": time / seconds(fastest) if time else math.inf, "trusted": is_trusted(integrator)}


def totals(overview):
    """Of each column of the overview: the geometric mean of its factors, how many never arrive, and the largest. And the
    name in the overview that is the choice where nothing is known, if there are problems enough to tell."""
    columns = [[cell["factor"] for cell in column if cell] for column in zip(*(row["cells"] for row in overview))]
    summaries = []
    for factors in columns:
        finite = [factor for factor in factors if math.isfinite(factor)]
        summaries.append({"typical": math.exp(sum(map(math.log, finite)) / len(finite)) if finite else None,
                          "never": len(factors) - len(finite), "worst": max(factors, default=None)})
    combined = dict(zip(COMBINED, summaries))
    safest = min((name for name in combined if combined[name]["typical"] and not combined[name]["never"]),
                 key=lambda name: combined[name]["typical"], default=None)
    return {"columns": summaries, "safest": safest and {"name": safest} | combined[safest] if len(overview) >= 10 else None}


def level(factor):
    """How bad a factor is, from 0 (none) to 4, for its color."""
    return sum(factor > limit for limit in (1.5, 5, 50, 1000))
