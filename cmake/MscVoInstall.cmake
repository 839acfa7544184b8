# Installation for find_package(msc_vo COMPONENTS ...). Every library is a component with an export
# set of its own, so that a component requires only the packages that it links: the
# solver does not need OpenCV.
include(CMakePackageConfigHelpers)
include(MscVoInstallDocs)
set(MSC_VO_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/msc_vo)

# Sets `out` to the path from one folder of the installation to another one. Each is absolute or
# relative to the prefix.
function(msc_vo_installed_path out from to)
  foreach(folder from to)
    cmake_path(ABSOLUTE_PATH ${folder} BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} NORMALIZE)
  endforeach()
  file(RELATIVE_PATH path ${from} ${to})
  set(${out} ${path} PARENT_SCOPE)
endfunction()

# Lets a target that is installed to `destination` find shared libraries of msc_vo, wherever all are
# installed to.
function(msc_vo_find_libraries_from target destination)
  if(BUILD_SHARED_LIBS)
    msc_vo_installed_path(libraries ${destination} ${CMAKE_INSTALL_LIBDIR})
    set_target_properties(${target} PROPERTIES INSTALL_RPATH $ORIGIN/${libraries})
  endif()
endfunction()

# Sets `out` to the arguments of find_package() for the package of an external target.
function(msc_vo_package_of target out)
  if(target MATCHES "^opencv_(.*)$")
    set(package "OpenCV 4.5 COMPONENTS ${CMAKE_MATCH_1}")
  elseif(target STREQUAL "Eigen3::Eigen")
    set(package "Eigen3 3.4 NO_MODULE")
  elseif(target STREQUAL "Ceres::ceres")
    set(package "Ceres 2.1")
  elseif(target STREQUAL "SQLite::SQLite3")
    set(package SQLite3)
  elseif(target MATCHES "^([^:]+)::")
    set(package ${CMAKE_MATCH_1})
  else()
    set(package ${target})
  endif()
  set(${out} ${package} PARENT_SCOPE)
endfunction()

# Gives msc_vo_<component> its public name msc_vo::<component> and an export set, and records the
# components (lowest first) and packages that it needs.
function(msc_vo_export component)
  set(target msc_vo_${component})
  add_library(msc_vo::${component} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
  install(TARGETS ${target} EXPORT ${target} COMPONENT development)
  install(EXPORT ${target} NAMESPACE msc_vo:: DESTINATION ${MSC_VO_CMAKE_DIR}
          COMPONENT development)

  set(components)
  set(packages)
  foreach(dependency ${ARGN})
    if(dependency MATCHES "^msc_vo::(.*)$")
      get_property(below GLOBAL PROPERTY MSC_VO_COMPONENTS_OF_${CMAKE_MATCH_1})
      if(NOT below)
        message(FATAL_ERROR "${dependency} is not below ${component} in msc_vo/CMakeLists.txt")
      endif()
      list(APPEND components ${below})
    else()
      msc_vo_package_of(${dependency} package)
      list(APPEND packages ${package})
    endif()
  endforeach()
  list(APPEND components ${component})
  list(REMOVE_DUPLICATES components)
  set_property(GLOBAL APPEND PROPERTY MSC_VO_COMPONENTS ${component})
  set_property(GLOBAL PROPERTY MSC_VO_COMPONENTS_OF_${component} ${components})
  set_property(GLOBAL PROPERTY MSC_VO_PACKAGES_OF_${component} ${packages})
endfunction()

# Installs the headers and the package files. Call once, after all libraries are declared.
function(msc_vo_install)
  msc_vo_include_closure(headers "${MSC_VO_PUBLIC_HEADERS}")
  foreach(header ${headers})
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${header}
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT development)
  endforeach()
  install(FILES ${PROJECT_BINARY_DIR}/include/msc_vo/version.h
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/msc_vo COMPONENT development)
  if(PROJECT_IS_TOP_LEVEL)
    msc_vo_install_documents()  # in a folder that has the name of the whole project
  endif()

  get_property(all GLOBAL PROPERTY MSC_VO_COMPONENTS)
  set(MSC_VO_COMPONENT_TABLE "set(msc_vo_all_components ${all})\n")
  foreach(component ${all})
    get_property(components GLOBAL PROPERTY MSC_VO_COMPONENTS_OF_${component})
    get_property(packages GLOBAL PROPERTY MSC_VO_PACKAGES_OF_${component})
    get_property(libraries GLOBAL PROPERTY MSC_VO_LIBRARIES_OF_${component})
    string(APPEND MSC_VO_COMPONENT_TABLE
           "set(msc_vo_components_of_${component} \"${components}\")\n"
           "set(msc_vo_packages_of_${component} \"${packages}\")\n"
           "set(msc_vo_libraries_of_${component} \"${libraries}\")\n")
  endforeach()
  configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/cmake/msc_voConfig.cmake.in ${PROJECT_BINARY_DIR}/msc_voConfig.cmake
    INSTALL_DESTINATION ${MSC_VO_CMAKE_DIR} NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(
    ${PROJECT_BINARY_DIR}/msc_voConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/msc_voConfig.cmake
                ${PROJECT_BINARY_DIR}/msc_voConfigVersion.cmake
          DESTINATION ${MSC_VO_CMAKE_DIR} COMPONENT development)
  msc_vo_pkg_config(solver "Local bundle adjustment with points, lines and structure")
  msc_vo_pkg_config(odometry "RGB-D visual odometry from points, lines and structure")
endfunction()

# Writes msc_vo-<component>.pc for those who build without CMake.
function(msc_vo_pkg_config component description)
  get_property(components GLOBAL PROPERTY MSC_VO_COMPONENTS_OF_${component})
  set(libraries)
  set(packages)
  foreach(below ${components})
    get_target_property(type msc_vo_${below} TYPE)
    if(type STREQUAL STATIC_LIBRARY OR type STREQUAL SHARED_LIBRARY)
      list(PREPEND libraries -lmsc_vo_${below})  # the linker resolves from left to right
    endif()
    get_property(below_packages GLOBAL PROPERTY MSC_VO_PACKAGES_OF_${below})
    list(APPEND packages ${below_packages})
  endforeach()
  # Ceres has no file for pkg-config on Debian; the others are known by these names.
  set(requires eigen3)
  set(others)
  foreach(package ${packages})
    if(package MATCHES "^OpenCV")
      list(APPEND requires opencv4)
    elseif(package MATCHES "^spdlog")
      list(APPEND requires spdlog)
    elseif(package MATCHES "^Ceres")
      list(APPEND others -lceres -lglog)
    elseif(package MATCHES "^Threads")
      list(APPEND others -pthread)
    endif()
  endforeach()
  list(REMOVE_DUPLICATES requires)
  list(REMOVE_DUPLICATES others)
  list(JOIN requires ", " PC_REQUIRES)
  list(JOIN libraries " " PC_LIBRARIES)
  list(JOIN others " " PC_OTHERS)
  # From the file itself, so that the installation may be moved as a whole.
  set(file_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  msc_vo_installed_path(PC_INCLUDES ${file_folder} ${CMAKE_INSTALL_INCLUDEDIR})
  msc_vo_installed_path(PC_LIBRARY_FOLDER ${file_folder} ${CMAKE_INSTALL_LIBDIR})
  set(PC_OPTIONS "")
  if(MSC_VO_NATIVE)
    set(PC_OPTIONS " -march=native")
  endif()
  set(PC_COMPONENT ${component})
  set(PC_DESCRIPTION ${description})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/msc_vo.pc.in
                 ${PROJECT_BINARY_DIR}/msc_vo-${component}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/msc_vo-${component}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()
