# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: calibration against truth, on rendered photos and beside OpenCV on equal detections.

The figures are those of test/benchmark/calibration_benchmark.cc.
"""
import statistics

from benchmark.measure import log
from benchmark.programs import built_benchmark, measure
from benchmark.simulation import simulate
from benchmark.tables import number, print_table

NUM_SETS = 50
NUM_QUICK_SETS = 10
# Name, scenario, fixed grid, share of the markers that something lies on, and the bounds.
SOUND = {"focal_percent": 0.05, "principal_px": 1.0, "distortion_px": 0.1}
TROUBLED = {"focal_percent": 0.2}
RENDERED = [("12 photos", "calibration", "-", 0.0, SOUND, None),
            ("a third hidden", "calibration", "-", 0.33, TROUBLED, "wrong_view"),
            ("grid bent by 3 mm", "calibration_bent", "a4", 0.0, TROUBLED, "off_plane"),
            ("grid bent, as strewn", "calibration_bent", "-", 0.0, TROUBLED, "off_plane")]
METHODS = ["opencv", "fixed", "strewn"]
ERRORS = ["focal_percent", "principal_px", "distortion_px"]


def add_arguments(_):
    pass


def run(arguments):
    program = built_benchmark("calibration_benchmark")
    results = {"rendered": [], "sets": {}, "failures": []}
    for name, scenario, grid, hidden, bounds, finding in RENDERED:
        scene = simulate(arguments.plumbline, scenario)
        log("calibration: " + name)
        figures = measure(program, "photos", scene.photos, scene.camera, grid, hidden)
        results["rendered"].append({"name": name, "bounds": bounds, **figures})
        results["failures"] += faults(name, figures, bounds, finding)
    num_sets = NUM_QUICK_SETS if arguments.quick else NUM_SETS
    for kind in ("sound", "troubled"):
        log("calibration: %d %s sets" % (num_sets, kind))
        results["sets"][kind] = measure(program, "sets", num_sets, kind)
    return results


def faults(name, figures, bounds, finding):
    """What is beyond its bound, or not said."""
    result = figures.get("twice", {})
    texts = ["calibration, %s: %s is %s, the bound is %g" % (name, key, result.get(key), bound)
             for key, bound in bounds.items() if not result.get(key, float("inf")) <= bound]
    if finding and finding not in [found["kind"] for found in result.get("findings", [])]:
        texts.append("calibration, %s: the report does not say %s" % (name, finding))
    return texts


def rms(values):
    return (sum(value * value for value in values) / len(values)) ** 0.5 if values else None


def print_results(results):
    rows = []
    for run in results["rendered"]:
        for key, label in (("once", ", lens unknown"), ("twice", "")):
            errors = run.get(key, {})
            rows.append([run["name"] + label, run["photos"], run["markers"]] +
                        [number(errors.get(error), 4) for error in ERRORS] +
                        [number(errors.get("focal_sigma_percent"), 4),
                         number(errors.get("principal_sigma_px"), 3),
                         number(errors.get("distortion_sigma_px"), 3),
                         number(errors.get("rms_px"), 3), errors.get("verdict", "-")])
    print_table("Calibration from rendered photos: errors, then standard deviations promised",
                ["photos of", "photos", "markers", "focal %", "principal px", "distortion px",
                 "focal %", "principal px", "distortion px", "RMS px", "verdict"], rows)
    for run in results["rendered"]:
        for finding in run.get("twice", {}).get("findings", []):
            print("  %s: %s" % (run["name"], finding["text"]))
    for kind, sets in results["sets"].items():
        print_sets(kind, sets)
        print_searches(sets)


def print_sets(kind, sets):
    rows = []
    for method in METHODS:
        row = [method]
        for error in ERRORS:
            values = [one[method][error] for one in sets if error in one[method]]
            row += [number(statistics.median(values), 4), number(rms(values), 4),
                    number(max(values), 4)] if values else ["-"] * 3
        failed = sum(error not in one[method] for one in sets)
        rows.append(row + [failed])
    print_table("%d %s sets of equal detections of the fixed grid: median, RMS, worst"
                % (len(sets), kind),
                ["method", "focal %", "", "", "principal px", "", "", "distortion px", "", "",
                 "failed"], rows)


def print_searches(sets):
    rows = []
    for method in ("orthonormality", "reprojection_fixed", "reprojection_strewn"):
        values = [one["search"][method] for one in sets]
        rows.append([method, number(statistics.median(values), 1), number(max(values), 1),
                     sum(value > 5.0 for value in values), sum(value > 20.0 for value in values)])
    print_table("The same: minimum over 48 focal lengths, 6 % apart, off the truth",
                ["error function", "median %", "worst %", "beyond 5 %", "beyond 20 %"], rows)
