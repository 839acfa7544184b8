# Functions that declare the targets of msc_vo. Each folder is one library that links only libraries
# of lower layers, so that calls into a higher layer fail to link (if libraries are static).

# Compiler options of msc_vo's own code: PRIVATE, so that they do not reach projects that link it.
function(msc_vo_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow
                         -Wnon-virtual-dtor -Woverloaded-virtual)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # Both are deliberate: loops that vectorise without branches, with a hint for GCC.
    target_compile_options(${target} PRIVATE -Wno-unknown-pragmas -Wno-bitwise-instead-of-logical)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND MSC_VO_PRECOMPILE_HEADERS)
    # GCC spends a tenth of its time on collecting garbage, which saves a sixth of its memory: it begins at 1 GiB.
    # Tools that read the commands with another compiler need a build without this and without precompiled headers.
    target_compile_options(${target} PRIVATE --param=ggc-min-heapsize=1048576)
  endif()
  # To the compiler, files that are compiled together are one file: it warns about local names that
  # another one has, and GCC about unnamed namespaces in headers.
  set(together $<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>)
  target_compile_options(${target} PRIVATE $<${together}:-Wno-shadow>
                         $<$<AND:${together},$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)
  if(MSC_VO_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
      # GCC 14 warns about the values of empty std::optional objects that are copied.
      target_compile_options(${target} PRIVATE -Wno-error=maybe-uninitialized)
    endif()
  endif()
  if(MSC_VO_NATIVE)
    # PUBLIC: Eigen's memory layout depends on it, so a consumer must be compiled alike.
    target_compile_options(${target} PUBLIC -march=native)
    # GCC 12 warns about its own AVX headers: variables for AVX-512, arrays for AVX2.
    target_compile_options(${target} PRIVATE -Wno-error=maybe-uninitialized
                           -Wno-error=array-bounds)
  else()
    # Multiplication and addition are rounded one by one, as on a processor that cannot fuse them.
    target_compile_options(${target} PRIVATE -ffp-contract=off)
    if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
      target_include_directories(${target} BEFORE PRIVATE ${PROJECT_SOURCE_DIR}/cmake/aarch64)
    endif()
  endif()
endfunction()

# msc_vo_library(<folder> SOURCES a.cc ... [DEPENDS target ...] [PRIVATE_DEPENDS target ...])
# The component has the folder's name, with _ for /. Libraries are static, or shared with
# BUILD_SHARED_LIBS. A folder that holds headers only becomes an INTERFACE library.
function(msc_vo_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  string(REPLACE / _ component ${folder})
  set(target msc_vo_${component})
  if(ARG_SOURCES)
    add_library(${target} ${ARG_SOURCES})
    set(scope PUBLIC)
    msc_vo_compile_options(${target})
    msc_vo_use_precompiled_headers(${target} library)
    set_target_properties(${target} PROPERTIES
      POSITION_INDEPENDENT_CODE ON VERSION ${PROJECT_VERSION}
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    msc_vo_find_libraries_from(${target} ${CMAKE_INSTALL_LIBDIR})
    target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
    target_compile_features(${target} INTERFACE cxx_std_17)
    target_link_libraries(${target} INTERFACE ${ARG_DEPENDS})
  endif()
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_property(GLOBAL PROPERTY MSC_VO_FOLDER_OF_${component} ${folder})
  msc_vo_export(${component} ${ARG_DEPENDS} ${ARG_PRIVATE_DEPENDS})
endfunction()

# msc_vo_private_library(<folder> SOURCES ... [DEPENDS ...] [PRIVATE_DEPENDS ...]): a library of the
# msc_vo command that is not installed, because it needs packages that programs embedding msc_vo rarely
# have.
function(msc_vo_private_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target msc_vo_${folder})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(msc_vo::${folder} ALIAS ${target})
  msc_vo_compile_options(${target})
  msc_vo_use_precompiled_headers(${target} library)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
endfunction()

# msc_vo_umbrella(<name> <folder> ...): several folders under one name.
function(msc_vo_umbrella name)
  list(TRANSFORM ARGN PREPEND msc_vo:: OUTPUT_VARIABLE depends)
  add_library(msc_vo_${name} INTERFACE)
  target_link_libraries(msc_vo_${name} INTERFACE ${depends})
  msc_vo_export(${name} ${depends})
endfunction()
