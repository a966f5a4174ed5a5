#include <fmt/format.h>

#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction_files.hpp"

namespace twin::studies::reproduce {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Wang and Yau beside twin</title>
<style>
body { font: 15px/1.45 sans-serif; color: #222; max-width: 1080px; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.6em } h2 { font-size: 1.15em; margin: 2em 0 .5em }
table { border-collapse: collapse; font-size: .87em }
th, td { padding: .18em .6em; text-align: right; font-variant-numeric: tabular-nums }
th { font-weight: 600; vertical-align: bottom } tr > th:first-child, td.what, td.note { text-align: left }
tr.first > * { border-top: 1px solid #bbb } td.what { color: #555; white-space: pre }
td.note { color: #a33; font-size: .92em }
.w10 { background: #cfe8d5 } .w20 { background: #e6f2cf } .w30 { background: #fbf0c4 }
.out { background: #f6c9bd; font-weight: 700 }
.figures { display: flex; flex-wrap: wrap; gap: 1.5em }
figure { margin: 0; width: 500px } figure img { width: 100%; border: 1px solid #ddd }
figcaption { font-size: .87em; color: #555 } li { margin: .35em 0 }
</style>
</head>
<body>
)";

std::string figures_html(const std::vector<pictures::Picture>& pictures) {
  if (pictures.empty()) {
    return "";
  }
  std::string text = "<h2>Figures 12 to 19</h2>\n<div class=\"figures\">\n";
  for (const pictures::Picture& picture : pictures) {
    text += fmt::format(
        "<figure><a href=\"figures/{0}.svg\"><img src=\"figures/{0}.png\" alt=\"{1}\"></a>"
        "<figcaption>{1}</figcaption></figure>\n",
        picture.name, escape_html(picture.caption));
  }
  return text + "</div>\n";
}

}  // namespace

std::string page_text(const Reproduction& reproduction,
                      const std::vector<pictures::Picture>& pictures) {
  std::string text(kHead);
  text += fmt::format(
      "<h1>Published figures beside ours</h1>\n<p>{}; our machine: {}, simulated. A ratio is ours "
      "/ published: <span class=\"w10\">within 10 %</span>, <span class=\"w20\">20 %</span>, "
      "<span class=\"w30\">30 %</span>, <span class=\"out\">further off</span>.</p>\n",
      escape_html(reproduction.source), escape_html(reproduction.machine));
  text +=
      "<p>The same as <a href=\"tables.md\">tables.md</a>, <a href=\"tables.csv\">tables.csv"
      "</a> and <a href=\"reproduce.json\">reproduce.json</a>.</p>\n";
  text += to_html(grid_of_counts(reproduction));
  for (int table = kFirstTable; table <= kLastTable; ++table) {
    text += to_html(grid_of_table(reproduction, table));
  }
  text += figures_html(pictures);
  text += "<h2>What differs, and why</h2>\n<ul>\n";
  for (const std::string& difference : differences(reproduction)) {
    text += fmt::format("<li>{}</li>\n", escape_html(difference));
  }
  return text + "</ul>\n</body>\n</html>\n";
}

}  // namespace twin::studies::reproduce
