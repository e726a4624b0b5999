# cmake -D LIBRARY=<shared library> -P check_exports.cmake
#
# Fails where a layer exports a symbol outside the namespace abut: what a compiler made of headers of others is not to be seen.
execute_process(COMMAND nm -D --defined-only ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${symbols}")
list(LENGTH lines n)
list(FILTER lines EXCLUDE REGEX " (_ZNK?[RO]?4abut|_ZT[ISV]N4abut|_ZThn[0-9]+_NK?4abut|_ZGVN4abut)")
list(LENGTH lines n_others)
if(n EQUAL 0 OR n_others GREATER 0)
  list(SUBLIST lines 0 5 some)
  message(FATAL_ERROR "${LIBRARY} exports what is not its own, ${n_others} of ${n} symbols: ${some}")
endif()
message("${n} symbols, all of abut")
