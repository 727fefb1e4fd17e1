# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes: folders with photos/, camera.yaml and, if they are known, ground_truth/poses.csv."""
import os


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
        raise RuntimeError("%s: no scene %s; a scene is a folder with photos/ and camera.yaml"
                           % (data, ", ".join(sorted(missing)) or "at all"))
    return scenes
