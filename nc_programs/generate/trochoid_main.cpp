/// Writes trochoid.nc into the directory given, which is made.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "nc_programs/generate/programs.hpp"

int main(int argc, char** argv) {
  const std::filesystem::path directory = argc > 1 ? argv[1] : ".";
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  const auto program = twin::programs::trochoid_program();
  std::ofstream out(directory / program.name, std::ios::binary);
  out << program.text;
  if (!out.flush()) {
    std::fprintf(stderr, "cannot write %s\n", (directory / program.name).c_str());
    return 1;
  }
  return 0;
}
