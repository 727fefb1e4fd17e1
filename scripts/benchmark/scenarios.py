# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: the simulated scenarios, reconstructed and held against their exact truth."""
import collections
import json
import os
import shutil
import subprocess

from benchmark.measure import log, run_timed
from benchmark.reconstruction import GROWTH_SCENE_PHOTOS, growth
from benchmark.simulation import scenario_names, simulate
from benchmark.tables import number, print_table

QUICK_PHOTOS = 40


def add_arguments(parser):
    parser.add_argument("--scenario", action="append", choices=scenario_names(),
                        help="only this one; repeat")
    parser.add_argument("--quick", action="store_true",
                        help="no more than the first %d photos of a scenario, and few rendered markers"
                        % QUICK_PHOTOS)


def run(arguments):
    results = {"runs": [], "failures": []}
    for name in arguments.scenario or scenario_names():
        try:
            results["runs"].append(run_scenario(arguments, name))
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            results["failures"].append("scenario %s: %s" % (name, error))
    return results


def run_scenario(arguments, name):
    scene = simulate(arguments.plumbline, name,
                     max_photos=QUICK_PHOTOS if arguments.quick else None)
    session = os.path.join(arguments.output, "scenario-" + scene.name)
    shutil.rmtree(session, ignore_errors=True)
    log("plumbline on scenario %s, %d photos" % (scene.name, scene.num_photos))
    timing = run_timed([arguments.plumbline, "reconstruct", "--photos", scene.photos, "--camera",
                        scene.camera, "--session", session], session + ".log")
    result = {"scenario": scene.name, "photos": scene.num_photos,
              "simulation_s": scene.simulation_s, **timing}
    with open(os.path.join(session, "report.json")) as file:
        report = json.load(file)
    result["registered"] = report["session"]["accepted"]
    result["refused"] = dict(collections.Counter(
        photo["reason"] for photo in report["photos"] if photo["verdict"] != "accepted"))
    result["peak_memory_mib"] = report["run"]["peak_memory_bytes"] / 2**20
    if scene.num_photos >= GROWTH_SCENE_PHOTOS:
        result["growth"] = growth(report["photos"], "cpu_s")
    result["evaluation"] = evaluate(arguments.plumbline, scene, session, result)
    return result


def evaluate(plumbline, scene, session, result):
    """Nothing where fewer than three photos have a pose: there is nothing to align then."""
    if result["registered"] < 3:
        return None
    truth = os.path.join(os.path.dirname(scene.photos), "ground_truth")
    command = [plumbline, "evaluate", "--session", session, "--truth", scene.truth]
    for option, name in (("--surface", "surface.ply"), ("--laser", "laser.ply")):
        path = os.path.join(truth, name)
        command += [option, path] if os.path.exists(path) else []
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return json.loads(done.stdout)


def within(evaluation, key, *path):
    value = evaluation
    for step in path + (key,):
        value = (value or {}).get(step)
    return value


def print_results(results):
    runs = results["runs"]
    print_table("Scenarios; wrong: beyond 10 cm or 1 degree; bend: of the truly flat wall",
                ["scenario", "registered", "wrong", "centre mean mm", "max mm", "bend mm",
                 "sigma mm", "CPU s/photo", "wall s/photo", "growth", "MiB"],
                [pose_row(run) for run in runs])
    print_table("Points of the scenarios against the true surface and the laser scan",
                ["scenario", "points", "median mm", "90 % mm", "max mm", "within 2 mm",
                 "laser median mm", "laser 90 % mm", "laser within 2 mm", "seen within 20 mm"],
                [point_row(run) for run in runs])
    print_table("Photos refused", ["scenario", "reasons"],
                [[run["scenario"], ", ".join("%d %s" % (count, reason) for reason, count in
                                             sorted(run["refused"].items())) or "-"]
                 for run in runs])


def pose_row(run):
    evaluation = run["evaluation"]
    wrong = within(evaluation, "wrong")
    return [run["scenario"], "%d/%d" % (run["registered"], run["photos"]),
            "-" if wrong is None else len(wrong),
            number(within(evaluation, "mean", "center_error_mm")),
            number(within(evaluation, "max", "center_error_mm"), 1),
            number(within(evaluation, "max_bend_mm", "wall")),
            number(within(evaluation, "sigma_mm", "wall")),
            number(run["cpu_s"] / run["photos"]), number(run["wall_s"] / run["photos"]),
            number(run.get("growth")), number(run["peak_memory_mib"], 0)]


def point_row(run):
    evaluation = run["evaluation"]
    cells = [run["scenario"], within(evaluation, "points", "surface", "accuracy") or "-"]
    for truth in ("surface", "laser"):
        keys = ["median_mm", "p90_mm"] + (["max_mm"] if truth == "surface" else [])
        cells += [number(within(evaluation, key, truth, "accuracy")) for key in keys]
        cells.append(number(within(evaluation, "2 mm", truth, "accuracy", "share_within")))
    cells.append(number(within(evaluation, "20 mm", "surface", "completeness", "share_within")))
    return cells
