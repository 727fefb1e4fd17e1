# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: how simulated photos look to feature matching, beside real ones.

The figures are those of test/benchmark/realism_benchmark.cc, defined alike for both. Features a
megapixel grow as photos shrink, so small simulated photos stand beside the real ones at their width.
"""
import json
import os
import shutil
import statistics
import subprocess

import yaml

from benchmark.measure import log
from benchmark.programs import built_benchmark
from benchmark.scenes import Scene, find_scenes
from benchmark.simulation import simulate
from benchmark.tables import number, print_table

REAL = ["fountain-P11", "Herz-Jesus-P8"]
REDUCED_WIDTH_PX = 2000  # That of demo.
# Scenario, rows, what the real scenes' names end in.
SIMULATED = [("demo", None, "@%d" % REDUCED_WIDTH_PX), ("multiscale_500", "6m", "")]
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
    scenes = [(name, None, lambda name=name: find_scenes(arguments.data, [name])[0])
              for name in REAL]
    scenes += [(name, None, lambda name=name: reduced(find_scenes(arguments.data, [name])[0],
                                                      arguments.output)) for name in REAL]
    for name, rows, suffix in SIMULATED:
        scenes.append((name, suffix, lambda name=name, rows=rows: simulate(
            arguments.plumbline, name, rows, MAX_PHOTOS)))
    for name, suffix, make_scene in scenes:
        try:
            scene = make_scene()
            log("realism of %s" % scene.name)
            results["scenes"][scene.name] = measure(program, os.path.dirname(scene.photos))
            if suffix is not None:
                results["simulated"].append((scene.name, suffix))
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            results["failures"].append("realism of %s: %s" % (name, error))
    results["ratios"] = {name: ratios(results, name, suffix)
                         for name, suffix in results["simulated"]}
    return results


def reduced(scene, output):
    """The scene with its photos brought to REDUCED_WIDTH_PX, in a folder made anew."""
    name = "%s@%d" % (scene.name, REDUCED_WIDTH_PX)
    folder = os.path.join(output, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "photos"))
    shutil.copytree(os.path.join(os.path.dirname(scene.photos), "ground_truth"),
                    os.path.join(folder, "ground_truth"))
    for photo in sorted(os.listdir(scene.photos)):
        subprocess.run(["convert", os.path.join(scene.photos, photo), "-resize",
                        "%dx" % REDUCED_WIDTH_PX, "-quality", "95",
                        os.path.join(folder, "photos", photo)], check=True)
    with open(scene.camera) as file:
        camera = yaml.safe_load(file)
    scale = REDUCED_WIDTH_PX / camera["image_width"]
    camera["image_width"] = REDUCED_WIDTH_PX
    camera["image_height"] = round(scale * camera["image_height"])
    k = camera["camera_matrix"]["data"]
    for focal, centre in ((0, 2), (4, 5)):
        k[focal] *= scale
        k[centre] = scale * (k[centre] + 0.5) - 0.5
    with open(os.path.join(folder, "camera.yaml"), "w") as file:
        yaml.safe_dump(camera, file)
    return Scene(folder)


def ratios(results, name, suffix):
    """Simulated over the mean of the real scenes; empty where there are none."""
    real = [results["scenes"][scene + suffix] for scene in REAL
            if scene + suffix in results["scenes"]]
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
