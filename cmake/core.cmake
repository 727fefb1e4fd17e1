# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# The core library: free of ROS, one static library a module, each linked only to
# modules above it in docs/architecture.md.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(OpenCV REQUIRED COMPONENTS core imgcodecs imgproc features2d calib3d)
find_package(Ceres REQUIRED)
find_package(CGAL REQUIRED)
find_path(NANOFLANN_INCLUDE_DIR nanoflann.hpp REQUIRED)
find_package(Threads REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(embree 3 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo-pdf cairo-svg)
pkg_check_modules(SQLITE3 REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(EXIV2 REQUIRED IMPORTED_TARGET exiv2)
pkg_check_modules(LIBJPEG REQUIRED IMPORTED_TARGET libjpeg)
pkg_check_modules(PROJ REQUIRED IMPORTED_TARGET proj)
pkg_check_modules(MAXFLOW REQUIRED IMPORTED_TARGET maxflow)  # Only tests and benchmarks.

add_library(plumb_warnings INTERFACE)
target_compile_options(plumb_warnings INTERFACE -Wall -Wextra -Wconversion)
if(NOT PLUMBLINE_SANITIZE)  # GCC's flow warnings are wrong in instrumented code (its manual says so).
  target_compile_options(plumb_warnings INTERFACE -Werror)
endif()

# plumb_module(<name> <libraries…>): src/<name>/*.cc as plumb_<name>.
function(plumb_module name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cc)
  if(sources)
    add_library(plumb_${name} STATIC ${sources})
    target_include_directories(plumb_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include
                               PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(plumb_${name} PUBLIC ${ARGN} PRIVATE plumb_warnings)
  else()
    add_library(plumb_${name} INTERFACE)
    target_include_directories(plumb_${name} INTERFACE ${PROJECT_SOURCE_DIR}/include)
    target_link_libraries(plumb_${name} INTERFACE ${ARGN})
  endif()
endfunction()

plumb_module(common Threads::Threads)
plumb_module(geometry plumb_common Eigen3::Eigen opencv_calib3d)
plumb_module(camera plumb_geometry yaml-cpp)
plumb_module(image plumb_camera opencv_core opencv_imgproc opencv_imgcodecs opencv_features2d
             PkgConfig::LIBJPEG PkgConfig::EXIV2 ZLIB::ZLIB)
plumb_module(marker plumb_image PkgConfig::CAIRO)
plumb_module(calibration plumb_marker Ceres::ceres nlohmann_json::nlohmann_json PkgConfig::CAIRO)
plumb_module(map plumb_image PkgConfig::SQLITE3 nlohmann_json::nlohmann_json)
plumb_module(matching plumb_map opencv_core)
plumb_module(sfm plumb_matching Ceres::ceres)
plumb_module(surface plumb_map)
target_link_libraries(plumb_surface PRIVATE CGAL::CGAL)
plumb_module(quality plumb_surface opencv_imgproc embree)
# Its loops become vector code, with the same bits on all processors.
set_source_files_properties(src/quality/sight_kernel.cc PROPERTIES COMPILE_OPTIONS
                            "-ffp-contract=off;-fno-math-errno;-fno-trapping-math")
plumb_module(georeference plumb_sfm plumb_marker PkgConfig::PROJ)
plumb_module(simulation plumb_marker embree PkgConfig::PROJ)
# A vectorised square root sets no errno.
set_source_files_properties(src/simulation/develop.cc PROPERTIES COMPILE_OPTIONS -fno-math-errno)
# All processors shall render the same bits: nothing is contracted to fused operations.
file(GLOB shade_kernels CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/simulation/shade_kernel*.cc)
set_source_files_properties(${shade_kernels} PROPERTIES COMPILE_OPTIONS -ffp-contract=off)
plumb_module(export plumb_sfm plumb_surface)
plumb_module(evaluation plumb_export embree)
target_link_libraries(plumb_evaluation PRIVATE CGAL::CGAL)
target_include_directories(plumb_evaluation SYSTEM PRIVATE ${NANOFLANN_INCLUDE_DIR})

# The command-line program; all but its main is a library, so that it can be tested.
plumb_module(tools plumb_evaluation plumb_calibration plumb_georeference plumb_simulation yaml-cpp
             CLI11::CLI11)
target_compile_definitions(plumb_tools PRIVATE
                           PLUMBLINE_SCENARIOS="${PROJECT_SOURCE_DIR}/config/scenarios")
file(STRINGS ${PROJECT_SOURCE_DIR}/package.xml version_line REGEX "<version>")
string(REGEX REPLACE ".*<version>(.*)</version>.*" "\\1" PLUMBLINE_VERSION "${version_line}")
add_executable(plumbline_tool ${PROJECT_SOURCE_DIR}/src/nodes/plumbline_main.cc)
set_target_properties(plumbline_tool PROPERTIES OUTPUT_NAME plumbline)
target_include_directories(plumbline_tool PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_compile_definitions(plumbline_tool PRIVATE PLUMBLINE_VERSION="${PLUMBLINE_VERSION}")
target_link_libraries(plumbline_tool PRIVATE plumb_tools plumb_warnings)

# One test program a module: test/<name>/*_test.cc as <name>_test. The target `tests`, to which
# catkin adds its own, builds them.
find_package(GTest REQUIRED)
enable_testing()
add_custom_target(tests)
function(plumb_module_test name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/${name}/*.cc)
  if(NOT sources)
    return()
  endif()
  add_executable(${name}_test EXCLUDE_FROM_ALL ${sources})
  add_dependencies(tests ${name}_test)
  target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name}_test PRIVATE PLUMBLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name}_test PRIVATE ${ARGN} GTest::gmock GTest::gtest_main plumb_warnings)
  add_test(NAME ${name}_test COMMAND ${name}_test)
  if(PLUMBLINE_SANITIZE)
    set_property(TEST ${name}_test PROPERTY ENVIRONMENT
                 LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/test/sanitizer_suppressions.txt)
  endif()
endfunction()
foreach(module common geometry camera image marker calibration map matching sfm surface georeference
               simulation export evaluation tools)
  plumb_module_test(${module} plumb_${module} plumb_camera)  # test/support makes scenes.
endforeach()
set_tests_properties(tools_test PROPERTIES COST 100)  # The longest: first of those at once.
plumb_module_test(quality plumb_quality plumb_simulation)  # Whose facades are true meshes.
target_link_libraries(surface_test PRIVATE CGAL::CGAL PkgConfig::MAXFLOW)

# Timing programs: test/benchmark/*_benchmark.cc as <name>_benchmark. `benchmarks` builds them.
add_custom_target(benchmarks)
find_package(benchmark QUIET)
find_package(OpenCV QUIET OPTIONAL_COMPONENTS aruco)
pkg_check_modules(APRILTAG QUIET IMPORTED_TARGET apriltag)
if(benchmark_FOUND AND APRILTAG_FOUND AND TARGET opencv_aruco)
  file(GLOB benchmark_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/benchmark/*_benchmark.cc)
  foreach(source ${benchmark_sources})
    get_filename_component(name ${source} NAME_WE)
    add_executable(${name} EXCLUDE_FROM_ALL ${source})
    add_dependencies(benchmarks ${name})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src)
    target_compile_definitions(${name} PRIVATE PLUMBLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    target_link_libraries(${name} PRIVATE plumb_evaluation plumb_simulation benchmark::benchmark)
  endforeach()
  # The surface is held against a solve from nothing.
  target_link_libraries(surface_benchmark PRIVATE plumb_surface CGAL::CGAL PkgConfig::MAXFLOW
                        GTest::gtest nlohmann_json::nlohmann_json)
  target_link_libraries(quality_benchmark PRIVATE plumb_quality nlohmann_json::nlohmann_json)
  # The marker detector is measured beside two others.
  target_link_libraries(marker_benchmark PRIVATE plumb_marker opencv_aruco PkgConfig::APRILTAG
                        nlohmann_json::nlohmann_json)
  target_link_libraries(georeference_benchmark PRIVATE plumb_georeference)
  target_link_libraries(colmap_matches_benchmark PRIVATE plumb_map plumb_matching)
  # The calibration beside OpenCV's.
  target_link_libraries(calibration_benchmark PRIVATE plumb_calibration
                        nlohmann_json::nlohmann_json)
endif()
