// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "common/yaml_hint.h"
#include "plumbline/camera/camera.h"

namespace plumb {
namespace {

constexpr const char* kPlumbBobName = "plumb_bob";
constexpr const char* kRationalName = "rational_polynomial";

// One camera_info file; knows its name so that every error names it.
class CameraInfo {
 public:
  CameraInfo(const YAML::Node& root, const std::string& source) : root_(root), source_(source) {
    if (!root_.IsMap()) {
      Fail("is not a camera_info YAML (expected lines such as \"image_width: 4000\")");
    }
  }

  [[noreturn]] void Fail(const std::string& what) const {
    throw std::runtime_error(source_ + ": " + what);
  }

  YAML::Node Require(const char* field, const char* cure) const {
    const YAML::Node node = root_[field];
    if (!node || node.IsNull()) Fail(std::string(field) + " is missing; " + cure);
    return node;
  }

  int PositiveInt(const char* field) const {
    const YAML::Node node = Require(field, "add the size of the photos in pixels");
    int value = 0;
    if (!node.IsScalar() || !YAML::convert<int>::decode(node, value) || value <= 0) {
      Fail(std::string(field) + " must be a positive whole number of pixels, but is " + Text(node));
    }
    return value;
  }

  std::string String(const char* field, const char* cure) const {
    const YAML::Node node = Require(field, cure);
    if (!node.IsScalar()) Fail(std::string(field) + " must be a word, but is " + Text(node));
    return node.Scalar();
  }

  // The `data` of a {rows, cols, data} matrix, row by row.
  std::vector<double> Matrix(const char* field, const char* cure) const {
    const YAML::Node node = Require(field, cure);
    const YAML::Node data = node.IsMap() ? YAML::Node(node["data"]) : YAML::Node();
    if (!data || !data.IsSequence()) {
      Fail(std::string(field) + " must have rows, cols and a list named data, but is " +
           Text(node));
    }
    std::vector<double> values;
    for (const YAML::Node& entry : data) {
      double value = 0.0;
      if (!entry.IsScalar() || !YAML::convert<double>::decode(entry, value)) {
        Fail(std::string(field) + ": data[" + std::to_string(values.size()) +
             "] must be a number, but is " + Text(entry));
      }
      values.push_back(value);
    }
    CheckShape(field, node, values.size());
    return values;
  }

 private:
  static std::string Text(const YAML::Node& node) {
    if (node.IsScalar()) return '"' + node.Scalar() + '"';
    return node.IsMap() ? "a map" : node.IsSequence() ? "a list" : "empty";
  }

  void CheckShape(const char* field, const YAML::Node& node, std::size_t num_values) const {
    if (!node["rows"] && !node["cols"]) return;
    std::size_t rows = 0;
    std::size_t cols = 0;
    if (!node["rows"] || !node["cols"] || !YAML::convert<std::size_t>::decode(node["rows"], rows) ||
        !YAML::convert<std::size_t>::decode(node["cols"], cols) || rows * cols != num_values) {
      Fail(std::string(field) + ": rows times cols must equal the " + std::to_string(num_values) +
           " values of data");
    }
  }

