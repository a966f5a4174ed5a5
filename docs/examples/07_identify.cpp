// Identify a machine from a trace recorded on it: here the trace is that of a table whose friction
// is hidden from the search.
#include <cstdio>
#include <filesystem>
#include <twin/identify.hpp>
#include <twin/machines.hpp>
#include <twin/run.hpp>

int main() {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "twin_example_identify";
  twin::Settings hidden;
  hidden.set("table.x.coulomb_friction_N", 14.0);
  const auto table = twin::make_table(hidden);
  const twin::Run run = twin::run(twin::Program::from_file("identify.nc"), hidden, *table,
                                  {.folder = folder.string()});
  if (run.failure) {
    std::printf("failed: %s\n", to_string(*run.failure).c_str());
    return 1;
  }
  const twin::Identification found =
      twin::identify({(folder / "trace.csv").string()}, twin::Settings(), {.evaluations = 60});
  std::printf("%s\n", found.table.c_str());
  std::printf("Coulomb friction of x: %.1f N\n",
              found.settings.number("table.x.coulomb_friction_N"));
  fs::remove_all(folder);
}
