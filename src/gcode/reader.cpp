#include "gcode/reader.hpp"

#include <memory>
#include <utility>

#include "gcode/reading.hpp"

namespace twin::gcode {

Reader::Reader(const ProgramText& program, const ReaderOptions& options)
    : reading_(std::make_unique<Reading>(program, options)) {}
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;
Reader::~Reader() = default;

Expected<Reader> Reader::open(const std::string& path, const ReaderOptions& options) {
  TWIN_TRY(const ProgramText program, ProgramText::read(path));
  return Reader(program, options);
}

Reader Reader::from_text(std::string text, std::string name, const ReaderOptions& options) {
  return Reader(ProgramText::from_text(std::move(text), std::move(name)), options);
}

Expected<std::optional<Block>> Reader::next() { return reading_->next(); }
bool Reader::resume() { return reading_->resume(); }
const Notes& Reader::notes() const noexcept { return reading_->notes(); }
std::int64_t Reader::line() const noexcept { return reading_->flow().furthest_line(); }
std::int64_t Reader::bytes_read() const noexcept { return reading_->flow().bytes_read(); }
std::int64_t Reader::size() const noexcept { return reading_->flow().size(); }

}  // namespace twin::gcode
