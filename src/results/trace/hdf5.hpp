#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "twin/trace.hpp"

/// Traces as HDF5. Everything that needs the HDF5 library is in the module twin-hdf5.so, which is
/// loaded when the first such file is written or read.
namespace twin::results {

/// Rows between two flushes of an HDF5 file, which is the length of its chunks.
inline constexpr std::size_t kHdf5ChunkRows = 8192;

/// Writes rows of numbers into an HDF5 file: one dataset a column, at the root, with the attributes
/// `units` and `long_name`; shuffled and deflated in chunks of kHdf5ChunkRows rows.
///
/// After each chunk the file is flushed, so that a killed process leaves a file that can be read up
/// to there. No time goes into the file: the same rows are the same bytes. After a failure every
/// further call returns the first error.
class Hdf5Writer {
 public:
  Hdf5Writer() = default;
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  virtual ~Hdf5Writer() = default;  ///< closes the file as it is

  /// @param values  (rows x columns), row after row
  virtual Expected<void> rows(std::span<const double> values) = 0;
  /// Gives the file an attribute at its root, in place of one of that name.
  virtual Expected<void> set_text(const char* name, std::string_view text) = 0;
  /// Writes the rows that wait for their chunk, and closes the file.
  virtual Expected<void> close() = 0;
};

/// The columns of an HDF5 file: datasets of one dimension of numbers at its root, and those of two
/// dimensions of which one is 1.
class Hdf5Columns {
 public:
  Hdf5Columns() = default;
  Hdf5Columns(const Hdf5Columns&) = delete;
  Hdf5Columns& operator=(const Hdf5Columns&) = delete;
  virtual ~Hdf5Columns() = default;

  virtual const std::vector<std::string>& names() const noexcept = 0;
  virtual std::size_t rows(std::size_t column) const noexcept = 0;
  /// Whether the writer above was killed before it closed the file, so that columns may end apart.
  virtual bool is_unfinished() const noexcept = 0;
  /// Reads values of a column from row `first` on.
  virtual Expected<void> read(std::size_t column, std::size_t first, std::span<double> values) = 0;
};

/// A column of a table that is small enough to be in memory: numbers, or texts.
struct Hdf5TableColumn {
  TraceColumn column;  ///< name, kind, unit and meaning
  std::vector<double> numbers{};
  std::vector<std::string> texts{};  ///< where there are no numbers
};

/// What the module does.
struct Hdf5Module {
  /// Begins a file, in place of one that is there.
  Expected<std::unique_ptr<Hdf5Writer>> (*create)(const std::filesystem::path& file,
                                                  const std::vector<TraceColumn>& columns);
  Expected<std::unique_ptr<Hdf5Columns>> (*open)(const std::filesystem::path& file);
  /// Writes a whole table, in place of a file that is there. All columns are as long.
  Expected<void> (*write_table)(const std::filesystem::path& file,
                                const std::vector<Hdf5TableColumn>& columns);
};

/// Type and name of the one function that twin-hdf5.so shows.
using GiveHdf5Module = const Hdf5Module* (*)();
inline constexpr const char* kGiveHdf5ModuleName = "twin_hdf5";

/// The module; the first call loads it.
Expected<const Hdf5Module*> hdf5_module();

/// Whether a file begins as an HDF5 file does. What is no regular file is none.
bool is_hdf5(const std::filesystem::path& file);

}  // namespace twin::results
