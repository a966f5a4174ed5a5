#include "nc_programs/generate/programs.hpp"

#include "nc_programs/generate/butterfly.hpp"
#include "nc_programs/generate/exercises.hpp"
#include "nc_programs/generate/shapes.hpp"

namespace twin::programs {

std::vector<ProgramFile> all_programs() {
  return {outline_program(oxalis()), outline_program(dolphin()), butterfly_program(),
          butterfly_nurbs_program(), circle_program(),           square_program(),
          mixed_program(),           identify_program()};
}

}  // namespace twin::programs
