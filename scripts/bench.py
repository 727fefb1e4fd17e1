#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures Plumbline section by section, prints tables and writes them as JSON.

A section is a module of scripts/benchmark with add_arguments(parser), run(arguments), which gives
what the JSON shall hold, with a list "failures", and print_results(results). A section that fails
costs no other one.
"""
import argparse
import json
import os
import sys
import traceback

from benchmark import (calibration, display, markers, multiscale, realism, reconstruction,
                       scenarios, surface)

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SECTIONS = {"reconstruction": reconstruction, "realism": realism, "scenarios": scenarios,
            "markers": markers, "calibration": calibration, "surface": surface,
            "display": display}
# Only where it is asked for: it takes as long as all others together.
EXTRA_SECTIONS = {"multiscale": multiscale}
ALL_SECTIONS = {**SECTIONS, **EXTRA_SECTIONS}


def built_program():
    """The newest build: with the ROS nodes it lies under devel/."""
    paths = [os.path.join(ROOT, "devel", "lib", "plumbline", "plumbline"),
             os.path.join(ROOT, "build", "plumbline")]
    return max(paths, key=lambda path: os.path.getmtime(path) if os.path.exists(path) else 0)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--section", action="append", choices=sorted(ALL_SECTIONS),
                        help="only this one; repeat")
    parser.add_argument("--data", default=os.environ.get(
        "PLUMBLINE_DATA", os.path.join(ROOT, "..", "shared", "data")), help="folder of scenes")
    parser.add_argument("--plumbline", default=built_program(), help="the built program")
    parser.add_argument("--flight", metavar="DIR",
                        help="markers, multiscale: a folder by plumbline simulate, in place of "
                             "multiscale_500 simulated anew")
    parser.add_argument("--output", default=os.path.join(ROOT, "build", "bench"))
    for section in ALL_SECTIONS.values():
        section.add_arguments(parser)
    arguments = parser.parse_args()
    if not os.path.isdir(arguments.data):
        sys.exit("bench: %s: no such folder; set PLUMBLINE_DATA" % arguments.data)
    if not os.path.exists(arguments.plumbline):
        sys.exit("bench: %s: not built; run make build" % arguments.plumbline)
    os.makedirs(arguments.output, exist_ok=True)
    return arguments


def run_section(name, arguments):
    try:
        results = ALL_SECTIONS[name].run(arguments)
        ALL_SECTIONS[name].print_results(results)
        return results
    except Exception as error:  # Whatever it is, the other sections are still measured.
        if not isinstance(error, RuntimeError):
            traceback.print_exc()
        return {"failures": ["%s: %s" % (name, error)]}


def write_json(results, path):
    with open(path + ".part", "w") as file:
        json.dump({"cores": os.cpu_count(), **results}, file, indent=1)
    os.replace(path + ".part", path)


def main():
    arguments = parse_arguments()
    path = os.path.join(arguments.output, "bench.json")
    results = {}
    for name in arguments.section or SECTIONS:
        results[name] = run_section(name, arguments)
        write_json(results, path)  # After each one: a later one may be cut off.
    print("\nwrote %s" % path)
    failures = [failure for result in results.values() for failure in result["failures"]]
    for failure in failures:
        print("bench: failed: " + failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
