#include "hal/rig/cards.hpp"

#include "hal/rig/daqnavi_cards.hpp"
#include "hal/rig/pci1716.hpp"
#include "hal/rig/pci1784.hpp"
#include "hal/rig/register_cards.hpp"

namespace twin::hal::rig {

Expected<std::unique_ptr<Cards>> open_cards(const RigSettings& settings) {
  return settings.driver == Driver::kDaqnavi ? DaqnaviCards::open(settings)
                                             : open_register_cards(settings);
}

RigView look_at_rig(io_port::IoPort& pci1716, io_port::IoPort& pci1784,
                    const RigSettings& settings) {
  Pci1716 analogue(pci1716, safe_digital(settings));
  Pci1784 counters(pci1784, settings);
  RigView view;
  view.board_id_1716 = analogue.is_gone() ? -1 : analogue.board_id();
  view.digital = analogue.digital_in();
  std::array<std::int64_t, kCounters> counts{};
  view.board_id_1784 = counters.read(counts) ? counters.board_id() : -1;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const AxisWiring& wiring = settings.axis[axis];
    view.counts[axis] = counts[static_cast<std::size_t>(wiring.counter)];
    view.drives[axis] = Servopack(wiring).decode(view.digital, false);
    if (wiring.vref_readback >= 0) {
      view.vref[axis] = analogue.read_volts(wiring.vref_readback);
    }
  }
  return view;
}

}  // namespace twin::hal::rig
