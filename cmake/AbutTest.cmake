# abut_test(<name> SOURCES files... LINK targets... [LAYER name] [LONG] [PROPERTIES name value...])
#
# One Catch2 program, test_<name>, and one CTest per TEST_CASE, called "<name>/<title>" or "<layer>/<title>". LINK names what is under test, for
# example abut::contact. PROPERTIES go to every one of its CTests, for example TIMEOUT 300 or COST 20. LONG: some cases have the tag
# [long], and their CTests this label, which continuous integration leaves out. The main program is compiled once, in tests/support; headers
# there are included as "support/<name>.hpp".
include(Catch)

function(abut_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "LONG" "LAYER" "SOURCES;LINK;PROPERTIES")
  if(NOT test_LAYER)
    set(test_LAYER ${name})
  endif()
  add_executable(test_${name} ${test_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE ${test_LINK} abut_test_main abut_compile_options)
  # What is under test is optimised as it will be used, except run and input; its tests compile in two thirds of the time
  # without.
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
  abut_join_sources(test_${name})
  # Catch2 2.13 asks the finished program for its test cases right after linking it; it has no DISCOVERY_MODE.
  set(usual "")
  if(test_LONG)
    set(usual TEST_SPEC "~[long]")
    catch_discover_tests(test_${name} TEST_SPEC "[long]~[.]" TEST_LIST test_${name}_LONG_TESTS TEST_PREFIX "${test_LAYER}/"
      PROPERTIES TIMEOUT 1200 LABELS long ${test_PROPERTIES})
  endif()
  catch_discover_tests(test_${name} ${usual} TEST_PREFIX "${test_LAYER}/" PROPERTIES TIMEOUT 600 ${test_PROPERTIES})
endfunction()
