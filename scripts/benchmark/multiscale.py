# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: the multi-scale experiment, and COLMAP on the far row and on all rows, from
camera_wrong.yaml, whose fault is of the same size, aligned by the same targets.

Hours; --quick is one seed of the far row, without COLMAP. What it has computed is kept under build/
and taken again.
"""
import json
import os
import shutil

from benchmark import colmap_targets
from benchmark.measure import log, run_timed
from benchmark.simulation import simulate
from benchmark.tables import number, print_table

SCENARIO = "multiscale_500"
COLMAP_LIMIT_S = 6 * 3600.0  # Of a row; two cores take two hours for all rows.
FAR_ROW = "10m"
# Mean of the check points [mm], after the bundle with control points.
MOST_MM = {"10m": 3.0, "6m": 8.0, "4m": 15.0, "all": 3.0}


def add_arguments(parser):
    parser.add_argument("--seeds", type=int, default=2, help="multiscale: faulty calibrations")


def run_experiment(arguments, flight, output):
    command = [arguments.plumbline, "experiment", "multiscale", "--flight", flight,
               "--output", output, "--seeds", str(1 if arguments.quick else arguments.seeds)]
    command += ["--rows", FAR_ROW] if arguments.quick else []
    timing = run_timed(command, output + ".log")
    if timing["exit_code"] != 0:
        raise RuntimeError("experiment multiscale: exit code %d, see %s.log"
                           % (timing["exit_code"], output))
    with open(os.path.join(output, "results.json")) as file:
        return json.load(file)


def run(arguments):
    flight = arguments.flight or os.path.dirname(simulate(arguments.plumbline, SCENARIO).photos)
    output = os.path.join(arguments.output, "multiscale-quick" if arguments.quick else "multiscale")
    log("multiscale: " + flight)
    results = {"flight": flight, "lines": run_experiment(arguments, flight, output),
               "failures": []}
    results["failures"] = faults(results["lines"])
    if shutil.which("colmap") and not arguments.quick:
        results["colmap"] = {}
        for row in (FAR_ROW, colmap_targets.ALL_ROWS):
            log("multiscale: COLMAP, rows " + row)
            results["colmap"][row] = colmap_targets.measure(
                arguments.plumbline, flight, row,
                os.path.join(arguments.output, "colmap-targets-" + row), limit_s=COLMAP_LIMIT_S)
    return results


def faults(lines):
    found = []
    for line in lines:
        most = MOST_MM.get(line["rows"])
        if line["bundle"] != "constrained" or most is None:
            continue
        mean = line["check_mm"] and line["check_mm"]["mean"]
        if mean is None or mean > most:
            found.append("multiscale: rows %s: check points %s mm, at most %g mm"
                         % (line["rows"], number(mean), most))
    return found


def with_spread(figure, digits=2):
    return "-" if figure is None else "%.*f ± %.*f" % (digits, figure["mean"], digits,
                                                       figure["spread"])


def print_results(results):
    rows = [[line["rows"], line["bundle"], with_spread(line["control_mm"]),
             with_spread(line["check_mm"]), with_spread(line["true_check_mm"]),
             with_spread(line["bend_mm"]), with_spread(line["cpu_s"], 0)]
            for line in results["lines"]]
    print_table("Multi-scale experiment, mean errors of the targets",
                ["rows", "bundle", "control mm", "check mm", "to truth mm", "bend mm", "CPU s"],
                rows)
    for row, found in results.get("colmap", {}).items():
        print("  COLMAP, rows %s: %d photos, control %s mm, check %s mm, CPU %s s%s"
              % (row, found["registered"], number(found["control_mm"]),
                 number(found["check_mm"]), number(found["cpu_s"], 0),
                 ", cut off in " + found["cut_off"] if "cut_off" in found else ""))
