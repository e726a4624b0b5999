# abut_layer(<name> SOURCES ... HEADERS ... [DEPENDS layers...] [PUBLIC targets...] [PRIVATE targets...] [JOIN])
#
# One library per layer: target abut_<name>, alias abut::<name>, component <name> of find_package(abut). File names are
# relative to the layer's folder. HEADERS become a file set that is installed under include/abut/<name>. DEPENDS are lower
# layers. PRIVATE are the back ends, which no user ever sees; cmake/AbutDependencies.cmake finds their packages.
# JOIN: abut_join_sources may take the layer.
#
# abut_check_headers() once, after the layers: the target check_headers compiles each of their headers on its own.
# abut_install_package() once, after the layers: what find_package(abut) reads.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(abut_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/abut)

add_library(abut_compile_options INTERFACE)
target_compile_features(abut_compile_options INTERFACE cxx_std_20)
# Same bits everywhere a compiler is free to choose: no contraction of a*b+c, no reassociation.
# No interposition: calls between functions of one shared library are inlined as in a static one.
target_compile_options(abut_compile_options INTERFACE
  -ffp-contract=off -fno-fast-math -fno-semantic-interposition
  # Debug information does not name the build folder, so that a compiler cache serves another one, as tests make it.
  -fdebug-prefix-map=${PROJECT_BINARY_DIR}=.
  # gcc collects its garbage at 128 MB, which costs up to a tenth of its time; at 512 MB hardly ever. With a compiler cache time
  # is no matter, and what is in it stays valid.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<BOOL:${ABUT_CCACHE}>>>:--param=ggc-min-heapsize=524288>
  -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers  # {.shift = s} leaves the rest to its defaults on purpose
  $<$<BOOL:${ABUT_WERROR}>:-Werror>
  $<$<BOOL:${ABUT_NATIVE}>:-march=native>
  # Overlaps of boxes are found without branches.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>
  # gcc 12 takes the undefined registers in its own AVX-512 header for a mistake of ours.
  $<$<AND:$<BOOL:${ABUT_NATIVE}>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>
  # At -O3 it finds faults in its own headers and in Eigen's (std::string, std::vector, AVX-512); builds for tests have these on.
  $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-array-bounds;-Wno-free-nonheap-object;-Wno-restrict;-Wno-stringop-overflow>)
if(ABUT_SANITIZE)
  target_compile_options(abut_compile_options INTERFACE -fsanitize=${ABUT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(abut_compile_options INTERFACE -fsanitize=${ABUT_SANITIZE})
endif()

function(abut_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 layer "JOIN" "" "SOURCES;HEADERS;DEPENDS;PUBLIC;PRIVATE")
  set(target abut_${name})
  add_library(${target} ${layer_SOURCES})
  add_library(abut::${name} ALIAS ${target})

  # Through the link include/abut, so that a header is found as "abut/<layer>/<name>.hpp" here and where it is installed.
  list(TRANSFORM layer_HEADERS PREPEND ${PROJECT_SOURCE_DIR}/include/abut/${name}/ OUTPUT_VARIABLE headers)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${headers})

  list(TRANSFORM layer_DEPENDS PREPEND abut:: OUTPUT_VARIABLE lower_layers)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target}
    PUBLIC ${lower_layers} ${layer_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:abut_compile_options> ${layer_PRIVATE})
  if(NOT ABUT_SANITIZE AND NOT APPLE)  # the linkers of GNU and LLVM know it
    target_link_options(${target} PRIVATE -Wl,--no-undefined)  # found here, not where a user links
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL SHARED_LIBRARY AND NOT APPLE)
    target_link_options(${target} PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map)
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exports.map)
  endif()
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH $ORIGIN)

  if(layer_JOIN)
    abut_join_sources(${target})
  endif()

  abut_install_layer(${name} "${layer_DEPENDS}" "${layer_PUBLIC}" "${layer_PRIVATE}")
  set_property(GLOBAL APPEND PROPERTY abut_layers ${name})
  set_property(GLOBAL APPEND PROPERTY abut_public_headers ${headers})
endfunction()

