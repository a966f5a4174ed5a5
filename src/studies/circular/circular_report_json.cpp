#include "core/json.hpp"
#include "core/units.hpp"
#include "studies/circular/circular_report.hpp"

namespace twin::studies::circular {
namespace {

double um(double mm) { return rounded(units::um_from_mm(mm)); }
double deg(double rad) { return rounded(units::deg_from_rad(rad)); }

Json spike_of(const Spike& spike) {
  return {{"angle_deg", deg(spike.angle)},
          {"height_um", um(spike.height)},
          {"width_deg", deg(spike.width)}};
}

Json spikes_of(const std::array<ReversalSpikes, 2>& spikes) {
  Json list = Json::array();
  for (std::size_t q = 0; q < 4; ++q) {
    list.push_back({{"quadrant_deg", 90 * q},
                    {"axis", q % 2 == 0 ? "x" : "y"},
                    {"ccw", spike_of(spikes[0].quadrant[q])},
                    {"cw", spike_of(spikes[1].quadrant[q])}});
  }
  return list;
}

Json circle_of(const Circle& circle) {
  return {{"x_um", um(circle.centre.x())},
          {"y_um", um(circle.centre.y())},
          {"radius_mm", rounded(circle.radius)}};
}

Json json_of(const Measured& measured) {
  const Deviations& d = measured.deviations;
  const SenseDeviations& ccw = d.sense[0];
  const SenseDeviations& cw = d.sense[1];
  Json json;
  json["circular_deviation_um"] = {{"ccw", um(ccw.circular)}, {"cw", um(cw.circular)}};
  json["bidirectional_circular_deviation_um"] = um(d.bidirectional);
  json["circular_hysteresis_um"] = um(d.hysteresis);
  json["mean_bidirectional_radial_deviation_um"] = um(d.mean_radial);
  json["radial_deviation_um"] = {
      {"ccw", {{"max", um(ccw.radial_max)}, {"min", um(ccw.radial_min)}}},
      {"cw", {{"max", um(cw.radial_max)}, {"min", um(cw.radial_min)}}}};
  json["least_squares_circle"] = {{"ccw", circle_of(ccw.least_squares)},
                                  {"cw", circle_of(cw.least_squares)}};
  json["reversal_spikes"] = spikes_of(measured.spikes);
  json["ripple_um"] = {{"ccw", um(measured.spikes[0].ripple)},
                       {"cw", um(measured.spikes[1].ripple)}};
  return json;
}

}  // namespace

std::string to_json(const Report& report) {
  Json json;
  json["machine"] = report.machine;
  json["hal"] = report.hal;
  json["interpolator"] = report.interpolator;
  json["period_s"] = rounded(report.period);
  json["radius_mm"] = rounded(report.radius);
  json["feedrate_mm_per_s"] = {{"programmed", rounded(report.feedrate)},
                               {"ccw", rounded(report.reached[0])},
                               {"cw", rounded(report.reached[1])}};
  json["table"] = json_of(report.table);
  json["encoder"] = json_of(report.encoder);
  json["predicted_radial_deviation_um"] =
      report.predicted ? Json(um(*report.predicted)) : Json(nullptr);
  return to_text(json);
}

}  // namespace twin::studies::circular
