#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the demo says before and after a flight, and of a launch that ends too early."""

import contextlib
import io
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import demo


CAMERA = """{image_width: 60, image_height: 40, distortion_model: plumb_bob,
camera_matrix: {rows: 3, cols: 3, data: [50, 0, 30, 0, 5e1, 20, 0, 0, 1]},
distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 1e-3, 0, 0]}}"""


def verdict(verdict_s, work_s):
    return types.SimpleNamespace(verdict_s=verdict_s, decode_s=work_s, features_s=0.0,
                                 retrieval_s=0.0, matching_s=0.0, pose_s=0.0, attempt=1, name="a")


class DemoTest(unittest.TestCase):
    def test_a_file_that_is_no_camera_is_named_with_the_cure(self):
        with tempfile.TemporaryDirectory() as folder:
            camera = pathlib.Path(folder) / "camera.yaml"
            for content, problem in ((None, "cannot be read"), ("image_width: 1", "image_height"),
                                     ("{", "no YAML"), ("- 1", "image_width")):
                if content is not None:
                    camera.write_text(content)
                with self.assertRaises(SystemExit) as end:
                    demo.check_camera(camera)
                self.assertIn(problem, str(end.exception))
                self.assertIn("CAMERA=", str(end.exception))
            for word, bad, problem in (("50", ".nan", "finite"), ("50", "nan", "finite"),
                                       ("50", "-50", "positive"), ("5e1", "0", "positive"),
                                       ("50, ", "", "9 numbers"), ("60", "wide", "image_width"),
                                       ("1e-3", ".inf", "distortion_coefficients"),
                                       ("0, 0, 1e-3", "1e-3", "4 or 5 numbers"),
                                       ("plumb_bob", "[1]", "distortion_model")):
                camera.write_text(CAMERA.replace(word, bad, 1))
                with self.assertRaises(SystemExit) as end:
                    demo.check_camera(camera)
                self.assertIn(problem, str(end.exception))
                self.assertIn(str(camera), str(end.exception))
            camera.write_text(CAMERA)
            demo.check_camera(camera)

    def test_only_a_folder_of_a_demo_is_emptied(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve() / "out"
            demo.make_folder(folder, [])
            (folder / "card/old.jpg").write_text("of the demo before")
            demo.make_folder(folder, [])
            self.assertEqual(list((folder / "card").iterdir()), [])
            (folder / demo.MADE_BY_DEMO).unlink()
            (folder / "rviz_003.png").write_text("of a demo that left no file")
            demo.make_folder(folder, [])
            for kept in ("thesis.txt", "card/mine.jpg"):
                (folder / demo.MADE_BY_DEMO).unlink()
                (folder / kept).write_text("precious")
                with self.assertRaises(SystemExit) as end:
                    demo.make_folder(folder, [])
                self.assertIn(f"{folder}: is not empty", str(end.exception))
                self.assertEqual((folder / kept).read_text(), "precious")
                (folder / kept).unlink()
                demo.make_folder(folder, [])
            with self.assertRaises(SystemExit) as end:
                demo.make_folder(folder, [folder / "card"])
            self.assertIn("copy it elsewhere", str(end.exception))
            file = folder / "file"
            file.write_text("precious")
            with self.assertRaises(SystemExit):
                demo.make_folder(file, [])
            self.assertEqual(file.read_text(), "precious")

    def test_a_folder_of_a_demo_that_left_no_file_is_known_by_its_session(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve()
            (folder / "card").mkdir()
            (folder / "session").mkdir()
            (folder / "card/1.jpg").write_text("flown")
            self.assertFalse(demo.is_own_folder(folder))
            (folder / "session/session.db").write_text("")
            self.assertTrue(demo.is_own_folder(folder))

    def test_work_and_waiting_are_told_apart(self):
        lines = demo.describe_times([verdict(9.0, 1.0)] * 3, 8.0)
        self.assertEqual(lines[0], "median 9.00 s from photo to verdict, 1.00 s of it work")
        self.assertIn("up to 8 s in the queue", lines[1])
        self.assertEqual(len(demo.describe_times([verdict(1.2, 1.0)], 0.2)), 1)
        self.assertEqual(demo.describe_times([], 0.0), [])

    def test_only_first_verdicts_tell_of_the_queue(self):
        verdicts = demo.Verdicts()
        verdicts.hear(verdict(3.0, 1.0))
        later = verdict(99.0, 1.0)
        later.attempt = 2
        verdicts.hear(later)
        self.assertEqual(verdicts.longest_wait_s(), 2.0)
        self.assertEqual(verdicts.num_photos(), 1)

    def test_targets_are_told_with_their_millimetres_and_what_is_wrong(self):
        target = types.SimpleNamespace(name="5", role="check", state="wrong", error_mm=487.04,
                                       sigma_mm=2.0, num_used=3)
        unseen = types.SimpleNamespace(name="6", state="unseen")
        finding = types.SimpleNamespace(severity="warning", text="target 5 was moved")
        georeference = types.SimpleNamespace(
            source="targets", targets=[target, unseen], findings=[finding], num_control=4,
            control_mean_mm=1.0, control_max_mm=2.0, num_check=0, metres_per_map_unit=0.8)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            demo.print_georeference(georeference)
            demo.print_georeference(None)
        self.assertEqual(said.getvalue().splitlines(), [
            "  target 5: check, wrong, 487.0 mm (expected 2.0), in 3 photos",
            "4 control points: mean 1.00 mm, largest 2.00 mm",
            "Placed by: targets, 0.800000 m a map unit", "  warning: target 5 was moved"])

    def test_a_launch_that_ends_is_told_with_its_reason(self):
        launch = demo.Launch(["bash", "-c", r"echo -e '\e[31m[FATAL] [12.5]: no card\e[0m'; exit 1"])
        with self.assertRaises(SystemExit) as end:
            launch.wait_for(lambda: False, 60.0)
        launch.end()
        self.assertEqual(str(end.exception), "the flight has ended by itself: no card")

    def test_what_rviz_misses_without_harm_is_not_shown(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            launch = demo.Launch(["printf", "%s\n", "before", demo.HARMLESS, "after"])
            launch._process.wait()
            launch.end()
        self.assertEqual(said.getvalue(), "before\nafter\n")

    def test_a_launch_that_runs_is_waited_for(self):
        launch = demo.Launch(["sleep", "60"])
        self.assertFalse(launch.wait_for(lambda: False, 0.0))
        self.assertTrue(launch.wait_for(lambda: True, 60.0))
        launch.end()


    def test_ctrl_c_ends_it_quietly(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "photos").mkdir()
            (folder / "photos" / "1.jpg").write_text("never looked at")
            (folder / "camera.yaml").write_text(CAMERA)
            launch = folder / "roslaunch"  # In place of ROS's: says that it runs, then waits.
            launch.write_text("#!/bin/sh\necho running\nexec sleep 60\n")
            launch.chmod(0o755)
            run = subprocess.Popen(
                [sys.executable, demo.__file__, "--photos", folder / "photos", "--camera",
                 folder / "camera.yaml", "--out", folder / "out"],
                env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "DISPLAY": ":99"},
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertEqual(run.stdout.readline(), "running\n")
            run.send_signal(signal.SIGINT)
            _, errors = run.communicate(timeout=60.0)
        self.assertEqual(run.returncode, 130)
        self.assertEqual(errors, "demo: ended by Ctrl-C\n")


if __name__ == "__main__":
    unittest.main()
