# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: accuracy and speed of `plumbline reconstruct` on the scenes, beside COLMAP's."""
import json
import os
import shutil
import statistics
import subprocess

from benchmark import colmap
from benchmark.measure import log, run_timed
from benchmark.scenes import find_scenes
from benchmark.tables import number, print_table

STAGES = ["decode_s", "features_s", "retrieval_s", "matching_s", "pose_s", "verdict_s",
          "expand_s", "bundle_s"]
SHUFFLES = ["shuffle:1", "shuffle:2", "shuffle:3"]
GROWTH_SCENE_PHOTOS = 100  # Fewer photos say nothing about growth.


def growth(photos, key):
    """Mean seconds a photo of the last quarter over those of the second."""
    seconds = [photo["turn"][key] for photo in photos]
    quarter = len(seconds) // 4
    return statistics.mean(seconds[-quarter:]) / statistics.mean(seconds[quarter:2 * quarter])


def evaluate(plumbline, scene, session):
    if scene.truth is None:
        return None
    done = subprocess.run([plumbline, "evaluate", "--session", session, "--truth", scene.truth],
                          capture_output=True, text=True)
    if done.returncode != 0:
        log(done.stderr.strip())
        return None
    return json.loads(done.stdout)


def run_plumbline(plumbline, scene, order, work):
    session = os.path.join(work, "%s-%s" % (scene.name, order.replace(":", "")))
    shutil.rmtree(session, ignore_errors=True)
    command = [plumbline, "reconstruct", "--photos", scene.photos, "--camera", scene.camera,
               "--session", session, "--order", order]
    timing = run_timed(command, session + ".log")
    result = {"scene": scene.name, "order": order, "photos": scene.num_photos, **timing}
    try:
        with open(os.path.join(session, "report.json")) as file:
            report = json.load(file)
    except OSError:
        log("bench: %s: plumbline wrote no report; see %s.log" % (scene.name, session))
        return result
    photos = report["photos"]
    result["registered"] = report["session"]["accepted"]
    result["without_reason"] = sum(photo["verdict"] != "accepted" and photo["reason"] == "none"
                                   for photo in photos)
    result["peak_memory_mib"] = report["run"]["peak_memory_bytes"] / 2**20
    result["cpu_s_per_photo"] = timing["cpu_s"] / scene.num_photos
    first = [photo["attempts"][0]["seconds"] for photo in photos]
    result["median_s"] = {stage: statistics.median(s[stage] for s in first) for stage in STAGES}
    result["max_verdict_s"] = max(s["verdict_s"] for s in first)
    if scene.num_photos >= GROWTH_SCENE_PHOTOS:
        result["growth"] = {key: growth(photos, key) for key in ("wall_s", "cpu_s")}
    evaluation = evaluate(plumbline, scene, session)
    if evaluation:
        result["center_error_mm"] = evaluation["center_error_mm"]
        result["rotation_error_deg"] = evaluation["rotation_error_deg"]
    return result


def feature_cpu(plumbline, scene):
    """CPU seconds a photo of decoding and features alone."""
    done = subprocess.run([plumbline, "check", "--photos", scene.photos, "--camera", scene.camera],
                          capture_output=True, text=True, check=True)
    photos = [json.loads(line) for line in done.stdout.splitlines()]
    return statistics.mean(photo["cpu_s"] for photo in photos if "cpu_s" in photo)


def error_cells(result):
    errors = result.get("center_error_mm") or {}
    return [number(errors.get(key)) for key in ("mean", "median", "max")]


def add_arguments(parser):
    parser.add_argument("--scene", action="append", help="only this one; repeat")
    parser.add_argument("--no-orders", action="store_true", help="only the order of the names")
    parser.add_argument("--no-colmap", action="store_true")
    parser.add_argument("--reuse-colmap", action="store_true",
                        help="take COLMAP's result of an earlier run on the same photos")
    parser.add_argument("--colmap-limit", type=float, default=20.0, metavar="TIMES",
                        help="end COLMAP after so many times Plumbline's wall time on the scene; "
                        "0: never (default: %(default)s)")


def colmap_limit_s(arguments, scene, runs):
    """Plumbline's longest wall time on the scene, times --colmap-limit; None: no limit."""
    ours_s = max((r["wall_s"] for r in runs if r["scene"] == scene.name), default=None)
    return ours_s * arguments.colmap_limit if ours_s and arguments.colmap_limit > 0 else None


