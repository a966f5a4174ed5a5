#include "core/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace twin {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  return words;
}

/// A heading in lines no wider than `width`.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  for (const std::string& word : words_of(text)) {
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= width) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

/// Widths of the columns: of their cells and of the longest word of their headings.
std::vector<std::size_t> column_widths(const TextTable& table, std::size_t least) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    std::size_t width = least;
    for (const std::string& word : words_of(table.head[i])) {
      width = std::max(width, word.size());
    }
    for (const Line& line : table.lines) {
      width = std::max(width, i < line.cells.size() ? line.cells[i].text.size() : 0);
    }
    widths.push_back(width);
  }
  return widths;
}

/// Width of one of the two columns in front.
std::size_t front_width(const TextTable& table, std::string Line::*field, std::size_t least) {
  std::size_t width = least;
  for (const Line& line : table.lines) {
    width = std::max(width, (line.*field).size());
  }
  return width;
}

std::string without_trailing_space(std::string text) {
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

/// The headings of the columns, each in as many lines as it needs, behind that of the rows.
std::string text_head(const TextTable& table, const std::vector<std::size_t>& widths,
                      std::size_t indent, std::size_t front) {
  std::vector<std::vector<std::string>> heads;
  std::size_t height = 0;
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    heads.push_back(wrapped(table.head[i], widths[i]));
    height = std::max(height, heads.back().size());
  }
  std::string text;
  for (std::size_t row = 0; row < height; ++row) {
    const bool is_last = row + 1 == height;
    std::string line = fmt::format("{:{}}{:<{}}", "", indent, is_last ? table.row_head : "", front);
    for (std::size_t i = 0; i < heads.size(); ++i) {
      const std::size_t skipped = height - heads[i].size();
      line += fmt::format(" {:>{}} ", row < skipped ? "" : heads[i][row - skipped], widths[i]);
    }
    text += without_trailing_space(line);
  }
  return text;
}

char sign_of(Mark mark) {
  return mark == Mark::kOutside ? '!' : mark == Mark::kDoubtful ? '*' : ' ';
}

constexpr std::array<std::string_view, 6> kClasses{"", "w10", "w20", "w30", "out", "doubt"};

}  // namespace

std::string to_text(const TextTable& table, const TextLayout& layout) {
  const auto widths = column_widths(table, layout.cell_width);
  const std::size_t what_width = front_width(table, &Line::what, 0);
  const std::size_t gap = what_width > 0 ? 2 : 0;
  const std::size_t row_width =
      std::max(front_width(table, &Line::row, layout.row_width), table.row_head.size());
  std::string text = table.title.empty() ? "" : table.title + "\n";
  text += text_head(table, widths, layout.indent, row_width + gap + what_width);
  for (const Line& line : table.lines) {
    std::string out = fmt::format("{:{}}{:<{}}{:{}}{:<{}}", "", layout.indent, line.row, row_width,
                                  "", gap, line.what, what_width);
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const Cell& cell = line.cells[i];
      out += fmt::format(" {:>{}}{}", cell.text, widths[i], sign_of(cell.mark));
    }
    if (layout.notes == Notes::kShown) {
      out += " " + line.note;
    }
    text += without_trailing_space(out);
  }
  return text;
}

namespace {

/// Any text within one cell of a Markdown table, or in its heading.
std::string in_one_cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    result += c == '|' ? "\\|" : std::string(1, static_cast<unsigned char>(c) < 32 ? ' ' : c);
  }
  return result;
}

}  // namespace

std::string quote_csv(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    result.append(c == '"' ? 2 : 1, c);
  }
  return result + "\"";
}

std::string to_markdown(const TextTable& table) {
  std::string text = fmt::format("## {}\n\n| {}| |", in_one_cell(table.title),
                                 table.row_head.empty() ? "" : table.row_head + " ");
  std::string rule = "| --- | --- |";
  for (const std::string& head : table.head) {
    text += fmt::format(" {} |", head);
    rule += " ---: |";
  }
  text += table.note_head.empty() ? "\n" : fmt::format(" {} |\n", table.note_head);
  text += rule + (table.note_head.empty() ? "\n" : " --- |\n");
  for (const Line& line : table.lines) {
    text += fmt::format("| {} | {} |", in_one_cell(line.row), line.what);
    for (const Cell& cell : line.cells) {
      const std::string_view bold = cell.mark == Mark::kOutside ? "**" : "";
      text += fmt::format(" {}{}{} |", bold, cell.text, bold);
    }
    text += table.note_head.empty() ? "\n" : fmt::format(" {} |\n", line.note);
  }
  return text + "\n";
}

std::string escape_html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string to_html(const TextTable& table) {
  std::string text =
      fmt::format("<h2>{}</h2>\n<table>\n<tr><th></th><th></th>", escape_html(table.title));
  for (const std::string& head : table.head) {
    text += fmt::format("<th>{}</th>", escape_html(head));
  }
  text += "<th></th></tr>\n";
  for (const Line& line : table.lines) {
    text += fmt::format("<tr{}><th>{}</th><td class=\"what\">{}</td>",
                        line.row.empty() ? "" : " class=\"first\"", escape_html(line.row),
                        escape_html(line.what));
    for (const Cell& cell : line.cells) {
      text += fmt::format("<td class=\"{}\">{}</td>", kClasses[static_cast<std::size_t>(cell.mark)],
                          escape_html(cell.text));
    }
    text += fmt::format("<td class=\"note\">{}{}</td></tr>\n",
                        line.note.empty() ? "" : table.note_head + ": ", escape_html(line.note));
  }
  return text + "</table>\n";
}

}  // namespace twin
