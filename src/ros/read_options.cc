// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/read_options.h"

#include <algorithm>
#include <sstream>

namespace plumb::ros_adapter {
namespace {

using XmlRpc::XmlRpcValue;

const char* NameOfType(const XmlRpcValue& parameter) {
  switch (parameter.getType()) {
    case XmlRpcValue::TypeBoolean:
      return "a boolean";
    case XmlRpcValue::TypeInt:
      return "an integer";
    case XmlRpcValue::TypeDouble:
      return "a double";
    case XmlRpcValue::TypeString:
      return "a text";
    case XmlRpcValue::TypeArray:
      return "a list";
    case XmlRpcValue::TypeStruct:
      return "a group";
    default:
      return "of a type that has no use here";
  }
}

// XmlRpcValue's conversions are not const.
template <typename Value>
bool Assign(XmlRpcValue parameter, XmlRpcValue::Type type, Value* value) {
  if (parameter.getType() != type) return false;
  *value = static_cast<Value&>(parameter);
  return true;
}

}  // namespace

bool AssignParameter(const XmlRpcValue& parameter, double* value) {
  int integer = 0;
  if (!Assign(parameter, XmlRpcValue::TypeInt, &integer)) {
    return Assign(parameter, XmlRpcValue::TypeDouble, value);
  }
  *value = integer;
  return true;
}

bool AssignParameter(const XmlRpcValue& parameter, int* value) {
  return Assign(parameter, XmlRpcValue::TypeInt, value);
}

bool AssignParameter(const XmlRpcValue& parameter, bool* value) {
  return Assign(parameter, XmlRpcValue::TypeBoolean, value);
}

bool AssignParameter(const XmlRpcValue& parameter, std::string* value) {
  return Assign(parameter, XmlRpcValue::TypeString, value);
}

std::string DescribeMismatch(const XmlRpcValue& parameter, const char* expected) {
  std::ostringstream text;
  text << "must be " << expected << ", but is ";
  parameter.write(text);
  text << " (" << NameOfType(parameter) << ')';
  return text.str();
}

std::vector<std::string> WithParameterNames(std::vector<std::string> problems) {
  for (std::string& problem : problems) {
    const auto end_of_name = std::find(problem.begin(), problem.end(), ' ');
    std::replace(problem.begin(), end_of_name, '.', '/');
  }
  return problems;
}

void OptionReader::RefuseUnknown() {
  for (const auto& member : tree_) {
    if (known_.count(member.first) != 0) continue;
    std::string message = prefix_ + member.first + " is unknown; there are";
    for (const std::string& name : known_) message += ' ' + name;
    problems_->push_back(message);
  }
}

}  // namespace plumb::ros_adapter
