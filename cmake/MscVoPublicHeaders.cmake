# The headers that are installed: those that a user of msc_vo includes, and what these include in
# turn. Everything else is internal to the libraries.
set(MSC_VO_PUBLIC_HEADERS
  # The odometry
  msc_vo/odometry/odometry.h
  msc_vo/checkpoint/checkpoint_file.h
  msc_vo/odometry/localization.h
  msc_vo/odometry/localizer.h
  msc_vo/odometry/map_merge.h
  msc_vo/map_file/map_reader.h
  msc_vo/map_file/map_writer.h
  msc_vo/logging/logger.h
  msc_vo/config/options_file.h
  msc_vo/camera/undistorted_camera.h
  # Sequences and results
  msc_vo/datasets/accelerometer.h
  msc_vo/datasets/image_masks.h
  msc_vo/datasets/paced_source.h
  msc_vo/datasets/rgbd_source.h
  msc_vo/phone_recordings/folder_sequence.h
  msc_vo/diagnosis/sequence_check.h
  msc_vo/datasets/trajectory.h
  msc_vo/results/result_files.h
  msc_vo/results/run_report.h
  msc_vo/report/report.h
  # The solvers, and windows as files
  msc_vo/bundle_adjustment/custom_factor.h
  msc_vo/bundle_adjustment/local_bundle_adjustment.h
  msc_vo/bundle_adjustment/window_covariance.h
  msc_vo/bundle_adjustment/window_problem.h
  msc_vo/pose_estimation/pose_optimization.h
  msc_vo/recording/window_file.h
  # Other sensors
  msc_vo/inertial/gravity_factors.h
  msc_vo/inertial/vertical_measurement.h
  msc_vo/sensor/depth_registration.h
  # Structure of the scene
  msc_vo/structure/axes_refinement.h
  msc_vo/structure/axis_association.h
  msc_vo/structure/coarse_axes.h
  msc_vo/structure/frame_structure.h
  # Evaluation and synthetic data
  msc_vo/evaluation/line_error.h
  msc_vo/evaluation/trajectory_error.h
  msc_vo/synthetic/scene/synthetic_sequence.h
  msc_vo/synthetic/window/synthetic_window.h)
# The catalogue of factors.
file(GLOB factors RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
     ${PROJECT_SOURCE_DIR}/msc_vo/factors/*.h)
list(APPEND MSC_VO_PUBLIC_HEADERS ${factors})

# Sets `out` to `headers` and every header of msc_vo that they include, directly or not.
function(msc_vo_include_closure out headers)
  set(found)
  set(pending ${headers})
  while(pending)
    list(POP_FRONT pending header)
    if(header IN_LIST found OR NOT EXISTS ${PROJECT_SOURCE_DIR}/${header})  # generated: version.h
      continue()
    endif()
    list(APPEND found ${header})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
    file(STRINGS ${PROJECT_SOURCE_DIR}/${header} includes REGEX "^#include \"msc_vo/")
    foreach(include ${includes})
      string(REGEX REPLACE "^#include \"(msc_vo/[^\"]+)\".*" "\\1" include "${include}")
      list(APPEND pending ${include})
    endforeach()
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
endfunction()
