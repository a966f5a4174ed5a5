#include <filesystem>
#include <system_error>

#include "core/atomic_file.hpp"
#include "library/inside.hpp"
#include "results/trace/csv_trace.hpp"

namespace twin {

struct CsvTrace::Data {
  std::filesystem::path folder;
  results::CsvTrace trace;
};

CsvTrace::CsvTrace(const std::string& folder)
    : data_(new Data{folder, results::CsvTrace(folder)}) {}
CsvTrace::~CsvTrace() = default;

std::optional<Error> CsvTrace::begin(const TraceHeader& header) {
  std::error_code code;
  std::filesystem::create_directories(data_->folder, code);
  if (code) {
    return file_error(data_->folder, "make this folder", code.value()).value();
  }
  return data_->trace.begin(header);
}

std::optional<Error> CsvTrace::rows(std::span<const double> values) {
  return data_->trace.rows(values);
}
std::optional<Error> CsvTrace::commit() { return data_->trace.commit(); }
void CsvTrace::abandon() noexcept { data_->trace.abandon(); }

}  // namespace twin
