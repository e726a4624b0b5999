# cmake -D LIBRARY=<shared library> -D "ALLOWED=name,name" [-D DIRECT=ON] -P check_links.cmake
#
# Lists what a shared library links, all the way down (DIRECT: what it names itself), and fails where one is not allowed: a host
# pays for nothing that it does not use. Names are without lib and .so; what every C++ program links is always allowed.
cmake_minimum_required(VERSION 3.25)

string(REPLACE "," ";" allowed "${ALLOWED}")
list(APPEND allowed stdc++ m gcc_s c dl pthread rt ld-linux-x86-64 ld-linux-aarch64 linux-vdso)

if(DIRECT)
  execute_process(COMMAND readelf --dynamic --wide ${LIBRARY} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "\\(NEEDED\\)[^\n]*\\[[^\n]*\\]" lines "${text}")
else()
  execute_process(COMMAND ldd ${LIBRARY} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${text}")
endif()

set(linked "")
foreach(line IN LISTS lines)
  if(line MATCHES "(lib)?([A-Za-z0-9_+-]+)\\.so")
    list(APPEND linked ${CMAKE_MATCH_2})
  endif()
endforeach()
list(REMOVE_DUPLICATES linked)
list(SORT linked)
if(NOT linked)
  message(FATAL_ERROR "${LIBRARY}: nothing is linked, not even libc; this check would pass without looking at it")
endif()

set(unwanted "")
foreach(library IN LISTS linked)
  if(NOT library IN_LIST allowed)
    list(APPEND unwanted ${library})
  endif()
endforeach()
list(JOIN linked ", " linked)
message("links: ${linked}")
if(unwanted)
  list(JOIN unwanted ", " unwanted)
  message("${LIBRARY} must not link ${unwanted}")  # in one line; an error would be wrapped
  message(FATAL_ERROR "a host pays for nothing that it does not use")
endif()
