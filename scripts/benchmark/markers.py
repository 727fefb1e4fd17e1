# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: the marker detector on rendered markers with known truth, beside ArUco and apriltag, on
photos without markers, and on the control points of a simulated flight.

The figures are those of test/benchmark/marker_benchmark.cc. Diameters are those of the outer circle
or, of the square markers, their outer side.
"""
import json
import os

from benchmark.marker_flight import measure_flight
from benchmark.programs import built_benchmark, run_benchmark
from benchmark.scenes import find_scenes
from benchmark.simulation import simulate
from benchmark.tables import number, print_table

NUM_PER_SCENE, NUM_FRONTAL, NUM_MIXED = 1000, 10000, 100000
QUICK_PER_SCENE, QUICK_FRONTAL, QUICK_MIXED, QUICK_PHOTOS = 160, 1000, 4000, 40
FLIGHT = "multiscale_500"
OURS = "plumbline"
SEEN_RATE = 0.9  # From which rate on a size counts as seen.


def add_arguments(parser):
    """--quick is that of the scenarios."""


def measure(program, *arguments):
    """One dictionary a line that the program prints."""
    return [json.loads(line) for line in run_benchmark(program, *arguments).splitlines()]


def run(arguments):
    program = built_benchmark("marker_benchmark")
    per_scene, per_size, mixed = (
        (QUICK_PER_SCENE, QUICK_FRONTAL, QUICK_MIXED) if arguments.quick
        else (NUM_PER_SCENE, NUM_FRONTAL, NUM_MIXED))
    results = {"photos": {}, "failures": []}
    results["scenes"] = measure(program, "scenes", str(per_scene))
    results["frontal"] = measure(program, "frontal", str(per_size))
    for scene in find_scenes(arguments.data, None):
        results["photos"][scene.name] = measure(program, "photos", scene.photos)[0]
    flight = arguments.flight or os.path.dirname(simulate(
        arguments.plumbline, FLIGHT, max_photos=QUICK_PHOTOS if arguments.quick else None).photos)
    results["flight"] = measure_flight(arguments.plumbline, flight, arguments.output)
    results["mixed"] = measure(program, "mixed", str(mixed))[-1]
    results["figures"] = figures(results)
    results["failures"] += ["markers: %s: %s, but must be %s" % (name, shown, bound)
                            for name, bound, shown, is_met in results["figures"]
                            if not is_met and "seconds" not in name]
    return results


def ours(results, name):
    return [row for row in results["scenes"]
            if row["detector"] == OURS and row["scene"] == name]


def smallest_size(results, detector):
    """Of frontal markers, from which on all sizes are seen; None if not even the largest is."""
    smallest = None
    rows = [row for row in results["scenes"]
            if row["detector"] == detector and row["scene"] == "frontal"]
    for row in sorted(rows, key=lambda row: -row["diameter_px"]):
        if row["rate"] < SEEN_RATE:
            return smallest
        smallest = row["diameter_px"]
    return smallest


def figures(results):
    """Name, bound, what was measured, and whether that meets it."""
    frontal, tilted = ours(results, "frontal"), ours(results, "tilted")
    others = sorted({row["detector"] for row in results["scenes"]} - {OURS})
    many = {row["diameter_px"]: row for row in results["frontal"]}
    large = min([many[24]["rate"]] + [row["rate"] for row in frontal if row["diameter_px"] > 24])
    small = many[16]["rate"]
    steep = min(row["rate"] for row in tilted if row["tilt_deg"] == 60 and row["diameter_px"] >= 40)
    error_px = max(row["mean_error_px"] for row in frontal + tilted if row["diameter_px"] == 30)
    flight = results["flight"]
    rendered = [results["mixed"]] + results["frontal"] + [
        row for row in results["scenes"] if row["detector"] == OURS]
    wrong = sum(row["wrong"] for row in rendered)
    photos = results["photos"].values()
    false = sum(photo[kind]["found"] for photo in photos for kind in ("originals", "mosaics"))
    cpu_s = [photo["mosaics"]["cpu_s"] for photo in photos]
    sizes = {name: smallest_size(results, name) for name in [OURS] + others}
    ratios = [row["mean_error_px"] / ours_row["mean_error_px"] for ours_row, row in same_scenes(results)]
    return [
        ["found of frontal markers of 24 px and more", ">= 99.9 %", percent(large), large >= 0.999],
        ["found of frontal markers of 16 px", ">= 90 %", percent(small), small >= 0.9],
        ["found of those tilted by 60 deg, 40 px and more", ">= 99 %", percent(steep),
         steep >= 0.99],
        ["wrong IDs of %d rendered markers" % sum(row["shown"] for row in rendered), "0", str(wrong),
         wrong == 0],
        ["wrong or false in %d photos of a flight" % flight["photos"], "0",
         str(flight["wrong"] + flight["false"]), flight["wrong"] + flight["false"] == 0],
        ["markers seen in %d photos without" % sum(p["originals"]["photos"] for p in photos), "0",
         str(false), false == 0],
        ["worst mean centre error at 30 px, up to 60 deg [px]", "<= 0.05", number(error_px, 3),
         error_px <= 0.05],
        ["least centre error of the others over ours, same scene", "> 1", number(min(ratios)),
         min(ratios) > 1.0],
        ["smallest frontal size of which 90 % are seen [px]",
         "below " + ", ".join("%g of %s" % (sizes[name], name) for name in others),
         "%g" % sizes[OURS], all(sizes[OURS] < sizes[name] for name in others)],
        ["CPU seconds for 16 megapixels, over two cores, mean of the scenes", "<= 0.25",
         number(sum(cpu_s) / len(cpu_s) / 2.0, 3), sum(cpu_s) / len(cpu_s) / 2.0 <= 0.25]]


def same_scenes(results):
    """Our result with that of each other detector, where both see most markers of the scene."""
    pairs = []
    for row in results["scenes"]:
        for ours_row in results["scenes"]:
            is_same = all(row[key] == ours_row[key] for key in ("scene", "diameter_px", "tilt_deg"))
            if is_same and ours_row["detector"] == OURS != row["detector"] and \
                    min(row["rate"], ours_row["rate"]) >= SEEN_RATE:
                pairs.append((ours_row, row))
    return pairs


def percent(share):
    return "%.2f %%" % (100.0 * share)


def print_results(results):
    rows = [[row["scene"], "%g" % row["diameter_px"], "%g" % row["tilt_deg"], row["detector"],
             percent(row["rate"]), row["wrong"], number(row["mean_error_px"], 3),
             number(row["p95_error_px"], 3), number(row["max_error_px"], 3),
             number(row["cpu_s_per_megapixel"], 3)]
            for row in results["scenes"] + results["frontal"] + [results["mixed"]]]
    print_table("Markers: rendered with known truth; errors are the centre's",
                ["scene", "px", "tilt deg", "detector", "found", "wrong", "mean px", "95 % px",
                 "max px", "CPU s/MP"], rows)
    rows = []
    for scene, kinds in results["photos"].items():
        for kind, row in kinds.items():
            rows.append([scene, kind, row["photos"], number(row["megapixels"], 1), row["found"],
                         number(row["cpu_s"], 3), number(row["wall_s"], 3)])
    print_table("Markers: photos without any; mosaics: a photo and its mirror images",
                ["scene", "", "photos", "MP", "seen", "CPU s", "wall s"], rows)
    print_flight(results["flight"])
    print_table("Markers: what is asked", ["figure", "asked", "measured", ""],
                [[name, bound, shown, "" if is_met else "MISSED"]
                 for name, bound, shown, is_met in results["figures"]])


def print_flight(flight):
    rows = [[">= %d" % row["min_px"], row["shown"], percent(row["found"] / row["shown"]),
             number(row["mean_error_px"], 3), number(row["p95_error_px"], 3),
             number(row["max_error_px"], 3)] for row in flight["sizes"]]
    print_table("Markers: control points of %s, %d photos: %d of %d found, %d wrong, %d false; "
                "%.2f CPU s a photo with its decoding"
                % (flight["flight"], flight["photos"], flight["found"], flight["shown"],
                   flight["wrong"], flight["false"], flight["cpu_s"] / flight["photos"]),
                ["diameter px", "shown", "found", "mean px", "95 % px", "max px"], rows)
