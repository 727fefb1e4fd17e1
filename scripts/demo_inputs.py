# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a demo checks before it deletes anything: its camera, and that its folder is a demo's."""

import math
import re
import shutil
import sys

import yaml

MADE_BY_DEMO = ".plumbline_demo"  # Tells a folder that may be emptied.


def check_camera(path):
    """Ends with what is wrong with a file if it is no calibration; the nodes check the rest."""
    cure = "give CAMERA= the ROS camera_info YAML of the camera that took the photos"
    try:
        content = yaml.safe_load(path.read_text())
    except OSError as error:
        sys.exit(f"{path}: cannot be read: {error.strerror}; {cure}")
    except (UnicodeDecodeError, yaml.YAMLError):
        sys.exit(f"{path}: is no YAML; {cure}")
    fault = camera_fault(content)
    if fault:
        sys.exit(f"{path}: {fault}; {cure}")


def camera_fault(content):
    """What is wrong with the content of a camera_info YAML, or None."""
    for name in ("image_width", "image_height", "camera_matrix", "distortion_model",
                 "distortion_coefficients"):
        if not isinstance(content, dict) or name not in content:
            return f"has no {name}"
    for name in ("image_width", "image_height"):
        if not is_finite([content[name]]) or float(content[name]) < 1:
            return f"{name} must be a number of pixels, but is {content[name]}"
    num_coefficients = {"plumb_bob": [4, 5], "rational_polynomial": [8]}
    if content["distortion_model"] not in [*num_coefficients]:
        return f"distortion_model must be one of {', '.join(num_coefficients)}"
    coefficients = num_coefficients[content["distortion_model"]]
    for name, lengths in (("camera_matrix", [9]), ("distortion_coefficients", coefficients)):
        data = content[name].get("data") if isinstance(content[name], dict) else None
        if not isinstance(data, list) or len(data) not in lengths:
            return f"{name} must have a list named data of {' or '.join(map(str, lengths))} numbers"
        if not is_finite(data):
            return f"{name} must have finite numbers, but has {data}"
    focal_lengths_px = [float(content["camera_matrix"]["data"][place]) for place in (0, 4)]
    if min(focal_lengths_px) <= 0.0:
        return f"the focal lengths must be positive, but are {focal_lengths_px}"
    return None


def is_finite(values):
    """Whether all are finite numbers; also 1e-3, which YAML 1.1 takes for a word."""
    try:
        return all(math.isfinite(float(value)) for value in values)
    except (TypeError, ValueError):
        return False


def is_own_folder(folder):
    """Whether a demo made a folder, so that it may be emptied."""
    if (folder / MADE_BY_DEMO).is_file():
        return True
    # Demos once left no such file, but only these; a card they had not flown yet was empty.
    names = {path.name for path in folder.iterdir()}
    is_familiar = all(re.fullmatch(r"card|session|rviz_\d+\.png", name) for name in names)
    return ("card" in names and is_familiar
            and ((folder / "session/session.db").is_file() or not any((folder / "card").iterdir())))


def make_folder(folder, inputs):
    """Makes a demo's folder, in place of an earlier demo's; ends with the reason if it may not."""
    cure = "name another folder as --out, or remove what is there yourself"
    for path in inputs:
        if folder == path or folder in path.parents:
            sys.exit(f"{path}: lies in {folder}, which a demo empties first: copy it elsewhere")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()) and not is_own_folder(folder):
            sys.exit(f"{folder}: is not empty and was not made by a demo; {cure}")
        mark = folder / MADE_BY_DEMO  # Never away, so that Ctrl-C leaves no folder of nobody.
        mark.write_text("The next demo with this folder as --out empties it.\n")
        for path in folder.iterdir():
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            elif path != mark:
                path.unlink()
        (folder / "card").mkdir()
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}; {cure}")
