# cmake -D SOURCE=<project> -D BUILD=<folder> -D GENERATOR=<name> -D "OPTIONS=-D...,-D..." -D "RUN=program,argument,..." -P build_consumer.cmake
#
# Configures a project of its own in an empty folder, builds one of its programs and runs it there.
string(REPLACE "," ";" OPTIONS "${OPTIONS}")
string(REPLACE "," ";" RUN "${RUN}")
list(POP_FRONT RUN program)

file(REMOVE_RECURSE ${BUILD})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} -G ${GENERATOR} ${OPTIONS} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --target ${program} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${BUILD}/${program} ${RUN} WORKING_DIRECTORY ${BUILD} COMMAND_ERROR_IS_FATAL ANY)
