// Run a program on the simulated servo XY table, once as it is and once with a stiffer loop.
#include <cstdio>
#include <twin/machines.hpp>
#include <twin/run.hpp>

int main() {
  const twin::Program program =
      twin::Program::from_text("G21 G90 G64\nG1 X20 F3000\nY15\nX0 Y0\nM30\n", "triangle.nc");
  double error = 0.0;  // of the run before [um]
  for (const double gain : {60.0, 120.0}) {
    twin::Settings settings;
    settings.set("servo.x.kp_per_s", gain).set("servo.y.kp_per_s", gain);
    settings.set("servo.x.kf=0").set("servo.y.kf=0");
    const auto table = twin::make_table(settings);
    const twin::Run run = twin::run(program, settings, *table);
    if (run.failure) {
      std::printf("failed: %s\n", to_string(*run.failure).c_str());
      return 1;
    }
    error = run.summary.number("tracking_error_um.x.max");
    std::printf("gain %3.0f 1/s: tracking error of x %.1f um, %.3f s\n", gain, error,
                run.summary.number("machining_time_s"));
  }
}
