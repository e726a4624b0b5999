# Packages for Debian, by `cpack` in a build with CMAKE_INSTALL_PREFIX=/usr; scripts/deb makes them, scripts/try_deb tries them on a
# bare Debian. Each is a component of the install; there are those whose parts are built, with ABUT_LAYERS=contact the first two and that
# for Python. DEBFULLNAME and DEBEMAIL of the environment say who makes them, as for other tools of Debian.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Abut)
set(CPACK_PACKAGE_CONTACT "The Abut authors <abut@localhost>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "contact between deformable solids in explicit dynamics")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/deb)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_files.cmake)
# The libraries of one package are looked at when those of another are.
get_property(abut_packaged_layers GLOBAL PROPERTY abut_layers)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/bindings/c)
foreach(layer IN LISTS abut_packaged_layers)
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/${layer})
endforeach()

# abut_package(<component> <name> SECTION word TEXT line... [DEPENDS packages] [RECOMMENDS packages] [COMPILED | LIBRARIES | FOR_ANY]).
# COMPILED: dpkg-shlibdeps adds the packages that its programs are linked with. LIBRARIES: those of others may be linked with it, too.
# FOR_ANY: for any kind of machine.
set(CPACK_COMPONENTS_ALL "")
macro(abut_package component name)
  cmake_parse_arguments(package "COMPILED;LIBRARIES;FOR_ANY" "SECTION;DEPENDS;RECOMMENDS" "TEXT" ${ARGN})
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} package_key)
  list(JOIN package_TEXT "\n" CPACK_COMPONENT_${package_key}_DESCRIPTION)
  set(CPACK_DEBIAN_${package_key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${package_key}_PACKAGE_SECTION ${package_SECTION})
  set(CPACK_DEBIAN_${package_key}_PACKAGE_DEPENDS "${package_DEPENDS}")
  set(CPACK_DEBIAN_${package_key}_PACKAGE_RECOMMENDS "${package_RECOMMENDS}")
  if(package_COMPILED OR package_LIBRARIES)
    set(CPACK_DEBIAN_${package_key}_PACKAGE_SHLIBDEPS ON)
  endif()
  if(package_FOR_ANY)
    set(CPACK_DEBIAN_${package_key}_PACKAGE_ARCHITECTURE all)
  endif()
  if(package_LIBRARIES)
    set(control ${PROJECT_BINARY_DIR}/package/${component})
    get_property(layers GLOBAL PROPERTY abut_${component})
    list(TRANSFORM layers REPLACE "(.+)" "libabut_\\1 ${abut_soname} ${name} ${abut_same}\n" OUTPUT_VARIABLE lines)
    file(WRITE ${control}/shlibs ${lines})
    file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
    set(CPACK_DEBIAN_${package_key}_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)
  endif()
endmacro()

# The version of the soname is part of the name: programs linked with another one keep theirs.
set(abut_soname ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(abut_same "(= ${PROJECT_VERSION})")
abut_package(contact_libraries libabut-contact${abut_soname} LIBRARIES SECTION libs
  TEXT "Shared libraries: contact geometry, contact on nodes and on faces," "integrators, and the C interface of contact.")
abut_package(contact_development libabut-contact-dev SECTION libdevel
  TEXT "Headers of contact for C++20, C and Fortran, files for CMake and" "pkg-config, and example programs."
  DEPENDS "libabut-contact${abut_soname} ${abut_same}")
set(abut_python_depends "libabut-contact${abut_soname} ${abut_same}")
if(TARGET abut::solid)
  abut_package(libraries libabut${abut_soname} LIBRARIES SECTION libs
    TEXT "Shared libraries: meshes, solids, runs, and scenes in files."
    DEPENDS "libabut-contact${abut_soname} ${abut_same}" RECOMMENDS "libabut-gmsh${abut_soname} ${abut_same}")
  abut_package(gmsh libabut-gmsh${abut_soname} COMPILED SECTION libs
    TEXT "Makes meshes of discs, cylinders, spheres and boxes by Gmsh. The" "libraries load it when a scene asks for one.")
  abut_package(development libabut-dev SECTION libdevel
    TEXT "Headers of meshes, solids, runs and scenes for C++20, files for CMake."
    DEPENDS "libabut${abut_soname} ${abut_same}, libabut-contact-dev ${abut_same}")
  string(APPEND abut_python_depends ", libabut${abut_soname} ${abut_same}")
endif()
if(TARGET abut)
  abut_package(programs abut COMPILED SECTION science
    TEXT "The program abut runs, checks and draws scenes of solids in contact, and" "detects contact of meshes in files. Scenes to run are in"
      "/usr/share/abut/scenes."
    DEPENDS "libabut${abut_soname} ${abut_same}")
  install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/abut-doc COMPONENT documentation
    FILES_MATCHING PATTERN *.md PATTERN *.png PATTERN *.svg PATTERN site EXCLUDE)
  install(DIRECTORY out/site/html DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/abut-doc COMPONENT documentation OPTIONAL)
  abut_package(documentation abut-doc FOR_ANY SECTION doc
    TEXT "The pages of the documentation, with the site that they make where it was" "built.")
endif()
if(TARGET abut_python__contact)
  math(EXPR abut_next_python "${Python_VERSION_MINOR} + 1")
  abut_package(python python3-abut COMPILED SECTION python
    TEXT "The package abut for Python and numpy: contact for solvers of one's own, and" "meshes, solids and runs where they are built."
    DEPENDS "${abut_python_depends}, python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${abut_next_python}), python3-numpy")
  # Python writes compiled files beside the module, which dpkg does not know.
  set(abut_scripts ${PROJECT_BINARY_DIR}/package)
  file(WRITE ${abut_scripts}/postinst "#!/bin/sh\nset -e\nif command -v py3compile >/dev/null; then py3compile -p python3-abut; fi\n")
  file(WRITE ${abut_scripts}/prerm "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null; then py3clean -p python3-abut; fi\n")
  file(CHMOD ${abut_scripts}/postinst ${abut_scripts}/prerm
    PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${abut_scripts}/postinst ${abut_scripts}/prerm)
endif()
include(CPack)
