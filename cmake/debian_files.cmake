# Run by cpack before it makes packages of what it has installed, one folder per component: what Debian asks of a package beside
# its files. Libraries lie where the system looks for them, and need no paths of their own.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  file(REMOVE_RECURSE ${root}/share/doc/abut)  # LICENSE, NOTICE and README, for which Debian has a file
  set(folder ${root}/share/doc/${package})
  file(WRITE ${folder}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Abut

Files: *
Copyright: 2026 The Abut authors
License: Apache-2.0

License: Apache-2.0
 Licensed under the Apache License, Version 2.0. On Debian systems its text is in /usr/share/common-licenses/Apache-2.0.
 .
 Programs that link Abut also link software of others under their own licences. libabut-gmsh loads Gmsh, which is under the
 GNU General Public License, version 2 or later.
")
  file(WRITE ${folder}/changelog "abut (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * See the file CHANGELOG.md of the sources.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  if(component STREQUAL "gmsh")  # a table of Gmsh's functions, which calls none of libc
    file(WRITE ${root}/share/lintian/overrides/${package} "${package}: library-not-linked-against-libc *\n")
  endif()
  file(GLOB compressed ${folder}/changelog ${root}/share/man/man1/*.1)
  execute_process(COMMAND gzip -9n ${compressed} COMMAND_ERROR_IS_FATAL ANY)

  file(GLOB_RECURSE compiled ${root}/bin/* ${root}/lib/*.so ${root}/lib/*.so.*)
  foreach(file IN LISTS compiled)
    if(NOT IS_SYMLINK ${file})
      file(RPATH_REMOVE FILE ${file})
    endif()
  endforeach()
endforeach()
