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
import re
import signal
import socket
import subprocess
import sys
import threading
import time

import demo_inputs
import fly_photos

START_DEADLINE_S = 60.0
POLL_S = 0.1
READ_S = 5.0  # For the last lines of a launch that has ended.
QUEUE_S = 2.0  # A photo that waits no longer came while another one was in work.
HARMLESS = "[rospack] Error: no such package media_export"  # RViz asks for it; Debian has none.
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


class Launch:
    """roslaunch, whose output is shown and searched for why it ends."""

    def __init__(self, words):
        self._fatal = ""
        self._process = subprocess.Popen(
            words, start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True, errors="replace", env={**os.environ, "PYTHONUNBUFFERED": "1"})
        self._reader = threading.Thread(target=self._show, daemon=True)
        self._reader.start()

    def _show(self):
        for line in self._process.stdout:
            if line.strip() == HARMLESS:
                continue
            print(line, end="", flush=True)
            if "FATAL" in line:
                self._fatal = re.sub(r"\x1b\[[0-9;]*m|\[FATAL\] *|\[\d+\.\d+\]: *", "", line).strip()

    def check(self):
        """Ends with the reason if the launch has ended."""
        if self._process.poll() is None:
            return
        self._reader.join(READ_S)
        sys.exit("the flight has ended by itself: " + (self._fatal or "see its messages above"))

    def wait_for(self, is_so, deadline_s):
        """Waits until something is so; False if it is not in time. Ends if the launch does."""
        deadline = time.monotonic() + deadline_s
        while not is_so():
            self.check()
            if time.monotonic() > deadline:
                return False
            time.sleep(POLL_S)
        return True

    def end(self):
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        self._process.wait()
        self._reader.join(READ_S)
        if not self._reader.is_alive():
            self._process.stdout.close()


class Verdicts:
    """The latest verdict of each photo, as they are heard."""

    def __init__(self):
        self._lock = threading.Lock()
        self._by_name = {}
        self._waits_s = []

    def hear(self, message):
        with self._lock:
            self._by_name[message.name] = message
            if message.attempt == 1:  # Later ones follow other photos, not the queue.
                self._waits_s.append(waited_s(message))

    def num_photos(self):
        with self._lock:
            return len(self._by_name)

    def all(self):
        with self._lock:
            return [self._by_name[name] for name in sorted(self._by_name)]

    def longest_wait_s(self):
        with self._lock:
            return max(self._waits_s, default=0.0)


def waited_s(verdict):
    """How long a photo lay in queues before its verdict."""
    return verdict.verdict_s - (verdict.decode_s + verdict.features_s + verdict.retrieval_s +
                                verdict.matching_s + verdict.pose_s)


def take_picture(path):
    time.sleep(DRAW_S)
    subprocess.run(["import", "-window", "root", str(path)], check=True)
    print(f"Picture of the screen: {path}", flush=True)


def fly(photos, card, launch, verdicts, arguments):
    """Leaves the photos on the card and waits for verdicts; returns how many were readable."""
    num_left = 0
    for number, photo in enumerate(photos, start=1):
        begin = time.monotonic()
        num_left += fly_photos.leave_photo(photo, card / photo.relative_to(arguments.photos))
        if number in arguments.picture_at and number < len(photos):
            launch.wait_for(lambda: verdicts.num_photos() >= num_left, arguments.deadline)
            take_picture(arguments.out / f"rviz_{number:03d}.png")
        launch.check()
        time.sleep(max(0.0, arguments.every - (time.monotonic() - begin)))
    if not launch.wait_for(lambda: verdicts.num_photos() >= num_left, arguments.deadline):
        print("Not all photos were answered in time.")
    return num_left


def describe_times(verdicts, longest_wait_s):
    """One or two lines on how long photos took, or none without verdicts."""
    if not verdicts:
        return []
    times_s = sorted(verdict.verdict_s for verdict in verdicts)
    work_s = sorted(verdict.verdict_s - waited_s(verdict) for verdict in verdicts)
    middle = len(verdicts) // 2
    lines = [f"median {times_s[middle]:.2f} s from photo to verdict, "
             f"{work_s[middle]:.2f} s of it work"]
    if longest_wait_s > QUEUE_S:
        lines.append("Photos came faster than this computer maps them: "
                     f"they waited up to {longest_wait_s:.0f} s in the queue; "
                     "a longer --every gives it time")
    return lines


def print_verdicts(heard):
    verdicts = heard.all()
    for verdict in verdicts:
        print(f"  {verdict.name}: {verdict.status} after {verdict.verdict_s:.2f} s"
              + (f", {verdict.reason}: {verdict.hint}" if verdict.status != "accepted" else
                 f", {verdict.num_inliers} landmarks agree"))
    for status in ("accepted", "waiting", "refused"):
        print(f"{sum(verdict.status == status for verdict in verdicts)} {status}", end=", ")
    print(*describe_times(verdicts, heard.longest_wait_s()), sep="\n")


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


