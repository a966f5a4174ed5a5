#include "hal/rig/cards.hpp"

#include "hal/rig/daqnavi_cards.hpp"
#include "hal/rig/register_cards.hpp"

namespace twin::hal::rig {

Expected<std::unique_ptr<Cards>> open_cards(const RigSettings& settings) {
  return settings.driver == Driver::kDaqnavi ? DaqnaviCards::open(settings)
                                             : open_register_cards(settings);
}

}  // namespace twin::hal::rig
