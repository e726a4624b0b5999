# What keeps a build from scratch short where most of its time goes: programs, studies and tests, which drive the library.

# Options of programs: those of the library, except in a build for tests, where only the library is optimised as it will be
# used, without its layers run and input.
add_library(abut_program_options INTERFACE)
target_link_libraries(abut_program_options INTERFACE abut_compile_options)
target_compile_options(abut_program_options INTERFACE $<$<CONFIG:RelWithDebInfo>:-O1>)

add_library(abut_joined_options INTERFACE)
target_compile_options(abut_joined_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-shadow;-Wshadow=local;-Wno-subobject-linkage>)

# abut_join_sources(targets...): with ABUT_JOIN_SOURCES, eight sources of a target are compiled at a time, and share their
# headers. Names in unnamed namespaces must differ then, and warnings that see names of other sources are off. A call
# may silently find a better match in another source: overloads in unnamed namespaces take other types, or have other names.
function(abut_join_sources)
  if(ABUT_JOIN_SOURCES)
    foreach(target IN LISTS ARGN)
      set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:abut_joined_options>)
    endforeach()
  endif()
endfunction()
