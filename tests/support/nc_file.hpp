#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace twin::test {

using Point = Eigen::Vector2d;

/// Whole file of nc_programs/ as text.
inline std::string read_file(const std::string& name) {
  std::ifstream in(std::string(TWIN_SOURCE_DIR) + "/nc_programs/" + name, std::ios::binary);
  if (!in) {
    throw std::runtime_error("cannot open " + name);
  }
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Text without what is in round brackets.
inline std::string without_comments(const std::string& text) {
  std::string out;
  bool is_comment = false;
  for (const char c : text) {
    is_comment = is_comment || c == '(';
    if (!is_comment) {
      out.push_back(c);
    }
    is_comment = is_comment && c != ')';
  }
  return out;
}

/// Lines of the program without comments and without empty lines.
inline std::vector<std::string> code_lines(const std::string& name) {
  std::istringstream in(without_comments(read_file(name)));
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) {
      out.push_back(line);
    }
  }
  return out;
}

/// Value of a word of the line, or `otherwise`.
inline double word(const std::string& line, char letter, double otherwise) {
  const std::size_t at = line.find(letter);
  return at == std::string::npos ? otherwise : std::stod(line.substr(at + 1));
}

/// Corners of a program of straight blocks, X0 Y0 first [mm].
inline std::vector<Point> polygon(const std::string& name) {
  std::vector<Point> out{Point::Zero()};
  for (const std::string& line : code_lines(name)) {
    if (line.front() == 'X' || line.front() == 'Y') {
      out.emplace_back(word(line, 'X', out.back().x()), word(line, 'Y', out.back().y()));
    }
  }
  return out;
}

/// Lengths of the blocks between the points [mm].
inline std::vector<double> lengths(const std::vector<Point>& points) {
  std::vector<double> out;
  for (std::size_t i = 1; i < points.size(); ++i) {
    out.push_back((points[i] - points[i - 1]).norm());
  }
  return out;
}

}  // namespace twin::test
