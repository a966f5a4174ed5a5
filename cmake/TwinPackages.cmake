# Packages from the system; nothing is downloaded at configure time. Names of the Debian packages: see ./twin.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tl-expected REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(FastFloat REQUIRED)
pkg_check_modules(eigen REQUIRED IMPORTED_TARGET eigen3)
pkg_check_modules(osmesa REQUIRED IMPORTED_TARGET osmesa)
pkg_check_modules(ffmpeg REQUIRED IMPORTED_TARGET libavcodec libavformat libavutil libswscale)

# mujoco::mujoco comes from find_package; an unpacked upstream release has no CMake package of its own.
if(TWIN_MUJOCO_ROOT)
  find_library(TWIN_MUJOCO_LIBRARY mujoco PATHS "${TWIN_MUJOCO_ROOT}/lib" NO_DEFAULT_PATH REQUIRED)
  add_library(mujoco::mujoco SHARED IMPORTED)
  set_target_properties(mujoco::mujoco PROPERTIES
    IMPORTED_LOCATION "${TWIN_MUJOCO_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${TWIN_MUJOCO_ROOT}/include")
else()
  find_package(mujoco 2.2 REQUIRED)
endif()

if(TWIN_BUILD_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(TWIN_BUILD_BENCH)
  find_package(benchmark REQUIRED)
endif()
