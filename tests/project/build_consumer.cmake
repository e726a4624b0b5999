# cmake -D SOURCE=<project> -D BUILD=<folder> -D GENERATOR=<name> -D "OPTIONS=-D...,-D..." -D "RUN=program,argument,..." -P build_consumer.cmake
#
# Configures a project of its own in an empty folder, builds one of its programs and runs it there; with an empty RUN it builds
# all of it and runs its tests.
string(REPLACE "," ";" OPTIONS "${OPTIONS}")
string(REPLACE "," ";" RUN "${RUN}")
set(target all)
set(command ${CMAKE_CTEST_COMMAND} --output-on-failure --no-tests=error)
if(RUN)
  list(POP_FRONT RUN target)
  set(command ${BUILD}/${target} ${RUN})
endif()

file(REMOVE_RECURSE ${BUILD})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} -G ${GENERATOR} ${OPTIONS} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --target ${target} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${command} WORKING_DIRECTORY ${BUILD} COMMAND_ERROR_IS_FATAL ANY)
