#include "studies/batch/store.hpp"
#include "core/sha256.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/temporary_folder.hpp"

namespace twin::fuzz {
namespace store_target {

using namespace studies;

batch::PreparedJob job() {
  batch::PreparedJob job{.job = {},
                         .program = gcode::ProgramText::from_text("G01 X1 F100\n", "a.nc"),
                         .machine = {},
                         .canonical = "{}",
                         .key = std::string(64, 'a')};
  return job;
}

/// The records of a result, first as they are, then with checksums that are right: by the first byte
/// the rest is job.json, summary.json or failure.json.
void run(Bytes bytes) {
  static const TemporaryFolder folder;
  static const batch::PreparedJob asked = job();
  const unsigned kind = bytes.empty() ? 0 : bytes.front();
  const std::string_view text = text_of(bytes.empty() ? bytes : bytes.subspan(1));
  std::error_code ignored;
  std::filesystem::remove_all(folder.path() / "store", ignored);
  if (kind % 4 == 3) {
    folder.write("store/twin-store.json", text);
    const auto opened = batch::Store::open(folder.path() / "store");
    promise(opened || !opened.error().message.empty(), "an error without a message");
    return;
  }
  const auto store = batch::Store::open(folder.path() / "store");
  promise(store.has_value(), "no store");
  const std::string place = "store/aa/" + asked.key + "/";
  if (kind % 4 == 0) {
    folder.write(place + "summary.json", "{}");
    folder.write(place + "job.json", text);
  } else {
    const std::string name = kind % 4 == 1 ? "summary.json" : "failure.json";
    folder.write(place + name, text);
    folder.write(place + "job.json", "{\"files\":{\"" + name + "\":\"" + sha256(text) + "\"}}");
  }
  static_cast<void>(store->find(asked));
}

}  // namespace store_target

const Target kStore{"store", store_target::run};

}  // namespace twin::fuzz
