# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a demo checks before it deletes anything: its camera, and that its folder is a demo's."""

import re
import shutil
import subprocess
import sys

MADE_BY_DEMO = ".plumbline_demo"  # Tells a folder that may be emptied.


def check_camera(path):
    """Ends with what is wrong with a file if the nodes would not take it as a camera."""
    run = subprocess.run(["rosrun", "plumbline", "plumbline", "check", "--camera", str(path)],
                         stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{run.stderr.strip()}; give CAMERA= the ROS camera_info YAML of the camera that "
                 "took the photos")


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
