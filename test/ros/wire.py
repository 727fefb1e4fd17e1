#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the rostests share: nodes as processes, and messages waited for with a deadline."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import threading
import time
import unittest

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from plumbline.msg import Photo
from sensor_msgs.msg import CameraInfo

DEADLINE_S = 60.0

EX_CONFIG = 78  # Of a node that another start would not cure.

CAMERA_YAML = """\
image_width: 64
image_height: 48
camera_name: tiny
camera_matrix: {rows: 3, cols: 3, data: [60, 0, 31.5, 0, 60, 23.5, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}
"""

# Enough of a JPEG for camera_ingest, which does not decode.
JPEG = b"\xff\xd8 pixels \xff\xd9"


def shared_data(scene):
    """The folder of a scene of the shared data; skips the test where there is none."""
    source = pathlib.Path(__file__).resolve().parents[2]
    folder = pathlib.Path(os.environ.get("PLUMBLINE_DATA", source.parent / "shared/data")) / scene
    if not folder.is_dir():
        raise unittest.SkipTest(f"no shared data: {folder} is absent; set PLUMBLINE_DATA")
    return folder


def wait_until(condition, what):
    """Asks again and again, for what no message tells, such as that rospy has a connection."""
    deadline_s = time.monotonic() + DEADLINE_S
    while not condition():
        if time.monotonic() > deadline_s:
            raise AssertionError(f"in {DEADLINE_S} s there was not {what}")
        time.sleep(0.02)


class Heard:
    """All messages of a topic since this object was made."""

    def __init__(self, topic, message_type):
        self._changed = threading.Condition()
        self._messages = []
        self._subscriber = rospy.Subscriber(topic, message_type, self._hear, queue_size=1000)

    def _hear(self, message):
        with self._changed:
            self._messages.append(message)
            self._changed.notify_all()

    def all(self):
        with self._changed:
            return list(self._messages)

    def wait(self, condition, what, deadline_s=DEADLINE_S):
        """Waits until the condition holds of the list of messages; returns the list."""
        with self._changed:
            if not self._changed.wait_for(lambda: condition(self._messages), deadline_s):
                raise AssertionError(f"in {deadline_s} s, {what} was not heard; heard were "
                                     f"{len(self._messages)} messages")
            return list(self._messages)

    def is_connected(self):
        return self._subscriber.get_num_connections() > 0

    def close(self):
        self._subscriber.unregister()


class Diagnostics(Heard):
    """What /diagnostics says from now on."""

    def __init__(self):
        super().__init__("/diagnostics", DiagnosticArray)
        self._num_known = 0

    def _wait_for_news(self, is_it, what):
        def is_heard(messages):
            return any(is_it(status) for message in messages[self._num_known:]
                       for status in message.status)
        self._num_known = len(self.wait(is_heard, what))

    def wait_for_error(self, text):
        self._wait_for_news(lambda status: status.level == DiagnosticStatus.ERROR and
                            text in status.message, f"an ERROR with '{text}'")

    def wait_for_figure(self, node, key, value):
        """As the panel reads it: by the node's hardware id."""
        self._wait_for_news(lambda status: status.hardware_id == node and any(
            pair.key == key and pair.value == value for pair in status.values),
                            f"{key} {value} of {node}")

    def wait_for_no_error(self):
        self._wait_for_news(lambda status: status.level != DiagnosticStatus.ERROR, "no ERROR")


def start_node(name, namespace, **parameters):
    """Starts a node of this package with private parameters; its log is in `stdout`."""
    arguments = [f"_{key}:={value}" for key, value in parameters.items()]
    return subprocess.Popen(["rosrun", "plumbline", name, f"__ns:={namespace}"] + arguments,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def photo_message(sequence, name, data):
    """A photo of the tiny camera, as camera_ingest sends it."""
    message = Photo(sequence=sequence, name=name)
    message.image.data = data
    message.camera_info = CameraInfo(width=64, height=48, distortion_model="plumb_bob",
                                     D=[0.0] * 5, K=[60.0, 0, 31.5, 0, 60.0, 23.5, 0, 0, 1])
    return message


def end(process):
    """Ends a process by SIGINT; returns what it said."""
    process.send_signal(2)
    said, _ = process.communicate(timeout=DEADLINE_S)
    return said


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, gone at the end."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="plumbline_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.card = self.folder / "card"
        self.card.mkdir()
        self.session = self.folder / "session"
        self.camera = self.folder / "camera.yaml"
        self.camera.write_text(CAMERA_YAML)
