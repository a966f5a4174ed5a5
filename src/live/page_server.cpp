#include "live/view_module.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/random.h>

#include <array>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "pictures/page/page.hpp"

namespace twin::live {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostRowsAnEvent = 2000;
constexpr std::size_t kThreads = 4;          // browsers that are served at a time
constexpr auto kPause = 100ms;               // between two events
constexpr auto kFarewell = 500ms;            // for browsers to get the last rows
constexpr std::int64_t kMostText = 4 << 20;  // of the program [bytes]

/// 128 random bits as text; empty if the system gives none.
std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    return {};
  }
  std::string token;
  for (const unsigned char byte : bytes) {
    token += fmt::format("{:02x}", byte);
  }
  return token;
}

/// What summary.json says of a run before it begins.
std::string summary_of(const LiveRun& run) {
  Json json{{"program", run.program.file().filename().string()},
            {"machine", run.machine.name},
            {"hal", run.hal},
            {"simulated", run.simulated},
            {"period_s", 1.0 / LiveView::kRowsPerSecond},
            {"settings", Json::object()}};
  for (const Setting& setting : config::settings_of(run.machine)) {
    json["settings"][setting.section][setting.key] =
        std::visit([](const auto& value) { return Json(value); }, setting.value);
  }
  return to_line(json);
}

Expected<std::string> page_of(const LiveRun& run) {
  pictures::PageRun page;
  page.name = run.program.file().filename().string();
  page.summary = summary_of(run);
  page.is_live = true;
  if (run.program.size() <= kMostText) {
    std::string text(static_cast<std::size_t>(run.program.size()), '\0');
    TWIN_TRY(const std::size_t copied, run.program.copy(0, text));
    text.resize(copied);
    page.program = pictures::PageProgram{std::move(text), {}, {}};
  }
  const std::array<pictures::PageRun, 1> runs{std::move(page)};
  return pictures::page_text(runs, runs[0].name + ", live, twin");
}

/// The page, its browsers and its rows.
struct Server {
  httplib::Server http;
  std::jthread thread;
  std::string address;
  std::string page;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> names;  // of the columns
  std::vector<double> kept;        // rows (rows x columns)
  double next_time = 0.0;          // of the next row that is kept [s]
  bool has_ended = false;
  std::atomic<int> listeners{0};

  std::size_t rows() const { return names.empty() ? 0 : kept.size() / names.size(); }
  std::string event(std::size_t from, std::size_t to) const;
  bool send(std::size_t& sent, httplib::DataSink& sink);
  void end();
};

/// Rows as an event: the names first.
std::string Server::event(std::size_t from, std::size_t to) const {
  Json list = Json::array();
  for (std::size_t row = from; row < to; ++row) {
    const auto begin = kept.begin() + static_cast<std::ptrdiff_t>(row * names.size());
    list.push_back(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(names.size())));
  }
  return "data: " + to_line({{"names", names}, {"rows", std::move(list)}}) + "\n\n";
}

/// The next event for a browser. @returns false when it is gone
bool Server::send(std::size_t& sent, httplib::DataSink& sink) {
  std::string text;
  bool is_last = false;
  {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, 1s, [&] { return has_ended || rows() > sent; });
    const std::size_t to = std::min(rows(), sent + kMostRowsAnEvent);
    text = to > sent ? event(sent, to) : std::string(": nothing new\n\n");
    sent = to;
    is_last = has_ended && sent == rows();
  }
  if (is_last) {
    text += "event: end\ndata: {}\n\n";
  }
  if (!sink.write(text.data(), text.size())) {
    return false;
  }
  if (is_last) {
    sink.done();
  } else {
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

void Server::end() {
  const std::lock_guard lock(mutex);
  has_ended = true;
  changed.notify_all();
}

class PageServer final : public LiveView {
 public:
  explicit PageServer(std::unique_ptr<Server> server) : server_(std::move(server)) {}
  ~PageServer() override;

  const std::string& address() const noexcept override { return server_->address; }
  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override;
  void abandon() noexcept override { server_->end(); }

 private:
  std::unique_ptr<Server> server_;
};

PageServer::~PageServer() {
  server_->end();
  const auto until = std::chrono::steady_clock::now() + kFarewell;
  while (server_->listeners > 0 && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(5ms);
  }
  server_->http.stop();
}

std::optional<Error> PageServer::begin(const TraceHeader& header) {
  const std::lock_guard lock(server_->mutex);
  server_->names.clear();
  for (const TraceColumn& column : header.columns) {
    server_->names.push_back(column.name);
  }
  return std::nullopt;
}

std::optional<Error> PageServer::rows(std::span<const double> values) {
  const std::lock_guard lock(server_->mutex);
  const std::size_t width = server_->names.size();
  for (std::size_t begin = 0; begin + width <= values.size(); begin += width) {
    const double t = values[begin];  // t_s, the first column
    if (t + 1e-9 >= server_->next_time) {
      server_->next_time = t + 1.0 / kRowsPerSecond;
      server_->kept.insert(server_->kept.end(), values.begin() + static_cast<std::ptrdiff_t>(begin),
                           values.begin() + static_cast<std::ptrdiff_t>(begin + width));
    }
  }
  server_->changed.notify_all();
  return std::nullopt;
}

std::optional<Error> PageServer::commit() {
  server_->end();
  return std::nullopt;
}

}  // namespace

Expected<std::unique_ptr<LiveView>> serve(const LiveRun& run, int port) {
  auto server = std::make_unique<Server>();
  TWIN_TRY(server->page, page_of(run));
  const std::string token = random_token();
  if (token.empty()) {
    return fail(ErrorCode::kFile, "--view: the system gives no random numbers");
  }
  Server& s = *server;
  s.http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  s.http.set_payload_max_length(0);
  s.http.Get("/" + token + "/", [&s](const httplib::Request&, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content(s.page, "text/html; charset=utf-8");
  });
  s.http.Get("/" + token + "/events", [&s](const httplib::Request&, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    ++s.listeners;
    response.set_chunked_content_provider(
        "text/event-stream",
        [&s, sent = std::size_t{0}](std::size_t, httplib::DataSink& sink) mutable {
          return s.send(sent, sink);
        },
        [&s](bool) { --s.listeners; });
  });
  const int bound = port == 0 ? s.http.bind_to_any_port("127.0.0.1")
                              : (s.http.bind_to_port("127.0.0.1", port) ? port : -1);
  if (bound <= 0) {
    return fail(ErrorCode::kFile,
                fmt::format("--view: port {} of 127.0.0.1 cannot be had; is it in use?", port));
  }
  s.address = fmt::format("http://127.0.0.1:{}/{}/", bound, token);
  s.thread = std::jthread([&s] { s.http.listen_after_bind(); });
  return std::unique_ptr<LiveView>(std::make_unique<PageServer>(std::move(server)));
}

}  // namespace twin::live