def print_georeference(georeference):
    """Prints what the last Georeference message says; nothing without targets and GPS."""
    if georeference is None or (georeference.source == "none" and not georeference.targets):
        return
    compared = [target for target in georeference.targets if target.state in ("good", "wrong")]
    for target in compared:
        print(f"  target {target.name}: {target.role}, {target.state}, {target.error_mm:.1f} mm "
              f"(expected {target.sigma_mm:.1f}), in {target.num_used} photos")
    for role in ("control", "check"):
        if number := getattr(georeference, f"num_{role}"):
            print(f"{number} {role} points: mean {getattr(georeference, f'{role}_mean_mm'):.2f} mm, "
                  f"largest {getattr(georeference, f'{role}_max_mm'):.2f} mm")
    scale = georeference.metres_per_map_unit
    print(f"Placed by: {georeference.source}" + (f", {scale:.6f} m a map unit" if scale else ""))
    for finding in georeference.findings:
        print(f"  {finding.severity}: {finding.text}")


def run_flight(launch, photos, arguments):
    """Flies; returns whether each readable photo was answered and one was accepted."""
    import rospy  # After ROS_MASTER_URI is set.
    from plumbline.msg import Georeference, PhotoVerdict, StoredPhotos
    from std_srvs.srv import Trigger

    session = arguments.out / "session"
    verdicts = Verdicts()
    rospy.init_node("demo", anonymous=True, disable_signals=True)
    rospy.Subscriber("/plumbline/photo_verdict", PhotoVerdict, verdicts.hear, queue_size=1000)
    georeferences = [None]
    rospy.Subscriber("/plumbline/georeference", Georeference,
                     lambda heard: georeferences.append(heard), queue_size=1000)
    is_mapping = threading.Event()
    rospy.Subscriber("/plumbline/stored_photos", StoredPhotos, lambda _: is_mapping.set())
    if not launch.wait_for(is_mapping.is_set, START_DEADLINE_S):
        sys.exit("the mapper does not answer; see its messages above")
    num_left = fly(photos, arguments.out / "card", launch, verdicts, arguments)
    finish = rospy.ServiceProxy("/plumbline/finish", Trigger)
    answer = finish()
    if not answer.success:
        print(f"The flight is not finished: {answer.message}")
    take_picture(arguments.out / f"rviz_{len(photos):03d}.png")
    print_verdicts(verdicts)
    if num_left < len(photos):
        print(f"{len(photos) - num_left} photos could not be read and were left out")
    is_any_accepted = any(verdict.status == "accepted" for verdict in verdicts.all())
    if is_any_accepted:
        print_accuracy(session, arguments.photos.parent / "ground_truth")
    else:
        print("No photo was accepted: there is no map.")
    print_georeference(georeferences[-1])
    print(f"Report: {session / 'report.json'}")
    return is_any_accepted and verdicts.num_photos() == num_left


def wait_for_master(launch):
    import rosgraph
    if not launch.wait_for(rosgraph.is_master_online, START_DEADLINE_S):
        sys.exit("roslaunch did not start; see its messages above")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--photos", required=True, type=pathlib.Path, help="folder of photos, with its sub-folders")
    parser.add_argument("--camera", required=True, type=pathlib.Path, help="camera_info YAML")
    parser.add_argument("--survey", type=pathlib.Path,
                        help="of the targets; by default the survey.csv beside the photos, if any")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("build/demo"),
                        help="folder for pictures and session, new or of an earlier demo, which is "
                             "deleted first")
    parser.add_argument("--every", type=float, default=1.0, help="seconds from photo to photo")
    parser.add_argument("--deadline", type=float, default=120.0,
                        help="seconds to wait for the last verdicts")
    parser.add_argument("--picture-at", type=int, nargs="*", default=[3],
                        help="numbers of photos after which to take a picture; one more at the end")
    parser.add_argument("--record", action="store_true", help="record the wire into the session")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    try:
        photos = fly_photos.list_photos(arguments.photos.resolve())
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}: give PHOTOS= and CAMERA=")
    if not photos:
        sys.exit(f"{arguments.photos} holds no photos: give PHOTOS= and CAMERA=")
    demo_inputs.check_camera(arguments.camera)
    arguments.photos = arguments.photos.resolve()
    beside = arguments.photos.parent / "survey.csv"
    survey = arguments.survey or (beside if beside.exists() else None)
    if survey and not survey.is_file():
        sys.exit(f"{survey}: there is no such file; correct --survey or leave it out")
    arguments.out = arguments.out.resolve()
    demo_inputs.make_folder(arguments.out, [path.resolve() for path in (
        arguments.photos, arguments.camera, survey) if path])

    display = None if os.environ.get("DISPLAY") else start_virtual_display()
    port = free_port()
    os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
    launch = Launch(
        ["roslaunch", "--no-summary", "-p", str(port), "plumbline", "flight.launch",
         f"photos:={arguments.out / 'card'}", f"camera:={arguments.camera.resolve()}",
         f"session:={arguments.out / 'session'}", "respawn:=false",
         f"survey:={survey.resolve() if survey else ''}",
         f"record:={str(arguments.record).lower()}"])
    try:
        wait_for_master(launch)
        is_complete = run_flight(launch, photos, arguments)
    finally:
        launch.end()
        if display:
            display.terminate()
    sys.exit(0 if is_complete else 1)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        # What there was is kept.
        print("demo: ended by Ctrl-C", file=sys.stderr)
        sys.exit(130)
