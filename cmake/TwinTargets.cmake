# One library per folder, one test program per tested folder: the only ways this project makes targets.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(TWIN_CCACHE ccache)
if(TWIN_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${TWIN_CCACHE}")
endif()

add_library(twin_options INTERFACE)
target_include_directories(twin_options INTERFACE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/src")
target_compile_options(twin_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Werror
  -Wno-restrict)  # g++ 12 is wrong about "literal" + std::string(...)
if(TWIN_SANITIZE)
  target_compile_options(twin_options INTERFACE -fsanitize=${TWIN_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(twin_options INTERFACE -fsanitize=${TWIN_SANITIZE})
  # Eigen would allocate in another way under a sanitizer than in libpagmo, which frees what this program allocates.
  target_compile_definitions(twin_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# twin_library(gcode SOURCES a.cpp b.cpp DEPS twin_core ...)
# makes target twin_gcode from the sources of this folder.
function(twin_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  if(ARG_SOURCES)
    add_library(twin_${name} STATIC ${ARG_SOURCES})
    target_link_libraries(twin_${name} PUBLIC twin_options ${ARG_DEPS})
  else()
    add_library(twin_${name} INTERFACE)
    target_link_libraries(twin_${name} INTERFACE twin_options ${ARG_DEPS})
  endif()
endfunction()

# twin_test(gcode SOURCES a_test.cpp DEPS twin_gcode [LABELS slow] [SERIAL])
# makes program gcode_test and one ctest entry per TEST in it; SERIAL ones, on the wall clock, run with nothing beside.
function(twin_test name)
  cmake_parse_arguments(ARG "SERIAL" "" "SOURCES;DEPS;LABELS" ${ARGN})
  add_executable(${name}_test ${ARG_SOURCES})
  target_link_libraries(${name}_test PRIVATE ${ARG_DEPS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name}_test PRIVATE TWIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  set(label_property)
  if(ARG_LABELS)
    set(label_property LABELS "${ARG_LABELS}")
  endif()
  if(ARG_SERIAL)
    list(APPEND label_property RUN_SERIAL TRUE)
  endif()
  gtest_discover_tests(${name}_test DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT 300 ${label_property})
endfunction()

# twin_bench(gcode SOURCES a_bench.cpp DEPS twin_gcode) makes program gcode_bench (Google Benchmark).
function(twin_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name}_bench ${ARG_SOURCES})
  target_link_libraries(${name}_bench PRIVATE ${ARG_DEPS} benchmark::benchmark_main)
  target_compile_definitions(${name}_bench PRIVATE TWIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()
