#include "runtime/program_source.hpp"

namespace twin::runtime {

Expected<gcode::Reader> open_program(const ProgramSource& program,
                                     const gcode::ReaderOptions& options) {
  if (program.text) {
    return gcode::Reader::from_text(*program.text, program.file.string(), options);
  }
  return gcode::Reader::open(program.file.string(), options);
}

}  // namespace twin::runtime
