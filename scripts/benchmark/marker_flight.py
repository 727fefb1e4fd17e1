# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The control points of a simulated flight, as `plumbline detect` finds them, against their truth."""
import csv
import json
import os
import shutil

import numpy as np
import yaml

from benchmark.measure import log, run_timed

MIN_DIAMETERS_PX = [10, 16, 24, 40, 100, 200, 400]  # Where each class of sizes begins.
RIM_POINTS = 24
QUIET_RADIUS = 1.25  # Of the white rim, in outer radii.
SAME_PX = 3.0        # Further off it is another one's.


def measure_flight(plumbline, folder, output):
    """Of the flight in `folder`, which is only read."""
    folder = os.path.abspath(folder)
    with open(os.path.join(folder, "scenario.yaml")) as file:
        scenario = yaml.safe_load(file)
    centers = exact_centers(plumbline, scenario, output)
    camera = os.path.join(folder, "camera.yaml")
    found_path = os.path.join(output, "flight_markers.csv")
    photos = os.path.join(folder, "photos")
    log("plumbline detect on %s" % photos)
    timing = run_timed([plumbline, "detect", "--photos", photos, "--camera", camera, "--output",
                        found_path], os.path.join(output, "flight_markers.log"))
    if timing["exit_code"] != 0:
        raise RuntimeError("detect: exit code %d, see flight_markers.log" % timing["exit_code"])
    shown = shown_markers(folder, centers, scenario["facade"]["target_diameter_m"], Lens(camera))
    return {"flight": os.path.basename(folder), "photos": len(os.listdir(photos)),
            "cpu_s": timing["cpu_s"], **compare(shown, read_csv(found_path))}


def exact_centers(plumbline, scenario, output):
    """In the world [m] by ID. The flight's survey has the errors of a total station, which are more
    than those of the detector; the same facade is surveyed again without."""
    exact = json.loads(json.dumps(scenario))
    exact["survey"]["sigma_m"] = 0.0
    path = os.path.join(output, "exact_targets.yaml")
    with open(path, "w") as file:
        json.dump(exact, file)
    folder = os.path.join(output, "exact_targets")
    shutil.rmtree(folder, ignore_errors=True)
    timing = run_timed([plumbline, "simulate", "--scenario", path, "--output", folder, "--photos",
                        "1", "--no-bag"], folder + ".log")
    if timing["exit_code"] != 0:
        raise RuntimeError("simulate: exit code %d, see %s.log" % (timing["exit_code"], folder))
    return {int(row["id"]): np.array([float(row[key]) for key in ("x_m", "y_m", "z_m")])
            for row in read_csv(os.path.join(folder, "survey.csv"))}


def read_csv(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Lens:
    """plumb_bob, as ROS defines it."""

    def __init__(self, path):
        with open(path) as file:
            data = yaml.safe_load(file)
        self.size_px = np.array([data["image_width"], data["image_height"]])
        matrix = np.reshape(data["camera_matrix"]["data"], (3, 3))
        self.focal_px = np.array([matrix[0, 0], matrix[1, 1]])
        self.center_px = matrix[:2, 2]
        self.k1, self.k2, self.p1, self.p2, self.k3 = data["distortion_coefficients"]["data"]

    def project(self, points_in_cam):
        x, y = (points_in_cam[:, :2] / points_in_cam[:, 2:]).T
        r2 = x * x + y * y
        radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        bent = np.stack([x * radial + 2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x),
                         y * radial + self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y])
        return (self.focal_px[:, None] * bent + self.center_px[:, None]).T

    def shows(self, points_in_cam):
        if not (points_in_cam[:, 2] > 0.1).all():
            return False
        pixels = self.project(points_in_cam)
        return bool((pixels >= 0.0).all() and (pixels <= self.size_px - 1).all())


def rotation_of(row):
    w, x, y, z = (float(row[key]) for key in ("qw", "qx", "qy", "qz"))
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def shown_markers(folder, centers, diameter_m, lens):
    """By photo and ID, those whose centre is in the image: where, the diameter along the minor axis,
    and whether they are there with all their white rim. The plates lie in the wall's plane, x and
    z."""
    angles_rad = 2.0 * np.pi * np.arange(RIM_POINTS) / RIM_POINTS
    circle = np.stack([np.cos(angles_rad), 0.0 * angles_rad, np.sin(angles_rad)], axis=1)
    shown = {}
    for row in read_csv(os.path.join(folder, "ground_truth", "poses.csv")):
        cam_from_world = rotation_of(row)
        camera = np.array([float(row["center_%s_m" % axis]) for axis in "xyz"])
        for marker, center in centers.items():
            rim = center - camera + 0.5 * diameter_m * circle
            quiet = center - camera + 0.5 * QUIET_RADIUS * diameter_m * circle
            middle = (center - camera)[None] @ cam_from_world.T
            if not lens.shows(middle):
                continue
            rim_px = lens.project(rim @ cam_from_world.T)
            spread = np.linalg.eigvalsh(np.cov(rim_px.T, bias=True))  # Half the squared axes.
            shown[row["photo"], marker] = {
                "is_whole": lens.shows(quiet @ cam_from_world.T),
                "center_px": lens.project(middle)[0],
                "diameter_px": 2.0 * np.sqrt(2.0 * spread[0])}
    return shown


def compare(shown, detections):
    """Rates and errors by size; what was seen where none with its ID is."""
    found, strange = {}, []
    for row in detections:
        key = row["photo"], int(row["id"])
        place = np.array([float(row["x_px"]), float(row["y_px"])])
        if key in shown and np.linalg.norm(place - shown[key]["center_px"]) < SAME_PX:
            found[key] = place - shown[key]["center_px"]
            continue
        is_other = any(photo == key[0] and
                       np.linalg.norm(place - one["center_px"]) < 0.5 * one["diameter_px"]
                       for (photo, _), one in shown.items())
        strange.append({"photo": key[0], "id": key[1], "is_other": is_other,
                        "center_px": place.tolist()})
    whole = [key for key, one in shown.items() if one["is_whole"]]
    sizes = []
    for begin, end in zip(MIN_DIAMETERS_PX, MIN_DIAMETERS_PX[1:] + [np.inf]):
        keys = [key for key in whole if begin <= shown[key]["diameter_px"] < end]
        errors_px = [float(np.linalg.norm(found[key])) for key in keys if key in found]
        if keys:
            sizes.append({"min_px": begin, "shown": len(keys), "found": len(errors_px),
                          "mean_error_px": float(np.mean(errors_px)) if errors_px else None,
                          "p95_error_px": float(np.quantile(errors_px, 0.95)) if errors_px else None,
                          "max_error_px": max(errors_px) if errors_px else None})
    return {"shown": len(whole), "found": sum(key in found for key in whole), "seen": len(detections), "sizes": sizes,
            "wrong": sum(one["is_other"] for one in strange),
            "false": sum(not one["is_other"] for one in strange), "strange": strange,
            "missed": [list(key) for key in whole if key not in found]}
