# A room is a static library of the same name; a test is one executable of GoogleTest cases.

add_library(zrobench_options INTERFACE)
target_include_directories(zrobench_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(zrobench_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Wold-style-cast
  -ffp-contract=off  # a*b+c must round alike on host and target
  $<$<BOOL:${ZROBENCH_WERROR}>:-Werror>)

# zrobench_room(NAME SOURCES a.cc ... DEPS lib ...)
function(zrobench_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC zrobench_options ${ARG_DEPS})
endfunction()

# What ./run-tests builds a second time, with sanitizers.
add_custom_target(sanitized_tests)

# GoogleTest, parsed once for all tests; they include it all the same.
function(zrobench_test_headers)
  file(WRITE ${CMAKE_BINARY_DIR}/test_headers.cc "")
  add_library(test_headers OBJECT ${CMAKE_BINARY_DIR}/test_headers.cc)
  target_link_libraries(test_headers PRIVATE zrobench_options GTest::gmock)
  target_compile_options(test_headers PRIVATE ${zrobench_test_options})
  target_precompile_headers(test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
endfunction()
set(zrobench_test_options
  $<$<CONFIG:Release>:-O1>  # tests are built more than run
  -fpch-preprocess)         # ccache asks for it (its manual, "Precompiled headers")

# zrobench_test(NAME [LABELS l ...] SOURCES a_test.cc ... DEPS lib ...)
function(zrobench_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} zrobench_options GTest::gmock GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${zrobench_test_options})
  target_precompile_headers(${name} REUSE_FROM test_headers)
  target_compile_definitions(${name} PRIVATE ZROBENCH_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(ARG_LABELS MATCHES "^(unit|crash)$")
    add_dependencies(sanitized_tests ${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS ${ARG_LABELS} TIMEOUT 300)
endfunction()

# zrobench_hot(NAME): simulated hours run through this room; worth optimising under the sanitizers,
# which build everything else unoptimised to be built soon.
function(zrobench_hot name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:None>:-O1>)
endfunction()
