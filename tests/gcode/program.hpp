#pragma once

#include <string>
#include <vector>

#include "gcode/reader.hpp"

namespace twin::gcode {

/// All blocks of a program, or its error.
Expected<std::vector<Block>> read_program(const std::string& text,
                                          const ReaderOptions& options = {});

/// All blocks a reader has left, or its error.
Expected<std::vector<Block>> read_rest(Reader& reader);

/// Blocks of a program that must be sound; an error fails the test and gives no block.
std::vector<Block> blocks_of(const std::string& text, const ReaderOptions& options = {});

/// "line:column: message" of a program that must fail; "" and a failed test if it does not.
std::string error_of(const std::string& text, const ReaderOptions& options = {});

/// A block in one line of text with 9 decimals, the same for the same geometry:
///   line motion mode start -> end [degree p U knots points w weights] [c centre n axis r radius a
///   sweep] F feedrate P tolerance
std::string to_text(const Block& block);

/// Blocks, one a line.
std::string to_text(const std::vector<Block>& blocks);

}  // namespace twin::gcode
