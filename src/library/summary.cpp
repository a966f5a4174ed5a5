#include <fmt/format.h>

#include "config/nearest_name.hpp"
#include "core/json.hpp"
#include "library/inside.hpp"

namespace twin {
namespace {

/// Takes a value of the JSON, and those in it, under its name.
void collect(const Json& json, const std::string& name, auto& data) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      collect(value, name.empty() ? key : name + "." + key, data);
    }
    return;
  }
  if (json.is_number()) {
    data.numbers[name] = json.get<double>();
  } else if (json.is_string()) {
    data.texts[name] = json.get<std::string>();
  } else if (json.is_boolean()) {
    data.texts[name] = json.get<bool>() ? "true" : "false";
  } else {
    return;
  }
  data.keys.push_back(name);
}

/// The value of a key, or what else there is.
template <class Map>
const auto& found(const Map& map, std::string_view key, const std::vector<std::string>& keys,
                  std::string_view kind) {
  const auto it = map.find(key);
  if (it == map.end()) {
    throw Failure(
        {ErrorCode::kUsage,
         fmt::format("the summary has no {} {}{}", kind, key, config::did_you_mean(key, keys)),
         {},
         0,
         0});
  }
  return it->second;
}

}  // namespace

Summary Inside::summary(const results::Summary& summary, const Limits& limits) {
  auto data = std::make_shared<Summary::Data>();
  data->json = results::to_json(summary);
  data->table = results::to_table(summary, limits);
  collect(parse_json(data->json), "", *data);
  return Summary(std::move(data));
}

Summary::Summary(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

double Summary::number(std::string_view key) const {
  return found(data_->numbers, key, data_->keys, "number");
}
std::string Summary::text(std::string_view key) const {
  return found(data_->texts, key, data_->keys, "text");
}
bool Summary::has(std::string_view key) const noexcept {
  return data_->numbers.contains(key) || data_->texts.contains(key);
}
std::vector<std::string> Summary::keys() const { return data_->keys; }
const std::string& Summary::json() const noexcept { return data_->json; }
const std::string& Summary::table() const noexcept { return data_->table; }

}  // namespace twin
