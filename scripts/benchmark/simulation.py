# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulated flights, kept under build/ for as long as they would come out the same."""
import glob
import hashlib
import os
import shutil

from benchmark.measure import log, run_timed
from benchmark.scenes import Scene

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCENARIOS = os.path.join(ROOT, "config", "scenarios")
CACHE = os.path.join(ROOT, "build", "scenarios")


def scenario_names():
    """Of the flights; floors to calibrate with are no scenes to reconstruct."""
    return sorted(os.path.basename(path)[:-len(".yaml")]
                  for path in glob.glob(os.path.join(SCENARIOS, "*.yaml"))
                  if not os.path.basename(path).startswith("calibration"))


def digest_of(name):
    """Of the scenario and of all that draws it."""
    paths = [os.path.join(SCENARIOS, name + ".yaml")]
    for folder in ("src/simulation", "include/plumbline/simulation"):
        paths += sorted(glob.glob(os.path.join(ROOT, folder, "*")))
    digest = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            digest.update(os.path.basename(path).encode() + b"\0" + file.read())
    return digest.hexdigest()[:12]


def simulate(plumbline, name, rows=None, max_photos=None):
    """The scene, simulated or taken from an earlier run; what an older simulator drew is removed."""
    label = name + ("-" + rows if rows else "") + ("-%d" % max_photos if max_photos else "")
    folder = os.path.join(CACHE, "%s@%s" % (label, digest_of(name)))
    for other in glob.glob(os.path.join(CACHE, label + "@*")):
        if not other.startswith(folder):
            log("removing %s: the simulator has changed" % other)
            shutil.rmtree(other) if os.path.isdir(other) else os.remove(other)
    done = folder + ".complete"  # Holds the seconds it took.
    if not os.path.exists(done):
        os.makedirs(CACHE, exist_ok=True)
        log("simulating %s into %s" % (label, folder))
        command = [plumbline, "simulate", "--scenario", os.path.join(SCENARIOS, name + ".yaml"),
                   "--output", folder, "--no-bag"]
        command += ["--rows", rows] if rows else []
        command += ["--photos", str(max_photos)] if max_photos else []
        timing = run_timed(command, folder + ".log")
        if timing["exit_code"] != 0:
            raise RuntimeError("simulate %s: exit code %d, see %s.log"
                               % (label, timing["exit_code"], folder))
        with open(done, "w") as file:
            file.write("%.1f\n" % timing["wall_s"])
    scene = Scene(folder)
    scene.name = label
    with open(done) as file:
        scene.simulation_s = float(file.read())
    return scene
