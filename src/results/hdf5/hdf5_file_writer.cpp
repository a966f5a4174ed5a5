#include "results/hdf5/hdf5_file_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "results/hdf5/column_packer.hpp"
#include "results/hdf5/hdf5_calls.hpp"

namespace twin::results::hdf5 {
namespace {

/// Longest text of an attribute that the oldest format of files holds [bytes].
constexpr std::size_t kLongestText = 60000;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kNoWhole = std::numeric_limits<std::int64_t>::min();

/// One column on its way into its dataset.
struct Column {
  bool is_whole = false;
  Handle dataset;
  std::vector<std::uint64_t> waiting;  // bits of the values of the chunk that is being filled

  /// Takes a value of each row. @param step  from one to the next
  void take(std::span<const double> values, std::size_t step, std::size_t rows) {
    const std::size_t first = waiting.size();
    waiting.resize(first + rows);
    std::uint64_t* to = waiting.data() + first;
    const double* from = values.data();
    if (is_whole) {
      for (std::size_t i = 0; i < rows; ++i) {
        to[i] = std::bit_cast<std::uint64_t>(static_cast<std::int64_t>(from[i * step]));
      }
    } else {
      for (std::size_t i = 0; i < rows; ++i) {
        to[i] = std::bit_cast<std::uint64_t>(from[i * step] + 0.0);  // no -0
      }
    }
  }
};

class FileWriter final : public Hdf5Writer {
 public:
  FileWriter(std::string name, Handle file) : name_(std::move(name)), file_(std::move(file)) {}
  ~FileWriter() override {
    const Calls calls;
    columns_.clear();
    static_cast<void>(file_.close());
  }

  Expected<void> add(const TraceColumn& column);
  Expected<void> add_texts(const TraceColumn& column, const std::vector<std::string>& texts);
  Expected<void> flush_file();
  Expected<void> rows(std::span<const double> values) override;
  Expected<void> set_text(const char* name, std::string_view text) override;
  Expected<void> close() override;

 private:
  tl::unexpected<Error> failed(const char* action) {
    auto error = library_error(name_, action);
    failure_ = error.value();
    return error;
  }
  Expected<void> describe(hid_t dataset, const TraceColumn& column);
  Expected<void> set_text_of(hid_t object, const char* name, std::string_view text);
  Expected<void> write_chunk();

  std::string name_;
  Handle file_;
  std::vector<Column> columns_;
  ColumnPacker packer_;
  std::size_t written_ = 0;  // rows
  std::optional<Error> failure_;
};

/// How a dataset is stored.
Handle storage_of(bool is_whole) {
  Handle storage(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  const hsize_t chunk = kHdf5ChunkRows;
  H5Pset_chunk(storage.id(), 1, &chunk);
  H5Pset_shuffle(storage.id());
  H5Pset_deflate(storage.id(), 1);
  H5Pset_obj_track_times(storage.id(), false);
  if (is_whole) {
    H5Pset_fill_value(storage.id(), H5T_NATIVE_INT64, &kNoWhole);
  } else {
    H5Pset_fill_value(storage.id(), H5T_NATIVE_DOUBLE, &kNoNumber);
  }
  return storage;
}

Expected<void> FileWriter::add(const TraceColumn& column) {
  const bool is_whole = column.kind == TraceColumn::Kind::kWhole;
  const Handle storage = storage_of(is_whole);
  const hsize_t none = 0;
  const hsize_t any = H5S_UNLIMITED;
  const Handle space(H5Screate_simple(1, &none, &any), &H5Sclose);
  Handle dataset(
      H5Dcreate2(file_.id(), column.name.c_str(), is_whole ? H5T_STD_I64LE : H5T_IEEE_F64LE,
                 space.id(), H5P_DEFAULT, storage.id(), H5P_DEFAULT),
      &H5Dclose);
  if (!dataset.is_open()) {
    return failed("write");
  }
  TWIN_CHECK(describe(dataset.id(), column));
  columns_.push_back({is_whole, std::move(dataset), {}});
  columns_.back().waiting.reserve(kHdf5ChunkRows);
  return {};
}

Expected<void> FileWriter::describe(hid_t dataset, const TraceColumn& column) {
  TWIN_CHECK(set_text_of(dataset, "units", column.unit.empty() ? "1" : column.unit));
  return set_text_of(dataset, "long_name",
                     column.long_name.empty() ? column.name : column.long_name);
}

/// A dataset of texts, each as long as the longest. They have no mark as UTF-8, which Octave does not
/// read.
Expected<void> FileWriter::add_texts(const TraceColumn& column,
                                     const std::vector<std::string>& texts) {
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    longest = std::max(longest, text.size() + 1);
  }
  std::string all(longest * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) {
    texts[i].copy(all.data() + i * longest, longest - 1);
  }
  const Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.id(), longest);
  const Handle storage(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_obj_track_times(storage.id(), false);
  const hsize_t count = texts.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), &H5Sclose);
  const Handle dataset(H5Dcreate2(file_.id(), column.name.c_str(), type.id(), space.id(),
                                  H5P_DEFAULT, storage.id(), H5P_DEFAULT),
                       &H5Dclose);
  if (!dataset.is_open() || (count > 0 && H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL,
                                                   H5P_DEFAULT, all.data()) < 0)) {
    return failed("write");
  }
  return describe(dataset.id(), column);
}

