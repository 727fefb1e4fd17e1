#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays topics of a bag once all are heard, and stays when it is through: the launch goes on.

A bag that cannot be played ends it with the reason and the cure. As a launch-prefix, with --hold,
it lets a node start only if the bag can be played, so that nothing is left of a launch that ends.
"""

import argparse
import os
import pathlib
import shlex
import signal
import subprocess
import sys

PHOTO_TOPIC = "/plumbline/photo"  # Of a recorded flight.
EX_CONFIG = 78  # What the nodes end with after an error that a restart cannot cure.


def another_bag(topic):
    """Which bag would do."""
    if topic == PHOTO_TOPIC:
        return "give a bag that flight.launch recorded with record:=true"
    return "give a bag with the images of a camera"


def open_fault(bag, topic):
    """What keeps rosbag from reading a file, with the cure."""
    import rosbag  # Takes half a second: only once the arguments are right.
    try:
        with rosbag.Bag(bag) as content:
            return topics_fault(bag, topic, content.get_type_and_topic_info().topics)
    except rosbag.ROSBagUnindexedException:
        return (f"{bag}: was cut off and has no index: `rosbag reindex {shlex.quote(bag)}` "
                "makes one for what there is")
    except OSError as error:
        return f"{bag}: cannot be read: {error.strerror}; make it readable for who starts this"
    except Exception as error:  # rosbag passes on whatever bytes it stumbles over.
        return f"{bag}: is no bag or a damaged one: {error}; copy it anew or {another_bag(topic)}"


def topics_fault(bag, topic, topics):
    """What keeps the topics of a bag, {name: message_count and more}, from being played."""
    if find_topic(topic, topics):
        return None
    held = ", ".join(sorted(name for name in topics if topics[name].message_count)) or "nothing"
    cure = another_bag(topic) if topic == PHOTO_TOPIC else "correct image_topic:="
    return f"{bag}: has no messages on {topic} (it holds {held}); {cure}"


def find_topic(topic, topics):
    """A topic by its name in the bag, with messages; a bag may leave out the first slash."""
    for name in topics:
        if name.lstrip("/") == topic.lstrip("/") and topics[name].message_count:
            return name
    return None


def fault_of(bag, topic):
    """Why the topic of a bag cannot be played, with the cure; None if it can."""
    if not bag.startswith("/"):
        folder = os.environ.get("PLUMBLINE_CALLED_FROM") or os.getcwd()
        return f"bag must be an absolute path, such as {folder}/{bag}, but is {bag}"
    if not topic:
        return f"{bag}: there is no image_topic; give the topic of its images as image_topic:="
    path = pathlib.Path(bag)
    if path.is_dir():
        return f"{bag}: is a folder; name the bag in it"
    if not path.exists():
        return f"{bag}: there is no such file: correct bag:= or {another_bag(topic)}"
    if path.is_file() and path.stat().st_size == 0:
        return f"{bag}: is empty; {another_bag(topic)}"
    return open_fault(bag, topic)


def say_fatal(text):
    """As the nodes of a launch say it."""
    print(f"\x1b[31m[FATAL] {text}\x1b[0m", file=sys.stderr, flush=True)


def hold(arguments):
    """Becomes the command if the bag is good; else waits for the end, which `play` brings about."""
    if fault_of(arguments.bag, arguments.topic):
        signal.pause()
    for number in (signal.SIGPIPE, signal.SIGXFSZ):  # Python ignores them, and a command would too.
        signal.signal(number, signal.SIG_DFL)
    os.execvp(arguments.command[0], arguments.command)


def play(arguments):
    """Plays the bag, then waits for the end of the launch; returns the exit code of a failure."""
    fault = fault_of(arguments.bag, arguments.topic)
    if fault:
        say_fatal(fault)
        return EX_CONFIG
    topics = [spelling for topic in [arguments.topic, *arguments.also]
              for spelling in ("/" + topic.lstrip("/"), topic.lstrip("/"))]
    code = subprocess.run(
        ["rosrun", "rosbag", "play", "--quiet", "--wait-for-subscribers", "--rate", arguments.rate,
         arguments.bag, "--topics", *topics, *arguments.names], check=False).returncode
    if code != 0:
        say_fatal(f"{arguments.bag}: could not be played to its end, see above; if it is damaged, "
                  f"`rosbag reindex {shlex.quote(arguments.bag)}` saves what can be read")
        return code if code > 0 else EX_CONFIG
    print(f"{arguments.bag}: played to its end; Ctrl-C ends the launch", flush=True)
    signal.pause()
    return 0


def parse_arguments(words):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hold", action="store_true", help="start a command if the bag is good")
    parser.add_argument("--rate", default="1.0", help="times as fast as recorded")
    parser.add_argument("--also", nargs="*", default=[], help="topics to play if the bag has them")
    parser.add_argument("bag", help="absolute path")
    parser.add_argument("topic", help="that must be in it")
    command = []
    if "--" in words:  # What follows is not for this program.
        words, command = words[:words.index("--")], words[words.index("--") + 1:]
    names = [word for word in words if ":=" in word]  # roslaunch's __name:=play and __log:=.
    arguments = parser.parse_args([word for word in words if word not in names])
    arguments.names, arguments.command = names, command
    return arguments


def main():
    arguments = parse_arguments(sys.argv[1:])
    try:
        if arguments.hold:
            hold(arguments)
        sys.exit(play(arguments))
    except KeyboardInterrupt:  # The end of the launch.
        sys.exit(0)


if __name__ == "__main__":
    main()
