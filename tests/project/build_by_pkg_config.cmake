# cmake -D PREFIX=<install> -D LIBDIR=<lib> -D PKG_CONFIG=<program> -D CC=<compiler> -D SOURCE=<file.c> -D PROGRAM=<file> -P build_by_pkg_config.cmake
#
# Compiles a program of C with what abut_c.pc says, and runs it.
set(ENV{PKG_CONFIG_PATH} ${PREFIX}/${LIBDIR}/pkgconfig)
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs abut_c OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
execute_process(COMMAND ${CC} -std=c99 ${SOURCE} -o ${PROGRAM} ${flags} -lm COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${PROGRAM} COMMAND_ERROR_IS_FATAL ANY)
