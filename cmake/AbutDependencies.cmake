# Every package that the wanted layers need, found here once, so that its targets are visible in all folders.
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

# The same for a back end that a layer can do without, unless the layer mesh is wanted, whose users get all there is.
macro(abut_find_back_end package version without)
  if(mesh IN_LIST abut_wanted_layers)
    abut_find(${package} "${version}" ${ARGN})
  else()
    find_package(${package} ${version} QUIET CONFIG)
    if(${package}_FOUND)
      abut_find(${package} "${version}" ${ARGN})
    else()
      message(STATUS "Abut without ${package}: ${without}")
    endif()
  endif()
endmacro()

set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE ON)

# base
abut_find(Eigen3 3.4 ARGS CONFIG TARGETS Eigen3::Eigen)
abut_find(TBB 2021 ARGS CONFIG TARGETS TBB::tbb)

if(geometry IN_LIST abut_wanted_layers)
  abut_find(CGAL 5.5 ARGS CONFIG TARGETS CGAL::CGAL)
  abut_find_back_end(embree "" "the packed tree finds the same pairs" ARGS CONFIG TARGETS embree)  # 3 or 4
  abut_find_back_end(ccd 2.0 "no distances of convex cells" ARGS CONFIG TARGETS ccd)  # 2.1 calls itself 2.0
  abut_find_back_end(fcl 0.7 "the packed tree finds the same pairs" ARGS CONFIG TARGETS fcl)
endif()

if(mesh IN_LIST abut_wanted_layers)
  abut_find(Gmsh 4.8 ARGS MODULE TARGETS Gmsh::Gmsh)
  abut_find(pugixml 1.12 ARGS CONFIG TARGETS pugixml::pugixml)
  abut_find(ZLIB 1.2 ARGS MODULE TARGETS ZLIB::ZLIB)
endif()

if(solid IN_LIST abut_wanted_layers)
  abut_find(nanoflann 1.4 ARGS CONFIG TARGETS nanoflann::nanoflann)
  abut_find(LBFGSpp "" ARGS MODULE TARGETS LBFGSpp::LBFGSpp)
  find_package(Kokkos 3.4 QUIET MODULE)
  if(Kokkos_FOUND)
    abut_find(Kokkos 3.4 ARGS MODULE TARGETS Kokkos::kokkos)
  else()
    message(STATUS "Abut without Kokkos: steps are made on the host alone (scripts/packages-devices.txt)")
  endif()
endif()

# Where nobody asks for ranks by name, and MPI or Zoltan is not there, the layer is left out.
if(ranks IN_LIST abut_wanted_layers)
  set(MPI_CXX_SKIP_MPICXX ON)  # nobody uses the bindings for C++
  if(ABUT_LAYERS STREQUAL "all")
    find_package(MPI 3.0 QUIET MODULE COMPONENTS C)
    find_package(Zoltan 3.8 QUIET MODULE)
  endif()
  if(ABUT_LAYERS STREQUAL "all" AND NOT (MPI_FOUND AND Zoltan_FOUND))
    list(REMOVE_ITEM abut_wanted_layers ranks)
    message(STATUS "Abut without MPI and Zoltan: runs on one rank alone (scripts/packages-ranks.txt)")
  else()
    abut_find(MPI 3.0 ARGS MODULE COMPONENTS C TARGETS MPI::MPI_C)
    abut_find(Zoltan 3.8 ARGS MODULE TARGETS Zoltan::Zoltan)
  endif()
endif()

if(run IN_LIST abut_wanted_layers)
  abut_find(HDF5 1.10 ARGS MODULE COMPONENTS C CXX TARGETS hdf5::hdf5 hdf5::hdf5_cpp)
  abut_find(fmt 9.1 ARGS CONFIG TARGETS fmt::fmt)
  abut_find(nlohmann_json 3.11 ARGS CONFIG TARGETS nlohmann_json::nlohmann_json)
  if(ABUT_PROGRAMS OR ABUT_BENCHMARKS)
    abut_find(CLI11 2.1 ARGS CONFIG TARGETS CLI11::CLI11)
    abut_find(spdlog 1.10 ARGS CONFIG TARGETS spdlog::spdlog)
  endif()
  if(ABUT_BENCHMARKS)
    abut_find(Polyclipping 6.4 ARGS MODULE TARGETS Polyclipping::Polyclipping)
    abut_find(Boost 1.74 TARGETS Boost::headers)
  endif()
endif()

if(input IN_LIST abut_wanted_layers)
  abut_find(tomlplusplus 3.3 ARGS CONFIG TARGETS tomlplusplus::tomlplusplus)
  abut_find(muparser 2.3 ARGS CONFIG TARGETS muparser::muparser)
endif()

# bindings: the module for Python is made where pybind11 is
if(contact IN_LIST abut_wanted_layers AND BUILD_SHARED_LIBS AND NOT ABUT_SANITIZE)
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)  # that of the system, to which the packages pybind11 and numpy belong
  endif()
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    find_package(pybind11 2.10 QUIET CONFIG)
  endif()
  if(NOT pybind11_FOUND)
    message(STATUS "Abut without pybind11: no module for Python (scripts/packages-python.txt)")
  endif()
endif()

# tests
if(ABUT_TESTS)
  abut_find(Catch2 2.13 ARGS CONFIG TARGETS Catch2::Catch2)
  if(run IN_LIST abut_wanted_layers)
    abut_find(EXPAT 2.5 ARGS MODULE TARGETS EXPAT::EXPAT)
  endif()
endif()
