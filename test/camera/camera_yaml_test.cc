// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "plumbline/camera/camera.h"

namespace plumb {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kGood = R"(image_width: 4000
image_height: 3000
camera_name: mav
camera_matrix:
  rows: 3
  cols: 3
  data: [2500.5, 0, 1999.5, 0, 2501.25, 1499.5, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.1, 0.02, 0.001, -0.002, 0.003]
)";

// kGood with one piece of text replaced.
std::string Replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the template: " + from);
  return text.replace(at, from.size(), to);
}

std::string ErrorOf(const std::string& text) {
  try {
    ParseCameraYaml(text, "lens.yaml");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseCameraYaml, ReadsWhatCameraCalibrationWrites) {
  const Camera camera = ParseCameraYaml(kGood, "lens.yaml");
  EXPECT_EQ(camera.name(), "mav");
  EXPECT_EQ(camera.width_px(), 4000);
  EXPECT_EQ(camera.height_px(), 3000);
  EXPECT_EQ(camera.model(), DistortionModel::kPlumbBob);
  const LensParameters<double> expected = {
      2500.5, 2501.25, 1999.5, 1499.5, -0.1, 0.02, 0.001, -0.002, 0.003, 0.0, 0.0, 0.0};
  EXPECT_EQ(camera.lens(), expected);
}

TEST(ParseCameraYaml, ReadsBlockLists) {
  const std::string text = Replaced("[2500.5, 0, 1999.5, 0, 2501.25, 1499.5, 0, 0, 1]",
                                    "\n  - 2500.5\n  - 0\n  - 1999.5\n  - 0\n  - 2501.25\n"
                                    "  - 1499.5\n  - 0\n  - 0\n  - 1");
  EXPECT_EQ(ParseCameraYaml(text, "lens.yaml").lens(), ParseCameraYaml(kGood, "lens.yaml").lens());
}

TEST(ParseCameraYaml, ReadsFourCoefficientsAsNoK3) {
  const std::string text = Replaced("cols: 5\n  data: [-0.1, 0.02, 0.001, -0.002, 0.003]",
                                    "cols: 4\n  data: [-0.1, 0.02, 0.001, -0.002]");
  const Camera camera = ParseCameraYaml(text, "lens.yaml");
  EXPECT_EQ(camera.lens()[kP2], -0.002);
  EXPECT_EQ(camera.lens()[kK3], 0.0);
}

TEST(ParseCameraYaml, ReadsTheRationalModel) {
  std::string text = Replaced("plumb_bob", "rational_polynomial");
  text = text.substr(0, text.find("  cols: 5")) +
         "  cols: 8\n  data: [4.1, 2.3, 0.0001, -0.0002, 0.09, 4.5, 3.6, 0.55]\n";
  const Camera camera = ParseCameraYaml(text, "lens.yaml");
  EXPECT_EQ(camera.model(), DistortionModel::kRationalPolynomial);
  EXPECT_EQ(camera.lens()[kK3], 0.09);
  EXPECT_EQ(camera.lens()[kK6], 0.55);
}

TEST(ToCameraYaml, IsReadBackExactly) {
  const LensParameters<double> lens = {1.0 / 3e-3,
                                       999.8749999999999,
                                       600.1,
                                       449.9,
                                       -1e-5 / 3.0,
                                       0.1 + 0.2,
                                       -1e-17,
                                       2.0 / 7.0 * 1e-4,
                                       1e-3,
                                       0.01 / 3.0,
                                       0.002,
                                       0.003};
  const Camera rational("two words: #1", 1200, 900, DistortionModel::kRationalPolynomial, lens);
  LensParameters<double> bob_lens = lens;
  bob_lens[kK4] = bob_lens[kK5] = bob_lens[kK6] = 0.0;
  const Camera plumb_bob("12", 1200, 900, DistortionModel::kPlumbBob, bob_lens);
  for (const Camera& camera : {rational, plumb_bob}) {
    const Camera back = ParseCameraYaml(ToCameraYaml(camera), "written");
    EXPECT_EQ(back.name(), camera.name());
    EXPECT_EQ(back.width_px(), camera.width_px());
    EXPECT_EQ(back.height_px(), camera.height_px());
    EXPECT_EQ(back.model(), camera.model());
    EXPECT_EQ(back.lens(), camera.lens());
  }
}

TEST(ParseCameraYaml, NamesFileFieldAndCureOfWhatIsMissing) {
  EXPECT_THAT(ErrorOf(Replaced("image_width: 4000\n", "")),
              AllOf(HasSubstr("lens.yaml"), HasSubstr("image_width is missing; add")));
  EXPECT_THAT(ErrorOf(Replaced("image_height: 3000", "image_height:")),
              HasSubstr("image_height is missing; add"));
  EXPECT_THAT(ErrorOf(Replaced("camera_matrix", "matrix")),
              AllOf(HasSubstr("lens.yaml"), HasSubstr("camera_matrix is missing; add")));
  EXPECT_THAT(ErrorOf(Replaced("distortion_model: plumb_bob\n", "")),
              HasSubstr("distortion_model is missing; add"));
  EXPECT_THAT(ErrorOf(Replaced("distortion_coefficients", "coefficients")),
              HasSubstr("distortion_coefficients is missing; add"));
}

TEST(ParseCameraYaml, NamesTheBadFocalLength) {
  EXPECT_THAT(ErrorOf(Replaced("2500.5", "-2500.5")),
              AllOf(HasSubstr("lens.yaml"), HasSubstr("focal length fx"), HasSubstr("-2500.5")));
  EXPECT_THAT(ErrorOf(Replaced("2501.25", "0")), HasSubstr("focal length fy must be positive"));
  EXPECT_THAT(ErrorOf(Replaced("2500.5", ".nan")), HasSubstr("fx must be a finite number"));
  EXPECT_THAT(ErrorOf(Replaced("2500.5", "wide")),
              AllOf(HasSubstr("camera_matrix"), HasSubstr("\"wide\"")));
}

TEST(ParseCameraYaml, NamesTheBadSize) {
  EXPECT_THAT(ErrorOf(Replaced("4000", "-4000")), HasSubstr("image_width must be a positive"));
  EXPECT_THAT(ErrorOf(Replaced("4000", "4000.5")), HasSubstr("image_width"));
  EXPECT_THAT(ErrorOf(Replaced("4000", "[4000]")), HasSubstr("image_width"));
}

TEST(ParseCameraYaml, RefusesAMatrixItWouldMisread) {
  EXPECT_THAT(ErrorOf(Replaced("[2500.5, 0,", "[2500.5, 1.5,")), HasSubstr("data[1] is not 0"));
  EXPECT_THAT(ErrorOf(Replaced(", 0, 0, 1]", ", 0, 0]")), HasSubstr("rows times cols"));
  EXPECT_THAT(ErrorOf(Replaced("0, 0, 1]", "0, 0, 2]")), HasSubstr("end with 1"));
  EXPECT_THAT(ErrorOf(Replaced("data: [-0.1", "values: [-0.1")), HasSubstr("named data"));
}

TEST(ParseCameraYaml, CountsTheCoefficients) {
  EXPECT_THAT(ErrorOf(Replaced("cols: 5\n  data: [-0.1,", "cols: 6\n  data: [0, -0.1,")),
              AllOf(HasSubstr("distortion_coefficients must have 4 or 5"), HasSubstr("has 6")));
  EXPECT_THAT(ErrorOf(Replaced("plumb_bob", "rational_polynomial")),
              AllOf(HasSubstr("distortion_coefficients must have 8"), HasSubstr("has 5")));
}

TEST(ParseCameraYaml, NamesAnUnknownModelAndTheKnownOnes) {
  EXPECT_THAT(ErrorOf(Replaced("plumb_bob", "equidistant")),
              AllOf(HasSubstr("lens.yaml"),
                    HasSubstr("distortion_model \"equidistant\""),
                    HasSubstr("rational_polynomial")));
}

TEST(ParseCameraYaml, RefusesALensThatFoldsTheImage) {
  EXPECT_THAT(ErrorOf(Replaced("[-0.1,", "[-3.0,")),
              AllOf(HasSubstr("lens.yaml"), HasSubstr("fold"), HasSubstr("calibrate")));
}

TEST(ParseCameraYaml, SaysWhenItIsNotACalibrationAtAll) {
  EXPECT_THAT(ErrorOf("a: [1, 2"), AllOf(HasSubstr("lens.yaml"), HasSubstr("not YAML")));
  EXPECT_THAT(ErrorOf(""), HasSubstr("not a camera_info YAML"));
  EXPECT_THAT(ErrorOf("just words"), HasSubstr("not a camera_info YAML"));
  EXPECT_THAT(ErrorOf("- 1\n- 2\n"), HasSubstr("not a camera_info YAML"));
  EXPECT_THAT(ErrorOf(std::string("\xff\xd8\xff\xe0\0\x10JFIF", 10)), HasSubstr("lens.yaml"));
}

std::string ReadErrorOf(const std::string& path) {
  try {
    ReadCameraYaml(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ReadCameraYaml, NamesAFileThatIsNotThere) {
  EXPECT_THAT(ReadErrorOf("/nowhere/lens.yaml"),
              AllOf(HasSubstr("/nowhere/lens.yaml"), HasSubstr("No such file")));
}

TEST(ReadCameraYaml, SaysThatAFolderIsNone) {
  const std::string folder = ::testing::TempDir();
  EXPECT_THAT(ReadErrorOf(folder), AllOf(HasSubstr(folder), HasSubstr("is a folder")));
}

TEST(ReadCameraYaml, ReadsAFile) {
  const std::string path = ::testing::TempDir() + "camera_yaml_test.yaml";
  std::ofstream(path) << kGood;
  EXPECT_EQ(ReadCameraYaml(path).lens(), ParseCameraYaml(kGood, "text").lens());
  std::filesystem::remove(path);
}

TEST(ReadCameraYaml, ReadsTheCamerasOfTheSharedScenes) {
  const char* variable = std::getenv("PLUMBLINE_DATA");
  const std::filesystem::path data =
      variable != nullptr ? variable : PLUMBLINE_SOURCE_DIR "/../shared/data";
  if (!std::filesystem::is_directory(data)) {
    GTEST_SKIP() << "no real data at " << data << "; set PLUMBLINE_DATA";
  }
  for (const char* scene : {"fountain-P11", "Herz-Jesus-P8", "sceaux", "south_building"}) {
    const Camera camera = ReadCameraYaml((data / scene / "camera.yaml").string());
    EXPECT_EQ(camera.name(), scene);
    EXPECT_GT(camera.MeanFocalLength(), 900.0);
  }
}

}  // namespace
}  // namespace plumb
