# Packages for Debian: libabut-contact, libabut-contact-dev and python3-abut, by `cpack` in a build of the layers up to
# contact with CMAKE_INSTALL_PREFIX=/usr. scripts/deb does that, and tries them on a bare Debian.
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

set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME libabut-contact)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Shared libraries: contact geometry, contact on nodes and on faces, the C interface.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libabut-contact-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libabut-contact (= ${PROJECT_VERSION}), libeigen3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers for C++20, C and Fortran, for CMake and pkg-config.")

if(TARGET abut_python__contact)
list(APPEND CPACK_COMPONENTS_ALL python)
math(EXPR abut_next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-abut)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "libabut-contact (= ${PROJECT_VERSION}), python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${abut_next_python}), python3-numpy")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The package abut for numpy.")
endif()
# The libraries of the one package are looked at when those of the other are.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/base ${PROJECT_BINARY_DIR}/geometry
  ${PROJECT_BINARY_DIR}/contact ${PROJECT_BINARY_DIR}/bindings/c)
include(CPack)
