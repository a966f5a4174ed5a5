#include "studies/identify/search_checkpoint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/json.hpp"

namespace twin::studies::identify {
namespace {

constexpr const char* kFormat = "twin identify checkpoint 1";

std::vector<double> list_of(const Eigen::MatrixXd& values) {
  return {values.data(), values.data() + values.size()};
}

tl::unexpected<Error> about_checkpoint(const std::filesystem::path& file, std::string message) {
  return tl::unexpected<Error>(Error{ErrorCode::kFile, std::move(message), file.string(), 0, 0});
}

/// Numbers of a key as a matrix of given size; throws where they are not.
Eigen::MatrixXd matrix_of(const Json& json, const char* key, Eigen::Index rows,
                          Eigen::Index columns) {
  const auto values = json.at(key).get<std::vector<double>>();
  if (static_cast<Eigen::Index>(values.size()) != rows * columns) {
    throw Json::other_error::create(600, key, nullptr);
  }
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), rows, columns);
}

Checkpoint parsed(const Json& json) {
  Checkpoint checkpoint;
  checkpoint.fit = json.at("fit").get<std::string>();
  checkpoint.stage = json.at("stage").get<int>();
  search::Minimum& best = checkpoint.state.best;
  best.x = json.at("best").get<std::vector<double>>();
  best.cost = json.at("cost").get<double>();
  best.evaluations = json.at("evaluations").get<std::size_t>();
  search::CmaState& cma = checkpoint.state.cma;
  const auto n = static_cast<Eigen::Index>(best.x.size());
  cma.mean = matrix_of(json, "mean", n, 1);
  cma.step = json.at("step").get<double>();
  cma.covariance = matrix_of(json, "covariance", n, n);
  cma.step_path = matrix_of(json, "step_path", n, 1);
  cma.covariance_path = matrix_of(json, "covariance_path", n, 1);
  cma.generation = json.at("generation").get<std::uint64_t>();
  return checkpoint;
}

}  // namespace

Expected<void> write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  const auto& [cma, best] = checkpoint.state;
  const Json json{{"format", kFormat},
                  {"fit", checkpoint.fit},
                  {"stage", checkpoint.stage},
                  {"generation", cma.generation},
                  {"evaluations", best.evaluations},
                  {"cost", best.cost},
                  {"best", best.x},
                  {"step", cma.step},
                  {"mean", list_of(cma.mean)},
                  {"covariance", list_of(cma.covariance)},
                  {"step_path", list_of(cma.step_path)},
                  {"covariance_path", list_of(cma.covariance_path)}};
  return write_whole_file(file, to_text(json));
}

Expected<std::optional<Checkpoint>> read_checkpoint(const std::filesystem::path& file,
                                                    const std::string& fit) {
  if (!std::filesystem::exists(file)) {
    return std::optional<Checkpoint>();
  }
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  const Json json = parse_json(text.str());
  if (!json.is_object() || !json.contains("format") || json["format"] != kFormat) {
    return about_checkpoint(file, "is not the checkpoint of a search; remove it to begin anew");
  }
  try {
    Checkpoint checkpoint = parsed(json);
    if (checkpoint.fit != fit) {
      return about_checkpoint(
          file, fmt::format("is the checkpoint of another fit ({}, this one is {}): remove it to "
                            "begin anew, or name another --out",
                            checkpoint.fit, fit));
    }
    return std::optional(std::move(checkpoint));
  } catch (const Json::exception&) {
    return about_checkpoint(file, "is a checkpoint with parts missing; remove it to begin anew");
  }
}

}  // namespace twin::studies::identify