  const YAML::Node root_;
  const std::string source_;
};

void ReadPinhole(const CameraInfo& info, LensParameters<double>* lens) {
  const std::vector<double> k =
      info.Matrix("camera_matrix", "add the calibration's 3 x 3 matrix [fx 0 cx; 0 fy cy; 0 0 1]");
  if (k.size() != 9) {
    info.Fail("camera_matrix must have 9 values, but has " + std::to_string(k.size()));
  }
  for (const int zero : {1, 3, 6, 7}) {
    if (k[zero] != 0.0) {
      info.Fail("camera_matrix must be [fx 0 cx; 0 fy cy; 0 0 1], but data[" +
                std::to_string(zero) + "] is not 0");
    }
  }
  if (k[8] != 1.0) info.Fail("camera_matrix must end with 1");
  (*lens)[kFx] = k[0];
  (*lens)[kFy] = k[4];
  (*lens)[kCx] = k[2];
  (*lens)[kCy] = k[5];
}

DistortionModel ReadModel(const CameraInfo& info) {
  const std::string name = info.String(
      "distortion_model", "add plumb_bob or rational_polynomial as the calibration says");
  if (name == kPlumbBobName) return DistortionModel::kPlumbBob;
  if (name == kRationalName) return DistortionModel::kRationalPolynomial;
  info.Fail("distortion_model \"" + name +
            "\" is not known; calibrate the camera with plumb_bob or rational_polynomial");
}

void ReadDistortion(const CameraInfo& info, DistortionModel model, LensParameters<double>* lens) {
  const std::vector<double> coefficients = info.Matrix(
      "distortion_coefficients", "add them, or five zeros if the photos are free of distortion");
  const bool is_plumb_bob = model == DistortionModel::kPlumbBob;
  const std::size_t count = coefficients.size();
  if (is_plumb_bob ? count != 4 && count != 5 : count != 8) {
    info.Fail(std::string("distortion_coefficients must have ") +
              (is_plumb_bob ? "4 or 5 values (k1 k2 p1 p2 [k3]) for plumb_bob"
                            : "8 values (k1 k2 p1 p2 k3 k4 k5 k6) for rational_polynomial") +
              ", but has " + std::to_string(count));
  }
  std::copy(coefficients.begin(), coefficients.end(), lens->begin() + kK1);
}

// The fewest digits that read back as the same number.
std::string Shortest(double value) {
  for (int precision = 6;; ++precision) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(precision);
    text << value;
    if (precision >= 17 || std::stod(text.str()) == value) return text.str();
  }
}

void EmitMatrix(const char* field,
                int rows,
                std::initializer_list<double> values,
                YAML::Emitter* out) {
  *out << YAML::Key << field << YAML::Value << YAML::BeginMap;
  *out << YAML::Key << "rows" << YAML::Value << rows;
  *out << YAML::Key << "cols" << YAML::Value << static_cast<int>(values.size()) / rows;
  *out << YAML::Key << "data" << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double value : values) *out << Shortest(value);
  *out << YAML::EndSeq << YAML::EndMap;
}

}  // namespace

Camera ParseCameraYaml(const std::string& text, const std::string& source) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(source + ": is not YAML: " + error.what() + TabulatorHint(text));
  }
  const CameraInfo info(root, source);
  const int width_px = info.PositiveInt("image_width");
  const int height_px = info.PositiveInt("image_height");
  LensParameters<double> lens = {};
  ReadPinhole(info, &lens);
  const DistortionModel model = ReadModel(info);
  ReadDistortion(info, model, &lens);
  const std::string name =
      root["camera_name"] ? info.String("camera_name", "name the camera") : "camera";
  try {
    return Camera(name, width_px, height_px, model, lens);
  } catch (const std::invalid_argument& error) {
    info.Fail(std::string(error.what()) + "; calibrate the camera again or correct the file");
  }
}

Camera ReadCameraYaml(const std::string& path) {
  std::error_code status_error;
  if (std::filesystem::is_directory(path, status_error)) {
    throw std::runtime_error(path + ": is a folder; name the camera_info YAML file in it");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  }
  std::ostringstream text;
  text << file.rdbuf();
  return ParseCameraYaml(text.str(), path);
}

std::string ToCameraYaml(const Camera& camera) {
  const LensParameters<double>& l = camera.lens();
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "image_width" << YAML::Value << camera.width_px();
  out << YAML::Key << "image_height" << YAML::Value << camera.height_px();
  out << YAML::Key << "camera_name" << YAML::Value << camera.name();
  EmitMatrix("camera_matrix", 3, {l[kFx], 0, l[kCx], 0, l[kFy], l[kCy], 0, 0, 1}, &out);
  const bool is_plumb_bob = camera.model() == DistortionModel::kPlumbBob;
  out << YAML::Key << "distortion_model" << YAML::Value
      << (is_plumb_bob ? kPlumbBobName : kRationalName);
  if (is_plumb_bob) {
    EmitMatrix("distortion_coefficients", 1, {l[kK1], l[kK2], l[kP1], l[kP2], l[kK3]}, &out);
  } else {
    EmitMatrix("distortion_coefficients",
               1,
               {l[kK1], l[kK2], l[kP1], l[kP2], l[kK3], l[kK4], l[kK5], l[kK6]},
               &out);
  }
  EmitMatrix("rectification_matrix", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}, &out);
  EmitMatrix(
      "projection_matrix", 3, {l[kFx], 0, l[kCx], 0, 0, l[kFy], l[kCy], 0, 0, 0, 1, 0}, &out);
  out << YAML::EndMap;
  return std::string(out.c_str()) + '\n';
}

}  // namespace plumb
