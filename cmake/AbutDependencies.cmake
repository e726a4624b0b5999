# Every package that the build needs, found here once, so that its targets are visible in all folders.
#
# abut_find(<package> <version> ARGS ... TARGETS ...) calls find_package and remembers which package a target comes from:
# abut_layer() writes from that what an installed layer has to find again.
macro(abut_find package version)
  cmake_parse_arguments(abut_find "" "" "ARGS;TARGETS" ${ARGN})
  find_package(${package} ${version} REQUIRED ${abut_find_ARGS})
  foreach(abut_find_target IN LISTS abut_find_TARGETS)
    set_property(GLOBAL PROPERTY abut_package_of_${abut_find_target} "${package} ${version} ${abut_find_ARGS}")
  endforeach()
endmacro()

set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE ON)

# base
abut_find(Eigen3 3.4 ARGS CONFIG TARGETS Eigen3::Eigen)
abut_find(TBB 2021 ARGS CONFIG TARGETS TBB::tbb)

# geometry
abut_find(CGAL 5.5 ARGS CONFIG TARGETS CGAL::CGAL)
abut_find(embree "" ARGS CONFIG TARGETS embree)  # 3 or 4
abut_find(ccd 2.0 ARGS CONFIG TARGETS ccd)  # 2.1 calls itself 2.0
abut_find(fcl 0.7 ARGS CONFIG TARGETS fcl)

# mesh
abut_find(Gmsh 4.8 ARGS MODULE TARGETS Gmsh::Gmsh)
abut_find(VTK 9.1 ARGS CONFIG COMPONENTS CommonCore CommonDataModel IOXML
  TARGETS VTK::CommonCore VTK::CommonDataModel VTK::IOXML)

# solid
abut_find(nanoflann 1.4 ARGS CONFIG TARGETS nanoflann::nanoflann)
abut_find(LBFGSpp "" ARGS MODULE TARGETS LBFGSpp::LBFGSpp)

# run
abut_find(fmt 9.1 ARGS CONFIG TARGETS fmt::fmt)
abut_find(nlohmann_json 3.11 ARGS CONFIG TARGETS nlohmann_json::nlohmann_json)

# programs
if(ABUT_PROGRAMS OR ABUT_BENCHMARKS)
  abut_find(CLI11 2.1 ARGS CONFIG TARGETS CLI11::CLI11)
  abut_find(spdlog 1.10 ARGS CONFIG TARGETS spdlog::spdlog)
endif()

# benchmarks
if(ABUT_BENCHMARKS)
  abut_find(Polyclipping 6.4 ARGS MODULE TARGETS Polyclipping::Polyclipping)
  abut_find(Boost 1.74 TARGETS Boost::headers)
endif()

# tests
if(ABUT_TESTS)
  abut_find(Catch2 2.13 ARGS CONFIG TARGETS Catch2::Catch2)
endif()
