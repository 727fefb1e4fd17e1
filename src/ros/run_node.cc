// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/run_node.h"

#include <langinfo.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpc.h>

#include <chrono>
#include <clocale>
#include <cstdint>
#include <optional>
#include <string>

namespace plumb::ros_adapter {
namespace {

// Of a call that a process answers at once, on this computer or one beside it.
constexpr std::chrono::seconds kAnswerDeadline(3);
constexpr double kPoll_s = 0.05;

// Calls `method` with this node's name and `argument`, if it is not empty. Nothing if it does not
// answer in time, or with a failure.
std::optional<XmlRpc::XmlRpcValue> Ask(const std::string& uri,
                                       const char* method,
                                       const std::string& argument = {}) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return std::nullopt;
  XmlRpc::XmlRpcValue words;
  words[0] = ros::this_node::getName();
  if (!argument.empty()) words[1] = argument;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  if (!client.executeNonBlock(method, words)) return std::nullopt;
  XmlRpc::XmlRpcDispatch dispatch;
  dispatch.addSource(&client,
                     XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  XmlRpc::XmlRpcValue answer;
  const auto deadline = std::chrono::steady_clock::now() + kAnswerDeadline;
  while (!client.executeCheckDone(answer)) {
    const bool is_closed = client.getfd() < 0;  // Nobody listens there any more.
    if (is_closed || std::chrono::steady_clock::now() > deadline) return std::nullopt;
    dispatch.work(kPoll_s);
  }
  const bool is_success = !client.isFault() && answer.getType() == XmlRpc::XmlRpcValue::TypeArray &&
                          answer.size() == 3 &&
                          answer[0].getType() == XmlRpc::XmlRpcValue::TypeInt &&
                          static_cast<int&>(answer[0]) == 1;
  if (!is_success) return std::nullopt;
  return answer[2];
}

}  // namespace

void UseUtf8InLogs() {
  std::setlocale(LC_CTYPE, "");
  if (nl_langinfo(CODESET) != std::string("UTF-8")) std::setlocale(LC_CTYPE, "C.UTF-8");
}

void RefuseToReplaceANode() {
  const std::string& name = ros::this_node::getName();
  std::optional<XmlRpc::XmlRpcValue> uri = Ask(ros::master::getURI(), "lookupNode", name);
  if (!uri || uri->getType() != XmlRpc::XmlRpcValue::TypeString) return;
  if (!Ask(static_cast<std::string&>(*uri), "getPid")) return;
  throw IncurableError(name + " is running already on " + ros::master::getURI() +
                       ": end that flight first, or use another ROS_MASTER_URI");
}

}  // namespace plumb::ros_adapter
