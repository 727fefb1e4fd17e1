#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Flies a folder of photos through flight.launch with RViz and says what came of it.

Photos are left one by one in a watched folder, as a camera would. Ends by itself once each has its
verdict. Where there is no display, RViz draws on a virtual one. Pictures of the screen, the
session and its report are kept in --out.
"""

import argparse
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time

import fly_photos

START_DEADLINE_S = 60.0
DRAW_S = 3.0  # RViz draws ten times a second, in software a good deal slower.


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def start_virtual_display():
    """Starts an X server on a free display; returns its process, with DISPLAY set."""
    reader, writer = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"],
        pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writer)
    with os.fdopen(reader) as pipe:
        number = pipe.readline().strip()
    if not number:
        sys.exit("Xvfb did not start")
    os.environ["DISPLAY"] = f":{number}"
    os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
    return server


class Verdicts:
    """The latest verdict of each photo, as they are heard."""

    def __init__(self):
        self._changed = threading.Condition()
        self._by_name = {}

    def hear(self, message):
        with self._changed:
            self._by_name[message.name] = message
            self._changed.notify_all()

    def wait_for(self, num_photos, deadline_s):
        """Waits until so many photos have a verdict; False if they do not in time."""
        with self._changed:
            return self._changed.wait_for(lambda: len(self._by_name) >= num_photos, deadline_s)

    def all(self):
        with self._changed:
            return [self._by_name[name] for name in sorted(self._by_name)]


def take_picture(path):
    time.sleep(DRAW_S)
    subprocess.run(["import", "-window", "root", str(path)], check=True)
    print(f"Picture of the screen: {path}", flush=True)


def fly(photos, card, verdicts, arguments):
    """Leaves the photos on the card; returns how many were answered in time."""
    for number, photo in enumerate(photos, start=1):
        begin = time.monotonic()
        fly_photos.leave_photo(photo, card / photo.relative_to(arguments.photos))
        if number in arguments.picture_at and number < len(photos):
            verdicts.wait_for(number, arguments.deadline)
            take_picture(arguments.out / f"rviz_{number:03d}.png")
        time.sleep(max(0.0, arguments.every - (time.monotonic() - begin)))
    if not verdicts.wait_for(len(photos), arguments.deadline):
        print("Not all photos were answered in time.")


def print_verdicts(verdicts):
    for verdict in verdicts:
        print(f"  {verdict.name}: {verdict.status} after {verdict.verdict_s:.2f} s"
              + (f", {verdict.reason}: {verdict.hint}" if verdict.status != "accepted" else
                 f", {verdict.num_inliers} landmarks agree"))
    for status in ("accepted", "waiting", "refused"):
        print(f"{sum(verdict.status == status for verdict in verdicts)} {status}", end=", ")
    times = sorted(verdict.verdict_s for verdict in verdicts)
    if times:
        print(f"median {times[len(times) // 2]:.2f} s from photo to verdict")


def print_accuracy(session, truth):
    """Prints what `plumbline evaluate` measures against the truth in a folder, if there is any."""
    poses, surface = truth / "poses.csv", truth / "surface.ply"
    if not poses.exists():
        return
    run = subprocess.run(["rosrun", "plumbline", "plumbline", "evaluate", "--session",
                          str(session), "--truth", str(poses)]
                         + (["--surface", str(surface)] if surface.exists() else []),
                         capture_output=True, text=True)
    if run.returncode != 0:
        print(f"No accuracy: {run.stderr.strip()}")
        return
    result = json.loads(run.stdout)
    error = result["center_error_mm"]
    print(f"Camera centres against {poses}: mean {error['mean']:.2f} mm, "
          f"largest {error['max']:.2f} mm, {len(result['wrong'])} wrong poses")
    points = result.get("surface")
    if points:
        print(f"Points against {surface}: half within {points['accuracy']['median_mm']:.1f} mm, "
              f"90 % within {points['accuracy']['p90_mm']:.1f} mm")
        if result["wall"]:
            print(f"Largest bend of the flat wall: {result['wall']['max_bend_mm']:.1f} mm")


def run_flight(arguments):
    import rospy  # After ROS_MASTER_URI is set.
    from plumbline.msg import PhotoVerdict, StoredPhotos
    from std_srvs.srv import Trigger

    session = arguments.out / "session"
    verdicts = Verdicts()
    rospy.init_node("demo", anonymous=True, disable_signals=True)
    rospy.Subscriber("/plumbline/photo_verdict", PhotoVerdict, verdicts.hear, queue_size=1000)
    rospy.wait_for_message("/plumbline/stored_photos", StoredPhotos, START_DEADLINE_S)
    photos = fly_photos.list_photos(arguments.photos)
    fly(photos, arguments.out / "card", verdicts, arguments)
    finish = rospy.ServiceProxy("/plumbline/finish", Trigger)
    answer = finish()
    if not answer.success:
        print(f"The flight is not finished: {answer.message}")
    take_picture(arguments.out / f"rviz_{len(photos):03d}.png")
    print_verdicts(verdicts.all())
    print_accuracy(session, arguments.photos.parent / "ground_truth")
    print(f"Report: {session / 'report.json'}")
    return len(verdicts.all()) == len(photos)


def wait_for_master(launch):
    import rosgraph
    deadline = time.monotonic() + START_DEADLINE_S
    while not rosgraph.is_master_online():
        if launch.poll() is not None or time.monotonic() > deadline:
            sys.exit("roslaunch did not start; see its messages above")
        time.sleep(0.1)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--photos", required=True, type=pathlib.Path, help="folder of photos, with its sub-folders")
    parser.add_argument("--camera", required=True, type=pathlib.Path, help="camera_info YAML")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("build/demo"),
                        help="folder for pictures and session; emptied first")
    parser.add_argument("--every", type=float, default=1.0, help="seconds from photo to photo")
    parser.add_argument("--deadline", type=float, default=120.0,
                        help="seconds to wait for the last verdicts")
    parser.add_argument("--picture-at", type=int, nargs="*", default=[3],
                        help="numbers of photos after which to take a picture; one more at the end")
    parser.add_argument("--record", action="store_true", help="record the wire into the session")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    if not arguments.photos.is_dir() or not fly_photos.list_photos(arguments.photos):
        sys.exit(f"{arguments.photos} holds no photos: give PHOTOS= and CAMERA=")
    arguments.photos = arguments.photos.resolve()
    arguments.out = arguments.out.resolve()
    shutil.rmtree(arguments.out, ignore_errors=True)
    (arguments.out / "card").mkdir(parents=True)

    display = None if os.environ.get("DISPLAY") else start_virtual_display()
    port = free_port()
    os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
    launch = subprocess.Popen(
        ["roslaunch", "--no-summary", "-p", str(port), "plumbline", "flight.launch",
         f"photos:={arguments.out / 'card'}", f"camera:={arguments.camera.resolve()}",
         f"session:={arguments.out / 'session'}", "respawn:=false",
         f"record:={str(arguments.record).lower()}"], start_new_session=True)
    try:
        wait_for_master(launch)
        is_complete = run_flight(arguments)
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait()
        if display:
            display.terminate()
    sys.exit(0 if is_complete else 1)


if __name__ == "__main__":
    main()
