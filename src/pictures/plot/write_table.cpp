#include "pictures/plot/write_table.hpp"

#include "results/trace/csv_file.hpp"

namespace twin::pictures {

Expected<void> write_table(const std::filesystem::path& folder, const std::string& name,
                           std::span<const std::string_view> columns, const results::Table& table) {
  TWIN_TRY(results::CsvFile file, results::CsvFile::create(folder / (name + ".csv"),
                                                           folder / (name + ".csv.tmp"), columns));
  for (std::size_t i = 0; i < table.rows(); ++i) {
    TWIN_CHECK(file.write(table.row(i)));
  }
  return file.commit();
}

}  // namespace twin::pictures
