# cmake -D BUILD=<build tree> -D PREFIX=<folder> -P install_anew.cmake
#
# Installs into an empty folder, so that nothing of an earlier install helps a later one along.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} COMMAND_ERROR_IS_FATAL ANY)
