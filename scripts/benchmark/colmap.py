# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""COLMAP on the same photos: number of features, cores and intrinsics as Plumbline has them."""
import csv
import hashlib
import json
import os
import re
import shutil
import subprocess

import numpy as np

from benchmark.measure import run_timed

NUM_FEATURES = 5000  # FeatureOptions::max_features.
HEADLESS = dict(os.environ, QT_QPA_PLATFORM="offscreen")


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
                              stderr=subprocess.DEVNULL, env=HEADLESS)
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


def run_colmap(scene, work, reuse, limit_s=None):
    """What it found and took; in place of what it found, "failed", the step that failed, or
    "cut_off", the step that `limit_s` for all steps ended."""
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
        left_s = None if limit_s is None else max(limit_s - result["wall_s"], 0.0)
        timing = run_timed(command, os.path.join(folder, "log"), HEADLESS, left_s)
        result["wall_s"] += timing["wall_s"]
        result["cpu_s"] += timing["cpu_s"]
        result["steps_s"][step] = timing["wall_s"]
        if timing["cut_off"]:
            return dict(result, cut_off=step)
        if timing["exit_code"] != 0:
            return dict(result, failed="%s, see %s/log" % (step, folder))
    poses = largest_model(folder)
    result["registered"] = len(poses)
    if scene.truth:
        result["center_error_mm"] = center_errors_mm(poses, scene.truth)
    with open(cache, "w") as file:
        json.dump(result, file)
    return result
