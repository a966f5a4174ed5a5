#include <array>

#include "studies/convert/bspline.hpp"
#include "studies/convert/dialect.hpp"
#include "studies/convert/knot_nurbs.hpp"
#include "studies/convert/uniform_nurbs.hpp"

namespace twin::studies::convert {
namespace {

using Make = std::unique_ptr<Dialect> (*)();

struct Entry {
  std::string_view name;
  Make make;
  bool is_readable;
};

constexpr std::array<Entry, 4> kDialects = {{
    {"g5.2", []() -> std::unique_ptr<Dialect> { return std::make_unique<UniformNurbs>(); }, true},
    {"g6.2", []() -> std::unique_ptr<Dialect> { return std::make_unique<KnotNurbs>(); }, true},
    {"fanuc", []() -> std::unique_ptr<Dialect> { return std::make_unique<FanucNurbs>(); }, true},
    {"bspline", []() -> std::unique_ptr<Dialect> { return std::make_unique<Bspline>(); }, false},
}};

}  // namespace

std::vector<std::string> dialect_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kDialects) {
    names.emplace_back(entry.name);
  }
  return names;
}

bool is_readable(std::string_view name) {
  for (const Entry& entry : kDialects) {
    if (entry.name == name) {
      return entry.is_readable;
    }
  }
  return false;
}

std::unique_ptr<Dialect> make_dialect(std::string_view name) {
  for (const Entry& entry : kDialects) {
    if (entry.name == name) {
      return entry.make();
    }
  }
  return nullptr;
}

}  // namespace twin::studies::convert
