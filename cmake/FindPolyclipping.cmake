# Clipper, the polygon clipping library of Angus Johnson, as Debian calls it. It comes without a CMake package. Makes the
# target Polyclipping::Polyclipping and the variable Polyclipping_VERSION.
find_path(Polyclipping_INCLUDE_DIR polyclipping/clipper.hpp)
find_library(Polyclipping_LIBRARY polyclipping)
if(Polyclipping_INCLUDE_DIR)
  file(STRINGS ${Polyclipping_INCLUDE_DIR}/polyclipping/clipper.hpp Polyclipping_VERSION REGEX "define CLIPPER_VERSION \"")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Polyclipping_VERSION "${Polyclipping_VERSION}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Polyclipping REQUIRED_VARS Polyclipping_LIBRARY Polyclipping_INCLUDE_DIR
  VERSION_VAR Polyclipping_VERSION)

if(Polyclipping_FOUND AND NOT TARGET Polyclipping::Polyclipping)
  add_library(Polyclipping::Polyclipping UNKNOWN IMPORTED)
  set_target_properties(Polyclipping::Polyclipping PROPERTIES
    IMPORTED_LOCATION ${Polyclipping_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Polyclipping_INCLUDE_DIR})
endif()
mark_as_advanced(Polyclipping_INCLUDE_DIR Polyclipping_LIBRARY)
