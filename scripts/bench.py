#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Accuracy and speed of `plumbline reconstruct` on the shared scenes, beside COLMAP's.

Prints tables and writes them as JSON. Runs every scene in the order of its names; scenes with true
poses also in reverse and in three shuffled orders. Where `colmap` is installed, it is given the same
photos, number of features, cores and intrinsics in the same run.
"""
import argparse
import csv
import hashlib
import json
import os
import re
import resource
import shutil
import statistics
import subprocess
import sys
import time

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
STAGES = ["decode_s", "features_s", "retrieval_s", "matching_s", "pose_s", "verdict_s",
          "expand_s", "bundle_s"]
NUM_FEATURES = 5000  # FeatureOptions::max_features; COLMAP gets as many.
SHUFFLES = ["shuffle:1", "shuffle:2", "shuffle:3"]
GROWTH_SCENE_PHOTOS = 100  # Fewer photos say nothing about growth.


def built_program():
    """The newest build: with the ROS nodes it lies under devel/."""
    paths = [os.path.join(ROOT, "devel", "lib", "plumbline", "plumbline"),
             os.path.join(ROOT, "build", "plumbline")]
    return max(paths, key=lambda path: os.path.getmtime(path) if os.path.exists(path) else 0)


def log(text):
    print(text, file=sys.stderr, flush=True)


class Scene:
    def __init__(self, folder):
        self.name = os.path.basename(folder)
        self.photos = os.path.join(folder, "photos")
        self.camera = os.path.join(folder, "camera.yaml")
        truth = os.path.join(folder, "ground_truth", "poses.csv")
        self.truth = truth if os.path.exists(truth) else None
        self.num_photos = len([n for n in os.listdir(self.photos) if not n.startswith(".")])


def find_scenes(data, wanted):
    scenes = []
    for name in sorted(os.listdir(data)):
        folder = os.path.join(data, name)
        is_scene = os.path.isdir(os.path.join(folder, "photos")) and \
            os.path.exists(os.path.join(folder, "camera.yaml"))
        if is_scene and (not wanted or name in wanted):
            scenes.append(Scene(folder))
    missing = set(wanted or []) - {scene.name for scene in scenes}
    if missing or not scenes:
        sys.exit("bench: %s: no scene %s; a scene is a folder with photos/ and camera.yaml"
                 % (data, ", ".join(sorted(missing)) or "at all"))
    return scenes


def run_timed(command, log_path, environment=None):
    """Wall and CPU seconds and peak memory of a command; its output goes to `log_path`."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    with open(log_path, "a") as output:
        output.write("$ %s\n" % " ".join(command))
        output.flush()
        code = subprocess.call(command, stdout=output, stderr=subprocess.STDOUT,
                               env=environment)
    wall_s = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"exit_code": code, "wall_s": wall_s, "cpu_s": cpu_s}


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


def read_numbers(camera_path, key):
    with open(camera_path) as file:
        text = file.read()
    section = text[text.index(key + ":"):]
    return [float(v) for v in re.search(r"data:\s*\[([^\]]*)\]", section).group(1).split(",")]


def colmap_camera(scene):
    """COLMAP's model and parameters: its pixel origin lies half a pixel up and left of ours."""
    k = read_numbers(scene.camera, "camera_matrix")
    d = (read_numbers(scene.camera, "distortion_coefficients") + 8 * [0.0])[:8]
    values = [k[0], k[4], k[2] + 0.5, k[5] + 0.5]
    if any(d[4:]):
        return "FULL_OPENCV", values + d
    return ("OPENCV", values + d[:4]) if any(d) else ("PINHOLE", values)


def colmap_commands(scene, folder):
    model, values = colmap_camera(scene)
    database = os.path.join(folder, "database.db")
    fixed = ["--Mapper.ba_refine_focal_length", "0", "--Mapper.ba_refine_principal_point", "0",
             "--Mapper.ba_refine_extra_params", "0"]
    return [
        ("extract", ["colmap", "feature_extractor", "--database_path", database,
                     "--image_path", scene.photos, "--ImageReader.single_camera", "1",
                     "--ImageReader.camera_model", model,
                     "--ImageReader.camera_params", ",".join("%.17g" % v for v in values),
                     "--SiftExtraction.use_gpu", "0",
                     "--SiftExtraction.max_num_features", str(NUM_FEATURES)]),
        ("match", ["colmap", "exhaustive_matcher", "--database_path", database,
                   "--SiftMatching.use_gpu", "0"]),
        ("map", ["colmap", "mapper", "--database_path", database, "--image_path", scene.photos,
                 "--output_path", os.path.join(folder, "sparse")] + fixed),
    ]


