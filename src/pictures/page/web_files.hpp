#pragma once

#include <array>
#include <string_view>

namespace twin::pictures {

/// Scripts of the page, in the order in which they must run.
inline constexpr std::array<std::string_view, 9> kScripts{
    "uplot.js",  "data.js",   "quantities.js", "path_view.js", "scene3d.js",
    "curves.js", "panels.js", "live.js",       "main.js"};

/// The text of a file in the folder web, which is a part of the program. Empty for another name.
std::string_view web_file(std::string_view name);

}  // namespace twin::pictures
