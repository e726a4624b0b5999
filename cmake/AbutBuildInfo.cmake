# abut_build_info(<file>) writes the source file that says how this build is made, for `abut --version`. One file alone has
# the commit in it, so that a new one makes the compiler cache miss once.

function(abut_build_info file)
  set(abut_commit "")
  find_package(Git QUIET)
  if(Git_FOUND AND PROJECT_IS_TOP_LEVEL)
    execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12 --exclude=*
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE abut_commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  if(ABUT_NATIVE)
    set(abut_processor "the processor it was built on")
  else()
    set(abut_processor "any ${CMAKE_SYSTEM_PROCESSOR}")
  endif()
  if(ABUT_SANITIZE)
    string(APPEND abut_processor ", with sanitizers: ${ABUT_SANITIZE}")
  endif()

  set(abut_library_versions "")
  foreach(library IN ITEMS Eigen3=Eigen TBB=TBB CGAL=CGAL embree=Embree fcl=FCL Gmsh=Gmsh pugixml=pugixml nanoflann=nanoflann fmt=fmt
                           nlohmann_json=nlohmann-json tomlplusplus=toml++ muparser=muParser CLI11=CLI11 spdlog=spdlog
                           MPI_C=MPI Zoltan=Zoltan Kokkos=Kokkos)
    string(REGEX MATCH "^(.*)=(.*)$" matched ${library})
    string(APPEND abut_library_versions "{\"${CMAKE_MATCH_2}\", \"${${CMAKE_MATCH_1}_VERSION}\"}, ")
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/apps/abut/build_info.cpp.in ${file} @ONLY)
endfunction()