def largest_model(folder):
    """images.txt of the model with most photos, as {name: (rotation, centre)}."""
    best = {}
    sparse = os.path.join(folder, "sparse")
    for name in sorted(os.listdir(sparse)):
        text = os.path.join(folder, "text-" + name)
        os.makedirs(text, exist_ok=True)
        subprocess.check_call(["colmap", "model_converter", "--input_path",
                               os.path.join(sparse, name), "--output_path", text,
                               "--output_type", "TXT"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL,
                              env=dict(os.environ, QT_QPA_PLATFORM="offscreen"))
        with open(os.path.join(text, "images.txt")) as file:
            lines = [line for line in file if not line.startswith("#")][::2]
        poses = {}
        for line in lines:
            field = line.split()
            rotation = rotation_matrix(*map(float, field[1:5]))
            poses[field[9]] = (rotation, -rotation.T @ np.array(field[5:8], float))
        if len(poses) > len(best):
            best = poses
    return best


def rotation_matrix(w, x, y, z):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def center_errors_mm(poses, truth_path):
    """As `plumbline evaluate`: after the similarity that fits the centres best (Umeyama 1991)."""
    with open(truth_path) as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#"))
                if row and row[0] != "photo" and row[0] in poses]
    if len(rows) < 3:
        return None
    source = np.array([poses[row[0]][1] for row in rows])
    target = np.array([[float(v) for v in row[5:8]] for row in rows])
    a, b = source - source.mean(0), target - target.mean(0)
    u, d, vt = np.linalg.svd(b.T @ a)
    sign = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    rotation = u @ sign @ vt
    scale = np.trace(np.diag(d) @ sign) / (a**2).sum()
    errors = 1000 * np.linalg.norm(scale * a @ rotation.T - b, axis=1)
    return {"mean": errors.mean(), "median": float(np.median(errors)), "max": errors.max()}


def cache_key(scene):
    """Of all that COLMAP's result depends on but this machine."""
    digest = hashlib.sha256(json.dumps([colmap_camera(scene), NUM_FEATURES, os.cpu_count()])
                            .encode())
    for name in sorted(os.listdir(scene.photos)):
        with open(os.path.join(scene.photos, name), "rb") as file:
            digest.update(hashlib.sha256(file.read()).digest())
    return digest.hexdigest()[:16]


def run_colmap(scene, work, reuse):
    cache = os.path.join(work, "colmap-%s-%s.json" % (scene.name, cache_key(scene)))
    if reuse and os.path.exists(cache):
        with open(cache) as file:
            return dict(json.load(file), reused=True)
    folder = os.path.join(work, "colmap-" + scene.name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "sparse"))
    result = {"scene": scene.name, "photos": scene.num_photos, "wall_s": 0.0, "cpu_s": 0.0,
              "steps_s": {}}
    for step, command in colmap_commands(scene, folder):
        timing = run_timed(command, os.path.join(folder, "log"),
                           dict(os.environ, QT_QPA_PLATFORM="offscreen"))
        if timing["exit_code"] != 0:
            log("bench: colmap %s failed on %s; see %s/log" % (step, scene.name, folder))
            return None
        result["wall_s"] += timing["wall_s"]
        result["cpu_s"] += timing["cpu_s"]
        result["steps_s"][step] = timing["wall_s"]
    poses = largest_model(folder)
    result["registered"] = len(poses)
    if scene.truth:
        result["center_error_mm"] = center_errors_mm(poses, scene.truth)
    with open(cache, "w") as file:
        json.dump(result, file)
    return result


def print_table(title, header, rows):
    cells = [header] + [[str(cell) for cell in row] for row in rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(header))]
    print("\n" + title)
    for row in cells:
        print("  " + "  ".join(cell.ljust(width) if i == 0 else cell.rjust(width)
                               for i, (cell, width) in enumerate(zip(row, widths))))
    sys.stdout.flush()


def number(value, digits=2):
    return "-" if value is None else "%.*f" % (digits, value)


def error_cells(result):
    errors = result.get("center_error_mm") or {}
    return [number(errors.get(key)) for key in ("mean", "median", "max")]


