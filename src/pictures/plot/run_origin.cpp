#include "pictures/plot/run_origin.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace twin::pictures {

RunOrigin read_run_origin(const std::filesystem::path& directory) {
  std::ifstream in(directory / "summary.json");
  const auto json = nlohmann::json::parse(in, nullptr, false);
  RunOrigin origin;
  if (!json.is_object()) {
    return origin;
  }
  const auto simulated = json.find("simulated");
  origin.is_simulated = simulated != json.end() && simulated->is_boolean() &&
                        simulated->get<bool>() && json.contains("machining_time_s");
  const auto period = json.find("period_s");
  if (period != json.end() && period->is_number()) {
    origin.period = period->get<double>();
  }
  return origin;
}

std::string title_of(const std::string& title, const RunOrigin& origin) {
  if (!origin.is_simulated) {
    return title;
  }
  return title.empty() ? "simulated" : title + ", simulated";
}

}  // namespace twin::pictures