def run(arguments):
    """The runs of both, and under "failures" what went wrong: a failed one costs no other."""
    results = {"plumbline": [], "colmap": [], "failures": []}
    with_colmap = not arguments.no_colmap and shutil.which("colmap") is not None
    for scene in find_scenes(arguments.data, arguments.scene):
        try:
            run_orders(arguments, scene, results)
        except (OSError, ValueError, KeyError, subprocess.SubprocessError) as error:
            results["failures"].append("plumbline on %s: %s" % (scene.name, error))
        if not with_colmap:
            continue
        log("colmap on %s" % scene.name)
        try:
            result = colmap.run_colmap(scene, arguments.output, arguments.reuse_colmap,
                                       colmap_limit_s(arguments, scene, results["plumbline"]))
            results["colmap"].append(result)
            if "failed" in result:
                results["failures"].append("colmap on %s: %s" % (scene.name, result["failed"]))
        except (OSError, ValueError, KeyError, subprocess.SubprocessError) as error:
            results["failures"].append("colmap on %s: %s" % (scene.name, error))
    return results


def run_orders(arguments, scene, results):
    extraction_cpu_s = feature_cpu(arguments.plumbline, scene)
    all_orders = scene.truth is not None and not arguments.no_orders
    for order in ["name"] + (["reverse"] + SHUFFLES if all_orders else []):
        log("plumbline on %s, order %s" % (scene.name, order))
        result = run_plumbline(arguments.plumbline, scene, order, arguments.output)
        results["plumbline"].append(result)
        result["feature_cpu_s_per_photo"] = extraction_cpu_s
        if "cpu_s_per_photo" in result:
            result["cpu_over_features"] = result["cpu_s_per_photo"] / extraction_cpu_s
        if result["exit_code"] != 0:
            results["failures"].append("plumbline on %s, order %s: exit code %d"
                                       % (scene.name, order, result["exit_code"]))


def print_results(results):
    runs = results["plumbline"]
    label = lambda r: "%s, %s" % (r["scene"], r["order"])
    print_table("Accuracy (camera centres after similarity alignment)",
                ["scene, order", "registered", "mean mm", "median mm", "max mm"],
                [[label(r), "%s/%d" % (r.get("registered", "-"), r["photos"])] + error_cells(r)
                 for r in runs])
    print_table("Speed and memory; growth: seconds a photo, last quarter over second quarter",
                ["scene, order", "wall s", "s/photo", "CPU s/photo", "/features", "MiB",
                 "growth", "CPU growth"],
                [[label(r), number(r["wall_s"], 1), number(r["wall_s"] / r["photos"]),
                  number(r.get("cpu_s_per_photo")), number(r.get("cpu_over_features")),
                  number(r.get("peak_memory_mib"), 0), number(r.get("growth", {}).get("wall_s")),
                  number(r.get("growth", {}).get("cpu_s"))] for r in runs])
    print_table("Median seconds a photo by stage; verdict: from its first byte, waiting included",
                ["scene, order"] + [stage[:-2] for stage in STAGES] + ["slowest verdict"],
                [[label(r)] + [number(r["median_s"][stage], 3) for stage in STAGES] +
                 [number(r["max_verdict_s"])] for r in runs if "median_s" in r])
    print_colmap(results["colmap"], {r["scene"]: r["wall_s"] for r in runs
                                     if r["order"] == "name" and r["exit_code"] == 0})


def colmap_outcome(result):
    if "failed" in result:
        return "failed"
    if "cut_off" in result:
        return "ended in %s" % result["cut_off"]
    return "%d/%d" % (result["registered"], result["photos"])


def print_colmap(results, plumbline_wall_s):
    if not results:
        print("\nCOLMAP: not installed or not asked for, nothing to compare with")
        return
    rows = []
    for result in results:
        ours_s = plumbline_wall_s.get(result["scene"])
        is_comparable = ours_s is not None and "failed" not in result
        bound = "> " if "cut_off" in result else ""
        rows.append([result["scene"], colmap_outcome(result)] + error_cells(result) +
                    [bound + number(result["wall_s"], 1) +
                     (" (reused)" if result.get("reused") else ""),
                     number(ours_s, 1),
                     bound + number(result["wall_s"] / ours_s if is_comparable else None, 1)])
    print_table("COLMAP, same photos, %d features, %d cores, intrinsics fixed, exhaustive"
                % (colmap.NUM_FEATURES, os.cpu_count()),
                ["scene", "registered", "mean mm", "median mm", "max mm", "wall s",
                 "plumbline s", "times faster"], rows)
