#include "hal/rig/register_cards.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "hal/rig/servopack.hpp"

namespace twin::hal::rig {
namespace {

std::string gone_text(std::string_view card) {
  return fmt::format("the {} no longer answers: its registers read all ones", card);
}

std::string port_text(std::string_view card, int number) {
  return fmt::format("an access to the {}'s registers failed: {}{}", card, std::strerror(number),
                     number == EPERM ? "; kernel lockdown (Secure Boot) may forbid it" : "");
}

}  // namespace

RegisterCards::RegisterCards(std::unique_ptr<io_port::IoPort> pci1716,
                             std::unique_ptr<io_port::IoPort> pci1784, const RigSettings& settings)
    : port_1716_(std::move(pci1716)),
      port_1784_(std::move(pci1784)),
      analogue_(*port_1716_, safe_digital(settings)),
      counters_(*port_1784_, settings) {}

Expected<std::unique_ptr<Cards>> RegisterCards::open(std::unique_ptr<io_port::IoPort> pci1716,
                                                     std::unique_ptr<io_port::IoPort> pci1784,
                                                     const RigSettings& settings) {
  std::unique_ptr<RegisterCards> cards(
      new RegisterCards(std::move(pci1716), std::move(pci1784), settings));
  cards->analogue_.open();
  cards->counters_.open();
  CardInputs inputs;
  if (cards->read(inputs) == Status::kError) {
    return fail(ErrorCode::kMachine, cards->last_error());
  }
  if (cards->analogue_.is_gone()) {
    cards->fail_with(Fault::kPci1716Gone);
    return fail(ErrorCode::kMachine, cards->last_error());
  }
  return std::unique_ptr<Cards>(std::move(cards));
}

RegisterCards::~RegisterCards() { analogue_.make_safe(); }

Status RegisterCards::fail_with(Fault fault) noexcept {
  fault_ = fault;
  return Status::kError;
}

Status RegisterCards::check_ports() noexcept {
  if (port_1716_->error() != 0) {
    return fail_with(Fault::kPci1716Port);
  }
  return port_1784_->error() != 0 ? fail_with(Fault::kPci1784Port) : Status::kOk;
}

Status RegisterCards::read(CardInputs& inputs) noexcept {
  const bool has_counters = counters_.read(inputs.counts);
  inputs.index_seen = counters_.take_index();
  inputs.digital = analogue_.digital_in();
  if (check_ports() == Status::kError) {
    return Status::kError;
  }
  if (!has_counters) {
    return fail_with(Fault::kPci1784Gone);
  }
  if (inputs.digital == 0xFFFF && analogue_.is_gone()) {
    return fail_with(Fault::kPci1716Gone);
  }
  return Status::kOk;
}

Status RegisterCards::write(const CardOutputs& outputs) noexcept {
  analogue_.set_digital(outputs.digital);
  for (std::size_t channel = 0; channel < kDacs; ++channel) {
    analogue_.set_volts(channel, outputs.volts[channel]);
  }
  return check_ports();
}

std::string RegisterCards::last_error() const {
  switch (fault_) {
    case Fault::kNone:
      return {};
    case Fault::kPci1716Gone:
      return gone_text(io_port::kPci1716.name);
    case Fault::kPci1784Gone:
      return gone_text(io_port::kPci1784.name);
    case Fault::kPci1716Port:
      return port_text(io_port::kPci1716.name, port_1716_->error());
    case Fault::kPci1784Port:
      return port_text(io_port::kPci1784.name, port_1784_->error());
  }
  return {};
}

Expected<CardsFound> find_cards(const RigSettings& settings) {
  TWIN_TRY(auto analogue, io_port::find_card(io_port::kPci1716, settings.pci1716_board_id,
                                             settings.access, settings.sysfs));
  TWIN_TRY(auto counters, io_port::find_card(io_port::kPci1784, settings.pci1784_board_id,
                                             settings.access, settings.sysfs));
  return CardsFound{std::move(analogue), std::move(counters)};
}

Expected<std::unique_ptr<Cards>> open_register_cards(const RigSettings& settings) {
  TWIN_TRY(const CardsFound found, find_cards(settings));
  TWIN_TRY(auto analogue, io_port::open_port(found.pci1716.port));
  TWIN_TRY(auto counters, io_port::open_port(found.pci1784.port));
  return RegisterCards::open(std::move(analogue), std::move(counters), settings);
}

}  // namespace twin::hal::rig
