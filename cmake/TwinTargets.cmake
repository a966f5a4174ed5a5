# One library per folder, one test program per room of the house: the only ways this project makes targets.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
# One set of flags for the program and its tests: optimised, and with this project's assertions. Eigen's own cost planning
# a third of its speed; the presets dev, asan and tsan have them.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DEIGEN_NO_DEBUG")
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
# g++ collects its garbage at 128 MB, a tenth of a unit's time; few units ever hold more than this [kB].
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
find_program(TWIN_CCACHE ccache)
if(TWIN_CCACHE)
  # With these it keeps units with precompiled headers, too.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${TWIN_CCACHE}")
endif()

add_library(twin_options INTERFACE)
target_include_directories(twin_options INTERFACE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/src")
target_compile_options(twin_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Werror
  -Wno-restrict  # g++ 12 is wrong about "literal" + std::string(...)
  -Wno-maybe-uninitialized  # and about the vectors in a std::variant that is moved
  -Wno-subobject-linkage)  # g++ takes a unit of several sources for a header
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # The warnings are chosen for g++; clang does not know all of these options.
  target_compile_options(twin_options INTERFACE -w)
endif()
if(TWIN_SANITIZE)
  target_compile_options(twin_options INTERFACE -fsanitize=${TWIN_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(twin_options INTERFACE -fsanitize=${TWIN_SANITIZE})
  if(TWIN_SANITIZE MATCHES "address")
    # The address sanitizer finds what these checks find; at every element of Eigen they take half of the time.
    target_compile_options(twin_options INTERFACE -fno-sanitize=null,alignment)
  endif()
endif()

# Longest time of a test [s].
if(TWIN_SANITIZE)
  set(TWIN_TEST_TIMEOUT 5400)
else()
  set(TWIN_TEST_TIMEOUT 900)
endif()

# Compiles a target's sources as one unit, or in batches of $1 sources: nine tenths of a source's time are its headers.
function(twin_unity target batch)
  if(TWIN_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
endfunction()

# Compiles the headers that nearly every unit includes once: for units with optimisation, for those without, and the
# same with the headers of tests. They are those of others only; a header of this project is never among them.
set(TWIN_COMMON_HEADERS <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstring> <deque> <filesystem> <fstream>
  <functional> <map> <memory> <mutex> <optional> <set> <span> <sstream> <string> <string_view> <thread> <variant> <vector>
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <fmt/ranges.h> <tl/expected.hpp>)
function(twin_precompile_headers)
  if(NOT TWIN_UNITY OR NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU OR TWIN_SANITIZE OR NOT CMAKE_BUILD_TYPE STREQUAL Release)
    return()
  endif()
  foreach(use IN ITEMS library test)
    if(use STREQUAL test AND NOT TWIN_BUILD_TESTS)
      break()
    endif()
    foreach(flag IN ITEMS -O2 -O0)
      set(name twin_headers_${use}${flag})
      add_library(${name} OBJECT EXCLUDE_FROM_ALL "${PROJECT_SOURCE_DIR}/cmake/headers.cpp")
      target_link_libraries(${name} PRIVATE twin_options PkgConfig::eigen fmt::fmt tl::expected)
      target_precompile_headers(${name} PRIVATE ${TWIN_COMMON_HEADERS})
      twin_optimise(${name} ${flag})
      if(use STREQUAL test)
        target_link_libraries(${name} PRIVATE GTest::gmock)
        target_precompile_headers(${name} PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
        # A program is compiled for places that only it has.
        set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
        target_compile_options(${name} PRIVATE -fPIE)
      endif()
    endforeach()
  endforeach()
endfunction()

# Lets a target use them: $1 is library or test, $2 says whether it is compiled without optimisation.
function(twin_use_precompiled_headers target use plain)
  if(plain)
    set(name twin_headers_${use}-O0)
  else()
    set(name twin_headers_${use}-O2)
  endif()
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# Optimises a target in another way than the build type Release does.
function(twin_optimise target flag)
  if(NOT TWIN_SANITIZE AND CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE ${flag})
  endif()
endfunction()

# twin_library(gcode SOURCES a.cpp b.cpp DEPS twin_core ... [PRIVATE_DEPS ...] [PLAIN] [FAST] [UNITY_BATCH n])
# makes target twin_gcode from the sources of this folder. A PLAIN one, which computes next to nothing itself, is
# compiled without optimisation. A FAST one, of whose speed planning lives, is compiled with -O3, which makes it a tenth
# faster; the headers that are compiled once are made for -O2 and would bring that with them.
function(twin_library name)
  cmake_parse_arguments(ARG "PLAIN;FAST" "UNITY_BATCH" "SOURCES;DEPS;PRIVATE_DEPS" ${ARGN})
  add_library(twin_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(twin_${name} PUBLIC twin_options ${ARG_DEPS} PRIVATE ${ARG_PRIVATE_DEPS})
  if(ARG_PLAIN)
    twin_optimise(twin_${name} -O0)
  endif()
  if(NOT ARG_UNITY_BATCH)
    set(ARG_UNITY_BATCH 0)
  endif()
  twin_unity(twin_${name} ${ARG_UNITY_BATCH})
  if(ARG_FAST)
    twin_optimise(twin_${name} -O3)
  else()
    twin_use_precompiled_headers(twin_${name} library "${ARG_PLAIN}")
  endif()
endfunction()

# twin_test(gcode SOURCES a_test.cpp DEPS twin_gcode [SHARDS n] [LABELS slow] [SERIAL] [PROGRAM] [OPTIMISED] [UNITY_BATCH n])
# makes program gcode_test, which target slow_tests builds if it is labelled slow, and else target all. ctest has an entry for each of its n shards, which gtest deals the tests to. SERIAL ones,
# on the wall clock, run with nothing beside; those of PROGRAM start the program `twin`;
# most compute next to nothing themselves and are compiled without optimisation, OPTIMISED ones with it.
function(twin_test name)
  cmake_parse_arguments(ARG "SERIAL;PROGRAM;OPTIMISED" "SHARDS;UNITY_BATCH" "SOURCES;DEPS;LABELS" ${ARGN})
  add_executable(${name}_test ${ARG_SOURCES})
  target_link_libraries(${name}_test PRIVATE ${ARG_DEPS} twin_test_support GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name}_test PRIVATE TWIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_compile_options(${name}_test PRIVATE -Wno-array-bounds -Wno-stringop-overflow)  # g++ 12 is wrong about short strings
  twin_optimise(${name}_test $<IF:$<BOOL:${ARG_OPTIMISED}>,-O1,-O0>)
  if(ARG_PROGRAM)
    target_compile_definitions(${name}_test PRIVATE TWIN_EXECUTABLE="$<TARGET_FILE:twin_program>")
    add_dependencies(${name}_test twin-studies)
  endif()
  if(NOT ARG_UNITY_BATCH)
    set(ARG_UNITY_BATCH 0)
  endif()
  twin_unity(${name}_test ${ARG_UNITY_BATCH})
  if(ARG_OPTIMISED)
    twin_use_precompiled_headers(${name}_test test FALSE)
  else()
    twin_use_precompiled_headers(${name}_test test TRUE)
  endif()
  if(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  if("slow" IN_LIST ARG_LABELS)
    set_target_properties(${name}_test PROPERTIES EXCLUDE_FROM_ALL ON)
    add_dependencies(slow_tests ${name}_test)
  endif()
  foreach(shard RANGE 1 ${ARG_SHARDS})
    set(test ${name})
    if(ARG_SHARDS GREATER 1)
      set(test ${name}.${shard})
    endif()
    math(EXPR index "${shard} - 1")
    add_test(NAME ${test} COMMAND ${name}_test --gtest_brief=1)
    set_tests_properties(${test} PROPERTIES TIMEOUT ${TWIN_TEST_TIMEOUT}
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${index}")
    if(ARG_LABELS)
      set_tests_properties(${test} PROPERTIES LABELS "${ARG_LABELS}" COST 100)
    endif()
    if(ARG_SERIAL)
      set_tests_properties(${test} PROPERTIES RUN_SERIAL TRUE)
    endif()
  endforeach()
endfunction()

# twin_bench(gcode SOURCES a_bench.cpp DEPS twin_gcode) makes program gcode_bench (Google Benchmark).
function(twin_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name}_bench ${ARG_SOURCES})
  target_link_libraries(${name}_bench PRIVATE ${ARG_DEPS} benchmark::benchmark_main)
  target_compile_definitions(${name}_bench PRIVATE TWIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()
