#include "results/hdf5/hdf5_file_columns.hpp"

#include <array>
#include <utility>

#include "results/hdf5/hdf5_calls.hpp"

namespace twin::results::hdf5 {
namespace {

/// A dataset that is a column.
struct FileColumn {
  Handle dataset;
  std::array<hsize_t, 2> dims{};  // rows, and 1; or 1, and rows
  int rank = 1;
  std::size_t along = 0;  // the dimension of the rows
};

class FileColumns final : public Hdf5Columns {
 public:
  FileColumns(std::string name, Handle file) : name_(std::move(name)), file_(std::move(file)) {}
  ~FileColumns() override {
    const Calls calls;
    columns_.clear();
    static_cast<void>(file_.close());
  }

  Expected<void> find();
  const std::vector<std::string>& names() const noexcept override { return names_; }
  std::size_t rows(std::size_t column) const noexcept override {
    return columns_[column].dims[columns_[column].along];
  }
  bool is_unfinished() const noexcept override { return is_unfinished_; }
  Expected<void> read(std::size_t column, std::size_t first, std::span<double> values) override;

 private:
  void take(const char* name);

  std::string name_;
  Handle file_;
  bool is_unfinished_ = false;
  std::vector<std::string> names_;
  std::vector<FileColumn> columns_;
};

/// Takes an object of the root if it is a column.
void FileColumns::take(const char* name) {
  H5O_info_t info{};
  if (H5Oget_info_by_name2(file_.id(), name, &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0 ||
      info.type != H5O_TYPE_DATASET) {
    return;
  }
  FileColumn column{Handle(H5Dopen2(file_.id(), name, H5P_DEFAULT), &H5Dclose)};
  const Handle type(H5Dget_type(column.dataset.id()), &H5Tclose);
  const Handle space(H5Dget_space(column.dataset.id()), &H5Sclose);
  const H5T_class_t kind = H5Tget_class(type.id());
  column.rank = H5Sget_simple_extent_ndims(space.id());
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || column.rank < 1 || column.rank > 2) {
    return;
  }
  H5Sget_simple_extent_dims(space.id(), column.dims.data(), nullptr);
  if (column.rank == 2 && column.dims[0] != 1 && column.dims[1] != 1) {
    return;
  }
  column.along = column.rank == 2 && column.dims[0] == 1 ? 1 : 0;
  names_.emplace_back(name);
  columns_.push_back(std::move(column));
}

Expected<void> FileColumns::find() {
  std::vector<std::string> links;
  const auto note = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  if (H5Literate(file_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, note, &links) < 0) {
    return library_error(name_, "read");
  }
  for (const std::string& link : links) {
    take(link.c_str());
  }
  is_unfinished_ = H5Aexists(file_.id(), "created_by") > 0 && H5Aexists(file_.id(), "rows") == 0;
  return {};
}

Expected<void> FileColumns::read(std::size_t column, std::size_t first, std::span<double> values) {
  const Calls calls;
  const FileColumn& from = columns_[column];
  std::array<hsize_t, 2> start{0, 0};
  std::array<hsize_t, 2> count{1, 1};
  start[from.along] = first;
  count[from.along] = values.size();
  const Handle space(H5Dget_space(from.dataset.id()), &H5Sclose);
  const hsize_t size = values.size();
  const Handle memory(H5Screate_simple(1, &size, nullptr), &H5Sclose);
  if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                          nullptr) < 0 ||
      H5Dread(from.dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT,
              values.data()) < 0) {
    return library_error(name_, ("read column " + names_[column]).c_str());
  }
  return {};
}

}  // namespace

Expected<std::unique_ptr<Hdf5Columns>> open_columns(const std::filesystem::path& file) {
  const Calls calls;
  const Handle access = file_access();
  Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.id()), &H5Fclose);
  if (!opened.is_open()) {
    return library_error(file.string(), "read this HDF5 file, which may be cut short");
  }
  auto columns = std::make_unique<FileColumns>(file.string(), std::move(opened));
  TWIN_CHECK(columns->find());
  return columns;
}

}  // namespace twin::results::hdf5
