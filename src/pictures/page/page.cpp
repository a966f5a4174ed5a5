#include "pictures/page/page.hpp"

#include <limits>
#include <string_view>

#include "core/json.hpp"
#include "core/text_table.hpp"
#include "pictures/page/packed.hpp"
#include "pictures/page/web_files.hpp"

namespace twin::pictures {
namespace {

constexpr double kOutlineStep = 1e-4;  // [mm]

Json json_of(const PackedColumn& column) {
  return {{"name", column.name},
          {"step", column.step},
          {"order", column.order},
          {"planes", column.planes},
          {"count", column.count}};
}

/// Appends the outline as two columns, and says where it is lifted.
void add_outline(Json& json, Packer& packer, const std::vector<Vec2>& outline) {
  std::vector<double> x;
  std::vector<double> y;
  Json lifts = Json::array();
  for (const Vec2& point : outline) {
    if (point.allFinite()) {
      x.push_back(point.x());
      y.push_back(point.y());
    } else {
      lifts.push_back(x.size());
    }
  }
  json["outline"] = {json_of(packer.add("outline_x_mm", x, kOutlineStep)),
                     json_of(packer.add("outline_y_mm", y, kOutlineStep))};
  json["lifts"] = std::move(lifts);
}

/// The numbers of a run as text, with what the page must know to read them.
Expected<Json> add_run(const PageRun& run) {
  Packer packer;
  Json json;
  json["name"] = run.name;
  json["partial"] = run.is_partial;
  json["note"] = run.note;
  if (run.is_live) {
    json["live"] = true;
  }
  json["rows_of_trace"] = run.rows.rows_of_trace;
  json["thinned"] = run.rows.is_thinned;
  Json summary = parse_json(run.summary);
  json["summary"] = summary.is_object() ? std::move(summary) : Json::object();
  json["columns"] = Json::array();
  for (const PageColumn& column : run.rows.columns) {
    json["columns"].push_back(json_of(packer.add(column.name, column.values, column.step)));
  }
  if (run.program) {
    add_outline(json, packer, run.program->outline);
    json["rapid_lines"] = run.program->rapid_lines;
    json["text_bytes"] = run.program->text.size();
    packer.add_bytes(run.program->text);
  }
  TWIN_TRY(json["data"], packer.finish());
  return json;
}

void replace(std::string& text, std::string_view mark, std::string_view by) {
  if (const std::size_t at = text.find(mark); at != std::string::npos) {
    text.replace(at, mark.size(), by);
  }
}

}  // namespace

Expected<std::string> page_text(std::span<const PageRun> runs, const std::string& title) {
  Json list = Json::array();
  for (const PageRun& run : runs) {
    TWIN_TRY(Json json, add_run(run));
    list.push_back(std::move(json));
  }
  std::string page(web_file("page.html"));
  replace(page, "<!--title-->", escape_html(title));
  replace(page, "/*style*/",
          std::string(web_file("uplot.css")) + std::string(web_file("style.css")));
  std::string code = "/*\n" + std::string(web_file("uplot.LICENSE")) + "*/\n";
  for (const std::string_view name : kScripts) {
    code += web_file(name);
    code += '\n';
  }
  replace(page, "/*code*/", code);
  replace(page, "/*runs*/", inside_html(list));
  return page;
}

}  // namespace twin::pictures
