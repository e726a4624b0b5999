# cmake -D MPIEXEC=<mpirun> -D PROGRAM=<program> -P same_digits.cmake
#
# Runs a program on 1, 2 and 4 ranks of this machine, and fails where it fails or prints other lines than on one, except for
# the last line.
cmake_minimum_required(VERSION 3.25)

foreach(n IN ITEMS 1 2 4)
  execute_process(COMMAND ${MPIEXEC} --oversubscribe --bind-to none --allow-run-as-root -n ${n} ${PROGRAM}
    OUTPUT_VARIABLE printed RESULT_VARIABLE failed)
  message("${n} of them:\n${printed}")
  if(failed)
    message(FATAL_ERROR "on ${n} ranks it ends with ${failed}")
  endif()
  string(REGEX REPLACE "[^\n]*\n$" "" figures "${printed}")
  if(n EQUAL 1)
    set(alone "${figures}")
  endif()
  if(figures STREQUAL "" OR NOT figures STREQUAL alone)
    message(FATAL_ERROR "the figures of ${n} ranks are not those of one")
  endif()
endforeach()
