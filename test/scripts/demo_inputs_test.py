#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A demo names what is wrong with its inputs, and deletes only what a demo made."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import demo_inputs

CAMERA = """{image_width: 60, image_height: 40, distortion_model: plumb_bob,
camera_matrix: {rows: 3, cols: 3, data: [50, 0, 30, 0, 5e1, 20, 0, 0, 1]},
distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 1e-3, 0, 0]}}"""


class DemoInputsTest(unittest.TestCase):
    def test_a_file_that_is_no_camera_is_named_with_the_cure(self):
        with tempfile.TemporaryDirectory() as folder:
            camera = pathlib.Path(folder) / "camera.yaml"
            for content, problem in ((None, "cannot be read"), ("image_width: 1", "image_height"),
                                     ("{", "not YAML"), ("- 1", "image_width")):
                if content is not None:
                    camera.write_text(content)
                with self.assertRaises(SystemExit) as end:
                    demo_inputs.check_camera(camera)
                self.assertIn(problem, str(end.exception))
                self.assertIn("CAMERA=", str(end.exception))
            for word, bad, problem in (("50", ".nan", "finite"), ("50", "nan", "must be a number"),
                                       ("50", "-50", "positive"), ("5e1", "0", "positive"),
                                       ("50, ", "", "camera_matrix: rows times cols"),
                                       ("60", "wide", "image_width"),
                                       ("1e-3", ".inf", "p1 must be a finite"),
                                       ("0, 0, 1e-3", "1e-3",
                                        "distortion_coefficients: rows times cols"),
                                       ("plumb_bob", "[1]", "distortion_model")):
                camera.write_text(CAMERA.replace(word, bad, 1))
                with self.assertRaises(SystemExit) as end:
                    demo_inputs.check_camera(camera)
                self.assertIn(problem, str(end.exception))
                self.assertIn(str(camera), str(end.exception))
            camera.write_text(CAMERA)
            demo_inputs.check_camera(camera)

    def test_only_a_folder_of_a_demo_is_emptied(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve() / "out"
            demo_inputs.make_folder(folder, [])
            (folder / "card/old.jpg").write_text("of the demo before")
            demo_inputs.make_folder(folder, [])
            self.assertEqual(list((folder / "card").iterdir()), [])
            (folder / demo_inputs.MADE_BY_DEMO).unlink()
            (folder / "rviz_003.png").write_text("of a demo that left no file")
            demo_inputs.make_folder(folder, [])
            for kept in ("thesis.txt", "card/mine.jpg"):
                (folder / demo_inputs.MADE_BY_DEMO).unlink()
                (folder / kept).write_text("precious")
                with self.assertRaises(SystemExit) as end:
                    demo_inputs.make_folder(folder, [])
                self.assertIn(f"{folder}: is not empty", str(end.exception))
                self.assertEqual((folder / kept).read_text(), "precious")
                (folder / kept).unlink()
                demo_inputs.make_folder(folder, [])
            with self.assertRaises(SystemExit) as end:
                demo_inputs.make_folder(folder, [folder / "card"])
            self.assertIn("copy it elsewhere", str(end.exception))
            file = folder / "file"
            file.write_text("precious")
            with self.assertRaises(SystemExit):
                demo_inputs.make_folder(file, [])
            self.assertEqual(file.read_text(), "precious")

    def test_a_folder_of_a_demo_that_left_no_file_is_known_by_its_session(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve()
            (folder / "card").mkdir()
            (folder / "session").mkdir()
            (folder / "card/1.jpg").write_text("flown")
            self.assertFalse(demo_inputs.is_own_folder(folder))
            (folder / "session/session.db").write_text("")
            self.assertTrue(demo_inputs.is_own_folder(folder))


if __name__ == "__main__":
    unittest.main()