def print_results(runs, colmap):
    print_table("Accuracy (camera centres after similarity alignment)",
                ["scene, order", "registered", "mean mm", "median mm", "max mm"],
                [["%s, %s" % (r["scene"], r["order"]),
                  "%s/%d" % (r.get("registered", "-"), r["photos"])] + error_cells(r)
                 for r in runs])
    print_table("Speed and memory; growth: seconds a photo, last quarter over second quarter",
                ["scene, order", "wall s", "s/photo", "CPU s/photo", "/features", "MiB",
                 "growth", "CPU growth"],
                [["%s, %s" % (r["scene"], r["order"]), number(r["wall_s"], 1),
                  number(r["wall_s"] / r["photos"]), number(r.get("cpu_s_per_photo")),
                  number(r.get("cpu_over_features")), number(r.get("peak_memory_mib"), 0),
                  number(r.get("growth", {}).get("wall_s")),
                  number(r.get("growth", {}).get("cpu_s"))] for r in runs])
    print_table("Median seconds a photo by stage; verdict: from its first byte, waiting included",
                ["scene, order"] + [stage[:-2] for stage in STAGES] + ["slowest verdict"],
                [["%s, %s" % (r["scene"], r["order"])] +
                 [number(r["median_s"][stage], 3) for stage in STAGES] +
                 [number(r["max_verdict_s"])] for r in runs if "median_s" in r])
    if not colmap:
        print("\nCOLMAP: not installed or not asked for, nothing to compare with")
        return
    by_name = {r["scene"]: r for r in runs if r["order"] == "name"}
    print_table("COLMAP, same photos, %d features, %d cores, intrinsics fixed, exhaustive"
                % (NUM_FEATURES, os.cpu_count()),
                ["scene", "registered", "mean mm", "median mm", "max mm", "wall s",
                 "plumbline s", "times faster"],
                [[c["scene"], "%d/%d" % (c["registered"], c["photos"])] + error_cells(c) +
                 [number(c["wall_s"], 1) + (" (reused)" if c.get("reused") else ""),
                  number(by_name[c["scene"]]["wall_s"], 1),
                  number(c["wall_s"] / by_name[c["scene"]]["wall_s"], 1)] for c in colmap])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--data", default=os.environ.get(
        "PLUMBLINE_DATA", os.path.join(ROOT, "..", "shared", "data")), help="folder of scenes")
    parser.add_argument("--scene", action="append", help="only this one; repeat")
    parser.add_argument("--plumbline", default=built_program())
    parser.add_argument("--output", default=os.path.join(ROOT, "build", "bench"))
    parser.add_argument("--no-orders", action="store_true", help="only the order of the names")
    parser.add_argument("--no-colmap", action="store_true")
    parser.add_argument("--reuse-colmap", action="store_true",
                        help="take COLMAP's result of an earlier run on the same photos")
    arguments = parser.parse_args()
    if not os.path.isdir(arguments.data):
        sys.exit("bench: %s: no such folder; set PLUMBLINE_DATA" % arguments.data)
    if not os.path.exists(arguments.plumbline):
        sys.exit("bench: %s: not built; run make build" % arguments.plumbline)
    os.makedirs(arguments.output, exist_ok=True)
    with_colmap = not arguments.no_colmap and shutil.which("colmap") is not None

    runs, colmap = [], []
    for scene in find_scenes(arguments.data, arguments.scene):
        extraction_cpu_s = feature_cpu(arguments.plumbline, scene)
        all_orders = scene.truth is not None and not arguments.no_orders
        for order in ["name"] + (["reverse"] + SHUFFLES if all_orders else []):
            log("plumbline on %s, order %s" % (scene.name, order))
            result = run_plumbline(arguments.plumbline, scene, order, arguments.output)
            result["feature_cpu_s_per_photo"] = extraction_cpu_s
            if "cpu_s_per_photo" in result:
                result["cpu_over_features"] = result["cpu_s_per_photo"] / extraction_cpu_s
            runs.append(result)
        if with_colmap:
            log("colmap on %s" % scene.name)
            result = run_colmap(scene, arguments.output, arguments.reuse_colmap)
            colmap += [result] if result else []
    print_results(runs, colmap)
    path = os.path.join(arguments.output, "bench.json")
    with open(path + ".part", "w") as file:
        json.dump({"cores": os.cpu_count(), "plumbline": runs, "colmap": colmap}, file, indent=1)
    os.replace(path + ".part", path)
    print("\nwrote %s" % path)
    return 1 if any(run["exit_code"] != 0 for run in runs) else 0


if __name__ == "__main__":
    sys.exit(main())
