# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# The ROS side: messages, src/ros as plumb_ros, one executable for each of src/nodes, rostests.
set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "")
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "")
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR AND NOT DEFINED CATKIN_DEVEL_PREFIX)
  set(CATKIN_DEVEL_PREFIX ${PROJECT_SOURCE_DIR}/devel CACHE PATH "")
endif()
# Python rostests fail on the first build without it.
file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages)

find_package(catkin REQUIRED COMPONENTS cv_bridge diagnostic_msgs
             diagnostic_updater geometry_msgs message_generation nav_msgs rosbag_storage roscpp sensor_msgs std_msgs std_srvs tf2_ros visualization_msgs)

add_message_files(FILES LandmarkStates.msg MapDelta.msg MarkerDetection.msg
                  MarkerDetectionArray.msg ObservationStates.msg Photo.msg PhotoVerdict.msg
                  StoredPhotos.msg ViewState.msg)
add_service_files(FILES GetMap.srv)
add_message_files(FILES CalibrationProgress.msg CoverageBar.msg)
# The mesh and its quality.
add_message_files(FILES Gap.msg Gaps.msg MeshBlock.msg MeshDelta.msg)
add_service_files(FILES GetMesh.srv SetMeshDisplay.srv)
add_message_files(FILES ControlPoint.msg ControlPoints.msg Georeference.msg GeoreferenceFinding.msg
                  PhotoPositions.msg SearchedPhotos.msg TargetResidual.msg)
add_service_files(FILES GetMarkerDetections.srv LoadSurvey.srv)
generate_messages(DEPENDENCIES geometry_msgs sensor_msgs std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime geometry_msgs sensor_msgs std_msgs)

