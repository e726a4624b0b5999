# Packages for Debian: libabut-contact0.1, libabut-contact-dev and python3-abut, by `cpack` in a build with ABUT_LAYERS=contact
# and CMAKE_INSTALL_PREFIX=/usr. scripts/deb does that, and tries them on a bare Debian.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Abut)
set(CPACK_PACKAGE_CONTACT "The authors of Abut <abut@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/deb)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL libraries development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

# The version of the soname is part of the name: programs linked with another one keep theirs.
set(abut_library_package libabut-contact${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME ${abut_library_package})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Shared libraries: contact geometry, contact on nodes and on faces, the C interface.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libabut-contact-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${abut_library_package} (= ${PROJECT_VERSION}), libeigen3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers for C++20, C and Fortran, for CMake and pkg-config.")

if(TARGET abut_python__contact)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR abut_next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-abut)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${abut_library_package} (= ${PROJECT_VERSION}), python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${abut_next_python}), python3-numpy")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The package abut for numpy.")
  # Python writes compiled files beside the module, which dpkg does not know.
  file(WRITE ${PROJECT_BINARY_DIR}/package/prerm "#!/bin/sh\nrm -rf /usr/lib/python3/dist-packages/abut/__pycache__\n")
  file(CHMOD ${PROJECT_BINARY_DIR}/package/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/prerm)
endif()
# The libraries of the one package are looked at when those of the other are.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/base ${PROJECT_BINARY_DIR}/geometry
  ${PROJECT_BINARY_DIR}/contact ${PROJECT_BINARY_DIR}/bindings/c)
include(CPack)
