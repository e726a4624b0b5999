# abut_test(<name> SOURCES files... LINK targets... [PROPERTIES name value...])
#
# One Catch2 program, test_<name>, and one CTest a TEST_CASE, called "<name>/<title>". LINK names what is under test, for
# example abut::contact. PROPERTIES go to every one of its CTests, for example TIMEOUT 300 or PROCESSORS 2. The main
# program is compiled once, in tests/support; headers there are included as "support/<name>.hpp".
include(Catch)

add_library(abut_joined_options INTERFACE)
target_compile_options(abut_joined_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-shadow;-Wshadow=local;-Wno-subobject-linkage>)

function(abut_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "SOURCES;LINK;PROPERTIES")
  add_executable(test_${name} ${test_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE ${test_LINK} abut_test_main abut_compile_options)
  # What is under test is optimised as it will be used; its tests compile in two thirds of the time without.
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
  # Most of that time is headers, which several sources share. Names in unnamed namespaces must differ then, and warnings that
  # see names of other sources are off. Of tests alone, since a call may silently find a better match in another source.
  if(ABUT_JOIN_SOURCES)
    set_target_properties(test_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    target_link_libraries(test_${name} PRIVATE abut_joined_options)
  endif()
  # Catch2 2.13 asks the finished program for its test cases right after linking it; it has no DISCOVERY_MODE.
  catch_discover_tests(test_${name} TEST_PREFIX "${name}/" PROPERTIES TIMEOUT 600 ${test_PROPERTIES})
endfunction()
