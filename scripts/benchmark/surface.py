# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: the surface of simulated flights: its truth, its energy, and its time per photo.

The figures are those of test/benchmark/surface_benchmark.cc.
"""
import os
import shutil

from benchmark.measure import run_timed
from benchmark.programs import built_benchmark, measure
from benchmark.simulation import simulate
from benchmark.tables import number, print_table

SCENES = ["demo", "hand_flown"]
SYNTHETIC = {"photos": 500, "landmarks": 300000}
CHECK_EVERY = 10  # Deltas of a scene between checks from scratch.


def add_arguments(parser):
    parser.add_argument("--surface-session", action="append", default=[], metavar="DIR",
                        help="a reconstructed session whose flight is meshed as well; repeat")


def run(arguments):
    results = {"truth": {}, "flights": {}, "failures": []}
    program = built_benchmark("surface_benchmark")
    for name in SCENES:
        try:
            run_scene(arguments, program, name, results)
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            results["failures"].append("surface of %s: %s" % (name, error))
    flights = [(os.path.basename(os.path.normpath(path)), "record", (path,))
               for path in arguments.surface_session]
    flights.append(("synthetic", "synthetic", tuple(str(n) for n in SYNTHETIC.values())))
    for name, mode, inputs in flights:
        try:
            deltas = os.path.join(arguments.output, "surface-%s.deltas" % name)
            measure(program, mode, *inputs, deltas)
            results["flights"][name] = measure(program, "replay", deltas)
            os.remove(deltas)
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            results["failures"].append("flight %s: %s" % (name, error))
    return results


def run_scene(arguments, program, name, results):
    scene = simulate(arguments.plumbline, name)
    session = os.path.join(arguments.output, "surface-" + scene.name)
    shutil.rmtree(session, ignore_errors=True)
    timing = run_timed([arguments.plumbline, "reconstruct", "--photos", scene.photos, "--camera",
                        scene.camera, "--session", session], session + ".log")
    if timing["exit_code"] != 0:
        raise RuntimeError("reconstruct: exit code %d, see %s.log" % (timing["exit_code"], session))
    surface = os.path.join(os.path.dirname(scene.truth), "surface.ply")
    results["truth"][name] = measure(program, "truth", session, scene.truth, surface)
    deltas = session + ".deltas"
    measure(program, "record", session, deltas)
    results["flights"][name] = measure(program, "replay", deltas)
    # What is measured is not held against anything, and the other way round.
    results["flights"][name]["checked"] = \
        measure(program, "replay", deltas, str(CHECK_EVERY))["checked"]
    os.remove(deltas)


def print_results(results):
    rows = []
    for name, truth in results["truth"].items():
        for kind in ("ours", "full_ray_cast"):
            of_kind = truth[kind]
            rows.append([name, kind, of_kind["faces"], number(truth["mean_error_gsd"]),
                         number(of_kind["within_2_mean_errors"], 3),
                         number(of_kind["accuracy_median_mm"]),
                         number(of_kind["accuracy_20_mm"], 3),
                         number(of_kind["completeness_20_mm"], 3),
                         number(of_kind["f_score_20_mm"], 3)])
    print_table("Surfaces against the truth; errors of points in ground sampling distances",
                ["scene", "energy", "faces", "mean error GSD", "within 2 errors", "median mm",
                 "accurate 20 mm", "complete 20 mm", "F-score 20 mm"], rows)
    print_table("CPU seconds of both energies, from nothing",
                ["scene", "weights", "cut", "cut by library", "full rays", "full cut", "ratio"],
                [energy_row(name, truth) for name, truth in results["truth"].items()])
    print_table("The mesh, photo by photo: CPU ms",
                ["flight", "deltas", "landmarks", "cells", "median", "95 %", "100-200", "last 100",
                 "growth", "rebuild", "times faster", "MiB", "checked"],
                [flight_row(name, flight) for name, flight in results["flights"].items()])


def energy_row(name, truth):
    own = truth["weights_cpu_s"] + truth["cut_cpu_s"]
    full = truth["full_cast_cpu_s"] + truth["full_cut_cpu_s"]
    return [name] + [number(truth[key]) for key in (
        "weights_cpu_s", "cut_cpu_s", "cut_by_library_cpu_s", "full_cast_cpu_s",
        "full_cut_cpu_s")] + [number(full / own)]


def flight_row(name, flight):
    early, late = flight["100_to_200"]["total_ms"], flight["last_100"]["total_ms"]
    return [name, flight["deltas"], flight["vertices"], flight["cells"],
            number(flight["median_ms"], 1), number(flight["p95_ms"], 1), number(early, 1),
            number(late, 1), number(late / early) if early else "-",
            number(flight["rebuild_ms"], 0), number(flight["rebuild_ms"] / flight["median_ms"], 1),
            number(flight["memory_mib"], 0), flight.get("checked", 0)]