# The library, its headers, its targets and a list of what has to be found before them. A shared library brings its back
# ends along; one that links a static library has to find them.
function(abut_install_layer name lower_layers public_targets private_targets)
  set(libraries libraries)
  set(development development)
  if(name MATCHES "^(base|geometry|contact|dynamics|c)$")  # what a solver of one's own needs, without that of the others
    set(libraries contact_libraries)
    set(development contact_development)
  endif()
  set_property(GLOBAL APPEND PROPERTY abut_${libraries} ${name})
  install(TARGETS abut_${name} EXPORT abut_${name}
    LIBRARY COMPONENT ${libraries} NAMELINK_COMPONENT ${development}
    ARCHIVE COMPONENT ${development}
    FILE_SET HEADERS COMPONENT ${development})
  install(EXPORT abut_${name} NAMESPACE abut:: DESTINATION ${abut_package_dir} FILE abut-${name}-targets.cmake
    COMPONENT ${development})

  set(needed ${public_targets})
  get_target_property(type abut_${name} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    list(APPEND needed ${private_targets})
  endif()
  set(lines "")
  list(TRANSFORM needed REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1")
  foreach(target IN LISTS needed)
    get_property(package GLOBAL PROPERTY abut_package_of_${target})
    if(NOT package)
      message(FATAL_ERROR "abut_layer(${name}): no package is known to bring '${target}'. Add it to cmake/AbutDependencies.cmake.")
    endif()
    string(REPLACE ";" " " package "${package}")
    list(APPEND lines "find_dependency(${package})\n")
  endforeach()
  list(REMOVE_DUPLICATES lines)
  list(JOIN lines "" lines)
  set(file ${PROJECT_BINARY_DIR}/package/abut-${name}-dependencies.cmake)
  file(WRITE ${file} "set(abut_${name}_lower_layers ${lower_layers})\n${lines}")
  install(FILES ${file} DESTINATION ${abut_package_dir} COMPONENT ${development})
endfunction()

function(abut_install_package)
  get_property(abut_layers GLOBAL PROPERTY abut_layers)
  list(JOIN abut_layers ", " abut_layer_names)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/abutConfig.cmake.in
    ${PROJECT_BINARY_DIR}/package/abutConfig.cmake INSTALL_DESTINATION ${abut_package_dir})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/abutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/package/abutConfig.cmake ${PROJECT_BINARY_DIR}/package/abutConfigVersion.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindGmsh.cmake ${PROJECT_SOURCE_DIR}/cmake/FindKokkos.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindLBFGSpp.cmake ${PROJECT_SOURCE_DIR}/cmake/FindZoltan.cmake
    DESTINATION ${abut_package_dir} COMPONENT contact_development)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/abut COMPONENT contact_development)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE ${PROJECT_SOURCE_DIR}/README.md TYPE DOC
    COMPONENT contact_libraries)
endfunction()

# The target check_headers compiles each public header as if it were the only one in its source. A header may stand behind one
# that it includes before any code of its own: what it finds there is what it asks for itself. Such rows of headers share a source.
function(abut_check_headers)
  get_property(headers GLOBAL PROPERTY abut_public_headers)
  get_property(layers GLOBAL PROPERTY abut_layers)
  list(TRANSFORM headers REPLACE "^${PROJECT_SOURCE_DIR}/include/" "")
  set(first_of_row ${headers})
  foreach(header IN LISTS headers)
    file(STRINGS ${PROJECT_SOURCE_DIR}/include/${header} lines REGEX "^(#include \"abut/|namespace )")
    foreach(line IN LISTS lines)
      if(line MATCHES "^namespace ")
        break()
      endif()
      string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
      if(included IN_LIST headers AND NOT DEFINED "behind_${included}")
        set("behind_${included}" ${header})
        list(REMOVE_ITEM first_of_row ${header})
        break()
      endif()
    endforeach()
  endforeach()

  set(sources "")
  foreach(header IN LISTS first_of_row)
    set(source ${PROJECT_BINARY_DIR}/check_headers/${header}.cpp)
    set(row "")
    while(header)
      string(APPEND row "#include \"${header}\"\n")
      set(header "${behind_${header}}")
    endwhile()
    file(CONFIGURE OUTPUT ${source} CONTENT "${row}")
    list(APPEND sources ${source})
  endforeach()
  add_library(check_headers OBJECT EXCLUDE_FROM_ALL ${sources})
  list(TRANSFORM layers PREPEND abut::)
  target_link_libraries(check_headers PRIVATE ${layers} abut_compile_options)
endfunction()
