#include "gcode/flow/control_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gcode/text/fault.hpp"

namespace twin::gcode {

/// Finds the partners while the lines come one after the other.
class IndexBuilder {
 public:
  explicit IndexBuilder(ControlIndex& index) : index_(index) {}

  Expected<void> add(std::string_view line, std::size_t at, const LineSource::Place& begin,
                     const LineSource::Place& behind) {
    auto control = read_control_line(line, at);
    if (!control) {
      return {};  // the flow says so when it comes there
    }
    if (index_.entries_.size() == ControlIndex::kMost) {
      return fail_at(0, fmt::format("more than {} lines of flow control", ControlIndex::kMost));
    }
    index_.entries_.push_back({begin, behind, control->keyword, std::nullopt});
    if (control->keyword >= Keyword::kMacroIf) {
      add_macro(line, *control);
    } else {
      add_o_word(*control);
    }
    return {};
  }

 private:
  /// A begin whose end has not come.
  struct Open {
    std::size_t entry;
    std::string label;
  };

  std::size_t last() const { return index_.entries_.size() - 1; }
  Keyword keyword_of(const Open& open) const { return index_.entries_[open.entry].keyword; }

  void add_o_word(const ControlLine& control) {
    const std::string& label = control.label;
    switch (control.keyword) {
      case Keyword::kName:
        index_.names_.emplace(label, last());
        break;
      case Keyword::kSub:
        index_.subs_.emplace(label, last());
        open_.push_back({last(), label});
        break;
      case Keyword::kWhile:
        if (!close(label, {Keyword::kDo})) {
          open_.push_back({last(), label});
        }
        break;
      case Keyword::kIf:
      case Keyword::kDo:
      case Keyword::kRepeat:
        open_.push_back({last(), label});
        break;
      case Keyword::kElseIf:
      case Keyword::kElse:
        if (close(label, {Keyword::kIf, Keyword::kElseIf})) {
          index_.entries_.back().partner.reset();
          open_.push_back({last(), label});
        }
        break;
      case Keyword::kEndIf:
        close(label, {Keyword::kIf, Keyword::kElseIf, Keyword::kElse});
        break;
      case Keyword::kEndSub:
        close(label, {Keyword::kSub});
        break;
      case Keyword::kEndWhile:
        close(label, {Keyword::kWhile});
        break;
      case Keyword::kEndRepeat:
        close(label, {Keyword::kRepeat});
        break;
      case Keyword::kBreak:
      case Keyword::kContinue:
        point_at_loop(label);
        break;
      default:
        break;
    }
  }

  void add_macro(std::string_view line, const ControlLine& control) {
    const auto number = [line](std::size_t at) {
      while (at < line.size() && !is_digit(line[at])) {
        ++at;
      }
      return "DO" + std::string(line.substr(at, 1));
    };
    if (control.keyword == Keyword::kMacroDo) {
      open_.push_back({last(), number(control.rest)});
    } else if (control.keyword == Keyword::kMacroWhile) {
      open_.push_back({last(), number(std::min(line.rfind(']'), line.size()))});
    } else if (control.keyword == Keyword::kMacroEnd) {
      close(number(control.rest), {Keyword::kMacroDo, Keyword::kMacroWhile});
    }
  }

  /// Joins the last entry to the innermost open one of its label and one of the kinds.
  bool close(std::string_view label, std::initializer_list<Keyword> kinds) {
    for (std::size_t i = open_.size(); i-- > 0;) {
      const Keyword kind = keyword_of(open_[i]);
      if (open_[i].label == label && std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) {
        index_.entries_[open_[i].entry].partner = last();
        index_.entries_.back().partner = open_[i].entry;
        open_.resize(i);
        return true;
      }
      if (kind == Keyword::kSub) {
        return false;
      }
    }
    return false;
  }

  void point_at_loop(std::string_view label) {
    for (std::size_t i = open_.size(); i-- > 0;) {
      const Keyword kind = keyword_of(open_[i]);
      if (open_[i].label == label &&
          (kind == Keyword::kWhile || kind == Keyword::kDo || kind == Keyword::kRepeat)) {
        index_.entries_.back().partner = open_[i].entry;
        return;
      }
    }
  }

  ControlIndex& index_;
  std::vector<Open> open_;
};

Expected<ControlIndex> ControlIndex::of(const ProgramText& text, bool skips_deleted) {
  ControlIndex index;
  IndexBuilder builder(index);
  LineSource source(text);
  while (true) {
    const LineSource::Place begin = source.place();
    auto line = source.next();
    if (!line || !*line) {
      return index;  // an over-long line is the flow's to report
    }
    std::size_t at = (*line)->find_first_not_of(" \t");
    if (at == std::string_view::npos) {
      continue;
    }
    if ((**line)[at] == '/') {
      if (skips_deleted) {
        continue;
      }
      ++at;
    }
    at = begin_of_words(**line, at);
    if (at < (*line)->size() && may_be_control(**line, at)) {
      TWIN_CHECK(builder.add(**line, at, begin, source.place()));
    }
  }
}

std::size_t ControlIndex::at_offset(std::int64_t offset) const {
  const auto found = std::lower_bound(
      entries_.begin(), entries_.end(), offset,
      [](const ControlEntry& entry, std::int64_t place) { return entry.begin.offset < place; });
  return static_cast<std::size_t>(found - entries_.begin());
}

std::optional<std::size_t> ControlIndex::find_sub(std::string_view label) const {
  const auto found = subs_.find(label);
  return found == subs_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::size_t> ControlIndex::find_name(std::string_view label) const {
  const auto found = names_.find(label);
  return found == names_.end() ? std::nullopt : std::optional(found->second);
}

ControlIndex::Extent ControlIndex::extent_around(std::int64_t offset, std::int64_t size) const {
  Extent extent{{}, size};
  for (const auto& [label, entry] : names_) {
    const ControlEntry& name = entries_[entry];
    if (name.begin.offset <= offset && name.behind.offset > extent.begin.offset) {
      extent.begin = name.behind;
    } else if (name.begin.offset > offset) {
      extent.end = std::min(extent.end, name.begin.offset);
    }
  }
  return extent;
}

}  // namespace twin::gcode
