# Debian packages by CPack, one per component of the installation. cmake/make_packages.sh configures
# the build for them and runs CPack; docs/packages.md describes them.
# They contain static libraries, and their tools read what is installed on this machine.
if(NOT PROJECT_IS_TOP_LEVEL OR BUILD_SHARED_LIBS OR CMAKE_CROSSCOMPILING)
  return()
endif()
set(MSC_VO_PACKAGE_REVISION 1 CACHE STRING "Revision of the Debian packages")
set(MSC_VO_PACKAGE_MAINTAINER "The msc_vo authors <msc-vo@localhost.localdomain>" CACHE STRING
    "Name and mail address of who builds the Debian packages")
set(MSC_VO_PACKAGE_DATE "Thu, 01 Jan 2026 00:00:00 +0000" CACHE STRING
    "Date of the changelog of the Debian packages, as of date -R")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME msc-vo)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "The msc_vo authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_GROUPING IGNORE)  # every component is a package
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${MSC_VO_PACKAGE_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_RELEASE ${MSC_VO_PACKAGE_REVISION})
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# msc_vo_package(<component> <name> <section> <synopsis> <description>): one package. Every one has its
# copyright and changelog.
function(msc_vo_package component name section synopsis description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${synopsis}\n${description}" PARENT_SCOPE)
  set(components ${CPACK_COMPONENTS_ALL} ${component})
  set(CPACK_COMPONENTS_ALL ${components} PARENT_SCOPE)
  install(FILES ${PROJECT_BINARY_DIR}/packages/copyright
                ${PROJECT_BINARY_DIR}/packages/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
endfunction()

configure_file(cmake/debian/copyright packages/copyright COPYONLY)
configure_file(cmake/debian/changelog.in packages/changelog.Debian @ONLY)
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/packages/changelog.Debian
                RESULT_VARIABLE failed ERROR_QUIET)
# The image formats of OpenCV are loaded while a program runs, which dpkg-shlibdeps does not see.
find_library(opencv_codecs NAMES ${MSC_VO_OPENCV_CODECS} NO_CACHE)
file(REAL_PATH "${opencv_codecs}" opencv_codecs)
execute_process(COMMAND dpkg-query --search ${opencv_codecs} OUTPUT_VARIABLE codecs_package
                RESULT_VARIABLE unknown ERROR_QUIET)
string(REGEX REPLACE ":.*" "" codecs_package "${codecs_package}")
if(failed OR unknown)
  message(STATUS "Debian packages left out: gzip, dpkg-query or the package of OpenCV is missing")
  return()
endif()

set(about "msc_vo estimates the trajectory of an RGB-D camera from points, lines
and structural constraints (parallel and perpendicular lines, Manhattan
axes), repeatably and with a covariance for every pose.
")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # that of every package is the first line of its description
set(CPACK_COMPONENTS_ALL)
msc_vo_package(development libmsc-vo-dev libdevel "RGB-D visual odometry, development files" "${about}
This package contains the static libraries, the headers and the files for
CMake and pkg-config.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libceres-dev (>= 2.1), libdeflate-dev, libeigen3-dev, libopencv-dev (>= 4.5), libspdlog-dev, libsqlite3-dev, libturbojpeg0-dev, libyaml-cpp-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "${codecs_package}")
if(TARGET msc_vo_command)
  msc_vo_package(command msc-vo science "RGB-D visual odometry, command" "${about}
This package contains the command with its manual pages and documentation.")
endif()
if(TARGET msc_vo_fusion)
  msc_vo_package(fusion msc-vo-fusion science "RGB-D visual odometry, surface fusion" "${about}
This package contains the module of the command that fuses depth images
into coloured surfaces.")
  set(CPACK_DEBIAN_FUSION_PACKAGE_DEPENDS
      "msc-vo (= ${PROJECT_VERSION}-${MSC_VO_PACKAGE_REVISION})")
  set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS msc-vo-fusion)
endif()
if(TARGET msc_vo_python)
  msc_vo_package(python python3-msc-vo python "RGB-D visual odometry, Python module" "${about}
This package contains the module msc_vo for Python 3.")
  execute_process(COMMAND ${MSC_VO_PYTHON_INTERPRETER} -c
                  "import sys; v = sys.version_info; print(f'python3 (>= {v[0]}.{v[1]}), python3 (<< {v[0]}.{v[1] + 1})')"
                  OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${python}, python3-numpy, ${codecs_package}")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
endif()
include(CPack)
