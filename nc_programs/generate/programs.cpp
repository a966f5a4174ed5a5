#include "nc_programs/generate/programs.hpp"

namespace twin::programs {

std::vector<ProgramFile> all_programs() {
  return {outline_program(oxalis()),
          outline_program(dolphin()),
          butterfly_program(),
          butterfly_nurbs_program(),
          circle_program(),
          square_program(),
          mixed_program(),
          identify_program(),
          zigzag_program(),
          star_program(),
          gear_program()};
}

}  // namespace twin::programs