file(GLOB ros_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/ros/*.cc)
add_library(plumb_ros STATIC ${ros_sources})
add_dependencies(plumb_ros ${PROJECT_NAME}_generate_messages_cpp)
target_include_directories(plumb_ros PUBLIC ${PROJECT_SOURCE_DIR}/src)
target_include_directories(plumb_ros SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/include
                           ${catkin_INCLUDE_DIRS})
target_link_libraries(plumb_ros PUBLIC plumb_export plumb_georeference ${catkin_LIBRARIES}
                      PRIVATE plumb_warnings)
target_link_libraries(plumb_ros PUBLIC plumb_quality)

# The calibrator takes images of either kind from one topic.
find_package(topic_tools REQUIRED)
target_include_directories(plumb_ros SYSTEM PUBLIC ${topic_tools_INCLUDE_DIRS})
target_link_libraries(plumb_ros PUBLIC plumb_calibration ${topic_tools_LIBRARIES})

# src/nodes/<name>_node.cc becomes `rosrun plumbline <name>`.
file(GLOB node_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/nodes/*_node.cc)
set(programs)
foreach(source ${node_sources})
  get_filename_component(stem ${source} NAME_WE)
  string(REGEX REPLACE "_node$" "" name ${stem})
  add_executable(${stem} ${source})
  set_target_properties(${stem} PROPERTIES OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY
                        ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  target_link_libraries(${stem} PRIVATE plumb_ros plumb_warnings)
  list(APPEND programs ${stem})
endforeach()

# The calibrator's window, of Qt.
find_package(Qt5 REQUIRED COMPONENTS Widgets)
file(GLOB window_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/ros/calibrator_window/*.cc)
add_library(plumb_calibrator_window STATIC ${window_sources})
target_compile_definitions(plumb_calibrator_window PUBLIC QT_NO_KEYWORDS)
target_link_libraries(plumb_calibrator_window PUBLIC plumb_ros Qt5::Widgets PRIVATE plumb_warnings)
target_link_libraries(calibrator_node PRIVATE plumb_calibrator_window)

if(TARGET plumbline_tool)
  set_target_properties(plumbline_tool PROPERTIES RUNTIME_OUTPUT_DIRECTORY
                        ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  target_compile_definitions(plumbline_tool PRIVATE PLUMBLINE_WITH_ROS)
  target_link_libraries(plumbline_tool PRIVATE plumb_ros)  # `plumbline simulate` writes a bag.
  list(APPEND programs plumbline_tool)
endif()

# The RViz panel, a plugin.
find_package(rviz REQUIRED)
find_package(Qt5 REQUIRED COMPONENTS Test Widgets)
file(GLOB panel_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/rviz/*.cc)
qt5_wrap_cpp(panel_moc ${PROJECT_SOURCE_DIR}/src/rviz/flight_panel.h)
set_source_files_properties(${panel_moc} PROPERTIES COMPILE_OPTIONS -w)
add_library(plumbline_rviz SHARED ${panel_sources} ${panel_moc})
add_dependencies(plumbline_rviz ${PROJECT_NAME}_generate_messages_cpp)
set_target_properties(plumbline_rviz PROPERTIES LIBRARY_OUTPUT_DIRECTORY
                      ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION})
target_compile_definitions(plumbline_rviz PUBLIC QT_NO_KEYWORDS)
target_include_directories(plumbline_rviz PUBLIC ${PROJECT_SOURCE_DIR}/src)
target_include_directories(plumbline_rviz SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/include
                           ${catkin_INCLUDE_DIRS} ${rviz_INCLUDE_DIRS})
target_link_libraries(plumbline_rviz PUBLIC Qt5::Widgets ${rviz_LIBRARIES} ${catkin_LIBRARIES}
                      PRIVATE plumb_warnings)
install(TARGETS plumbline_rviz LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
install(FILES rviz_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

install(TARGETS ${programs} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(PROGRAMS scripts/fly_photos.py scripts/keep_running.sh
        scripts/play_bag.py scripts/record_flight.sh
        DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY config launch rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

# What docs/parameters.md is made of.
add_executable(list_parameters ${PROJECT_SOURCE_DIR}/src/ros/tools/list_parameters.cc)
set_target_properties(list_parameters PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
target_link_libraries(list_parameters PRIVATE plumb_ros plumb_warnings)
add_test(NAME parameters_page_is_current
         COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/scripts/parameters_doc.py --check
                 $<TARGET_FILE:list_parameters>)

# Of scripts/; none needs a ROS master.
file(GLOB script_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/scripts/*_test.py)
foreach(script_test ${script_tests})
  get_filename_component(name ${script_test} NAME_WE)
  add_test(NAME ${name} COMMAND /usr/bin/python3 ${script_test})
endforeach()

# Failures of these fail ctest; they are built by the target `tests`.
if(CATKIN_ENABLE_TESTING)
  find_package(rostest REQUIRED)
  file(GLOB ros_test_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/ros/*_test.cc)
  if(ros_test_sources)
    add_executable(ros_test EXCLUDE_FROM_ALL ${ros_test_sources})
    add_dependencies(tests ros_test)
    set_target_properties(ros_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
    target_include_directories(ros_test PRIVATE ${PROJECT_SOURCE_DIR})
    target_compile_definitions(ros_test PRIVATE PLUMBLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    target_link_libraries(ros_test PRIVATE plumb_ros GTest::gmock GTest::gtest_main plumb_warnings)
    add_test(NAME ros_test COMMAND ros_test)
  endif()

  # The calibrator's window, drawn into memory.
  find_package(Qt5 REQUIRED COMPONENTS Test)
  file(GLOB window_test_sources CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/test/ros/calibrator_window/*.cc)
  add_executable(calibrator_window_test EXCLUDE_FROM_ALL ${window_test_sources})
  add_dependencies(tests calibrator_window_test)
  set_target_properties(calibrator_window_test PROPERTIES
                        RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  target_include_directories(calibrator_window_test PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(calibrator_window_test PRIVATE plumb_calibrator_window Qt5::Test
                        GTest::gmock GTest::gtest plumb_warnings)
  add_test(NAME calibrator_window_test COMMAND calibrator_window_test)

  # Photos for calibrate.test.
  add_executable(make_calibration_photos EXCLUDE_FROM_ALL
                 ${PROJECT_SOURCE_DIR}/test/ros/make_calibration_photos.cc)
  add_dependencies(tests make_calibration_photos)
  set_target_properties(make_calibration_photos PROPERTIES RUNTIME_OUTPUT_DIRECTORY
                        ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  target_include_directories(make_calibration_photos PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(make_calibration_photos PRIVATE plumb_marker plumb_warnings
                        opencv_imgcodecs)

  # The panel, driven in an RViz of its own on a virtual display.
  add_rostest_gtest(panel_test test/rviz/panel.test test/rviz/panel_test.cc)
  target_include_directories(panel_test PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(panel_test PRIVATE PLUMBLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(panel_test plumbline_rviz Qt5::Test GTest::gmock plumb_warnings)

  file(GLOB rostests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/ros/*.test)
  foreach(rostest ${rostests})
    add_rostest(${rostest} DEPENDENCIES ${programs})
  endforeach()

  # Each starts a ROS graph, with time limits of its own: nothing runs beside it.
  get_property(registered DIRECTORY PROPERTY TESTS)
  list(FILTER registered INCLUDE REGEX "rostest")
  set_tests_properties(${registered} PROPERTIES RUN_SERIAL TRUE)
endif()
