# Kokkos as it installs itself, or that of Trilinos, as Debian packages it. Makes the target Kokkos::kokkos, and the function
# kokkos_compilation where sources that use it need another compiler.
block(PROPAGATE Kokkos_FOUND Kokkos_VERSION Kokkos_CONFIG Kokkos_DIR Kokkos_LIBRARIES Kokkos_ENABLE_CUDA
  Kokkos_CXX_COMPILER Kokkos_CXX_COMPILER_ID Kokkos_COMPILE_LAUNCHER)
  set(CMAKE_CXX_EXTENSIONS OFF)  # else Kokkos switches them off for all of us
  find_package(Kokkos ${Kokkos_FIND_VERSION} CONFIG QUIET OPTIONAL_COMPONENTS separable_compilation)
endblock()
if(Kokkos_FOUND AND TARGET trilinos_kokkoscore)
  # Its own target names a folder that is not there.
  find_path(Kokkos_INCLUDE_DIR Kokkos_Core.hpp PATH_SUFFIXES trilinos)
  mark_as_advanced(Kokkos_INCLUDE_DIR)
  set_target_properties(Kokkos::kokkos PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${Kokkos_INCLUDE_DIR} INTERFACE_LINK_LIBRARIES trilinos_kokkoscore)
endif()
if(Kokkos_ENABLE_CUDA AND TARGET Kokkos::kokkoscore)
  # The host's compiler links and does not know the options of that of Kokkos. Code of the device needs no link step of its
  # own, unless Kokkos was built with relocatable device code, which its default is not.
  set_target_properties(Kokkos::kokkoscore PROPERTIES INTERFACE_LINK_OPTIONS "")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Kokkos CONFIG_MODE)
