# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: how simulated photos look to feature matching, beside real ones.

The figures are those of test/benchmark/realism_benchmark.cc, defined alike for both.
"""
import json
import os
import statistics
import subprocess

from benchmark.measure import log
from benchmark.programs import built_benchmark
from benchmark.scenes import find_scenes
from benchmark.simulation import simulate
from benchmark.tables import number, print_table

REAL = ["fountain-P11", "Herz-Jesus-P8"]
SIMULATED = [("demo", None), ("multiscale_500", "6m")]
MAX_PHOTOS = 10  # Neighbours: those that follow each other in one row.
MAX_RATIO = 2.0  # Of a simulated figure to the real scenes' mean, or the inverse.
COMPARED = {"features_per_mp": 0, "opencv_per_mp": 0, "features": 0, "matches": 0,
            "inlier_ratio": 3, "repeatability": 3, "parallax_deg": 1}


def add_arguments(_):
    pass


def measure(program, folder):
    done = subprocess.run([program, folder, str(MAX_PHOTOS)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return json.loads(done.stdout)


def run(arguments):
    results = {"scenes": {}, "simulated": [], "failures": []}
    program = built_benchmark("realism_benchmark")
    scenes = [(name, lambda name=name: find_scenes(arguments.data, [name])[0]) for name in REAL]
    for name, rows in SIMULATED:
        scenes.append((name, lambda name=name, rows=rows: simulate(
            arguments.plumbline, name, rows, MAX_PHOTOS)))
    for name, make_scene in scenes:
        try:
            scene = make_scene()
            log("realism of %s" % scene.name)
            results["scenes"][scene.name] = measure(program, os.path.dirname(scene.photos))
            results["simulated"] += [scene.name] if name not in REAL else []
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            results["failures"].append("realism of %s: %s" % (name, error))
    results["ratios"] = {name: ratios(results, name) for name in results["simulated"]}
    return results


def ratios(results, name):
    """Simulated over the mean of the real scenes; empty where there are none."""
    real = [figures for scene, figures in results["scenes"].items() if scene in REAL]
    if not real:
        return {}
    return {key: results["scenes"][name][key] / statistics.mean(r[key] for r in real)
            for key in COMPARED}


def print_results(results):
    rows = [[name, figures["photos"], number(figures["megapixels"], 1)] +
            [number(figures[key], digits) for key, digits in COMPARED.items()]
            for name, figures in results["scenes"].items()]
    for name, values in results["ratios"].items():
        rows.append([name + " / real", "", ""] + [ratio_cell(values, key) for key in COMPARED])
    print_table("Realism: medians over photos and over pairs of neighbours; !: beyond a factor of "
                "%g" % MAX_RATIO,
                ["scene", "photos", "MP", "SIFT/MP", "OpenCV SIFT/MP", "taken", "matches",
                 "inliers", "repeated", "parallax deg"], rows)


def ratio_cell(values, key):
    if key not in values:
        return "-"
    is_far = not 1.0 / MAX_RATIO <= values[key] <= MAX_RATIO
    return "%.2f%s" % (values[key], "!" if is_far and key != "parallax_deg" else "")