/// A text of fixed length, which MATLAB and Octave read as they read their own. One that is too long
/// is left out.
Expected<void> FileWriter::set_text_of(hid_t object, const char* name, std::string_view text) {
  if (text.size() > kLongestText) {
    return {};
  }
  const std::string content(text);
  const Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.id(), content.size() + 1);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  if (H5Aexists(object, name) > 0) {
    H5Adelete(object, name);
  }
  const Handle attribute(H5Acreate2(object, name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         &H5Aclose);
  if (!attribute.is_open() || H5Awrite(attribute.id(), type.id(), content.c_str()) < 0) {
    return failed("write");
  }
  return {};
}

Expected<void> FileWriter::set_text(const char* name, std::string_view text) {
  if (failure_) {
    return tl::unexpected(*failure_);
  }
  const Calls calls;
  return set_text_of(file_.id(), name, text);
}

Expected<void> FileWriter::flush_file() {
  return H5Fflush(file_.id(), H5F_SCOPE_LOCAL) < 0 ? failed("write") : Expected<void>{};
}

Expected<void> FileWriter::rows(std::span<const double> values) {
  if (failure_) {
    return tl::unexpected(*failure_);
  }
  const std::size_t width = columns_.size();
  while (values.size() >= width) {
    const std::size_t rows =
        std::min(values.size() / width, kHdf5ChunkRows - columns_.front().waiting.size());
    for (std::size_t i = 0; i < width; ++i) {
      columns_[i].take(values.subspan(i), width, rows);
    }
    values = values.subspan(rows * width);
    if (columns_.front().waiting.size() == kHdf5ChunkRows) {
      const Calls calls;
      TWIN_CHECK(write_chunk());
      TWIN_CHECK(flush_file());
    }
  }
  return {};
}

/// Writes the rows that wait as a chunk of each column; the library need not pack them itself.
Expected<void> FileWriter::write_chunk() {
  const hsize_t offset = written_;
  written_ += columns_.front().waiting.size();
  const hsize_t rows = written_;
  for (Column& column : columns_) {
    const bool is_full = column.waiting.size() == kHdf5ChunkRows;
    column.waiting.resize(kHdf5ChunkRows, column.is_whole
                                              ? std::bit_cast<std::uint64_t>(kNoWhole)
                                              : std::bit_cast<std::uint64_t>(kNoNumber));
    const auto packed = packer_.pack(column.waiting, is_full);
    column.waiting.clear();
    if (H5Dset_extent(column.dataset.id(), &rows) < 0 ||
        H5Dwrite_chunk(column.dataset.id(), H5P_DEFAULT, 0, &offset, packed.size(), packed.data()) <
            0) {
      return failed("write");
    }
  }
  return {};
}

Expected<void> FileWriter::close() {
  if (failure_) {
    return tl::unexpected(*failure_);
  }
  const Calls calls;
  if (!columns_.empty() && !columns_.front().waiting.empty()) {
    TWIN_CHECK(write_chunk());
  }
  TWIN_CHECK(set_text_of(file_.id(), "rows", std::to_string(written_)));
  bool is_closed = true;
  for (Column& column : columns_) {
    is_closed = column.dataset.close() && is_closed;
  }
  return file_.close() && is_closed ? Expected<void>{} : failed("write");
}

/// Bytes of the file's structure that the library keeps in memory, where they take ten times as
/// much. What changes between two flushes is a quarter of them, and the least recently used go first:
/// so the file on the disk does not change between two flushes but for new chunks at its end, and
/// memory does not grow with it.
constexpr std::size_t kStructureInMemory = std::size_t{512} << 10;

void bound_structure_in_memory(hid_t file) {
  H5AC_cache_config_t config{};
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  if (H5Fget_mdc_config(file, &config) >= 0) {
    config.set_initial_size = true;
    config.initial_size = kStructureInMemory;
    config.min_size = kStructureInMemory;
    config.max_size = kStructureInMemory;
    config.incr_mode = H5C_incr__off;
    config.flash_incr_mode = H5C_flash_incr__off;
    config.decr_mode = H5C_decr__off;
    H5Fset_mdc_config(file, &config);
  }
}

Expected<std::unique_ptr<FileWriter>> begin_file(const std::filesystem::path& file) {
  const Handle access = file_access();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), &H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  Handle opened(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), &H5Fclose);
  if (!opened.is_open()) {
    return library_error(file.string(), "write");
  }
  bound_structure_in_memory(opened.id());
  auto writer = std::make_unique<FileWriter>(file.string(), std::move(opened));
  TWIN_CHECK(writer->set_text("created_by", "twin"));
  return writer;
}

}  // namespace

Expected<std::unique_ptr<Hdf5Writer>> create_writer(const std::filesystem::path& file,
                                                    const std::vector<TraceColumn>& columns) {
  const Calls calls;
  TWIN_TRY(std::unique_ptr<FileWriter> writer, begin_file(file));
  for (const TraceColumn& column : columns) {
    TWIN_CHECK(writer->add(column));
  }
  TWIN_CHECK(writer->flush_file());
  return writer;
}

Expected<void> write_table(const std::filesystem::path& file,
                           const std::vector<Hdf5TableColumn>& columns) {
  const Calls calls;
  TWIN_TRY(const std::unique_ptr<FileWriter> writer, begin_file(file));
  std::vector<const std::vector<double>*> numbers;
  for (const Hdf5TableColumn& column : columns) {
    if (column.texts.empty()) {
      TWIN_CHECK(writer->add(column.column));
      numbers.push_back(&column.numbers);
    } else {
      TWIN_CHECK(writer->add_texts(column.column, column.texts));
    }
  }
  std::vector<double> row(numbers.size());
  for (std::size_t i = 0; !numbers.empty() && i < numbers.front()->size(); ++i) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      row[k] = (*numbers[k])[i];
    }
    TWIN_CHECK(writer->rows(row));
  }
  return writer->close();
}

}  // namespace twin::results::hdf5
