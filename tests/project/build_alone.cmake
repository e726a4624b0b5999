# cmake -D ROOT=<source tree> -D LAYERS=<layer> -D BUILD=<folder> -D PREFIX=<folder> -D GENERATOR=<name> -D "OPTIONS=-D...,-D..." -D "LAUNCHER=program,argument,..."
#   -P build_alone.cmake
#
# Configures, builds and installs these layers where no package of the others can be found. The compiler is started by LAUNCHER.
string(REPLACE "," ";" OPTIONS "${OPTIONS}")
string(REGEX REPLACE ",$" "" LAUNCHER "${LAUNCHER}")
string(REPLACE "," ";" LAUNCHER "${LAUNCHER}")
set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${LAUNCHER}")  # a list, which no argument of a command can be
foreach(package embree fcl ccd Gmsh pugixml nanoflann LBFGSpp fmt nlohmann_json tomlplusplus muparser CLI11 spdlog Polyclipping Catch2 pybind11 MPI Zoltan)
  list(APPEND OPTIONS -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
file(REMOVE_RECURSE ${BUILD} ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${ROOT} -B ${BUILD} -G ${GENERATOR} -DABUT_LAYERS=${LAYERS} -DABUT_TESTS=OFF ${OPTIONS}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} COMMAND_ERROR_IS_FATAL ANY)
