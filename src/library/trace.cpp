#include <algorithm>
#include <filesystem>

#include "library/inside.hpp"
#include "results/trace/csv_trace.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin {

struct CsvTrace::Data {
  std::filesystem::path folder;
  results::CsvTrace trace;
};

CsvTrace::CsvTrace(const std::string& folder)
    : data_(new Data{folder, results::CsvTrace(folder)}) {}
CsvTrace::~CsvTrace() = default;

std::optional<Error> CsvTrace::begin(const TraceHeader& header) {
  if (auto made = make_folder(data_->folder); !made) {
    return std::move(made).error();
  }
  return data_->trace.begin(header);
}

std::optional<Error> CsvTrace::rows(std::span<const double> values) {
  return data_->trace.rows(values);
}
std::optional<Error> CsvTrace::commit() { return data_->trace.commit(); }
void CsvTrace::abandon() noexcept { data_->trace.abandon(); }

void read_trace(const std::string& file, TraceSink& sink) {
  const auto check_call = [](std::optional<Error> error) { check(checked(std::move(error))); };
  results::TraceReader reader = value_of(results::TraceReader::open(file));
  TraceHeader header;
  for (const std::string& name : reader.header()) {
    header.columns.push_back({.name = name});
  }
  const auto time = static_cast<std::size_t>(
      std::ranges::find(reader.header(), std::string_view("t_s")) - reader.header().begin());
  std::vector<double> first;  // the rows up to the second, by which the period is known
  std::size_t rows = 0;
  const auto begin = [&] {
    if (rows > 1 && time < header.columns.size()) {
      header.period = first[header.columns.size() + time] - first[time];
    }
    check_call(sink.begin(header));
    if (rows > 0) {
      check_call(sink.rows(first));
    }
  };
  check(reader.for_each_row([&](std::span<const double> row) {
    if (++rows <= 2) {
      first.insert(first.end(), row.begin(), row.end());
    }
    if (rows == 2) {
      begin();
    } else if (rows > 2) {
      check_call(sink.rows(row));
    }
  }));
  if (rows < 2) {
    begin();
  }
  check_call(sink.commit());
}

}  // namespace twin
