# Every public header compiles alone. A header with a source file of its own is included first by it
# (cmake/check_layers.py sees to that); each of the others gets a source file here that holds nothing
# but the include. cmake/check_headers.py finds includes that the precompiled headers hide. A build that compiles
# several files at a time tests neither, as a header finds what an earlier file has included.
if(CMAKE_UNITY_BUILD)
  return()
endif()
get_property(components GLOBAL PROPERTY MSC_VO_COMPONENTS)
foreach(component ${components})
  get_property(folder GLOBAL PROPERTY MSC_VO_FOLDER_OF_${component})
  set(headers)
  if(folder)  # an umbrella has none
    file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
         ${PROJECT_SOURCE_DIR}/msc_vo/${folder}/*.h)
  endif()
  set(sources)
  foreach(header ${headers})
    cmake_path(REPLACE_EXTENSION header .cc OUTPUT_VARIABLE source)
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${source})
      file(CONFIGURE OUTPUT headers/${source} CONTENT "#include \"@header@\"\n" @ONLY)
      list(APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/headers/${source})
    endif()
  endforeach()
  if(sources)
    add_library(${component}_headers OBJECT ${sources})
    msc_vo_compile_options(${component}_headers)
    set_target_properties(${component}_headers PROPERTIES
      UNITY_BUILD OFF  # each header alone
      POSITION_INDEPENDENT_CODE ON)
    msc_vo_use_precompiled_headers(${component}_headers library)
    target_link_libraries(${component}_headers PRIVATE msc_vo::${component})
  endif()
endforeach()
