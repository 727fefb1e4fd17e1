#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""COLMAP on photos of a simulated flight, with the flight's wrong lens refined, held against the
survey: coded markers found by `plumbline detect` are triangulated from COLMAP's poses and lens, the
control points align them, the check points tell."""
import argparse
import csv
import json
import os
import shutil
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from benchmark.colmap import HEADLESS, NUM_FEATURES, colmap_camera, rotation_matrix  # noqa: E402
from benchmark.colmap_pairs import nearest_pairs, write_pairs  # noqa: E402
from benchmark.measure import log, run_timed  # noqa: E402
from benchmark.programs import built_benchmark  # noqa: E402

MAX_ERROR_PX = 4.0  # GeoreferencerOptions::max_error_px.
NUM_STEPS = 10      # Of Gauss-Newton; a centre is found after three.
ALL_ROWS = "all"
NUM_NEIGHBORS = 40
MAX_DISTANCE_M = 15.0


class WrongCamera:
    """As benchmark.colmap wants a scene: the lens that COLMAP starts from."""

    def __init__(self, flight):
        self.camera = os.path.join(flight, "camera_wrong.yaml")


def link_photos(flight, row, folder, max_photos):
    os.makedirs(folder)
    with open(os.path.join(flight, "ground_truth", "rows.csv")) as file:
        names = [line["photo"] for line in csv.DictReader(file) if row in (line["row"], ALL_ROWS)]
    for name in names[:max_photos]:
        os.symlink(os.path.abspath(os.path.join(flight, "photos", name)),
                   os.path.join(folder, name))
    if not names:
        raise RuntimeError("%s: no photo of row %s" % (flight, row))


def steps(flight, work):
    """Names and commands. Pairs are written between the first and the second."""
    model, values = colmap_camera(WrongCamera(flight))
    database, matches = os.path.join(work, "database.db"), os.path.join(work, "matches.txt")
    photos = os.path.join(work, "photos")
    # The features asked for are the largest: none is of the doubled photo, whose search takes most
    # of the time. COLMAP's own matcher takes some ten hours for all rows. Lens and its distortion
    # are refined, as ours; COLMAP's default keeps the principal point.
    yield "extract", ["colmap", "feature_extractor", "--database_path", database,
                      "--image_path", photos, "--ImageReader.single_camera", "1",
                      "--ImageReader.camera_model", model,
                      "--ImageReader.camera_params", ",".join("%.17g" % v for v in values),
                      "--SiftExtraction.use_gpu", "0", "--SiftExtraction.first_octave", "0",
                      "--SiftExtraction.max_num_features", str(NUM_FEATURES)]
    pairs = os.path.join(work, "pairs.txt")
    write_pairs(pairs, nearest_pairs(database, NUM_NEIGHBORS, MAX_DISTANCE_M))
    yield "match", [built_benchmark("colmap_matches_benchmark"), database, pairs, matches]
    yield "verify", ["colmap", "matches_importer", "--database_path", database,
                     "--SiftMatching.use_gpu", "0", "--match_type", "raw",
                     "--match_list_path", matches]
    yield "map", ["colmap", "mapper", "--database_path", database, "--image_path", photos,
                  "--output_path", os.path.join(work, "sparse")]


def read_lines(path):
    with open(path) as file:
        return [line.split() for line in file if not line.startswith("#")]


def read_model(work):
    """Lens (fx, fy, cx, cy, k1, k2, p1, p2 …) and poses of the model with most photos."""
    best = (None, {})
    for name in sorted(os.listdir(os.path.join(work, "sparse"))):
        text = os.path.join(work, "text-" + name)
        os.makedirs(text, exist_ok=True)
        subprocess.check_call(["colmap", "model_converter", "--input_path",
                               os.path.join(work, "sparse", name), "--output_path", text,
                               "--output_type", "TXT"], stdout=subprocess.DEVNULL, env=HEADLESS)
        lens = [float(v) for v in read_lines(os.path.join(text, "cameras.txt"))[0][4:]]
        lens[2:4] = [lens[2] - 0.5, lens[3] - 0.5]  # To our pixel origin.
        poses = {}
        for field in read_lines(os.path.join(text, "images.txt"))[::2]:
            poses[field[9]] = (rotation_matrix(*map(float, field[1:5])),
                               np.array(field[5:8], float))
        if len(poses) > len(best[1]):
            best = (np.array(lens), poses)
    return best


def project(lens, point_in_cam):
    x, y = point_in_cam[:2] / point_in_cam[2]
    k1, k2, p1, p2 = (list(lens[4:]) + 4 * [0.0])[:4]
    r2 = x * x + y * y
    radial = 1 + r2 * (k1 + r2 * k2)
    dx = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
    dy = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
    return np.array([lens[0] * dx + lens[2], lens[1] * dy + lens[3]])


def residuals(lens, sightings, point):
    return np.array([project(lens, r @ point + t) - pixel for r, t, pixel in sightings])


def start_of(lens, sightings):
    """Nearest to all rays, of the lens without distortion."""
    normal, side = np.zeros((3, 3)), np.zeros(3)
    for rotation, shift, pixel in sightings:
        ray = rotation.T @ np.array([(pixel[0] - lens[2]) / lens[0],
                                     (pixel[1] - lens[3]) / lens[1], 1.0])
        ray /= np.linalg.norm(ray)
        across = np.eye(3) - np.outer(ray, ray)
        normal += across
        side += across @ (-rotation.T @ shift)
    return np.linalg.solve(normal, side)


def triangulate(lens, sightings):
    """Least squares over the sightings that agree; None with fewer than two."""
    while len(sightings) >= 2:
        point = start_of(lens, sightings)
        for _ in range(NUM_STEPS):
            now = residuals(lens, sightings, point).ravel()
            step = 1e-6 * max(1.0, np.linalg.norm(point))
            jacobian = np.array([(residuals(lens, sightings, point + step * axis).ravel() - now)
                                 / step for axis in np.eye(3)]).T
            point = point - np.linalg.lstsq(jacobian, now, rcond=None)[0]
        errors = np.linalg.norm(residuals(lens, sightings, point), axis=1)
        if errors.max() <= MAX_ERROR_PX:
            return point
        sightings = [s for i, s in enumerate(sightings) if i != errors.argmax()]
    return None


def find_markers(plumbline, flight, work):
    path = os.path.join(work, "markers.csv")
    command = [plumbline, "detect", "--photos", os.path.join(work, "photos"),
               "--camera", os.path.join(flight, "camera_wrong.yaml"), "--output", path]
    if run_timed(command, os.path.join(work, "log"))["exit_code"] != 0:
        raise RuntimeError("plumbline detect failed, see %s/log" % work)
    with open(path) as file:
        return list(csv.DictReader(file))


def target_errors_mm(lens, poses, markers, survey_path):
    """Of control and of check points, by role."""
    sightings = {}
    for marker in markers:
        if marker["photo"] in poses:
            rotation, shift = poses[marker["photo"]]
            sightings.setdefault(int(marker["id"]), []).append(
                (rotation, shift, np.array([float(marker["x_px"]), float(marker["y_px"])])))
    with open(survey_path) as file:
        survey = {int(row["id"]): row for row in csv.DictReader(file)}
    points = {i: triangulate(lens, seen) for i, seen in sightings.items() if i in survey}
    points = {i: point for i, point in points.items() if point is not None}
    truth = {i: np.array([float(survey[i][k]) for k in ("x_m", "y_m", "z_m")]) for i in points}
    control = [i for i in points if survey[i]["role"] == "control"]
    if len(control) < 3:
        raise RuntimeError("COLMAP's photos show %d control points, three are needed"
                           % len(control))
    transform = similarity(np.array([points[i] for i in control]),
                           np.array([truth[i] for i in control]))
    errors = {i: 1000 * np.linalg.norm(transform(points[i]) - truth[i]) for i in points}
    return {role: [float(errors[i]) for i in sorted(errors) if survey[i]["role"] == role]
            for role in ("control", "check")}


def similarity(source, target):
    """Umeyama, TPAMI 13(4), 1991."""
    mean_source, mean_target = source.mean(0), target.mean(0)
    a, b = source - mean_source, target - mean_target
    u, d, vt = np.linalg.svd(b.T @ a)
    sign = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    rotation = u @ sign @ vt
    scale = np.trace(np.diag(d) @ sign) / (a**2).sum()
    return lambda point: scale * rotation @ (point - mean_source) + mean_target


def measure(plumbline, flight, row, work, max_photos=None, limit_s=None):
    """What COLMAP makes of the row, kept in work/result.json; with "cut_off", the step that
    `limit_s` for all steps ended, there are no errors."""
    result_path = os.path.join(work, "result.json")
    asked = {"flight": os.path.abspath(flight), "row": row, "max_photos": max_photos}
    if os.path.exists(result_path):
        with open(result_path) as file:
            known = json.load(file)
        if known["of"] == asked:
            return known
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(os.path.join(work, "sparse"))
    link_photos(flight, row, os.path.join(work, "photos"), max_photos)
    result = {"of": asked, "registered": 0, "control_mm": None, "check_mm": None, "wall_s": 0.0, "cpu_s": 0.0}
    for step, command in steps(flight, work):
        log("colmap: " + step)
        left_s = None if limit_s is None else max(limit_s - result["wall_s"], 0.0)
        timing = run_timed(command, os.path.join(work, "log"), HEADLESS, left_s)
        result["wall_s"] += timing["wall_s"]
        result["cpu_s"] += timing["cpu_s"]
        if timing["cut_off"]:
            return dict(result, cut_off=step)
        if timing["exit_code"] != 0:
            raise RuntimeError("colmap: %s failed, see %s/log" % (step, work))
    lens, poses = read_model(work)
    errors = target_errors_mm(lens, poses, find_markers(plumbline, flight, work),
                              os.path.join(flight, "survey.csv"))
    result.update(registered=len(poses), focal_px=float(np.sqrt(lens[0] * lens[1])),
                  control_mm=float(np.mean(errors["control"])), errors_mm=errors,
                  check_mm=float(np.mean(errors["check"])) if errors["check"] else None)
    with open(result_path, "w") as file:
        json.dump(result, file, indent=1)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plumbline", required=True, help="the built program")
    parser.add_argument("--flight", required=True, help="folder by plumbline simulate")
    parser.add_argument("--row", default="10m", help="or " + ALL_ROWS)
    parser.add_argument("--photos", type=int, help="only the first so many")
    parser.add_argument("--work", required=True, help="folder for what COLMAP writes, new")
    arguments = parser.parse_args()
    print(json.dumps(measure(arguments.plumbline, arguments.flight, arguments.row, arguments.work,
                             arguments.photos), indent=1))


if __name__ == "__main__":
    main()
