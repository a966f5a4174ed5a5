#include "live/publisher.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <cerrno>
#include <charconv>
#include <utility>

#include "core/atomic_file.hpp"

namespace twin::live {
namespace {

/// "udp://127.0.0.1:9870" as an address.
std::optional<sockaddr_in> parse_address(std::string_view text) {
  constexpr std::string_view kScheme = "udp://";
  const std::size_t colon = text.rfind(':');
  if (!text.starts_with(kScheme) || colon < kScheme.size() || colon == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string host(text.substr(kScheme.size(), colon - kScheme.size()));
  const std::string_view port = text.substr(colon + 1);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc() || end != port.data() + port.size() || number == 0 ||
      inet_pton(AF_INET, host == "localhost" ? "127.0.0.1" : host.c_str(), &address.sin_addr) !=
          1) {
    return std::nullopt;
  }
  address.sin_port = htons(number);
  return address;
}

}  // namespace

Expected<std::unique_ptr<Publisher>> Publisher::open(const std::string& address) {
  const auto to = parse_address(address);
  if (!to) {
    return fail(
        ErrorCode::kUsage,
        fmt::format("--publish wants an address such as udp://127.0.0.1:9870, not {}", address));
  }
  Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.get() < 0) {
    return file_error(address, "open a socket for", errno);
  }
  return std::unique_ptr<Publisher>(new Publisher(std::move(socket), *to));
}

std::optional<Error> Publisher::begin(const TraceHeader& header) {
  names_.clear();
  for (const TraceColumn& column : header.columns) {
    names_.push_back(column.name);
  }
  return std::nullopt;
}

std::optional<Error> Publisher::rows(std::span<const double> values) {
  for (std::size_t row = 0; row < values.size(); row += names_.size()) {
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "{{");
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == "t_s") {
        fmt::format_to(std::back_inserter(text), "\"timestamp\":{},", values[row + i]);
      }
      fmt::format_to(std::back_inserter(text), "\"{}\":{}{}", names_[i], values[row + i],
                     i + 1 < names_.size() ? "," : "}\n");
    }
    // A listener that is gone or slow is no error of the run.
    static_cast<void>(::sendto(socket_.get(), text.data(), text.size(), 0,
                               reinterpret_cast<const sockaddr*>(&to_), sizeof(to_)));
  }
  return std::nullopt;
}

}  // namespace twin::live
