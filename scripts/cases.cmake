# SPDX-License-Identifier: Apache-2.0
# Each case of the GoogleTest programs as a test of its own, for `ctest -C cases`: `make test TESTS=SphericalSetup`.
if(CTEST_CONFIGURATION_TYPE STREQUAL "cases")
  foreach(program ${programs})
    execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX REPLACE " *#[^\n]*" "" listed "${listed}") # values of parameters
    string(REPLACE "\n" ";" lines "${listed}")
    foreach(line ${lines})
      if(line MATCHES "^[A-Za-z0-9_/]+\\.$")
        set(suite ${line})
      elseif(line MATCHES "^  (.+)$")
        add_test("${suite}${CMAKE_MATCH_1}" ${program} "--gtest_filter=${suite}${CMAKE_MATCH_1}")
      endif()
    endforeach()
  endforeach()
endif()
