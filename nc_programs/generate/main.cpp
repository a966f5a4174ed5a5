/// Writes the generated programs into the directory given, nc_programs by default.
#include <cstdio>
#include <exception>
#include <fstream>

#include "nc_programs/generate/programs.hpp"

int main(int argc, char** argv) {
  using namespace twin::programs;
  const std::string directory = argc > 1 ? argv[1] : "nc_programs";
  try {
    for (const ProgramFile& file : all_programs()) {
      std::ofstream out(directory + "/" + file.name, std::ios::binary);
      out << file.text;
      if (!out.flush()) {
        std::fprintf(stderr, "cannot write %s/%s\n", directory.c_str(), file.name.c_str());
        return 1;
      }
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
