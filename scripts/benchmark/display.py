# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section: how soon RViz shows that one block of a large mesh has changed.

A wall of 231 blocks with 1000 triangles each, as the mesher sends them, in RViz as
launch/rviz.launch starts it, on a virtual display. Its middle block changes colour; the time runs
from the message until the colour is on the screen.
"""
import os
import random
import socket
import statistics
import subprocess
import tempfile
import time
import xmlrpc.client

from benchmark.measure import log
from benchmark.simulation import ROOT
from benchmark.tables import number, print_table

BLOCKS = (21, 11)  # Of a metre; the middle one is in the middle of the view.
TRIANGLES = 1000  # A block.
CHANGES = 15
DEADLINE_S = 60.0
MOST_S = 0.5  # Median.
PIXEL = "16x16+1012+506"  # Inside the middle block.
COLOURS = ((0.9, 0.1, 0.1), (0.1, 0.1, 0.9))


def add_arguments(parser):
    del parser


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def ros_environment():
    """As after `source devel/setup.bash`, with a master of its own."""
    told = subprocess.run(["bash", "-c", "source %s/devel/setup.bash && env -0" % ROOT], check=True,
                          capture_output=True, text=True).stdout
    environment = dict(line.split("=", 1) for line in told.split("\0") if "=" in line)
    environment["ROS_MASTER_URI"] = "http://127.0.0.1:%d" % free_port()
    environment["LIBGL_ALWAYS_SOFTWARE"] = "1"
    return environment


def wait_until(is_so, what):
    deadline = time.monotonic() + DEADLINE_S
    while not is_so():
        if time.monotonic() > deadline:
            raise RuntimeError("display: waited in vain for " + what)
        time.sleep(0.01)


def has_master(environment):
    try:
        xmlrpc.client.ServerProxy(environment["ROS_MASTER_URI"]).getPid("/bench")
        return True
    except OSError:
        return False


def run(arguments):
    del arguments
    environment = ros_environment()
    with tempfile.TemporaryDirectory() as folder:
        programs = []
        try:
            reader, writer = os.pipe()
            programs.append(subprocess.Popen(
                ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1600x1000x24"],
                pass_fds=[writer], stderr=subprocess.DEVNULL))
            os.close(writer)
            with os.fdopen(reader) as pipe:
                environment["DISPLAY"] = ":" + pipe.readline().strip()
            with open(os.path.join(folder, "log"), "w") as output:
                master = ["rosmaster", "--core", "-p", environment["ROS_MASTER_URI"].split(":")[-1]]
                for words in (master, ["roslaunch", "plumbline", "rviz.launch"]):
                    programs.append(subprocess.Popen(words, env=environment, stdout=output,
                                                     stderr=output))
                    wait_until(lambda: has_master(environment), "the master")
            return measure(environment)
        finally:
            for program in reversed(programs):
                program.terminate()
            for program in programs:
                program.wait()


def measure(environment):
    """In this process, which is a ROS node from now on."""
    os.environ.update(environment)
    import rospy  # Only now: it reads the environment.
    import tf2_ros
    from geometry_msgs.msg import TransformStamped
    from visualization_msgs.msg import MarkerArray

    rospy.init_node("bench_display", disable_signals=True)
    frames = tf2_ros.StaticTransformBroadcaster()
    overview = TransformStamped(child_frame_id="map_overview")
    overview.header.frame_id = "map"
    overview.transform.rotation.w = 1.0
    frames.sendTransform(overview)
    publisher = rospy.Publisher("/plumbline/mesh_gsd", MarkerArray, queue_size=10)
    wait_until(publisher.get_num_connections, "RViz")
    wall = [make_block(column, row, COLOURS[0])
            for column in range(BLOCKS[0]) for row in range(BLOCKS[1])]
    log("display: %d triangles" % (len(wall) * TRIANGLES))
    publisher.publish(MarkerArray(wall))
    wait_until(lambda: colour_on_screen(environment) == 0, "the wall on the screen")
    seconds = []
    for change in range(1, CHANGES + 1):
        time.sleep(0.4 + 0.2 * random.random())  # At any moment between two pictures.
        colour = change % 2
        blocks = MarkerArray([make_block(BLOCKS[0] // 2, BLOCKS[1] // 2, COLOURS[colour])])
        start = time.monotonic()
        publisher.publish(blocks)
        wait_until(lambda: colour_on_screen(environment) == colour, "the other colour")
        seconds.append(time.monotonic() - start)
    grabs = []
    for _ in range(5):
        start = time.monotonic()
        colour_on_screen(environment)
        grabs.append(time.monotonic() - start)
    median = statistics.median(seconds)
    failures = ["display: %.2f s, at most %g s" % (median, MOST_S)] if median > MOST_S else []
    return {"triangles": len(wall) * TRIANGLES, "seconds": seconds, "median_s": median,
            "max_s": max(seconds), "screen_grab_s": statistics.median(grabs), "failures": failures}


def make_block(column, row, colour):
    """A square metre of the wall y = 0, that the view looks at; its own marker, as the mesher's."""
    from geometry_msgs.msg import Point
    from std_msgs.msg import ColorRGBA
    from visualization_msgs.msg import Marker
    marker = Marker(type=Marker.TRIANGLE_LIST, ns="gsd", id=column * BLOCKS[1] + row)
    marker.header.frame_id = "map"
    marker.color.a = 1.0
    marker.pose.orientation.w = marker.scale.x = marker.scale.y = marker.scale.z = 1.0
    left, bottom = column - BLOCKS[0] / 2, row - BLOCKS[1] / 2
    side = 20  # By 25 small squares of two triangles.
    for i in range(side):
        for j in range(TRIANGLES // 2 // side):
            width, height = 1.0 / side, 2.0 * side / TRIANGLES
            x, z = left + i * width, bottom + j * height
            corners = [Point(x, 0, z), Point(x + width, 0, z), Point(x + width, 0, z + height),
                       Point(x, 0, z + height)]
            marker.points += [corners[k] for k in (0, 1, 2, 0, 2, 3)]
    marker.colors = [ColorRGBA(*colour, 1.0)] * TRIANGLES
    return marker


def colour_on_screen(environment):
    """Which of COLOURS fills the pixel; None if neither does."""
    data = subprocess.run(["import", "-window", "root", "-crop", PIXEL, "-depth", "8", "rgb:-"],
                          env=environment, check=True, capture_output=True).stdout
    red, blue = sum(data[0::3]), sum(data[2::3])
    if red > 3 * blue:
        return 0
    return 1 if blue > 3 * red else None


def print_results(results):
    print_table("RViz, one of %d blocks of a mesh of %d triangles changed: s until it is seen" %
                (BLOCKS[0] * BLOCKS[1], results["triangles"]),
                ["", "median", "largest", "of it the look at the screen"],
                [["software rendering", number(results["median_s"]), number(results["max_s"]),
                  number(results["screen_grab_s"])]])
