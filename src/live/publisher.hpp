#pragma once

#include <netinet/in.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/descriptor.hpp"
#include "core/error.hpp"
#include "twin/trace.hpp"

namespace twin::live {

/// Sends the rows of a run as they come, each a datagram of one line of JSON,
///   {"timestamp":1.25,"t_s":1.25,"x_cmd_mm":3.5,...}
/// as PlotJuggler's UDP server takes them. Nobody need listen; what the network does not take at
/// once is lost.
class Publisher final : public TraceSink {
 public:
  /// @param address  "udp://127.0.0.1:9870"; a number of IPv4, and a port
  /// @returns a kUsage error for another form
  static Expected<std::unique_ptr<Publisher>> open(const std::string& address);

  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override { return std::nullopt; }
  void abandon() noexcept override {}

 private:
  Publisher(Descriptor socket, const sockaddr_in& to) : socket_(std::move(socket)), to_(to) {}

  Descriptor socket_;
  sockaddr_in to_;
  std::vector<std::string> names_;
};

}  // namespace twin::live
