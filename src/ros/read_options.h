// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>
#include <ros/param.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "plumbline/common/options.h"

namespace plumb::ros_adapter {

// Sets `value` from a parameter of the same type; a double takes an integer too. Nothing is
// rounded: roscpp's own typed reader turns 30.7 into 31. False if the type is wrong.
bool AssignParameter(const XmlRpc::XmlRpcValue& parameter, double* value);
bool AssignParameter(const XmlRpc::XmlRpcValue& parameter, int* value);
bool AssignParameter(const XmlRpc::XmlRpcValue& parameter, bool* value);
bool AssignParameter(const XmlRpc::XmlRpcValue& parameter, std::string* value);

// "must be an integer, but is 30.7 (a double)" and the like.
std::string DescribeMismatch(const XmlRpc::XmlRpcValue& parameter, const char* expected);

constexpr const char* TypeName(double) { return "a number"; }
constexpr const char* TypeName(int) { return "an integer"; }
constexpr const char* TypeName(bool) { return "true or false"; }
inline const char* TypeName(const std::string&) { return "a text"; }

// A visitor that fills the fields of an options struct from a parameter tree. Fields that
// are structs have a tree of their own. What is wrong is collected in `problems`, each
// naming the parameter with `prefix`.
class OptionReader {
 public:
  OptionReader(const XmlRpc::XmlRpcValue& tree,
               std::string prefix,
               std::vector<std::string>* problems)
      : tree_(tree), prefix_(std::move(prefix)), problems_(problems) {}

  template <typename Field>
  void operator()(const char* name, Field& field) {
    known_.insert(name);
    if (!tree_.hasMember(name)) return;
    const XmlRpc::XmlRpcValue& parameter = tree_[name];
    if constexpr (std::is_class_v<Field> && !std::is_same_v<Field, std::string>) {
      if (parameter.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
        problems_->push_back(prefix_ + name + ' ' + DescribeMismatch(parameter, "a group"));
        return;
      }
      OptionReader reader(parameter, prefix_ + name + '/', problems_);
      VisitFields(field, reader);
      reader.RefuseUnknown();
    } else if (!AssignParameter(parameter, &field)) {
      problems_->push_back(prefix_ + name + ' ' + DescribeMismatch(parameter, TypeName(field)));
    }
  }

  // Reports the parameters of the tree that no field was visited for.
  void RefuseUnknown();

 private:
  XmlRpc::XmlRpcValue tree_;
  std::string prefix_;
  std::vector<std::string>* problems_;
  std::set<std::string> known_;
};

// Problems as options structs tell them, "gaps.min_views must be ...", with the names that ROS has
// for nested parameters, "gaps/min_views".
std::vector<std::string> WithParameterNames(std::vector<std::string> problems);

// The options as the parameters in the namespace of `handle` set them, defaults where none
// are. Throws std::invalid_argument naming each parameter that is unknown, of the wrong type
// or out of bounds, with its value.
template <typename Options>
Options ReadOptions(const ros::NodeHandle& handle) {
  Options options;
  const std::string& name = handle.getNamespace();
  const std::string file = "config" + name.substr(name.rfind('/')) + ".yaml";
  std::vector<std::string> problems;
  XmlRpc::XmlRpcValue tree;
  if (ros::param::get(name, tree)) {
    OptionReader reader(tree, "", &problems);
    VisitFields(options, reader);
    reader.RefuseUnknown();
  }
  if (problems.empty()) problems = WithParameterNames(options.Problems());
  ThrowIfProblems("parameters of " + name + " (" + file + " or the file the launch was given)",
                  problems);
  return options;
}

}  // namespace plumb::ros_adapter
