// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <sysexits.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>

#include "ros/read_options.h"

namespace plumb::ros_adapter {

// What another start would not cure: a wrong parameter, another camera's session.
struct IncurableError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Lets the log show file names as they are: it prints "?" for whatever is not ASCII unless the
// process has a UTF-8 locale.
void UseUtf8InLogs();

// Throws IncurableError if a node of this one's name answers on the master. To register would
// silently end that one, and the flight with it. What a crashed node left on the master does not
// answer. Call it after ros::init and before the first NodeHandle, which registers.
void RefuseToReplaceANode();

// The whole of a node's main: refuses to replace a running one, reads its private parameters,
// builds it, spins. What stops it is said as FATAL. Gives EX_CONFIG (78) for an IncurableError and
// for whatever is thrown while it is built, EXIT_FAILURE for what came later:
// scripts/keep_running.sh starts it again then.
template <typename Node, typename Options>
int RunNode(int argc, char** argv, const char* name) {
  UseUtf8InLogs();
  ros::init(argc, argv, name);
  try {
    RefuseToReplaceANode();
  } catch (const IncurableError& error) {
    ROS_FATAL("%s", error.what());
    return EX_CONFIG;
  }
  ros::NodeHandle handle;  // Outside the try block: its end would stop logging before the catch.
  std::unique_ptr<Node> node;
  try {
    node = std::make_unique<Node>(handle, ReadOptions<Options>(ros::NodeHandle("~")));
    ros::spin();
    return EXIT_SUCCESS;
  } catch (const IncurableError& error) {
    ROS_FATAL("%s", error.what());
    return EX_CONFIG;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return node ? EXIT_FAILURE : EX_CONFIG;
  }
}

}  // namespace plumb::ros_adapter
