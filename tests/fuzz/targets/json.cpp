#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "session/pictures.hpp"
#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace json_target {

/// A folder that stands as long as the process.
struct Folder {
  Folder() {
    char name[] = "/tmp/twin_fuzz_XXXXXX";
    promise(::mkdtemp(name) != nullptr, "no folder");
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path;
};

void run(Bytes bytes) {
  static const Folder folder;
  std::ofstream(folder.path / "summary.json", std::ios::binary) << text_of(bytes);
  const auto origin = session::read_origin(folder.path);
  promise(origin || !origin.error().message.empty(), "an error without a message");
}

}  // namespace json_target

const Target kJson{"json", json_target::run};

}  // namespace twin::fuzz
